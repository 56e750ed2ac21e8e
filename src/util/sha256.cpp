// SHA-256 by OpenSSL.
#include "util/sha256.h"

#include "util/error.h"

#include <openssl/evp.h>

#include <array>

namespace etendue
{
std::string sha256(std::string_view data)
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (EVP_Digest(data.data(), data.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
        throw Error("OpenSSL could not compute a SHA-256 digest.", ExitCode::check);

    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
        text += "0123456789abcdef"[digest[i] >> 4];
        text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
}
} // namespace etendue
