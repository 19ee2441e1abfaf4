// What is wrong with a corpus is refused with its place, and no damage of a record breaks the reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hdf5/writer.h"
#include "synth/corpus/corpus.h"
#include "synth/corpus/record_file.h"
#include "synth/corpus/record_files.h"
#include "tests/support/sanitizers.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::sample_dyad;
using testing::sample_index;
using testing::sample_interval;
using testing::sample_ipu;
using testing::sample_talks;
using testing::TemporaryFolder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// What writing a talk says that was changed.
std::string talk_refusal(const std::function<void(IpuRecord&)>& change) {
    const TemporaryFolder folder;
    IpuRecord record = sample_ipu("a_1", "a");
    change(record);
    return refusal_of([&] { write_ipu(folder.path(), record); });
}

TEST(TalkRefusals, NameTheArrayAndBothValues) {
    EXPECT_THAT(talk_refusal([](auto& r) { r.id = "../a"; }),
                EndsWith("\"../a\" cannot name a file; use letters, digits and . _ - +"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.speaker = ".."; }), HasSubstr("\"..\" cannot name a file"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.fps = 30; }),
                EndsWith("a_1.h5: the face has 30 frames/s, and models learn at 24; resample it, as `corpus "
                         "import` does"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.words.clear(); }), EndsWith("there are no words"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.words[1].text = ""; }), EndsWith("word 1 is empty"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.words[1].end = 0.5; }),
                EndsWith("word 1 \",\" lasts from 0.5 to 0.5 s; it must end after it starts"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.words[2].end = std::numeric_limits<double>::infinity(); }),
                EndsWith("to inf s; it must end after it starts"));
    EXPECT_THAT(
        talk_refusal([](auto& r) { r.words[2].start = 0.8; }),
        EndsWith("word 2 \"done\" starts at 0.8 s, the word before it ends at 0.75 s; a silence between "
                 "words is the word \",\""));
    EXPECT_THAT(talk_refusal([](auto& r) { r.success.clear(); }), EndsWith("/success is empty"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.f0.clear(); }), EndsWith("/f0 is empty"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.vectors.pop_back(); }),
                EndsWith("/bert has 2303 numbers, and 2304 fit /words; they must be equally long"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.head.resize(3); }),
                EndsWith("/head has 3 numbers, and 144 fit /success; they must be equally long"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.f0[7] = 0; }),
                EndsWith("/f0: element 7 is 0; 50 to 550 is expected"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.units[8] = 5.5f; }),
                EndsWith("/au: element 8 is 5.5; 0 to 5 is expected"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.head[8] = 20; }),
                EndsWith("/head: element 8 is 20; -3.15 to 3.15 is expected"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.head[8] = kNan; }),
                EndsWith("/head: element 8 is nan; -3.15 to 3.15 is expected"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.vectors[8] = kNan; }),
                EndsWith("/bert: element 8 is nan; all must be finite"));
    EXPECT_THAT(talk_refusal([](auto& r) { r.success[8] = 2; }),
                EndsWith("/success: element 8 is 2; 0 or 1 is expected"));
}

// A pitch that was taken at another rate is as long as another stretch of speech.
TEST(TalkRefusals, NoticeAnotherRateByTheLength) {
    EXPECT_THAT(
        talk_refusal([](auto& r) {
            r.f0.resize(100, 100);
            r.f0_strength.resize(100);
            r.voice.resize(400);
        }),
        EndsWith("/f0 lasts 1.000 s, /words 2.000 s; cut them at the same places, at the rates that the "
                 "format has"));
}

TEST(RecordFile, ReadsWholeNumbersAlone) {
    const TemporaryFolder folder;
    Hdf5Writer writer(folder / "r.h5", "r.h5");
    const std::vector<double> numbers = {1, 1.5};
    writer.write_doubles("tokens", {2}, numbers);
    writer.close();
    EXPECT_THAT(refusal_of([&] { RecordFile(folder / "r.h5").ints("tokens", 2, "tokens"); }),
                HasSubstr("/tokens: element 1 is 1.5; a whole number is expected"));
}

