// What errors are measured against, and how far it is itself from the truth.
#pragma once

#include "converge/picture.h"
#include "converge/preparation.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace etendue
{
struct Reference {
    enum class Kind {
        none,       // nothing: only the spread between seeds is seen, a bias is not
        analytic,   // known exactly
        file,       // somebody's picture
        independent // rendered with random numbers of its own by another estimator
    };

    Kind kind = Kind::none;
    std::string description; // a sentence
    Pixels mean;
    Pixels variance;                                          // of each mean; zero where it is exact or unknown
    double degrees = std::numeric_limits<double>::infinity(); // of the variance of one pixel
    bool knows_error = true;                                  // of a file: its variance is there
    double floor = 0.0;                                       // mean variance: what every measured MSE has too much
    double floor_error = 0.0; // standard deviation of what stays when the floor is subtracted
    double skewness = 0.0;    // of a mean's noise, by replicates
    double replicate_ratio = std::numeric_limits<double>::quiet_NaN(); // floor by replicates over floor by the films
    std::uint64_t samples = 0;                                         // per pixel
    std::uint64_t wanted_samples = 0; // of an independent one; 0: as many as the time allows
    double seconds = 0.0;
    bool from_cache = false;
    std::vector<std::string> warnings;
};

// Fills floor and floor_error from the variance. The squared errors of the reference that there is differ from their
// mean: for a normal error e, Var e^2 = 2 (Var e)^2, which replicates know up to 1 + 1 / (R - 1); the channels of a
// pixel are taken to err together.
void set_floor(Reference& reference, double replicates = std::numeric_limits<double>::infinity());

// A picture of one radiance.
Reference analytic_reference(const Vec3& radiance, int width, int height, const std::string& description);

// The radiance that a scene's expectation names for every pixel (or, with `mean_too`, for their mean). Throws
// SceneError for a formula that is none.
std::optional<Vec3> expected_radiance(const Scene& scene, bool mean_too);

// A picture file; its variance from the channels stderr.R/G/B. Throws FileError, and UsageError where its size is not
// that of the film, a value or a standard error is not finite, or its random numbers are those of the study: seeds
// [first_seed, first_seed + seeds).
Reference file_reference(const std::string& path, const FilmSize& size, std::uint64_t first_seed, std::uint64_t seeds);

struct IndependentOptions {
    std::uint64_t samples = 0;    // per pixel, of all replicates together; 0: as many as fit into the time
    double seconds = 120.0;       // at most
    std::filesystem::path folder; // of references of earlier studies; "": none
    IntegratorType integrator = IntegratorType::light;
    std::function<bool()> stop = [] { return false; };
    std::function<void(double)> progress = [](double) {};
};

// Seeds of references have this bit: a domain of random numbers that no picture shares, whose seeds are below it.
constexpr std::uint64_t REFERENCE_SEEDS = std::uint64_t{1} << 63;
constexpr std::size_t REFERENCE_REPLICATES = 4;
// Samples of a reference for each sample of the last checkpoint.
constexpr std::uint64_t REFERENCE_SAMPLES = 16;

// An estimator that none of these uses: light, then path, then bsdf. All converge to the same picture, light without
// weighing strategies against each other. Where all are used, light.
IntegratorType reference_integrator(const std::vector<IntegratorType>& used);

// Render REFERENCE_REPLICATES pictures, or read what an earlier study left. Empty when it was stopped.
std::optional<Reference> independent_reference(const PreparedConfiguration& prepared,
                                               const IndependentOptions& options);
} // namespace etendue
