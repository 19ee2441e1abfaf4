// Files of Autodesk's FBX, which are not read: what they are, and how they become glTF.
#pragma once

#include <filesystem>
#include <string_view>

namespace chironomia {

// Throws Error if the content of `file` is FBX, binary or as text: which version it is, and the command line of a
// program that makes glTF of it. Does nothing for other files.
void refuse_fbx(const std::filesystem::path& file, std::string_view content);

}  // namespace chironomia
