// The canary's numbers, what strict floating point makes of them, and the verdict on disk.
#include "compute/canary.h"

#include "compute/buffer.h"
#include "compute/cache_file.h"
#include "compute/kernel.h"
#include "util/error.h"
#include "util/sha256.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <sstream>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr std::uint32_t COUNT = 1024;

// Kinds of results, in the order of canary.cl.
enum Result : std::size_t {
    DIFFERENCE,
    OPPOSITE,
    SUM_ERROR,
    QUOTIENT,
    ROOT,
    PRODUCT_AND_SUM,
    SEEN,
    SMALL,
    ZERO_MINUS,
    COMPENSATED_SUM,
    RESULT_KINDS
};
enum Seen : std::uint32_t { NAN_COMPARED = 1, NAN_FUNCTION = 2, NAN_BITS = 4, INFINITE_COMPARED = 8 };

struct Numbers {
    std::vector<float> a, b, c, d, special, factor;
};

Numbers make_numbers()
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    // With the factor that makes each a subnormal number, if one does.
    const std::pair<float, float> specials[] = {
        {nan, 1.0f},    {infinity, 1.0f}, {-infinity, 2.0f}, {0.0f, 1.0f},          {-0.0f, 1.0f},
        {1e-45f, 1.0f}, {-1e-40f, 1.0f},  {0x1p-126f, 0.5f}, {0x1p-100f, 0x1p-40f}, {1.5f, 0x1p-130f}};
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f + 0x1p-24f; };
    Numbers n;
    for (std::uint32_t i = 0; i < COUNT; ++i) {
        n.a.push_back(number());
        n.b.push_back(number());
        n.c.push_back(number());
        n.d.push_back(number());
        n.special.push_back(specials[i % std::size(specials)].first);
        n.factor.push_back(specials[i % std::size(specials)].second);
    }
    return n;
}

float compensated_sum(const std::vector<float>& values)
{
    float sum = 0.0f, carried = 0.0f;
    for (const float value : values) {
        const float next = value - carried, total = sum + next;
        carried = (total - sum) - next;
        sum = total;
    }
    return sum;
}

float sum_error(float a, float b)
{
    const float sum = a + b, b_part = sum - a;
    return (a - (sum - b_part)) + (b - b_part);
}

// What the device wrote.
class Results
{
public:
    explicit Results(std::vector<std::uint32_t> words) : words_(std::move(words)) {}

    std::uint32_t word(Result kind, std::uint32_t i) const { return words_[kind * COUNT + i]; }
    float number(Result kind, std::uint32_t i) const { return std::bit_cast<float>(word(kind, i)); }

private:
    std::vector<std::uint32_t> words_;
};

// Bits that are equal, or both not a number.
bool same(float a, float b)
{
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// How many items go wrong.
template<typename IsRight>
CanaryFinding count(const char* name, const char* what, IsRight is_right)
{
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < COUNT; ++i) wrong += is_right(i) ? 0 : 1;
    return {name, wrong == 0, fmt::format("{} of {} {}", wrong, COUNT, what)};
}

// The largest error in units of the last place of the exact results.
template<typename Exact>
CanaryFinding ulps(const char* name, const Results& results, Result kind, double limit, Exact exact)
{
    double worst = 0.0;
    for (std::uint32_t i = 0; i < COUNT; ++i) {
        const double x = exact(i);
        const double ulp = std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23);
        const double error = std::abs(results.number(kind, i) - x) / ulp;
        worst = std::max(worst, std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
    }
    return {name, worst <= limit, fmt::format("errs by up to {:.3g} ulp, allowed are {:.3g}", worst, limit)};
}

