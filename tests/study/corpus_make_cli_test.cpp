// chironomia corpus make: the real binary, interrupted and gone on with, and its tables imported again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/corpus.h"
#include "tests/study/corpus_info_of.h"
#include "tests/study/process.h"
#include "tests/support/folder_hash.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::info_of;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

std::vector<std::string> making(const fs::path& out, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"corpus", "make", "--size", "ci", "--quiet", "--out", out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(CorpusMake, MakesACorpusThatIsDescribed) {
    const TemporaryFolder folder;
    const std::string out = (folder / "dyads").string();
    const std::vector<std::string> make = making(out + "/", {"--kind", "dyads", "--seed", "3"});
    const Outcome made = run_chironomia(make);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("dyads\n3 dyads, "));
    EXPECT_TRUE(fs::exists(folder / "dyads/statistics.json"));
    const Json described = info_of(out);
    EXPECT_EQ(described["speakers"], 6);
    EXPECT_EQ(described["splits"]["test"]["speakers"], 2);
    for (const Json& person : described["people"]) {
        EXPECT_EQ(person["partners"].size(), 1u);
        EXPECT_GT(person["face"]["AU12"]["sd"], 0.1);
    }
    EXPECT_EQ(run_chironomia(make).exit_code, 3);
}

// One speaker's twelve units in six talks.
const std::vector<std::string> kOneSpeaker = {"--kind", "talks", "--speakers", "1", "--threads", "1"};

TEST(CorpusMake, GoesOnWhereItWasInterrupted) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_chironomia(making(folder / "whole", kOneSpeaker)).exit_code, 0);
    const fs::path partial = folder / ".cut.making";
    const Outcome cut = testing::signal_chironomia_at(partial / "records/adrian/adrian_0002.h5", SIGINT,
                                                      making(folder / "cut", kOneSpeaker));
    EXPECT_EQ(cut.exit_code, 130);
    EXPECT_FALSE(fs::exists(folder / "cut"));
    ASSERT_TRUE(fs::exists(partial / ".made/00000.json"));
    const auto first_made = fs::last_write_time(partial / "records/adrian/adrian_0000.h5");

    std::vector<std::string> other = kOneSpeaker;
    other.insert(other.end(), {"--seed", "2"});
    const Outcome refused = run_chironomia(making(folder / "cut", other));
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, AllOf(HasSubstr(".cut.making: an unfinished making of another order waits here "
                                             "(seed 2 and not 1); go on with that one"),
                                   HasSubstr("or remove this one")));

    const Outcome resumed = run_chironomia(making(folder / "cut", kOneSpeaker));
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(fs::last_write_time(folder / "cut/records/adrian/adrian_0000.h5"), first_made);
    EXPECT_EQ(testing::hash_of_folder(folder / "cut"), testing::hash_of_folder(folder / "whole"));
    EXPECT_FALSE(fs::exists(partial));
}

// The largest difference of two arrays that are equally long but for one row.
double difference(const std::vector<float>& a, const std::vector<float>& b, std::size_t width,
                  const std::string& what) {
    const std::size_t common = std::min(a.size(), b.size());
    EXPECT_LE(std::max(a.size(), b.size()) - common, width) << what;
    double most = 0;
    for (std::size_t i = 0; i < common; ++i) most = std::max(most, std::abs(double{a[i]} - b[i]));
    return most;
}

// The rows, `width` wide, with no lost frame within seven frames before and after, so that no median of the smoothing
// has a gap in it. A tracker makes units below 0 to 0. That changes the median of an even number of values, as at a
// gap.
std::vector<float> wholly_seen(const std::vector<float>& rows, std::size_t width,
                               const std::vector<std::uint8_t>& success) {
    std::vector<float> kept;
    const auto frames = static_cast<std::ptrdiff_t>(success.size());
    for (std::ptrdiff_t t = 0; t + 1 < frames; ++t) {
        const auto first = success.begin() + std::max<std::ptrdiff_t>(0, t - 7);
        const auto last = success.begin() + std::min(frames, t + 8);
        if (std::find(first, last, 0) != last) continue;
        const auto row = rows.begin() + t * static_cast<std::ptrdiff_t>(width);
        kept.insert(kept.end(), row, row + static_cast<std::ptrdiff_t>(width));
    }
    return kept;
}

