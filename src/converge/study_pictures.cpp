// Pictures by image_io, false colours by false_color.h.
#include "converge/study_pictures.h"

#include "converge/verdict.h"
#include "image/false_color.h"
#include "image/image_io.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr int SCALE_STEPS = 16;

Image film_image(const StudiedConfiguration& studied, const Pixels& mean, const Pixels& variance)
{
    const FilmDescription& film = studied.prepared.scene.film;
    return image_of(mean, variance, film.width, film.height);
}

HtmlPicture picture_of(const Image& image, const WriteOptions& options, const std::string& caption,
                       const std::string& description)
{
    return {caption, description, "image/png", png_bytes(image, options), image.width, image.height};
}

// Three standard deviations of the errors.
double error_scale(const Pixels& mean, const Pixels& reference)
{
    double squares = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const Vec3 error = mean[i] - reference[i];
        squares += glm::dot(error, error) / 3.0;
    }
    const double scale = 3.0 * std::sqrt(squares / static_cast<double>(mean.size()));
    return scale > 0.0 ? scale : 1.0;
}

HtmlPicture error_picture(const StudiedConfiguration& studied, const Pixels& mean)
{
    const Pixels& reference = studied.reference->mean;
    const double scale = error_scale(mean, reference);
    HtmlPicture picture =
        picture_of(signed_error_image(film_image(studied, mean, {}), film_image(studied, reference, {}), scale), {},
                   "Signed error, of the channel that is off most",
                   "Signed error: blue where the mean is darker than the reference, red where it is brighter");
    std::vector<std::string> colors;
    for (int i = 0; i <= SCALE_STEPS; ++i) colors.push_back(css_color(signed_error_color(2.0 * i / SCALE_STEPS - 1.0)));
    picture.note = html_scale(colors, fmt::format("−{:.3g}", scale), "0", fmt::format("+{:.3g}", scale));
    return picture;
}

HtmlPicture p_value_picture(const StudiedConfiguration& studied)
{
    const FilmDescription& film = studied.prepared.scene.film;
    const WelchTiles tiles = compare_tiles(studied.pool, *studied.reference, film.width, film.height);
    HtmlPicture picture = picture_of(p_value_image(tiles), {}, "p-values: the least of three channels in each tile",
                                     "p-values of tiles: light where the difference is more than noise explains");
    std::vector<std::string> colors;
    for (int i = 0; i <= SCALE_STEPS; ++i)
        colors.push_back(css_color(p_value_color(std::pow(10.0, -6.0 * i / SCALE_STEPS))));
    picture.note = html_scale(colors, "p = 1", "0.001", "10⁻⁶ and less");
    return picture;
}
} // namespace

std::vector<HtmlPicture> study_pictures(const StudiedConfiguration& studied)
{
    if (studied.pool.count() == 0) return {};
    const FilmDescription& film = studied.prepared.scene.film;
    const WriteOptions shown{film.tone_map, film.exposure};
    const Pixels mean = studied.pool.mean();
    std::vector<HtmlPicture> pictures;
    pictures.push_back(picture_of(film_image(studied, mean, {}), shown,
                                  fmt::format("Mean over {} seeds", studied.pool.count()), "The mean over the seeds"));
    if (studied.reference->kind == Reference::Kind::none) return pictures;
    pictures.push_back(
        picture_of(film_image(studied, studied.reference->mean, {}), shown, "Reference", "The reference"));
    pictures.push_back(error_picture(studied, mean));
    if (studied.pool.count() > 1) pictures.push_back(p_value_picture(studied));
    return pictures;
}

namespace
{
// For those who take the mean for a reference: "1 2 3".
std::string seeds_text(const Study& study)
{
    std::string text;
    for (std::uint64_t s = 0; s < study.options.seeds; ++s)
        text += (s == 0 ? "" : " ") + std::to_string(study.options.first_seed + s);
    return text;
}
} // namespace

void write_study_images(const Study& study, const std::string& folder)
{
    for (const StudiedConfiguration& studied : study.configurations) {
        const std::string stem = (std::filesystem::path(folder) / studied.prepared.configuration.name).string();
        if (studied.pool.count() > 0) {
            Image mean = film_image(studied, studied.pool.mean(), studied.pool.variance_of_mean());
            mean.metadata["etendue:seeds"] = seeds_text(study);
            write_image(mean, stem + ".exr");
        }
        if (studied.reference && studied.reference->kind != Reference::Kind::none)
            write_image(film_image(studied, studied.reference->mean, studied.reference->variance),
                        stem + "_reference.exr");
    }
}
} // namespace etendue
