// libFuzzer's entry: OBJ files. scripts/fuzz runs it.
#include "support/fuzz_targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    etendue::fuzz_obj({reinterpret_cast<const char*>(data), size});
    return 0;
}
