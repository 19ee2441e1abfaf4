// NumPy's array files: .npy (versions 1 to 3) and .npz, stored or compressed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace chironomia {

struct NumpyArray {
    std::string name;                // its key in the .npz, "" for a .npy
    std::string type;                // NumPy's code, "<f4"
    std::vector<size_t> shape;       // () for a scalar
    std::vector<double> numbers;     // in C order; empty if the array holds no real numbers
    std::vector<std::string> texts;  // in C order; empty if the array holds no text (U or S)
};

bool is_npy(std::span<const std::byte> bytes);
bool is_zip(std::span<const std::byte> bytes);

// Any byte order and any memory order; bool, integers, float16 to float64. Arrays of other types come with
// shape and type alone.
//   where   the file's name, for messages
// Throws Error if the array is broken or truncated, or if all arrays of the file hold more than 2^26 numbers,
// or more than 2^23 and 64 for each byte of the file: what an archive of a few bytes unpacks to is no motion.
NumpyArray parse_npy(std::span<const std::byte> bytes, const std::string& where);

// Throws Error if the archive is broken, and as parse_npy.
std::vector<NumpyArray> parse_npz(std::span<const std::byte> bytes, const std::string& where);

// "poses (150, 165)"
std::string describe(const NumpyArray& array);

}  // namespace chironomia