Outcome import_of(const fs::path& corpus, const std::string& manifest, const fs::path& out) {
    return run_chironomia(
        {"corpus", "import", (corpus / "recordings" / manifest).string(), "--out", out.string(), "--quiet"});
}

void expect_same_unit(const IpuRecord& made, const IpuRecord& read) {
    ASSERT_EQ(read.words.size(), made.words.size()) << made.id;
    for (std::size_t w = 0; w < made.words.size(); ++w) {
        EXPECT_EQ(read.words[w].text, made.words[w].text) << made.id;
        EXPECT_NEAR(read.words[w].start, made.words[w].start, 1e-9);
        EXPECT_NEAR(read.words[w].end, made.words[w].end, 1e-9);
    }
    EXPECT_EQ(read.vectors, made.vectors) << made.id;
    EXPECT_LT(difference(read.f0, made.f0, 1, "f0"), 1e-3) << made.id;
    EXPECT_LT(difference(read.f0_strength, made.f0_strength, 1, "f0_conf"), 1e-6) << made.id;
    EXPECT_LT(difference(read.voice, made.voice, IpuRecord::kVoice, "vq"), 1e-6) << made.id;
    EXPECT_LT(difference(read.head, made.head, IpuRecord::kAngles, "head"), 1e-5) << made.id;
    EXPECT_LT(difference(read.units, made.units, IpuRecord::kUnits, "au"), 0.3) << made.id;
    EXPECT_LT(difference(wholly_seen(read.units, 6, made.success), wholly_seen(made.units, 6, made.success),
                         6, "au"),
              1e-5)
        << made.id;
    const std::size_t frames = std::min(read.frames(), made.frames());
    for (std::size_t t = 0; t < frames; ++t) EXPECT_EQ(read.success[t], made.success[t]) << made.id;
}

// What the importer makes of the tables that a tracker and openSMILE would have written is what the maker
// keeps itself.
TEST(CorpusMake, WritesTablesOutOfWhichTheImporterMakesTheSameTalks) {
    const TemporaryFolder folder;
    std::vector<std::string> more = kOneSpeaker;
    more.emplace_back("--tables");
    ASSERT_EQ(run_chironomia(making(folder / "made", more)).exit_code, 0);
    const Outcome imported = import_of(folder / "made", "tables.json", folder / "read");
    ASSERT_EQ(imported.exit_code, 0) << imported.err;
    const CorpusIndex made = read_corpus_index(folder / "made"), read = read_corpus_index(folder / "read");
    ASSERT_EQ(read.entries.size(), made.entries.size()) << imported.err;
    for (std::size_t i = 0; i < made.entries.size(); ++i) {
        EXPECT_EQ(read.entries[i].id, made.entries[i].id + "_0000");
        EXPECT_EQ(read.entries[i].split, made.entries[i].split);
        expect_same_unit(read_ipu(made, made.entries[i]), read_ipu(read, read.entries[i]));
    }
    // Out of the sounds the voice is measured again.
    const Outcome heard = import_of(folder / "made", "sounds.json", folder / "heard");
    ASSERT_EQ(heard.exit_code, 0) << heard.err;
    const CorpusIndex sounds = read_corpus_index(folder / "heard");
    ASSERT_EQ(sounds.entries.size(), made.entries.size());
    expect_same_unit(read_ipu(made, made.entries[3]), read_ipu(sounds, sounds.entries[3]));
}

