// How configurations compare, two by two.
#pragma once

#include "converge/analysis.h"
#include "converge/curve.h"

#include <vector>

namespace etendue
{
// Efficiencies, row over column, with bands of seeds drawn for both together. Where the slopes differ no one ratio
// holds: then the times to the hardest target that both reach, column over row.
std::vector<std::vector<Ratio>> ratio_matrix(const std::vector<ConfigurationAnalysis>& configurations,
                                             const std::vector<RunCurve>& curves, const StudyOptions& options);

// Whether slopes differ beyond their intervals and beyond SLOPE_TOLERANCE.
bool slopes_differ(const Interval& a, const Interval& b);
} // namespace etendue
