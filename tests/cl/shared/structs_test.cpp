// Host and device agree on the layout of every shared struct.
#include "compute/kernel.h"
#include "math/shared.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <string>

using namespace etendue;

TEST_CASE("every shared struct has the same size on the host and on each device")
{
    std::string text =
        "#include \"shared/structs.h\"\nkernel void struct_sizes(global uint* sizes)\n{\n    uint i = 0;\n";
    std::vector<std::string> names;
    std::vector<std::uint32_t> expected;
#define ADD_STRUCT(name)                                                                                               \
    text += "    sizes[i++] = (uint)sizeof(" #name ");\n";                                                             \
    names.push_back(#name);                                                                                            \
    expected.push_back(sizeof(name));
    SHARED_STRUCTS(ADD_STRUCT)
#undef ADD_STRUCT

    for (Device& device : test_devices()) {
        const Program program = Program::from_text(device, "struct sizes", text + "}\n", "");
        const Buffer<std::uint32_t> sizes(device, "sizes", expected.size());
        Kernel(program, "struct_sizes").run(1, 0, sizes);
        const auto found = sizes.read();
        for (std::size_t i = 0; i < names.size(); ++i) {
            INFO(names[i] << " on " << device.info().name);
            CHECK(found[i] == expected[i]);
        }
    }
}
