// The errors of several runs as one curve, for any choice of the runs.
#pragma once

#include "converge/errors.h"
#include "converge/interval.h"

#include <string>
#include <vector>

namespace etendue
{
// One number of a row, by the names of image/metrics.h; of mse and relmse without the reference's variance.
double metric_of(const ErrorRow& row, const std::string& metric);
// Those that fall with the samples.
const std::vector<std::string>& error_names();

// The checkpoints of which all runs have a row, those at which the reference's floor does not show, the means of drawn
// runs.
class RunCurve
{
public:
    RunCurve() = default;
    RunCurve(std::vector<const Run*> runs, double floor);

    std::size_t runs() const { return runs_.size(); }
    std::size_t points() const { return points_; }
    bool usable(std::size_t point) const { return usable_[point]; }
    std::size_t usable_points() const;
    // The last usable point; points() where there is none.
    std::size_t last_usable() const;

    const ErrorRow& row(std::size_t run, std::size_t point) const { return runs_[run]->rows[rows_[run][point]]; }

    // Means over the drawn runs at each usable point.
    std::vector<double> mean(const Draw& draw, const std::string& metric) const;
    std::vector<double> mean_seconds(const Draw& draw) const;
    std::vector<double> mean_samples(const Draw& draw) const;
    // 1 / (MSE * seconds) at the last usable point.
    double efficiency(const Draw& draw) const;

    // Values of each run at one point.
    std::vector<double> values(std::size_t point, const std::string& metric) const;
    // The slope of log2 MSE on log2 samples, or on log2 seconds, of each run over the usable points.
    std::vector<double> slopes(bool on_seconds) const;

private:
    template<typename Value>
    std::vector<double> means(const Draw& draw, Value value) const;

    std::vector<const Run*> runs_;
    std::vector<std::vector<std::size_t>> rows_; // [run][point]
    std::size_t points_ = 0;
    std::vector<bool> usable_;
};
} // namespace etendue