std::string dyad_refusal(const std::function<void(DyadRecord&)>& change) {
    const TemporaryFolder folder;
    DyadRecord record = sample_dyad("d1", "p1", "p2");
    change(record);
    return refusal_of([&] { write_dyad(folder.path(), record); });
}

TEST(DyadRefusals, NameTheArrayAndBothValues) {
    EXPECT_THAT(dyad_refusal([](auto& r) { r.fps = 24; }),
                HasSubstr("the face has 24 frames/s, and models learn at 25"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[0].face.clear(); }), EndsWith("/A/face is empty"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[1].face.resize(10); }),
                EndsWith("/B/face has 10 numbers, and 1000 fit /A/face; they must be equally long"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[0].speech.resize(16); }),
                EndsWith("/A/speech has 16 numbers, and 1600 fit /A/face; they must be equally long"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[1].speech[5] = kNan; }),
                EndsWith("/B/speech: element 5 is nan; all must be finite"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[0].face[12] = 30; }),
                EndsWith("/A/face of frame 1: element 2 is 30; -3.15 to 3.15 is expected"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[0].face[17] = -1; }),
                EndsWith("/A/face of frame 1 from AU1 on: element 2 is -1; 0 to 5 is expected"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[1].participant = "p1"; }),
                EndsWith("both people are the participant \"p1\""));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[1].participant = "p1+x"; }),
                EndsWith("the participant \"p1+x\" has a +, which joins two of them in the index"));
    EXPECT_THAT(dyad_refusal([](auto& r) { r.people[1].participant = ""; }),
                EndsWith("the participant \"\" cannot name a file; use letters, digits and . _ - +"));
}

std::string interval_refusal(const std::function<void(IntervalRecord&)>& change) {
    const TemporaryFolder folder;
    IntervalRecord record = sample_interval("i1", "s");
    change(record);
    return refusal_of([&] { write_interval(folder.path(), record); });
}

TEST(IntervalRefusals, NameTheArrayAndBothValues) {
    EXPECT_THAT(interval_refusal([](auto& r) { r.pose.clear(); }), EndsWith("/pose/data is empty"));
    EXPECT_THAT(interval_refusal([](auto& r) { r.face.clear(); }),
                EndsWith("/face/data has 0 numbers, and 4200 fit /pose/data; they must be equally long"));
    EXPECT_THAT(interval_refusal([](auto& r) { r.pose_confidence[3] = 2; }),
                EndsWith("/pose/confidence: element 3 is 2; 0 to 1.5 is expected"));
    EXPECT_THAT(interval_refusal([](auto& r) { r.mel_400.pop_back(); }),
                EndsWith("/audio/log_mel_400 has no whole rows of 64 numbers"));
    EXPECT_THAT(
        interval_refusal([](auto& r) { r.mel_512.resize(128 * 60); }),
        EndsWith("/audio/log_mel_512 has 60 rows for 2.00 s of pose, where about 172 are expected (86.13 a "
                 "second); take the window and the hop of PATS"));
    EXPECT_THAT(interval_refusal([](auto& r) { r.tokens.resize(4); }),
                EndsWith("/text/tokens has 4 numbers, and 30 fit /pose/data; they must be equally long"));
    EXPECT_THAT(interval_refusal([](auto& r) { r.dialog_acts[4] = 3; }),
                EndsWith("/dialog/tags: element 4 is 3; 0 or 1 is expected"));
}

// An index that was changed as JSON, read again.
std::string index_refusal(const std::function<void(Json&)>& change) {
    const TemporaryFolder folder;
    sample_talks(folder.path());
    Json json = read_json(folder / "corpus.json");
    change(json);
    write_json(folder / "corpus.json", json);
    return refusal_of([&] { read_corpus_index(folder.path()); });
}

