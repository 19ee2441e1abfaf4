#include "synth/corpus/make_corpus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files.h"
#include "core/hash.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::refusal_of;

// Of all files of a folder with their names.
std::string hash_of(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string all;
    for (const fs::path& file : files)
        all += fs::relative(file, folder).string() + " " + sha256_of_file(file) + "\n";
    return sha256(all);
}

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
    EXPECT_EQ(hash_of(folder / "one"), hash_of(folder / "three"));
    order.folder = folder / "other";
    order.seed = 2;
    make_corpus(order);
    EXPECT_NE(hash_of(folder / "one"), hash_of(folder / "other"));

    EXPECT_EQ(index.entries.size(), 3u);
    const CorpusIndex read = read_corpus_index(folder / "one");
    EXPECT_EQ(read.kind, CorpusKind::dyads);
    EXPECT_EQ(read.origin.at("seed"), 1);
    EXPECT_EQ(read.origin.at("speakers").size(), 6u);
    EXPECT_EQ(read.origin.at("speakers").at("adrian").at("style").size(), IntervalRecord::kStyle);
}

TEST(MakeCorpus, LeavesNothingBehindWhereItFails) {
    const testing::TemporaryFolder folder;
    const CorpusOrder order = small_order(folder / "corpus");
    fs::create_directory(folder / "corpus");
    write_text(folder / "corpus/notes.txt", "mine");
    EXPECT_THAT(refusal_of([&] { make_corpus(order); }), HasSubstr("corpus"));
    EXPECT_EQ(read_text(folder / "corpus/notes.txt"), "mine");
}

TEST(CorpusSize, HasNames) {
    EXPECT_EQ(name_of(CorpusSize::mini), "mini");
    EXPECT_EQ(corpus_size_named("full"), CorpusSize::full);
    EXPECT_EQ(corpus_size_named("huge"), std::nullopt);
}

}  // namespace
}  // namespace chironomia
