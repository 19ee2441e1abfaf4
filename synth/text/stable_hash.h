// A number for a text that is the same on every machine.
#pragma once

#include <cstdint>
#include <string_view>

namespace chironomia {

// FNV-1a of 64 bits (Fowler, Noll, Vo).
constexpr std::uint64_t stable_hash(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char byte : bytes) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001b3ull;
    }
    return hash;
}

}  // namespace chironomia
