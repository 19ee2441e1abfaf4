// The skeleton of a motion drawn over the avatar that shows the motion, so that people can compare both by eye.
#pragma once

#include <cstddef>

#include "core/body/avatar.h"
#include "core/body/motion.h"
#include "core/render/frame.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"
#include "skinning/sketch/stick_sketch.h"

namespace chironomia::study {

struct Overlay {
    const StickSketch& sketch;  // at the rate of the picture
    bool flat = false;          // a picture's points, seen from the front; else places in space
    float size = 1;             // avatar / person, by the length of their arms
};

// Median length of the arms of the person [m], in space even where the motion is that of a picture; 0 if they
// are never seen.
float arm_length(const Motion& motion);
// The same of an avatar at rest.
float arm_length(const Avatar& avatar);

// What the picture under an overlay shows.
struct AvatarView {
    const Avatar& avatar;
    const Pose& pose;
    const Camera& camera;
};

// Draws the lines that are seen at `index` into a picture of the avatar. The middles of both shoulder lines lie on each
// other, and a sketch in space is turned to the avatar's heading.
void draw_overlay(Frame& frame, const Overlay& overlay, std::size_t index, const AvatarView& view);

}  // namespace chironomia::study
