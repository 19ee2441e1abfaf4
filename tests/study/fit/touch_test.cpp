// Hands that should rest on the body do so on all bundled people, measured on the triangles that are drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/body/rest.h"
#include "core/body/touch.h"
#include "core/text.h"
#include "skinning/fit/fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/skin.h"
#include "tests/skinning/shape/mesh_depth.h"
#include "tests/study/fit/lexicon_motion.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using testing::MeshDepth;
using testing::MeshRegion;

// In the scene "upper" at 720 rows a centimetre is 5 pixels. A gap of 3 cm is seen at once, one of 1.5 cm only by who
// looks for it, as palms are flat and trunks are not. Flesh and cloth give way by about a centimetre; a hand is
// 2.8 cm thick, and half of that would hide its edge. The poses were made by looking at neutral and the first female,
// with at most 0.8 and 0.7 cm; of the others the second male's loose shirt takes in 1.2 cm at the hips.
constexpr float kMostGap = 0.015f;    // between a hand and what it rests on [m]
constexpr float kMostDepth = 0.013f;  // of a hand or a forearm in anything [m]

struct Rest {
    MeshRegion hand;
    MeshRegion on;
};

struct TouchingGesture {
    std::string id;
    std::vector<Rest> rests;
};

const std::vector<TouchingGesture>& touching_gestures() {
    using enum MeshRegion;
    static const std::vector<TouchingGesture> gestures = {
        {"touch_chin", {{right_hand, head}}},
        {"hands_on_hips", {{left_hand, trunk}, {right_hand, trunk}}},
        {"arms_crossed", {{left_hand, trunk}, {right_hand, left_forearm}}},
        {"hand_on_arm", {{right_hand, left_forearm}}},
        {"plead", {{left_hand, right_hand}}}};
    return gestures;
}

const LabelTrack& track_of(const Motion& motion, std::string_view name) {
    return *std::find_if(motion.labels.begin(), motion.labels.end(),
                         [&](const LabelTrack& track) { return track.name == name; });
}

// Every third frame in which the right hand rests.
std::vector<std::size_t> held_frames(const Motion& motion) {
    const LabelTrack& track = track_of(motion, kTouchLabels[1]);
    std::vector<std::size_t> frames;
    for (std::size_t t = 0; t < motion.frames; t += 3)
        if (track.values[static_cast<std::size_t>(track.frames[t])] != name_of(Touch::nothing))
            frames.push_back(t);
    return frames;
}

// The nearest place of a hand to what it rests on; infinitely far if it is more than 5 cm away.
testing::NearPiece nearest_of(const std::vector<testing::NearPiece>& pieces, const Rest& rest) {
    testing::NearPiece nearest{.gap = std::numeric_limits<float>::infinity()};
    for (const testing::NearPiece& piece : pieces)
        if (piece.of == rest.hand && piece.to == rest.on && piece.gap < nearest.gap) nearest = piece;
    return nearest;
}

Vec3 place_of(const Avatar& avatar, const Pose& pose, HumanJoint part) {
    return origin(
        world_from_joints(avatar.skeleton, pose.joints)[static_cast<std::size_t>(avatar.humanoid[part])]);
}

void expect_touches(const TouchingGesture& gesture, const Avatar& avatar, MeshDepth& mesh,
                    const std::string& who) {
    const Motion motion = testing::motion_of_gestures({gesture.id}, 30);
    const Fit fit = fit_motion(motion, avatar, {.fps = 30});
    ASSERT_TRUE(fit.report.contact_moves);
    EXPECT_EQ(fit.report.contact_moves->too_far, 0u) << who;
    const std::vector<std::size_t> frames = held_frames(motion);
    ASSERT_GE(frames.size(), 3u) << who;
    for (const std::size_t t : frames) {
        const PosedMesh posed = skin(avatar, fit.poses[t]);
        const std::vector<testing::NearPiece> pieces = mesh.near(posed, 0.05f);
        const std::string when = format("{}, {}, frame {}", gesture.id, who, t);
        for (const Rest& rest : gesture.rests)
            EXPECT_LT(nearest_of(pieces, rest).gap, kMostGap) << when << ", " << name_of(rest.hand);
        for (const testing::SunkenPiece& piece : mesh.sunken(posed)) {
            EXPECT_LT(piece.depth, kMostDepth)
                << when << ", " << name_of(piece.of) << " in " << name_of(piece.in);
        }
        if (gesture.id != "touch_chin") continue;
        // Below the lips and before the throat.
        const Vec3 chin = nearest_of(pieces, gesture.rests[0]).place;
        const Vec3 jaw = place_of(avatar, fit.poses[t], HumanJoint::jaw);
        EXPECT_LT(chin.y, jaw.y - 0.03f) << when;
        EXPECT_GT(chin.z, jaw.z + 0.03f) << when;
    }
}

TEST(Touch, HandsRestOnAllBundledPeople) {
    for (const char* who : testing::kPeople) {
        const Avatar avatar =
            read_avatar(testing::source_dir() / "assets/avatars" / (std::string(who) + ".glb"));
        MeshDepth mesh(avatar);
        for (const TouchingGesture& gesture : touching_gestures()) expect_touches(gesture, avatar, mesh, who);
    }
}

// Its forearms are too short for its trunk.
TEST(Touch, OfAHandThatStaysAwayIsWarnedOf) {
    const Avatar avatar = read_avatar(testing::source_dir() / "assets/avatars/mannequin.glb");
    const Fit fit = fit_motion(testing::motion_of_gestures({"arms_crossed"}, 30), avatar, {.fps = 30});
    EXPECT_THAT(
        warnings_of(fit.report),
        ::testing::ElementsAre(::testing::MatchesRegex(
            "lexicon: in [0-9]+ frames a hand is too far from what it should rest on on this avatar, and "
            "stays there")));
}

// The bundled gestures that rest on something are those that this test looks at.
TEST(Touch, IsLookedForInEveryGestureThatAsksForIt) {
    for (const std::string& id : testing::ids_of_bundled_gestures()) {
        const Motion motion = testing::motion_of_gestures({id}, 10);
        const bool touches =
            std::any_of(motion.labels.begin(), motion.labels.end(),
                        [](const LabelTrack& track) { return track.name == kTouchLabels[1]; });
        const auto& all = touching_gestures();
        EXPECT_EQ(touches,
                  std::any_of(all.begin(), all.end(), [&](const auto& gesture) { return gesture.id == id; }))
            << id;
    }
}

}  // namespace
}  // namespace chironomia::study
