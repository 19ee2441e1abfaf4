// PATS's own tree, written by an independent script (tests/fixtures/corpus/make_pats.py) with h5py and
// pandas.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "synth/corpus/corpus.h"
#include "synth/corpus/pickled_texts.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

const fs::path kPats = testing::source_dir() / "tests/fixtures/corpus/pats";

std::vector<std::string> texts_of(const std::vector<CorpusWord>& words) {
    std::vector<std::string> texts;
    for (const CorpusWord& word : words) texts.push_back(word.text);
    return texts;
}

TEST(Pats, ListsWhatIsThere) {
    const CorpusIndex corpus = read_corpus_index(kPats);
    EXPECT_EQ(corpus.kind, CorpusKind::intervals);
    ASSERT_EQ(corpus.entries.size(), 3u);
    EXPECT_EQ(corpus.entries[0].id, "115309");
    EXPECT_EQ(corpus.entries[0].split, Split::train);
    EXPECT_EQ(corpus.entries[0].seconds, 0.4);
    EXPECT_EQ(corpus.entries[1].split, Split::validation);
    EXPECT_EQ(corpus.entries[2].speaker, "minhaj");
    EXPECT_EQ(corpus.entries[2].split, Split::unseen);
    const Json left_out = corpus.origin.at("left_out");
    EXPECT_EQ(left_out.at("train and dev of unseen speakers"), 1);
    EXPECT_EQ(left_out.at("speakers that the thesis does not use"), 1);
    EXPECT_EQ(left_out.at("listed in missing_intervals.h5"), 1);
    EXPECT_EQ(left_out.at("without a file"), 1);
    EXPECT_EQ(read_corpus_index(kPats / "data").entries.size(), 3u);
}

TEST(Pats, ReadsArraysPlainAndPacked) {
    const CorpusIndex corpus = read_corpus_index(kPats);
    for (const CorpusEntry& entry : corpus.entries) {
        const IntervalRecord found = read_interval(corpus, entry);
        ASSERT_EQ(found.frames(), 6u);
        // Element (t, k) is base + t + k / 128.
        EXPECT_EQ(found.pose[2 * 104 + 64], -100 + 2 + 0.5f);
        EXPECT_EQ(found.pose_normalized[5 * 104 + 1], -50 + 5 + 1 / 128.0f);
        EXPECT_EQ(found.pose_confidence[17], 0.75f);
        EXPECT_EQ(found.mel_400.size(), 41 * IntervalRecord::kMel400);
        EXPECT_EQ(found.mel_400[40 * 64 + 32], -9 + 40 + 0.25f);
        EXPECT_EQ(found.mel_512[34 * 128 + 127], -20 + 34 + 127 / 128.0f);
        EXPECT_EQ(found.vectors[4 * kWordVector + 640], -3 + 4 + 5.0f);
        EXPECT_THAT(found.tokens, ElementsAre(1996, 1996, 4248, 4248, 4248, 4419));
        EXPECT_TRUE(found.face.empty());
        EXPECT_TRUE(found.dialog_acts.empty());
    }
}

TEST(Pats, HasVectorsOfBert) {
    const fs::path file = kPats / "data/processed/oliver/115309.h5";
    EXPECT_EQ(text_encoder_of_interval(file), "bert-base-uncased");
    const TemporaryFolder folder;
    fs::copy(file, folder / "alone.h5");
    EXPECT_EQ(text_encoder_of_interval(folder / "alone.h5"), "bert-base-uncased");
}

// The published files do not all have one flag a frame.
TEST(Pats, BringsSilenceToTheFrames) {
    const CorpusIndex corpus = read_corpus_index(kPats);
    EXPECT_THAT(read_interval(corpus, corpus.entries[0]).silence, ElementsAre(1, 0, 0, 0, 0, 0));
    EXPECT_THAT(read_interval(corpus, corpus.entries[2]).silence, ElementsAre(0, 1, 0, 0, 0, 0));
}

