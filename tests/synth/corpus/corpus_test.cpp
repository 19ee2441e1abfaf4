// Corpora on disk: what is written is read again, and what is wrong is refused with its place.
#include "synth/corpus/corpus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::sample_dyad;
using testing::sample_index;
using testing::sample_interval;
using testing::sample_ipu;
using testing::sample_talks;
using testing::TemporaryFolder;

bool same(const std::vector<CorpusWord>& a, const std::vector<CorpusWord>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
        return one.text == other.text && one.start == other.start && one.end == other.end;
    });
}

TEST(Corpus, GivesTalksBackAsTheyWere) {
    const TemporaryFolder folder;
    const CorpusIndex written = sample_talks(folder.path());
    const CorpusIndex corpus = read_corpus_index(folder.path());
    EXPECT_EQ(corpus.kind, CorpusKind::talks);
    EXPECT_EQ(corpus.text_encoder, "hashbert");
    EXPECT_EQ(corpus.origin, written.origin);
    ASSERT_EQ(corpus.entries.size(), 5u);
    EXPECT_EQ(corpus.of(Split::train).size(), 2u);
    EXPECT_EQ(corpus.of(Split::unseen).at(0).speaker, "c");
    const IpuRecord expected = sample_ipu("a_1", "a", 0.7), found = read_ipu(corpus, corpus.entries[0]);
    EXPECT_EQ(found.id, expected.id);
    EXPECT_EQ(found.speaker, expected.speaker);
    EXPECT_EQ(found.source, expected.source);
    EXPECT_EQ(found.start, expected.start);
    EXPECT_TRUE(same(found.words, expected.words));
    EXPECT_EQ(found.vectors, expected.vectors);
    EXPECT_EQ(found.f0, expected.f0);
    EXPECT_EQ(found.f0_strength, expected.f0_strength);
    EXPECT_EQ(found.voice, expected.voice);
    EXPECT_EQ(found.units, expected.units);
    EXPECT_EQ(found.head, expected.head);
    EXPECT_EQ(found.success, expected.success);
    EXPECT_EQ(found.confidence, expected.confidence);
}

TEST(Corpus, GivesDyadsBackAsTheyWere) {
    const TemporaryFolder folder;
    DyadRecord expected = sample_dyad("d1", "p1", "p2");
    expected.language = "fr";
    expected.kappa = 0.5;
    expected.tau = 0.8;
    write_dyad(folder.path(), expected);
    write_corpus_index(sample_index(folder.path(), CorpusKind::dyads,
                                    {{.id = "d1", .speaker = "p1+p2", .split = Split::train, .seconds = 4}}));
    const CorpusIndex corpus = read_corpus_index(folder.path());
    const DyadRecord found = read_dyad(corpus, corpus.entries.at(0));
    EXPECT_EQ(found.language, "fr");
    EXPECT_EQ(found.kappa, 0.5);
    EXPECT_EQ(found.tau, 0.8);
    for (std::size_t p = 0; p < 2; ++p) {
        EXPECT_EQ(found.people[p].participant, expected.people[p].participant);
        EXPECT_EQ(found.people[p].role, expected.people[p].role);
        EXPECT_EQ(found.people[p].face, expected.people[p].face);
        EXPECT_EQ(found.people[p].speech, expected.people[p].speech);
    }
}

TEST(Corpus, GivesIntervalsBackAsTheyWere) {
    const TemporaryFolder folder;
    const IntervalRecord expected = sample_interval("i1", "s");
    write_interval(folder.path(), expected);
    write_corpus_index(sample_index(folder.path(), CorpusKind::intervals,
                                    {{.id = "i1", .speaker = "s", .split = Split::train, .seconds = 2}}));
    const CorpusIndex corpus = read_corpus_index(folder.path());
    const IntervalRecord found = read_interval(corpus, corpus.entries.at(0));
    EXPECT_TRUE(same(found.words, expected.words));
    EXPECT_EQ(found.pose, expected.pose);
    EXPECT_EQ(found.pose_normalized, expected.pose_normalized);
    EXPECT_EQ(found.pose_confidence, expected.pose_confidence);
    EXPECT_EQ(found.mel_400, expected.mel_400);
    EXPECT_EQ(found.mel_512, expected.mel_512);
    EXPECT_EQ(found.silence, expected.silence);
    EXPECT_EQ(found.vectors, expected.vectors);
    EXPECT_EQ(found.tokens, expected.tokens);
    EXPECT_EQ(found.face, expected.face);
    EXPECT_EQ(found.face_normalized, expected.face_normalized);
    EXPECT_EQ(found.face_confidence, expected.face_confidence);
    EXPECT_EQ(found.dialog_acts, expected.dialog_acts);
    EXPECT_EQ(found.style, expected.style);
    EXPECT_EQ(found.phase, expected.phase);
}

TEST(Corpus, WritesTheSameBytes) {
    const TemporaryFolder one, other;
    sample_talks(one.path());
    sample_talks(other.path());
    for (const char* file : {"corpus.json", "records/a/a_1.h5"})
        EXPECT_EQ(read_bytes(one / file), read_bytes(other / file)) << file;
}

TEST(Corpus, RefusesAFolderWithoutOne) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal_of([&] { read_corpus_index(folder.path()); }),
                HasSubstr("holds no corpus: there is neither corpus.json nor data/cmu_intervals_df.csv"));
}

}  // namespace
}  // namespace chironomia
