// Builds programs, from our cache when it can.
#include "compute/program.h"

#include "compute/cache_file.h"
#include "util/environment.h"
#include "util/sha256.h"
#include "util/stopwatch.h"

#include <atomic>
#include <chrono>
#include <cstdint>

#include <fmt/format.h>

namespace etendue
{
namespace fs = std::filesystem;
// Literals carry no suffix in our kernels, so the float build makes them float.
std::string all_build_options(const DeviceInfo& device, const std::string& options)
{
    std::string all = base_build_options;
    if (options.find("-DREAL_IS_DOUBLE=1") == std::string::npos) all += " -cl-single-precision-constant";
    if (device.correctly_rounded_divide) all += " -cl-fp32-correctly-rounded-divide-sqrt";
    if (const std::string extra = environment("ETENDUE_CL_OPTIONS"); !extra.empty()) all += ' ' + extra;
    return options.empty() ? all : all + ' ' + options;
}

namespace
{
// Everything a binary depends on.
std::string cache_key(const DeviceInfo& d, const std::string& source, const std::string& options)
{
    std::string text;
    for (const std::string& part : {std::string(ETENDUE_VERSION), d.platform_name, d.platform_version, d.name,
                                    d.driver_version, d.device_version, options, source})
        text += fmt::format("{}:{};", part.size(), part);
    return sha256(text);
}

std::string build_log(const cl::Program& program, const Device& device)
{
    try {
        return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle());
    } catch (const cl::Error&) {
        return "";
    }
}

cl::Program build_source(const Device& device, const std::string& source, BuildReport& report)
{
    cl::Program program;
    try {
        program = cl::Program(device.context(), source);
    } catch (const cl::Error& e) {
        throw_device_error(device.info().name, e);
    }
    try {
        program.build(device.handle(), report.options.c_str());
    } catch (const cl::Error& e) {
        throw BuildError(fmt::format("{} does not compile on {}, driver {}: {}.\nOptions: {}\n{}", report.program,
                                     device.info().name, device.info().driver_version, opencl_error_name(e.err()),
                                     report.options, build_log(program, device)));
    }
    return program;
}

// The program from its binary in the cache; an empty handle when there is none that the driver takes.
cl::Program build_cached(const Device& device, const fs::path& file, BuildReport& report)
{
    const auto binary = read_cache_file(file);
    if (!binary) return {};
    try {
        cl::Program program(device.context(), {device.handle()}, cl::Program::Binaries{*binary});
        program.build(device.handle(), report.options.c_str());
        report.from_cache = true;
        report.binary_bytes = binary->size();
        return program;
    } catch (const cl::Error&) {
        return {};
    }
}
} // namespace

KernelCache KernelCache::at(const fs::path& folder)
{
    KernelCache cache;
    if (is_writable_folder(folder))
        cache.folder_ = folder;
    else
        cache.warning_ = fmt::format(
            "The kernel cache {} cannot be written, so kernels are compiled anew in every run: set ETENDUE_CACHE_DIR "
            "to a folder that can be written.",
            folder.string());
    return cache;
}

KernelCache KernelCache::standard()
{
    if (const std::string folder = environment("ETENDUE_CACHE_DIR"); !folder.empty()) return at(folder);
    if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty()) return at(fs::path(cache) / "etendue");
    if (const std::string home = environment("HOME"); !home.empty()) return at(fs::path(home) / ".cache" / "etendue");
    return none();
}

KernelCache KernelCache::remembering() const
{
    KernelCache cache = *this;
    cache.programs_ = std::make_shared<Programs>();
    return cache;
}

cl::Program* KernelCache::remembered(const Device& device, const std::string& key) const
{
    return programs_ ? &(*programs_)[{device.context()(), key}] : nullptr;
}

KernelCache KernelCache::cold()
{
    static std::atomic<std::uint64_t> serial{0};
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    KernelCache cache;
    cache.option_ = fmt::format("-DUNSEEN_BEFORE={}{:04}", now, serial++);
    return cache;
}

Program::Program(const Device& device, const std::string& name, const std::string& options, const KernelCache& cache)
    : device_(&device)
{
    const std::string source = expand_program(name);
    report_.program = name;
    report_.options = all_build_options(device.info(), options);
    if (!cache.option().empty()) report_.options += ' ' + cache.option();
    report_.source_bytes = source.size();
    const std::string key = cache_key(device.info(), source, report_.options);
    if (cache.enabled()) cache_file_ = cache.folder() / (key + ".bin");

    const Stopwatch stopwatch;
    cl::Program* const remembered = cache.remembered(device, key);
    if (remembered && (*remembered)()) {
        program_ = *remembered;
        report_.remembered = true;
    } else {
        if (!cache_file_.empty()) program_ = build_cached(device, cache_file_, report_);
        if (!report_.from_cache) program_ = build_source(device, source, report_);
        if (remembered) *remembered = program_;
    }
    report_.seconds = stopwatch.seconds();
    report_.log = build_log(program_, device);
}

Program Program::from_text(const Device& device, const std::string& name, const std::string& text,
                           const std::string& options)
{
    const std::string source = expand_source(name, text);
    Program program;
    program.device_ = &device;
    program.report_.program = name;
    program.report_.options = all_build_options(device.info(), options);
    program.report_.source_bytes = source.size();
    const Stopwatch stopwatch;
    program.program_ = build_source(device, source, program.report_);
    program.report_.seconds = stopwatch.seconds();
    program.report_.log = build_log(program.program_, device);
    return program;
}

void Program::store_in_cache()
{
    if (cache_file_.empty() || report_.from_cache || report_.remembered || report_.stored) return;
    try {
        const auto binaries = program_.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.empty() || binaries.front().empty()) return;
        report_.binary_bytes = binaries.front().size();
        write_cache_file(cache_file_, binaries.front());
        report_.stored = true;
    } catch (const cl::Error&) {
    } catch (const FileError&) {
    }
}
} // namespace etendue
