// Words of a command line that a person can paste into a shell.
#pragma once

#include <string>

namespace etendue
{
// The word within single quotes where a shell would take it for something else.
std::string shell_word(const std::string& word);
} // namespace etendue
