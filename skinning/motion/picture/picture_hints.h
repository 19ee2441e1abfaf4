// What files of a picture's points may leave out, and the user can give: the size of the picture, and the
// field of view of its camera.
#pragma once

#include <optional>
#include <string_view>

#include "core/body/motion.h"

namespace chironomia {

struct PictureHints {
    std::optional<Vec2> size{};             // [px]
    std::optional<double> field_of_view{};  // across the longer side [deg]
};

// "1280x720", each side from 16 to 16384. Throws Error otherwise.
Vec2 picture_size_named(std::string_view text);
// Degrees from 5 to 160. Throws Error otherwise.
double field_of_view_named(std::string_view text);

// The same motion with its picture in pixels as far as its size is known: points that are shares of width and
// height, as MediaPipe writes them and OpenPose if asked to, are brought to it; none has a place beyond 4
// then. Where no size is known, points are taken for such shares if nine of ten lie from 0 to 4, and
// half from 0 to 1; beside a body in space they are left out, which a note says. Throws Error if
// - such shares are all that there is, and no size is known,
// - a hint is set and there is no picture, or the file has another size,
// - a tenth of the points that are seen surely lies outside of a picture of the size that is set,
// - a field of view is set without a size.
Motion with_picture_hints(Motion motion, const PictureHints& hints);

}  // namespace chironomia
