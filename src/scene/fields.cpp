// Reading objects by their tables.
#include "scene/fields.h"

#include "util/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace etendue
{
namespace
{
[[noreturn]] void fail_kind(const json::Value& value, const Property& property)
{
    value.fail("must be " + property.expectation() + ", is " + value.description());
}

void check_range(const json::Value& value, double x, const Range& range)
{
    if (!range.contains(x)) value.fail("must be " + range.text() + ", is " + value.description());
}

double read_number(const json::Value& value, const Property& property)
{
    if (!value.is_number()) fail_kind(value, property);
    check_range(value, value.as_number(), property.range);
    return value.as_number();
}

std::uint64_t read_integer(const json::Value& value, const Property& property)
{
    const bool beyond_64_bits = value.is_number() && !value.raw().isUInt64() && value.as_number() >= 0x1p64;
    if (!value.is_number() || !(value.raw().isIntegral() || beyond_64_bits)) fail_kind(value, property);
    check_range(value, value.as_number(), property.range);
    if (beyond_64_bits) value.fail("must be at most 18446744073709551615, is " + value.description());
    return value.raw().asUInt64();
}

void check_list(const json::Value& value, std::size_t size, const Property& property)
{
    if (!value.is_array() || value.size() != size) fail_kind(value, property);
}

// A number inside a list: a wrong one is reported at its own place.
double read_element(const json::Value& list, std::size_t index, const Property& property)
{
    const Json::Value& raw = list.raw()[static_cast<Json::ArrayIndex>(index)];
    if (!raw.isNumeric()) list[index].fail("must be a number, is " + list[index].description());
    const double x = raw.asDouble();
    if (!property.range.contains(x)) check_range(list[index], x, property.range);
    return x;
}

Vec3 read_vector3(const json::Value& value, const Property& property)
{
    check_list(value, 3, property);
    return {read_element(value, 0, property), read_element(value, 1, property), read_element(value, 2, property)};
}

Vec3 read_number_or_vector3(const json::Value& value, const Property& property)
{
    if (value.is_number()) return Vec3(read_number(value, property));
    return read_vector3(value, property);
}

std::size_t find_name(const json::Value& value, const std::string& what, const std::vector<std::string>& names)
{
    const auto found = std::find(names.begin(), names.end(), value.as_string());
    if (found == names.end()) value.fail(unknown_name(what, value.as_string(), names));
    return static_cast<std::size_t>(found - names.begin());
}

FormulaText read_formula(const json::Value& value, const Property& property)
{
    if (!value.is_number() && !value.is_string()) fail_kind(value, property);
    return {value.is_number() ? fmt::format("{}", value.as_number()) : value.as_string(), value.location()};
}

Mat4 read_matrix(const json::Value& value, const Property& property)
{
    // Take 16 numbers, or 4 rows of 4.
    const bool flat = value.is_array() && value.size() == 16;
    if (!flat) check_list(value, 4, property);
    Mat4 matrix;
    for (std::size_t row = 0; row < 4; ++row) {
        if (!flat) check_list(value[row], 4, property);
        for (std::size_t column = 0; column < 4; ++column)
            matrix[static_cast<int>(column)][static_cast<int>(row)] =
                flat ? read_element(value, 4 * row + column, property) : read_element(value[row], column, property);
    }
    return matrix;
}
} // namespace

Fields::Fields(const json::Value& value, const Table& table, UnknownKeys unknown) : value_(value), table_(&table)
{
    if (!value.is_object() && !(table.name_alone && value.is_string())) {
        const std::string names = table.name_alone ? " or one of the names " + list_names(table.variant_names()) : "";
        value.fail("must be an object" + names + ", is " + value.description());
    }
    find_variant();
    check_keys(unknown);
}

void Fields::find_variant()
{
    if (table_->variants.empty()) return;
    const std::string what = table_->type_noun.empty() ? table_->name + " type" : table_->type_noun;
    if (value_.is_string()) {
        variant_ = find_name(value_, what, table_->variant_names());
    } else if (value_.has(table_->type_key)) {
        const json::Value type = value_[table_->type_key];
        if (!type.is_string())
            type.fail("must be one of the names " + list_names(table_->variant_names()) + ", is " + type.description());
        variant_ = find_name(type, what, table_->variant_names());
    } else if (table_->standard_type) {
        const std::vector<std::string> names = table_->variant_names();
        variant_ =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), table_->standard_type) - names.begin());
    } else {
        value_.fail(fmt::format("this {} needs the key \"{}\": one of {}", table_->name, table_->type_key,
                                list_names(table_->variant_names())));
    }
}

