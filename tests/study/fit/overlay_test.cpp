// The skeleton over the picture: it lies where the avatar's joints are seen.
#include "study/fit/overlay.h"

#include <gtest/gtest.h>

#include "core/render/camera.h"
#include "scenes/scene_file.h"
#include "skinning/fit/avatar_motion.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/sketch/sketch_motion.h"
#include "study/clip/clip.h"

namespace chironomia::study {
namespace {

constexpr RenderSize kSize{480, 270};

Frame white() {
    return {.width = kSize.width,
            .height = kSize.height,
            .rgba = std::vector<std::uint8_t>(static_cast<std::size_t>(kSize.width * kSize.height) * 4, 255)};
}

TEST(Overlay, LiesOnTheAvatarThatMadeTheMotion) {
    const Avatar avatar = read_avatar(find_avatar("mannequin"));
    const Fit fit = stand_relaxed(avatar, {});
    const Motion motion = motion_of_avatar(avatar, std::vector<Pose>{fit.poses[0]}, 30);
    const StickSketch sketch = sketch_motion(motion);
    EXPECT_NEAR(arm_length(motion), arm_length(avatar), 1e-4f);
    const Scene scene = make_scene("upper", avatar, kSize);
    Frame frame = white();
    draw_overlay(frame, {.sketch = sketch}, 0,
                 {.avatar = avatar, .pose = fit.poses[0], .camera = scene.camera});

    const auto world = world_from_joints(avatar.skeleton, fit.poses[0].joints);
    const auto colour_at = [&](HumanJoint part) {
        const Vec3 place = origin(world[static_cast<std::size_t>(avatar.humanoid[part])]);
        const Vec2 pixel = pixel_of(scene.camera, kSize, place);
        return frame.rgba.data() + 4 * (static_cast<int>(pixel.y) * kSize.width + static_cast<int>(pixel.x));
    };
    for (const HumanJoint part : {HumanJoint::left_lower_arm, HumanJoint::left_upper_arm}) {
        const std::uint8_t* blue = colour_at(part);
        EXPECT_GT(blue[2], blue[0] + 100) << name_of(part);
        const std::uint8_t* orange = colour_at(mirrored(part));
        EXPECT_GT(orange[0], orange[2] + 100) << name_of(mirrored(part));
    }
    EXPECT_EQ(frame.rgba[0], 255) << "nothing is drawn where there is no line";
}

}  // namespace
}  // namespace chironomia::study
