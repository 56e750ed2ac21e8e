// Assertions about results.
#include "support/device_checks.h"

#include "compute/kernel_source.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"
#include "util/environment.h"
#include "util/file.h"

#include <catch2/catch.hpp>

namespace etendue
{
namespace
{
// cl/ with one piece of one file changed, while it lives.
class ChangedKernels
{
public:
    ChangedKernels(const std::string& file, const std::string& piece, const std::string& other)
        : before_(environment("ETENDUE_CL_DIR"))
    {
        std::string text = kernel_file(file);
        const auto place = text.find(piece);
        REQUIRE(place != std::string::npos);
        text.replace(place, piece.size(), other);
        const std::filesystem::path changed = folder_.path() / file;
        std::filesystem::create_directories(changed.parent_path());
        write_file(changed.string(), text);
        set_environment("ETENDUE_CL_DIR", folder_.path().string());
        release_device_functions();
    }
    ~ChangedKernels()
    {
        set_environment("ETENDUE_CL_DIR", before_);
        release_device_functions();
    }
    ChangedKernels(const ChangedKernels&) = delete;
    ChangedKernels& operator=(const ChangedKernels&) = delete;

private:
    TemporaryFolder folder_;
    std::string before_;
};
} // namespace

std::vector<CheckResult> run_check(const Check& check, const Device& device)
{
    // Never released: drivers are unloaded in an order of their own.
    static const KernelCache& cache = *new KernelCache(KernelCache::none().remembering());
    CheckContext context;
    context.device = &device;
    context.cache = cache;
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
                CHECK((r.verdict == Verdict::passed || r.verdict == Verdict::not_covered));
            }
        }
    }
    CHECK(ran > 0);
}

std::vector<std::string> failures(const std::vector<CheckResult>& results)
{
    std::vector<std::string> names;
    for (const CheckResult& r : results)
        if (r.verdict == Verdict::failed || r.verdict == Verdict::underpowered) names.push_back(r.name);
    return names;
}

std::vector<std::string> failures_with_bug(const std::vector<Check>& checks, const std::string& part,
                                           const std::string& file, const std::string& piece, const std::string& other)
{
    const ChangedKernels changed(file, piece, other);
    std::vector<std::string> names;
    for (const Check& check : checks) {
        if (check.is_long || check.name.find(part) == std::string::npos) continue;
        for (const std::string& name : failures(run_check(check, test_devices().front()))) names.push_back(name);
    }
    return names;
}
} // namespace etendue
