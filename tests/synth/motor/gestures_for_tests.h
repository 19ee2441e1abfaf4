// A small lexicon, and lists of planned gestures for it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "synth/gestures/gesture.h"
#include "synth/planner/behaviour.h"
#include "synth/speakers/speaker.h"

namespace chironomia::testing {

// Every finger of a right hand bent by the same share of a fist.
inline HandShape bent_hand(const std::string& id, float share) {
    HandShape shape{.id = id, .turns = {}};
    for (std::size_t f = 0; f < shape.turns.size(); ++f) {
        const bool thumb = f < 3;
        const Vec3 axis = thumb ? normalize(Vec3(-0.6f, 0.6f, 0.4f)) : Vec3(0, 0, 1);
        const float whole = thumb ? 0.5f : f % 3 == 0 ? 1.4f : f % 3 == 1 ? 1.6f : 1.1f;
        shape.turns[f] = glm::angleAxis(whole * share, axis);
    }
    return shape;
}

inline KeyPose right_pose(GesturePhase phase, const ArmPose& pose, Speed speed = Speed::normal) {
    return {.phase = phase, .speed = speed, .right = pose, .left = std::nullopt, .path = {}};
}

inline KeyPose both_poses(GesturePhase phase, const ArmPose& pose, Speed speed = Speed::normal) {
    return {.phase = phase, .speed = speed, .right = pose, .left = pose, .path = {}};
}

enum TestGesture : std::size_t { kBeat, kOffer, kFrame, kPoint, kRoll, kGreet };

// "beat": one hand, down; "offer": both, outward, with a hold; "frame": both, two ways; "point": one hand,
// all fixed, not repeated; "roll": one hand, two circles; "greet": one hand at the head, waving.
inline Lexicon test_lexicon() {
    using enum GesturePhase;
    Lexicon lexicon;
    lexicon.shapes = {bent_hand("relax", 0.3f), bent_hand("fist", 1), bent_hand("open", 0.05f),
                      bent_hand("cup", 0.45f)};
    const Vec3 inward(-1, 0, 0), up(0, 1, 0), front(0, 0, 1), down(0, -1, 0);
    const ArmPose high{.wrist = {0.35f, 0.45f, 0.55f}, .palm = inward, .fingers = front, .shape = 3};
    ArmPose low = high;
    low.wrist = {0.4f, 0.05f, 0.6f};
    lexicon.gestures.push_back(
        {.id = "beat", .poses = {right_pose(preparation, high), right_pose(stroke, low)}});

    const ArmPose gathered{.wrist = {0.12f, 0.2f, 0.45f}, .palm = up, .fingers = front, .shape = 2};
    const ArmPose offered{
        .wrist = {0.6f, 0.2f, 0.6f}, .palm = up, .fingers = normalize(Vec3(0.4f, 0, 1)), .shape = 2};
    lexicon.gestures.push_back({.id = "offer",
                                .category = GestureCategory::metaphoric,
                                .hands = GestureHands::both,
                                .poses = {both_poses(preparation, gathered), both_poses(stroke, offered),
                                          both_poses(post_stroke_hold, offered)}});

    const ArmPose wide{
        .wrist = {0.5f, 0.7f, 0.5f}, .palm = inward, .fingers = front, .shape = 2, .swivel = 0.6f};
    ArmPose under = wide;
    under.wrist = {0.25f, -0.1f, 0.55f};
    ArmPose narrow = wide;
    narrow.wrist = {0.2f, 0.5f, 0.5f};
    lexicon.gestures.push_back({.id = "frame",
                                .category = GestureCategory::iconic,
                                .hands = GestureHands::both,
                                .poses = {both_poses(preparation, narrow), both_poses(stroke, wide),
                                          both_poses(stroke, under, Speed::slow)}});

    ArmPose aimed{.wrist = {0.45f, 0.55f, 0.9f}, .palm = down, .fingers = front, .shape = 0};
    aimed.fixed = {
        .wrist_x = true, .wrist_y = true, .wrist_z = true, .palm = true, .shape = true, .swivel = true};
    ArmPose drawn = aimed;
    drawn.wrist = {0.35f, 0.35f, 0.5f};
    lexicon.gestures.push_back({.id = "point",
                                .category = GestureCategory::deictic,
                                .poses = {right_pose(preparation, drawn), right_pose(pre_stroke_hold, drawn),
                                          right_pose(stroke, aimed, Speed::fast)},
                                .repeats = false});

    const ArmPose turning{.wrist = {0.3f, 0.3f, 0.55f}, .palm = inward, .fingers = front, .shape = 0};
    KeyPose rolled = right_pose(stroke, turning);
    rolled.path = {.shape = WristShape::circle, .radius = 0.15f, .turns = 2, .axis = {1, 0, 0}};
    lexicon.gestures.push_back({.id = "roll", .poses = {right_pose(preparation, turning), rolled}});

    const ArmPose waved{
        .wrist = {0.55f, 0.8f, 0.35f}, .palm = front, .fingers = up, .shape = 2, .swivel = 0.9f};
    ArmPose waved_back = waved;
    waved_back.wrist.x = 0.4f;
    lexicon.gestures.push_back({.id = "greet",
                                .category = GestureCategory::emblem,
                                .poses = {right_pose(preparation, waved), right_pose(stroke, waved_back),
                                          right_pose(stroke, waved), right_pose(stroke, waved_back)}});
    return lexicon;
}

inline PlannedGesture planned_gesture(std::size_t gesture, double stroke_end, const Manner& manner = {}) {
    return {.gesture = gesture,
            .function = "rheme",
            .stroke_end = stroke_end,
            .accents = {},
            .rheme_start = stroke_end - 0.5,
            .rheme_end = stroke_end + 1,
            .left_hand = false,
            .weight = 0.5,
            .manner = manner};
}

inline double between(Random& random, double low, double high) {
    return low + (high - low) * random.uniform();
}

inline Vec3 random_direction(Random& random) {
    for (;;) {
        const Vec3 v(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
        if (length(v) > 0.1f && length(v) < 1) return normalize(v);
    }
}

// Somewhere in McNeill's sectors.
inline ArmPose random_pose(Random& random) {
    constexpr std::array<float, 5> kX = {0.8f, 0.5f, 0.25f, 0, -0.25f};
    constexpr std::array<float, 7> kY = {1.2f, 0.9f, 0.6f, 0.25f, 0, -0.3f, -0.5f};
    constexpr std::array<float, 3> kZ = {0.4f, 0.65f, 0.95f};
    ArmPose pose{.wrist = {kX[random.below(5)], kY[random.below(7)], kZ[random.below(3)]},
                 .palm = random_direction(random),
                 .shape = random.below(4),
                 .swivel = static_cast<float>(between(random, 0, 1.2))};
    const Vec3 any = random_direction(random);
    pose.fingers = normalize(any - pose.palm * dot(any, pose.palm));
    return pose;
}

inline Gesture random_gesture(Random& random) {
    Gesture gesture{.id = "random", .hands = random.below(2) ? GestureHands::both : GestureHands::either};
    const std::size_t strokes = 1 + random.below(3);
    for (std::size_t p = 0; p <= strokes; ++p) {
        KeyPose pose = right_pose(p == 0 ? GesturePhase::preparation : GesturePhase::stroke,
                                  random_pose(random), static_cast<Speed>(random.below(3)));
        if (gesture.hands == GestureHands::both) pose.left = random_pose(random);
        if (random.below(6) == 0) {
            pose.path = {.shape = WristShape::circle,
                         .radius = static_cast<float>(between(random, 0.05, 0.2)),
                         .turns = static_cast<float>(between(random, 0.5, 2)),
                         .axis = random_direction(random)};
        }
        gesture.poses.push_back(pose);
    }
    return gesture;
}

// Twenty seconds of anything, in any manner.
struct RandomScore {
    Lexicon lexicon = test_lexicon();
    std::vector<PlannedGesture> planned_gestures;
    Speaker speaker;
};

inline RandomScore random_score(std::uint64_t seed) {
    Random random(seed);
    RandomScore score;
    for (int g = 0; g < 12; ++g) score.lexicon.gestures.push_back(random_gesture(random));
    Manner manner;
    for (double& value : manner.values) value = between(random, -1, 1);
    score.speaker.height = between(random, -0.2, 0.2);
    for (double time = 1; time < 20; time += between(random, 0.4, 3)) {
        PlannedGesture planned = planned_gesture(
            random.below(static_cast<std::uint32_t>(score.lexicon.gestures.size())), time, manner);
        planned.left_hand = random.below(3) == 0;
        planned.weight = random.uniform();
        planned.rheme_start = time - between(random, 0, 1);
        planned.rheme_end = time + between(random, 0, 2);
        for (double accent = time + 0.3; accent < time + 3; accent += between(random, 0.3, 0.9))
            planned.accents.push_back(accent);
        score.planned_gestures.push_back(std::move(planned));
    }
    return score;
}

}  // namespace chironomia::testing
