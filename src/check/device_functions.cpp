// Makes one kernel per function, which loads LANES consecutive elements, runs the body and stores by lane.
#include "check/device_functions.h"

#include "compute/kernel.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Programs = std::map<std::tuple<const DeviceFunctions*, const Device*, std::uint32_t>, Program>;

Programs& built_programs()
{
    static Programs all;
    return all;
}

// A Float, of single precision in either kind of program, as a word of a buffer.
const char* const FLOAT_WORDS = "#if REAL_IS_DOUBLE\n"
                                "#define float_from_word(word) ((Float)as_float(word))\n"
                                "#define word_of_float(x) as_uint((float)(x))\n"
                                "#else\n"
                                "#define float_from_word(word) from_bits(word)\n"
                                "#define word_of_float(x) uint_bits(x)\n"
                                "#endif\n";

struct Signature {
    std::vector<std::string> inputs, outputs;
};

Signature parse_signature(const std::string& text)
{
    Signature signature;
    auto* side = &signature.inputs;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (word == "->")
            side = &signature.outputs;
        else
            side->push_back(word);
    }
    return signature;
}

bool is_array(const std::string& type)
{
    return type.ends_with('*');
}

// float -> Float and so on: the type of one value per lane.
std::string lane_type(std::string type)
{
    if (type != "float" && type != "int" && type != "uint" && type != "mask")
        throw std::logic_error("The type of a device function's value is float, int, uint or mask, not " + type + ".");
    type[0] = static_cast<char>(type[0] - 'a' + 'A');
    return type;
}

std::string from_words(const std::string& type, const std::string& words)
{
    if (type == "float") return fmt::format("float_from_word({})", words);
    if (type == "int") return fmt::format("int_bits({})", words);
    if (type == "mask") return fmt::format("({} != (Uint)(0u))", words);
    return words;
}

std::string to_words(const std::string& type, const std::string& value)
{
    if (type == "mask") return fmt::format("({} ? (Uint)(1u) : (Uint)(0u))", value);
    if (type == "float") return fmt::format("word_of_float({})", value);
    return type == "uint" ? value : fmt::format("uint_bits({})", value);
}

// Declare in<i>: the elements of this work-item (the last one again behind the end), or a pointer to the array.
std::string load_input(std::size_t i, const std::string& type)
{
    if (is_array(type))
        return fmt::format("    global const {0} in{1} = (global const {0})(words + offsets[{1}]);\n", type, i);
    return fmt::format("    UintLanes in{0}_lanes;\n"
                       "    for (uint lane = 0; lane < LANES; lane++)\n"
                       "        in{0}_lanes.lane[lane] = words[offsets[{0}] + min(first + lane, count - 1u)];\n"
                       "    {1} in{0} = {2};\n",
                       i, lane_type(type), from_words(type, fmt::format("in{}_lanes.lanes", i)));
}

std::string store_output(std::size_t i, const std::string& type)
{
    return fmt::format(
        "    UintLanes out{0}_lanes;\n"
        "    out{0}_lanes.lanes = {1};\n"
        "    for (uint lane = 0; lane < LANES; lane++)\n"
        "        if (first + lane < count) results[{0} * count + first + lane] = out{0}_lanes.lane[lane];\n",
        i, to_words(type, fmt::format("out{}", i)));
}

std::string kernel_text(const DeviceFunction& function)
{
    const Signature signature = parse_signature(function.signature);
    std::string text = fmt::format("#line 1 \"kernel around {0}\"\nkernel void call_{0}(uint count, global const uint* "
                                   "offsets, global const uint* words, "
                                   "global uint* results)\n{{\n    uint first = (uint)get_global_id(0) * LANES;\n",
                                   function.name);
    for (std::size_t i = 0; i < signature.inputs.size(); ++i) text += load_input(i, signature.inputs[i]);
    for (std::size_t i = 0; i < signature.outputs.size(); ++i)
        text += fmt::format("    {} out{};\n", lane_type(signature.outputs[i]), i);

    const bool is_expression = function.body.find(';') == std::string::npos;
    text += fmt::format("#line 1 \"body of {}\"\n{}\n", function.name,
                        is_expression ? "out0 = " + function.body + ";" : function.body);

    for (std::size_t i = 0; i < signature.outputs.size(); ++i) text += store_output(i, signature.outputs[i]);
    return text + "}\n";
}

