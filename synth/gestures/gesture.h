// The gesture language: prototypes as key poses, and which of their features carry the meaning.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/touch.h"
#include "core/math.h"

namespace chironomia {

// McNeill, "Hand and Mind", 1992; an adaptor tends to the body and means nothing.
enum class GestureCategory { beat, metaphoric, iconic, deictic, emblem, adaptor };

std::string_view name_of(GestureCategory category);  // "beat"

enum class GestureHands {
    either,  // one hand: the speaker's preferred one; authored for the right arm
    both,    // both hands, each with its own key poses
};

// Phases of a gesture after McNeill and Kendon, in their order. `rest` is between gestures.
enum class GesturePhase { rest, preparation, pre_stroke_hold, stroke, post_stroke_hold, retraction };
std::string_view name_of(GesturePhase phase);  // "pre-stroke-hold"

// The velocity of the way to a key pose, in the words of the gesture language.
enum class Speed { slow, normal, fast };

enum class WristShape { line, circle };

// The way of the wrist to a key pose: straight, or in circles on the way.
struct WristPath {
    WristShape shape = WristShape::line;
    float radius = 0;    // of the circles [arm lengths]
    float turns = 1;     // how many, above 0
    Vec3 axis{0, 0, 1};  // of the circles: unit, gesture space; they go clockwise as one looks along it
};

// What a manner may not change, because the meaning is in it.
struct FixedFeatures {
    bool wrist_x = false, wrist_y = false, wrist_z = false;
    bool palm = false, shape = false, swivel = false;
};

// One arm at one moment; without more it hangs. Gesture space of an arm: x outward from the midline (the
// arm's own side), y up from the height of the hanging elbow, z forward from the shoulders; in lengths of the
// whole arm. The sectors of McNeill's diagram are named points of it (sectors.h).
struct ArmPose {
    Vec3 wrist{0.52f, -0.44f, 0.13f};  // gesture space [arm lengths]
    Vec3 palm{-1, 0, 0};               // unit, gesture space: where the palm faces
    Vec3 fingers{0, -1, 0};  // unit, gesture space, at right angles to `palm`: where straight fingers point
    std::size_t shape = 0;   // of Lexicon::shapes
    float swivel = 0.35f;    // of the elbow: 0 down, pi / 2 out to the side [rad]
    FixedFeatures fixed;
    Touch touches = Touch::nothing;  // what the hand rests on
};

// Where both arms are at the end of a stretch of a phase. The key poses of a gesture lie in its preparation,
// its holds and its stroke; retraction goes to the rest pose and is not written down.
struct KeyPose {
    GesturePhase phase = GesturePhase::stroke;
    Speed speed = Speed::normal;
    std::optional<ArmPose> right;  // of `either`: the gesturing arm
    std::optional<ArmPose> left;   // only of `both`
    WristPath path;
};

struct Gesture {
    std::string id;  // "open_offer"
    GestureCategory category = GestureCategory::beat;
    GestureHands hands = GestureHands::either;
    std::vector<std::string> functions;  // what it can show: "performative=greet", "world=shape", "rheme"
    std::vector<KeyPose> poses;          // in time; the last one of phase `stroke` is the stroke's end
    bool repeats = true;                 // its stroke may be repeated on later accents
    std::string note;                    // what it looks like, in one sentence
};

// Turns of the 15 joints of a right hand against the straight hand: thumb, index, middle, ring, little, each
// from the palm outward. The left hand is its mirror image.
struct HandShape {
    std::string id;  // "index_point"
    std::array<Quat, 15> turns{};
};

struct Lexicon {
    std::vector<HandShape> shapes;  // 0 is "relax"
    std::vector<Gesture> gestures;
    std::vector<std::string> sources;  // the files that it was read from
};

std::optional<std::size_t> find_gesture(const Lexicon& lexicon, std::string_view id);
std::optional<std::size_t> find_shape(const Lexicon& lexicon, std::string_view id);

}  // namespace chironomia
