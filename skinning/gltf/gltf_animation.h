// The animations that a glTF file carries, and the pose of its scene at a moment of one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

enum class Interpolation { step, linear, cubic };

enum class AnimatedPath { translation, rotation, scale, weights };

// What one channel moves, key by key.
struct AnimationTrack {
    int joint = 0;  // index into the skeleton
    AnimatedPath path = AnimatedPath::translation;
    Interpolation interpolation = Interpolation::linear;
    size_t width = 3;           // numbers a value: 3, 4 (x y z w), or the morphs of the node
    int first_weight = 0;       // of AnimatedPath::weights, in Pose::morph_weights
    std::vector<float> times;   // (K) ascending, at least 0; twice the same is a step [s]
    std::vector<float> values;  // (K, width); cubic: (K, 3, width) in-tangent, value, out-tangent
};

struct Animation {
    std::string name;    // may be empty
    double seconds = 0;  // to the last key
    std::vector<AnimationTrack> tracks;
};

struct AnimatedScene {
    Avatar scene;  // as it stands in the file; the humanoid map is empty
    std::vector<Animation> animations;
};

// What a scene must have to be of use.
enum class SceneNeed { triangles, joints };

// The file's default scene and all its animations. A channel without a node, or of a node outside the scene,
// moves nothing and is left out. Throws Error as read_avatar_or_scene, and if an animation is broken: an accessor
// out of range, a number that is not finite, times that descend, a count that does not fit, a rotation
// that is none, two channels of one target, or weights of a node without morphs.
AnimatedScene read_animated_scene(const std::filesystem::path& file, SceneNeed need = SceneNeed::triangles);

std::string shown(const Animation& animation);  // its name in quotes, or that it has none

// The index of the animation of this name, else of this number from 0. Throws Error that lists those of the file if it
// has none such.
size_t animation_named(const AnimatedScene& file, const std::string& asked);

// The pose at a time [s]: before its first key a track holds the first value, after its last the last. What
// no track moves is at rest. Rotations take the shorter way round.
// Khronos, glTF 2.0 Specification, appendix C (STEP, LINEAR, SLERP, CUBICSPLINE).
Pose pose_at(const Avatar& scene, const Animation& animation, double time);

}  // namespace chironomia
