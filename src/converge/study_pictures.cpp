// Pictures by image_io, false colours by false_color.h.
#include "converge/study_pictures.h"

#include "converge/verdict.h"
#include "image/false_color.h"
#include "image/image_io.h"
#include "image/welch.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
class Writer
{
public:
    Writer(const StudiedConfiguration& studied, const std::string& folder)
        : studied_(studied), folder_(folder), film_(studied.prepared.scene.film)
    {
    }

    std::vector<StudyPicture> write()
    {
        const Pixels mean = studied_.pool.mean();
        const Image result = image_of(mean, studied_.pool.variance_of_mean(), film_.width, film_.height);
        write_image(result, path(".exr"));
        put("mean over the seeds", "", result, shown());
        const Reference& reference = *studied_.reference;
        if (reference.kind == Reference::Kind::none) return pictures_;
        const Image truth = image_of(reference.mean, reference.variance, film_.width, film_.height);
        write_image(truth, path("_reference.exr"));
        put("reference", "_reference", truth, shown());
        const double scale = error_scale(mean, reference.mean);
        put(fmt::format("signed error, full colour at {:.3g}", scale), "_error", signed_error(mean, scale), {});
        put("p-values of tiles", "_p_values", p_values(), {});
        return pictures_;
    }

private:
    WriteOptions shown() const { return {film_.tone_map, film_.exposure}; }
    std::string name(const std::string& suffix) const { return studied_.prepared.configuration.name + suffix; }
    std::string path(const std::string& suffix) const
    {
        return (std::filesystem::path(folder_) / name(suffix)).string();
    }

    void put(const std::string& caption, const std::string& suffix, const Image& image, const WriteOptions& options)
    {
        write_image(image, path(suffix + ".png"), options);
        pictures_.push_back({caption, name(suffix + ".png"), image.width, image.height});
    }

    // Three standard deviations of the errors.
    static double error_scale(const Pixels& mean, const Pixels& reference)
    {
        double squares = 0.0;
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const Vec3 error = mean[i] - reference[i];
            squares += glm::dot(error, error) / 3.0;
        }
        const double scale = 3.0 * std::sqrt(squares / static_cast<double>(mean.size()));
        return scale > 0.0 ? scale : 1.0;
    }

    Image signed_error(const Pixels& mean, double scale) const
    {
        return signed_error_image(image_of(mean, {}, film_.width, film_.height),
                                  image_of(studied_.reference->mean, {}, film_.width, film_.height), scale);
    }

    Image p_values() const
    {
        return p_value_image(compare_tiles(studied_.pool, *studied_.reference, film_.width, film_.height));
    }

    const StudiedConfiguration& studied_;
    std::string folder_;
    const FilmDescription& film_;
    std::vector<StudyPicture> pictures_;
};
} // namespace

std::vector<std::vector<StudyPicture>> write_pictures(const Study& study, const std::string& folder)
{
    std::vector<std::vector<StudyPicture>> pictures;
    for (const StudiedConfiguration& studied : study.configurations)
        pictures.push_back(studied.pool.count() > 0 ? Writer(studied, folder).write() : std::vector<StudyPicture>());
    return pictures;
}
} // namespace etendue
