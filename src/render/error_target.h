// Rendering until the picture is good enough: the film's relative error, how well it is known, and when to stop.
#pragma once

#include "render/film.h"
#include "render/renderer.h"
#include "scene/scene.h"

#include <cstdint>

namespace etendue
{
// The relative error of a film (Film::relative_error) and limits for the true error of its picture, which differs from
// the estimate because both are random: it is below `high`, and it is above `low`, each with the confidence asked for.
struct ErrorInterval {
    double relative_error = 0.0;
    double low = 0.0, high = 0.0;
    // Share of the squared error in the worst 0.1 % of the pixels. Where it is large, rare bright samples make the
    // error, and others may not have been met yet.
    double top_share = 0.0;

    bool heavy_tail() const { return top_share > 0.5; }
};

// `confidence` is between 0.5 and 1. All infinite while the film does not know its error.
ErrorInterval estimate_error(const Film& film, double confidence);

// Throws UsageError when the error of a picture of this scene and crop cannot be estimated well enough to stop by it.
void check_error_target(const Scene& scene, const PixelRect& crop);

// Decides after each pass whether to go on. Never stops on few samples (64 independent ones, else four blocks), nor on
// the estimate alone, nor on a single look: the upper limit must be below the target twice in a row.
class ErrorTarget
{
public:
    // `film` outlives the target.
    ErrorTarget(const Film& film, double wanted, double confidence);

    // For RenderLimits::after_pass.
    bool go_on(const PassEnd& end);

    struct Report {
        double wanted = 0.0, confidence = 0.0;
        bool reached = false;
        std::uint64_t looks = 0; // at the estimate
        ErrorInterval error;     // of the film as it is now
    };
    Report report() const;

private:
    const Film& film_;
    double wanted_, confidence_;
    std::uint64_t next_look_ = 0, looks_ = 0;
    bool was_below_ = false, reached_ = false;
};
} // namespace etendue
