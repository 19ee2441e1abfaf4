// One number out of the bytes of an array file, of whichever type and byte order.
#pragma once

#include <cstddef>
#include <string_view>

namespace chironomia {

// Reads the number that begins at a byte.
using ReadRawNumber = double (*)(const std::byte* bytes, bool swapped);

// The reader of a type by NumPy's code, such as "f4", "i8", "u1" or "b1" (float16 to float64, integers of 1
// to 8 bytes); nothing for another type. `swapped` is whether the most significant byte comes first.
ReadRawNumber raw_number_reader(std::string_view kind);

}  // namespace chironomia
