// The "expect" block of a scene: what its picture must be.
#pragma once

#include "scene/scene.h"
#include "scene/table.h"
#include "util/json.h"

namespace etendue
{
const Table& expectation_table();
const Table& fact_table();

// Formulas are kept as they are written. Throws SceneError.
Expectation parse_expectation(const json::Value& value);
} // namespace etendue
