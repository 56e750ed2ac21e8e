// What an object of a scene file may hold, as data: the parser, its messages, the JSON Schema and the reference in
// scenes/FORMAT.md all come from these tables.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace etendue
{
enum class Kind {
    number,
    integer,
    boolean,
    string,
    name,           // one of Property::names
    vector2,        // [x, y]
    vector3,        // [x, y, z]
    colour,         // [r, g, b], or one number for all three
    size2,          // [width, height], integers
    scale,          // one number, or [x, y, z]
    depth,          // an integer, or "unlimited"
    matrix,         // 16 numbers row by row, or 4 rows of 4
    vectors3,       // a list of [x, y, z]
    indices3,       // a list of [i, j, k]
    strings,        // a list of strings
    formula,        // a number, or a formula in quotes
    formulas,       // one of them, or three for the channels
    named_formulas, // an object whose every value is one of them
    object,         // Property::table
    objects,        // a list of them
    object_or_list  // one of them, or a list
};

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;
    bool high_open = false;

    bool contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
    bool unlimited() const { return low == -high && low < -std::numeric_limits<double>::max(); }
    // "between 0 and 1", "at least 0", "greater than 0 and less than 180"; "" when unlimited.
    std::string text() const;
};

inline constexpr const char* REQUIRED = nullptr;
inline constexpr const char* OPTIONAL = "";

struct Table;

struct Property {
    std::string name;
    Kind kind = Kind::number;
    Range range = {};                // of each number
    const char* standard = OPTIONAL; // JSON text of the default, or REQUIRED, or OPTIONAL: may be left out
    std::string text = {};           // one phrase for the reference
    std::vector<std::string> names = {};
    const Table& (*table)() = nullptr;

    // "a number between 0 and 1", "a list of objects": completes "must be ...".
    std::string expectation() const;
};

// A value of the key "type" (or type_key), and what it adds to the object.
struct Variant {
    std::string name;
    std::string text;
    std::vector<Property> properties;
};

struct Table {
    std::string name; // "camera", "material": what messages and the schema call the object
    std::string text;
    std::vector<Property> properties;
    std::vector<Variant> variants = {};   // not empty: the object has a key that names one of them
    const char* standard_type = REQUIRED; // the name of the variant when there is no "type"
    bool name_alone = false;              // the name of the variant may stand for the whole object
    bool exactly_one = false;             // the object has exactly one of the properties
    std::string type_noun = {};           // what messages call the type, when not "<name> type"
    const char* type_key = "type";

    std::vector<std::string> variant_names() const;
    // Of one variant (by index; ignored when there are none): "type", its own properties and those of all.
    std::vector<const Property*> properties_of(std::size_t variant) const;
};

// A number for messages: 600, 0.5, 1e+15.
std::string number_text(double x);
} // namespace etendue
