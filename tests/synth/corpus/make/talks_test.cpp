#include "synth/corpus/make/talks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "synth/features/contour.h"
#include "synth/markup/vocabulary.h"
#include "tests/synth/corpus/made.h"
#include "tests/synth/correlation.h"

namespace chironomia {
namespace {

using testing::correlation;

// Of each speaker 5 units and of an unseen one 3, the first of them said by all.
struct Talks {
    explicit Talks(std::size_t speakers) {
        const UnitCounts counts{.seen = speakers, .unseen = 1, .of_seen = 5, .of_unseen = 3};
        index = testing::made(
            plan_talks({.order = order, .lexicon = testing::corpus_lexicon(), .counts = counts}), order);
    }

    testing::TemporaryFolder folder;
    CorpusOrder order{.kind = CorpusKind::talks, .folder = folder.path(), .seed = 3};
    CorpusIndex index;

    std::vector<IpuRecord> records() const {
        std::vector<IpuRecord> all;
        for (const CorpusEntry& entry : index.entries) all.push_back(read_ipu(index, entry));
        return all;
    }
};

std::string text_of(const IpuRecord& record) {
    std::string text;
    for (const CorpusWord& word : record.words)
        if (word.text != ",") text += word.text + " ";
    return text;
}

TEST(MakeTalks, HoldsUnitsOfFifteenToFortyWordsWithoutLongPauses) {
    const Talks talks(1);
    ASSERT_EQ(talks.index.entries.size(), 8u);
    for (const IpuRecord& record : talks.records()) {
        const auto pauses = std::count_if(record.words.begin(), record.words.end(),
                                          [](const CorpusWord& word) { return word.text == ","; });
        const std::size_t words = record.words.size() - static_cast<std::size_t>(pauses);
        EXPECT_GE(words, 15u) << record.id;
        EXPECT_LE(words, 40u) << record.id;
        EXPECT_EQ(record.words.front().start, 0) << record.id;
        const double seconds = record.words.back().end;
        EXPECT_NEAR(static_cast<double>(record.frames()) / IpuRecord::kFps, seconds, 0.05);
        EXPECT_NEAR(static_cast<double>(record.f0.size()) / IpuRecord::kSpeechRate, seconds, 0.05);
        for (const CorpusWord& word : record.words)
            EXPECT_TRUE(word.text != "," || word.end - word.start <= 0.2 + 1e-3) << record.id;
        for (const float f0 : record.f0) ASSERT_TRUE(f0 >= 50 && f0 <= 550) << record.id;
    }
}

TEST(MakeTalks, LetsEverybodySayTheFirstUnitsAlikeAndTestsThem) {
    const Talks talks(2);
    std::map<std::string, std::set<std::string>> speakers;  // by what they say
    std::map<std::string, std::set<Split>> splits;          // of speakers
    for (std::size_t i = 0; i < talks.index.entries.size(); ++i) {
        const CorpusEntry& entry = talks.index.entries[i];
        const bool is_parallel = entry.id.ends_with("_0000");
        if (is_parallel) speakers[text_of(read_ipu(talks.index, entry))].insert(entry.speaker);
        splits[entry.speaker].insert(entry.split);
        EXPECT_TRUE(!is_parallel || entry.speaker == "quentin" || entry.split == Split::test);
    }
    ASSERT_EQ(speakers.size(), 1u);
    EXPECT_EQ(speakers.begin()->second.size(), 3u);
    EXPECT_EQ(splits.at("quentin"), std::set<Split>{Split::unseen});
    EXPECT_EQ(splits.at("adrian"), (std::set<Split>{Split::train, Split::validation, Split::test}));
}

TEST(MakeTalks, RaisesBrowsWhereTheVoiceRises) {
    const Talks talks(4);
    std::vector<double> accented, raised;
    const Vocabulary& vocabulary = Vocabulary::of("en");
    for (const IpuRecord& record : talks.records()) {
        std::vector<double> heights;
        std::vector<std::size_t> spoken;
        for (std::size_t w = 0; w < record.words.size(); ++w) {
            const CorpusWord& word = record.words[w];
            if (word.text == ",") continue;
            const SampleRange range = samples_in(word.start, word.end, IpuRecord::kSpeechRate);
            float highest = 50;
            for (std::size_t s = range.first; s < std::min(range.last, record.f0.size()); ++s)
                highest = std::max(highest, record.f0[s]);
            heights.push_back(std::log2(highest));
            spoken.push_back(w);
        }
        double mean = 0, square = 0;
        for (const double height : heights) mean += height / static_cast<double>(heights.size());
        for (const double height : heights) square += std::pow(height - mean, 2);
        const double spread = std::sqrt(square / static_cast<double>(heights.size()));
        for (std::size_t i = 0; i < spoken.size(); ++i) {
            const CorpusWord& word = record.words[spoken[i]];
            std::string plain = word.text;
            std::transform(plain.begin(), plain.end(), plain.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
            accented.push_back(heights[i] - mean > 0.8 * spread && !vocabulary.is_function_word(plain) ? 1
                                                                                                       : 0);
            const SampleRange frames = samples_in(word.start, word.end, IpuRecord::kFps);
            float most = 0;
            for (std::size_t t = frames.first; t < std::min(frames.last, record.frames()); ++t)
                most = std::max(most, record.units[t * IpuRecord::kUnits]);
            raised.push_back(most);
        }
    }
    const double r = correlation(accented, raised);
    std::cout << "AU1 against accented content words: r " << r << " over " << raised.size() << " words\n";
    EXPECT_GT(r, 0.4);
}

TEST(MakeTalks, LosesFramesAndBridgesThem) {
    const Talks talks(2);
    std::size_t lost = 0, frames = 0;
    for (const IpuRecord& record : talks.records()) {
        frames += record.frames();
        lost += static_cast<std::size_t>(std::count(record.success.begin(), record.success.end(), 0));
        for (std::size_t t = 1; t + 1 < record.frames(); ++t) {
            if (record.success[t] || !record.success[t - 1] || !record.success[t + 1]) continue;
            const std::size_t at = t * IpuRecord::kUnits;
            EXPECT_NEAR(record.units[at], (record.units[at - 6] + record.units[at + 6]) / 2, 1e-4)
                << record.id;
        }
    }
    EXPECT_GT(lost, frames / 300);
    EXPECT_LT(lost, frames / 30);
}

TEST(MakeTalks, ShowsWhatTheVoiceDoes) {
    Speech speech;
    speech.language = "en";
    speech.words = {
        {"the", 0, 0.5}, {"garden", 0.5, 1}, {"is", 1, 1.5}, {"gigantic", 1.5, 2}, {"indeed", 2, 2.5}};
    speech.marks = {
        {.kind = MarkKind::world, .value = "size-big", .first_word = 3, .end_word = 4, .weight = 0.2}};
    std::vector<float> f0(250, 100.0f);
    std::fill(f0.begin() + 150, f0.begin() + 200, 200.0f);
    const Speech shown = with_acts_of_voice(speech, f0);
    ASSERT_EQ(shown.marks.size(), 3u);
    for (const Mark& mark : shown.marks) {
        EXPECT_EQ(mark.first_word, 3u);
        EXPECT_EQ(mark.weight, 1);
    }
    const auto has = [&](MarkKind kind, std::string_view value) {
        return std::any_of(shown.marks.begin(), shown.marks.end(),
                           [&](const Mark& mark) { return mark.kind == kind && mark.value == value; });
    };
    EXPECT_TRUE(has(MarkKind::emphasis, "high"));
    EXPECT_TRUE(has(MarkKind::emotion, "surprise"));
}

}  // namespace
}  // namespace chironomia
