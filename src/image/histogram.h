// A histogram of numbers that should be uniform.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
// As SVG: the shares of p-values in equal parts of 0..1, the height that uniform ones have, and the band that holds all
// of them with 99.9 % certainty where they are independent. NaNs are left out.
std::string p_value_histogram_svg(const std::vector<double>& p_values, std::size_t bins = 20);
} // namespace etendue
