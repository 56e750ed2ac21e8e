// SHA-256, for naming what was rendered and what was compiled.
#pragma once

#include <string>
#include <string_view>

namespace etendue
{
// The digest as 64 hexadecimal digits. Throws Error when the cryptographic library fails.
std::string sha256(std::string_view data);
} // namespace etendue
