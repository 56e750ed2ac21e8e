// Markdown tables from the tables of the scene format.
#include "scene/scene_schema.h"

#include "scene/scene_tables.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string default_text(const Property& p)
{
    if (p.standard == REQUIRED) return "required";
    if (p.standard != std::string(OPTIONAL)) return fmt::format("`{}`", p.standard);
    return "";
}

// What may stand there, with a link to the section of an object.
std::string kind_text(const Property& p)
{
    if (p.kind == Kind::object) return fmt::format("[{0}](#{0})", p.table().name);
    if (p.kind == Kind::objects) return fmt::format("list of [{0}](#{0})", p.table().name);
    if (p.kind == Kind::object_or_list) return fmt::format("[{0}](#{0}) or a list of them", p.table().name);
    return p.expectation();
}

std::string row(const std::string& type, const Property& p)
{
    return fmt::format("| {} | `{}` | {} | {} | {} |\n", type, p.name, kind_text(p), default_text(p), p.text);
}

std::string section(const Table& table)
{
    std::string text = fmt::format("### {}\n\n{}\n", table.name, table.text);
    if (!table.variants.empty()) {
        text += fmt::format("\n`{}` is one of:\n\n", table.type_key);
        for (const Variant& variant : table.variants) text += fmt::format("- `{}`: {}\n", variant.name, variant.text);
        if (table.standard_type) text += fmt::format("\nWithout a type it is `{}`.", table.standard_type);
        if (table.name_alone) text += " The name of the type may stand for the whole object.";
        if (table.standard_type || table.name_alone) text += "\n";
    }
    if (table.exactly_one) text += "\nExactly one of the keys:\n";
    text += fmt::format("\n| for {} | key | is | default | |\n| --- | --- | --- | --- | --- |\n", table.type_key);
    for (const Property& p : table.properties) text += row(table.variants.empty() ? "" : "all", p);
    for (const Variant& variant : table.variants)
        for (const Property& p : variant.properties) text += row("`" + variant.name + "`", p);
    return text;
}
} // namespace

std::string scene_reference()
{
    std::string text;
    for (const Table* table : all_tables()) text += (text.empty() ? "" : "\n") + section(*table);
    return text;
}
} // namespace etendue
