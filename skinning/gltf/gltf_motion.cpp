#include "skinning/gltf/gltf_motion.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/signal/frame_rate.h"

namespace chironomia {
namespace {

constexpr double kMostFrames = 1e6;

// The keys of the track that has most of them.
const std::vector<float>& longest_keys(const Animation& animation) {
    const auto fewer = [](const AnimationTrack& a, const AnimationTrack& b) {
        return a.times.size() < b.times.size();
    };
    return std::max_element(animation.tracks.begin(), animation.tracks.end(), fewer)->times;
}

double rate_of_keys(const std::vector<float>& times, const std::string& where) {
    if (times.size() < 2)
        throw Error(
            format("{}: its animation has one key, which gives no rate; set it with --motion-fps", where));
    const double first = times.front(), step = (times.back() - first) / static_cast<double>(times.size() - 1);
    if (!(step > 0) || rate_of_step(step) > kFastestMotion) {
        throw Error(format(
            "{}: the {} keys of its animation lie between {} and {} s, {:.3g} s apart; at least {} s are "
            "expected, set the rate at which it is sampled with --motion-fps",
            where, times.size(), first, times.back(), step, 1 / kFastestMotion));
    }
    for (size_t k = 0; k < times.size(); ++k) {
        const double expected = first + step * static_cast<double>(k);
        if (std::abs(times[k] - expected) <= 0.1 * step) continue;
        throw Error(format(
            "{}: key {} of its animation lies at {} s, but even steps lead to {:.6g} s; set the rate at "
            "which it is sampled with --motion-fps",
            where, k, times[k], expected));
    }
    return rate_of_step(step);
}

void note_left_out(Motion& motion, const AnimatedScene& file) {
    const std::vector<AnimationTrack>& tracks = file.animations[0].tracks;
    const auto count = [&](AnimatedPath path) {
        return std::count_if(tracks.begin(), tracks.end(), [&](const auto& t) { return t.path == path; });
    };
    if (const auto scales = count(AnimatedPath::scale); scales > 0)
        motion.notes.push_back(format("scales of {} nodes are left out", scales));
    if (const auto weights = count(AnimatedPath::weights); weights > 0)
        motion.notes.push_back(format("morph weights of {} nodes are left out", weights));
}

}  // namespace

bool is_skeleton_alone(const std::filesystem::path& file) {
    return open_gltf(file).json.value("meshes", Json::array()).empty();
}

Motion read_gltf_motion(const std::filesystem::path& file, std::optional<double> fps) {
    const std::string where = file.string();
    const AnimatedScene scene = read_animated_scene(file, SceneNeed::joints);
    if (scene.animations.empty() || scene.animations[0].tracks.empty())
        throw Error(format("{}: has no animation that moves anything; a motion is expected", where));
    const Animation& animation = scene.animations[0];
    const double rate = fps ? *fps : rate_of_keys(longest_keys(animation), where);
    if (!(animation.seconds * rate < kMostFrames)) {
        throw Error(
            format("{}: {} s at {} frames/s are more than a million frames; set a lower rate with "
                   "--motion-fps",
                   where, animation.seconds, rate));
    }
    Motion motion{.source = where,
                  .companions = scene.scene.companions,
                  .fps = rate,
                  .frames = static_cast<size_t>(std::lround(animation.seconds * rate)) + 1,
                  .joints = JointTrack{.skeleton = scene.scene.skeleton, .turns = {}, .translations = {}},
                  .keypoints = {},
                  .notes = {format("glTF: animation \"{}\", the first of {}", animation.name,
                                   scene.animations.size())}};
    for (size_t t = 0; t < motion.frames; ++t) {
        const Pose pose = pose_at(scene.scene, animation, static_cast<double>(t) / rate);
        for (const Transform& joint : pose.joints) {
            motion.joints->turns.push_back(normalize(joint.rotation));
            motion.joints->translations.push_back(joint.translation);
        }
    }
    note_left_out(motion, scene);
    motion.notes.push_back(format("rate: {:.6g} frames/s{}", rate, fps ? ", set by hand" : ""));
    return motion;
}

}  // namespace chironomia
