// The machine a measurement ran on, and what else it was doing: times mean little without.
#pragma once

#include <string>

namespace etendue
{
// What the system does not tell is "" or NaN.
struct MachineState {
    std::string processor;     // its model's name
    double load_average = 0.0; // of the last minute
    double median_mhz = 0.0;   // of the processors' clocks now
    double least_mhz = 0.0;
};

MachineState machine_state();

// The same from the texts of /proc/cpuinfo and /proc/loadavg.
MachineState parse_machine_state(const std::string& processors, const std::string& load);
} // namespace etendue
