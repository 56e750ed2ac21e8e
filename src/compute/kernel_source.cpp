// The include expander: one text per program, every file once, with #line directives for the compiler's messages.
#include "compute/kernel_source.h"

#include "math/shared.h"
#include "util/environment.h"
#include "util/error.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// bsdf/all.h: one include per line of BSDF_LIST.
std::string every_bsdf()
{
    std::string text = "#pragma once\n";
#define INCLUDE_BSDF(NAME, name, description) text += "#include \"bsdf/" #name ".h\"\n";
    BSDF_LIST(INCLUDE_BSDF)
#undef INCLUDE_BSDF
    return text;
}

std::optional<std::string> overriding_file(const std::string& name)
{
    const std::string folder = environment("ETENDUE_CL_DIR");
    if (folder.empty()) return {};
    std::ifstream stream(std::filesystem::path(folder) / name, std::ios::binary);
    if (!stream) return {};
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

std::optional<std::string> embedded_file(const std::string& name)
{
    const auto& files = embedded_files();
    const auto found = std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& f) { return f.name == name; });
    if (found == files.end()) return {};
    return std::string(found->text);
}

// What follows `#directive` in the line, without blanks around, or nothing when the line is something else.
std::optional<std::string_view> directive_operand(std::string_view line, std::string_view directive)
{
    const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size())); };
    skip_blanks();
    if (!line.starts_with('#')) return {};
    line.remove_prefix(1);
    skip_blanks();
    if (!line.starts_with(directive)) return {};
    line.remove_prefix(directive.size());
    skip_blanks();
    return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

// "x" of a line `#include "x"`; nothing for any other line, `#include <x>` too.
std::optional<std::string> included_name(std::string_view line)
{
    const auto operand = directive_operand(line, "include");
    if (!operand || !operand->starts_with('"')) return {};
    const auto end = operand->find('"', 1);
    if (end == std::string_view::npos) return {};
    return std::string(operand->substr(1, end - 1));
}

class Expander
{
public:
    void append(const std::string& shown_name, std::string_view text)
    {
        append_line_directive(1, shown_name);
        int number = 0;
        while (!text.empty()) {
            const auto end = std::min(text.find('\n'), text.size());
            append_line(shown_name, ++number, text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }
    const std::string& text() const { return text_; }

private:
    void append_line(const std::string& shown_name, int number, std::string_view line)
    {
        const auto name = included_name(line);
        if (name && included_.insert(*name).second) {
            append("cl/" + *name, kernel_file(*name, fmt::format("{}:{}", shown_name, number)));
            append_line_directive(number + 1, shown_name);
        } else {
            // What goes leaves an empty line, so that the numbers of the lines below stay right.
            if (!name && directive_operand(line, "pragma") != "once") text_ += line;
            text_ += '\n';
        }
    }

    void append_line_directive(int number, const std::string& shown_name)
    {
        text_ += fmt::format("#line {} \"{}\"\n", number, shown_name);
    }

    std::string text_ = "#pragma OPENCL FP_CONTRACT OFF\n";
    std::set<std::string> included_;
};
} // namespace

std::string kernel_file(const std::string& name, const std::string& included_from)
{
    if (name == "bsdf/all.h") return every_bsdf();
    if (auto text = overriding_file(name)) return *text;
    if (auto text = embedded_file(name)) return *text;
    if (included_from.empty()) throw BuildError(fmt::format("There is no kernel source cl/{}.", name));
    throw BuildError(fmt::format("{}: there is no file cl/{} to include.", included_from, name));
}

std::string expand_program(const std::string& name)
{
    return expand_source("cl/" + name, kernel_file(name));
}

std::string expand_source(const std::string& name, const std::string& text)
{
    Expander expander;
    expander.append(name, text);
    return expander.text();
}
} // namespace etendue
