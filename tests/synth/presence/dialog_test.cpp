#include "synth/presence/dialog.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synth/presence/attend.h"
#include "synth/presence/turns.h"
#include "tests/synth/correlation.h"
#include "tests/synth/lagged_correlation.h"
#include "tests/synth/presence/presence_support.h"

namespace chironomia {
namespace {

using testing::babble;
using testing::correlation;
using testing::head_down;
using testing::intensities_of;
using testing::lagged_correlation;
using testing::LaggedCorrelation;
using testing::ranks_of;
using testing::signal_at;

constexpr double kFps = 25;

// Two who talk by turns of `turn` seconds, and smile as they please while they do.
std::array<Interlocutor, 2> talkers(double seconds, double turn, std::uint64_t seed) {
    std::array<Interlocutor, 2> people;
    Random random(seed, 1);
    for (int i = 0; i * turn < seconds; ++i) {
        Interlocutor& person = people[static_cast<std::size_t>(i) % 2];
        const double start = i * turn, end = start + turn;
        const Speech said = babble(start + 0.5, end);
        person.speech.words.insert(person.speech.words.end(), said.words.begin(), said.words.end());
        for (double time = start + draw_between(random, 0.2, 1); time + 2 < end;) {
            Signal smile = signal_at(SignalKind::smile, time, draw_between(random, 0.3, 1));
            smile.hold = smile.peak + draw_between(random, 0.1, 1);
            smile.end = smile.hold + 0.6;
            person.behaviours.signals.push_back(smile);
            time = smile.end + draw_between(random, 0.3, 3);
        }
        for (std::size_t w = 0; w < said.words.size(); w += 3)
            person.behaviours.accents.push_back(said.words[w].start + 0.1);
    }
    return people;
}

LaggedCorrelation measured(const Coupling& coupling, std::uint64_t seed) {
    constexpr double kSeconds = 240;
    const auto [first, second] =
        animate_dialog(talkers(kSeconds, 11, seed), coupling,
                       {.frames = static_cast<std::size_t>(kSeconds * kFps), .fps = kFps}, seed);
    return lagged_correlation(intensities_of(first, 12), intensities_of(second, 12), kFps);
}

TEST(Dialog, SmilesBackWithTheDelayAndTheStrengthThatAreSet) {
    std::vector<double> errors, strengths, scores;
    for (std::uint64_t i = 0; i < 12; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / 12;
        // Every delay once with some strength, in no order.
        const Coupling coupling{.strength = 0.8 * share,
                                .delay = 0.3 + 0.9 * (static_cast<double>(i * 5 % 12) + 0.5) / 12};
        const LaggedCorrelation found = measured(coupling, i);
        errors.push_back(std::abs(found.delay - coupling.delay));
        strengths.push_back(coupling.strength);
        scores.push_back(found.score);
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT((errors[5] + errors[6]) / 2, 0.12);
    const std::vector<double> by_strength = ranks_of(strengths), by_score = ranks_of(scores);
    EXPECT_GT(correlation(by_strength, by_score), 0.8);
}

constexpr FrameTimes kHalfAMinute{.frames = 750, .fps = kFps};

// What is shown of a smile is held below 5; this is the smile.
double smile_shown_by(double intensity) {
    const double square = intensity * intensity / 25;
    return intensity / std::pow(1 - square * square, 0.25) / 3.2;
}

TEST(Dialog, EchoesTheSpeakerAloneAndExactly) {
    std::array<Interlocutor, 2> people = talkers(30, 15, 3);
    // Both smile in both turns, but only the speaker's smile comes back.
    people[0].behaviours.signals = {signal_at(SignalKind::smile, 5), signal_at(SignalKind::smile, 21)};
    people[1].behaviours.signals = {signal_at(SignalKind::smile, 11, 0.5)};
    const Coupling coupling{.strength = 0.6, .delay = 0.8};
    const auto with = animate_dialog(people, coupling, kHalfAMinute, 9);
    const auto without = animate_dialog(people, {.strength = 0, .delay = 0.8}, kHalfAMinute, 9);
    const std::vector<double> speaker = intensities_of(without[0], 12),
                              alone = intensities_of(without[1], 12), listener = intensities_of(with[1], 12);
    const std::vector<double> coupled = intensities_of(with[0], 12);
    EXPECT_TRUE(std::equal(speaker.begin(), speaker.begin() + 380, coupled.begin())) << "while they speak";
    for (std::size_t t = 120; t < 200; ++t) {
        const double echo = smile_shown_by(listener[t]) - smile_shown_by(alone[t]);
        ASSERT_NEAR(echo, 0.6 * smile_shown_by(speaker[t - 20]), 1e-3) << t;
    }
    EXPECT_GT(listener[165], 1.5);
    EXPECT_NEAR(listener[560], alone[560], 1e-6) << "of a smile while the other has the floor";
}

TEST(Dialog, IsTheSameForASeedAndTwoPeopleEvenForTwins) {
    std::array<Interlocutor, 2> people = talkers(30, 15, 3);
    const auto first = animate_dialog(people, {}, kHalfAMinute, 1),
               second = animate_dialog(people, {}, kHalfAMinute, 1);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(first[i].turns, second[i].turns);
        EXPECT_EQ(first[i].face.intensities, second[i].face.intensities);
    }
    people[1] = people[0];
    const auto twins = animate_dialog(people, {}, kHalfAMinute, 1);
    EXPECT_NE(twins[0].turns, twins[1].turns);
    EXPECT_NE(animate_dialog(people, {}, kHalfAMinute, 2)[0].turns, twins[0].turns);
}

TEST(Dialog, LooksWhereThePartnerStands) {
    std::array<Interlocutor, 2> people = talkers(30, 15, 3);
    people[0].partner = radians(35.0);
    for (Interlocutor& person : people)
        person.behaviours.signals.push_back({SignalKind::look_at, 0, 0.1, 29, 30, 1});
    const auto bodies = animate_dialog(people, {}, kHalfAMinute, 4);
    for (std::size_t t = 0; t < 700; t += 10) {
        const Vec3 eye = testing::place_of(bodies[0], t, HumanJoint::left_eye).turn * Vec3(0, 0, 1);
        ASSERT_NEAR(std::atan2(eye.x, eye.z), radians(35.0), radians(3.0)) << t;
        ASSERT_NEAR(testing::head_left(bodies[1], t), 0, radians(14.0)) << t;
    }
    EXPECT_NEAR(testing::head_left(bodies[0], 100), radians(23.0), radians(10.0));
}

// A partner who speaks for a minute in phrases of 4 s, with 12 accents in each.
struct Lecture {
    std::vector<Phrase> phrases = phrases_of(babble(1, 61));
    std::vector<double> accents;

