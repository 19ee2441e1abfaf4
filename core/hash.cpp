#include "core/hash.h"

#include <sodium.h>

#include <array>
#include <fstream>

#include "core/error.h"
#include "core/input_file.h"
#include "core/text.h"

namespace chironomia {
namespace {

std::string to_hex(std::span<const unsigned char> digest) {
    std::string hex;
    for (const unsigned char byte : digest) hex += format("{:02x}", byte);
    return hex;
}

const unsigned char* as_bytes(const char* text) {
    return reinterpret_cast<const unsigned char*>(text);
}

}  // namespace

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256(digest.data(), as_bytes(bytes.data()), bytes.size());
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
    crypto_hash_sha256_state state;
    crypto_hash_sha256_init(&state);
    std::array<char, 1 << 16> block{};
    while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
        crypto_hash_sha256_update(&state, as_bytes(block.data()), static_cast<size_t>(stream.gcount()));
    }
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256_final(&state, digest.data());
    return to_hex(digest);
}

std::string keyed_sha256(std::string_view key, std::string_view text) {
    crypto_auth_hmacsha256_state state;
    crypto_auth_hmacsha256_init(&state, as_bytes(key.data()), key.size());
    crypto_auth_hmacsha256_update(&state, as_bytes(text.data()), text.size());
    std::array<unsigned char, crypto_auth_hmacsha256_BYTES> digest{};
    crypto_auth_hmacsha256_final(&state, digest.data());
    return to_hex(digest);
}

}  // namespace chironomia
