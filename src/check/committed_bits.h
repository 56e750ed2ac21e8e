// SHA-256 of what every device computes alike. They change only with the kernels that they are of: `etendue check
// device` shows what it found, in the note.
#pragma once

namespace etendue
{
inline constexpr const char* COMMITTED_PHILOX = "dd53477ca0a7184cdd91a46a8694a48050189c1e69dbd18c66ee29e5fac94246";
inline constexpr const char* COMMITTED_TREE = "acc9312421dad215392012fe91e4b4511238ebe417bc9f45ea8a3f237a39e167";
inline constexpr const char* COMMITTED_FILM = "936b816bb107227b8c5d824874b20514e06bf86e8a8d92792b4dba74e5992089";
} // namespace etendue
