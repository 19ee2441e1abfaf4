// Biovision hierarchies (.bvh): any joint names, any channels in any order, with or without End Sites.
//
// Channels turn a joint in the order in which they are listed, the first one outermost. Tools disagree about
// position channels: Blender's importer (io_anim_bvh, import_bvh.py) lets them replace OFFSET, three.js
// (BVHLoader.js) adds them to it. Here they replace it, unless the file itself shows that it means the other:
// the positions of all joints below the root stay nearer to zero than to their OFFSET, or those of the root
// leave out the height that its OFFSET has. Then they are added, and a note says so.
//
// An End Site becomes a joint named after its parent, "Head_end", that never turns.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/body/motion.h"

namespace chironomia {

// The motion in the file's own axes and units, its notes beginning with the dialect.
//   where   the file's name, for messages
//   fps     instead of the Frame Time in the file
// Throws Error with the line if the text is no BVH of one figure, is broken or truncated, or its rate is not within 1
// to 1000 frames/s.
Motion parse_bvh(std::string_view text, const std::string& where, std::optional<double> fps = {});

// Centimetres, rotations Z X Y, the root's OFFSET 0 so that no reader can add it twice, joints with a moving
// or scaled place get six channels, all others three. The world directions and places are those of `motion`
// whatever the rest pose's own turns; joints named like an End Site become one. Throws Error if the motion
// has no joints or the file cannot be written.
void write_bvh(const std::filesystem::path& file, const Motion& motion);

}  // namespace chironomia
