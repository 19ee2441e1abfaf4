#include "synth/motor/schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/text.h"
#include "synth/motor/reach_time.h"
#include "tests/synth/motor/gestures_for_tests.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::planned_gesture;
using testing::test_lexicon;

// All that a schedule is made from, kept together.
struct Score {
    std::vector<PlannedGesture> planned_gestures;
    Variants variants{};
    double duration = 60;

    Lexicon lexicon = test_lexicon();
    std::array<ArmState, 2> resting = {resting_arm(ArmSide::left, lexicon.shapes[0].turns),
                                       resting_arm(ArmSide::right, lexicon.shapes[0].turns)};
    std::vector<PerformableGesture> performable_gestures{};

    Schedule plan() {
        performable_gestures.clear();
        for (const PlannedGesture& planned : planned_gestures)
            performable_gestures.push_back(
                make_performable(lexicon.gestures[planned.gesture], planned.left_hand, planned.manner,
                                 {.lexicon = lexicon, .speaker = {}, .variants = variants}));
        return schedule({.planned_gestures = planned_gestures,
                         .performable_gestures = performable_gestures,
                         .lexicon = lexicon,
                         .resting = resting,
                         .variants = variants,
                         .duration = duration});
    }

    // The way of the right wrist from pose to pose of the n-th gesture [m].
    double way(std::size_t n, std::size_t from, std::size_t to) const {
        return distance(performable_gestures[n].poses[from].arms[1]->wrist,
                        performable_gestures[n].poses[to].arms[1]->wrist);
    }
    double way_from_rest(std::size_t n) const {
        return distance(resting[1].wrist, performable_gestures[n].poses[0].arms[1]->wrist);
    }
};

PlannedGesture beat_at(double time, const Manner& manner = {}) {
    return planned_gesture(testing::kBeat, time, manner);
}

Manner with(Expressivity dimension, double value) {
    Manner manner;
    manner[dimension] = value;
    return manner;
}

const ArmTimes& right_times(const Schedule& plan, std::size_t n) {
    return plan.placed[n].arms[1];
}

TEST(Schedule, CountsBackFromTheAccentAndForwardFromIt) {
    Score score{.planned_gestures = {beat_at(5)}};
    const Schedule plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 1u);
    const PlacedStroke& stroke = plan.placed[0].strokes.at(0);
    const double stroke_time = reach_time({.metres = score.way(0, 0, 1)}, 0, {});
    const double connection =
        reach_time({.metres = score.way_from_rest(0), .kind = HandMovementKind::connection}, 0, {});
    EXPECT_DOUBLE_EQ(stroke.end, 5);
    EXPECT_DOUBLE_EQ(stroke.accent, 5);
    EXPECT_NEAR(stroke.start, 5 - stroke_time, 1e-9);
    const ArmTimes& times = right_times(plan, 0);
    EXPECT_NEAR(times.begin, stroke.start - connection, 1e-6);
    EXPECT_NEAR(times.ready, stroke.start, 1e-9);
    EXPECT_NEAR(times.release, 5 + stroke_time / 2, 1e-9);
    EXPECT_TRUE(times.retracted);
    EXPECT_FALSE(plan.placed[0].arms[0].moves);
    EXPECT_THAT(plan.keys[0], IsEmpty());
    EXPECT_THAT(plan.notes, IsEmpty());
}

TEST(Schedule, NamesThePhasesOfTheWayToEachKey) {
    Score score{.planned_gestures = {planned_gesture(testing::kPoint, 5)}};
    const Schedule plan = score.plan();
    std::vector<GesturePhase> phases;
    for (const ArmKey& key : plan.keys[1]) phases.push_back(key.phase);
    using enum GesturePhase;
    EXPECT_THAT(phases,
                ElementsAre(rest, preparation, pre_stroke_hold, stroke, post_stroke_hold, retraction));
    EXPECT_NEAR(plan.keys[1][2].time - plan.keys[1][1].time, 0.2, 1e-9);
    EXPECT_TRUE(
        std::all_of(plan.keys[1].begin(), plan.keys[1].end(), [](const ArmKey& key) { return key.stops; }));
}

TEST(Schedule, LetsTheSlowerArmOfTwoSetTheTime) {
    Score score{.planned_gestures = {planned_gesture(testing::kOffer, 5)}};
    Gesture& offer = score.lexicon.gestures[testing::kOffer];
    offer.poses[1].left->wrist = offer.poses[0].left->wrist + Vec3(0.05f, 0, 0);
    const Schedule plan = score.plan();
    const PlacedStroke& stroke = plan.placed[0].strokes[0];
    EXPECT_NEAR(stroke.end - stroke.start, reach_time({.metres = score.way(0, 0, 1)}, 0, {}), 1e-9);
    EXPECT_TRUE(plan.placed[0].arms[0].moves && plan.placed[0].arms[1].moves);
}

