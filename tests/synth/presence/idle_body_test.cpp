#include "synth/presence/idle_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "synth/body/agent_body.h"
#include "synth/speakers/speakers.h"
#include "tests/synth/presence/presence_support.h"

namespace chironomia {
namespace {

using testing::babble;
using testing::busy_behaviours;
using testing::frames_of;
using testing::head_down;
using testing::head_left;
using testing::intensities_of;
using testing::place_of;
using testing::signal_at;

constexpr double kFps = 30;

struct Scene {
    Speech speech = babble(1, 120);
    Behaviours behaviours = busy_behaviours(speech);
    Speaker speaker;
    double seconds = 120;
    double fps = kFps;
    std::uint64_t seed = 1;

    IdleBody idle_body() const {
        return animate_idle_body({.behaviours = behaviours,
                                  .speech = speech,
                                  .speaker = speaker,
                                  .times = {.frames = static_cast<std::size_t>(seconds * fps), .fps = fps},
                                  .seed = seed});
    }
};

// Somebody silent who is asked for these signals.
Scene silent(std::vector<Signal> signals, double seconds = 6) {
    return {.speech = {}, .behaviours = {.signals = std::move(signals)}, .seconds = seconds};
}

std::vector<Scene> scenes() {
    std::vector<Scene> all;
    for (const char* name : {"neutral", "abrupt", "vigorous", "sluggish", "jane", "gordon", "hilda"})
        all.push_back({.speaker = speaker_named(name), .seed = all.size()});
    // Signals as large and as sudden as a planner may ask for.
    Scene& wild = all.emplace_back(all.front());
    for (Signal& signal : wild.behaviours.signals) {
        signal.amount = 2;
        signal.start = signal.peak - 0.05;
    }
    return all;
}

constexpr HumanJoint kMoving[] = {
    HumanJoint::hips,          HumanJoint::spine,          HumanJoint::chest,
    HumanJoint::upper_chest,   HumanJoint::neck,           HumanJoint::head,
    HumanJoint::left_shoulder, HumanJoint::right_shoulder, HumanJoint::left_upper_leg,
    HumanJoint::left_foot,     HumanJoint::left_lower_leg, HumanJoint::right_upper_leg,
    HumanJoint::right_foot,    HumanJoint::right_lower_leg};

float degrees(float angle) {
    return glm::degrees(angle);
}

TEST(CarryBody, KeepsTheFeetWhereTheyAre) {
    for (const Scene& scene : scenes()) {
        const IdleBody body = scene.idle_body();
        for (const HumanJoint part :
             {HumanJoint::left_foot, HumanJoint::right_foot, HumanJoint::left_toes, HumanJoint::right_toes}) {
            const testing::JointPlace first = place_of(body, 0, part);
            for (std::size_t t = 0; t < frames_of(body); t += 3) {
                const testing::JointPlace now = place_of(body, t, part);
                ASSERT_LT(distance(now.place, first.place), 1e-4f) << scene.speaker.name << " " << t;
                ASSERT_LT(angle_between(now.turn, first.turn), 2e-3f) << scene.speaker.name << " " << t;
            }
        }
    }
}

TEST(CarryBody, PutsTheSolesOnTheFloorOfTheTPose) {
    const IdleBody body = Scene().idle_body();
    const std::vector<Mat4> rest = world_from_joints(agent_skeleton(), rest_transforms(agent_skeleton()));
    for (const HumanJoint part : {HumanJoint::left_foot, HumanJoint::right_toes})
        EXPECT_NEAR(place_of(body, 0, part).place.y, origin(rest[joint_of(part)]).y, 1e-5);
    EXPECT_LT(distance(place_of(body, 0, HumanJoint::left_foot).place,
                       origin(rest[joint_of(HumanJoint::left_foot)])),
              1e-5f);
}

TEST(CarryBody, BendsKneesForwardALittleAndNeverSnapsThem) {
    for (const Scene& scene : scenes()) {
        const IdleBody body = scene.idle_body();
        for (const HumanJoint knee : {HumanJoint::left_lower_leg, HumanJoint::right_lower_leg}) {
            float last = -1;
            for (std::size_t t = 0; t < frames_of(body); ++t) {
                const float bent =
                    degrees(angle_between(kNoTurn, body.turns[t * kAgentJoints + joint_of(knee)]));
                ASSERT_GT(bent, 4) << t;
                ASSERT_LT(bent, 40) << t;
                if (last >= 0) {
                    ASSERT_LT(std::abs(bent - last) * kFps, 60) << t;
                }
                last = bent;
            }
            const HumanJoint foot =
                knee == HumanJoint::left_lower_leg ? HumanJoint::left_foot : HumanJoint::right_foot;
            const HumanJoint hip =
                knee == HumanJoint::left_lower_leg ? HumanJoint::left_upper_leg : HumanJoint::right_upper_leg;
            const Vec3 middle = (place_of(body, 50, foot).place + place_of(body, 50, hip).place) * 0.5f;
            const Vec3 ahead = place_of(body, 50, foot).turn * Vec3(0, 0, 1);
            EXPECT_GT(dot(place_of(body, 50, knee).place - middle, ahead), 0.01f);
        }
    }
}

TEST(CarryBody, MovesTheSameWayAtAnyRate) {
    Scene scene{.speech = babble(1, 40), .seconds = 40};
    scene.behaviours = busy_behaviours(scene.speech);
    const IdleBody thirty = scene.idle_body();
    scene.fps = 60;
    const IdleBody sixty = scene.idle_body();
    scene.fps = 25;
    const IdleBody twenty_five = scene.idle_body();
    const auto expect_same = [](const IdleBody& a, std::size_t t, const IdleBody& b, std::size_t u) {
        EXPECT_LT(distance(a.hips[t], b.hips[u]), 1e-6f);
        for (std::size_t j = 0; j < kAgentJoints; ++j)
            ASSERT_LT(angle_between(a.turns[t * kAgentJoints + j], b.turns[u * kAgentJoints + j]), 1e-3f);
        const std::size_t channels = a.face.channels.size();
        for (std::size_t c = 0; c < channels; ++c)
            ASSERT_NEAR(a.face.intensities[t * channels + c], b.face.intensities[u * channels + c], 1e-4);
    };
    for (std::size_t t = 0; t < frames_of(thirty); ++t) expect_same(thirty, t, sixty, 2 * t);
    for (std::size_t t = 0; t < frames_of(twenty_five); t += 5)
        expect_same(twenty_five, t, thirty, t * 6 / 5);
}

TEST(CarryBody, DependsOnItsSeedAlone) {
    Scene scene{.seconds = 20};
    const IdleBody first = scene.idle_body(), second = scene.idle_body();
    EXPECT_EQ(first.turns, second.turns);
    EXPECT_EQ(first.hips, second.hips);
    EXPECT_EQ(first.face.intensities, second.face.intensities);
    scene.seed = 2;
    EXPECT_NE(scene.idle_body().turns, first.turns);
}

// A head that is shaken in earnest turns by 200 degrees a second, and turns round within a tenth of one.
TEST(CarryBody, NeverPops) {
    for (const Scene& scene : scenes()) {
        const IdleBody body = scene.idle_body();
        for (const HumanJoint part : kMoving) {
            Vec3 last(0);
            for (std::size_t t = 1; t < frames_of(body); ++t) {
                const std::size_t now = t * kAgentJoints + joint_of(part);
                const Quat step = body.turns[now] * conjugate(body.turns[now - kAgentJoints]);
                const Vec3 speed = 2.0f * Vec3(step.x, step.y, step.z) * degrees(1) * float(kFps);
                ASSERT_LT(length(speed), 200) << scene.speaker.name << " " << name_of(part) << " " << t;
                if (t > 1) {
                    ASSERT_LT(distance(speed, last) * kFps, 3000)
                        << scene.speaker.name << " " << name_of(part) << " " << t;
                }
                last = speed;
            }
        }
        for (std::size_t t = 1; t < frames_of(body); ++t)
            ASSERT_LT(distance(body.hips[t], body.hips[t - 1]) * kFps, 0.2) << t;
        for (const FaceChannel& channel : body.face.channels) {
            if (channel.unit == 45) continue;
            const std::vector<double> values = intensities_of(body, channel.unit);
            for (std::size_t t = 1; t < values.size(); ++t)
                ASSERT_LT(std::abs(values[t] - values[t - 1]), 1.6) << to_text(channel) << " " << t;
        }
    }
}

TEST(CarryBody, ShowsFacesWithinTheirScale) {
    Scene scene{.speaker = speaker_named("jane")};
    for (Signal& signal : scene.behaviours.signals) signal.amount = 2;
    const IdleBody body = scene.idle_body();
    EXPECT_EQ(body.face.head.size(), 0u);
    EXPECT_EQ(body.face.gaze.size(), frames_of(body));
    const auto [least, most] =
        std::minmax_element(body.face.intensities.begin(), body.face.intensities.end());
    EXPECT_GE(*least, 0);
    EXPECT_LE(*most, 5);
}

TEST(CarryBody, ShowsEachSignalOfTheFaceByItsUnits) {
    const std::map<SignalKind, std::vector<int>> units = {{SignalKind::brow_raise, {1, 2}},
                                                          {SignalKind::frown, {4}},
                                                          {SignalKind::smile, {6, 12}},
                                                          {SignalKind::sad_mouth, {1, 4, 15}},
                                                          {SignalKind::angry_face, {4, 5, 7, 23}},
                                                          {SignalKind::surprised, {1, 2, 5, 26}},
                                                          {SignalKind::afraid, {1, 2, 4, 5, 20}},
                                                          {SignalKind::disgusted, {9, 10, 17}}};
    for (const auto& [kind, shown] : units) {
        const IdleBody body = silent({signal_at(kind, 1)}, 3.5).idle_body();
        for (const FaceChannel& channel : body.face.channels) {
            if (channel.unit == 45) continue;
            const std::vector<double> values = intensities_of(body, channel.unit);
            const bool expected = std::find(shown.begin(), shown.end(), channel.unit) != shown.end();
            const bool is_shown = values[60] > 1.5, is_hidden = values[60] < 1;
            EXPECT_TRUE(expected ? is_shown : is_hidden) << static_cast<int>(kind) << to_text(channel);
            EXPECT_LT(values[15], 1);
            EXPECT_LT(values[95], 1);
        }
    }
}

TEST(CarryBody, NodsDownAndScalesWithTheSpeaker) {
    const auto deepest = [](double gain) {
        Scene scene = silent({{SignalKind::nod, 2, 2.3, 2.3, 2.8, 1}}, 4);
        scene.speaker.nod_gain = gain;
        const IdleBody body = scene.idle_body();
        return degrees(static_cast<float>(head_down(body, 69) - head_down(body, 57)));
    };
    EXPECT_NEAR(deepest(1), 9, 1.5);
    EXPECT_NEAR(deepest(2), 17, 2);
    EXPECT_NEAR(deepest(0), 0, 1);
}

TEST(CarryBody, HoldsTheHeadWithinItsLimits) {
    std::vector<Signal> many(20, {SignalKind::nod, 2, 2.4, 2.4, 2.8, 2});
    many.insert(many.end(), 20, signal_at(SignalKind::tilt, 2, 2));
    const IdleBody body = silent(many, 5).idle_body();
    double most = 0;
    for (std::size_t t = 0; t < frames_of(body); ++t) most = std::max(most, head_down(body, t));
    EXPECT_GT(most, radians(20.0));
    EXPECT_LT(most, radians(28.0));
}

// Where both eyes look in the world, from straight ahead to the person's left and up [degrees].
Vec2 look_of(const IdleBody& body, std::size_t t) {
    const Vec3 left = place_of(body, t, HumanJoint::left_eye).turn * Vec3(0, 0, 1),
               right = place_of(body, t, HumanJoint::right_eye).turn * Vec3(0, 0, 1);
    const Vec3 ahead = normalize(left + right);
    return {degrees(std::atan2(ahead.x, ahead.z)), degrees(std::asin(ahead.y))};
}

TEST(CarryBody, KeepsTheEyesOnThePartnerWhileTheHeadMoves) {
    Scene scene = silent({signal_at(SignalKind::look_at, 0), signal_at(SignalKind::nod, 0.5),
                          signal_at(SignalKind::shake, 1.5), signal_at(SignalKind::look_at, 2)},
                         3.5);
    scene.speaker.turn = 0.4;
    const IdleBody body = scene.idle_body();
    float moved = 0;
    for (std::size_t t = 0; t < frames_of(body); ++t) {
        EXPECT_LT(length(look_of(body, t)), 3) << t;
        moved = std::max(moved, degrees(static_cast<float>(std::abs(head_down(body, t)))));
    }
    EXPECT_GT(moved, 6);
}

TEST(CarryBody, LooksAwayWithTheEyesFirst) {
    const IdleBody body = silent({signal_at(SignalKind::look_away, 2)}, 5).idle_body();
    EXPECT_LT(length(look_of(body, 58)), 3);
    const float there = length(look_of(body, 63));
    EXPECT_GT(there, 6);
    EXPECT_NEAR(length(look_of(body, 85)), there, 2.5);
    EXPECT_LT(length(look_of(body, 110)), 3);
    // The head follows later, and only a part of the way.
    const auto head = [&](std::size_t t) {
        return degrees(static_cast<float>(
            std::hypot(head_left(body, t) - head_left(body, 59), head_down(body, t) - head_down(body, 59))));
    };
    EXPECT_LT(head(62), 1);
    EXPECT_GT(head(80), 2);
    EXPECT_LT(head(80), 0.7f * there);
}

TEST(CarryBody, TurnsTheEyesByTwentyFiveDegreesAtMost) {
    Scene scene{.speaker = speaker_named("gordon")};
    for (Signal& signal : scene.behaviours.signals) signal.amount = 2;
    const IdleBody body = scene.idle_body();
    for (std::size_t t = 0; t < frames_of(body); ++t) {
        const Gaze& gaze = body.face.gaze[t];
        ASSERT_LT(length(gaze.left), radians(25.0f));
        ASSERT_LT(length(gaze.right), radians(25.0f));
        const Vec3 turned = body.turns[t * kAgentJoints + joint_of(HumanJoint::left_eye)] * Vec3(0, 0, 1);
        ASSERT_NEAR(std::atan2(turned.x, turned.z), gaze.left.x, 1e-5);
        ASSERT_NEAR(std::asin(turned.y), gaze.left.y, 1e-5);
    }
}

// The starts of all stretches above half of a value's largest.
std::vector<std::size_t> peaks_of(const std::vector<double>& values, double level) {
    std::vector<std::size_t> starts;
    for (std::size_t t = 1; t < values.size(); ++t)
        if (values[t] >= level && values[t - 1] < level) starts.push_back(t);
    return starts;
}

TEST(CarryBody, BlinksAsOftenAsPeopleDo) {
    Scene scene{.speech = babble(0, 600), .behaviours = {}, .seconds = 600, .fps = 100};
    const std::vector<double> lids = intensities_of(scene.idle_body(), 45);
    const double speaking = static_cast<double>(peaks_of(lids, 0.5).size()) / 10;
    EXPECT_NEAR(speaking, 17, 2);
    scene.speech = {};
    const double listening =
        static_cast<double>(peaks_of(intensities_of(scene.idle_body(), 45), 0.5).size()) / 10;
    EXPECT_NEAR(listening, 13, 2);

    // Lids close all the way, quicker than they open, in 150 to 300 ms in all.
    std::size_t closing = 0, opening = 0;
    for (std::size_t t = 1; t < lids.size(); ++t) {
        closing += lids[t] > lids[t - 1];
        opening += lids[t] < lids[t - 1];
    }
    const double blinks = speaking * 10;
    EXPECT_NEAR(static_cast<double>(closing) / scene.fps / blinks, 0.076, 0.02);
    EXPECT_NEAR(static_cast<double>(opening) / scene.fps / blinks, 0.13, 0.03);
    EXPECT_EQ(*std::max_element(lids.begin(), lids.end()), 5);
}

TEST(CarryBody, BreathesFourteenTimesAMinuteAtRest) {
    const IdleBody body = silent({}, 120).idle_body();
    std::vector<double> lifted;
    for (std::size_t t = 0; t < frames_of(body); ++t)
        lifted.push_back(
            angle_between(kNoTurn, body.turns[t * kAgentJoints + joint_of(HumanJoint::left_shoulder)]));
    EXPECT_NEAR(static_cast<double>(peaks_of(lifted, radians(0.6)).size()), 28, 3);
}

TEST(CarryBody, DrawsADeepBreathBeforeItSpeaks) {
    Scene scene{.speech = babble(10, 15), .behaviours = {}, .seconds = 16};
    const IdleBody body = scene.idle_body();
    const auto lifted = [&](std::size_t t) {
        return angle_between(kNoTurn, body.turns[t * kAgentJoints + joint_of(HumanJoint::left_shoulder)]);
    };
    EXPECT_LT(lifted(280), 0.3f * lifted(300));
    EXPECT_GT(lifted(300), radians(1.5f));
    EXPECT_LT(lifted(419), 0.05f * lifted(300));
}

TEST(CarryBody, ShiftsTheWeightOnASignal) {
    const IdleBody body = silent({signal_at(SignalKind::shift, 2)}, 5).idle_body();
    EXPECT_GT(std::abs(body.hips[130].x - body.hips[58].x), 0.02f);
    EXPECT_LT(std::abs(body.hips[58].x - body.hips[30].x), 0.006f);
}

TEST(CarryBody, KeepsTheMomentsOfASignalWhereABodyCanFollow) {
    const std::vector<double> slow =
        intensities_of(silent({{SignalKind::frown, 1, 1.5, 2, 2.5, 1}}, 3).idle_body(), 4);
    EXPECT_EQ(slow[29], 0);
    EXPECT_NEAR(slow[38], slow[45] / 2, 0.3);
    EXPECT_NEAR(slow[45], slow[60], 1e-5);
    EXPECT_LT(slow[61], slow[60]);
    EXPECT_EQ(slow[75], 0);
    // Nobody frowns in no time: the frown is there on time, but begins earlier.
    const std::vector<double> sudden =
        intensities_of(silent({{SignalKind::frown, 1.5, 1.5, 2, 2, 1}}, 3).idle_body(), 4);
    EXPECT_NEAR(sudden[45], slow[45], 1e-5);
    EXPECT_GT(sudden[44], 0);
    EXPECT_EQ(sudden[40], 0);
    EXPECT_EQ(sudden[64], 0);
}

TEST(CarryBody, MovesTheBrowsWithAccentsSoonerWithPower) {
    const auto at_start = [](double power) {
        Scene scene{.speech = babble(1, 6), .seconds = 7};
        scene.behaviours = {.accents = {1.15, 2.15, 3.15, 4.15}};
        scene.speaker.manner[Expressivity::power] = power;
        const std::vector<double> brows = intensities_of(scene.idle_body(), 1);
        double sum = 0;
        for (const std::size_t accent : {1, 2, 3, 4}) sum += brows[30 * accent + 1];
        return sum;
    };
    EXPECT_GT(at_start(-1), at_start(0) + 0.05);
    EXPECT_GT(at_start(0), at_start(1) + 0.05);
}

TEST(CarryBody, LeansAndTurnsAsTheSpeakerDoes) {
    Scene scene = silent({}, 2);
    scene.speaker.lean = 0.25;
    scene.speaker.turn = 0.4;
    const IdleBody body = scene.idle_body();
    const Quat chest = place_of(body, 30, HumanJoint::upper_chest).turn;
    const Vec3 up = chest * Vec3(0, 1, 0), ahead = chest * Vec3(0, 0, 1);
    EXPECT_NEAR(std::acos(up.y), 0.25, 0.05);
    EXPECT_NEAR(std::atan2(ahead.x, ahead.z), 0.4, 0.08);
    // The face stays with the partner.
    EXPECT_LT(std::abs(head_left(body, 30)), 0.2);
    EXPECT_LT(std::abs(head_down(body, 30)), 0.12);
}

}  // namespace
}  // namespace chironomia
