// Running a scene and judging what it says of itself.
#include "check/scene_checks.h"

#include "check/check_picture.h"
#include "check/fact.h"
#include "geometry/geometry.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace etendue
{
namespace
{
using Subject = ExpectedFact::Subject;

// Times the samples of a scene: a quarter of its error.
constexpr double MOST_FINE_EFFORT = 16.0;

struct SceneFacts {
    SceneSource source;
    LoadedScene loaded;
    std::vector<Fact> facts;
    std::vector<std::string> names; // of the results

    const Expectation& expectation() const { return *loaded.scene.expectation; }
};

const char* group_name(Expectation::Group group)
{
    return group == Expectation::Group::analytic ? "analytic" : "stiff";
}

// The scene's name for its first fact, and with what makes them unique for the others.
std::vector<std::string> result_names(const std::string& scene, const std::vector<Fact>& facts)
{
    std::vector<std::string> names;
    std::map<std::string, int> used;
    for (const Fact& fact : facts) {
        const int number = ++used[fact.subject()];
        std::string name = scene;
        if (!names.empty()) name += "/" + fact.subject() + (number > 1 ? "-" + std::to_string(number) : "");
        names.push_back(name);
    }
    return names;
}

// A fact of a scene's only picture needs it; the others load and render their own.
bool needs_picture(const Fact& fact)
{
    return fact.text.subject != Subject::load_error;
}

std::vector<std::string> loading_errors(const SceneFacts& scene, const Fact& fact)
{
    try {
        const LoadedScene loaded = scene.source.load(fact.text.overrides);
        make_geometry(loaded.scene, {scene.expectation().lenient});
        return {};
    } catch (const Error& error) {
        return {error.what()};
    }
}

CheckPicture other_picture(const CheckContext& context, const SceneFacts& scene, const Fact& fact)
{
    const SceneSource source = fact.text.scene.empty() ? scene.source : scene.source.neighbour(fact.text.scene);
    const LoadedScene loaded = source.load(fact.text.overrides);
    const bool lenient = loaded.scene.expectation ? loaded.scene.expectation->lenient : scene.expectation().lenient;
    return check_picture(context, loaded, {lenient, fact.text.specialized, fact.text.overrides});
}

void judge_fact(CheckResult& result, const Fact& fact, const SceneFacts& scene, const CheckPicture& picture,
                const CheckContext& context)
{
    switch (fact.text.subject) {
    case Subject::pixels:
        return judge_pixels(result, fact, picture);
    case Subject::mean:
        return judge_mean(result, fact, picture, context);
    case Subject::relative_variance:
    case Subject::second_moment:
        return judge_moment(result, fact, picture);
    case Subject::rays:
        return judge_rays(result, fact, picture);
    case Subject::same: {
        const CheckPicture other = other_picture(context, scene, fact);
        judge_same(result, fact, picture, other, context);
        if (!other.accident.empty()) {
            result.verdict = Verdict::failed;
            result.note = "the other picture: " + other.accident;
        }
        return;
    }
    case Subject::load_error:
        return judge_message(result, fact, loading_errors(scene, fact));
    case Subject::warning:
        return judge_message(result, fact, picture.warnings);
    }
}

std::vector<CheckResult> run_scene(const SceneFacts& scene, const CheckContext& context)
{
    Stopwatch watch;
    CheckPicture picture;
    for (const Fact& fact : scene.facts) {
        if (!needs_picture(fact)) continue;
        picture = check_picture(context, scene.loaded, {scene.expectation().lenient, false});
        break;
    }
    std::vector<CheckResult> results;
    for (std::size_t i = 0; i < scene.facts.size(); ++i) {
        const Fact& fact = scene.facts[i];
        CheckResult result;
        result.group = group_name(scene.expectation().group);
        result.name = scene.names[i];
        result.rule = fact.rule();
        judge_fact(result, fact, scene, picture, context);
        if (needs_picture(fact) && !picture.accident.empty()) {
            result.verdict = Verdict::failed;
            result.note = picture.accident;
        }
        result.seconds = watch.restart();
        results.push_back(result);
    }
    return results;
}

std::vector<CheckResult> run_scene_finely(SceneFacts scene, CheckContext context)
{
    double widest = context.delta;
    for (const Fact& fact : scene.facts) widest = std::max(widest, *fact.delta);
    // The error falls with the root of the number of samples.
    const double effort = std::min(std::ceil(std::pow(widest / context.delta, 2.0)), MOST_FINE_EFFORT);
    context.effort *= effort;
    for (Fact& fact : scene.facts) fact.delta = std::max(context.delta, *fact.delta / std::sqrt(effort));
    return run_scene(scene, context);
}

// The errors of Sobol's and stratified samples are known to a few degrees of freedom only, which no fact of the film's
// variance allows for.
void refuse_unknown_errors(const SceneFacts& scene)
{
    const bool is_statistical = std::any_of(scene.facts.begin(), scene.facts.end(), [](const Fact& fact) {
        return fact.statistical_tests() > 0 || fact.text.subject == Subject::relative_variance ||
               fact.text.subject == Subject::second_moment;
    });
    if (is_statistical && scene.loaded.scene.sampler.type != SamplerType::independent)
        throw SceneError(scene.source.file + ": a fact with the rule \"stat\", or about variance or moments, needs "
                                             "independent samples: \"sampler\": {\"type\": \"independent\"}.");
}

// Nothing where the scene expects nothing.
std::optional<SceneFacts> load_facts(const SceneSource& source)
{
    SceneFacts scene{source, source.load(), {}, {}};
    if (!scene.loaded.scene.expectation) return {};
    const Formulas formulas(scene.expectation().where);
    for (const ExpectedFact& text : scene.expectation().facts) scene.facts.push_back(make_fact(text, formulas));
    refuse_unknown_errors(scene);
    return scene;
}

// A check of these facts that has yet to be told how it runs.
Check check_of(SceneFacts& scene, const std::string& name)
{
    Check check;
    check.group = group_name(scene.expectation().group);
    check.name = name;
    for (const Fact& fact : scene.facts) check.statistical_tests += fact.statistical_tests();
    scene.names = result_names(name, scene.facts);
    return check;
}

Check plain_check(SceneFacts scene)
{
    Check check = check_of(scene, scene.source.name);
    check.is_long = scene.expectation().is_long;
    check.run = [scene = std::move(scene)](const CheckContext& context) { return run_scene(scene, context); };
    return check;
}

// Of the facts that are content with less power than others, if there are any.
std::optional<Check> fine_check(SceneFacts scene)
{
    std::erase_if(scene.facts, [](const Fact& fact) { return fact.delta.value_or(0.0) <= DEFAULT_DELTA; });
    if (scene.facts.empty()) return {};
    Check check = check_of(scene, scene.source.name + "-finely");
    check.is_long = true;
    check.run = [scene = std::move(scene)](const CheckContext& context) { return run_scene_finely(scene, context); };
    return check;
}
} // namespace

std::optional<Check> scene_check(const SceneSource& source)
{
    std::optional<SceneFacts> scene = load_facts(source);
    if (!scene) return {};
    return plain_check(std::move(*scene));
}

std::vector<Check> scene_checks(const std::vector<SceneSource>& sources)
{
    std::vector<Check> checks;
    for (const SceneSource& source : sources) {
        const std::optional<SceneFacts> scene = load_facts(source);
        if (!scene) continue;
        checks.push_back(plain_check(*scene));
        if (std::optional<Check> check = fine_check(*scene)) checks.push_back(std::move(*check));
    }
    return checks;
}
} // namespace etendue
