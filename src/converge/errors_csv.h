// errors.csv: every checkpoint of every run.
#pragma once

#include "converge/study.h"

#include <string>
#include <utility>
#include <vector>

namespace etendue
{
// A header line, then a line for each configuration, seed and checkpoint. Commas and quotes in names are quoted.
std::string errors_csv(const Study& study);

// Each column with what it holds, in order.
const std::vector<std::pair<std::string, std::string>>& csv_columns();
} // namespace etendue