TEST(IndexRefusals, NameTheKeyOrTheSpeaker) {
    EXPECT_THAT(index_refusal([](Json& j) { j["format"] = "other"; }), HasSubstr("corpus.json: format: "));
    EXPECT_THAT(index_refusal([](Json& j) { j["version"] = 2; }), HasSubstr("corpus.json: version: "));
    EXPECT_THAT(index_refusal([](Json& j) { j["kind"] = "walks"; }), HasSubstr("corpus.json: kind: "));
    EXPECT_THAT(index_refusal([](Json& j) { j["records"][0]["split"] = "tset"; }),
                HasSubstr("corpus.json: records[0].split: "));
    EXPECT_THAT(index_refusal([](Json& j) { j["records"][0]["speaker"] = "a/b"; }),
                HasSubstr("records[0]: \"a/b\" cannot name a file"));
    EXPECT_THAT(index_refusal([](Json& j) { j["records"][1]["id"] = "a_1"; }),
                EndsWith("the id \"a_1\" comes twice; give each record its own"));
    EXPECT_THAT(
        index_refusal([](Json& j) { j["records"][2]["split"] = "unseen"; }),
        EndsWith("speaker \"b\" is in the split unseen (record \"b_1\") and in validation (record \"b_2\"); "
                 "keep each unseen speaker to one of them"));
    EXPECT_THAT(index_refusal([](Json& j) {
                    for (Json& record : j["records"]) {
                        if (record["split"] == "train") record["split"] = "validation";
                    }
                }),
                EndsWith("the split train is empty, of 5 records; models learn from it alone"));
}

TEST(IndexRefusals, KeepParticipantsOfDyadsToOneSplit) {
    const TemporaryFolder folder;
    const CorpusIndex index =
        sample_index(folder.path(), CorpusKind::dyads,
                     {{.id = "d1", .speaker = "p1+p2", .split = Split::train, .seconds = 4},
                      {.id = "d2", .speaker = "p3+p1", .split = Split::test, .seconds = 4}});
    EXPECT_THAT(
        refusal_of([&] { write_corpus_index(index); }),
        EndsWith("corpus.json: speaker \"p1\" is in the split test (record \"d2\") and in train (record "
                 "\"d1\"); keep each participant to one of them"));
    const CorpusIndex stopped =
        sample_index(folder.path(), CorpusKind::dyads,
                     {{.id = "d1", .speaker = "p1+p2", .split = Split::train, .seconds = 4},
                      {.id = "d2", .speaker = "p3+p4", .split = Split::validation, .seconds = 4},
                      {.id = "d3", .speaker = "p4+p5", .split = Split::test, .seconds = 4}});
    EXPECT_THAT(
        refusal_of([&] { write_corpus_index(stopped); }),
        EndsWith(
            "speaker \"p4\" is in the split test (record \"d3\") and in validation (record \"d2\"); keep "
            "each participant to one of them"));
}

// A record's file with something else under its name.
TEST(RecordRefusals, NoticeAFileThatIsNotTheIndexes) {
    const TemporaryFolder folder;
    const CorpusIndex corpus = sample_talks(folder.path());
    write_ipu_file(folder / "records/a/a_1.h5", sample_ipu("a_2", "a"));
    EXPECT_THAT(
        refusal_of([&] { read_ipu(corpus, corpus.entries[0]); }),
        EndsWith("a_1.h5: its id is \"a_2\", the index says \"a_1\"; put the file back in its place"));
    write_dyad_file(folder / "records/a/a_1.h5", sample_dyad("a_1", "a", "b"));
    EXPECT_THAT(refusal_of([&] { read_ipu(corpus, corpus.entries[0]); }),
                EndsWith("its format is \"chironomia dyad\"; \"chironomia talk\" is expected"));
    std::filesystem::remove(folder / "records/a/a_1.h5");
    EXPECT_THAT(refusal_of([&] { read_ipu(corpus, corpus.entries[0]); }), HasSubstr("records/a/a_1.h5"));
}

