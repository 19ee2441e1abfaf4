// Little-endian numbers out of bytes that may end early.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace chironomia {

// Reads on from byte to byte of a piece of an HDF5 file.
class Hdf5Cursor {
  public:
    //   where   the file's name, for messages
    Hdf5Cursor(std::span<const std::byte> bytes, const std::string& where) : rest_(bytes), where_(&where) {}

    // Throw Error if less is left.
    std::uint64_t number(size_t size);  // of 1 to 8 bytes
    std::span<const std::byte> take(std::uint64_t size);
    std::string_view text(std::uint64_t size);
    void skip(std::uint64_t size) { take(size); }
    // Throws Error unless `signature` comes next.
    void expect(std::string_view signature);

    size_t left() const { return rest_.size(); }

  private:
    std::span<const std::byte> rest_;
    const std::string* where_;
};

// An address or a length that says that there is none.
inline constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

// From byte `address` on. Throws Error if it lies behind the end.
Hdf5Cursor hdf5_at(std::span<const std::byte> file, std::uint64_t address, const std::string& where);

// The Error of a file whose structure makes no sense.
[[noreturn]] void refuse_damage(const std::string& where, std::string_view what);

// Bob Jenkins' lookup3 hash, which guards the headers of the newer layouts.
std::uint32_t hdf5_checksum(std::span<const std::byte> bytes);

}  // namespace chironomia
