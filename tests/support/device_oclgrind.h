// What Oclgrind, a simulator that watches every access to memory, says of a run.
#pragma once

#include <string>
#include <vector>

namespace etendue
{
struct OclgrindReport {
    std::string error;  // the first line: "Read-write data race at ...", "Invalid write of size 4 at ..."
    std::string kernel; // "" when none is named
};

// The reports in what Oclgrind wrote.
std::vector<OclgrindReport> oclgrind_reports(const std::string& text);

// Without the data races of the one kernel whose order Oclgrind cannot see: in the bottom-up climb the second work-item
// to arrive at a node reads what the first one wrote, ordered by an atomic exchange and fences. The level-by-level
// refit, which has no such races, gives the same bits (tests/src/bvh/lbvh_builder_test.cpp).
std::vector<OclgrindReport> without_expected(std::vector<OclgrindReport> reports);
} // namespace etendue
