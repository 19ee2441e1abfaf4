// Our own motion files, exactly as they are stored.
#pragma once

#include "core/files/files.h"
#include "skinning/motion/motion_hdf5.h"

namespace chironomia::testing {

inline Motion read_motion_hdf5(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    return motion_of_hdf5(Hdf5File(bytes, file.string()));
}

}  // namespace chironomia::testing
