// The bundled gestures: what they serve, and that every pose of them is one that a body takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/text.h"
#include "synth/gestures/lexicon.h"
#include "synth/gestures/pose_arm.h"
#include "tests/support/support.h"
#include "tests/synth/gestures/hand_capsules.h"

namespace chironomia {
namespace {

using ::testing::IsEmpty;

const Lexicon& bundled() {
    static const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    return lexicon;
}

std::size_t choices_for(const std::string& function, const std::function<bool(const Gesture&)>& counts) {
    return static_cast<std::size_t>(
        std::count_if(bundled().gestures.begin(), bundled().gestures.end(), [&](const Gesture& gesture) {
            const auto& shown = gesture.functions;
            return counts(gesture) && std::find(shown.begin(), shown.end(), function) != shown.end();
        }));
}

bool any_gesture(const Gesture&) {
    return true;
}
bool is_beat(const Gesture& gesture) {
    return gesture.category == GestureCategory::beat;
}

TEST(BundledLexicon, HasEveryCategory) {
    std::map<GestureCategory, int> counts;
    for (const Gesture& gesture : bundled().gestures) ++counts[gesture.category];
    EXPECT_GE(counts[GestureCategory::beat], 8);
    EXPECT_GE(counts[GestureCategory::metaphoric], 8);
    EXPECT_GE(counts[GestureCategory::iconic], 6);
    EXPECT_GE(counts[GestureCategory::deictic], 5);
    EXPECT_GE(counts[GestureCategory::emblem], 5);
    EXPECT_GE(counts[GestureCategory::adaptor], 1);
    EXPECT_GE(bundled().gestures.size(), 38u);
}

// Power closes a free hand towards a fist, which would make a claw of an open one.
TEST(BundledLexicon, LeavesOnlyLooseHandsFree) {
    std::set<std::string> free;
    for (const Gesture& gesture : bundled().gestures) {
        for (const KeyPose& pose : gesture.poses) {
            for (const auto& arm : {pose.right, pose.left})
                if (arm && !arm->fixed.shape) free.insert(bundled().shapes[arm->shape].id);
        }
    }
    EXPECT_THAT(free, ::testing::ElementsAre("curved", "relax"));
}

// What a planner can ask for: the functions of the markup.
TEST(BundledLexicon, ServesEveryFunctionInAtLeastTwoWays) {
    const std::map<std::string, std::vector<std::string>> functions = {
        {"performative",
         {"greet", "inform", "ask", "order", "suggest", "thank", "apologise", "refuse", "agree", "goodbye"}},
        {"certainty", {"certain", "uncertain"}},
        {"belief-relation", {"contrast", "cause-effect", "enumerate", "condition", "elaborate"}},
        {"deictic", {"place-here", "place-there", "self", "partner", "object"}},
        {"world",
         {"shape-round", "shape-flat", "size-big", "size-small", "quantity-one", "quantity-two",
          "quantity-three", "quantity-many", "up", "down", "time-past", "time-future"}},
        {"emotion", {"joy", "sadness", "anger", "fear", "surprise", "disgust"}},
        {"emphasis", {"low", "medium", "high"}},
        {"turn", {"take", "give", "keep"}}};
    std::set<std::string> known = {"rheme", "theme"};
    for (const auto& [kind, values] : functions)
        for (const std::string& value : values) known.insert(kind + "=" + value);
    for (const std::string& function : known) EXPECT_GE(choices_for(function, any_gesture), 2u) << function;
    for (const Gesture& gesture : bundled().gestures) {
        for (const std::string& function : gesture.functions)
            EXPECT_TRUE(known.contains(function)) << gesture.id << ": " << function;
        EXPECT_EQ(gesture.functions.empty(), gesture.category == GestureCategory::adaptor) << gesture.id;
    }
}

TEST(BundledLexicon, HasManyBeats) {
    EXPECT_GE(choices_for("rheme", is_beat), 6u);
    std::size_t emphatic = 0;
    for (const char* level : {"low", "medium", "high"}) {
        emphatic += choices_for(format("emphasis={}", level), is_beat);
        EXPECT_GE(choices_for(format("emphasis={}", level), is_beat), 3u) << level;
    }
    EXPECT_GE(emphatic, 6u);
}

// Calls visit(place, pose, side) for each arm of each key pose.
void for_each_arm(
    const std::function<void(const std::string&, const Gesture&, const ArmPose&, ArmSide)>& visit) {
    for (const Gesture& gesture : bundled().gestures) {
        for (std::size_t n = 0; n < gesture.poses.size(); ++n) {
            const KeyPose& pose = gesture.poses[n];
            const std::string place = format("{} {} {}", gesture.id, n, name_of(pose.phase));
            visit(place + " right", gesture, *pose.right, ArmSide::right);
            if (pose.left) visit(place + " left", gesture, *pose.left, ArmSide::left);
        }
    }
}

TEST(BundledLexicon, HasOnlyPosesThatArmsTake) {
    for_each_arm([](const std::string& place, const Gesture&, const ArmPose& pose, ArmSide side) {
        const ArmTurns turns = pose_arm(pose, bundled().shapes.at(pose.shape), side);
        const ArmAngles& angles = turns.angles;
        EXPECT_TRUE(turns.reached) << place;
        EXPECT_FALSE(turns.clamped) << place;
        EXPECT_GE(angles.forward, -kArmLimits.most_back) << place;
        EXPECT_GE(angles.outward, -kArmLimits.most_across) << place;
        EXPECT_LE(std::abs(angles.rotation), kArmLimits.most_rotation) << place;
        EXPECT_LE(angles.elbow, kArmLimits.most_elbow) << place;
        EXPECT_LE(std::abs(angles.twist), kArmLimits.most_twist + 1e-4f) << place;
        EXPECT_LE(std::abs(angles.flexion), kArmLimits.most_flexion + 1e-4f) << place;
        EXPECT_LE(std::abs(angles.deviation), kArmLimits.most_deviation + 1e-4f) << place;
    });
}

TEST(BundledLexicon, FacesItsPalmsWhereItSays) {
    for_each_arm([](const std::string& place, const Gesture&, const ArmPose& pose, ArmSide side) {
        const auto world = testing::world_of(pose_arm(pose, bundled().shapes[pose.shape], side), side);
        const Quat hand = rotation_of(world[joint_of(testing::arm_joint(HumanJoint::left_hand, side))]);
        const Vec3 mirror(side == ArmSide::left ? 1 : -1, 1, 1);
        EXPECT_LT(distance(hand * Vec3(0, -1, 0), pose.palm * mirror), 1e-3f) << place;
        EXPECT_LT(distance(hand * (Vec3(1, 0, 0) * mirror), pose.fingers * mirror), 1e-3f) << place;
    });
}

// Trunk and head as thick as the neutral avatar's.
std::vector<testing::Capsule> body() {
    const auto world = world_from_joints(agent_skeleton(), rest_transforms(agent_skeleton()));
    const auto place = [&](HumanJoint part) { return origin(world[joint_of(part)]); };
    const Vec3 low = place(HumanJoint::hips), high = place(HumanJoint::neck), head = place(HumanJoint::head);
    std::vector<testing::Capsule> capsules;
    for (const float x : {-0.06f, 0.0f, 0.06f})
        capsules.push_back({.from = {x, low.y, 0.03f}, .to = {x, high.y - 0.14f, 0.03f}, .radius = 0.105f});
    capsules.push_back({.from = head, .to = head + Vec3(0, 0.075f, 0.005f), .radius = 0.1f});
    return capsules;
}

float outside_of_body(const Vec3& point) {
    float nearest = 1;
    for (const testing::Capsule& part : body())
        nearest = std::min(nearest, testing::axis_distance(part, {point, point, 0}) - part.radius);
    return nearest;
}

// A wrist is as far from the body as half a hand is thick, and further unless the hand is to lie on the body.
TEST(BundledLexicon, KeepsWristsOutOfTheBody) {
    const std::set<std::string> on_body = {"point_self",    "heart",        "touch_chin",
                                           "hands_on_hips", "arms_crossed", "hand_on_arm"};
    for_each_arm([&](const std::string& place, const Gesture& gesture, const ArmPose& pose, ArmSide side) {
        const float room = outside_of_body(wrist_in_body(pose.wrist, side));
        EXPECT_GT(room, on_body.contains(gesture.id) ? 0.04f : 0.08f) << place;
    });
    EXPECT_LT(outside_of_body({0.05f, 1.2f, 0.05f}), 0);
    EXPECT_LT(outside_of_body({0, 1.6f, 0.05f}), 0);
}

// The joints of one hand with its fingers [m].
std::vector<Vec3> joints_of_hand(const ArmPose& pose, ArmSide side) {
    const auto world = testing::world_of(pose_arm(pose, bundled().shapes.at(pose.shape), side), side);
    std::vector<Vec3> places = {origin(world[joint_of(testing::arm_joint(HumanJoint::left_hand, side))])};
    for (std::size_t n = 0; n < 15; ++n) places.push_back(origin(world[joint_of(finger_joint(n, side))]));
    return places;
}

// Fingers are some 1.6 cm thick, and give way: nearer joints would be one hand in the other.
TEST(BundledLexicon, KeepsHandsOutOfEachOther) {
    for (const Gesture& gesture : bundled().gestures) {
        for (const KeyPose& pose : gesture.poses) {
            if (!pose.left) continue;
            float nearest = 1;
            for (const Vec3& a : joints_of_hand(*pose.right, ArmSide::right))
                for (const Vec3& b : joints_of_hand(*pose.left, ArmSide::left))
                    nearest = std::min(nearest, distance(a, b));
            EXPECT_GT(nearest, 0.014f) << gesture.id << " " << name_of(pose.phase);
        }
    }
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    const std::string text = read_text(file);
    for (const std::string_view line : split(text, '\n')) lines.emplace_back(line);
    return lines;
}

// The page that users read lists every gesture with what it shows and looks like, and every hand shape.
TEST(BundledLexicon, IsListedInItsPage) {
    const std::vector<std::string> page = lines_of(testing::source_dir() / "docs/gestures.md");
    std::vector<std::string> missing;
    for (const Gesture& gesture : bundled().gestures) {
        const std::string functions = gesture.functions.empty() ? "" : join(gesture.functions);
        const std::string row =
            format("| `{}` | {} | {} | {} | {} |", gesture.id, name_of(gesture.category),
                   gesture.hands == GestureHands::both ? "both" : "either", functions, gesture.note);
        if (std::find(page.begin(), page.end(), row) == page.end()) missing.push_back(row);
    }
    EXPECT_THAT(missing, IsEmpty()) << join(missing, "\n");
    const std::string text = join(page, "\n");
    for (const HandShape& shape : bundled().shapes)
        EXPECT_NE(text.find(format("`{}`", shape.id)), std::string::npos) << shape.id;
}

// What users copy from the page is read beside the bundled files.
TEST(BundledLexicon, ReadsTheExamplesOfItsPage) {
    const testing::TemporaryFolder folder;
    std::vector<std::filesystem::path> files = bundled_lexicon_files();
    const std::size_t bundled_files = files.size();
    std::string example;
    bool inside = false;
    for (const std::string& line : lines_of(testing::source_dir() / "docs/gestures.md")) {
        if (inside && line == "```") {
            files.push_back(folder / format("example_{}.json", files.size()));
            write_text(files.back(), example);
            example.clear();
        }
        inside = line == "```json" || (inside && line != "```");
        if (inside && line != "```json") example += line + "\n";
    }
    ASSERT_EQ(files.size(), bundled_files + 2);
    const Lexicon lexicon = read_lexicon(files);
    EXPECT_TRUE(find_gesture(lexicon, "offer_high"));
    EXPECT_TRUE(find_shape(lexicon, "hook"));
}

}  // namespace
}  // namespace chironomia