// The number of elements: that of every argument which is no array.
std::size_t element_count(const DeviceFunction& function, const Signature& signature,
                          const std::vector<DeviceArgument>& arguments)
{
    if (signature.inputs.size() != arguments.size())
        throw std::logic_error(
            fmt::format("{} takes {} arguments, not {}.", function.name, signature.inputs.size(), arguments.size()));
    std::optional<std::size_t> count;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (is_array(signature.inputs[i])) continue;
        if (count.value_or(arguments[i].count) != arguments[i].count)
            throw std::logic_error(fmt::format("The arguments of {} differ in length.", function.name));
        count = arguments[i].count;
    }
    if (!count) throw std::logic_error(fmt::format("{} has no argument with one value per element.", function.name));
    return *count;
}

// The arguments one after the other; where each begins, in words, is a multiple of the largest alignment.
struct PackedArguments {
    std::vector<std::uint32_t> words, offsets;
};

PackedArguments pack(const std::vector<DeviceArgument>& arguments)
{
    constexpr std::size_t ALIGNMENT = 32;
    PackedArguments packed;
    for (const DeviceArgument& argument : arguments) {
        packed.offsets.push_back(static_cast<std::uint32_t>(packed.words.size()));
        packed.words.insert(packed.words.end(), argument.words.begin(), argument.words.end());
        packed.words.resize((packed.words.size() + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
    }
    return packed;
}

std::vector<std::vector<std::uint32_t>> split(const std::vector<std::uint32_t>& words, std::size_t parts)
{
    const std::size_t size = parts ? words.size() / parts : 0;
    std::vector<std::vector<std::uint32_t>> outputs;
    for (std::size_t i = 0; i < parts; ++i)
        outputs.emplace_back(words.data() + i * size, words.data() + (i + 1) * size);
    return outputs;
}
} // namespace

void release_device_functions()
{
    built_programs().clear();
}

DeviceFunctions::DeviceFunctions(std::vector<std::string> parts, std::vector<DeviceFunction> functions,
                                 std::string definitions, Specialization features)
    : parts_(std::move(parts)), functions_(std::move(functions)), definitions_(std::move(definitions)),
      features_(features)
{
}

DeviceFunctions::~DeviceFunctions()
{
    // A table that goes takes its programs along: another table may get its address.
    std::erase_if(built_programs(), [&](const auto& entry) { return std::get<0>(entry.first) == this; });
}

std::string DeviceFunctions::source() const
{
    std::string text = "#include \"math/lanes.h\"\n#include \"shared/structs.h\"\n";
    text += FLOAT_WORDS;
    for (const std::string& part : parts_) text += fmt::format("#include \"{}\"\n", part);
    text += definitions_ + '\n';
    for (const DeviceFunction& function : functions_) text += kernel_text(function);
    return text;
}

DeviceResults DeviceFunctions::evaluate(const Device& device, const std::string& name,
                                        const std::vector<DeviceArgument>& arguments, std::uint32_t lanes) const
{
    const auto function =
        std::find_if(functions_.begin(), functions_.end(), [&](const DeviceFunction& f) { return f.name == name; });
    if (function == functions_.end()) throw std::logic_error("There is no device function " + name + ".");
    const Signature signature = parse_signature(function->signature);
    const std::size_t count = element_count(*function, signature, arguments);

    // Build the program at its first use.
    Specialization features = features_;
    const std::uint32_t suitable = features.precision == Precision::fp64 ? 1 : device.preferred_lanes();
    features.lanes = lanes ? lanes : suitable;
    Programs& programs = built_programs();
    const auto key = std::tuple(this, &device, features.lanes);
    if (!programs.contains(key))
        programs.emplace(key, Program::from_text(device, parts_.empty() ? "functions" : "functions of " + parts_.back(),
                                                 source(), features.build_options()));
    Kernel kernel(programs.at(key), "call_" + name);

    // Put all arguments into one buffer, and read all outputs from another.
    const PackedArguments packed = pack(arguments);
    const Buffer<std::uint32_t> offsets(device, "offsets", packed.offsets);
    const Buffer<std::uint32_t> words(device, "arguments", packed.words);
    const Buffer<std::uint32_t> results(device, "results", signature.outputs.size() * count);
    // One item a group on a CPU: PoCL keeps the private arrays of a whole group on one thread's stack.
    const std::size_t local_size = device.is_cpu() ? 1 : 0;
    kernel.run((count + features.lanes - 1) / features.lanes, local_size, static_cast<std::uint32_t>(count), offsets,
               words, results);
    return {split(results.read(), signature.outputs.size())};
}
} // namespace etendue
