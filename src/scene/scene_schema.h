// The native scene format described for programs and for people, from the parser's own tables.
#pragma once

#include <string>

namespace etendue
{
// JSON Schema, draft 2020-12: the text of scenes/scene.schema.json.
std::string scene_schema();

// Markdown tables of every object and key: the second part of scenes/FORMAT.md.
std::string scene_reference();
} // namespace etendue
