// The text of located errors.
#include "util/error.h"

namespace etendue
{
namespace
{
bool starts_code_point(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u;
}

// The excerpt, and a caret below the byte `offset`: one column per code point, tabs and control characters as one
// space.
std::string excerpt_with_caret(const std::string& excerpt, std::size_t offset)
{
    std::string line, caret;
    for (std::size_t i = 0; i < excerpt.size(); ++i) {
        line += static_cast<unsigned char>(excerpt[i]) < 0x20u ? ' ' : excerpt[i];
        if (i < offset && starts_code_point(excerpt[i])) caret += ' ';
    }
    return "\n  " + line + "\n  " + caret + "^";
}
} // namespace

std::string without_control_characters(std::string text)
{
    for (char& c : text)
        if ((static_cast<unsigned char>(c) < 0x20u && c != '\n' && c != '\t') || c == 0x7f) c = '?';
    return text;
}

std::string format_located(const SourceLocation& where, const std::string& message)
{
    std::string text = where.file;
    if (where.line > 0) text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
    if (!text.empty()) text += ": ";
    if (!where.pointer.empty()) text += where.pointer + ": ";
    text += message;
    if (!where.excerpt.empty() && where.column >= where.excerpt_column)
        text += excerpt_with_caret(where.excerpt, static_cast<std::size_t>(where.column - where.excerpt_column));
    return text;
}
} // namespace etendue
