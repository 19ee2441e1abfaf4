// NumPy's files, written by tests.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace chironomia::testing {

struct NamedNumbers {
    std::string name;  // "poses"
    std::vector<std::size_t> shape;
    std::vector<double> numbers;
};

// A .npy of doubles in C order.
void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               const std::vector<double>& numbers);

// A .npz of them, stored.
void write_npz(const std::filesystem::path& file, const std::vector<NamedNumbers>& arrays);

}  // namespace chironomia::testing
