// What a fuzzer runs for one input, and every rule that no input may break. An Error that explains itself is a fine
// answer; whatever else leaves these functions is a finding.
#pragma once

#include <stdexcept>
#include <string_view>

namespace etendue
{
// An input broke a rule.
struct FuzzFinding : std::logic_error {
    using std::logic_error::logic_error;
};

// A scene in either format. Lines at the top that begin with "-D " are overrides. No mesh file is read: a box stands
// for each that exists.
void fuzz_scene(std::string_view input);

// A mesh file, then the geometry of a scene that has nothing but this mesh. Numbers of OBJ files are compared with
// those of the C library.
void fuzz_obj(std::string_view input);
void fuzz_ply(std::string_view input);
} // namespace etendue