    Lecture() {
        for (const SpokenWord& word : babble(1, 61).words) accents.push_back(word.start + 0.1);
    }
    std::vector<Signal> attended(double activation, std::vector<Signal> own = {}) const {
        Speaker speaker;
        speaker.manner[Expressivity::overall_activation] = activation;
        return attend(std::move(own), {.person = 1,
                                       .floors = floor_times({phrases, {{62, 70}}}),
                                       .partner = {phrases, accents},
                                       .speaker = speaker,
                                       .seed = 5});
    }
};

std::ptrdiff_t count_of(const std::vector<Signal>& signals, SignalKind kind) {
    return std::count_if(signals.begin(), signals.end(),
                         [&](const Signal& signal) { return signal.kind == kind; });
}

TEST(Attend, NodsInPausesAndTheMoreTheLivelierTheListener) {
    const std::vector<Signal> usual = Lecture().attended(0.5);
    EXPECT_GE(count_of(usual, SignalKind::nod), 8);
    EXPECT_LE(count_of(usual, SignalKind::nod), 34);
    EXPECT_GT(count_of(Lecture().attended(1), SignalKind::nod), count_of(usual, SignalKind::nod));
    EXPECT_LT(count_of(Lecture().attended(0), SignalKind::nod), count_of(usual, SignalKind::nod));
    EXPECT_TRUE(std::is_sorted(usual.begin(), usual.end(),
                               [](const Signal& a, const Signal& b) { return a.start < b.start; }));
    double last = -10;
    for (const Signal& signal : usual) {
        if (signal.kind != SignalKind::nod) continue;
        EXPECT_GT(signal.start - last, 0.45);
        EXPECT_LT(signal.amount, 1);
        last = signal.start;
    }
}

TEST(Attend, LooksAwayWhenTakingTheTurnUnlessSignalsSayWhereToLook) {
    const auto taking = [](const std::vector<Signal>& signals) {
        return std::count_if(signals.begin(), signals.end(), [](const Signal& signal) {
            return signal.kind == SignalKind::look_away && std::abs(signal.start - 62) < 0.3;
        });
    };
    EXPECT_EQ(taking(Lecture().attended(0.5)), 1);
    EXPECT_EQ(taking(Lecture().attended(0.5, {signal_at(SignalKind::look_at, 61.5)})), 0);
}

TEST(Attend, LooksAtThePartnerAtTheEndOfItsTurn) {
    const std::vector<Phrase> mine = {{1, 5}}, theirs = {{6, 9}};
    const std::vector<Signal> signals = attend({}, {.person = 0,
                                                    .floors = floor_times({mine, theirs}),
                                                    .partner = {theirs, {}},
                                                    .speaker = {},
                                                    .seed = 5});
    EXPECT_EQ(count_of(signals, SignalKind::look_at), 1);
    for (const Signal& signal : signals) {
        if (signal.kind != SignalKind::look_at) continue;
        EXPECT_LT(signal.start, 5);
        EXPECT_GT(signal.end, 5);
    }
}

TEST(Dialog, ShowsTheNodsOfTheListener) {
    std::array<Interlocutor, 2> people = talkers(30, 30, 3);
    people[1].speaker.manner[Expressivity::overall_activation] = 1;
    const auto bodies = animate_dialog(people, {}, kHalfAMinute, 4);
    double deepest = 0;
    for (std::size_t t = 5; t < 750; ++t)
        deepest = std::max(deepest, head_down(bodies[1], t) - head_down(bodies[1], t - 5));
    EXPECT_GT(deepest, radians(4.0));
}

}  // namespace
}  // namespace chironomia
