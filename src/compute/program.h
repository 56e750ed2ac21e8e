// A compiled program: its source expanded, its options, where the binary came from and what that cost.
#pragma once

#include "compute/device.h"
#include "compute/kernel_source.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace etendue
{
// Always: strict floating point, so never a fast-math flag (the source itself forbids contraction, kernel_source.h).
// The float build adds -cl-single-precision-constant, a device that can adds -cl-fp32-correctly-rounded-divide-sqrt.
// ETENDUE_CL_OPTIONS of the environment comes last: like ETENDUE_CL_DIR it is for developing and for tests.
inline constexpr const char* base_build_options = "-cl-std=CL1.2";

// Where compiled kernels are kept between runs, or nothing. Default: $ETENDUE_CACHE_DIR, else $XDG_CACHE_HOME/etendue,
// else ~/.cache/etendue. A folder that cannot be written switches the cache off with a warning.
class KernelCache
{
public:
    static KernelCache at(const std::filesystem::path& folder);
    static KernelCache standard();
    static KernelCache none() { return {}; }
    // Nothing is kept, and drivers that keep kernels themselves find none either: every build has an option that no
    // build before it had. For measuring what the first run on a machine costs.
    static KernelCache cold();

    // The same cache, which also remembers the programs that it and its copies have built, as long as one of them
    // lives: for many scenes one after the other. Not for several threads at once.
    KernelCache remembering() const;

    bool enabled() const { return !folder_.empty(); }
    const std::filesystem::path& folder() const { return folder_; }
    const std::string& warning() const { return warning_; } // why it is switched off, or ""
    const std::string& option() const { return option_; }   // of every build; "" unless cold

    // Where the program of this key is remembered, empty at first; null where nothing is.
    cl::Program* remembered(const Device& device, const std::string& key) const;

private:
    using Programs = std::map<std::pair<cl_context, std::string>, cl::Program>;

    std::string warning_, option_;
    std::filesystem::path folder_;
    std::shared_ptr<Programs> programs_;
};

struct BuildReport {
    std::string program; // "path_megakernel.cl"
    std::string options;
    std::string log;
    bool from_cache = false; // loaded from our own cache
    bool remembered = false; // built before by this process
    bool stored = false;     // written to our own cache
    double seconds = 0.0;    // clBuildProgram, cold or from a binary
    std::size_t source_bytes = 0, binary_bytes = 0;
};

// The options of every build for this device, then those of this program.
std::string all_build_options(const DeviceInfo& device, const std::string& options);

class Program
{
public:
    // Build cl/<name> for the device. Throws BuildError with the log, options and device.
    Program(const Device& device, const std::string& name, const std::string& options, const KernelCache& cache);
    // Build a text; `name` is what messages call it. Never cached on disk.
    static Program from_text(const Device& device, const std::string& name, const std::string& text,
                             const std::string& options);

    const Device& device() const { return *device_; }
    const cl::Program& handle() const { return program_; }
    const BuildReport& report() const { return report_; }

    // Write the binary to the cache if it is not there yet. Asking some drivers for a binary is slow (PoCL compiles
    // again), so this is called when there is time: after the picture is written. Never throws.
    void store_in_cache();

private:
    Program() = default;

    const Device* device_ = nullptr;
    cl::Program program_;
    BuildReport report_;
    std::filesystem::path cache_file_;
};
} // namespace etendue
