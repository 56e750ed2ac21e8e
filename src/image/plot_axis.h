// A logarithmic axis: which numbers it reaches, and which of them are marked.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
struct AxisTick {
    double value = 1.0;
    bool is_decade = false; // a power of ten
    bool is_labelled = false;
};

class LogAxis
{
public:
    // Reaches all of `values` that are positive and finite, and a little more; from 1 to 10 where there is none.
    explicit LogAxis(const std::vector<double>& values);

    double low() const { return low_; }
    double high() const { return high_; }
    // 0 at low, 1 at high; outside of that for what is outside.
    double position(double value) const;
    // Powers of ten, with the numbers between where there is space for them. At least two have labels.
    std::vector<AxisTick> ticks(std::size_t most_labels) const;

private:
    double low_ = 1.0, high_ = 10.0;
};

// A number can be placed on the axis.
bool is_plottable(double value);

// The parts of a label: "0.01" for 1e-2, {"10", "-5"} for 1e-5, {"2×10", "-5"} for 2e-5.
struct TickLabel {
    std::string text, exponent;
};
TickLabel tick_label(double value);
} // namespace etendue
