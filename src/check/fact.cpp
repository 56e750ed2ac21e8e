// From the text of a fact to numbers.
#include "check/fact.h"

namespace etendue
{
std::string Fact::subject() const
{
    static const char* const names[] = {"pixels", "mean", "relative-variance", "second-moment",
                                        "rays",   "same", "load-error",        "warning"};
    return names[static_cast<std::size_t>(text.subject)];
}

std::size_t Fact::statistical_tests() const
{
    using Subject = ExpectedFact::Subject;
    if (text.rule != ExpectedFact::Rule::stat) return 0;
    if (text.subject == Subject::mean) return value.size();
    return text.subject == Subject::same ? 3 : 0;
}

Fact make_fact(const ExpectedFact& text, const Formulas& formulas)
{
    Fact fact;
    fact.text = text;
    for (const FormulaText& value : text.value) fact.value.push_back(formulas.evaluate(value));
    if (text.other_value) fact.other = {formulas.evaluate(*text.other_value)};
    if (text.tolerance) fact.tolerance = formulas.evaluate(*text.tolerance);
    if (text.delta) fact.delta = formulas.evaluate(*text.delta);
    return fact;
}
} // namespace etendue
