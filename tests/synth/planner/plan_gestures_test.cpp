#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "synth/planner/plan_behaviours.h"
#include "synth/planner/plan_gestures.h"
#include "tests/support/support.h"
#include "tests/synth/planner/plan_support.h"
#include "tests/synth/planner/talk.h"

namespace chironomia {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using testing::full_lexicon;
using ::testing::IsEmpty;
using testing::refusal_of;
using testing::small_lexicon;
using testing::speaker_of;
using testing::spoken;

const double kThird = 0.4 / 3;  // where a word without phonemes is stressed [s]

std::vector<PlannedGesture> planned(const Speech& speech, double activation = 1, std::uint64_t seed = 1) {
    return plan_behaviours(speech, {small_lexicon(), speaker_of(activation), {}}, seed).gestures;
}

std::vector<std::string> shown(const std::vector<PlannedGesture>& gestures) {
    std::vector<std::string> ids;
    for (const PlannedGesture& gesture : gestures)
        ids.push_back(small_lexicon().gestures[gesture.gesture].id);
    return ids;
}

Mark mark(MarkKind kind, std::string value, std::size_t first, std::size_t end, double weight = 0.5) {
    return {.kind = kind, .value = std::move(value), .first_word = first, .end_word = end, .weight = weight};
}

const Speech& talk() {
    static const Speech speech = spoken(parse_marked_text({.text = testing::kTalk, .language = "en"}));
    return speech;
}

TEST(PlanGestures, ShowsAnActWhoseWeightIsMoreThanTheActivationLeaves) {
    const Speech speech = spoken("hello there", {mark(MarkKind::performative, "greet", 0, 2, 0.4)});
    EXPECT_THAT(planned(speech, 0.6), IsEmpty());  // 0.4 is not more than 1 - 0.6
    EXPECT_THAT(shown(planned(speech, 0.61)), ElementsAre("wave"));
}

TEST(PlanGestures, AnActMayHaveAnActivationOfItsOwn) {
    Speech speech = spoken("hello there", {mark(MarkKind::performative, "greet", 0, 2, 0.4)});
    speech.marks[0].manner[Expressivity::overall_activation] = 0.9;
    EXPECT_THAT(shown(planned(speech, 0)), ElementsAre("wave"));
    speech.marks[0].manner[Expressivity::overall_activation] = 0;
    EXPECT_THAT(planned(speech, 1), IsEmpty());
}

TEST(PlanGestures, NotesANamedGestureThatAnotherOnItsWordDrops) {
    const Speech speech = spoken("hello there", {mark(MarkKind::gesture, "wave", 0, 1, 0.9),
                                                 mark(MarkKind::gesture, "offer", 0, 1, 0.8),
                                                 mark(MarkKind::emphasis, "low", 0, 1, 0.9)});
    const Behaviours behaviours = plan_behaviours(speech, {small_lexicon(), speaker_of(1), {}}, 1);
    EXPECT_THAT(shown(behaviours.gestures), ElementsAre("wave"));
    EXPECT_THAT(
        behaviours.notes,
        ElementsAre("gesture \"offer\" at 0.13 s dropped: gesture \"wave\" at 0.13 s is on the same word, "
                    "\"hello\""));
}

TEST(PlanGestures, EndsTheStrokeWithTheVowelUnderPrimaryStress) {
    Speech speech = spoken("a banana", {mark(MarkKind::emphasis, "high", 1, 2)});
    speech.phonemes = {{"ə", 0, 0.4, Stress::none},         {"b", 0.4, 0.45, Stress::none},
                       {"ə", 0.45, 0.5, Stress::secondary}, {"n", 0.5, 0.55, Stress::none},
                       {"ɑː", 0.55, 0.7, Stress::primary},  {"nə", 0.7, 0.8, Stress::none}};
    speech.words[0].end_phoneme = 1;
    speech.words[1].first_phoneme = 1;
    speech.words[1].end_phoneme = 6;
    ASSERT_EQ(planned(speech).size(), 1u);
    EXPECT_EQ(planned(speech)[0].stroke_end, 0.55);
    speech.phonemes[4].stress = Stress::none;
    EXPECT_EQ(planned(speech)[0].stroke_end, 0.45);
    speech.words[1].end_phoneme = 1;
    EXPECT_DOUBLE_EQ(planned(speech)[0].stroke_end, 0.4 + kThird);
}

TEST(PlanGestures, ShowsAClauseOnItsLastAccentAndAWordOnItself) {
    const Speech speech =
        spoken("the wheel over there turns quickly now",
               {mark(MarkKind::performative, "ask", 0, 7, 0.9), mark(MarkKind::rheme, "", 1, 7),
                mark(MarkKind::pitch_accent, "Hstar", 1, 2, 0), mark(MarkKind::deictic, "place-there", 2, 4),
                mark(MarkKind::pitch_accent, "Hstar", 5, 6, 0)});
    const std::vector<PlannedGesture> gestures = planned(speech);
    EXPECT_THAT(shown(gestures), ElementsAre("point", "offer"));
    EXPECT_DOUBLE_EQ(gestures[0].stroke_end, 1.2 + kThird);
    EXPECT_EQ(gestures[0].function, "deictic=place-there");
    EXPECT_DOUBLE_EQ(gestures[1].stroke_end, 2.0 + kThird);
    EXPECT_EQ(gestures[1].weight, 0.9);
    EXPECT_DOUBLE_EQ(gestures[1].rheme_start, 0.4);
    EXPECT_DOUBLE_EQ(gestures[1].rheme_end, 2.8);
}

TEST(PlanGestures, OfSeveralActsOnAWordTheOneThatSaysMostIsShown) {
    Speech speech =
        spoken("a ball", {mark(MarkKind::rheme, "", 0, 2, 0.9), mark(MarkKind::emphasis, "high", 1, 2, 0.8),
                          mark(MarkKind::world, "shape-round", 1, 2, 0.3)});
    EXPECT_THAT(shown(planned(speech, 1)), ElementsAre("ring"));
    // Where the ring is not shown, the beat is: of emphasis, which says more than a rheme.
    const std::vector<PlannedGesture> gestures = planned(speech, 0.5);
    ASSERT_EQ(gestures.size(), 1u);
    EXPECT_EQ(gestures[0].function, "emphasis=high");
}

TEST(PlanGestures, FallsBackFromTheValueToItsStemToItsKindToBeats) {
    const auto gestures_of = [](MarkKind kind, const std::string& value) {
        return shown(planned(spoken("one", {mark(kind, value, 0, 1)})));
    };
    EXPECT_THAT(gestures_of(MarkKind::world, "shape-round"), ElementsAre("ring"));
    EXPECT_THAT(gestures_of(MarkKind::performative, "thank"), ElementsAre("offer"));
    EXPECT_THAT(gestures_of(MarkKind::emotion, "joy"), IsEmpty());
    EXPECT_THAT(gestures_of(MarkKind::emphasis, "low"), ElementsAre("beat_down"));
    std::set<std::string> beats;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (const std::string& id :
             shown(planned(spoken("one", {mark(MarkKind::emphasis, "high", 0, 1)}), 1, seed)))
            beats.insert(id);
    EXPECT_THAT(beats, ElementsAre("beat_down", "beat_out"));
}

TEST(PlanGestures, ShowsANamedGestureOrElseItsFunction) {
    Mark named = mark(MarkKind::gesture, "wave", 0, 1, 1);
    EXPECT_THAT(shown(planned(spoken("one", {named}))), ElementsAre("wave"));
    named.value = "ask_Ges_B";
    named.reference = "performative=ask";
    const std::vector<PlannedGesture> gestures = planned(spoken("one", {named}));
    EXPECT_THAT(shown(gestures), ElementsAre("offer"));
    EXPECT_EQ(gestures[0].function, "performative=ask");
    named.value = "wve";
    named.reference = "";
    EXPECT_EQ(
        refusal_of([&] { planned(spoken("one", {named}), 0); }),
        "gesture \"wve\": none of the 6 gestures of the lexicon has this name; did you mean wave? Write one that "
        "is there, or say what it shows (reference=\"performative=ask\")");
}

TEST(PlanGestures, AnUnknownNameIsRefusedWithItsPlace) {
    const auto refusal = [](const std::string& text) {
        return refusal_of(
            [&] { check_gesture_names(parse_marked_text({.text = text, .name = "talk"}), small_lexicon()); });
    };
    const std::string unknown =
        "gesture \"wve\": none of the 6 gestures of the lexicon has this name; did you mean wave? Write one that is "
        "there, or say what it shows (reference=\"performative=ask\")";
    EXPECT_EQ(refusal("<bml><speech>Hi</speech>\n<gesture lexeme=\"wve\"/></bml>"), "talk:2:2: " + unknown);
    EXPECT_EQ(refusal("<APLM>\n<gesture name=\"wve\">Hi</gesture></APLM>"), "talk:2:2: " + unknown);
    check_gesture_names(
        parse_marked_text({.text = "<APLM><gesture name=\"wave\">Hi</gesture><gesture name=\"wve\" "
                                   "reference=\"performative=ask\">there</gesture></APLM>"}),
        small_lexicon());
}

TEST(PlanGestures, ANamedGestureEndsItsStrokeWhenItsAuthorSaid) {
    const auto end_with = [](const MarkTimes& times) {
        Mark named = mark(MarkKind::gesture, "wave", 0, 4, 1);
        named.times = times;
        return planned(spoken("one wheel turns quickly", {named})).at(0).stroke_end;
    };
    EXPECT_DOUBLE_EQ(end_with({.stroke = SyncPoint{1, 0.1}, .stroke_end = SyncPoint{2, 0.1}}), 0.9);
    EXPECT_DOUBLE_EQ(end_with({.ready = SyncPoint{0, 0}, .stroke = SyncPoint{1, 0.1}}), 0.5);
    EXPECT_DOUBLE_EQ(end_with({.ready = SyncPoint{2, -0.2}, .relax = SyncPoint{4, 0}}),
                     0.8 + kThird);                                 // "turns"
    EXPECT_DOUBLE_EQ(end_with({.ready = SyncPoint{3, 0.2}}), 1.7);  // no accent is left: 0.3 s later
    EXPECT_DOUBLE_EQ(end_with({.end = SyncPoint{0, 0.3}}), 0.1);    // none before: 0.2 s earlier
    EXPECT_DOUBLE_EQ(end_with({.start = SyncPoint{std::nullopt, 1.4}}), 1.7);
}

TEST(PlanGestures, ANamedGestureKeepsItsAuthorsRelaxationAndEnd) {
    Mark named = mark(MarkKind::gesture, "wave", 0, 4, 1);
    named.times = {.stroke = SyncPoint{1, 0.1}, .relax = SyncPoint{2, 0.1}, .end = SyncPoint{4, 0}};
    const PlannedGesture timed = planned(spoken("one wheel turns quickly", {named})).at(0);
    EXPECT_EQ(timed.relax, 0.8 + 0.1);
    EXPECT_EQ(timed.end, 1.6);
    named.times = {.stroke = SyncPoint{1, 0.1}};
    const PlannedGesture free = planned(spoken("one wheel turns quickly", {named})).at(0);
    EXPECT_FALSE(free.relax || free.end);
}

TEST(PlanGestures, NamesTheLaterAccentsUpToTheLongestHorizon) {
    std::vector<Mark> marks = {mark(MarkKind::rheme, "", 0, 4)};
    for (std::size_t word = 0; word < 12; ++word)
        marks.push_back(mark(MarkKind::pitch_accent, "Hstar", word, word + 1, 0));
    const std::vector<PlannedGesture> gestures = planned(spoken("a b c d e f g h i j k l", marks));
    ASSERT_EQ(gestures.size(), 1u);
    EXPECT_DOUBLE_EQ(gestures[0].stroke_end, 1.2 + kThird);
    // 2 * 1.25 * 1.6 s reach to 4.0 s: the accents of the words 4 to 9.
    ASSERT_EQ(gestures[0].accents.size(), 6u);
    EXPECT_DOUBLE_EQ(gestures[0].accents.front(), 1.6 + kThird);
    EXPECT_DOUBLE_EQ(gestures[0].accents.back(), 3.6 + kThird);
}

TEST(PlanGestures, FindsAccentsWhereNobodyMarkedThem) {
    const Behaviours unmarked =
        plan_behaviours(spoken("the big wheel of time"), {small_lexicon(), {}, {}}, 1);
    EXPECT_THAT(unmarked.accents, ElementsAre(DoubleNear(0.4 + kThird, 1e-9), DoubleNear(0.8 + kThird, 1e-9),
                                              DoubleNear(1.6 + kThird, 1e-9)));
    const Speech speech = spoken("the big wheel of it", {mark(MarkKind::pitch_accent, "Hstar", 0, 1),
                                                         mark(MarkKind::rheme, "", 1, 5)});
    const Behaviours marked = plan_behaviours(speech, {small_lexicon(), {}, {}}, 1);
    EXPECT_THAT(marked.accents, ElementsAre(DoubleNear(kThird, 1e-9), DoubleNear(0.8 + kThird, 1e-9)));
}

TEST(PlanGestures, ActsTakeOverTheMannerOfThoseAroundThem) {
    Speech speech = spoken("one two three",
                           {mark(MarkKind::performative, "inform", 0, 3),
                            mark(MarkKind::emphasis, "high", 0, 1), mark(MarkKind::emphasis, "high", 1, 2)});
    speech.marks[0].manner[Expressivity::spatial_extent] = 0.5;
    speech.marks[2].manner[Expressivity::spatial_extent] = -1;
    Speaker speaker = speaker_of(1);
    speaker.manner[Expressivity::power] = 0.25;
    const std::vector<PlannedGesture> gestures =
        plan_behaviours(speech, {small_lexicon(), speaker, {}}, 1).gestures;
    ASSERT_EQ(gestures.size(), 3u);
    EXPECT_EQ(gestures[0].manner[Expressivity::spatial_extent], 0.5);
    EXPECT_EQ(gestures[1].manner[Expressivity::spatial_extent], -1);
    EXPECT_EQ(gestures[1].manner[Expressivity::power], 0.25);
}

TEST(PlanGestures, TheHandFollowsTheSpeakersHabit) {
    const auto share_of_left = [](double handedness) {
        Speaker speaker = speaker_of(1);
        speaker.handedness = handedness;
        const std::vector<PlannedGesture> gestures =
            plan_behaviours(talk(), {small_lexicon(), speaker, {}}, 1).gestures;
        const auto left = std::count_if(gestures.begin(), gestures.end(),
                                        [](const PlannedGesture& w) { return w.left_hand; });
        return static_cast<double>(left) / static_cast<double>(gestures.size());
    };
    EXPECT_EQ(share_of_left(1), 0);
    EXPECT_EQ(share_of_left(-1), 1);
    EXPECT_NEAR(share_of_left(0), 0.5, 0.2);
}

TEST(PlanGestures, NoGestureFollowsItself) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Behaviours planned = plan_behaviours(talk(), {full_lexicon(), speaker_of(1), {}}, seed);
        for (std::size_t i = 1; i < planned.gestures.size(); ++i)
            EXPECT_NE(planned.gestures[i].gesture, planned.gestures[i - 1].gesture) << i;
    }
    // The lexicon has one gesture for emphasis=low; the other one is the other beat.
    const Mark low = {.kind = MarkKind::emphasis, .value = "low", .end_word = 1};
    Mark again = low;
    again.first_word = 1;
    again.end_word = 2;
    EXPECT_THAT(shown(planned(spoken("one two", {low, again}))), ElementsAre("beat_down", "beat_out"));
}

