// Formulas by muParser.
#include "scene/formula.h"

#include "util/suggestion.h"

#include <muParser.h>

#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

namespace etendue
{
namespace
{
double round_to_float(double x)
{
    return static_cast<double>(static_cast<float>(x));
}

void prepare(mu::Parser& parser, const FormulaText& formula)
{
    parser.DefineFun("float", round_to_float);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("u", 0x1p-24);
    parser.SetExpr(formula.text);
}

[[noreturn]] void fail(const FormulaText& formula, const mu::ParserError& error)
{
    std::string message = error.GetMsg();
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    throw SceneError(formula.location, fmt::format("\"{}\" is not a formula: {}", formula.text, message));
}

// The names that a formula uses, constants apart.
std::set<std::string> used_names(const FormulaText& formula)
{
    try {
        mu::Parser parser;
        prepare(parser, formula);
        std::set<std::string> names;
        for (const auto& [name, address] : parser.GetUsedVar()) names.insert(name);
        return names;
    } catch (const mu::ParserError& error) {
        fail(formula, error);
    }
}

double evaluate_with(const FormulaText& formula, std::map<std::string, double> values)
{
    for (const std::string& name : used_names(formula)) {
        if (values.contains(name)) continue;
        std::vector<std::string> known{"pi", "u"};
        for (const auto& [other, value] : values) known.push_back(other);
        throw SceneError(formula.location, unknown_name("name in a formula", name, known));
    }
    double result = 0.0;
    int results = 1;
    try {
        mu::Parser parser;
        prepare(parser, formula);
        for (auto& [name, value] : values) parser.DefineVar(name, &value);
        result = parser.Eval();
        results = parser.GetNumResults();
    } catch (const mu::ParserError& error) {
        fail(formula, error);
    }
    if (results != 1)
        throw SceneError(formula.location, fmt::format("\"{}\" is {} numbers, not one (0.5 has a point, not a comma)",
                                                       formula.text, results));
    if (!std::isfinite(result))
        throw SceneError(formula.location, fmt::format("\"{}\" is {}, not a finite number", formula.text, result));
    return result;
}

// Works out every name after those it is made of.
class Resolver
{
public:
    explicit Resolver(const std::vector<std::pair<std::string, FormulaText>>& names)
        : formulas_(names.begin(), names.end())
    {
        for (const auto& [name, formula] : names) check_name(name, formula);
        for (const auto& [name, formula] : names) resolve(name, formula);
    }
    const std::map<std::string, double>& values() const { return values_; }

private:
    static void check_name(const std::string& name, const FormulaText& formula)
    {
        double value = 0.0;
        mu::Parser parser;
        try {
            prepare(parser, formula);
        } catch (const mu::ParserError& error) {
            fail(formula, error);
        }
        try {
            parser.DefineVar(name, &value);
        } catch (const mu::ParserError&) {
            throw SceneError(formula.location, fmt::format("\"{}\" cannot be a name in formulas", name));
        }
    }

    void resolve(const std::string& name, const FormulaText& formula)
    {
        if (values_.contains(name)) return;
        if (!begun_.insert(name).second)
            throw SceneError(formula.location, fmt::format("\"{}\" is made of itself", name));
        for (const std::string& other : used_names(formula))
            if (const auto found = formulas_.find(other); found != formulas_.end()) resolve(other, found->second);
        values_[name] = evaluate_with(formula, values_);
    }

    std::map<std::string, FormulaText> formulas_;
    std::map<std::string, double> values_;
    std::set<std::string> begun_;
};
} // namespace

Formulas::Formulas(const std::vector<std::pair<std::string, FormulaText>>& names) : values_(Resolver(names).values()) {}

double Formulas::evaluate(const FormulaText& formula) const
{
    return evaluate_with(formula, values_);
}
} // namespace etendue
