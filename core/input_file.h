// Whether a path names a file that can be read.
#pragma once

#include <filesystem>

namespace chironomia {

// Throws Error if the file is missing, is a folder, a pointer of Git LFS to a file that was not fetched, or a pipe or a
// device, which can be read only once; or if the system cannot follow the path: a name is too long, links run in a
// circle, a folder may not be entered.
void expect_file(const std::filesystem::path& file);

}  // namespace chironomia
