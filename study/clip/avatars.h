// The avatars that the program knows by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace chironomia::study {

// The names of the bundled avatars, in order.
std::vector<std::string> bundled_avatars();

// The avatar "stick" is none of a file: it is drawn from the motion (skinning/stick/stick.h).
bool is_stick(const std::filesystem::path& avatar);

inline constexpr const char* kDefaultAvatar = "neutral";

// What an avatar may be called: the bundled ones, and "stick".
std::vector<std::string> avatar_names();

// The file of an avatar given by path or by the name of a bundled one ("neutral").
// Throws Error naming the bundled ones if it is neither.
std::filesystem::path find_avatar(const std::filesystem::path& name_or_file);

}  // namespace chironomia::study
