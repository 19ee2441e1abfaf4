// What files of a picture's points may leave out, and who has them may know: how large the picture was, and
// how much its camera's lens showed.
#pragma once

#include <optional>
#include <string_view>

#include "core/motion.h"

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
// height, as MediaPipe writes them and OpenPose if asked to, are brought to it. Nine of ten points that are
// seen have places from 0 to 1 then, and none is beyond 4. Without a size such points are left out beside a
// body in space, which a note says. Throws Error if
// - shares are all that there is, and no size is known,
// - a hint is set and there is no picture, or the file tells another size,
// - a tenth of the points lies outside of a picture of that size,
// - a field of view is set without a size.
Motion with_picture_hints(Motion motion, const PictureHints& hints);

}  // namespace chironomia
