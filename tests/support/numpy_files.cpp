#include "tests/support/numpy_files.h"

#include <cstring>

#include "core/files.h"
#include "core/text.h"

namespace chironomia::testing {

void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               const std::vector<double>& numbers) {
    const std::string header =
        format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}\n", fmt::join(shape, ", "));
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 255);
    bytes += static_cast<char>(header.size() >> 8);
    bytes += header;
    const std::size_t begin = bytes.size();
    bytes.resize(begin + numbers.size() * sizeof(double));
    std::memcpy(bytes.data() + begin, numbers.data(), numbers.size() * sizeof(double));
    write_text(file, bytes);
}

}  // namespace chironomia::testing
