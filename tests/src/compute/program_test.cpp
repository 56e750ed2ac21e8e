// Building programs: messages, strict floating point, and the cache on disk.
#include "compute/program.h"

#include "compute/cache_file.h"
#include "compute/kernel.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"
#include "util/environment.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
// cl/probe.cl of this test only: writes one number.
class ProbeProgram
{
public:
    ProbeProgram() : before_(environment("ETENDUE_CL_DIR"))
    {
        set_environment("ETENDUE_CL_DIR", folder_.path().string());
        write_number(1);
    }
    ~ProbeProgram() { set_environment("ETENDUE_CL_DIR", before_); }
    ProbeProgram(const ProbeProgram&) = delete;
    ProbeProgram& operator=(const ProbeProgram&) = delete;

    void write_number(int number)
    {
        write_file((folder_.path() / "probe.cl").string(),
                   "kernel void probe(global uint* out) { out[0] = " + std::to_string(number) + "u; }\n");
    }

private:
    TemporaryFolder folder_;
    std::string before_;
};

std::uint32_t probed_number(const Program& program)
{
    const Buffer<std::uint32_t> out(program.device(), "out", 1);
    Kernel(program, "probe").run(1, 1, out);
    return out.read()[0];
}

std::vector<fs::path> files_in(const fs::path& folder)
{
    return {fs::directory_iterator(folder), fs::directory_iterator()};
}

// Build, run, store; returns the report.
BuildReport build_and_store(const Device& device, const KernelCache& cache, std::uint32_t number,
                            const std::string& options = "")
{
    Program program(device, "probe.cl", options, cache);
    CHECK(probed_number(program) == number);
    program.store_in_cache();
    return program.report();
}
} // namespace

TEST_CASE("a kernel that does not compile is reported with program, device, options, file and line")
{
    for (Device& device : test_devices()) {
        const std::string text =
            "#include \"shared/limits.h\"\nkernel void k(global int* x)\n{\n    x[0] = wrong;\n}\n";
        CHECK_THROWS_AS(Program::from_text(device, "cl/example.cl", text, ""), BuildError);
        CHECK_THROWS_WITH(Program::from_text(device, "cl/example.cl", text, "-DABC=1"),
                          Contains("cl/example.cl does not compile on " + device.info().name) &&
                              Contains("CL_BUILD_PROGRAM_FAILURE") && Contains("-cl-std=CL1.2") &&
                              Contains("-DABC=1") && Contains("cl/example.cl:4:") && Contains("wrong"));
        CHECK_THROWS_AS(Program::from_text(device, "cl/example.cl", "kernel void k(void) {}", "-no-such-option"),
                        BuildError);
    }
}

TEST_CASE("literals without a suffix are float, alone and with vectors")
{
    for (Device& device : test_devices()) {
        const Program program = Program::from_text(device, "literals",
                                                   "kernel void literals(global uint* out)\n{\n"
                                                   "    float4 v = (float4)(3.0f) * 0.1;\n"
                                                   "    out[0] = (uint)sizeof(0.1);\n    out[1] = as_uint(v.x);\n}\n",
                                                   "");
        const Buffer<std::uint32_t> out(device, "out", 2);
        Kernel(program, "literals").run(1, 1, out);
        const float product = 3.0f * 0.1f;
        CHECK(out.read() == std::vector<std::uint32_t>{4, DeviceArgument(std::vector<float>{product}).words[0]});
    }
}

TEST_CASE("floating point is strict: no contraction, compensated sums survive, NaN is seen")
{
    const DeviceFunctions functions(
        {},
        {
            {"antisymmetric", "float float float float -> float", "(in0 * in1 - in2 * in3) + (in2 * in3 - in0 * in1)"},
            {"lost", "float float -> float", "Float s = in0 + in1; Float part = s - in0; out0 = in1 - part;"},
            {"same", "float -> mask", "in0 == in0"},
            {"fused", "float float -> float", "fma(in0, in1, -(in0 * in1))"},
        });
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<float> a, b, c, d;
    for (int i = 0; i < 4096; ++i)
        for (auto* values : {&a, &b, &c, &d}) values->push_back(uniform(random));

    for (Device& device : test_devices())
        for (const std::uint32_t lanes : {1u, 16u}) {
            const auto sums = functions.evaluate<float>(device, "antisymmetric", {a, b, c, d}, lanes);
            CHECK(std::count(sums.begin(), sums.end(), 0.0f) == 4096);

            // The low part of big + small: what Kahan's summation carries on.
            const std::vector<float> big{16777216.0f, 1.0f}, small{1.5f, 0x1p-30f};
            CHECK(functions.evaluate<float>(device, "lost", {big, small}, lanes) ==
                  std::vector<float>{-0.5f, 0x1p-30f});

            CHECK(functions.evaluate<std::uint32_t>(device, "same", {std::vector<float>{NAN, 1.0f}}, lanes) ==
                  std::vector<std::uint32_t>{0, 1});

            // An explicit fma is exact: the rounding error of the product, as double sees it.
            const auto errors = functions.evaluate<float>(device, "fused", {a, b}, lanes);
            for (std::size_t i = 0; i < a.size(); ++i)
                REQUIRE(static_cast<double>(errors[i]) ==
                        static_cast<double>(a[i]) * static_cast<double>(b[i]) - static_cast<double>(a[i] * b[i]));
        }
}