void Fields::check_keys(UnknownKeys unknown) const
{
    // Collect what this variant of the object may hold.
    std::vector<std::string> known;
    if (!table_->variants.empty()) known.push_back(table_->type_key);
    for (const Property* p : table_->properties_of(variant_)) known.push_back(p->name);

    const std::string type =
        table_->variants.empty() ? "" : fmt::format(" of {} ", table_->type_key) + table_->variants[variant_].name;
    for (const std::string& key : value_.keys()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        if (unknown.paths_) {
            unknown.paths_->push_back(value_[key].pointer());
            continue;
        }
        throw SceneError(value_.key_location(key), unknown_name(table_->name + " key", key, known));
    }
    for (const Property* p : table_->properties_of(variant_))
        if (p->standard == REQUIRED && !value_.has(p->name))
            value_.fail(
                fmt::format("this {}{} needs the key \"{}\": {}", table_->name, type, p->name, p->expectation()));
    if (table_->exactly_one && value_.keys().size() != 1)
        value_.fail(fmt::format("a {} has exactly one of the keys {}; this has {}", table_->name, list_names(known),
                                list_names(value_.keys())));
}

const Property& Fields::property(const std::string& name) const
{
    for (const Property* p : table_->properties_of(variant_))
        if (p->name == name) return *p;
    throw std::logic_error("the table of " + table_->name + " has no " + name);
}

// Call read_value(value, property) for the value in the file, or for the default of the table.
template<typename Read>
auto Fields::read(const std::string& name, Read read_value) const
{
    const Property& p = property(name);
    if (value_.has(name)) return read_value(value_[name], p);
    const json::Document standard(p.standard, "default of " + table_->name + "." + name);
    return read_value(standard.root(), p);
}

double Fields::number(const std::string& name) const
{
    return read(name, read_number);
}
std::uint64_t Fields::integer(const std::string& name) const
{
    return read(name, read_integer);
}
Vec3 Fields::vector3(const std::string& name) const
{
    return read(name, read_vector3);
}
Vec3 Fields::colour(const std::string& name) const
{
    return read(name, read_number_or_vector3);
}
Vec3 Fields::scale(const std::string& name) const
{
    return read(name, read_number_or_vector3);
}
Mat4 Fields::matrix(const std::string& name) const
{
    return read(name, read_matrix);
}

bool Fields::boolean(const std::string& name) const
{
    return read(name, [](const json::Value& value, const Property& p) {
        if (!value.is_boolean()) fail_kind(value, p);
        return value.as_boolean();
    });
}

std::string Fields::string(const std::string& name) const
{
    if (!has(name) && property(name).standard == std::string(OPTIONAL)) return "";
    return read(name, [](const json::Value& value, const Property& p) {
        if (!value.is_string()) fail_kind(value, p);
        return value.as_string();
    });
}

std::size_t Fields::name(const std::string& name) const
{
    return read(name, [](const json::Value& value, const Property& p) {
        if (!value.is_string()) fail_kind(value, p);
        return find_name(value, p.name, p.names);
    });
}

Vec2 Fields::vector2(const std::string& name) const
{
    return read(name, [](const json::Value& value, const Property& p) {
        check_list(value, 2, p);
        return Vec2(read_element(value, 0, p), read_element(value, 1, p));
    });
}

