// A formula as a scene file writes it; scene/formula.h works it out.
#pragma once

#include "util/error.h"

#include <string>

namespace etendue
{
struct FormulaText {
    std::string text;
    SourceLocation location;
};
} // namespace etendue
