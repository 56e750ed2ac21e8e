// Quoting for POSIX shells.
#include "util/shell_word.h"

#include <cctype>

namespace etendue
{
std::string shell_word(const std::string& word)
{
    bool is_plain = !word.empty();
    for (const char c : word)
        is_plain = is_plain && (std::isalnum(static_cast<unsigned char>(c)) ||
                                std::string("-_./:=,+@%").find(c) != std::string::npos);
    if (is_plain) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}
} // namespace etendue