glm::u64vec2 Fields::size2(const std::string& name) const
{
    return read(name, [](const json::Value& value, const Property& p) {
        check_list(value, 2, p);
        Property element = p;
        element.kind = Kind::integer;
        return glm::u64vec2(read_integer(value[0], element), read_integer(value[1], element));
    });
}

std::optional<std::uint64_t> Fields::depth(const std::string& name) const
{
    return read(name, [](const json::Value& value, const Property& p) -> std::optional<std::uint64_t> {
        if (value.is_string() && value.as_string() == "unlimited") return std::nullopt;
        return read_integer(value, p);
    });
}

std::vector<Vec3> Fields::vectors3(const std::string& name) const
{
    std::vector<Vec3> vectors;
    if (!has(name)) return vectors;
    const json::Value list = at(name);
    const Property& p = property(name);
    if (!list.is_array()) fail_kind(list, p);
    Property element = p;
    element.kind = Kind::vector3;
    for (std::size_t i = 0; i < list.size(); ++i) vectors.push_back(read_vector3(list[i], element));
    return vectors;
}

std::vector<glm::u32vec3> Fields::indices3(const std::string& name) const
{
    std::vector<glm::u32vec3> triples;
    if (!has(name)) return triples;
    const json::Value list = at(name);
    const Property& p = property(name);
    if (!list.is_array()) fail_kind(list, p);
    Property element = p;
    element.kind = Kind::integer;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const json::Value triple = list[i];
        if (!triple.is_array() || triple.size() != 3)
            triple.fail("must be a list of 3 integers, is " + triple.description());
        glm::u32vec3 indices;
        for (int k = 0; k < 3; ++k)
            indices[k] = static_cast<std::uint32_t>(read_integer(triple[static_cast<std::size_t>(k)], element));
        triples.push_back(indices);
    }
    return triples;
}

std::vector<double> Fields::reals(const std::string& name) const
{
    if (property(name).kind == Kind::number) return {number(name)};
    const Vec3 c = colour(name);
    return {c.x, c.y, c.z};
}

std::vector<std::string> Fields::strings(const std::string& name) const
{
    std::vector<std::string> list;
    if (!has(name)) return list;
    const json::Value value = at(name);
    if (!value.is_array()) fail_kind(value, property(name));
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_string()) value[i].fail("must be a string, is " + value[i].description());
        list.push_back(value[i].as_string());
    }
    return list;
}

std::optional<FormulaText> Fields::formula(const std::string& name) const
{
    if (!has(name) && property(name).standard == std::string(OPTIONAL)) return {};
    return read(name, read_formula);
}

std::vector<FormulaText> Fields::formulas(const std::string& name) const
{
    return read(name, [](const json::Value& value, const Property& p) {
        if (!value.is_array()) return std::vector<FormulaText>{read_formula(value, p)};
        check_list(value, 3, p);
        Property element = p;
        element.kind = Kind::formula;
        std::vector<FormulaText> list;
        for (std::size_t i = 0; i < 3; ++i) list.push_back(read_formula(value[i], element));
        return list;
    });
}

std::vector<std::pair<std::string, FormulaText>> Fields::named_formulas(const std::string& name) const
{
    std::vector<std::pair<std::string, FormulaText>> list;
    if (!has(name)) return list;
    const json::Value value = at(name);
    if (!value.is_object()) fail_kind(value, property(name));
    Property element = property(name);
    element.kind = Kind::formula;
    for (const std::string& key : value.keys()) list.emplace_back(key, read_formula(value[key], element));
    return list;
}

std::vector<json::Value> Fields::objects(const std::string& name) const
{
    std::vector<json::Value> list;
    if (!has(name)) return list;
    const json::Value value = at(name);
    const Property& p = property(name);
    if (value.is_object() && p.kind == Kind::object_or_list) return {value};
    if (!value.is_array()) fail_kind(value, p);
    for (std::size_t i = 0; i < value.size(); ++i) list.push_back(value[i]);
    return list;
}
} // namespace etendue
