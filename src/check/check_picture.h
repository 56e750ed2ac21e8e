// The picture of a scene as a check sees it: pixels with their errors, and everything that went wrong on the way.
#pragma once

#include "check/check.h"
#include "render/film.h"
#include "render/render_report.h"
#include "scene/scene_loader.h"

#include <string>
#include <vector>

namespace etendue
{
struct CheckPicture {
    int width = 0, height = 0;
    std::vector<PixelEstimate> pixels; // row by row
    RenderReport report;
    std::vector<std::string> warnings; // of loading and rendering
    std::string accident;              // empty, or what a health counter says: the picture is worth nothing then
};

struct PictureChoice {
    bool lenient = false;
    bool other_kernel = false; // specialised where the context asks for the general kernel, and the other way round
    std::vector<std::string> overrides = {}; // with which the scene was loaded
};

// Load and render with the samples and the seed of the scene, changed as the context says. Throws what loading and
// rendering throw.
CheckPicture check_picture(const CheckContext& context, const LoadedScene& loaded, const PictureChoice& choice);

// One channel of all samples of a picture together.
struct ChannelEstimate {
    double mean = 0.0;
    double standard_error = 0.0; // of the mean; pixels that differ add nothing to it
    double degrees = 0.0;        // of freedom of that error
    double variance = 0.0;       // of one sample of any pixel
    double variance_error = 0.0; // its standard error, where every pixel has the same distribution; else unknown
    double largest_share = 0.0;  // of the largest pixel in the sum of all: no sample has more
};
ChannelEstimate estimate_channel(const CheckPicture& picture, int channel);
} // namespace etendue
