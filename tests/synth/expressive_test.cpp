// The whole engine: half an hour of 26 speakers who keep out of their own bodies, end their strokes on their
// accents, and are the same every time.
#include "synth/expressive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <map>

#include "core/error.h"
#include "core/hash.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/body/agent_body.h"
#include "synth/gestures/lexicon.h"
#include "synth/markup/markup.h"
#include "synth/speakers/speakers.h"
#include "synth/speech/speak.h"
#include "tests/synth/talks.h"

namespace chironomia {
namespace {

constexpr std::size_t kTalksEach = 5;

constexpr double kMostAcceleration = 80;  // of a wrist, at 60 frames/s [m/s^2]

const Lexicon& lexicon() {
    static const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    return lexicon;
}

Speech speech_of(const std::string& text, const Voice& voice = {}) {
    return speak(parse_marked_text({.text = text}, MarkupLanguage::plain), voice);
}

Performed perform_as(const Speaker& speaker, const Speech& speech, std::uint64_t seed = 1, double fps = 60) {
    return perform(speech,
                   {.speaker = speaker, .lexicon = lexicon(), .variants = {}, .fps = fps, .seed = seed});
}

// Places of the joints of one frame in the frame of the upper chest, where the arms hang [m].
std::vector<Vec3> places_at(const Motion& motion, std::size_t frame) {
    const JointTrack& track = *motion.joints;
    std::vector<Transform> local = rest_transforms(track.skeleton);
    for (std::size_t j = 0; j < kAgentJoints; ++j) {
        local[j].rotation = track.turns[frame * kAgentJoints + j];
        local[j].translation = track.translations[frame * kAgentJoints + j];
    }
    const std::vector<Mat4> world = world_from_joints(track.skeleton, local);
    const Mat4 chest_from_world = inverse(world[joint_of(HumanJoint::upper_chest)]);
    std::vector<Vec3> places;
    for (const Mat4& joint : world) places.push_back(Vec3(chest_from_world * Vec4(origin(joint), 1)));
    return places;
}

// Whether a wrist is in the trunk, an upright elliptic cylinder around the spine, or in the head, a ball.
bool is_inside(const std::vector<Vec3>& places, HumanJoint wrist) {
    const Vec3 hand = places[joint_of(wrist)];
    const Vec3 hips = places[joint_of(HumanJoint::hips)], neck = places[joint_of(HumanJoint::neck)];
    const Vec3 head = places[joint_of(HumanJoint::head)] + Vec3(0, 0.08f, 0.02f);
    const float height = std::clamp((hand.y - hips.y) / (neck.y - hips.y), 0.0f, 1.0f);
    const Vec3 spine = hips + (neck - hips) * height;
    const bool is_beside = hand.y > hips.y - 0.1f && hand.y < neck.y;
    const double x = (hand.x - spine.x) / 0.13, z = (hand.z - spine.z - 0.02) / 0.10;
    return (is_beside && x * x + z * z < 1) || distance(hand, head) < 0.10f;
}

struct Seen {
    std::size_t frames = 0, inside = 0;
    double acceleration = 0;                // the highest of a wrist [m/s^2]
    double elbow = 0, wrist = 0, neck = 0;  // the highest angles [rad]
    std::size_t strokes = 0, late = 0;
};

void watch_joints(const Motion& motion, Seen& seen) {
    std::map<HumanJoint, std::array<Vec3, 2>> before;
    for (std::size_t t = 0; t < motion.frames; ++t) {
        const std::vector<Vec3> places = places_at(motion, t);
        for (const HumanJoint wrist : {HumanJoint::left_hand, HumanJoint::right_hand}) {
            seen.inside += is_inside(places, wrist);
            auto& [older, old] = before[wrist];
            const Vec3 now = places[joint_of(wrist)];
            if (t >= 2) {
                const double change = length(now - 2.0f * old + older);
                seen.acceleration = std::max(seen.acceleration, change * motion.fps * motion.fps);
            }
            older = old;
            old = now;
        }
        const Quat* turns = &motion.joints->turns[t * kAgentJoints];
        const auto angle = [&](HumanJoint part) { return angle_between(turns[joint_of(part)], kNoTurn); };
        for (const HumanJoint side : {HumanJoint::left_hand, HumanJoint::right_hand}) {
            const Quat swing = split_twist(turns[joint_of(side)], Vec3(1, 0, 0)).swing;
            seen.wrist = std::max(seen.wrist, double(angle_between(swing, kNoTurn)));
            const Quat bend = split_twist(turns[joint_of(*parent_of(side))], Vec3(1, 0, 0)).swing;
            seen.elbow = std::max(seen.elbow, double(angle_between(bend, kNoTurn)));
        }
        seen.neck = std::max(seen.neck, double(angle(HumanJoint::neck) + angle(HumanJoint::head)));
        ++seen.frames;
    }
}

// Every run of stroke in the labels ends on the stress of a word that is shown, or on a pitch accent.
void watch_strokes(const Performed& made, Seen& seen) {
    std::vector<double> accents = made.behaviours.accents;
    for (const PlannedGesture& gesture : made.behaviours.gestures) accents.push_back(gesture.stroke_end);
    for (const LabelTrack& label : made.motion.labels) {
        if (label.name != "left phase" && label.name != "right phase") continue;
        const auto stroke = static_cast<int>(std::find(label.values.begin(), label.values.end(), "stroke") -
                                             label.values.begin());
        for (std::size_t t = 1; t < label.frames.size(); ++t) {
            if (label.frames[t - 1] != stroke || label.frames[t] == stroke) continue;
            const double end = static_cast<double>(t - 1) / made.motion.fps;
            double nearest = 1;
            for (const double accent : accents) nearest = std::min(nearest, std::abs(accent - end));
            ++seen.strokes;
            seen.late += nearest > 0.040;
        }
    }
}

TEST(HalfAnHour, KeepsToTheBodyAndTheSpeech) {
    Seen seen;
    double seconds = 0;
    std::size_t number = 0;
    for (const std::string& name : speaker_names()) {
        const Speaker speaker = speaker_named(name);
        const Speech speech = speech_of(testing::talk(number++, kTalksEach), speaker.voice);
        const Performed made = perform_as(speaker, speech, number);
        watch_joints(made.motion, seen);
        watch_strokes(made, seen);
        seconds += speech.audio.duration();
    }
    RecordProperty("minutes", std::to_string(seconds / 60));
    RecordProperty("strokes", std::to_string(seen.strokes));
    RecordProperty("late", std::to_string(seen.late));
    RecordProperty("acceleration", std::to_string(seen.acceleration));
    EXPECT_GT(seconds, kTalksEach * 6 * 60);
    EXPECT_EQ(seen.inside, 0u) << "of " << seen.frames << " frames";
    EXPECT_GT(seen.strokes, seconds / 60 * 5);
    EXPECT_LE(seen.late, seen.strokes / 20) << "of " << seen.strokes;
    EXPECT_LT(seen.acceleration, kMostAcceleration);
    EXPECT_LT(glm::degrees(seen.elbow), 151);
    EXPECT_LT(glm::degrees(seen.wrist), 90);
    EXPECT_LT(glm::degrees(seen.neck), 75);
}

std::string digest(const Motion& motion) {
    std::string bytes;
    const auto add = [&](const auto& values) {
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
    };
    add(motion.joints->turns);
    add(motion.joints->translations);
    add(motion.face->intensities);
    add(motion.face->gaze);
    for (const LabelTrack& label : motion.labels) add(label.frames);
    return sha256(bytes);
}

TEST(ExpressiveEngine, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
    const Speech speech = speech_of(testing::talk(0, 1));
    const Performed once = perform_as({}, speech, 5, 30);
    EXPECT_EQ(digest(once.motion), digest(perform_as({}, speech, 5, 30).motion));
    EXPECT_NE(digest(once.motion), digest(perform_as({}, speech, 6, 30).motion));
}

// In a process of its own, whose interrupt is not forgotten.
TEST(ExpressiveEngine, StopsWhereItIsInterrupted) {
    const Speech speech = speech_of("There are two ways.");
    const auto be_interrupted = [&] {
        watch_for_interrupts();
        std::raise(SIGINT);
        try {
            perform_as(speaker_named("neutral"), speech);
        } catch (const Interrupted&) {
            std::_Exit(130);
        }
        std::_Exit(0);
    };
    EXPECT_EXIT(be_interrupted(), ::testing::ExitedWithCode(130), "");
}

TEST(ExpressiveEngine, ShowsTheSameActsInEveryManner) {
    const Speech speech = speech_of(testing::talk(2, 1));
    const auto chosen = [&](const char* speaker) {
        Speaker one = speaker_named(speaker);
        one.manner[Expressivity::overall_activation] = 0.6;
        std::vector<std::size_t> gestures;
        for (const PlannedGesture& gesture : perform_as(one, speech).behaviours.gestures)
            gestures.push_back(gesture.gesture);
        return gestures;
    };
    EXPECT_EQ(chosen("abrupt"), chosen("vigorous"));
    EXPECT_EQ(chosen("abrupt"), chosen("sluggish"));
}

// A motion at another rate is the same movement.
TEST(ExpressiveEngine, MovesTheSameWayAtAnyRate) {
    const Speech speech = speech_of(testing::talk(1, 1));
    const Motion slow = perform_as({}, speech, 3, 30).motion, fast = perform_as({}, speech, 3, 60).motion;
    for (std::size_t t = 0; t + 1 < slow.frames; t += 7) {
        const std::vector<Vec3> a = places_at(slow, t), b = places_at(fast, 2 * t);
        for (std::size_t j = 0; j < kAgentJoints; ++j)
            EXPECT_LT(distance(a[j], b[j]), 2e-3f) << t << " " << j;
    }
}

TEST(ExpressiveEngine, GivesTheTurnOfTheHeadAsTheJointsDo) {
    const Motion motion = perform_as({}, speech_of("Look over there!"), 1, 30).motion;
    ASSERT_EQ(motion.face->head.size(), motion.frames);
    for (std::size_t t = 0; t < motion.frames; ++t) {
        std::vector<Transform> local = rest_transforms(motion.joints->skeleton);
        for (std::size_t j = 0; j < kAgentJoints; ++j)
            local[j].rotation = motion.joints->turns[t * kAgentJoints + j];
        const Quat head =
            rotation_of(world_from_joints(motion.joints->skeleton, local)[joint_of(HumanJoint::head)]);
        EXPECT_LT(angle_between(head, motion.face->head[t]), 1e-3f);
    }
}

TEST(ExpressiveEngine, MovesMouthAndBrows) {
    const Motion motion = perform_as({}, speech_of("Hello! Mama, do you see the boat?"), 1, 30).motion;
    const auto most = [&](int unit) {
        float found = 0;
        const auto& channels = motion.face->channels;
        for (std::size_t c = 0; c < channels.size(); ++c)
            for (std::size_t t = 0; channels[c].unit == unit && t < motion.frames; ++t)
                found = std::max(found, motion.face->intensities[t * channels.size() + c]);
        return found;
    };
    EXPECT_GT(most(25), 0.5f);
    EXPECT_GT(most(26), 0.5f);
    EXPECT_GT(most(45), 2.0f);
    EXPECT_GT(std::max(most(1), most(2)), 0.5f);
}

}  // namespace
}  // namespace chironomia
