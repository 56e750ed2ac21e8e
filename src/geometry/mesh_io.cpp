// The choice of the reader.
#include "geometry/mesh_io.h"

#include "geometry/obj_reader.h"
#include "geometry/ply_reader.h"
#include "geometry/text_scanner.h"
#include "util/error.h"
#include "util/file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>

namespace etendue
{
namespace
{
// A mesh is read whole: a device or a pipe could go on for ever.
void refuse_special_file(const std::string& file)
{
    std::error_code error;
    if (std::filesystem::is_other(file, error)) throw FileError(file, "is a device or a pipe, not a mesh file.");
}

std::string lower_case_extension(const std::string& file)
{
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}
} // namespace

Mesh read_mesh(const std::string& file, const MeshReadOptions& options)
{
    refuse_special_file(file);
    const std::string bytes = read_file(file);
    if (options.bytes) *options.bytes += bytes.size();
    return parse_mesh(bytes, file, options.lenient);
}

Mesh parse_mesh(std::string_view bytes, const std::string& file, bool lenient)
{
    if (bytes.empty()) throw FileError(file, "is empty.");
    if (is_ply(bytes)) return triangulate(parse_ply(bytes, file), file, lenient);
    const std::string extension = lower_case_extension(file);
    if (extension == ".obj") return triangulate(parse_obj(bytes, file), file, lenient);
    if (extension == ".ply") throw FileError(file, "is no PLY file: its first line is not \"ply\".");
    throw FileError(file, fmt::format("mesh format {} is not known; there are: .obj, .ply.", quote(extension)));
}
} // namespace etendue
