// A file that the build has put into the executable (scripts/embed_files).
#pragma once

#include <string>
#include <string_view>

namespace etendue
{
struct EmbeddedFile {
    std::string name; // relative to its folder, e.g. "bsdf/diffuse.h"
    std::string_view text;
};
} // namespace etendue