TEST(Pats, TakesWordsFromPandasOrATableOrTokens) {
    const CorpusIndex corpus = read_corpus_index(kPats);
    const auto of_pandas = read_interval(corpus, corpus.entries[0]).words;
    EXPECT_THAT(texts_of(of_pandas), ElementsAre("the", "quick", "the"));
    EXPECT_NEAR(of_pandas[1].start, 2 / 15.0, 1e-12);
    EXPECT_NEAR(of_pandas[1].end, 5 / 15.0, 1e-12);
    const auto of_table = read_interval(corpus, corpus.entries[1]).words;
    EXPECT_THAT(texts_of(of_table), ElementsAre("the", "quick", "fox"));
    EXPECT_NEAR(of_table[2].end, 6 / 15.0, 1e-12);
    const auto of_tokens = read_interval(corpus, corpus.entries[2]).words;
    EXPECT_THAT(texts_of(of_tokens), ElementsAre("#1996", "#4248", "#4419"));
    EXPECT_NEAR(of_tokens[1].start, 2 / 15.0, 1e-12);
    EXPECT_NEAR(of_tokens[2].end, 6 / 15.0, 1e-12);
}

// PATS counts in frames: in the interval that its own tutorial prints three of 60 words begin and end in the same one.
TEST(Pats, ReadsWordsThatAreShorterThanAFrame) {
    const TemporaryFolder folder;
    fs::copy(kPats, folder / "pats", fs::copy_options::recursive);
    write_text(folder / "pats/data/processed/oliver/cmu0000025735.words.csv",
               "word,start_frame,end_frame\nsince,0,3\nit,3,3\nwas,3,6\n");
    const CorpusIndex corpus = read_corpus_index(folder / "pats");
    const auto words = read_interval(corpus, corpus.entries.at(1)).words;
    EXPECT_THAT(texts_of(words), ElementsAre("since", "it", "was"));
    EXPECT_EQ(words[1].start, words[1].end);
}

// The tree with another table, and with the words of one interval replaced.
std::string refusal_of_table(const std::string& table, const std::string& words = "") {
    const TemporaryFolder folder;
    fs::copy(kPats, folder / "pats", fs::copy_options::recursive);
    const fs::path data = folder / "pats/data";
    if (!table.empty()) write_text(data / "cmu_intervals_df.csv", table);
    if (!words.empty()) write_text(data / "processed/oliver/cmu0000025735.words.csv", words);
    return refusal_of([&] {
        const CorpusIndex corpus = read_corpus_index(folder / "pats");
        read_interval(corpus, corpus.entries.at(1));
    });
}

TEST(Pats, RefusesABrokenTableWithItsLine) {
    const std::string header = "dataset,delta_time,interval_id,speaker\n";
    EXPECT_THAT(refusal_of_table("dataset,delta_time,speaker\ntrain,1,oliver\n"),
                HasSubstr("cmu_intervals_df.csv: there is no column \"interval_id\"; add it"));
    EXPECT_THAT(
        refusal_of_table(header + "train,1,115309,oliver\ntrian,1,115309,oliver\n"),
        HasSubstr("cmu_intervals_df.csv:3: the dataset is \"trian\"; train, dev or test is expected"));
    EXPECT_THAT(refusal_of_table(header + "train,nan,115309,oliver\n"),
                HasSubstr("cmu_intervals_df.csv:2: column \"delta_time\": nan is not finite"));
    EXPECT_THAT(refusal_of_table(header + "train,0,115309,oliver\n"),
                HasSubstr("cmu_intervals_df.csv:2: the interval lasts 0 s; it must be longer than 0"));
    EXPECT_THAT(refusal_of_table(header + "train,1,../115309,oliver\n"),
                HasSubstr("cmu_intervals_df.csv:2: \"../115309\" of \"oliver\" cannot name a file"));
    EXPECT_THAT(refusal_of_table(header + "train,1,,oliver\n"),
                HasSubstr("cmu_intervals_df.csv:2: column \"interval_id\" is empty"));
    EXPECT_THAT(refusal_of_table(header + "train,1,115309,oliver\ndev,1,115309,oliver\n"),
                HasSubstr("the id \"115309\" comes twice; give each record its own"));
    EXPECT_THAT(refusal_of_table(header + "test,1,115309,oliver\n"),
                HasSubstr("the split train is empty, of 1 records; models learn from it alone"));
}

