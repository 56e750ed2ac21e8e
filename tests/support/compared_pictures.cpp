// Gradients with noise.
#include "support/compared_pictures.h"

#include <random>

namespace etendue
{
Image noisy_picture(unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Image image;
    image.width = image.full_width = 48;
    image.height = image.full_height = 32;
    image.channels = {"R", "G", "B", "stderr.R", "stderr.G", "stderr.B", "samples.Y"};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double means[] = {0.2 + 0.01 * x, 0.5, 0.6 - 0.01 * y};
            for (const double mean : means)
                image.data.push_back(static_cast<float>(mean * (1 + 0.05 * normal(random))));
            for (const double mean : means) image.data.push_back(static_cast<float>(0.05 * mean));
            image.data.push_back(64.0f);
        }
    }
    return image;
}

Image without_errors(const Image& image)
{
    Image plain = image;
    plain.channels = {"R", "G", "B"};
    plain.data.clear();
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
        for (const char* const name : {"R", "G", "B"})
            plain.data.push_back(image.data[i * image.channels.size() + image.channel(name)]);
    return plain;
}

void brighten(Image& image, const PictureArea& area, float factor)
{
    const auto width = static_cast<std::size_t>(image.width);
    for (int y = area.y; y < area.y + area.height; ++y)
        for (int x = area.x; x < area.x + area.width; ++x)
            for (const char* const name : {"R", "G", "B"})
                image.data[(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) * image.channels.size() +
                           image.channel(name)] *= factor;
}
} // namespace etendue
