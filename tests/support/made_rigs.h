// The joints of other people's rigs, for avatars that are made for tests (made_avatars.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace chironomia::testing {

// Parents first, as in our own avatars.
struct Rig {
    // Ours, theirs; joints of ours without a name fall to the nearest one above that has one.
    std::vector<std::pair<std::string, std::string>> names{};
    bool along_bones = false;  // +y of a joint points to its first child
    bool z_up = false;
    // Each mesh gets a name out of these and hangs in a group with another one; empty: they stay as they are.
    std::vector<std::string> groups{};
};

// The word with a capital first letter.
std::string capital(std::string word);

Rig mixamo_rig(const std::string& prefix);
Rig makehuman_rig();
Rig numbered_rig();
Rig sumerian_rig();  // meshes have the names of parts
Rig rigify_rig();
Rig biped_rig();  // 3ds Max; meshes have the names of joints

}  // namespace chironomia::testing