TEST(Pats, SaysWhereItLooksForFilesThatAreNotThere) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "data");
    fs::copy(kPats / "data/cmu_intervals_df.csv", folder / "data/cmu_intervals_df.csv");
    EXPECT_THAT(
        refusal_of([&] { read_corpus_index(folder.path()); }),
        AllOf(HasSubstr("cmu_intervals_df.csv: none of its 7 intervals can be used (speakers that the thesis "
                        "does not use: 1, train and dev of unseen speakers: 1, without a file: 5)"),
              HasSubstr("files are looked for as "), HasSubstr("data/processed/SPEAKER/ID.h5")));
}

TEST(Pats, RefusesBrokenWords) {
    EXPECT_THAT(
        refusal_of_table("", "word,start_frame,end_frame\nthe,2,0\n"),
        HasSubstr("word 0 \"the\" lasts from 0.13333333333333333 to 0 s; it may not end before it starts"));
    EXPECT_THAT(
        refusal_of_table("", "word,start_frame,end_frame\nthe,0,4\nfox,3,5\n"),
        HasSubstr("word 1 \"fox\" starts at 0.2 s, the word before it ends at 0.26666666666666666 s; words "
                  "may not overlap"));
}

using namespace std::string_literals;

TEST(PickledTexts, FollowsRepeatedTextsAndOneAlone) {
    // What Python writes of ["a", "b", same a], and of ["a"], with protocol 4.
    EXPECT_THAT(*pickled_texts("\x80\x04]\x94(\x8c\x01"
                               "a\x94\x8c\x01"
                               "b\x94h\x01"
                               "e."s),
                ElementsAre("a", "b", "a"));
    EXPECT_THAT(*pickled_texts("\x80\x04]\x94\x8c\x01"
                               "a\x94"
                               "a."s),
                ElementsAre("a"));
    // With protocol 2.
    EXPECT_THAT(*pickled_texts("\x80\x02]q\0(X\x01\0\0\0aq\x01X\x01\0\0\0bq\x02h\x01"
                               "e."s),
                ElementsAre("a", "b", "a"));
}

TEST(PickledTexts, IsNothingForAnythingElse) {
    EXPECT_FALSE(pickled_texts(""));
    EXPECT_FALSE(pickled_texts("\x80\x04."s));
    EXPECT_FALSE(
        pickled_texts("\x80\x04]\x94(K\x01K\x02"
                      "e."s));  // numbers
    EXPECT_FALSE(
        pickled_texts("\x80\x04]\x94(\x8c\xff"
                      "abc"s));  // cut off
    EXPECT_FALSE(
        pickled_texts("\x80\x04]\x94(\x8c\x01"
                      "a\x94h\x07"
                      "e."s));  // a text that was never kept
    EXPECT_FALSE(
        pickled_texts("\x80\x04]\x94(G\0\0\0\0\0\0\0\0\x8c\x01"
                      "ae."s));  // a number of eight bytes
}

// A text of 64 KiB that is kept, or said again, half a million times.
TEST(PickledTexts, DoesNotFillTheMemory) {
    const std::string start = "\x80\x04]\x94(X"s + "\0\0\x01\0"s + std::string(65536, 'a') + "\x94"s;
    std::string again = start, kept = start;
    for (int i = 0; i < 500'000; ++i) {
        again += "h\x01"s;
        kept += "\x94"s;
    }
    EXPECT_FALSE(pickled_texts(again + "e."));
    EXPECT_THAT(*pickled_texts(kept + "e."), ::testing::SizeIs(1));
    EXPECT_FALSE(
        pickled_texts("\x80\x04]\x94(X\xff\xff\xff\xff"
                      "ae."s));  // a count beyond the end
}

}  // namespace
}  // namespace chironomia
