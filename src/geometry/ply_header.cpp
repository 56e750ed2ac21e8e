// The declarations of a PLY header, checked one by one.
#include "geometry/ply_header.h"

#include "geometry/text_scanner.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace etendue
{
namespace
{
struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr std::array<TypeName, 16> TYPE_NAMES = {{{"char", PlyType::int8},
                                                  {"int8", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"uint8", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"int16", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"int32", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"float32", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"float64", PlyType::float64}}};

class HeaderParser
{
public:
    HeaderParser(std::string_view bytes, const std::string& file) : scanner_(bytes), file_(file) {}

    PlyHeader parse()
    {
        scanner_.next_line();
        for (std::string_view keyword; keyword != "end_header";) {
            if (!scanner_.next_line()) fail("the header ends without \"end_header\".");
            keyword = scanner_.next_word();
            parse_declaration(keyword);
        }
        if (!has_format_) fail("the header has no \"format\" line.");
        header_.body = scanner_.rest();
        header_.lines = scanner_.line_number();
        return std::move(header_);
    }

private:
    void parse_declaration(std::string_view keyword)
    {
        if (keyword == "format")
            parse_format();
        else if (keyword == "element")
            parse_element();
        else if (keyword == "property")
            parse_property();
        else if (keyword != "comment" && keyword != "obj_info" && keyword != "end_header" && !keyword.empty())
            fail(fmt::format("expected format, element, property, comment, obj_info or end_header, found {}.",
                             quote(keyword)));
    }

    void parse_format()
    {
        const std::string_view name = scanner_.next_word();
        const std::string_view version = scanner_.next_word();
        if (name == "ascii")
            header_.encoding = PlyEncoding::text;
        else if (name == "binary_little_endian")
            header_.encoding = PlyEncoding::binary_little_endian;
        else if (name == "binary_big_endian")
            header_.encoding = PlyEncoding::binary_big_endian;
        else
            fail(fmt::format("format {} is not known; there are: ascii, binary_little_endian, binary_big_endian.",
                             quote(name)));
        if (version != "1.0") fail(fmt::format("PLY version {} is not known; there is 1.0.", quote(version)));
        has_format_ = true;
    }

    void parse_element()
    {
        PlyElement element;
        element.name = scanner_.next_word();
        const std::string_view word = scanner_.next_word();
        const auto count = parse_integer(word);
        if (element.name.empty() || !count || *count < 0)
            fail(fmt::format("expected \"element NAME COUNT\" with a whole number, found {}.", quote(word)));
        for (const PlyElement& other : header_.elements)
            if (other.name == element.name) fail(fmt::format("element {} is declared twice.", quote(element.name)));
        element.count = static_cast<std::uint64_t>(*count);
        header_.elements.push_back(std::move(element));
    }

    void parse_property()
    {
        if (header_.elements.empty()) fail("a property comes before the first element.");
        PlyProperty property;
        std::string_view type = scanner_.next_word();
        if (type == "list") {
            property.is_list = true;
            property.count_type = parse_type(scanner_.next_word());
            if (!is_integer(property.count_type)) fail("the number of items of a list must have an integer type.");
            type = scanner_.next_word();
        }
        property.type = parse_type(type);
        property.name = scanner_.next_word();
        if (property.name.empty()) fail("expected the name of the property, found the end of the line.");
        PlyElement& element = header_.elements.back();
        for (const PlyProperty& other : element.properties)
            if (other.name == property.name) fail(fmt::format("property {} is declared twice.", quote(property.name)));
        element.properties.push_back(std::move(property));
    }

    PlyType parse_type(std::string_view word) const
    {
        const auto found = std::find_if(TYPE_NAMES.begin(), TYPE_NAMES.end(),
                                        [&](const TypeName& candidate) { return candidate.name == word; });
        if (found == TYPE_NAMES.end())
            fail(fmt::format("type {} is not known; there are: char, uchar, short, ushort, int, uint, float, double, "
                             "int8, uint8, int16, uint16, int32, uint32, float32, float64.",
                             quote(word)));
        return found->type;
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        throw FileError(fmt::format("{}:{}", file_, scanner_.line_number()), message);
    }

    TextScanner scanner_;
    const std::string& file_;
    PlyHeader header_;
    bool has_format_ = false;
};
} // namespace

std::size_t size_of(PlyType type)
{
    constexpr std::array<std::size_t, 8> SIZES = {1, 1, 2, 2, 4, 4, 4, 8};
    return SIZES[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type)
{
    return type != PlyType::float32 && type != PlyType::float64;
}

std::size_t PlyElement::least_size(PlyEncoding encoding) const
{
    // In a text a number takes a digit and what ends it; the last one of the file may lack the latter.
    std::size_t size = 0;
    for (const PlyProperty& property : properties)
        size += encoding == PlyEncoding::text ? 2 : size_of(property.is_list ? property.count_type : property.type);
    return size;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file)
{
    return HeaderParser(bytes, file).parse();
}
} // namespace etendue
