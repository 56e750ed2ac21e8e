// References that need no rendering, and what all have in common.
#include "converge/reference.h"

#include "image/image_io.h"
#include "scene/formula.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string attribute(const Image& image, const std::string& name)
{
    const auto found = image.metadata.find(name);
    return found == image.metadata.end() ? "" : found->second;
}

bool has_channel(const Image& image, const std::string& name)
{
    return std::find(image.channels.begin(), image.channels.end(), name) != image.channels.end();
}

Pixels channels_of(const Image& image, const std::string& prefix)
{
    Pixels pixels;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto value = [&](const char* channel) {
                return static_cast<double>(image.at(x, y, image.channel(prefix + channel)));
            };
            pixels.emplace_back(value("R"), value("G"), value("B"));
        }
    return pixels;
}

bool contains_word(const std::string& words, const std::string& word)
{
    return (' ' + words + ' ').find(' ' + word + ' ') != std::string::npos;
}

void check_finite(const Pixels& pixels, int width, const std::string& path, const char* what)
{
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(pixels[i][c]))
                throw UsageError(fmt::format("The reference {} is of no use: its {} at pixel {},{} is {}.", path, what,
                                             i % static_cast<std::size_t>(width), i / static_cast<std::size_t>(width),
                                             pixels[i][c]));
}
} // namespace

void set_floor(Reference& reference, double replicates)
{
    const double values = 3.0 * static_cast<double>(reference.variance.size());
    double sum = 0.0, squares = 0.0;
    for (const Vec3& v : reference.variance) {
        const double of_pixel = v.x + v.y + v.z;
        sum += of_pixel;
        squares += of_pixel * of_pixel;
    }
    const double known = std::isfinite(replicates) ? replicates / (replicates - 1) : 1.0;
    reference.floor = sum / values;
    reference.floor_error = std::sqrt(2.0 * known * squares) / values;
}

Reference analytic_reference(const Vec3& radiance, int width, int height, const std::string& description)
{
    Reference reference;
    reference.kind = Reference::Kind::analytic;
    reference.description = description;
    reference.mean.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), radiance);
    reference.variance.assign(reference.mean.size(), Vec3(0.0));
    return reference;
}

std::optional<Vec3> expected_radiance(const Scene& scene, bool mean_too)
{
    if (!scene.expectation) return {};
    for (const ExpectedFact& fact : scene.expectation->facts) {
        const bool is_mean = mean_too && fact.subject == ExpectedFact::Subject::mean;
        const bool is_every_pixel = fact.subject == ExpectedFact::Subject::pixels && !fact.other_value;
        const bool is_value = fact.rule != ExpectedFact::Rule::bound && fact.rule != ExpectedFact::Rule::count;
        if (!is_value || !(is_every_pixel || is_mean)) continue;
        const Formulas formulas(scene.expectation->where);
        Vec3 radiance(0.0);
        for (std::size_t c = 0; c < 3; ++c)
            radiance[static_cast<int>(c)] = formulas.evaluate(fact.value[fact.value.size() == 1 ? 0 : c]);
        return radiance;
    }
    return {};
}

Reference file_reference(const std::string& path, const FilmSize& size, std::uint64_t first_seed, std::uint64_t seeds)
{
    const Image image = read_image(path);
    if (image.width != size.width || image.height != size.height)
        throw UsageError(fmt::format("The reference {} has {}x{} pixels, the study {}x{}: give --size {}x{}.", path,
                                     image.width, image.height, size.width, size.height, image.width, image.height));
    // A picture of one seed, or the mean over those of a study.
    const std::string seed = attribute(image, "etendue:seed"), study_seeds = attribute(image, "etendue:seeds");
    for (std::uint64_t s = first_seed; s < first_seed + seeds; ++s)
        if (seed == std::to_string(s) || contains_word(study_seeds, std::to_string(s)))
            throw UsageError(fmt::format("The reference {} was rendered with seed {}, which the study uses too: what "
                                         "shares random numbers looks better than it is. Choose another --seed.",
                                         path, s));
    Reference reference;
    reference.kind = Reference::Kind::file;
    reference.mean = channels_of(image, "");
    check_finite(reference.mean, size.width, path, "value");
    reference.variance.assign(reference.mean.size(), Vec3(0.0));
    if (has_channel(image, "stderr.R")) {
        reference.variance = channels_of(image, "stderr.");
        for (Vec3& v : reference.variance) v *= v;
        check_finite(reference.variance, size.width, path, "standard error");
        reference.description = fmt::format("the file {}, its variance by its channels stderr.R/G/B", path);
    } else {
        reference.knows_error = false;
        reference.description = fmt::format("the file {}, whose own error is not known", path);
        reference.warnings.push_back(
            fmt::format("{} has no channels stderr.R/G/B: its own error is taken for none and not subtracted.", path));
    }
    set_floor(reference);
    return reference;
}
} // namespace etendue
