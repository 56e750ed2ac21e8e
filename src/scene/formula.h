// The formulas of "expect" blocks, by muParser.
#pragma once

#include "scene/formula_text.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace etendue
{
// Named numbers, each worked out from a formula that may use the others in any order.
class Formulas
{
public:
    // Throws SceneError, at the formula's place, for what is no formula, for a name that nobody knows, for names that
    // are made of themselves, and for results that are not finite.
    explicit Formulas(const std::vector<std::pair<std::string, FormulaText>>& names);

    double evaluate(const FormulaText& formula) const;

private:
    std::map<std::string, double> values_;
};
} // namespace etendue