TEST(CorpusMake, WritesTablesOutOfWhichTheImporterMakesTheSameDyads) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_chironomia(making(folder / "made", {"--kind", "dyads", "--tables"})).exit_code, 0);
    const Outcome imported = import_of(folder / "made", "tables.json", folder / "read");
    ASSERT_EQ(imported.exit_code, 0) << imported.err;
    const CorpusIndex made = read_corpus_index(folder / "made"), read = read_corpus_index(folder / "read");
    ASSERT_EQ(read.entries.size(), made.entries.size());
    for (std::size_t i = 0; i < made.entries.size(); ++i) {
        const DyadRecord ours = read_dyad(made, made.entries[i]), theirs = read_dyad(read, read.entries[i]);
        EXPECT_EQ(read.entries[i].split, made.entries[i].split);
        for (std::size_t p = 0; p < 2; ++p) {
            const DyadPerson &a = ours.people[p], &b = theirs.people[p];
            EXPECT_EQ(a.participant, b.participant);
            EXPECT_EQ(a.role, b.role);
            EXPECT_LT(difference(a.speech, b.speech, DyadPerson::kSpeech, "speech"), 1e-2) << ours.id;
            std::vector<float> angles[2];
            double most = 0;
            for (std::size_t t = 0; t < std::min(ours.frames(), theirs.frames()); ++t) {
                for (std::size_t c = 0; c < 5; ++c) {
                    angles[0].push_back(a.face[t * DyadPerson::kFace + c]);
                    angles[1].push_back(b.face[t * DyadPerson::kFace + c]);
                }
                for (std::size_t c = 5; c < DyadPerson::kFace; ++c)
                    most = std::max(most, std::abs(double{a.face[t * 10 + c]} - b.face[t * 10 + c]));
            }
            EXPECT_LT(difference(angles[0], angles[1], 0, "angles"), 1e-5) << ours.id;
            EXPECT_LT(most, 0.3) << ours.id;
        }
    }
}

TEST(CorpusMake, WrongCommandLinesAreRefused) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"corpus"},
          {"corpus", "make", "--out", "x"},
          {"corpus", "make", "--kind", "walks", "--out", "x"},
          {"corpus", "make", "--kind", "talks", "--speakers", "17", "--out", "x"},
          {"corpus", "make", "--kind", "talks", "--speakers", "2+7", "--out", "x"},
          {"corpus", "make", "--kind", "talks", "--speakers", "0+1", "--out", "x"},
          {"corpus", "make", "--kind", "dyads", "--speakers", "4", "--out", "x"},
          {"corpus", "make", "--kind", "intervals", "--tables", "--out", "x"},
          {"corpus", "import", "--out", "x"}})
        EXPECT_EQ(run_chironomia(words).exit_code, 2) << words.back();
}

TEST(CorpusMake, NamesThePeopleThereAre) {
    const TemporaryFolder folder;
    const Outcome nobody =
        run_chironomia(making(folder / "out", {"--kind", "talks", "--speakers", "adrian,nobody"}));
    EXPECT_EQ(nobody.exit_code, 3);
    EXPECT_THAT(nobody.err,
                HasSubstr("speakers: nobody of this size is called \"nobody\"; there are adrian, "));
    const Outcome unseen =
        run_chironomia(making(folder / "out", {"--kind", "talks", "--speakers", "quentin"}));
    EXPECT_EQ(unseen.exit_code, 3);
    EXPECT_THAT(unseen.err, HasSubstr("speakers: quentin is unseen, and models learn from seen ones alone; "
                                      "add one of adrian, "));
    EXPECT_FALSE(fs::exists(folder / "out"));
    EXPECT_FALSE(fs::exists(folder / ".out.making"));
    const Outcome count = run_chironomia(making(folder / "out", {"--kind", "talks", "--speakers", "17"}));
    EXPECT_THAT(count.err,
                HasSubstr("is \"17\"; there are 1 to 16 speakers to learn from and, behind a +, 0 to 6"));
}

}  // namespace
}  // namespace chironomia::study
