#include "synth/corpus/make/make_corpus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/version.h"
#include "tests/support/folder_hash.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::hash_of_folder;
using ::testing::HasSubstr;
using testing::refusal_of;

CorpusOrder small_order(const fs::path& folder) {
    return {.kind = CorpusKind::dyads, .size = CorpusSize::ci, .folder = folder, .quiet = true};
}

TEST(MakeCorpus, GivesTheSameBytesWithAnyNumberOfThreads) {
    const testing::TemporaryFolder folder;
    CorpusOrder order = small_order(folder / "one");
    order.threads = 1;
    const CorpusIndex index = make_corpus(order);
    order.folder = folder / "three";
    order.threads = 3;
    make_corpus(order);
    EXPECT_EQ(hash_of_folder(folder / "one"), hash_of_folder(folder / "three"));
    order.folder = folder / "other";
    order.seed = 2;
    make_corpus(order);
    EXPECT_NE(hash_of_folder(folder / "one"), hash_of_folder(folder / "other"));

    EXPECT_EQ(index.entries.size(), 3u);
    const CorpusIndex read = read_corpus_index(folder / "one");
    EXPECT_EQ(read.kind, CorpusKind::dyads);
    EXPECT_EQ(read.origin.at("seed"), 1);
    EXPECT_EQ(read.origin.at("speakers").size(), 6u);
    EXPECT_EQ(read.origin.at("speakers").at("adrian").at("style").size(), IntervalRecord::kStyle);
}

// The bundled checkpoints have learned talks and dyads of this very seed (assets/models/README.md): who
// changes their bytes trains the checkpoints anew. Bytes hold within a release of Debian, and speech is espeak-ng's.
TEST(MakeCorpus, GivesTheBytesThatTheBundledModelsHaveLearned) {
    if (library_versions().find("espeak-ng 1.51") == std::string_view::npos)
        GTEST_SKIP() << "the bundled models have learned the speech of espeak-ng 1.51, Debian 12's";
    const testing::TemporaryFolder folder;
    const CorpusOrder talks{.kind = CorpusKind::talks,
                            .size = CorpusSize::ci,
                            .folder = folder / "talks",
                            .speakers = {.names = {"adrian"}},
                            .quiet = true};
    make_corpus(talks);
    EXPECT_EQ(hash_of_folder(folder / "talks/records/adrian"),
              "69676b0a3137cda5bb649a7a5c7a0046ed9394ce904ba7474fe04fedfab01244");
    make_corpus(small_order(folder / "dyads"));
    EXPECT_EQ(hash_of_folder(folder / "dyads/records"),
              "3954e43a41133cc9c8040548c3ead378c187d3f0f1d111b43e3ec525b5bebc31");
}

TEST(MakeCorpus, LeavesNothingBehindWhereItFails) {
    const testing::TemporaryFolder folder;
    CorpusOrder order = small_order(folder / "corpus");
    fs::create_directory(folder / "corpus");
    write_text(folder / "corpus/notes.txt", "mine");
    EXPECT_THAT(refusal_of([&] { make_corpus(order); }), HasSubstr("corpus"));
    EXPECT_EQ(read_text(folder / "corpus/notes.txt"), "mine");
    write_text(folder / "file", "no folder");
    order.folder = folder / "file/corpus";
    EXPECT_THAT(refusal_of([&] { make_corpus(order); }), HasSubstr("file/corpus: cannot be written"));
}

// Adrian and quentin say and do the same whoever else is there.
TEST(MakeCorpus, MakesChosenSpeakersAsInTheWhole) {
    const testing::TemporaryFolder folder;
    CorpusOrder order{.kind = CorpusKind::talks,
                      .size = CorpusSize::ci,
                      .folder = folder / "two",
                      .speakers = {.counts = SpeakerChoice::Counts{.seen = 1, .unseen = 1}},
                      .quiet = true};
    const CorpusIndex both = make_corpus(order);
    EXPECT_EQ(both.entries.size(), 18u);
    EXPECT_EQ(both.of(Split::unseen).size(), 6u);
    order.folder = folder / "one";
    order.speakers.names = {"adrian"};
    const CorpusIndex one = make_corpus(order);
    EXPECT_EQ(one.entries.size(), 12u);
    EXPECT_EQ(hash_of_folder(folder / "one/records/adrian"), hash_of_folder(folder / "two/records/adrian"));
    EXPECT_EQ(one.origin.at("speakers").size(), 1u);
}

// Whoever fails leaves what is whole, and it is not made again.
TEST(MakeCorpus, GoesOnWithWhatIsWhole) {
    const testing::TemporaryFolder folder;
    CorpusOrder order{.kind = CorpusKind::talks,
                      .size = CorpusSize::ci,
                      .folder = folder / "whole",
                      .speakers = {.counts = SpeakerChoice::Counts{.seen = 1, .unseen = 0}},
                      .threads = 1,
                      .quiet = true};
    make_corpus(order);
    int talks = 0;
    const auto encode = order.encoder.vectors;
    order.encoder.vectors = [&talks, encode](const Utterances& utterances) {
        if (++talks == 4) throw Error("the encoder is tired");
        return encode(utterances);
    };
    order.folder = folder / "cut";
    EXPECT_THAT(refusal_of([&] { make_corpus(order); }), HasSubstr("the encoder is tired"));
    EXPECT_FALSE(fs::exists(folder / "cut"));
    EXPECT_TRUE(fs::exists(folder / ".cut.making/.made/00002.json"));
    make_corpus(order);
    EXPECT_EQ(talks, 4 + 3) << "of six talks three were whole";
    EXPECT_EQ(hash_of_folder(folder / "cut"), hash_of_folder(folder / "whole"));

    order.folder = folder / "broken";
    talks = 0;
    EXPECT_THAT(refusal_of([&] { make_corpus(order); }), HasSubstr("tired"));
    write_text(folder / ".broken.making/.made/00001.json", R"({"records": [{"id": "a"}]})");
    EXPECT_THAT(refusal_of([&] { make_corpus(order); }),
                HasSubstr("00001.json: records[0].speaker: is missing"));
}

TEST(SpeakerChoice, IsCountsOrNames) {
    EXPECT_EQ(speaker_choice_of("6").counts->seen, 6u);
    EXPECT_EQ(speaker_choice_of("6").counts->unseen, 0u);
    EXPECT_EQ(speaker_choice_of("6+2").counts->unseen, 2u);
    EXPECT_THAT(speaker_choice_of("adrian, quentin").names, ::testing::ElementsAre("adrian", "quentin"));
    for (const char* wrong : {"0", "17", "3+", "3+7", "3+1+1", "-2"})
        EXPECT_THAT(refusal_of([&] { speaker_choice_of(wrong); }),
                    HasSubstr("1 to 16 speakers to learn from"));
}

TEST(CorpusSize, HasNames) {
    EXPECT_EQ(name_of(CorpusSize::mini), "mini");
    EXPECT_EQ(name_of(CorpusSize::full), "full");
}

}  // namespace
}  // namespace chironomia
