// The errors of etendue. The text of each is a complete message for the user; main() turns it into an exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace etendue
{
enum class ExitCode { success = 0, usage = 1, scene = 2, device = 3, file = 4, check = 5, interrupted = 130 };

// A place in a scene file: where an object was written, for errors found later.
struct SourceLocation {
    std::string file;       // as the user named it, or "command line" for -D
    int line = 0;           // from 1; 0: unknown
    int column = 0;         // from 1, in bytes
    std::string pointer;    // JSON path, e.g. /materials/2/roughness
    std::string excerpt;    // the line of the file, for the caret; of a long line only the part around the column
    int excerpt_column = 1; // column of the excerpt's first byte
};

// "scenes/glass.json:12:19: /materials/2/roughness: <message>", then the excerpt and a caret below the column.
std::string format_located(const SourceLocation& where, const std::string& message);

// The text with a question mark for each control character but line breaks and tabs: what a file says must neither end
// a message early nor steer the terminal.
std::string without_control_characters(std::string text);

class Error : public std::runtime_error
{
public:
    explicit Error(const std::string& text, ExitCode code)
        : std::runtime_error(without_control_characters(text)), code_(code)
    {
    }
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

struct UsageError : Error {
    explicit UsageError(const std::string& text) : Error(text, ExitCode::usage) {}
};

struct SceneError : Error {
    explicit SceneError(const std::string& text) : Error(text, ExitCode::scene) {}
    SceneError(const SourceLocation& where, const std::string& message)
        : Error(format_located(where, message), ExitCode::scene)
    {
    }
};

// An OpenCL call failed, or no usable device exists.
struct DeviceError : Error {
    explicit DeviceError(const std::string& text) : Error(text, ExitCode::device) {}
};

// A kernel did not compile; the text carries program, device, options and the compiler's log.
struct BuildError : Error {
    explicit BuildError(const std::string& text) : Error(text, ExitCode::device) {}
};

struct FileError : Error {
    FileError(const std::string& path, const std::string& message) : Error(path + ": " + message, ExitCode::file) {}
};
} // namespace etendue