TEST_CASE("the second build of a program comes from the cache, and any change of source or options does not")
{
    const TemporaryFolder folder;
    const KernelCache cache = KernelCache::at(folder.path() / "new" / "folder");
    REQUIRE(cache.enabled());
    ProbeProgram probe;
    const Device& device = test_devices().front();

    const BuildReport first = build_and_store(device, cache, 1);
    CHECK_FALSE(first.from_cache);
    CHECK(first.stored);
    CHECK(first.binary_bytes > 0);
    const BuildReport second = build_and_store(device, cache, 1);
    CHECK(second.from_cache);
    CHECK_FALSE(second.stored);
    CHECK(second.binary_bytes == first.binary_bytes);

    CHECK_FALSE(build_and_store(device, cache, 1, "-DOTHER=1").from_cache);
    probe.write_number(2);
    CHECK_FALSE(build_and_store(device, cache, 2).from_cache);
    CHECK(build_and_store(device, cache, 2).from_cache);
    CHECK(files_in(cache.folder()).size() == 3);
}

TEST_CASE("a damaged file of the cache is rebuilt in silence and replaced")
{
    const TemporaryFolder folder;
    const KernelCache cache = KernelCache::at(folder.path());
    const ProbeProgram probe;
    const Device& device = test_devices().front();
    build_and_store(device, cache, 1);
    REQUIRE(files_in(folder.path()).size() == 1);
    const std::string file = files_in(folder.path())[0].string(), whole = read_file(file);

    std::string flipped = whole;
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
    for (const std::string& damaged :
         {std::string(), std::string("x\ny"), whole.substr(0, whole.size() / 2), flipped}) {
        write_file(file, damaged);
        const BuildReport report = build_and_store(device, cache, 1);
        CHECK_FALSE(report.from_cache);
        CHECK(report.stored);
        CHECK(build_and_store(device, cache, 1).from_cache);
    }
}

TEST_CASE("a whole binary that the driver does not take is rebuilt in silence")
{
    const TemporaryFolder folder;
    const KernelCache cache = KernelCache::at(folder.path());
    const ProbeProgram probe;
    const Device& device = test_devices().front();
    build_and_store(device, cache, 1);
    write_cache_file(files_in(folder.path()).at(0), std::vector<unsigned char>(1000, 'x'));
    const BuildReport report = build_and_store(device, cache, 1);
    CHECK_FALSE(report.from_cache);
    CHECK(report.stored);
}

TEST_CASE("a cache folder that cannot be written switches the cache off and says so")
{
    const TemporaryFolder folder;
    write_file((folder.path() / "file").string(), "");
    const KernelCache cache = KernelCache::at(folder.path() / "file" / "cache");
    CHECK_FALSE(cache.enabled());
    CHECK_THAT(cache.warning(), Contains("file/cache cannot be written"));
    CHECK(KernelCache::none().warning().empty());

    const ProbeProgram probe;
    const BuildReport report = build_and_store(test_devices().front(), cache, 1);
    CHECK_FALSE(report.from_cache);
    CHECK_FALSE(report.stored);
}

TEST_CASE("the standard cache is where the environment says")
{
    const TemporaryFolder folder;
    const std::string before = environment("ETENDUE_CACHE_DIR");
    set_environment("ETENDUE_CACHE_DIR", (folder.path() / "kernels").string());
    CHECK(KernelCache::standard().folder() == folder.path() / "kernels");
    set_environment("ETENDUE_CACHE_DIR", before);
}

TEST_CASE("a cold build is unlike every build before it and leaves nothing")
{
    Device& device = test_devices().front();
    const KernelCache first = KernelCache::cold(), second = KernelCache::cold();
    CHECK_FALSE(first.enabled());
    CHECK(first.option() != second.option());
    CHECK(KernelCache::none().option().empty());
    Program program(device, "film.cl", "-DHAS_AOV=0 -DLANES=1 -DSTACK_SIZE=32", first);
    CHECK_THAT(program.report().options, Contains(first.option()));
    CHECK_FALSE(program.report().from_cache);
    program.store_in_cache();
    CHECK_FALSE(program.report().stored);
}

TEST_CASE("a cache that remembers gives the same program again, for the same source, options and device")
{
    ProbeProgram probe;
    for (const Device& device : test_devices()) {
        probe.write_number(1);
        const KernelCache cache = KernelCache::none().remembering();
        const Program first(device, "probe.cl", "-DA", cache), again(device, "probe.cl", "-DA", KernelCache(cache));
        CHECK_FALSE(first.report().remembered);
        CHECK(again.report().remembered);
        CHECK(again.handle()() == first.handle()());
        CHECK(probed_number(again) == 1);
        // Another device object of the same device, with the same context.
        const Device same(device.info());
        CHECK(Program(same, "probe.cl", "-DA", cache).report().remembered);
        CHECK_FALSE(Program(device, "probe.cl", "-DB", cache).report().remembered);
        CHECK_FALSE(Program(device, "probe.cl", "-DA", KernelCache::none()).report().remembered);
        CHECK_FALSE(Program(device, "probe.cl", "-DA", KernelCache::none().remembering()).report().remembered);
        probe.write_number(2);
        const Program changed(device, "probe.cl", "-DA", cache);
        CHECK_FALSE(changed.report().remembered);
        CHECK(probed_number(changed) == 2);
    }
}
