// Studies whose truth is known because a generator of normal numbers made them.
#pragma once

#include "converge/analysis.h"
#include "converge/study.h"

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace etendue
{
struct SyntheticOptions {
    int width = 16, height = 16;
    std::uint64_t seeds = 8;
    int checkpoints = 9;            // at 1, 2, 4, ...
    double bias = 0.0;              // added to every pixel of every picture
    double spread = 0.5;            // standard deviation of one sample, relative to the pixel
    double reference_samples = 0.0; // 0: an analytic reference
    double seconds_per_sample = 1e-3;
};

inline double true_value(std::size_t pixel)
{
    return 1.0 + 0.5 * std::sin(0.37 * static_cast<double>(pixel));
}

class SyntheticScene
{
public:
    SyntheticScene(const SyntheticOptions& options, std::uint64_t seed) : options_(options), random_(seed) {}

    std::shared_ptr<const Reference> reference()
    {
        Reference reference;
        const bool exact = options_.reference_samples == 0.0;
        reference.kind = exact ? Reference::Kind::analytic : Reference::Kind::independent;
        reference.description = "synthetic";
        for (std::size_t i = 0; i < pixels(); ++i) {
            const double variance = exact ? 0.0 : sample_variance(i) / options_.reference_samples;
            reference.mean.push_back(Vec3(true_value(i)) + std::sqrt(variance) * normal3());
            reference.variance.push_back(Vec3(variance));
        }
        set_floor(reference);
        return std::make_shared<const Reference>(std::move(reference));
    }

    // Pictures of growing means of one row of samples.
    StudiedConfiguration run(const std::string& name, std::shared_ptr<const Reference> reference)
    {
        StudiedConfiguration studied;
        studied.prepared.configuration.name = name;
        studied.prepared.scene.file = "synthetic.json";
        studied.prepared.scene.film.width = options_.width;
        studied.prepared.scene.film.height = options_.height;
        DeviceInfo device;
        device.name = "Device, \"quoted\"";
        studied.prepared.options.devices = {device};
        studied.reference = std::move(reference);
        studied.cold.compile = 2.0;
        for (std::uint64_t s = 0; s < options_.seeds; ++s) add_run(studied, s + 1);
        return studied;
    }

private:
    std::size_t pixels() const { return static_cast<std::size_t>(options_.width * options_.height); }
    double sample_variance(std::size_t pixel) const { return std::pow(options_.spread * true_value(pixel), 2); }

    Vec3 normal3()
    {
        const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
        return {x, y, z};
    }

    void add_run(StudiedConfiguration& studied, std::uint64_t seed)
    {
        const double relative = relative_floor(*studied.reference, {});
        Run run;
        run.seed = seed;
        Pixels sum(pixels(), Vec3(0.0));
        double done = 0.0;
        for (int k = 0; k < options_.checkpoints; ++k) {
            const double samples = std::exp2(k);
            Snapshot snapshot;
            for (std::size_t i = 0; i < pixels(); ++i) {
                sum[i] += std::sqrt((samples - done) * sample_variance(i)) * normal3();
                snapshot.pixels.mean.push_back(Vec3(true_value(i) + options_.bias) + sum[i] / samples);
                snapshot.pixels.variance.push_back(Vec3(sample_variance(i) / samples));
            }
            done = samples;
            snapshot.checkpoint = static_cast<std::size_t>(k);
            snapshot.samples = static_cast<std::uint64_t>(samples);
            snapshot.render_seconds = snapshot.kernel_seconds = samples * options_.seconds_per_sample;
            snapshot.rays = snapshot.samples * pixels() * 3;
            snapshot.relative_error = options_.spread / std::sqrt(samples);
            run.rows.push_back(error_row(snapshot, *studied.reference, relative, {}));
            if (k + 1 < options_.checkpoints) continue;
            run.picture_mean = mean_of(snapshot.pixels.mean);
            run.picture_variance = variance_of_picture_mean(snapshot.pixels.variance);
            studied.pool.add(snapshot.pixels.mean);
        }
        run.measurement.complete = true;
        studied.runs.push_back(std::move(run));
    }

    SyntheticOptions options_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
};

inline Study synthetic_study(const SyntheticOptions& options, std::uint64_t seed)
{
    SyntheticScene scene(options, seed);
    Study study;
    study.options.draws = 200;
    study.options.seeds = options.seeds;
    study.options.delta = 0.05;
    study.configurations.push_back(scene.run("default", scene.reference()));
    return study;
}

inline ConfigurationAnalysis analysis_of(const SyntheticOptions& options, std::uint64_t seed)
{
    return analyse(synthetic_study(options, seed)).configurations.at(0);
}
} // namespace etendue
