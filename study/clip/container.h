// The outermost structure of MP4 and WebM files: enough to find where the pictures and the sound lie, and to
// make a file longer without changing what it shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace chironomia::study {

// A box of an MP4 file, or an element of a WebM file.
struct ContainerBox {
    std::string type;         // "moov"; of an element its id in hexadecimal: "1a45dfa3"
    std::uint64_t begin = 0;  // where its header begins      [bytes from the beginning of the file]
    std::uint64_t body = 0;   // where its content begins
    std::uint64_t end = 0;    // just behind it

    bool operator==(const ContainerBox&) const = default;
};

// The boxes of the outermost level, in the order of the file. The segment of a WebM file holds all that
// matters, so its own entry is its header alone and its elements follow it. Throws Error if the file is no
// MP4 or WebM, or if a box goes past the end of the file.
std::vector<ContainerBox> read_boxes(const std::filesystem::path& clip);

// The least number of bytes that pad_clip() can add.
inline constexpr std::uint64_t kLeastPadding = 16;

// Makes the file `size` bytes long by a last box that players skip: `free` in MP4, Void in WebM.
// `size` is at least kLeastPadding above what the file has. Throws Error if the file cannot be written.
void pad_clip(const std::filesystem::path& clip, std::uint64_t size);

}  // namespace chironomia::study
