#include "core/hash.h"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <cassert>
#include <fstream>
#include <memory>

#include "core/error.h"
#include "core/input_file.h"
#include "core/text.h"

namespace chironomia {
namespace {

using Digest = std::array<unsigned char, 32>;

std::string to_hex(const Digest& digest) {
    std::string hex;
    for (const unsigned char byte : digest) hex += format("{:02x}", byte);
    return hex;
}

const unsigned char* as_bytes(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

std::string sha256(std::string_view bytes) {
    Digest digest{};
    const int done = EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
    assert(done == 1);
    return to_hex(digest);
}

std::string sha256(std::span<const std::byte> bytes) {
    return sha256(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

std::string sha256_of_file(const std::filesystem::path& file) {
    expect_file(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(format("{}: cannot be read; check the path", file.string()));
    }
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> state(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    int done = EVP_DigestInit_ex(state.get(), EVP_sha256(), nullptr);
    std::array<char, 1 << 16> block{};
    while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
        done &= EVP_DigestUpdate(state.get(), block.data(), static_cast<size_t>(stream.gcount()));
    }
    Digest digest{};
    done &= EVP_DigestFinal_ex(state.get(), digest.data(), nullptr);
    assert(done == 1);
    return to_hex(digest);
}

std::string keyed_sha256(std::string_view key, std::string_view text) {
    Digest digest{};
    const unsigned char* done = HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), as_bytes(text),
                                     text.size(), digest.data(), nullptr);
    assert(done == digest.data());
    return to_hex(digest);
}

}  // namespace chironomia
