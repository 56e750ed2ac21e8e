// Options and choices of `etendue check`.
#include "command/check_arguments.h"

#include "check/bsdf_checks.h"
#include "check/bvh_checks.h"
#include "check/device_checks.h"
#include "check/large_scene_checks.h"
#include "check/light_checks.h"
#include "check/not_covered.h"
#include "check/sampling_checks.h"
#include "check/scene_checks.h"
#include "check/twin_checks.h"
#include "command/render_arguments.h"
#include "util/suggestion.h"

#include <algorithm>
#include <filesystem>
#include <fnmatch.h>

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::vector<Check> stiff_scene_checks()
{
    return scene_checks(stiff_scenes());
}

// Every list of checks there is, and the groups that its checks belong to.
struct CheckList {
    std::vector<std::string> groups;
    std::vector<Check> (*checks)();
};

const std::vector<CheckList>& check_lists()
{
    static const std::vector<CheckList> lists{
        {{"analytic", "stiff"}, stiff_scene_checks},
        {{"analytic", "stiff"}, large_scene_checks},
        {{"bsdf"}, bsdf_checks},
        {{"sampling"}, sampling_checks},
        {{"sampling"}, light_checks},
        {{"bvh"}, bvh_checks},
        {{"device"}, device_checks},
        {{"device"}, twin_checks},
        {{"stiff"}, not_covered_checks},
    };
    return lists;
}

bool contains(const std::vector<std::string>& list, const std::string& name)
{
    return std::find(list.begin(), list.end(), name) != list.end();
}

// Without any group or scene everything is meant.
bool wants_group(const CheckArguments& arguments, const std::string& group)
{
    return arguments.what.empty() || contains(arguments.what, group) || contains(arguments.what, "all");
}

bool wants_name(const CheckArguments& arguments, const std::string& name)
{
    return arguments.only.empty() ||
           std::any_of(arguments.only.begin(), arguments.only.end(),
                       [&](const std::string& pattern) { return fnmatch(pattern.c_str(), name.c_str(), 0) == 0; });
}

void append(std::vector<Check>& checks, std::vector<Check> more)
{
    for (Check& check : more) checks.push_back(std::move(check));
}

// The scenes at a path. A single file runs whatever its tier: it was asked for by name.
std::vector<Check> checks_at(const std::string& path)
{
    std::vector<Check> checks = scene_checks(scenes_at(path));
    if (checks.empty())
        throw UsageError(path + ": nothing here has an \"expect\" block, so there is nothing to check.");
    if (!std::filesystem::is_directory(path)) checks.front().is_long = false;
    return checks;
}

// A group's name that is misspelt is no path.
void check_what(const std::string& what)
{
    const std::vector<std::string> groups = check_group_names();
    if (contains(groups, what) || std::filesystem::exists(what)) return;
    if (what.find_first_of("./") != std::string::npos) throw FileError(what, "there is no such file or folder.");
    std::string message = unknown_name("group of checks", what, groups);
    message.front() = 'U';
    throw UsageError(message + ". A scene file or a folder may stand there too.");
}

std::vector<Check> candidates(const CheckArguments& arguments)
{
    for (const std::string& what : arguments.what) check_what(what);
    std::vector<Check> checks;
    for (const CheckList& list : check_lists()) {
        const bool wanted = std::any_of(list.groups.begin(), list.groups.end(),
                                        [&](const std::string& group) { return wants_group(arguments, group); });
        if (!wanted) continue;
        for (Check& check : list.checks())
            if (wants_group(arguments, check.group)) checks.push_back(std::move(check));
    }
    const std::vector<std::string> groups = check_group_names();
    for (const std::string& what : arguments.what)
        if (!contains(groups, what)) append(checks, checks_at(what));
    return checks;
}
} // namespace

std::vector<std::string> check_group_names()
{
    std::vector<std::string> names;
    for (const CheckList& list : check_lists())
        for (const std::string& group : list.groups)
            if (!contains(names, group)) names.push_back(group);
    names.push_back("all");
    return names;
}

void add_check_options(CLI::App& command, CheckArguments& arguments)
{
    command.add_option("WHAT", arguments.what,
                       "Groups (" + list_names(check_group_names()) +
                           "), scene files with an \"expect\" block, and folders of them; without any: all");
    command.add_option("--only", arguments.only, "Only checks whose name matches the pattern, such as 'F1-*'")
        ->type_name("GLOB");
    command.add_flag("--long", arguments.is_long, "Also those that take long");
    command.add_flag("--list", arguments.list, "Say which checks there are and run none");
    command.add_option("--device", arguments.device, "Device, as for render; of several each runs every check")
        ->type_name("SPEC");
    add_lanes_option(command, arguments.lanes);
    command
        .add_option("--specialize", arguments.specialize,
                    "on: scenes run on kernels compiled for them alone; off: on the general kernel, compiled once")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
    command.add_option("--alpha", arguments.alpha, "Probability that any statistical test fails without a reason")
        ->check(CLI::Range(1e-12, 0.5))
        ->capture_default_str();
    command.add_option("--delta", arguments.delta, "Relative bias that every statistical test must be able to see")
        ->check(CLI::Range(1e-9, 1.0))
        ->capture_default_str();
    command
        .add_option("--seed", arguments.seed,
                    "fixed: the same numbers each time; fresh: new ones, and what fails is tried again with 16 "
                    "times the samples")
        ->check(CLI::IsMember({"fixed", "fresh"}))
        ->capture_default_str();
    command.add_option("--budget", arguments.budget, "Begin no check after so many seconds; then exit code 5")
        ->check(CLI::NonNegativeNumber)
        ->type_name("SECONDS");
    command.add_option("--json", arguments.json, "Write all results to this file")->type_name("FILE");
    command.add_flag("--no-cache", arguments.no_cache, "Compile kernels anew");
    command.add_flag("-q,--quiet", arguments.quiet, "Print only what is not passed, and the summary");
}

std::vector<Check> chosen_checks(const CheckArguments& arguments, std::size_t& left_out)
{
    left_out = 0;
    std::vector<Check> chosen;
    for (Check& check : candidates(arguments)) {
        if (!wants_name(arguments, check.name)) continue;
        if (check.is_long && !arguments.is_long)
            ++left_out;
        else
            chosen.push_back(std::move(check));
    }
    if (chosen.empty())
        throw UsageError(left_out > 0 ? fmt::format("All {} checks that fit take long: say --long.", left_out)
                                      : "No check fits; --list without --only says which there are.");
    return chosen;
}
} // namespace etendue
