// Runs a study: references, cold starts, then the configurations in turn.
#include "converge/study.h"

#include "render/replay.h"
#include "util/stopwatch.h"
#include "util/study_progress.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

namespace etendue
{
namespace
{
class Runner
{
public:
    Runner(const StudyOptions& options, Log& log)
        : log_(log), last_(options.checkpoints.values().back()), progress_(log, total_work(options))
    {
        study_.options = options;
    }

    Study run()
    {
        const Stopwatch watch;
        study_.before = machine_state();
        carry_out();
        study_.after = machine_state();
        study_.interrupted = study_.options.stop();
        study_.seconds = watch.seconds();
        progress_.finish(!study_.interrupted);
        return std::move(study_);
    }

private:
    bool is_samples() const { return study_.options.checkpoints.axis == Checkpoints::Axis::samples; }

    // In samples per pixel, or in seconds; the reference counts before it is known whether it is there already.
    static double total_work(const StudyOptions& options)
    {
        const double runs = static_cast<double>(options.seeds * options.configurations.size());
        const double last = options.checkpoints.values().back();
        const bool is_samples = options.checkpoints.axis == Checkpoints::Axis::samples;
        const bool rendered = options.reference == "auto";
        return runs * last + (rendered ? reference_work(options, last, is_samples) : 0.0);
    }

    static double reference_work(const StudyOptions& options, double last, bool is_samples)
    {
        const double work = last * static_cast<double>(REFERENCE_SAMPLES);
        return is_samples ? work : std::min(work, options.reference_seconds);
    }

    void carry_out()
    {
        const StudyOptions& options = study_.options;
        for (const Configuration& configuration : options.configurations) {
            StudiedConfiguration studied;
            studied.prepared = prepare(configuration, options.preparation);
            for (const std::string& warning : studied.prepared.warnings) warn(warning);
            study_.configurations.push_back(std::move(studied));
        }
        describe();
        check_bench();
        if (options.stop() || !find_references()) return;
        for (StudiedConfiguration& studied : study_.configurations) {
            if (options.stop()) return;
            studied.cold = measure_cold_start(studied.prepared);
        }
        progress_.forget_speed();
        // A,B,A,B: what the machine does meanwhile meets every configuration alike.
        for (std::uint64_t s = 0; s < options.seeds; ++s)
            for (StudiedConfiguration& studied : study_.configurations) {
                if (options.stop()) return set_missing_errors();
                render(studied, s);
            }
        set_missing_errors();
    }

    // On each device in each precision that a configuration uses.
    void check_bench()
    {
        std::set<std::string> checked;
        for (const StudiedConfiguration& studied : study_.configurations) {
            const RenderOptions& options = studied.prepared.options;
            std::string where = options.precision == Precision::fp64 ? "fp64" : "single";
            if (options.fast_math) where += ", fast math";
            for (const DeviceInfo& device : options.devices)
                where += fmt::format(", device {} ({})", device.index, device.name);
            if (!checked.insert(where).second) continue;
            for (SelfCheckResult result : run_self_check(options, study_.options.stop)) {
                result.name += " (" + where + ")";
                study_.self_check.push_back(result);
            }
        }
        if (!passed(study_.self_check)) warn("The bench does not measure the furnace's known error: see the report.");
    }

    void describe()
    {
        const Scene& scene = study_.configurations.front().prepared.scene;
        log_.info(fmt::format("{}: {}x{} pixels, {} configuration{}, {} seeds, checkpoints {}", scene.file,
                              scene.film.width, scene.film.height, study_.configurations.size(),
                              study_.configurations.size() == 1 ? "" : "s", study_.options.seeds,
                              study_.options.checkpoints.text()));
    }

    // One for all configurations that converge to the same picture. Whether it was not stopped.
    bool find_references()
    {
        std::map<std::string, std::vector<StudiedConfiguration*>> groups;
        for (StudiedConfiguration& studied : study_.configurations)
            groups[picture_key(studied.prepared)].push_back(&studied);
        for (auto& [key, group] : groups) {
            std::optional<Reference> found = reference_of(group);
            if (!found) return false;
            for (const std::string& warning : found->warnings) warn(warning);
            const auto reference = std::make_shared<const Reference>(std::move(*found));
            log_.info("reference: " + reference->description);
            for (StudiedConfiguration* studied : group) studied->reference = reference;
        }
        return true;
    }

    std::optional<Reference> reference_of(const std::vector<StudiedConfiguration*>& group)
    {
        const StudyOptions& options = study_.options;
        const Scene& scene = group.front()->prepared.scene;
        const FilmSize size{scene.film.width, scene.film.height};
        if (options.reference == "none") {
            Reference none;
            none.description = "none: errors are the spread between seeds, and no bias can be seen";
            return none;
        }
        if (options.reference == "auto" || options.reference == "analytic") {
            const bool mean_too = options.reference == "analytic";
            const auto radiance = expected_radiance(scene, mean_too);
            if (radiance && is_as_written(group.front()->prepared)) {
                if (mean_too && !expected_radiance(scene, false))
                    warn("The scene expects something of the mean only: the reference takes every pixel to be that.");
                return analytic_reference(*radiance, size.width, size.height,
                                          fmt::format("analytic: the scene expects the radiance {:.9g}, {:.9g}, {:.9g}",
                                                      radiance->x, radiance->y, radiance->z));
            }
            if (mean_too && radiance)
                throw UsageError(scene.file +
                                 ": what the scene expects is not for a picture changed by -D or --config, "
                                 "so there is no analytic reference.");
            if (mean_too)
                throw UsageError(scene.file + ": the scene does not say what its picture must be (no fact about pixels "
                                              "or mean in \"expect\"), so there is no analytic reference.");
            return rendered_reference(group);
        }
        return file_reference(options.reference, size, options.first_seed, options.seeds);
    }

