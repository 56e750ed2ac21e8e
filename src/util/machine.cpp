// Reads what Linux tells in /proc; elsewhere nothing is known.
#include "util/machine.h"

#include "util/error.h"
#include "util/file.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

namespace etendue
{
namespace
{
std::string text_of(const std::string& path)
{
    try {
        return read_file(path);
    } catch (const FileError&) {
        return "";
    }
}

// A number at the beginning of a text; NaN where there is none.
double leading_number(const std::string& text)
{
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    double value = 0.0;
    return stream >> value ? value : std::numeric_limits<double>::quiet_NaN();
}
} // namespace

MachineState parse_machine_state(const std::string& processors, const std::string& load)
{
    MachineState state;
    state.load_average = leading_number(load);
    std::vector<double> clocks;
    std::istringstream lines(processors);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
        const std::string value = begin == std::string::npos ? "" : line.substr(begin);
        if (line.rfind("model name", 0) == 0 && state.processor.empty()) state.processor = value;
        if (line.rfind("cpu MHz", 0) == 0) clocks.push_back(leading_number(value));
    }
    std::sort(clocks.begin(), clocks.end());
    state.median_mhz = state.least_mhz = std::numeric_limits<double>::quiet_NaN();
    if (!clocks.empty()) {
        state.median_mhz = (clocks[(clocks.size() - 1) / 2] + clocks[clocks.size() / 2]) / 2;
        state.least_mhz = clocks.front();
    }
    return state;
}

MachineState machine_state()
{
    return parse_machine_state(text_of("/proc/cpuinfo"), text_of("/proc/loadavg"));
}
} // namespace etendue