TEST(Schedule, CompressesAPreparationToHalfAtLeast) {
    Score score{.planned_gestures = {beat_at(1)}};
    const Schedule plan = score.plan();
    const double stroke = reach_time({.metres = score.way(0, 0, 1)}, 0, {});
    const double lead =
        reach_time({.metres = score.way_from_rest(0), .kind = HandMovementKind::connection}, 0, {});
    ASSERT_LT(1 - stroke, lead);
    ASSERT_EQ(plan.placed.size(), 1u);
    EXPECT_DOUBLE_EQ(right_times(plan, 0).begin, 0);
    EXPECT_THAT(plan.notes, ElementsAre(HasSubstr("gesture \"beat\" at 1.00 s: preparation of the right hand "
                                                  "compressed to ")));
    score.planned_gestures = {beat_at(stroke + 0.5 * lead + 0.01)};
    EXPECT_EQ(score.plan().placed.size(), 1u);
    score.planned_gestures = {beat_at(stroke + 0.5 * lead - 0.01)};
    EXPECT_THAT(score.plan().placed, IsEmpty());
}

TEST(Schedule, DropsTheLighterOfTwoThatCollide) {
    Score score{.planned_gestures = {beat_at(5), beat_at(5.4)}};
    score.planned_gestures[1].weight = 0.6;
    Schedule plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 1u);
    EXPECT_EQ(plan.placed[0].planned, 1u);
    EXPECT_THAT(plan.notes,
                ElementsAre("gesture \"beat\" at 5.00 s dropped: no time before gesture \"beat\" at 5.40 s"));
    score.planned_gestures[0].weight = 0.7;
    plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 1u);
    EXPECT_EQ(plan.placed[0].planned, 0u);
    EXPECT_THAT(plan.notes,
                ElementsAre("gesture \"beat\" at 5.40 s dropped: no time after gesture \"beat\" at 5.00 s"));
}

TEST(Schedule, LetsEachArmDoItsOwnAtTheSameTime) {
    Score score{.planned_gestures = {beat_at(5), beat_at(5.2)}};
    score.planned_gestures[1].left_hand = true;
    const Schedule plan = score.plan();
    EXPECT_EQ(plan.placed.size(), 2u);
    EXPECT_TRUE(plan.placed[0].arms[1].moves && plan.placed[1].arms[0].moves);
}

// Between two beats 3 s apart the arm pauses for about 1.7 s.
TEST(Schedule, KeepsArmsUpLongerTheMoreFluidTheyAre) {
    const auto retracts = [](double fluidity, double threshold = 1) {
        Score score{.planned_gestures = {beat_at(5, with(Expressivity::fluidity, fluidity)),
                                         beat_at(8, with(Expressivity::fluidity, fluidity))},
                    .variants = {.retraction_threshold = threshold}};
        const Schedule plan = score.plan();
        EXPECT_EQ(plan.placed.size(), 2u);
        EXPECT_TRUE(right_times(plan, 1).retracted);
        return right_times(plan, 0).retracted;
    };
    EXPECT_TRUE(retracts(-1));
    EXPECT_TRUE(retracts(0));
    EXPECT_FALSE(retracts(1));
    EXPECT_FALSE(retracts(0, 2.5));
}

TEST(Schedule, DropsARetractionForWhichThereIsNoTime) {
    Score score{.planned_gestures = {beat_at(5, with(Expressivity::fluidity, -1)), beat_at(6.65)}};
    const Schedule plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 2u);
    EXPECT_FALSE(right_times(plan, 0).retracted);
    EXPECT_THAT(plan.notes,
                ElementsAre("gesture \"beat\" at 5.00 s does not retract: gesture \"beat\" at 6.65 s "
                            "comes too soon"));
    EXPECT_NEAR(right_times(plan, 0).release, right_times(plan, 1).begin, 1e-9);
}

TEST(Schedule, WaitsBeforeTheStrokeWhereTheNextRhemeHasBegun) {
    Score score{.planned_gestures = {beat_at(5), beat_at(7.2)}};
    score.planned_gestures[1].rheme_start = 5.9;
    const Schedule plan = score.plan();
    const ArmTimes& times = right_times(plan, 1);
    const double waits = plan.placed[1].strokes[0].start - times.ready;
    EXPECT_GT(waits, 0.1);
    EXPECT_LE(waits, 0.4 + 1e-9);
    EXPECT_GE(times.begin, 5.9 - 1e-9);
    const auto hold = std::find_if(plan.keys[1].begin(), plan.keys[1].end(), [](const ArmKey& key) {
        return key.phase == GesturePhase::pre_stroke_hold;
    });
    ASSERT_NE(hold, plan.keys[1].end());
    EXPECT_NEAR(hold->time, plan.placed[1].strokes[0].start, 1e-9);
}

