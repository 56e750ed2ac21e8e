// Finding a channel of a picture by its name.
#include "image/image.h"

#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace etendue
{
std::size_t Image::channel(const std::string& name) const
{
    const auto found = std::find(channels.begin(), channels.end(), name);
    if (found != channels.end()) return static_cast<std::size_t>(found - channels.begin());
    throw UsageError(fmt::format("The image has no channel \"{}\"; there are: {}.", name, fmt::join(channels, ", ")));
}
} // namespace etendue