TEST(PlanGestures, AHigherActivationOnlyAdds) {
    std::set<double> before;
    std::size_t last = 0;
    for (int tenth = 0; tenth <= 10; ++tenth) {
        const std::vector<PlannedGesture> gestures = planned(talk(), tenth / 10.0);
        std::set<double> moments;
        for (const PlannedGesture& gesture : gestures) moments.insert(gesture.stroke_end);
        EXPECT_TRUE(std::includes(moments.begin(), moments.end(), before.begin(), before.end())) << tenth;
        EXPECT_GE(gestures.size(), last);
        EXPECT_EQ(gestures.empty(), tenth <= 1) << tenth;
        before = std::move(moments);
        last = gestures.size();
    }
}

// What people do who talk freely; the weights of the rules are set so.
TEST(PlanGestures, AnOrdinarySpeakerMakesTenToSixteenGesturesAMinute) {
    const double minutes = talk().words.back().end / 60;
    const auto rate = [&](double activation) {
        const Behaviours planned = plan_behaviours(talk(), {full_lexicon(), speaker_of(activation), {}}, 1);
        return static_cast<double>(planned.gestures.size()) / minutes;
    };
    EXPECT_GT(rate(0.5), 10);
    EXPECT_LT(rate(0.5), 16);
    EXPECT_GT(rate(1), 22);
    EXPECT_LT(rate(1), 32);
}

