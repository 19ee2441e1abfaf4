// The scene "upper" has room for all gestures of the lexicon, and not much more.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/body/rest.h"
#include "core/render/camera.h"
#include "scenes/scene_file.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "tests/study/fit/lexicon_motion.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

// What is left between places and the edges, as a share of the picture's width or height.
struct Room {
    float side = 1, top = 1, bottom = 1;
    std::string at_side, at_top, at_bottom;  // the gesture that comes nearest

    void see(const Vec2& share, const std::string& gesture) {
        const auto take = [&](float& least, std::string& at, float room) {
            if (room < least) at = gesture;
            least = std::min(least, room);
        };
        take(side, at_side, std::min(share.x, 1 - share.x));
        take(top, at_top, share.y);
        take(bottom, at_bottom, 1 - share.y);
    }
};

// Of the picture's width and height, from the top left corner.
Vec2 share_of(const Camera& camera, RenderSize size, const Vec3& place) {
    return pixel_of(camera, size, place) / Vec2(float(size.width), float(size.height));
}

// The wrist, and the tips of the fingers: as far beyond their last joints as these are from the ones before.
std::vector<Vec3> places_of_hand(const Avatar& avatar, const std::vector<Mat4>& world, bool left) {
    const auto at = [&](HumanJoint part) {
        return origin(world[static_cast<std::size_t>(avatar.humanoid[left ? part : mirrored(part)])]);
    };
    using enum HumanJoint;
    std::vector<Vec3> places = {at(left_hand)};
    constexpr std::array<std::array<HumanJoint, 2>, 5> kFingers = {{{left_thumb_2, left_thumb_3},
                                                                    {left_index_2, left_index_3},
                                                                    {left_middle_2, left_middle_3},
                                                                    {left_ring_2, left_ring_3},
                                                                    {left_little_2, left_little_3}}};
    for (const auto& [before, last] : kFingers) places.push_back(2.0f * at(last) - at(before));
    return places;
}

// The rooms of wrists and of fingertips in one picture.
struct Rooms {
    Room wrists, tips;
};

Rooms rooms_of(const Avatar& avatar, const Fit& fit, const std::vector<std::string>& ids, RenderSize size) {
    const Camera camera = make_scene("upper", avatar, size).camera;
    const std::size_t each = fit.poses.size() / ids.size();
    Rooms rooms;
    for (std::size_t t = 0; t < fit.poses.size(); ++t) {
        const auto world = world_from_joints(avatar.skeleton, fit.poses[t].joints);
        for (const bool left : {false, true}) {
            const std::vector<Vec3> places = places_of_hand(avatar, world, left);
            for (std::size_t i = 0; i < places.size(); ++i)
                (i == 0 ? rooms.wrists : rooms.tips).see(share_of(camera, size, places[i]), ids[t / each]);
        }
    }
    return rooms;
}

void expect_room(const Room& room, float least, const std::string& who) {
    EXPECT_GT(room.side, least) << who << ", " << room.at_side;
    EXPECT_GT(room.top, least) << who << ", " << room.at_top;
    EXPECT_GT(room.bottom, least) << who << ", " << room.at_bottom;
}

// The height binds: "tall" at the top and "press_down" at the bottom. The tallest person's fingertips leave the picture
// by 3 of 720 rows there. At the sides there is more room only because the picture is wide.
TEST(GestureRoom, OfTheUpperSceneHoldsTheWholeLexiconOnAllBundledPeople) {
    const std::vector<std::string> ids = testing::ids_of_bundled_gestures();
    const Motion motion = testing::motion_of_gestures(ids, 10);
    for (const char* who : testing::kPeople) {
        const Avatar avatar =
            read_avatar(testing::source_dir() / "assets/avatars" / (std::string(who) + ".glb"));
        const Fit fit = fit_motion(motion, avatar, {.fps = 10});
        const Rooms wide = rooms_of(avatar, fit, ids, {1280, 720}),
                    narrow = rooms_of(avatar, fit, ids, {960, 720});
        for (const Rooms* rooms : {&wide, &narrow}) {
            expect_room(rooms->wrists, 0, who);
            expect_room(rooms->tips, -0.006f, who);
        }
        // No picture could be much closer, at 4:3 not at the sides either.
        EXPECT_LT(std::min(wide.tips.top, wide.tips.bottom), 0.06f) << who;
        EXPECT_GT(wide.tips.side, 0.12f) << who << ", as docs/inputs.md says";
        EXPECT_LT(narrow.tips.side, 0.12f) << who;
    }
}

}  // namespace
}  // namespace chironomia::study
