// The animation of a glTF file as a motion.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/body/motion.h"

namespace chironomia {

// An animation of the file; all nodes of its scene as joints, in the file's own axes. The rate is that of its keys where
// they lie evenly. Scales and morph weights that move are left out, which a note says.
//   fps        the rate at which the animation is sampled, instead of that of its keys
//   animation  its name, or its number from 0; empty: the first that moves or turns a joint, else the first
// Throws Error as read_animated_scene and animation_named, if there is no animation, if it moves nothing, or if its
// keys lie unevenly and no rate is given.
Motion read_gltf_motion(const std::filesystem::path& file, std::optional<double> fps,
                        const std::string& animation = {});

// Whether the file holds a skeleton alone, without any mesh. Throws Error if it is broken.
bool is_skeleton_alone(const std::filesystem::path& file);

}  // namespace chironomia
