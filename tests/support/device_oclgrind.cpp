// Reading Oclgrind's output.
#include "support/device_oclgrind.h"

#include <sstream>

namespace etendue
{
namespace
{
const char* const CLIMB_KERNEL = "climb_boxes";

bool begins_report(const std::string& line)
{
    for (const char* start : {"Read-write data race", "Write-write data race", "Invalid read", "Invalid write",
                              "Uninitialized value", "Work-group divergence", "Unaligned", "Index ("})
        if (line.rfind(start, 0) == 0) return true;
    return line.find("OCLGRIND") != std::string::npos;
}
} // namespace

std::vector<OclgrindReport> oclgrind_reports(const std::string& text)
{
    std::vector<OclgrindReport> reports;
    std::istringstream lines(text);
    const std::string kernel_prefix = "\tKernel: ";
    for (std::string line; std::getline(lines, line);) {
        if (begins_report(line)) reports.push_back({line, ""});
        if (!reports.empty() && line.rfind(kernel_prefix, 0) == 0)
            reports.back().kernel = line.substr(kernel_prefix.size());
    }
    return reports;
}

std::vector<OclgrindReport> without_expected(std::vector<OclgrindReport> reports)
{
    std::erase_if(reports, [](const OclgrindReport& r) {
        return r.kernel == CLIMB_KERNEL && r.error.find("data race") != std::string::npos;
    });
    return reports;
}
} // namespace etendue
