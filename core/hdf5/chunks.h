// Arrays of an HDF5 file that are kept in chunks; part of core/hdf5/file.h.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/hdf5/array.h"
#include "core/hdf5/bytes.h"

namespace chironomia {

struct Hdf5Filter {
    unsigned id = 0;
    std::vector<size_t> values;
};

struct Hdf5Chunked {
    std::vector<size_t> shape;        // of the array
    size_t element = 0;               // bytes of one element
    Hdf5Cursor layout;                // the layout message behind its class
    unsigned version = 3;             // of that message
    std::vector<Hdf5Filter> filters;  // in the order in which they were applied
};

// The filters of a pipeline message. Throws Error for one that is not read.
std::vector<Hdf5Filter> hdf5_filters(std::span<const std::byte> message, const Hdf5Place& place);

// All elements, in C order. Throws Error if chunks are missing, broken or kept in a way that is not read.
std::vector<std::byte> read_hdf5_chunks(const Hdf5Chunked& chunked, const Hdf5Place& place);

}  // namespace chironomia
