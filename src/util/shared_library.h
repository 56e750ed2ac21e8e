// Whether a shared library can be loaded at all.
#pragma once

#include <string>

namespace etendue
{
// Why the dynamic linker cannot load the library of this name or path, or "" when it can.
std::string load_failure(const std::string& library);
} // namespace etendue
