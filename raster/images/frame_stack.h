// Numbered pictures in a folder: "out/%05d.png" and the frames that lie there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/render/frame.h"

namespace chironomia {

// A folder and a file name with one number in it.
struct FrameStack {
    std::filesystem::path folder;
    std::string before;  // the number
    int digits = 0;      // at least, filled with zeros
    std::string after;   // the number, with the ending

    std::filesystem::path file(size_t index) const;
};

// Whether the path asks for a stack: it has a "%" in its file name.
bool is_stack_pattern(const std::filesystem::path& pattern);

// "out/frame_%04d.png". Throws Error unless the file name has exactly one number (%d, %5d or %05d; "%%" is a
// percent sign) and ends in .png or .exr.
FrameStack parse_stack_pattern(const std::filesystem::path& pattern);

// The folder's .png and .exr files by the number that ends their names. Throws Error if there is none, if a
// number is missing between the first and the last, or if a number occurs twice.
std::vector<std::filesystem::path> list_stack(const std::filesystem::path& folder);

}  // namespace chironomia
