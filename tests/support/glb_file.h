// A GLB taken apart and put together again, so that tests can write avatars as other programs do.
#pragma once

#include <filesystem>
#include <string>

#include "core/files/json.h"

namespace chironomia::testing {

struct Glb {
    Json json;
    std::string binary;  // buffer 0
};

// Of one of our own avatars: nothing is checked.
Glb read_glb(const std::filesystem::path& file);

// Buffer 0 becomes as long as `binary`; further buffers stay as the JSON has them.
void write_glb(const std::filesystem::path& file, Glb glb);

// Where the data of an accessor begins in `binary`.
std::size_t start_of(const Glb& glb, const Json& accessor);

}  // namespace chironomia::testing
