// SHA-256 and its keyed form, as lower-case hexadecimal.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace chironomia {

std::string sha256(std::string_view bytes);
std::string sha256(std::span<const std::byte> bytes);

// Throws Error if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

// HMAC-SHA-256 (RFC 2104). `key` may have any length. Without it the text cannot be found from the result, not even by
// trying likely texts.
std::string keyed_sha256(std::string_view key, std::string_view text);

}  // namespace chironomia
