#include "support/pattern.h"

#include <regex>

namespace etendue
{
std::vector<std::string> matches(const std::string& text, const std::string& pattern, int group)
{
    const std::regex expression(pattern);
    return {std::sregex_token_iterator(text.begin(), text.end(), expression, group), {}};
}
} // namespace etendue
