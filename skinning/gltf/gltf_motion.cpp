#include "skinning/gltf/gltf_motion.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/bind_pose.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_file.h"
#include "skinning/gltf/mixamo_rest.h"
#include "skinning/signal/frame_rate.h"

namespace chironomia {
namespace {

constexpr double kMostFrames = 1e6;
constexpr float kUnchanged = 1e-6f;  // of a value from key to key: rounding [m, or of a unit quaternion]

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

void note_left_out(Motion& motion, const Animation& animation) {
    const std::vector<AnimationTrack>& tracks = animation.tracks;
    const auto count = [&](AnimatedPath path) {
        return std::count_if(tracks.begin(), tracks.end(), [&](const auto& t) { return t.path == path; });
    };
    if (const auto scales = count(AnimatedPath::scale); scales > 0)
        motion.notes.push_back(format("scales of {} nodes are left out", scales));
    if (const auto weights = count(AnimatedPath::weights); weights > 0)
        motion.notes.push_back(format("morph weights of {} nodes are left out", weights));
}

// Whether it moves or turns any joint: a rest pose that was saved as an action, such as a T-pose, does not.
bool moves_joints(const Animation& animation) {
    return std::ranges::any_of(animation.tracks, [](const AnimationTrack& track) {
        const bool of_joint = track.path == AnimatedPath::translation || track.path == AnimatedPath::rotation;
        if (!of_joint || track.times.size() < 2) return false;
        const size_t key = track.values.size() / track.times.size();
        for (size_t n = key; n < track.values.size(); ++n) {
            if (std::abs(track.values[n] - track.values[n - key]) > kUnchanged) return true;
        }
        return false;
    });
}

// The first animation that moves, or the first one.
size_t first_that_moves(const std::vector<Animation>& animations) {
    const auto found = std::ranges::find_if(animations, moves_joints);
    return found == animations.end() ? 0 : static_cast<size_t>(found - animations.begin());
}

std::string name_in_file(const AnimatedScene& scene, size_t chosen, bool is_asked) {
    const size_t count = scene.animations.size();
    const std::string& name = scene.animations[chosen].name;
    if (chosen == 0) return format("glTF: animation \"{}\", the first of {}", name, count);
    return format("glTF: animation \"{}\", number {} of {}{}", name, chosen + 1, count,
                  is_asked ? "" : ": those before it are still");
}

}  // namespace

bool is_skeleton_alone(const std::filesystem::path& file) {
    return open_gltf(file).json.value("meshes", Json::array()).empty();
}

Motion read_gltf_motion(const std::filesystem::path& file, std::optional<double> fps,
                        const std::string& asked) {
    const std::string where = file.string();
    const AnimatedScene scene = read_animated_scene(file, SceneNeed::joints);
    const size_t chosen = asked.empty() ? first_that_moves(scene.animations) : animation_named(scene, asked);
    if (scene.animations.empty() || scene.animations[chosen].tracks.empty())
        throw Error(format("{}: has no animation that moves anything; a motion is expected", where));
    const Animation& animation = scene.animations[chosen];
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
                  .notes = {name_in_file(scene, chosen, !asked.empty())}};
    for (size_t t = 0; t < motion.frames; ++t) {
        const Pose pose = pose_at(scene.scene, animation, static_cast<double>(t) / rate);
        for (const Transform& joint : pose.joints) {
            motion.joints->turns.push_back(normalize(joint.rotation));
            motion.joints->translations.push_back(joint.translation);
        }
    }
    const bool has_skins = !scene.scene.skins.empty();
    if (auto bind = has_skins ? bind_pose_of(scene.scene) : mixamo_rest(scene.scene.skeleton)) {
        motion.joints->skeleton = std::move(bind->skeleton);
        motion.notes.push_back(std::move(bind->note));
    }
    note_left_out(motion, animation);
    motion.notes.push_back(format("rate: {:.6g} frames/s{}", rate, fps ? ", set by hand" : ""));
    return motion;
}

}  // namespace chironomia