TEST(Schedule, RetractsTheHandThatTheNextGestureLeavesIdle) {
    Score score{.planned_gestures = {planned_gesture(testing::kOffer, 5), beat_at(7)}};
    const Schedule plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 2u);
    EXPECT_TRUE(plan.placed[0].arms[0].retracted);
    EXPECT_FALSE(plan.placed[0].arms[1].retracted);
}

// A rheme of 2.7 s that begins at 4.6 s, and an accent in about every second.
std::size_t strokes_for(double repetition, std::size_t gesture = testing::kBeat) {
    Score score{
        .planned_gestures = {planned_gesture(gesture, 5, with(Expressivity::repetition, repetition))}};
    PlannedGesture& planned = score.planned_gestures[0];
    planned.rheme_start = 4.6;
    planned.rheme_end = 7.3;
    planned.accents = {6.1, 7.2, 8.4, 9.6, 10.8};
    const Schedule plan = score.plan();
    for (const PlacedStroke& stroke : plan.placed.at(0).strokes) EXPECT_EQ(stroke.end, stroke.accent);
    return plan.placed[0].strokes.size();
}

TEST(Schedule, RepeatsTheStrokeUpToTheHorizonOfRepetition) {
    EXPECT_EQ(strokes_for(-1), 1u);
    EXPECT_EQ(strokes_for(-0.5), 2u);  // 2.7 / 1.5 s: to 6.4 s
    EXPECT_EQ(strokes_for(0), 3u);
    EXPECT_EQ(strokes_for(0.25), 4u);  // 1.25 * 1.25 * 2.7 s: to 8.8 s
    EXPECT_EQ(strokes_for(1), 6u);     // 1.25 * 2 * 2.7 s: to 11.35 s
    EXPECT_EQ(strokes_for(1, testing::kPoint), 1u);
}

// The same beat with accents to be repeated on, and its author's times.
Score beat_with_times(std::optional<double> relax, std::optional<double> end) {
    Score score{.planned_gestures = {beat_at(5)}};
    PlannedGesture& planned = score.planned_gestures[0];
    planned.rheme_start = 4.6;
    planned.rheme_end = 7.3;
    planned.accents = {6.1, 7.2};
    planned.relax = relax;
    planned.end = end;
    return score;
}

TEST(Schedule, HoldsUntilItsAuthorRelaxesIt) {
    for (const double relax : {5.0, 5.1, 7.5}) {
        Score score = beat_with_times(relax, std::nullopt);
        const Schedule plan = score.plan();
        EXPECT_EQ(plan.placed.at(0).strokes.size(), 1u);
        EXPECT_DOUBLE_EQ(right_times(plan, 0).release, relax);
        EXPECT_THAT(plan.notes, IsEmpty());
    }
}

TEST(Schedule, IsBackAtRestWhenItsAuthorEndsIt) {
    const double way = right_times(beat_with_times(5, std::nullopt).plan(), 0).rest - 5;
    for (const double end : {5 + way, 6.0, 6.1 + way, 9.0}) {
        Score score = beat_with_times(std::nullopt, end);
        const Schedule plan = score.plan();
        EXPECT_NEAR(right_times(plan, 0).rest, end, 1e-9);
        EXPECT_EQ(plan.placed.at(0).strokes.size(), end < 6.1 + way - 0.01 ? 1u : end < 8 ? 2u : 3u) << end;
        EXPECT_THAT(plan.notes, IsEmpty());
    }
    Score score = beat_with_times(5.2, 5.2 + 0.6 * way);
    EXPECT_NEAR(right_times(score.plan(), 0).rest, 5.2 + 0.6 * way, 1e-9);
}

TEST(Schedule, NotesTimesOfAnAuthorThatCannotBeMet) {
    Score late = beat_with_times(5.2, 5.25);
    const Schedule plan = late.plan();
    const double rest = right_times(plan, 0).rest;
    EXPECT_DOUBLE_EQ(right_times(plan, 0).release, 5.2);
    EXPECT_THAT(plan.notes,
                ElementsAre(format("gesture \"beat\" at 5.00 s: the right hand is back at rest at {:.2f} s "
                                   "instead of 5.25 s: it leaves at 5.20 s, and the way takes {:.2f} s",
                                   rest, rest - 5.2)));
    EXPECT_THAT(beat_with_times(4.5, std::nullopt).plan().notes,
                ElementsAre("gesture \"beat\" at 5.00 s relaxes at 5.00 s instead of 4.50 s: its stroke ends "
                            "then"));
    EXPECT_THAT(
        beat_with_times(61, std::nullopt).plan().notes,
        ElementsAre("gesture \"beat\" at 5.00 s: the motion ends at 60.00 s, before the relaxation at "
                    "61.00 s"));
    EXPECT_THAT(
        beat_with_times(5.5, 61).plan().notes,
        ElementsAre("gesture \"beat\" at 5.00 s: the motion ends at 60.00 s, before the end at 61.00 s"));
}

