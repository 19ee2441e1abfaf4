#include "synth/gestures/hand_shape.h"

#include <gtest/gtest.h>

#include "core/text.h"
#include "synth/gestures/lexicon.h"
#include "tests/synth/gestures/hand_capsules.h"

namespace chironomia {
namespace {

using testing::HandPart;
using testing::parts_of_hand;

// The tip of a finger of a right hand in the T-pose: fingers along -x, palm to -y, thumb to +z [m].
Vec3 tip_of(const HandBends& bends, int finger) {
    for (const HandPart& part : parts_of_hand(turns_of(bends)))
        if (part.finger == finger && part.segment == 2) return part.capsule.to;
    return Vec3(0);
}

TEST(HandShape, LeavesAStraightHandAlone) {
    for (const Quat& turn : turns_of({})) EXPECT_EQ(turn, kNoTurn);
}

TEST(HandShape, BendsFingersTowardsThePalm) {
    for (std::size_t f = 0; f < 4; ++f) {
        HandBends bends;
        bends.fingers[f].flexion = {90, 0, 0};
        const Vec3 straight = tip_of({}, int(f) + 1), bent = tip_of(bends, int(f) + 1);
        EXPECT_LT(bent.y, straight.y - 0.03f) << f;
        bends.fingers[f].flexion = {90, 90, 0};
        EXPECT_GT(tip_of(bends, int(f) + 1).x, bent.x) << "back towards the wrist, " << f;
    }
}

TEST(HandShape, SpreadsFingersFromTheMiddleOne) {
    for (std::size_t f = 0; f < 4; ++f) {
        HandBends bends;
        bends.fingers[f].spread = 15;
        const float moved = tip_of(bends, int(f) + 1).z - tip_of({}, int(f) + 1).z;
        if (f < 2) {
            EXPECT_GT(moved, 0.008f) << "towards the thumb";
        } else {
            EXPECT_LT(moved, -0.008f) << "towards the little finger's side";
        }
    }
}

TEST(HandShape, MovesTheThumbInThreeWays) {
    const Vec3 straight = tip_of({}, 0);
    const Vec3 bent = tip_of({.thumb = {.flexion = {15, 30, 30}}}, 0);
    EXPECT_LT(bent.z, straight.z - 0.02f) << "flexion: across the palm";
    const Vec3 spread = tip_of({.thumb = {.spread = 25}}, 0);
    EXPECT_GT(spread.z, straight.z + 0.01f) << "spread: away from the index finger";
    const Vec3 opposed = tip_of({.thumb = {.oppose = 40}}, 0);
    EXPECT_LT(opposed.y, straight.y - 0.01f) << "oppose: under the palm";
    EXPECT_LT(opposed.z, straight.z - 0.01f);
}

const Lexicon& bundled() {
    static const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    return lexicon;
}

std::array<Quat, 15> shape_named(const char* id) {
    return bundled().shapes.at(find_shape(bundled(), id).value()).turns;
}

Vec3 tip_in(const char* shape, int finger) {
    for (const HandPart& part : parts_of_hand(shape_named(shape)))
        if (part.finger == finger && part.segment == 2) return part.capsule.to;
    return Vec3(0);
}

// Flesh gives way by a quarter of its thickness; more would be one finger in another, or in the palm.
TEST(BundledShapes, PassThroughNothing) {
    for (const HandShape& shape : bundled().shapes) {
        const testing::Overlap worst = testing::worst_overlap(shape.turns);
        EXPECT_LT(worst.share, 0.25f) << shape.id << ": " << worst.where;
    }
    // What is measured can be seen to fail: all joints of the fingers bent as far as they go.
    HandBends crushed;
    for (FingerBends& finger : crushed.fingers) finger.flexion = {95, 115, 85};
    EXPECT_GT(testing::worst_overlap(turns_of(crushed)).share, 0.5f);
}

TEST(BundledShapes, LookAsTheyAreCalled) {
    const auto extended = [](const char* shape, int finger) { return -tip_in(shape, finger).x > 0.14f; };
    const auto fingers_out = [&](const char* shape) {
        std::string out;
        for (int finger = 1; finger < 5; ++finger) out += extended(shape, finger) ? '1' : '0';
        return out;
    };
    EXPECT_EQ(fingers_out("fist"), "0000");
    EXPECT_EQ(fingers_out("thumb_up"), "0000");
    EXPECT_EQ(fingers_out("index_point"), "1000");
    EXPECT_EQ(fingers_out("number_one"), "1000");
    EXPECT_EQ(fingers_out("two"), "1100");
    EXPECT_EQ(fingers_out("three").substr(0, 3), "111");
    EXPECT_LT(-tip_in("three", 4).x, 0.11f);
    EXPECT_GT(distance(tip_in("two", 1), tip_in("two", 2)), 0.05f) << "a V";
    EXPECT_GT(tip_in("thumb_up", 0).z, tip_in("fist", 0).z + 0.05f);
    EXPECT_LT(distance(tip_in("ring", 0), tip_in("ring", 1)), 0.02f) << "thumb and index finger meet";
    EXPECT_GT(distance(tip_in("gap", 0), tip_in("gap", 1)), 0.03f) << "but not in the gap";
    for (int finger = 1; finger < 5; ++finger)
        EXPECT_LT(distance(tip_in("purse", 0), tip_in("purse", finger)), 0.03f)
            << "tips together, " << finger;
    for (int finger = 1; finger < 4; ++finger) {
        const float flat = distance(tip_in("open", finger), tip_in("open", finger + 1));
        EXPECT_GT(distance(tip_in("open_apart", finger), tip_in("open_apart", finger + 1)), flat + 0.004f)
            << finger;
    }
}

}  // namespace
}  // namespace chironomia
