// What may be said of a picture from its samples. Every test knows the smallest bias that it would have seen, and fails
// when that is too large to mean anything; nothing assumes a least variance.
#pragma once

#include "support/reference_tracer.h"
#include "support/render_scene.h"

#include <cstddef>
#include <string>

namespace etendue
{
// Half the distance from 1 to the next float: rounding tolerances are multiples of it.
inline constexpr double UNIT_ROUNDOFF = 0x1p-24;

// One channel of all samples of a picture together.
struct Estimate {
    double mean = 0.0;
    double standard_error = 0.0; // of the mean; pixels that differ add nothing to it
    double variance = 0.0;       // of one sample of any pixel
    double largest = 0.0;        // share of the largest pixel in the sum of all
};
Estimate estimate_of(const Picture& picture, int channel);

// Every pixel within `roundings` roundings of a value: for estimators without variance.
void check_every_pixel(const Picture& picture, const Vec3& expected, double roundings);

// Tests of means for one subject. At its end it prints the smallest bias that every one of its tests would have seen.
class MeanTests
{
public:
    explicit MeanTests(std::string subject) : subject_(std::move(subject)) {}
    ~MeanTests();
    MeanTests(const MeanTests&) = delete;
    MeanTests& operator=(const MeanTests&) = delete;

    // Test that the mean is `expected`. Fails also when a relative bias of `smallest_bias` could pass, and when a
    // single pixel brings so much of the sum that the error is not known.
    void check(const Estimate& estimate, double expected, double smallest_bias = 0.005);
    // All three channels.
    void check(const Picture& picture, const Vec3& expected, double smallest_bias = 0.005);

    // Test that two pictures have the same mean in every channel, and in every tile of tile x tile pixels by Welch's
    // test, whose p-values must be uniform (Jung, Hanika, Dachsbacher 2020, JCGT 9(2)).
    void check_same(const Picture& a, const Picture& b, int tile, double smallest_bias = 0.005);

private:
    void check_difference(double difference, double standard_error, double expected, double smallest_bias);

    std::string subject_;
    std::size_t tests_ = 0;
    double weakest_ = 0.0;
};

// The reference tracer's result as a picture, with `batches` as the samples of each pixel.
Picture as_picture(const Scene& scene, const ReferencePicture& reference, const ReferenceOptions& options);
} // namespace etendue
