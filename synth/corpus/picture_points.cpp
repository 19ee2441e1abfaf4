#include "synth/corpus/picture_points.h"

#include "core/math.h"
#include "core/quantile.h"
#include "synth/corpus/records.h"

namespace chironomia {

std::optional<float> shoulder_width(const PicturePoints& pose) {
    constexpr std::size_t kJoints = IntervalRecord::kJoints, kRight = 1, kLeft = 4;
    std::vector<float> widths;
    for (std::size_t first = 0; first < pose.places.size(); first += 2 * kJoints) {
        const auto place = [&](std::size_t joint) {
            return Vec2(pose.places[first + joint], pose.places[first + kJoints + joint]);
        };
        if (pose.confidence[first + kRight] > 0 && pose.confidence[first + kLeft] > 0)
            widths.push_back(distance(place(kRight), place(kLeft)));
    }
    if (widths.empty()) return std::nullopt;
    return median(std::move(widths));
}

std::vector<float> with_equal_shoulders(std::vector<float> places, float width) {
    constexpr float kShoulders = 100;  // [px]
    for (float& value : places) value *= kShoulders / width;
    return places;
}

}  // namespace chironomia
