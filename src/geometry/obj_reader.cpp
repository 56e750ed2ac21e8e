// One pass over the lines of an OBJ file.
#include "geometry/obj_reader.h"

#include "geometry/text_scanner.h"
#include "math/shared.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace etendue
{
namespace
{
// Statements that change nothing about the triangles.
constexpr std::array<std::string_view, 17> SKIPPED = {"vt",       "vp",     "g",      "o",      "s",         "mg",
                                                      "usemtl",   "mtllib", "l",      "p",      "bevel",     "c_interp",
                                                      "d_interp", "lod",    "usemap", "maplib", "shadow_obj"};

class ObjParser
{
public:
    ObjParser(std::string_view text, const std::string& file) : scanner_(text), file_(file) {}

    PolygonMesh parse()
    {
        mesh_.first_index = 1;
        while (scanner_.next_line()) parse_statement(scanner_.next_word());
        if (unknown_ > 0)
            mesh_.warnings.push_back(fmt::format("{}:{}: statement {} is not known and was skipped; so were {} others.",
                                                 file_, first_unknown_line_, quote(first_unknown_), unknown_ - 1));
        return std::move(mesh_);
    }

private:
    void parse_statement(std::string_view keyword)
    {
        if (keyword == "v")
            mesh_.positions.push_back(parse_vector());
        else if (keyword == "vn")
            mesh_.normals.push_back(parse_vector());
        else if (keyword == "f")
            parse_face();
        else if (!keyword.empty() && keyword[0] != '#' &&
                 std::find(SKIPPED.begin(), SKIPPED.end(), keyword) == SKIPPED.end())
            note_unknown(keyword);
    }

    // Three numbers; what follows (w, a colour) must be numbers, too.
    Vec3 parse_vector()
    {
        const double x = parse_number(scanner_.next_word());
        const double y = parse_number(scanner_.next_word());
        const double z = parse_number(scanner_.next_word());
        for (std::string_view word = scanner_.next_word(); !word.empty() && word[0] != '#'; word = scanner_.next_word())
            parse_number(word);
        return {x, y, z};
    }

    double parse_number(std::string_view word)
    {
        if (word.empty()) fail("expected three numbers, found the end of the line.");
        const auto value = parse_real(word);
        if (!value) fail(fmt::format("expected a number with a decimal point, found {}.", quote(word)));
        return *value;
    }

    void parse_face()
    {
        std::uint32_t size = 0, with_normal = 0;
        for (std::string_view word = scanner_.next_word(); !word.empty() && word[0] != '#';
             word = scanner_.next_word()) {
            with_normal += parse_corner(word) ? 1 : 0;
            ++size;
        }
        if (with_normal != 0 && with_normal != size) fail("some corners of the face have a normal and some have none.");
        mesh_.sizes.push_back(size);
        mesh_.lines.push_back(static_cast<std::uint32_t>(
            std::min<std::size_t>(scanner_.line_number(), std::numeric_limits<std::uint32_t>::max())));
    }

    // i, i/j, i//k or i/j/k; whether it has a normal.
    bool parse_corner(std::string_view word)
    {
        const std::size_t first = word.find('/');
        const std::size_t second = first == std::string_view::npos ? first : word.find('/', first + 1);
        const std::string_view texture =
            first == std::string_view::npos ? std::string_view() : word.substr(first + 1, second - first - 1);
        if (!texture.empty() && !parse_integer(texture)) fail_corner(word);
        if (texture.empty() && first != std::string_view::npos && second == std::string_view::npos) fail_corner(word);
        mesh_.corners.push_back(resolve(word, word.substr(0, first), mesh_.positions.size(), "vertex"));
        const bool has_normal = second != std::string_view::npos;
        mesh_.normal_corners.push_back(
            has_normal ? resolve(word, word.substr(second + 1), mesh_.normals.size(), "normal") : NO_INDEX);
        return has_normal;
    }

    // From the file's numbering (from 1, or back from the last one so far) to ours from 0.
    std::uint32_t resolve(std::string_view corner, std::string_view number, std::size_t count, const char* what)
    {
        const auto index = parse_integer(number);
        if (!index) fail_corner(corner);
        const auto limit = static_cast<std::int64_t>(NO_INDEX);
        const auto known = static_cast<std::int64_t>(count);
        if (*index == 0 || *index < -known || *index > limit)
            fail(fmt::format("face {} uses {} {}, but there are {} so far, numbered from 1.", mesh_.sizes.size() + 1,
                             what, *index, count));
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index);
    }

    void note_unknown(std::string_view keyword)
    {
        if (unknown_++ > 0) return;
        first_unknown_ = keyword;
        first_unknown_line_ = scanner_.line_number();
    }

    [[noreturn]] void fail_corner(std::string_view word) const
    {
        fail(fmt::format("expected a corner such as 1, 1/2, 1//3 or 1/2/3, found {}.", quote(word)));
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        throw FileError(fmt::format("{}:{}", file_, scanner_.line_number()), message);
    }

    TextScanner scanner_;
    const std::string& file_;
    PolygonMesh mesh_;
    std::size_t unknown_ = 0;
    std::string_view first_unknown_;
    std::size_t first_unknown_line_ = 0;
};
} // namespace

PolygonMesh parse_obj(std::string_view text, const std::string& file)
{
    return ObjParser(text, file).parse();
}
} // namespace etendue
