// Environment variables: the C++ standard only reads them, so setting one asks the operating system.
#include "util/environment.h"

#include <cstdlib>

namespace etendue
{
std::string environment(const std::string& name)
{
    const char* value = std::getenv(name.c_str());
    return value ? value : "";
}

void set_environment(const std::string& name, const std::string& value)
{
#ifdef _WIN32
    _putenv_s(name.c_str(), value.c_str());
#else
    setenv(name.c_str(), value.c_str(), 1);
#endif
}
} // namespace etendue
