#include "synth/corpus/splits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/text.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;

// So many records of each of so many speakers.
std::vector<CorpusEntry> records(std::size_t speakers, std::size_t each) {
    std::vector<CorpusEntry> entries;
    for (std::size_t s = 0; s < speakers; ++s) {
        for (std::size_t i = 0; i < each; ++i)
            entries.push_back(
                {.id = format("s{:02}_{:03}", s, i), .speaker = format("s{:02}", s), .seconds = 10});
    }
    return entries;
}

std::map<Split, std::size_t> counts(const std::vector<CorpusEntry>& entries) {
    std::map<Split, std::size_t> counts;
    for (const CorpusEntry& entry : entries) ++counts[entry.split];
    return counts;
}

TEST(SplitBySpeakers, HoldsOutSpeakersAndSharesTheOthers) {
    const auto entries = split_by_speakers(records(20, 50), 3);
    const auto found = counts(entries);
    EXPECT_EQ(found.at(Split::unseen), 100u);  // 2 of 20 speakers
    EXPECT_EQ(found.at(Split::validation), 90u);
    EXPECT_EQ(found.at(Split::test), 90u);
    EXPECT_EQ(found.at(Split::train), 720u);
    std::map<std::string, std::set<Split>> of_speaker;
    for (const CorpusEntry& entry : entries) of_speaker[entry.speaker].insert(entry.split);
    for (const auto& [speaker, splits] : of_speaker)
        EXPECT_TRUE(splits.size() == 1 || !splits.contains(Split::unseen)) << speaker;
}

TEST(SplitBySpeakers, DependsOnTheSeedAlone) {
    const auto splits_of = [](const std::vector<CorpusEntry>& entries) {
        std::vector<Split> splits;
        for (const CorpusEntry& entry : entries) splits.push_back(entry.split);
        return splits;
    };
    auto mixed = records(6, 10);
    std::reverse(mixed.begin(), mixed.end());
    const auto once = splits_of(split_by_speakers(records(6, 10), 1));
    EXPECT_EQ(once, splits_of(split_by_speakers(mixed, 1)));
    EXPECT_NE(once, splits_of(split_by_speakers(records(6, 10), 2)));
}

TEST(SplitBySpeakers, KeepsFewSpeakersAndGivesEachPartOne) {
    const auto found = counts(split_by_speakers(records(3, 1), 1));
    EXPECT_EQ(found.at(Split::train), 1u);
    EXPECT_EQ(found.at(Split::validation), 1u);
    EXPECT_EQ(found.at(Split::test), 1u);
    EXPECT_EQ(counts(split_by_speakers(records(1, 2), 1)).at(Split::train), 2u);
}

// Dyads of a minute between such people.
std::vector<CorpusEntry> dyads(const std::vector<std::string>& people) {
    std::vector<CorpusEntry> entries;
    for (const std::string& pair : people)
        entries.push_back({.id = format("d{:02}", entries.size()), .speaker = pair, .seconds = 60});
    return entries;
}

TEST(SplitByParticipants, NobodyIsInTwoParts) {
    // A chain a-b-c-d whose links come in out of order, and nine pairs.
    std::vector<std::string> people = {"a+b", "c+d", "b+c"};
    for (int i = 0; i < 9; ++i) people.push_back(format("x{}+y{}", i, i));
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto entries = split_by_participants(dyads(people), seed, "corpus");
        EXPECT_EQ(entries[0].split, entries[1].split);
        EXPECT_EQ(entries[0].split, entries[2].split);
        const auto found = counts(entries);
        EXPECT_NEAR(static_cast<double>(found.at(Split::train)), 0.7 * 12, 1);
        EXPECT_NEAR(static_cast<double>(found.at(Split::test)), 0.2 * 12, 1);
        EXPECT_NEAR(static_cast<double>(found.at(Split::validation)), 0.1 * 12, 1);
    }
}

TEST(SplitByParticipants, GivesEachPartOneOfThree) {
    const auto found = counts(split_by_participants(dyads({"a+b", "c+d", "e+f"}), 5, "corpus"));
    EXPECT_EQ(found.size(), 3u);
}

TEST(SplitByParticipants, RefusesPeopleWhoAreAllLinked) {
    EXPECT_EQ(refusal_of([] {
                  split_by_participants(dyads({"a+b", "b+c", "d+e"}), 1, "corpus");
              }),
              "corpus: 3 dyads fall into 2 groups of people who never meet those of another, and train, "
              "validation and test need one each; say the \"split\" of each dyad yourself");
}

}  // namespace
}  // namespace chironomia
