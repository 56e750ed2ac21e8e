// Assertions about results.
#include "support/device_checks.h"

#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

namespace etendue
{
std::vector<CheckResult> run_check(const Check& check, const Device& device)
{
    CheckContext context;
    context.device = &device;
    return check.run(context);
}

void require_passed(const std::vector<Check>& checks, const std::string& part)
{
    std::size_t ran = 0;
    for (const Check& check : checks) {
        if (check.is_long || check.name.find(part) == std::string::npos) continue;
        ++ran;
        for (const Device& device : test_devices()) {
            const std::vector<CheckResult> results = run_check(check, device);
            CHECK(!results.empty());
            for (const CheckResult& r : results) {
                CAPTURE(r.group, r.name, r.expected, r.found, r.statistic, r.critical, r.detectable_bias, r.note);
                CHECK(r.group == check.group);
                CHECK(r.name.rfind(check.name, 0) == 0);
                CHECK(r.verdict == Verdict::passed);
            }
        }
    }
    CHECK(ran > 0);
}

std::vector<std::string> failures(const std::vector<CheckResult>& results)
{
    std::vector<std::string> names;
    for (const CheckResult& r : results)
        if (r.verdict != Verdict::passed) names.push_back(r.name);
    return names;
}
} // namespace etendue
