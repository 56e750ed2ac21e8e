// Reading the "expect" block by its tables.
#include "scene/expectation_parser.h"

#include "scene/fields.h"

namespace etendue
{
namespace
{
using Rule = ExpectedFact::Rule;
using Subject = ExpectedFact::Subject;

const Range FRACTION{0, 1};

const std::vector<std::pair<std::string, Rule>> RULES{{"exact", Rule::exact},
                                                      {"round", Rule::round},
                                                      {"bound", Rule::bound},
                                                      {"count", Rule::count},
                                                      {"stat", Rule::stat}};

// The rules of a subject, its usual one first.
Property rule_property(std::vector<std::string> names, std::string text)
{
    static const std::vector<std::string> defaults{"\"exact\"", "\"round\"", "\"bound\"", "\"count\"", "\"stat\""};
    Property property{.name = "rule", .kind = Kind::name, .text = std::move(text), .names = std::move(names)};
    for (std::size_t i = 0; i < RULES.size(); ++i)
        if (RULES[i].first == property.names.front()) property.standard = defaults[i].c_str();
    return property;
}

Property formula_property(const char* name, const char* standard, const char* text)
{
    return {.name = name, .kind = Kind::formula, .standard = standard, .text = text};
}

Property value_property(const char* text)
{
    return {.name = "value", .kind = Kind::formulas, .standard = REQUIRED, .text = text};
}

Property delta_property()
{
    return formula_property(
        "delta", OPTIONAL,
        "the relative bias that the test must be able to see; without it that of --delta; above 0.005 there is "
        "a second check with up to 16 times the samples, NAME-finely, with --long");
}

Property overrides_property(const char* text)
{
    return {.name = "overrides", .kind = Kind::strings, .text = text};
}

std::vector<Variant> fact_variants()
{
    const std::string moment_rules = "stat: within the relative tolerance; bound: at most the value";
    const Property relative_tolerance = formula_property("tolerance", "0", "relative");
    return {
        {"pixels",
         "every pixel; with one sample per pixel: every sample",
         {rule_property({"round", "exact", "bound"}, "round: within the tolerance; exact: equal; bound: at most the "
                                                     "value, but for the tolerance, and not negative"),
          value_property("what each is"),
          formula_property("tolerance", "0", "roundings of 2^-24 of the value"),
          formula_property("or", OPTIONAL, "what a pixel may be instead, within the same tolerance"),
          {"or_share", Kind::vector2, FRACTION, "[0, 1]", "the least and the largest share of the pixels that are"}}},
        {"mean",
         "the mean of all pixels",
         {rule_property({"stat", "round", "bound"},
                        "stat: by Student's t at the level of all tests of the run; needs the independent sampler"),
          value_property("what it is, or is at most"),
          formula_property("tolerance", "16", "roundings of 2^-24 of the value that no error bar contains"),
          delta_property()}},
        {"relative_variance",
         "variance of one sample over the square of the mean",
         {rule_property({"stat", "bound"}, moment_rules), value_property("what it is"), relative_tolerance}},
        {"second_moment",
         "mean of the squares of samples",
         {rule_property({"stat", "bound"}, moment_rules), value_property("what it is"), relative_tolerance}},
        {"rays",
         "rays traced for each sample, shadow rays too",
         {rule_property({"count"}, "at least the value"), value_property("the fewest")}},
        {"same",
         "the picture is that of another scene, or of this one rendered otherwise",
         {rule_property({"exact", "count", "stat"},
                        "exact: equal bits; count: pixels within the tolerance; stat: equal means by Welch's t"),
          {.name = "scene", .kind = Kind::string, .text = "a file beside this one; without it this one"},
          overrides_property("path=value, applied to the other scene"),
          {"specialized", Kind::boolean, {}, "false", "the other is rendered by a kernel with its features only"},
          formula_property("tolerance", "0", "count: relative to the mean of the picture"),
          {"share", Kind::number, FRACTION, "1", "count: of the pixels that must be within it"},
          delta_property()}},
        {"load_error",
         "the scene, changed, does not load",
         {rule_property({"exact"}, "the message contains the text"),
          {.name = "text", .kind = Kind::string, .standard = REQUIRED, .text = "what the message contains"},
          overrides_property("path=value, which make it wrong")}},
        {"warning",
         "loading or rendering warns",
         {rule_property({"exact"}, "a warning contains the text"),
          {.name = "text", .kind = Kind::string, .standard = REQUIRED, .text = "what a warning contains"}}},
    };
}

Rule rule_of(const Fields& fields, std::size_t subject)
{
    for (const Property* property : fact_table().properties_of(subject)) {
        if (property->name != "rule") continue;
        const std::string& name = property->names[fields.name("rule")];
        for (const auto& [known, rule] : RULES)
            if (known == name) return rule;
    }
    return Rule::exact;
}

bool knows(std::size_t subject, const std::string& key)
{
    for (const Property* property : fact_table().properties_of(subject))
        if (property->name == key) return true;
    return false;
}

ExpectedFact parse_fact(const json::Value& value)
{
    const Fields fields(value, fact_table());
    const std::size_t subject = fields.variant();
    ExpectedFact fact;
    fact.location = value.location();
    fact.subject = static_cast<Subject>(subject);
    fact.rule = rule_of(fields, subject);
    if (knows(subject, "value")) fact.value = fields.formulas("value");
    if (knows(subject, "tolerance")) fact.tolerance = fields.formula("tolerance");
    if (knows(subject, "delta")) fact.delta = fields.formula("delta");
    if (knows(subject, "text")) fact.text = fields.string("text");
    if (knows(subject, "overrides")) fact.overrides = fields.strings("overrides");
    if (fact.subject == Subject::pixels) {
        fact.other_value = fields.formula("or");
        fact.other_share = fields.vector2("or_share");
    }
    if (fact.subject == Subject::same) {
        fact.scene = fields.string("scene");
        fact.specialized = fields.boolean("specialized");
        fact.share = fields.number("share");
        if (fact.scene.empty() && fact.overrides.empty() && !fact.specialized)
            throw SceneError(fact.location, "a picture is the same as itself: this fact needs \"scene\", \"overrides\" "
                                            "or \"specialized\"");
    }
    return fact;
}
} // namespace

const Table& expectation_table()
{
    static const Table table{
        "expectation",
        "What the picture must be. Formulas have + - * / ^, the names of \"where\", pi, u = 2^-24, the functions "
        "float (rounds to single precision), sqrt, abs, exp, ln, sin, cos, tan, asin, acos, atan, atan2, min, max.",
        {{"group", Kind::name, {}, "\"stiff\"", "what to call it by", {"analytic", "stiff"}},
         {"tier", Kind::name, {}, "\"quick\"", "long: only with --long", {"quick", "long"}},
         {.name = "because", .kind = Kind::string, .standard = REQUIRED, .text = "why, in a line"},
         {.name = "where",
          .kind = Kind::named_formulas,
          .text = "names for formulas, which may use each other in any order"},
         {"lenient", Kind::boolean, {}, "false", "load as --lenient does"},
         {.name = "facts",
          .kind = Kind::objects,
          .standard = REQUIRED,
          .text = "each is judged",
          .table = fact_table}}};
    return table;
}

const Table& fact_table()
{
    static const Table table = [] {
        Table t;
        t.name = "fact";
        t.text = "One thing that is so.";
        t.variants = fact_variants();
        t.type_noun = "subject";
        t.type_key = "subject";
        return t;
    }();
    return table;
}

Expectation parse_expectation(const json::Value& value)
{
    const Fields fields(value, expectation_table());
    Expectation expectation;
    expectation.location = value.location();
    expectation.group = static_cast<Expectation::Group>(fields.name("group"));
    expectation.is_long = fields.name("tier") == 1;
    expectation.because = fields.string("because");
    expectation.where = fields.named_formulas("where");
    expectation.lenient = fields.boolean("lenient");
    for (const json::Value& fact : fields.objects("facts")) expectation.facts.push_back(parse_fact(fact));
    if (expectation.facts.empty()) fields.at("facts").fail("must hold at least one fact");
    return expectation;
}
} // namespace etendue
