#include "synth/corpus/make/face.h"

#include <algorithm>
#include <cassert>

#include "synth/corpus/face_features.h"
#include "synth/corpus/make/noise.h"
#include "synth/features/contour.h"

namespace chironomia {
namespace {

std::vector<float> cleaned(const std::vector<float>& values, const std::vector<std::uint8_t>& success) {
    auto clean =
        smooth_and_bridge({.values = values, .width = values.size() / success.size(), .success = success});
    assert(clean);
    return std::move(*clean);
}

}  // namespace

TrackedFace track_face(const FaceTrack& face, std::span<const int> units, bool noise, Random random) {
    constexpr float kAngleNoise = 0.0087f, kUnitNoise = 0.15f;
    const std::size_t frames = face.head.size();
    TrackedFace all;
    for (std::size_t t = 0; t < frames; ++t) {
        const Vec2 gaze = openface_gaze(face.gaze[t], face.head[t]);
        const Vec3 head = openface_angles(face.head[t]);
        all.gaze.insert(all.gaze.end(), {gaze.x, gaze.y});
        all.head.insert(all.head.end(), {head.x, head.y, head.z});
    }
    all.units = intensities_of(face, frames, units);
    Sight sight = sight_of(frames, noise, Random(random.next(), 1));
    if (noise) {
        const std::vector<float> gaze_noise(TrackedFace::kGaze, kAngleNoise);
        const std::vector<float> head_noise(TrackedFace::kHead, kAngleNoise);
        const std::vector<float> unit_noise(units.size(), kUnitNoise);
        all.gaze = tracked(all.gaze, gaze_noise, sight, Random(random.next(), 2));
        all.head = tracked(all.head, head_noise, sight, Random(random.next(), 3));
        all.units = tracked(all.units, unit_noise, sight, Random(random.next(), 4));
    }
    all.success = std::move(sight.success);
    all.confidence = std::move(sight.confidence);
    return all;
}

TrackedFace cleaned(TrackedFace tracked) {
    for (std::vector<float>* values : {&tracked.gaze, &tracked.head, &tracked.units})
        *values = cleaned(*values, tracked.success);
    for (float& unit : tracked.units) unit = std::clamp(unit, 0.0f, 5.0f);
    return tracked;
}

}  // namespace chironomia
