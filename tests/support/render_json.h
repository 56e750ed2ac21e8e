// Renders a scene given as JSON on a device under test, and judges the mean of the picture.
#pragma once

#include "compute/device.h"
#include "render/film.h"
#include "render/render_report.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
struct JsonPicture {
    std::vector<PixelEstimate> pixels; // row by row
    int width = 0;
    RenderReport report;

    // Mean of all pixels, and its standard error from theirs.
    Vec3 mean() const;
    Vec3 standard_error() const;
    std::uint64_t samples() const; // of all pixels together
};

struct JsonPictureOptions {
    bool specialize = false; // the general kernel serves every scene, so that a test compiles once
    std::uint32_t lanes = 0;
};

// Render a scene in the native format. Overrides as for -D.
JsonPicture render_json(const Device& device, const std::string& json, const std::vector<std::string>& overrides = {},
                        JsonPictureOptions options = {});
JsonPicture render_json(const Device& device, const Scene& scene, JsonPictureOptions options = {});

// A test of a mean against its expected value, one of `tests` in the same run.
struct Verdict {
    double z = 0.0;          // (found - expected) / standard error
    double critical = 0.0;   // two-sided, alpha 1e-3 over the family after Sidak
    double detectable = 0.0; // smallest bias that would have been seen with 99 % power, relative to expected
    bool passed = false;     // |z| <= critical
    bool has_power = false;  // detectable <= wanted
    std::string text;        // for INFO
};
Verdict judge(double found, double standard_error, double expected, std::size_t tests, double wanted = 0.005);
} // namespace etendue