TEST(PlanGestures, TheMannerChangesTheMannerAlone) {
    Speaker other = speaker_of(0.7);
    for (const Expressivity dimension :
         {Expressivity::spatial_extent, Expressivity::temporal_extent, Expressivity::fluidity,
          Expressivity::power, Expressivity::repetition})
        other.manner[dimension] = -0.8;
    const std::vector<PlannedGesture> a = planned(talk(), 0.7);
    const std::vector<PlannedGesture> b = plan_behaviours(talk(), {small_lexicon(), other, {}}, 1).gestures;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].gesture, b[i].gesture);
        EXPECT_EQ(a[i].stroke_end, b[i].stroke_end);
        EXPECT_EQ(a[i].left_hand, b[i].left_hand);
    }
}

TEST(PlanGestures, TheSameSeedChoosesTheSameAndAnotherOthers) {
    const auto chosen = [](std::uint64_t seed) {
        std::vector<std::size_t> gestures;
        for (const PlannedGesture& gesture :
             plan_behaviours(talk(), {full_lexicon(), speaker_of(1), {}}, seed).gestures)
            gestures.push_back(gesture.gesture);
        return gestures;
    };
    EXPECT_EQ(chosen(7), chosen(7));
    EXPECT_NE(chosen(7), chosen(8));
}

TEST(PlanGestures, NobodySpeaksNobodyGestures) {
    EXPECT_THAT(planned(Speech{}), IsEmpty());
    EXPECT_THAT(plan_behaviours(talk(), {Lexicon{}, speaker_of(1), {}}, 1).gestures, IsEmpty());
}

}  // namespace
}  // namespace chironomia
