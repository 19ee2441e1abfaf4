#include "tests/support/numpy_files.h"

#include <cstdint>
#include <cstring>

#include "core/files/files.h"
#include "core/text.h"

namespace chironomia::testing {

namespace {

std::string npy_of(const std::vector<std::size_t>& shape, const std::vector<double>& numbers) {
    const std::string header =
        format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}\n", fmt::join(shape, ", "));
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 255);
    bytes += static_cast<char>(header.size() >> 8);
    bytes += header;
    const std::size_t begin = bytes.size();
    bytes.resize(begin + numbers.size() * sizeof(double));
    std::memcpy(bytes.data() + begin, numbers.data(), numbers.size() * sizeof(double));
    return bytes;
}

// The check sum of ZIP.
std::uint32_t crc32_of(const std::string& bytes) {
    std::uint32_t sum = 0xFFFFFFFFu;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0);
    }
    return ~sum;
}

// Little-endian.
std::string number_of(std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 255);
    return text;
}

}  // namespace

void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               const std::vector<double>& numbers) {
    write_text(file, npy_of(shape, numbers));
}

void write_npz(const std::filesystem::path& file, const std::vector<NamedNumbers>& arrays) {
    std::string files, directory;
    for (const NamedNumbers& array : arrays) {
        const std::string name = array.name + ".npy", bytes = npy_of(array.shape, array.numbers);
        // Version, flags, method, time, date, check sum, both sizes, length of the name, and none of extras.
        const std::string about = number_of(20, 2) + number_of(0, 8) + number_of(crc32_of(bytes), 4) +
                                  number_of(bytes.size(), 4) + number_of(bytes.size(), 4) +
                                  number_of(name.size(), 2) + number_of(0, 2);
        directory +=
            "PK\x01\x02" + number_of(20, 2) + about + number_of(0, 10) + number_of(files.size(), 4) + name;
        files += "PK\x03\x04" + about + name + bytes;
    }
    write_text(file, files + directory + "PK\x05\x06" + number_of(0, 4) + number_of(arrays.size(), 2) +
                         number_of(arrays.size(), 2) + number_of(directory.size(), 4) +
                         number_of(files.size(), 4) + number_of(0, 2));
}

}  // namespace chironomia::testing