// A talk's file by an own hand, with an array left out or other than it should be.
std::string file_refusal(const std::function<void(Hdf5Writer&)>& write_au) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "a.h5";
    Hdf5Writer file(path, "a.h5");
    for (const auto& [name, value] :
         {std::pair{"format", "chironomia talk"}, {"id", "a"}, {"speaker", "a"}, {"source", ""}})
        file.write_attribute(name, value);
    file.write_attribute("version", 1);
    file.write_attribute("start", 0.0);
    file.write_attribute("fps_video", 24.0);
    const std::vector<float> zeros(2 * kWordVector);
    file.write_texts("words", {"well"});
    file.write_doubles("word_times", {1, 2}, std::vector<double>{0, 0.04});
    file.write_floats("bert", {1, kWordVector}, std::span(zeros).first(kWordVector));
    file.write_floats("f0", {4}, std::vector<float>(4, 100));
    file.write_floats("f0_conf", {4}, std::span(zeros).first(4));
    file.write_floats("vq", {4, 4}, std::span(zeros).first(16));
    file.write_bytes("success", {1}, std::vector<std::uint8_t>{1});
    write_au(file);
    file.close();
    return refusal_of([&] { read_ipu_file(path); });
}

TEST(RecordRefusals, NameTheArrayThatIsMissingOrOfAnotherShape) {
    const std::vector<float> zeros(18);
    EXPECT_THAT(file_refusal([](Hdf5Writer&) {}), EndsWith("a.h5: /au is missing"));
    EXPECT_THAT(file_refusal([&](Hdf5Writer& f) {
                    f.write_floats("au", {1, 5}, std::span(zeros).first(5));
                }),
                EndsWith("a.h5: /au has the shape (1, 5); (any, 6) is expected"));
    EXPECT_THAT(file_refusal([&](Hdf5Writer& f) {
                    f.write_floats("au", {3, 6}, zeros);
                }),
                EndsWith("a.h5: /au has 3 rows, /success has 1; they must be equally long"));
    EXPECT_THAT(file_refusal([&](Hdf5Writer& f) {
                    f.write_floats("au", {0, 6}, {});
                }),
                EndsWith("a.h5: /au is empty"));
    EXPECT_THAT(file_refusal([&](Hdf5Writer& f) {
                    std::vector<float> row(6);
                    row[4] = kNan;
                    f.write_floats("au", {1, 6}, row);
                }),
                EndsWith("a.h5: /au: element 4 is nan; all must be finite and below 1000000000"));
}

// Reads what may be broken: an Error with the file's name is well.
template <typename Read>
void expect_no_crash(const std::vector<std::byte>& bytes, const std::filesystem::path& path, Read read) {
    write_bytes(path, bytes);
    try {
        read();
    } catch (const Error& error) {
        ASSERT_THAT(error.what(), HasSubstr(path.filename().string()));
    }
}

template <typename Read>
void flip_bytes(const std::filesystem::path& path, std::size_t step, Read read) {
    const std::vector<std::byte> whole = read_bytes(path);
    if (testing::has_sanitizers()) step *= 3;
    for (std::size_t i = 0; i < whole.size(); i += step) {
        std::vector<std::byte> bytes = whole;
        bytes[i] ^= std::byte{0xff};
        expect_no_crash(bytes, path, read);
    }
    expect_no_crash({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2)}, path,
                    read);
}

TEST(RecordMutations, NeverCrashTheReader) {
    const TemporaryFolder folder;
    write_ipu_file(folder / "talk.h5", sample_ipu("a_1", "a"));
    flip_bytes(folder / "talk.h5", 31, [&] { read_ipu_file(folder / "talk.h5"); });
    write_dyad_file(folder / "dyad.h5", sample_dyad("d1", "p1", "p2"));
    flip_bytes(folder / "dyad.h5", 31, [&] { read_dyad_file(folder / "dyad.h5"); });
    write_interval_file(folder / "interval.h5", sample_interval("i1", "s"));
    flip_bytes(folder / "interval.h5", 307, [&] { read_interval_file(folder / "interval.h5", "i1", "s"); });
    // What pandas wrote has no checksums at all.
    std::filesystem::copy_file(
        testing::source_dir() / "tests/fixtures/corpus/pats/data/processed/oliver/115309.h5",
        folder / "pats.h5");
    flip_bytes(folder / "pats.h5", 101, [&] { read_interval_file(folder / "pats.h5", "i", "s"); });
}

}  // namespace
}  // namespace chironomia
