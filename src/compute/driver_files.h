// What can be wrong with drivers before OpenCL is asked anything.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
// One sentence for each .icd file whose driver cannot be loaded: the OpenCL loader leaves those out without a word.
// Looks where the loader of Linux looks: OCL_ICD_VENDORS, OPENCL_VENDOR_PATH, else /etc/OpenCL/vendors.
std::vector<std::string> unloadable_drivers();

// PoCL shows no device when it cannot write its kernel cache ($POCL_CACHE_DIR, else $XDG_CACHE_HOME/pocl/kcache, else
// ~/.cache/pocl/kcache). In that case point it at a new temporary folder, removed at exit, and return the warning that
// says so; else return "". Call before PoCL is asked for its devices.
std::string ensure_pocl_cache();
} // namespace etendue
