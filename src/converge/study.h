// A study of convergence: every configuration rendered with every seed, in turn, against a reference.
#pragma once

#include "converge/checkpoints.h"
#include "converge/errors.h"
#include "converge/reference.h"
#include "converge/self_check.h"
#include "util/log.h"
#include "util/machine.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace etendue
{
struct Target {
    std::string metric = "relmse"; // a name of error_names()
    double value = 1e-2;
};

struct StudyOptions {
    PreparationOptions preparation;
    std::vector<Configuration> configurations; // at least one
    Checkpoints checkpoints;
    std::uint64_t seeds = 8;
    std::uint64_t first_seed = 1;
    std::string reference = "auto"; // auto, analytic, none or a file
    double reference_seconds = 120.0;
    std::vector<Target> targets{{"relmse", 1e-1}, {"relmse", 1e-2}, {"relmse", 1e-3}};
    std::vector<std::string> metrics{"mse", "relmse"}; // in plots and tables; the first leads
    MetricSettings metric_settings;
    double family_alpha = 1e-3; // of all parts of all verdicts together
    double delta = 0.005;       // relative bias that must be seen
    std::size_t draws = 2000;   // of bootstraps
    std::string command;        // as the user gave it
    std::function<bool()> stop = [] { return false; };
};

struct StudiedConfiguration {
    PreparedConfiguration prepared;
    std::shared_ptr<const Reference> reference;
    StartSeconds cold;
    std::vector<Run> runs; // by seed; the last may have ended early
    PixelPool pool;        // of the last checkpoint, over the complete runs
};

struct Study {
    StudyOptions options;
    std::vector<StudiedConfiguration> configurations;
    std::vector<SelfCheckResult> self_check;
    MachineState before, after;
    double seconds = 0.0;
    bool interrupted = false;
    std::vector<std::string> warnings;
};

// Throws what its parts throw. When it is stopped it returns what is done: perhaps no run at all.
Study run_study(const StudyOptions& options, Log& log);
} // namespace etendue
