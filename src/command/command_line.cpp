// Words for a shell.
#include "command/command_line.h"

#include "util/shell_word.h"

namespace etendue
{
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
