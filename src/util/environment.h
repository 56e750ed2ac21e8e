// Environment variables of this process.
#pragma once

#include <string>

namespace etendue
{
// The value, or "" when the variable is not set.
std::string environment(const std::string& name);

// Set it for this process and what it loads later. Call before other threads start.
void set_environment(const std::string& name, const std::string& value);
} // namespace etendue
