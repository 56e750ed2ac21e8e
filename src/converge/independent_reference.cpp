// References by rendering: other random numbers, another estimator, several replicates.
#include "converge/reference.h"

#include "image/image_io.h"
#include "util/file.h"
#include "util/sha256.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace etendue
{
namespace fs = std::filesystem;
namespace
{
// More samples than a life is long, for references that only time ends.
constexpr std::uint64_t UNLIMITED_SAMPLES = std::uint64_t{1} << 40;
// A reference that time ended is used again where the time was about the same.
constexpr double SAME_TIME = 0.9;

const char* integrator_name(IntegratorType type)
{
    switch (type) {
    case IntegratorType::normals:
        return "normals";
    case IntegratorType::hemisphere:
        return "hemisphere";
    case IntegratorType::bsdf:
        return "bsdf";
    case IntegratorType::light:
        return "light";
    case IntegratorType::path:
        break;
    }
    return "path";
}

// Where a reference is kept: named by all that its picture depends on.
fs::path cache_file(const PreparedConfiguration& prepared, const IndependentOptions& options)
{
    if (options.folder.empty()) return {};
    const DeviceInfo& device = prepared.options.devices.front();
    return options.folder /
           (sha256(fmt::format("{} {} {} {}", picture_key(prepared), integrator_name(options.integrator), device.name,
                               device.driver_version)) +
            ".exr");
}

std::string describe(const IndependentOptions& options, const Reference& reference)
{
    return fmt::format("rendered by the integrator {} with independent samples of a key domain of its own, {} "
                       "replicates, {} samples per pixel together",
                       integrator_name(options.integrator), REFERENCE_REPLICATES, reference.samples);
}

// The mean of replicates with the variance that their films estimate, and what the replicates themselves say of it.
class ReplicateSum
{
public:
    void add(const Film& film)
    {
        const FilmPixels pixels = pixels_of(film);
        pool_.add(pixels.mean);
        variance_.resize(pixels.variance.size(), Vec3(0.0));
        for (std::size_t i = 0; i < variance_.size(); ++i) variance_[i] += pixels.variance[i];
        samples_ += film.min_samples();
    }

    Reference reference() const
    {
        Reference reference;
        reference.kind = Reference::Kind::independent;
        reference.mean = pool_.mean();
        reference.samples = samples_;
        const double n = static_cast<double>(pool_.count());
        reference.variance = pool_.variance_of_mean();
        reference.degrees = n - 1;
        reference.skewness = pool_.skewness_of_mean();
        set_floor(reference, n);
        const double by_replicates = reference.floor;
        // Of each pixel the films know more than the few replicates do.
        if (std::isfinite(variance_.front().x)) {
            for (std::size_t i = 0; i < variance_.size(); ++i) reference.variance[i] = variance_[i] / (n * n);
            reference.degrees = static_cast<double>(samples_) - n;
            reference.skewness = pool_.skewness_of_mean(reference.variance);
            set_floor(reference, n);
            reference.replicate_ratio = by_replicates / reference.floor;
            reference.floor = by_replicates;
        }
        return reference;
    }

private:
    PixelPool pool_;
    Pixels variance_;
    std::uint64_t samples_ = 0;
};

void store(const Reference& reference, const PreparedConfiguration& prepared, const fs::path& file)
{
    if (file.empty()) return;
    Image image = image_of(reference.mean, reference.variance, prepared.scene.film.width, prepared.scene.film.height);
    const auto put = [&](const char* name, double value) { image.metadata[name] = fmt::format("{:.17g}", value); };
    put("etendue:reference_samples", static_cast<double>(reference.samples));
    put("etendue:reference_seconds", reference.seconds);
    put("etendue:reference_degrees", reference.degrees);
    put("etendue:reference_floor", reference.floor);
    put("etendue:reference_skewness", reference.skewness);
    put("etendue:reference_ratio", reference.replicate_ratio);
    image.metadata["etendue:scene"] = prepared.scene.file;
    image.metadata["etendue:scene_sha256"] = prepared.scene.sha256;
    // A folder that cannot be written costs the next study time, not this one its result.
    try {
        std::error_code ignored;
        fs::create_directories(file.parent_path(), ignored);
        write_image(image, file.string());
    } catch (const Error&) {
    }
}

std::optional<Reference> stored(const fs::path& file, const IndependentOptions& options)
{
    std::error_code ignored;
    if (file.empty() || !fs::exists(file, ignored)) return {};
    try {
        const Image image = read_image(file.string());
        Reference reference = file_reference(file.string(), {image.width, image.height}, 0, 0);
        const auto get = [&](const char* name) {
            const auto found = image.metadata.find(name);
            return found == image.metadata.end() ? std::nan("") : std::strtod(found->second.c_str(), nullptr);
        };
        reference.kind = Reference::Kind::independent;
        const double samples = get("etendue:reference_samples");
        reference.seconds = get("etendue:reference_seconds");
        reference.degrees = get("etendue:reference_degrees");
        set_floor(reference, static_cast<double>(REFERENCE_REPLICATES));
        reference.floor = get("etendue:reference_floor");
        reference.replicate_ratio = get("etendue:reference_ratio");
        reference.skewness = get("etendue:reference_skewness");
        if (!(samples > 0.0 && reference.seconds >= 0.0 && reference.degrees > 0.0 && reference.floor >= 0.0 &&
              std::isfinite(reference.skewness)))
            return {};
        reference.samples = static_cast<std::uint64_t>(samples);
        const bool enough = options.samples > 0 && reference.samples >= options.samples;
        if (!enough && reference.seconds < SAME_TIME * options.seconds) return {};
        reference.from_cache = true;
        return reference;
    } catch (const Error&) {
        return {};
    }
}
} // namespace

IntegratorType reference_integrator(const std::vector<IntegratorType>& used)
{
    for (const IntegratorType type : {IntegratorType::light, IntegratorType::path, IntegratorType::bsdf})
        if (std::find(used.begin(), used.end(), type) == used.end()) return type;
    return IntegratorType::light;
}

std::optional<Reference> independent_reference(const PreparedConfiguration& prepared, const IndependentOptions& options)
{
    const fs::path file = cache_file(prepared, options);
    std::optional<Reference> reference = stored(file, options);
    if (!reference) {
        Scene scene = prepared.scene;
        scene.integrator.type = options.integrator;
        scene.sampler.type = SamplerType::independent;
        RenderOptions render_options = prepared.options;
        render_options.specialize = true;
        render_options.precision = Precision::single;
        render_options.fast_math = false;
        ReplicateSum sum;
        const Stopwatch watch;
        for (std::size_t r = 0; r < REFERENCE_REPLICATES; ++r) {
            scene.sampler.seed = REFERENCE_SEEDS | r;
            Renderer renderer(scene, prepared.geometry, false, render_options);
            renderer.warm_up();
            Film film(scene.film.width, scene.film.height, {0, 0, scene.film.width, scene.film.height}, false);
            RenderLimits limits;
            limits.samples_per_pixel = options.samples == 0
                                           ? UNLIMITED_SAMPLES
                                           : (options.samples + REFERENCE_REPLICATES - 1) / REFERENCE_REPLICATES;
            // The first pass has one sample, of which no variance is known.
            limits.samples_per_pixel = std::max<std::uint64_t>(limits.samples_per_pixel, 2);
            limits.seconds = options.seconds / static_cast<double>(REFERENCE_REPLICATES);
            limits.stop = options.stop;
            limits.progress = [&](const RenderProgress& now) {
                options.progress((static_cast<double>(r) + now.fraction) / static_cast<double>(REFERENCE_REPLICATES));
            };
            renderer.render(film, limits);
            if (renderer.report().interrupted) return {};
            sum.add(film);
            renderer.store_in_cache();
        }
        reference = sum.reference();
        reference->seconds = watch.seconds();
        store(*reference, prepared, file);
    }
    reference->wanted_samples = options.samples;
    reference->description = describe(options, *reference);
    if (reference->samples < options.samples)
        reference->warnings.push_back(fmt::format(
            "The reference has {} samples per pixel, not the {} that are {} times those of the last checkpoint: its "
            "time ended at {:.0f} s.",
            reference->samples, options.samples, REFERENCE_SAMPLES, options.seconds));
    return reference;
}
} // namespace etendue
