// Biovision hierarchies (.bvh): any joint names, any channels in any order, with or without End Sites.
//
// Channels turn a joint in the order in which they are listed, the first one outermost. Position channels of
// the root replace its OFFSET; those of other joints replace it too, unless the whole file keeps them near
// zero, as some exporters do that write them relative to OFFSET: then they are added, and a note says so. A
// root whose positions leave out an OFFSET that stands far from the origin is read in the same way.
//
// An End Site becomes a joint named after its parent, "Head_end", that never turns.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/motion.h"

namespace chironomia {

// The motion in the file's own axes and units, its notes beginning with the dialect.
//   where   the file's name, for messages
//   fps     instead of the Frame Time in the file
// Throws Error with the line if the text is no BVH of one figure, or is broken or truncated.
Motion parse_bvh(std::string_view text, const std::string& where, std::optional<double> fps = {});

// Centimetres, rotations Z X Y, joints with a moving or scaled place get six channels, all others three. The
// world directions and places are those of `motion` whatever the rest pose's own turns; joints named like an
// End Site become one. Throws Error if the motion has no joints or the file cannot be written.
void write_bvh(const std::filesystem::path& file, const Motion& motion);

}  // namespace chironomia
