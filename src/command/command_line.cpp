// Words for a shell.
#include "command/command_line.h"

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
std::string command_line(const CLI::App& command)
{
    std::string text = "etendue " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_name() == "--help") continue;
        for (const std::string& value : option->results()) {
            if (!option->get_positional()) text += ' ' + option->get_name();
            if (option->get_items_expected_max() > 0) text += ' ' + shell_word(value);
        }
    }
    return text;
}
} // namespace etendue