TEST(Schedule, TheNextGestureEndsAHold) {
    Score score = beat_with_times(7.9, std::nullopt);
    score.planned_gestures.push_back(beat_at(8));
    const Schedule plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 2u);
    const double begin = right_times(plan, 1).begin;
    EXPECT_LT(begin, 7.9);
    EXPECT_DOUBLE_EQ(right_times(plan, 0).release, begin);
    EXPECT_THAT(
        plan.notes,
        ElementsAre("gesture \"beat\" at 5.00 s does not retract: gesture \"beat\" at 8.00 s comes too "
                    "soon",
                    format("gesture \"beat\" at 5.00 s is held until {:.2f} s instead of 7.90 s: gesture "
                           "\"beat\" at 8.00 s begins then",
                           begin)));
}

// Without an end the arm would stay up in such a pause.
TEST(Schedule, RetractsInAShortPauseToMeetAnEnd) {
    for (const bool has_end : {false, true}) {
        Score score = beat_with_times(std::nullopt, has_end ? std::optional(6.2) : std::nullopt);
        score.variants.retraction_threshold = 3;
        score.planned_gestures[0].accents.clear();
        score.planned_gestures.push_back(beat_at(8));
        const Schedule plan = score.plan();
        EXPECT_EQ(right_times(plan, 0).retracted, has_end);
        if (has_end) {
            EXPECT_NEAR(right_times(plan, 0).rest, 6.2, 1e-9);
        }
    }
}

TEST(Schedule, SkipsAccentsThatComeTooSoonAndEndsBeforeTheNextGesture) {
    Score score{.planned_gestures = {beat_at(5, with(Expressivity::repetition, 1)), beat_at(8)}};
    score.planned_gestures[0].rheme_end = 12;
    score.planned_gestures[0].accents = {5.3, 5.5, 6.2, 6.3, 7.9};
    const Schedule plan = score.plan();
    ASSERT_EQ(plan.placed.size(), 2u);
    ASSERT_EQ(plan.placed[0].strokes.size(), 2u);
    const PlacedStroke& repeat = plan.placed[0].strokes[1];
    EXPECT_DOUBLE_EQ(repeat.end, 6.2);
    EXPECT_TRUE(repeat.repeated);
    EXPECT_LE(repeat.end, right_times(plan, 1).begin);
}

TEST(Schedule, GoesBackForARepeatAsFarAsPowerAsks) {
    for (const double power : {-1.0, 0.0, 1.0}) {
        Score score{.planned_gestures = {beat_at(5, with(Expressivity::power, power))}};
        score.planned_gestures[0].rheme_end = 12;
        score.planned_gestures[0].accents = {6.5};
        const Schedule plan = score.plan();
        const double start = plan.placed.at(0).strokes.at(1).start;
        const auto back = std::find_if(plan.keys[1].begin(), plan.keys[1].end(),
                                       [&](const ArmKey& key) { return std::abs(key.time - start) < 1e-9; });
        ASSERT_NE(back, plan.keys[1].end());
        EXPECT_EQ(back->phase, GesturePhase::preparation);
        const ArmState& end = *score.performable_gestures[0].stroke_end().arms[1];
        EXPECT_NEAR(distance(back->state.wrist, end.wrist), (0.6 + 0.3 * power) * score.way(0, 0, 1), 1e-5);
    }
}

TEST(Schedule, PutsNoTwoKeysAtOneTime) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const testing::RandomScore random = testing::random_score(seed);
        Score score{.planned_gestures = random.planned_gestures, .duration = 20};
        score.lexicon = random.lexicon;
        const Schedule plan = score.plan();
        for (const auto& keys : plan.keys)
            for (std::size_t k = 1; k < keys.size(); ++k) ASSERT_GT(keys[k].time, keys[k - 1].time + 1e-9);
        for (std::size_t n = 1; n < plan.placed.size(); ++n)
            EXPECT_GE(plan.placed[n].strokes[0].end, plan.placed[n - 1].strokes[0].end);
    }
}

}  // namespace
}  // namespace chironomia
