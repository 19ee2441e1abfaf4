#include "core/hdf5/bytes.h"

#include <array>
#include <bit>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

using Lanes = std::array<std::uint32_t, 3>;

void mix(Lanes& lanes) {
    auto& [a, b, c] = lanes;
    const auto step = [](std::uint32_t& x, std::uint32_t& y, std::uint32_t z, int turn) {
        x -= y;
        x ^= std::rotl(y, turn);
        y += z;
    };
    step(a, c, b, 4);
    step(b, a, c, 6);
    step(c, b, a, 8);
    step(a, c, b, 16);
    step(b, a, c, 19);
    step(c, b, a, 4);
}

void finish(Lanes& lanes) {
    auto& [a, b, c] = lanes;
    const auto step = [](std::uint32_t& x, std::uint32_t y, int turn) {
        x ^= y;
        x -= std::rotl(y, turn);
    };
    step(c, b, 14);
    step(a, c, 11);
    step(b, a, 25);
    step(c, b, 16);
    step(a, c, 4);
    step(b, a, 14);
    step(c, b, 24);
}

void add(Lanes& lanes, std::span<const std::byte> bytes) {
    for (size_t i = 0; i < bytes.size(); ++i)
        lanes[i / 4] += static_cast<std::uint32_t>(bytes[i]) << (8 * (i % 4));
}

}  // namespace

void refuse_damage(const std::string& where, std::string_view what) {
    throw Error(
        format("{}: the HDF5 file is broken or truncated: {}; write it or get it again", where, what));
}

std::uint64_t Hdf5Cursor::number(size_t size) {
    std::uint64_t value = 0;
    const std::span<const std::byte> bytes = take(size);
    for (size_t i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
    return value;
}

std::span<const std::byte> Hdf5Cursor::take(std::uint64_t size) {
    if (size > rest_.size()) {
        refuse_damage(*where_, format("{} more bytes are expected where {} are left", size, rest_.size()));
    }
    const std::span<const std::byte> taken = rest_.first(static_cast<size_t>(size));
    rest_ = rest_.subspan(static_cast<size_t>(size));
    return taken;
}

std::string_view Hdf5Cursor::text(std::uint64_t size) {
    const std::span<const std::byte> bytes = take(size);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void Hdf5Cursor::expect(std::string_view signature) {
    if (text(signature.size()) != signature)
        refuse_damage(*where_, format("\"{}\" is not where it is expected", signature));
}

Hdf5Cursor hdf5_at(std::span<const std::byte> file, std::uint64_t address, const std::string& where) {
    if (address >= file.size()) {
        refuse_damage(where, format("it points to byte {} of {}", address, file.size()));
    }
    return {file.subspan(static_cast<size_t>(address)), where};
}

std::uint32_t hdf5_checksum(std::span<const std::byte> bytes) {
    Lanes lanes;
    lanes.fill(0xdeadbeef + static_cast<std::uint32_t>(bytes.size()));
    for (; bytes.size() > 12; bytes = bytes.subspan(12)) {
        add(lanes, bytes.first(12));
        mix(lanes);
    }
    if (bytes.empty()) return lanes[2];
    add(lanes, bytes);
    finish(lanes);
    return lanes[2];
}

}  // namespace chironomia
