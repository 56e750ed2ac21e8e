// The words for kinds and ranges.
#include "scene/table.h"

#include "util/suggestion.h"

#include <fmt/format.h>

#include <cmath>

namespace etendue
{
std::string number_text(double x)
{
    if (x == std::floor(x) && std::abs(x) < 1e9) return fmt::format("{:.0f}", x);
    return std::abs(x) < 1e9 ? fmt::format("{}", x) : fmt::format("{:.15g}", x);
}

std::string Range::text() const
{
    const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
    if (has_low && has_high && !low_open && !high_open)
        return "between " + number_text(low) + " and " + number_text(high);
    std::string text;
    if (has_low) text = (low_open ? "greater than " : "at least ") + number_text(low);
    if (has_low && has_high) text += " and ";
    if (has_high) text += (high_open ? "less than " : "at most ") + number_text(high);
    return text;
}

std::string Property::expectation() const
{
    const std::string limits = range.unlimited() ? "" : " " + range.text();
    const std::string each = range.unlimited() ? "" : ", each " + range.text();
    switch (kind) {
    case Kind::number:
        return "a number" + limits;
    case Kind::integer:
        return "an integer" + limits;
    case Kind::boolean:
        return "true or false";
    case Kind::string:
        return "a string";
    case Kind::name:
        return "one of the names " + list_names(names);
    case Kind::vector2:
        return "a list of 2 numbers" + each;
    case Kind::vector3:
        return "a list of 3 numbers" + each;
    case Kind::colour:
        return "a colour: [r, g, b] or one number" + each;
    case Kind::size2:
        return "a list of 2 integers" + each;
    case Kind::scale:
        return "a number or a list of 3 numbers" + each;
    case Kind::depth:
        return "an integer" + limits + " or \"unlimited\"";
    case Kind::matrix:
        return "16 numbers, row by row, or 4 rows of 4";
    case Kind::vectors3:
        return "a list of [x, y, z]" + each;
    case Kind::indices3:
        return "a list of [i, j, k], integers" + each;
    case Kind::strings:
        return "a list of strings";
    case Kind::formula:
        return "a number or a formula in quotes";
    case Kind::formulas:
        return "a number, a formula in quotes, or a list of 3 of them";
    case Kind::named_formulas:
        return "an object of numbers and formulas in quotes";
    case Kind::object:
        return table().name_alone ? "an object or one of the names " + list_names(table().variant_names())
                                  : "an object";
    case Kind::objects:
        return "a list of objects";
    case Kind::object_or_list:
        return "an object or a list of objects";
    }
    return "";
}

std::vector<std::string> Table::variant_names() const
{
    std::vector<std::string> names;
    for (const Variant& variant : variants) names.push_back(variant.name);
    return names;
}

std::vector<const Property*> Table::properties_of(std::size_t variant) const
{
    std::vector<const Property*> all;
    if (variant < variants.size())
        for (const Property& property : variants[variant].properties) all.push_back(&property);
    for (const Property& property : properties) all.push_back(&property);
    return all;
}
} // namespace etendue
