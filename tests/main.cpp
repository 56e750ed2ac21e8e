// The test program: Catch2's own command line, --device SPEC and --list-devices; at the end, which kernels ran where.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#ifdef ETENDUE_TESTS_USE_DEVICES
#include "compute/profile.h"
#include "support/device_evaluate.h"
#endif

#include <cstdint>
#include <iostream>
#include <string>

// What the address sanitizer's check of leaks need not report: OpenImageIO 2.4 loses its message when libpng jumps over
// it out of a damaged file; fontconfig keeps its fonts to the end. Libraries are named, not their functions: those need
// a symbolizer, which a bare system lacks.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libOpenImageIO.so\nleak:libfontconfig.so";
}
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options()
{
    return "print_suppressions=0";
}

namespace
{
#ifdef ETENDUE_TESTS_USE_DEVICES
// Print what --device can mean, and what it means if it is not given.
int list_devices()
{
    const etendue::DeviceList list = etendue::list_devices();
    for (const etendue::DeviceInfo& d : list.devices) std::cout << d.index << ' ' << d.type << ' ' << d.name << '\n';
    try {
        std::cout << etendue::explain_choice(list) << '\n';
    } catch (const etendue::Error& error) {
        std::cerr << error.what() << '\n';
        return static_cast<int>(error.code());
    }
    for (const std::string& warning : list.warnings) std::cerr << "warning: " << warning << '\n';
    return 0;
}

// Print distinct kernels and launches of each device. False if devices were used and no kernel ran on any.
bool report_launches()
{
    const auto by_device = etendue::launches();
    for (const auto& [device, kernels] : by_device) {
        std::uint64_t total = 0;
        for (const auto& [kernel, launches] : kernels) total += launches;
        std::cerr << device << ": " << kernels.size() << " kernels ran, " << total << " launches.\n";
    }
    if (!by_device.empty() || !etendue::test_devices_were_used()) return true;
    std::cerr << "No kernel ran on any device, although tests asked for one.\n";
    return false;
}
#endif
} // namespace

int main(int argc, char* argv[])
{
    Catch::Session session;
    std::string spec = "auto";
    bool only_list = false;
    using Catch::clara::Opt;
    session.cli(session.cli() |
                Opt(spec, "SPEC")["--device"]("run device tests on these devices, as in etendue render --device") |
                Opt(only_list)["--list-devices"]("list the devices, then exit"));
    if (const int failure = session.applyCommandLine(argc, argv)) return failure;

#ifdef ETENDUE_TESTS_USE_DEVICES
    if (only_list) return list_devices();
    etendue::choose_test_devices(spec);
    const int result = session.run();
    etendue::close_test_devices();
    const bool proven = report_launches();
    return result == 0 && !proven ? 1 : result;
#else
    return session.run();
#endif
}
