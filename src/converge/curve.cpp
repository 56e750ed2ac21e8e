// Means over runs, point by point.
#include "converge/curve.h"

#include "converge/analysis.h"
#include "converge/fit.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace etendue
{
namespace
{
// Indices of each run's rows at the checkpoints of which every run has one. Rows are in the order of their checkpoints.
std::vector<std::vector<std::size_t>> common_rows(const std::vector<const Run*>& runs)
{
    std::map<std::size_t, std::size_t> counts;
    for (const Run* run : runs)
        for (const ErrorRow& row : run->rows) ++counts[row.checkpoint];
    std::vector<std::vector<std::size_t>> common(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r)
        for (std::size_t k = 0; k < runs[r]->rows.size(); ++k)
            if (counts[runs[r]->rows[k].checkpoint] == runs.size()) common[r].push_back(k);
    return common;
}
} // namespace

const std::vector<std::string>& error_names()
{
    static const std::vector<std::string> names{"mse", "relmse", "mape", "max_relative", "trimmed_relmse"};
    return names;
}

double metric_of(const ErrorRow& row, const std::string& metric)
{
    if (metric == "mse") return row.mse;
    if (metric == "relmse") return row.relmse;
    for (const MetricName& name : metric_names())
        if (metric == name.name) return row.metrics.*name.value;
    throw std::invalid_argument("there is no metric " + metric);
}

RunCurve::RunCurve(std::vector<const Run*> runs, double floor) : runs_(std::move(runs))
{
    if (runs_.empty()) return;
    rows_ = common_rows(runs_);
    points_ = rows_.front().size();
    for (std::size_t k = 0; k < points_; ++k) {
        double measured = 0.0, corrected = 0.0, worst = row(0, k).mse;
        for (std::size_t run = 0; run < runs_.size(); ++run) {
            measured += row(run, k).metrics.mse / static_cast<double>(runs_.size());
            corrected += row(run, k).mse;
            worst = std::min(worst, row(run, k).mse);
        }
        usable_.push_back(measured >= FLOOR_MULTIPLE * floor && corrected > 0.0 && worst > 0.0);
    }
}

std::size_t RunCurve::usable_points() const
{
    return static_cast<std::size_t>(std::count(usable_.begin(), usable_.end(), true));
}

std::size_t RunCurve::last_usable() const
{
    for (std::size_t k = points_; k-- > 0;)
        if (usable_[k]) return k;
    return points_;
}

template<typename Value>
std::vector<double> RunCurve::means(const Draw& draw, Value value) const
{
    std::vector<double> result;
    for (std::size_t k = 0; k < points_; ++k) {
        if (!usable_[k]) continue;
        double sum = 0.0;
        for (const std::size_t run : draw) sum += value(row(run, k));
        result.push_back(sum / static_cast<double>(draw.size()));
    }
    return result;
}

std::vector<double> RunCurve::mean(const Draw& draw, const std::string& metric) const
{
    return means(draw, [&](const ErrorRow& row) { return metric_of(row, metric); });
}

std::vector<double> RunCurve::mean_seconds(const Draw& draw) const
{
    return means(draw, [](const ErrorRow& row) { return row.render_seconds; });
}

std::vector<double> RunCurve::mean_samples(const Draw& draw) const
{
    return means(draw, [](const ErrorRow& row) { return static_cast<double>(row.samples); });
}

double RunCurve::efficiency(const Draw& draw) const
{
    const std::vector<double> mse = mean(draw, "mse"), seconds = mean_seconds(draw);
    if (mse.empty()) return std::numeric_limits<double>::quiet_NaN();
    return 1.0 / (mse.back() * seconds.back());
}

std::vector<double> RunCurve::values(std::size_t point, const std::string& metric) const
{
    std::vector<double> values;
    for (std::size_t run = 0; run < runs_.size(); ++run) values.push_back(metric_of(row(run, point), metric));
    return values;
}

std::vector<double> RunCurve::slopes(bool on_seconds) const
{
    std::vector<double> slopes;
    for (std::size_t run = 0; run < runs_.size(); ++run) {
        const std::vector<double> x = on_seconds ? mean_seconds({run}) : mean_samples({run});
        if (x.size() >= 2) slopes.push_back(log_log_slope(x, mean({run}, "mse")));
    }
    return slopes;
}
} // namespace etendue
