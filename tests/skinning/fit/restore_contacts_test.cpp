#include "skinning/fit/restore_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skinning/body/body_plan.h"
#include "skinning/gltf/gltf.h"
#include "skinning/shape/contacts.h"
#include "skinning/shape/measure_shape.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

constexpr double kTouchFps = 30;

struct TouchPerson {
    explicit TouchPerson(const std::string& name)
        : avatar(read_avatar(testing::source_dir() / "assets/avatars" / (name + ".glb"))),
          rig(posture_rig(avatar.skeleton, avatar.humanoid)),
          shape(measure_shape(avatar, rig)) {}

    // Of the left hand to the trunk; below 0 inside [m].
    float gap(const Posture& posture) const {
        const PosedSkeleton posed = pose_skeleton(rig, posture, {});
        float depth = -0.3f;
        for (const Contact& contact : contacts_of(shape, {posed.turns, posed.places}, depth))
            if (contact.part == ShapePart::left_hand && contact.in == ShapePart::trunk)
                depth = std::max(depth, contact.overlap.depth);
        return -depth;
    }

    Vec3 wrist(const Posture& posture) const {
        return pose_skeleton(rig, posture, {}).places[static_cast<size_t>(rig.parts[HumanJoint::left_hand])];
    }

    Avatar avatar;
    PostureRig rig;
    BodyShape shape;
};

// The left upper arm hangs, the forearm lies before the belly `inward` from straight ahead [rad].
Posture before_the_belly(float inward) {
    Posture posture;
    for (const LimbParts& arm : kArms) {
        const Quat hangs = glm::angleAxis(-arm.side * 1.45f, Vec3(0, 0, 1));
        const Quat forward =
            glm::angleAxis(-arm.side * (0.5f * kPi + (arm.side > 0 ? inward : 0)), Vec3(0, 1, 0));
        posture[arm.upper] = hangs;
        posture[arm.lower] = forward;
        posture[arm.end] = forward;
    }
    return posture;
}

// The left hand touches the trunk from frame 40 to 59 of 100.
Touches touches_trunk() {
    Touches touches;
    for (auto& of_hand : touches) of_hand.assign(100, Touch::nothing);
    std::fill_n(touches[0].begin() + 40, 20, Touch::trunk);
    return touches;
}

TEST(RestoreContacts, LeavesPosturesWithoutATouchAsTheyAre) {
    const TouchPerson person("neutral");
    const std::vector<Posture> postures(100, before_the_belly(0.7f));
    Touches touches = touches_trunk();
    touches[0].assign(100, Touch::nothing);
    const RestoredPostures kept = restore_contacts(postures, kTouchFps, touches, {person.rig, person.shape});
    EXPECT_EQ(kept.report.frames, 0u);
    for (size_t t = 0; t < 100; ++t) EXPECT_EQ(kept.postures[t].parts, postures[t].parts);
}

TEST(RestoreContacts, BringsAHandThatIsBeforeTheTrunkOntoItAndBackSmoothly) {
    for (const char* name : {"neutral", "male"}) {
        const TouchPerson person(name);
        const std::vector<Posture> postures(100, before_the_belly(0.8f));
        const float before = person.gap(postures[0]);
        ASSERT_GT(before, 0.02f) << name;
        ASSERT_LT(before, 0.09f) << name;
        const RestoredPostures kept =
            restore_contacts(postures, kTouchFps, touches_trunk(), {person.rig, person.shape});
        for (size_t t = 43; t < 57; ++t)
            EXPECT_NEAR(person.gap(kept.postures[t]), -0.004f, 0.003f) << name << t;
        EXPECT_NEAR(kept.report.most_wrist, before, 0.02) << name;
        EXPECT_EQ(kept.report.too_far, 0u);
        // The move fades within 0.4 s, and a bit for its smoothing.
        for (const size_t t : {0u, 20u, 80u, 99u}) EXPECT_EQ(kept.postures[t].parts, postures[t].parts) << t;
        for (size_t t = 1; t < 100; ++t) {
            EXPECT_LT(distance(person.wrist(kept.postures[t - 1]), person.wrist(kept.postures[t])), 0.012f)
                << t;
        }
        // The hand keeps its turn in the world.
        EXPECT_EQ(kept.postures[50][HumanJoint::left_hand], postures[50][HumanJoint::left_hand]);
    }
}

TEST(RestoreContacts, BringsAHandThatIsInTheTrunkOutOfIt) {
    const TouchPerson person("neutral");
    const std::vector<Posture> postures(100, before_the_belly(1.15f));
    ASSERT_LT(person.gap(postures[0]), -0.01f);
    const RestoredPostures kept =
        restore_contacts(postures, kTouchFps, touches_trunk(), {person.rig, person.shape});
    EXPECT_NEAR(person.gap(kept.postures[50]), -0.004f, 0.003f);
}

TEST(RestoreContacts, LeavesAHandThatIsFarFromWhatItShouldRestOn) {
    const TouchPerson person("neutral");
    const std::vector<Posture> postures(100, before_the_belly(0));
    const RestoredPostures kept =
        restore_contacts(postures, kTouchFps, touches_trunk(), {person.rig, person.shape});
    EXPECT_EQ(kept.report.too_far, 20u);
    EXPECT_EQ(kept.report.frames, 0u);
    EXPECT_EQ(kept.postures[50].parts, postures[50].parts);
}

TEST(RestoreContacts, ReadsTheLabelsOfBothHands) {
    Motion motion{.source = "a.h5", .fps = 30, .frames = 3, .joints = {}, .keypoints = {}, .notes = {}};
    motion.labels = {{.name = "right phase", .values = {"rest"}, .frames = {0, 0, 0}}};
    EXPECT_FALSE(touches_of(motion));
    motion.labels.push_back({.name = "right touch", .values = {"nothing", "upper arm"}, .frames = {0, 1, 0}});
    const auto touches = touches_of(motion);
    ASSERT_TRUE(touches);
    EXPECT_EQ((*touches)[1], (std::vector{Touch::nothing, Touch::upper_arm, Touch::nothing}));
    EXPECT_EQ((*touches)[0], std::vector<Touch>(3, Touch::nothing));
}

TEST(RestoreContacts, RefusesALabelThatNamesNoPart) {
    Motion motion{.source = "a.h5", .fps = 30, .frames = 2, .joints = {}, .keypoints = {}, .notes = {}};
    motion.labels = {{.name = "left touch", .values = {"nothing", "knee"}, .frames = {0, 1}}};
    EXPECT_EQ(
        testing::refusal_of([&] { touches_of(motion); }),
        "a.h5: the label \"left touch\" is \"knee\" in frame 1; it may be nothing, head, trunk, hand, forearm, "
        "upper arm");
}

}  // namespace
}  // namespace chironomia
