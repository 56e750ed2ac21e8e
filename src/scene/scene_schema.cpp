// JSON Schema from the tables of the scene format.
#include "scene/scene_schema.h"

#include "scene/scene_tables.h"

#include <json/reader.h>
#include <json/writer.h>

#include <cmath>
#include <memory>

namespace etendue
{
namespace
{
Json::Value reference(const Table& table)
{
    Json::Value schema;
    schema["$ref"] = "#/$defs/" + table.name;
    return schema;
}

Json::Value one_of(const Json::Value& a, const Json::Value& b)
{
    Json::Value schema;
    schema["anyOf"].append(a);
    schema["anyOf"].append(b);
    return schema;
}

Json::Value list_of(const Json::Value& items, int count = -1)
{
    Json::Value schema;
    schema["type"] = "array";
    schema["items"] = items;
    if (count >= 0) schema["minItems"] = schema["maxItems"] = count;
    return schema;
}

Json::Value names(const std::vector<std::string>& list)
{
    Json::Value schema;
    schema["enum"] = Json::arrayValue;
    for (const std::string& name : list) schema["enum"].append(name);
    return schema;
}

// Whole numbers are written without a fraction.
Json::Value json_number(double x)
{
    if (x == std::floor(x) && std::abs(x) < 1e18) return Json::Value(static_cast<Json::Int64>(x));
    return Json::Value(x);
}

Json::Value number(const char* type, const Range& range)
{
    Json::Value schema;
    schema["type"] = type;
    if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = json_number(range.low);
    if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = json_number(range.high);
    return schema;
}

Json::Value formula_schema()
{
    Json::Value schema;
    schema["type"].append("number");
    schema["type"].append("string");
    return schema;
}

Json::Value kind_schema(const Property& p)
{
    const Json::Value real = number("number", p.range), integer = number("integer", p.range);
    Json::Value plain;
    switch (p.kind) {
    case Kind::number:
        return real;
    case Kind::integer:
        return integer;
    case Kind::boolean:
        plain["type"] = "boolean";
        return plain;
    case Kind::string:
        plain["type"] = "string";
        return plain;
    case Kind::name:
        return names(p.names);
    case Kind::vector2:
        return list_of(real, 2);
    case Kind::vector3:
        return list_of(real, 3);
    case Kind::colour:
    case Kind::scale:
        return one_of(real, list_of(real, 3));
    case Kind::size2:
        return list_of(integer, 2);
    case Kind::depth:
        return one_of(integer, names({"unlimited"}));
    case Kind::matrix:
        return one_of(list_of(real, 16), list_of(list_of(real, 4), 4));
    case Kind::vectors3:
        return list_of(list_of(real, 3));
    case Kind::indices3:
        return list_of(list_of(integer, 3));
    case Kind::strings:
        plain["type"] = "string";
        return list_of(plain);
    case Kind::formula:
        return formula_schema();
    case Kind::formulas:
        return one_of(formula_schema(), list_of(formula_schema(), 3));
    case Kind::named_formulas:
        plain["type"] = "object";
        plain["additionalProperties"] = formula_schema();
        return plain;
    case Kind::object:
        return reference(p.table());
    case Kind::objects:
        return list_of(reference(p.table()));
    case Kind::object_or_list:
        return one_of(reference(p.table()), list_of(reference(p.table())));
    }
    return plain;
}

Json::Value parse_default(const std::string& text)
{
    Json::Value value;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    reader->parse(text.data(), text.data() + text.size(), &value, nullptr);
    return value;
}

Json::Value property_schema(const Property& p)
{
    Json::Value schema = kind_schema(p);
    if (!p.text.empty()) schema["description"] = p.text;
    if (p.standard != REQUIRED && p.standard != std::string(OPTIONAL)) schema["default"] = parse_default(p.standard);
    return schema;
}

// The object with the keys of one variant, and no others.
Json::Value object_schema(const Table& table, std::size_t variant)
{
    Json::Value schema;
    schema["type"] = "object";
    schema["additionalProperties"] = false;
    schema["properties"] = Json::objectValue;
    if (!table.variants.empty()) {
        schema["description"] = table.variants[variant].text;
        schema["properties"][table.type_key]["const"] = table.variants[variant].name;
        const bool is_standard = table.standard_type && table.variants[variant].name == table.standard_type;
        if (!is_standard) schema["required"].append(table.type_key);
    }
    for (const Property* p : table.properties_of(variant)) {
        schema["properties"][p->name] = property_schema(*p);
        if (p->standard == REQUIRED) schema["required"].append(p->name);
    }
    if (table.exactly_one) schema["minProperties"] = schema["maxProperties"] = 1;
    return schema;
}

Json::Value table_schema(const Table& table)
{
    Json::Value schema;
    if (table.variants.empty()) {
        schema = object_schema(table, 0);
    } else {
        for (std::size_t i = 0; i < table.variants.size(); ++i) schema["oneOf"].append(object_schema(table, i));
        if (table.name_alone) schema["oneOf"].append(names(table.variant_names()));
    }
    schema["description"] = table.text;
    return schema;
}
} // namespace

std::string scene_schema()
{
    Json::Value schema = table_schema(scene_table());
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "etendue scene";
    for (const Table* table : all_tables())
        if (table != &scene_table()) schema["$defs"][table->name] = table_schema(*table);

    Json::StreamWriterBuilder builder;
    builder["indentation"] = "  ";
    builder["precision"] = 15;
    return Json::writeString(builder, schema) + "\n";
}
} // namespace etendue
