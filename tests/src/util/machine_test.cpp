// What Linux tells about a machine.
#include "util/machine.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;

TEST_CASE("the machine's state is read from what Linux tells")
{
    const MachineState state =
        parse_machine_state("processor\t: 0\nmodel name\t: Fast CPU @ 3 GHz\ncpu MHz\t\t: 3000.5\n\n"
                            "processor\t: 1\nmodel name\t: Fast CPU @ 3 GHz\ncpu MHz\t\t: 1000\n\n"
                            "processor\t: 2\ncpu MHz\t\t: 2000\n",
                            "0.75 0.50 0.25 1/234 5678\n");
    CHECK(state.processor == "Fast CPU @ 3 GHz");
    CHECK(state.load_average == 0.75);
    CHECK(state.median_mhz == 2000.0);
    CHECK(state.least_mhz == 1000.0);
}

TEST_CASE("what the system does not tell is not made up")
{
    const MachineState state = parse_machine_state("", "");
    CHECK(state.processor.empty());
    CHECK(std::isnan(state.load_average));
    CHECK(std::isnan(state.median_mhz));
    CHECK(std::isnan(state.least_mhz));
}
