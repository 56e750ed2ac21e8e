// Files in one folder, each whole or not there.
#include "converge/study_files.h"

#include "converge/converge_json.h"
#include "converge/converge_plots.h"
#include "converge/converge_report.h"
#include "converge/errors_csv.h"
#include "converge/study_pictures.h"
#include "image/plot.h"
#include "util/file.h"

#include <filesystem>

namespace etendue
{
void make_study_folder(const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder)) throw FileError(folder, "the folder cannot be made.");
    check_writable((std::filesystem::path(folder) / "report.html").string());
}

void write_study(const Study& study, const Analysis& analysis, const std::string& folder)
{
    const auto path = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
    write_file(path("errors.csv"), errors_csv(study));
    write_file(path("converge.json"), converge_json(study, analysis));
    const std::string& metric = study.options.metrics.front();
    const std::string render = convergence_svg(study, analysis, metric, TimeAxis::render);
    const std::string total = convergence_svg(study, analysis, metric, TimeAxis::total);
    write_file(path("converge.svg"), render);
    write_file(path("converge.png"), svg_png(render));
    write_file(path("converge_total.svg"), total);
    write_file(path("converge_total.png"), svg_png(total));
    write_study_images(study, folder);
    write_file(path("report.html"), converge_report(study, analysis));
}
} // namespace etendue
