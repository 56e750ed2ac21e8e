// A picture in memory: named float channels, row by row from the top.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace etendue
{
struct Image {
    int width = 0;
    int height = 0;
    int x = 0, y = 0;                            // place of the top left pixel within the whole film (a crop)
    int full_width = 0, full_height = 0;         // of the whole film
    std::vector<std::string> channels;           // "R", "G", "B", "stderr.R", ...
    std::vector<float> data;                     // interleaved: (row * width + column) * channels.size() + channel
    std::map<std::string, std::string> metadata; // strings, written into the file where the format can hold them

    std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    // Index of a channel; throws Error (usage) naming the channels there are.
    std::size_t channel(const std::string& name) const;
    float at(int column, int row, std::size_t channel_index) const
    {
        return data[(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(column)) *
                        channels.size() +
                    channel_index];
    }
};
} // namespace etendue