    // Whether the picture is that of the scene without the changes of -D and of the configuration: only for that one
    // holds what the scene expects.
    bool is_as_written(const PreparedConfiguration& prepared) const
    {
        PreparationOptions options = study_.options.preparation;
        options.overrides.clear();
        options.size = FilmSize{prepared.scene.film.width, prepared.scene.film.height};
        Configuration unchanged;
        unchanged.name = "as written";
        return picture_key(prepare(unchanged, options)) == picture_key(prepared);
    }

    std::optional<Reference> rendered_reference(const std::vector<StudiedConfiguration*>& group)
    {
        IndependentOptions options;
        if (is_samples()) options.samples = static_cast<std::uint64_t>(last_) * REFERENCE_SAMPLES;
        options.seconds = study_.options.reference_seconds;
        const KernelCache standard = KernelCache::standard();
        if (standard.enabled()) options.folder = standard.folder() / "references";
        std::vector<IntegratorType> used;
        for (const StudiedConfiguration* studied : group) used.push_back(studied->prepared.scene.integrator.type);
        options.integrator = reference_integrator(used);
        if (std::find(used.begin(), used.end(), options.integrator) != used.end())
            warn("Every estimator is under study: the reference has other random numbers, but the estimator of one of "
                 "them.");
        options.stop = study_.options.stop;
        options.progress = [this](double fraction) { progress_.show(fraction); };
        progress_.begin("reference", reference_work(study_.options, last_, is_samples()));
        std::optional<Reference> reference = independent_reference(group.front()->prepared, options);
        progress_.end();
        return reference;
    }

    void render(StudiedConfiguration& studied, std::uint64_t number)
    {
        const StudyOptions& options = study_.options;
        const Reference& reference = *studied.reference;
        const bool is_blind = reference.kind == Reference::Kind::none;
        const double relative = relative_floor(reference, options.metric_settings);
        Run run;
        run.seed = options.first_seed + number;
        std::vector<Pixels> pictures;
        FilmPixels last;
        MeasurementOptions measurement;
        measurement.checkpoints = options.checkpoints;
        measurement.seed = run.seed;
        measurement.stop = options.stop;
        measurement.progress = [this](double fraction) { progress_.show(fraction); };
        measurement.look = [&](const Snapshot& snapshot) {
            run.rows.push_back(is_blind ? bare_row(snapshot)
                                        : error_row(snapshot, reference, relative, options.metric_settings));
            last = snapshot.pixels;
            if (is_blind) pictures.push_back(last.mean);
        };
        progress_.begin(fmt::format("run {} of {}: {}, seed {}", ++runs_begun_,
                                    options.seeds * study_.configurations.size(), studied.prepared.configuration.name,
                                    run.seed),
                        last_);
        run.measurement = measure(studied.prepared, measurement);
        progress_.end();
        if (run.rows.empty()) return;
        run.replay = replay_of(studied, run);
        run.picture_mean = mean_of(last.mean);
        run.picture_variance = variance_of_picture_mean(last.variance);
        if (run.measurement.complete) studied.pool.add(last.mean);
        pictures_[&studied].push_back(std::move(pictures));
        studied.runs.push_back(std::move(run));
    }

    // How to see the path of a run's first accident; its place where no command line says the configuration.
    std::string replay_of(const StudiedConfiguration& studied, const Run& run) const
    {
        const Scene& scene = studied.prepared.scene;
        const std::vector<std::string>& changes = studied.prepared.configuration.overrides;
        for (const HealthRecord& record : run.measurement.report.health) {
            if (!record.first) continue;
            const ReplaySample sample{record.first->x, record.first->y, record.first->sample};
            // Scenes of the course's format have no settings that -D could change.
            if (scene.course_format && !(changes.empty() && study_.options.preparation.overrides.empty()))
                return fmt::format("pixel {},{} sample {} of seed {}", sample.x, sample.y, sample.sample, run.seed);
            std::vector<std::string> options{
                "--size",   fmt::format("{}x{}", scene.film.width, scene.film.height),
                "--spp",    std::to_string(run.rows.back().samples),
                "--device", std::to_string(studied.prepared.options.devices.front().index)};
            if (studied.prepared.configuration.fast_math) options.emplace_back("--fast-math");
            for (const auto* list : {&study_.options.preparation.overrides, &changes})
                for (const std::string& change : *list) options.insert(options.end(), {"-D", change});
            return replay_command(scene.file, sample, run.seed, options);
        }
        return "";
    }

    void set_missing_errors()
    {
        for (StudiedConfiguration& studied : study_.configurations)
            if (studied.reference->kind == Reference::Kind::none)
                set_errors_between_seeds(studied.runs, pictures_[&studied], study_.options.metric_settings);
    }

    void warn(const std::string& text)
    {
        if (std::find(study_.warnings.begin(), study_.warnings.end(), text) != study_.warnings.end()) return;
        study_.warnings.push_back(text);
        log_.warning(text);
    }

    Log& log_;
    double last_;
    StudyProgress progress_;
    Study study_;
    std::uint64_t runs_begun_ = 0;
    std::map<const StudiedConfiguration*, std::vector<std::vector<Pixels>>> pictures_; // without a reference
};
} // namespace

Study run_study(const StudyOptions& options, Log& log)
{
    check_names(options.configurations);
    return Runner(options, log).run();
}
} // namespace etendue
