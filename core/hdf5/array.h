// The arrays of an HDF5 file; part of core/hdf5/file.h.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct Hdf5Array {
    std::vector<size_t> shape;       // () for a scalar
    std::vector<double> numbers;     // in C order; empty if it holds none
    std::vector<std::string> texts;  // in C order, also sequences of bytes; empty if it holds none
    bool is_text = false;
};

// The messages that describe an array; a missing one is empty.
struct Hdf5ArrayHeader {
    std::span<const std::byte> space;
    std::span<const std::byte> type;
    std::span<const std::byte> layout;
    std::span<const std::byte> filters;
};

struct Hdf5Place {
    std::span<const std::byte> file;
    std::string where;  // the file's name
    std::string path;   // of the array, for messages
};

// Throws Error that begins with the place.
[[noreturn]] void refuse(const Hdf5Place& place, std::string_view message);

// Throw Error if the array is broken, or kept in a form that is not read.
std::vector<size_t> hdf5_shape(const Hdf5ArrayHeader& header, const Hdf5Place& place);
Hdf5Array read_hdf5_array(const Hdf5ArrayHeader& header, const Hdf5Place& place);

// The one number or text in the message of an attribute, if that is its name.
std::optional<Hdf5Array> hdf5_attribute(std::span<const std::byte> message, std::string_view name,
                                        const Hdf5Place& place);

}  // namespace chironomia
