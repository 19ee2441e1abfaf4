// Checks generated dyads by what their files hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "core/text.h"
#include "tests/synth/corpus/made.h"
#include "tests/synth/lagged_correlation.h"

namespace chironomia {
namespace {

using testing::correlation;
using testing::ranks_of;

// Twelve dyads in six groups of three people.
struct Dyads {
    Dyads() {
        index = testing::made(plan_dyads(order, testing::corpus_lexicon(),
                                         {.dyads = 12, .seconds = 100, .people = 3, .meetings = 2}),
                              order);
    }

    static const Dyads& of_all_tests() {
        static const Dyads all;
        return all;
    }

    testing::TemporaryFolder folder;
    CorpusOrder order{.kind = CorpusKind::dyads, .folder = folder.path(), .seed = 1};
    CorpusIndex index;
};

// AU12 of one of the two.
std::vector<double> smile_of(const DyadPerson& person) {
    std::vector<double> smile;
    for (std::size_t i = DyadPerson::kFace - 1; i < person.face.size(); i += DyadPerson::kFace)
        smile.push_back(person.face[i]);
    return smile;
}

// One speaks while the other does not, and both do.
void expect_turns(const DyadRecord& record) {
    ASSERT_EQ(record.people[0].face.size(), record.people[1].face.size());
    EXPECT_GE(static_cast<double>(record.frames()) / record.fps, 95) << record.id;
    EXPECT_EQ(record.people[0].role, "expert");
    std::array<std::size_t, 2> voiced{};
    std::size_t both = 0;
    for (std::size_t t = 0; t < record.frames(); ++t) {
        const auto is_voiced = [&](std::size_t i) {
            return record.people[i].speech[t * DyadPerson::kSpeech] > 0;
        };
        for (std::size_t i = 0; i < 2; ++i) voiced[i] += is_voiced(i) ? 1 : 0;
        both += is_voiced(0) && is_voiced(1) ? 1 : 0;
    }
    for (const std::size_t own : voiced) EXPECT_GT(own, record.frames() / 20) << record.id;
    EXPECT_LT(both, record.frames() / 100) << record.id;
}

TEST(MakeDyads, LetsPeopleTakeTurnsAndKeepsTheStatedDelayAndStrength) {
    const Dyads& dyads = Dyads::of_all_tests();
    std::vector<double> errors, strengths, scores;
    for (const CorpusEntry& entry : dyads.index.entries) {
        const DyadRecord record = read_dyad(dyads.index, entry);
        expect_turns(record);
        const auto found =
            testing::lagged_correlation(smile_of(record.people[0]), smile_of(record.people[1]), record.fps);
        errors.push_back(std::abs(found.delay - *record.tau));
        strengths.push_back(*record.kappa);
        scores.push_back(found.score);
    }
    std::sort(errors.begin(), errors.end());
    const double error = (errors[5] + errors[6]) / 2, r = correlation(ranks_of(strengths), ranks_of(scores));
    std::cout << "median error of the delay " << error << " s, Spearman's rho of the strength " << r << "\n";
    EXPECT_LT(error, 0.12);
    EXPECT_GT(r, 0.671);  // of twelve ranks in random order one in a hundred correlates more
    EXPECT_NEAR(*std::min_element(strengths.begin(), strengths.end()), 0.033, 0.001);
    EXPECT_NEAR(*std::max_element(strengths.begin(), strengths.end()), 0.767, 0.001);
}

TEST(MakeDyads, LetsSomeMeetTwiceAndNobodyAcrossSplits) {
    const Dyads& dyads = Dyads::of_all_tests();
    std::map<std::string, std::set<Split>> splits;
    std::map<std::string, int> meetings;
    for (const CorpusEntry& entry : dyads.index.entries) {
        for (const std::string_view person : split(entry.speaker, '+')) {
            splits[std::string(person)].insert(entry.split);
            ++meetings[std::string(person)];
        }
    }
    EXPECT_EQ(splits.size(), 18u);
    EXPECT_EQ(
        std::count_if(meetings.begin(), meetings.end(), [](const auto& met) { return met.second == 2; }), 6);
    for (const auto& [person, of] : splits) EXPECT_EQ(of.size(), 1u) << person;
    EXPECT_EQ(dyads.index.of(Split::train).size(), 8u);
    EXPECT_EQ(dyads.index.of(Split::validation).size(), 2u);
    EXPECT_EQ(dyads.index.of(Split::test).size(), 2u);
}

}  // namespace
}  // namespace chironomia
