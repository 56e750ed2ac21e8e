// Asks the dynamic linker for a library and lets it go again.
#include "util/shared_library.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace etendue
{
std::string load_failure(const std::string& library)
{
#ifdef _WIN32
    const HMODULE handle = LoadLibraryA(library.c_str());
    if (!handle) return "it cannot be loaded";
    FreeLibrary(handle);
#else
    void* const handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!handle) return dlerror();
    dlclose(handle);
#endif
    return "";
}
} // namespace etendue
