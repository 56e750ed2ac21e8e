// Reading one object of a scene file by its table: unknown and missing keys, wrong types and numbers out of range are
// errors with a place and what was expected.
#pragma once

#include "math/vector.h"
#include "scene/formula_text.h"
#include "scene/table.h"
#include "util/json.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace etendue
{
// What to do with a key that no table knows.
class UnknownKeys
{
public:
    static UnknownKeys fail() { return UnknownKeys(nullptr); }
    // Add its JSON path to the list.
    static UnknownKeys collect(std::vector<std::string>& paths) { return UnknownKeys(&paths); }

private:
    friend class Fields;
    explicit UnknownKeys(std::vector<std::string>* paths) : paths_(paths) {}
    std::vector<std::string>* paths_;
};

class Fields
{
public:
    // Throws SceneError unless `value` is an object that fits the table, or a name where a name alone will do.
    Fields(const json::Value& value, const Table& table, UnknownKeys unknown = UnknownKeys::fail());

    // Index of the variant that "type" names.
    std::size_t variant() const { return variant_; }

    bool has(const std::string& name) const { return value_.has(name); }
    // The value of a key that is there.
    json::Value at(const std::string& name) const { return value_[name]; }
    const json::Value& object() const { return value_; }

    // The value of a key, or its default. Throws SceneError when it is not what the table says.
    double number(const std::string& name) const;
    std::uint64_t integer(const std::string& name) const;
    bool boolean(const std::string& name) const;
    std::string string(const std::string& name) const; // OPTIONAL and not there: ""
    std::size_t name(const std::string& name) const;   // index into Property::names
    Vec2 vector2(const std::string& name) const;
    Vec3 vector3(const std::string& name) const;
    Vec3 colour(const std::string& name) const;
    Vec3 scale(const std::string& name) const;
    glm::u64vec2 size2(const std::string& name) const;
    std::optional<std::uint64_t> depth(const std::string& name) const; // empty: "unlimited"
    Mat4 matrix(const std::string& name) const;                        // column vectors
    std::vector<Vec3> vectors3(const std::string& name) const;         // empty when not there
    std::vector<glm::u32vec3> indices3(const std::string& name) const;
    std::vector<double> reals(const std::string& name) const;          // number: one; colour: three
    std::vector<std::string> strings(const std::string& name) const;   // empty when not there
    std::optional<FormulaText> formula(const std::string& name) const; // OPTIONAL and not there: empty
    std::vector<FormulaText> formulas(const std::string& name) const;  // one or three
    std::vector<std::pair<std::string, FormulaText>> named_formulas(const std::string& name) const;
    // The elements of a list of objects, or of one object; none when not there.
    std::vector<json::Value> objects(const std::string& name) const;

private:
    void find_variant();
    void check_keys(UnknownKeys unknown) const;
    const Property& property(const std::string& name) const;
    template<typename Read>
    auto read(const std::string& name, Read read_value) const;

    json::Value value_;
    const Table* table_;
    std::size_t variant_ = 0;
};
} // namespace etendue
