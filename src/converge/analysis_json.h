// The conclusions of a study, as parts of converge.json.
#pragma once

#include "converge/analysis.h"

#include <json/value.h>

#include <cstdint>

namespace etendue
{
// Numbers as JSON; what is not finite is null.
Json::Value json_number(std::uint64_t x);
Json::Value json_number(double x);

// Adds curve, slopes, fits, times, calibration and verdict to the object of a configuration.
void set_analysis(Json::Value& json, const ConfigurationAnalysis& analysis);

// A list of every ordered pair.
Json::Value ratios_json(const Analysis& analysis);
} // namespace etendue