std::vector<CanaryFinding> judge(const Numbers& n, const Results& r, bool correctly_rounded)
{
    const auto seen = [&](std::uint32_t i, Seen bit) { return (r.word(SEEN, i) & bit) != 0; };
    const auto nan_seen = [&](Seen bit) {
        return [&, bit](std::uint32_t i) { return seen(i, bit) == std::isnan(n.special[i]); };
    };
    // Limits of OpenCL 1.2, section 7.4, unless the device promised more.
    const double division = correctly_rounded ? 0.5 : 2.5, root = correctly_rounded ? 0.5 : 3.0;
    return {
        count("contraction", "differences of products are not rounded one by one",
              [&](std::uint32_t i) {
                  const float ab = n.a[i] * n.b[i], cd = n.c[i] * n.d[i];
                  return same(r.number(DIFFERENCE, i), ab - cd) && same(r.number(OPPOSITE, i), cd - ab);
              }),
        count("nan_by_comparison", "numbers are mistaken by x != x", nan_seen(NAN_COMPARED)),
        count("nan_by_function", "numbers are mistaken by isnan()", nan_seen(NAN_FUNCTION)),
        count("nan_by_bits", "numbers are mistaken by their bits", nan_seen(NAN_BITS)),
        count("infinity", "numbers are mistaken by x == INFINITY",
              [&](std::uint32_t i) { return seen(i, INFINITE_COMPARED) == std::isinf(n.special[i]); }),
        count("subnormal_numbers", "small products are not kept",
              [&](std::uint32_t i) { return same(r.number(SMALL, i), n.special[i] * n.factor[i]); }),
        count("signed_zeros", "differences from zero have another sign",
              [&](std::uint32_t i) { return same(r.number(ZERO_MINUS, i), 0.0f - n.special[i]); }),
        count("sum_error", "rounding errors of sums are lost",
              [&](std::uint32_t i) { return same(r.number(SUM_ERROR, i), sum_error(n.a[i], n.b[i])); }),
        count("compensated_sum", "compensated sums are another number",
              [&](std::uint32_t i) { return i > 0 || same(r.number(COMPENSATED_SUM, 0), compensated_sum(n.c)); }),
        count("fma", "products and sums are rounded twice",
              [&](std::uint32_t i) { return same(r.number(PRODUCT_AND_SUM, i), std::fma(n.a[i], n.b[i], -n.c[i])); }),
        ulps("division", r, QUOTIENT, division, [&](std::uint32_t i) { return double{n.a[i]} / n.b[i]; }),
        ulps("square_root", r, ROOT, root, [&](std::uint32_t i) { return std::sqrt(double{n.c[i]}); }),
    };
}

std::vector<CanaryFinding> fly(const Device& device, const std::string& options)
{
    const Numbers n = make_numbers();
    const Program program(device, "canary.cl", options, KernelCache::none());
    const Buffer<float> a(device, "canary a", n.a), b(device, "canary b", n.b), c(device, "canary c", n.c),
        d(device, "canary d", n.d), special(device, "canary special", n.special),
        factor(device, "canary factor", n.factor);
    const Buffer<std::uint32_t> results(device, "canary results", COUNT * RESULT_KINDS);
    Kernel(program, "canary").run(COUNT, 1, COUNT, a, b, c, d, special, factor, results);
    return judge(n, Results(results.read()), device.info().correctly_rounded_divide);
}

// Everything a verdict depends on.
std::string verdict_key(const DeviceInfo& d, const std::string& options)
{
    std::string text;
    for (const std::string& part :
         {std::string(ETENDUE_VERSION), d.platform_name, d.platform_version, d.name, d.driver_version, d.device_version,
          all_build_options(d, options), expand_program("canary.cl")})
        text += fmt::format("{}:{};", part.size(), part);
    return sha256(text);
}

// One finding a line: + or -, name, detail.
std::vector<unsigned char> verdict_bytes(const std::vector<CanaryFinding>& findings)
{
    std::string text;
    for (const CanaryFinding& f : findings) text += fmt::format("{}{} {}\n", f.passed ? '+' : '-', f.name, f.detail);
    return {text.begin(), text.end()};
}

// Nothing when the file is not there, or damaged.
std::optional<std::vector<CanaryFinding>> read_verdict(const std::filesystem::path& file)
{
    const auto bytes = read_cache_file(file);
    if (!bytes) return {};
    std::vector<CanaryFinding> findings;
    std::istringstream lines(std::string(bytes->begin(), bytes->end()));
    for (std::string line; std::getline(lines, line);) {
        const auto space = line.find(' ');
        if (space == std::string::npos) return {};
        findings.push_back({line.substr(1, space - 1), line[0] == '+', line.substr(space + 1)});
    }
    if (findings.empty()) return {};
    return findings;
}

void write_verdict(const std::filesystem::path& file, const std::vector<CanaryFinding>& findings)
{
    try {
        write_cache_file(file, verdict_bytes(findings));
    } catch (const FileError&) {
        // The next run flies the canary again.
    }
}
} // namespace

std::string CanaryReport::complaint() const
{
    std::string text;
    for (const CanaryFinding& f : findings)
        if (!f.passed) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", f.name, f.detail);
    return text.empty() ? text : text + ".";
}

CanaryReport run_canary(const Device& device, const std::string& options, const KernelCache& cache)
{
    const Stopwatch watch;
    CanaryReport report;
    std::filesystem::path file;
    if (cache.enabled()) file = cache.folder() / (verdict_key(device.info(), options) + ".canary");
    if (const auto kept = file.empty() ? std::nullopt : read_verdict(file)) {
        report.findings = *kept;
        report.from_cache = true;
    } else {
        report.findings = fly(device, options);
        if (!file.empty()) write_verdict(file, report.findings);
    }
    report.passed = std::all_of(report.findings.begin(), report.findings.end(), [](const auto& f) { return f.passed; });
    report.seconds = watch.seconds();
    return report;
}
} // namespace etendue
