// What checks gather, and the lines of the table that come of it.
#pragma once

#include "check/check.h"
#include "compute/device.h"
#include "util/chi_square.h"

#include <string>
#include <utility>
#include <vector>

namespace etendue
{
// A check whose results get the group and, where they have none of their own, an equal part of the time.
Check make_check(const std::string& group, const std::string& name,
                 std::function<std::vector<CheckResult>(const CheckContext&)> run, std::size_t statistical_tests = 0,
                 bool is_long = false);

// What a check that needs double precision says on a device without it.
CheckResult needs_double(const std::string& name, Rule rule, const DeviceInfo& device);

// Trials of which none may go wrong.
class Violations
{
public:
    // What the next trials are of, for the note about the first one that goes wrong.
    void set_subject(const std::string& subject) { subject_ = subject; }

    // One more trial; `what` is what is wrong with it if it is not right.
    void expect(bool is_right, const char* what)
    {
        ++trials_;
        if (!is_right) add(what, 1);
    }
    // Many trials at once.
    void add_trials(std::size_t count) { trials_ += count; }
    void add(const char* what, std::size_t count);

    std::size_t count() const { return count_; }
    std::size_t trials() const { return trials_; }

    CheckResult result(const std::string& name, Rule rule = Rule::count) const;

private:
    std::string subject_, first_subject_;
    std::size_t trials_ = 0, count_ = 0;
    std::vector<std::pair<std::string, std::size_t>> kinds_;
};

// The largest of many errors; one that is not a number is infinite.
class WorstError
{
public:
    void set_subject(const std::string& subject) { subject_ = subject; }
    void add(double error);
    double worst() const { return worst_; }

    // At most `limit`, in `unit`; without a single error the result fails.
    CheckResult result(const std::string& name, double limit, const std::string& unit, Rule rule = Rule::bound) const;

private:
    std::string subject_, worst_subject_;
    double worst_ = 0.0;
    std::size_t errors_ = 0;
};

// Chi-square tests of histograms, each at the context's level; the result is the least p-value.
class DistributionTests
{
public:
    // `smallest_bias`: the root mean square relative error of the bins' probabilities that has to be visible.
    explicit DistributionTests(const CheckContext& context, double smallest_bias = 0.02)
        : level_(context.test_alpha), smallest_bias_(smallest_bias)
    {
    }

    void add(const std::string& subject, const Histogram& histogram, const std::vector<double>& probabilities);
    // Counts of samples by bin, and of those in none.
    void add(const std::string& subject, const std::vector<double>& counts, double outside,
             const std::vector<double>& probabilities);
    CheckResult result(const std::string& name) const;

private:
    double level_, smallest_bias_;
    double least_p_ = 1.0, worst_bias_ = 0.0;
    std::size_t tests_ = 0, samples_ = 0, outside_ = 0;
    std::string worst_subject_, note_;
};

// Means of many samples against expected values, each at the context's level by the normal distribution; the result is
// the largest |z|.
class ExpectedMeans
{
public:
    explicit ExpectedMeans(const CheckContext& context);

    // `tolerance`: how far the expected value itself may be off.
    void add(const std::string& subject, double mean, double standard_error, double expected, double tolerance);
    CheckResult result(const std::string& name) const;

private:
    double delta_, critical_;
    double worst_z_ = 0.0, worst_bias_ = 0.0;
    std::size_t tests_ = 0;
    std::string worst_subject_, expected_, found_;
};
} // namespace etendue
