// chironomia corpus: the real binary, from recordings or from nothing to a corpus that models read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "synth/corpus/corpus.h"
#include "synth/corpus/statistics.h"
#include "synth/text/word_vectors.h"
#include "tests/study/corpus_info_of.h"
#include "tests/study/process.h"
#include "tests/study/recordings.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using testing::FaceSpec;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using testing::info_of;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

class CorpusImport : public ::testing::Test {
  protected:
    CorpusImport() {
        double confidence = 0.98;
        for (const char* face : {"face.csv", "p1.csv", "p2.csv"}) {
            testing::write_openface(file(face), {.first_lost = 20, .end_lost = 23, .confidence = confidence});
            confidence -= 0.01;
        }
        for (const char* voice : {"voice.wav", "p1.wav"}) testing::write_voice(file(voice));
        testing::write_voice(file("p2.wav"), 6, 180);
        testing::write_timed_words(file("words.csv"));
    }

    fs::path file(const std::string& name) { return folder_ / name; }

    static Json talk() {
        return {{"id", "t1"},
                {"speaker", "anna"},
                {"face", "face.csv"},
                {"audio", "voice.wav"},
                {"words", "words.csv"}};
    }
    static Json person(const std::string& name, const std::string& role) {
        return {{"participant", name}, {"role", role}, {"face", name + ".csv"}, {"audio", name + ".wav"}};
    }
    static Json dyad() {
        return {{"id", "d1"},
                {"language", "fr"},
                {"people", {person("p1", "expert"), person("p2", "novice")}},
                {"split", "train"}};
    }

    Outcome import_all(const std::string& kind, const std::vector<Json>& recordings,
                       const std::string& out = "out") {
        return import_manifest({{"kind", kind}, {"recordings", recordings}}, out);
    }
    Outcome import_manifest(const Json& manifest, const std::string& out = "out") {
        write_json(file("m.json"), manifest);
        return run_chironomia(
            {"corpus", "import", file("m.json").string(), "--out", file(out).string(), "--quiet"});
    }
    // What a manifest that must be refused as wrong input says.
    std::string refusal(const Json& manifest) {
        const Outcome outcome = import_manifest(manifest);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
        EXPECT_FALSE(fs::exists(file("out")));
        return outcome.err;
    }
    std::string talk_refusal(const std::string& key, const Json& value) {
        Json changed = talk();
        if (value.is_null())
            changed.erase(key);
        else
            changed[key] = value;
        return refusal({{"kind", "talks"}, {"recordings", {changed}}});
    }
    std::string dyad_refusal(const Json& dyad) {
        return refusal({{"kind", "dyads"}, {"recordings", {dyad}}});
    }

    TemporaryFolder folder_;
};

TEST_F(CorpusImport, CutsTalksIntoUnits) {
    const Outcome made = import_all("talks", {talk()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("out\n2 talks, 0.0 min: 2 train, 0 validation, 0 test, 0 unseen\n"));
    const CorpusIndex corpus = read_corpus_index(file("out"));
    ASSERT_EQ(corpus.entries.size(), 2u);
    const IpuRecord unit = read_ipu(corpus, corpus.entries[0]);
    EXPECT_EQ(unit.id, "t1_0000");
    EXPECT_EQ(unit.speaker, "anna");
    EXPECT_EQ(unit.start, 0.5);
    ASSERT_EQ(unit.words.size(), 3u);
    EXPECT_EQ(unit.words[1].text, ",");
    EXPECT_NEAR(unit.words[1].start, 0.5, 1e-9);
    EXPECT_NEAR(unit.words[1].end, 0.6, 1e-9);
    const std::vector<std::string> texts = {"well", ",", "done"};
    const std::vector<float> vectors = hashbert(texts);
    ASSERT_EQ(unit.vectors.size(), vectors.size());
    for (std::size_t i = 0; i < vectors.size(); ++i) EXPECT_NEAR(unit.vectors[i], vectors[i], 2e-3);
    EXPECT_EQ(unit.f0.size(), 100u);
    EXPECT_THAT(unit.f0, Each(FloatNear(120, 1.2f)));
    EXPECT_EQ(read_ipu(corpus, corpus.entries[1]).words.at(0).text, "again");
}

// The face was tracked at 30 frames/s and lost for three of them; all its numbers rise evenly.
TEST_F(CorpusImport, BringsTheFaceToItsRateAndBridgesIt) {
    ASSERT_EQ(import_all("talks", {talk()}).exit_code, 0);
    const CorpusIndex corpus = read_corpus_index(file("out"));
    const IpuRecord unit = read_ipu(corpus, corpus.entries[0]);
    ASSERT_EQ(unit.frames(), 24u);
    for (std::size_t t = 0; t < unit.frames(); ++t) {
        const double time = 0.5 + static_cast<double>(t) / 24;
        // Frames 20 to 22 of 30 a second lie about 0.7 s. Beside them the median of 7 has neighbours on one
        // side alone, and lags by up to one frame and a half.
        const double frame = time * 30;
        const double lag = frame > 16 && frame < 26 ? 1.5 / 30 : 0;
        for (std::size_t u = 0; u < IpuRecord::kUnits; ++u) {
            const double rise = 0.1 * static_cast<double>(u + 1);
            EXPECT_NEAR(unit.units[t * 6 + u], rise * time, rise * lag + 2e-5) << time;
        }
        // OpenFace's angles come through our own turns of the head.
        for (std::size_t a = 0; a < 3; ++a) {
            const double rise = 0.01 * static_cast<double>(a + 1);
            EXPECT_NEAR(unit.head[t * 3 + a], rise * time, rise * lag + 1e-6) << time;
        }
        const bool bridged = frame > 19.01 && frame < 22.99, seen = frame < 18.99 || frame > 23.01;
        EXPECT_TRUE((bridged && unit.success[t] == 0) || (seen && unit.success[t] == 1)) << time;
    }
}

TEST_F(CorpusImport, GivesTheSameBytes) {
    Json second = talk();
    second["id"] = "t2";
    second["face"] = "p2.csv";
    ASSERT_EQ(import_all("talks", {talk(), second}, "a").exit_code, 0);
    ASSERT_EQ(import_all("talks", {talk(), second}, "b").exit_code, 0);
    for (const char* name :
         {"corpus.json", "statistics.json", "records/anna/t1_0000.h5", "records/anna/t2_0001.h5"})
        EXPECT_EQ(read_bytes(file("a") / name), read_bytes(file("b") / name)) << name;
}

TEST_F(CorpusImport, TakesVoicesFromOpenSmile) {
    testing::write_opensmile(file("speech.csv"), file("quality.csv"));
    Json tables = talk();
    tables.erase("audio");
    tables["speech"] = "speech.csv";
    tables["voice"] = "quality.csv";
    const Outcome made = import_all("talks", {tables});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const CorpusIndex corpus = read_corpus_index(file("out"));
    const IpuRecord unit = read_ipu(corpus, corpus.entries[0]);
    EXPECT_THAT(unit.f0, Each(FloatNear(150, 1e-3f)));
    EXPECT_THAT(unit.f0_strength, Each(FloatNear(0.9f, 1e-6f)));
    EXPECT_NEAR(unit.voice[2], 15, 1e-6);
    fs::remove_all(file("out"));
    testing::write_opensmile(file("speech.csv"), file("quality.csv"), 6, 0.02);
    EXPECT_THAT(
        refusal({{"kind", "talks"}, {"recordings", {tables}}}),
        HasSubstr("speech.csv: it has 50 frames/s, talks have 100; set openSMILE's frame step to 0.01 s"));
    testing::write_opensmile(file("speech.csv"), file("unused.csv"));
    testing::write_opensmile(file("unused.csv"), file("quality.csv"), 3);
    EXPECT_THAT(refusal({{"kind", "talks"}, {"recordings", {tables}}}),
                AllOf(HasSubstr("speech.csv: it has 600 frames, "),
                      HasSubstr("quality.csv has 300; both must come out "
                                "of one sound")));
}

TEST_F(CorpusImport, KeepsShotsApart) {
    // A cut at 1.05 s lies in the silence between "well" and "done"; the last shot is too short.
    write_text(file("shots.csv"),
               "Timecode List:,00:00:01.050,00:00:05.000\n"
               "Scene Number,Start Frame,Start Timecode,Start Time (seconds),End Frame,End Timecode,End Time "
               "(seconds)\n"
               "1,1,00:00:00.000,0.0,31,00:00:01.050,1.05\n"
               "2,32,00:00:01.050,1.05,150,00:00:05.000,5.0\n"
               "3,151,00:00:05.000,5.0,180,00:00:06.000,6.0\n");
    Json cut = talk();
    cut["shots"] = "shots.csv";
    const Outcome made =
        import_manifest({{"kind", "talks"}, {"limits", {{"least_seconds", 1.02}}}, {"recordings", {cut}}});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("left out: shots under 1.02 s: 1\n"));
    const CorpusIndex corpus = read_corpus_index(file("out"));
    ASSERT_EQ(corpus.entries.size(), 3u);
    EXPECT_EQ(read_ipu(corpus, corpus.entries[0]).words.size(), 1u);
    EXPECT_EQ(read_ipu(corpus, corpus.entries[1]).words.at(0).text, "done");
    fs::remove_all(file("out"));
    write_text(file("shots.csv"), "start_frame,end_frame\n0,100\n90,180\n");
    EXPECT_THAT(
        talk_refusal("shots", "shots.csv"),
        HasSubstr("shots.csv:3: the shot has the frames 90 to 180 of 180; shots must follow one another"));
    write_text(file("shots.csv"), "begin,end\n0,100\n");
    EXPECT_THAT(
        talk_refusal("shots", "shots.csv"),
        HasSubstr("shots.csv: there are neither \"Start Time (seconds)\" and \"End Time (seconds)\" nor"));
    write_text(file("shots.csv"), "start_frame,end_frame\n-1,100\n");
    EXPECT_THAT(talk_refusal("shots", "shots.csv"),
                HasSubstr("shots.csv:2: column \"start_frame\": -1 is no time in a video"));
}

TEST_F(CorpusImport, JoinsTwoPeopleToADyad) {
    const Outcome made = import_all("dyads", {dyad()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const CorpusIndex corpus = read_corpus_index(file("out"));
    const DyadRecord found = read_dyad(corpus, corpus.entries.at(0));
    EXPECT_EQ(found.language, "fr");
    EXPECT_EQ(found.people[1].role, "novice");
    ASSERT_EQ(found.frames(), 150u);
    for (const std::size_t t : {10u, 100u}) {
        const double time = static_cast<double>(t) / 25;
        const float* face = &found.people[0].face[t * DyadPerson::kFace];
        EXPECT_NEAR(face[0], 0.004 * time, 1e-6);
        EXPECT_NEAR(face[1], 0.006 * time, 1e-6);
        EXPECT_NEAR(face[3], 0.02 * time, 1e-6);
        EXPECT_NEAR(face[9], 0.7 * time, 2e-5);  // AU12
        EXPECT_NEAR(found.people[0].speech[t * DyadPerson::kSpeech], 120, 1.2);
    }
    const CorpusStatistics statistics = read_statistics(corpus);
    // 150 numbers of each of two: the 99th percentile, place 296.01 of 0 to 299, is that of frame 148.
    EXPECT_NEAR(statistics.of("face")[9].one, 0.7 * 148 / 25, 1e-4);
}

TEST_F(CorpusImport, RefusesPeopleWhoWereNotRecordedTogether) {
    testing::write_voice(file("short.wav"), 4);
    Json changed = dyad();
    changed["people"][1]["audio"] = "short.wav";
    EXPECT_THAT(
        dyad_refusal(changed),
        HasSubstr("m.json: dyad \"d1\": its faces last 6.00 and 6.00 s, its voices 6.00 and 4.00 s; cut "
                  "them so that they begin and end together"));
}

TEST_F(CorpusImport, RefusesDyadsThatCannotBeSplit) {
    Json changed = dyad();
    changed.erase("split");
    EXPECT_THAT(dyad_refusal(changed), HasSubstr("1 dyads fall into 1 groups of people who never meet"));
}

TEST_F(CorpusImport, RefusesAFaceWithoutWhatTheCorpusNeeds) {
    testing::write_openface(file("face.csv"), {.without = "AU05"});
    EXPECT_THAT(talk_refusal("id", "t1"),
                HasSubstr("face.csv: it has no AU05_r, which the corpus needs; let the tracker write them"));
    testing::write_openface(file("face.csv"), {.without = "pose"});
    EXPECT_THAT(talk_refusal("id", "t1"), HasSubstr("face.csv: it has no pose_Rx, pose_Ry, pose_Rz"));
    testing::write_openface(file("p1.csv"), {.without = "gaze"});
    EXPECT_THAT(dyad_refusal(dyad()), HasSubstr("p1.csv: it has no gaze_angle_x, gaze_angle_y"));
    EXPECT_THAT(
        talk_refusal("face", (testing::source_dir() / "assets/samples/expressive/two-ways.bvh").string()),
        HasSubstr("two-ways.bvh: it holds no face"));
}

TEST_F(CorpusImport, SaysWhyNothingIsLeft) {
    const auto reason = [&](const FaceSpec& spec) {
        testing::write_openface(file("face.csv"), spec);
        return talk_refusal("id", "t1");
    };
    write_text(file("words.csv"), "start,end,word\n0.2,0.6,yes\n");
    testing::write_voice(file("voice.wav"), 1.5);
    EXPECT_THAT(reason({.seconds = 1}), AllOf(HasSubstr("m.json: nothing is left to learn from: "),
                                              HasSubstr("left out: shots under 2 s: 1")));
    testing::write_timed_words(file("words.csv"));
    testing::write_voice(file("voice.wav"));
    EXPECT_THAT(reason({.first_lost = 0, .end_lost = 100}),
                HasSubstr("left out: shots with a face in under 50 % of the frames: 1"));
    EXPECT_THAT(reason({.confidence = 0.8}),
                HasSubstr("left out: shots with a confidence of 0.9 in under 80 % of the frames: 1"));
    testing::write_openface(file("face.csv"), {});
    write_text(file("words.csv"), "start,end,word\n5.9,6.0,late\n");
    testing::write_openface(file("face.csv"), {.seconds = 5});
    EXPECT_THAT(talk_refusal("id", "t1"), HasSubstr("left out: shots without a whole word: 1"));
    testing::write_timed_words(file("words.csv"));
    testing::write_openface(file("face.csv"), {});
    write_wav(file("voice.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(96000)});
    EXPECT_THAT(talk_refusal("id", "t1"), HasSubstr("left out: units without a voiced sample: 2"));
}

TEST_F(CorpusImport, CountsWordsThatNoShotHasWhole) {
    write_text(file("shots.csv"), "start_frame,end_frame\n0,80\n80,180\n");  // "again" lies from 75 to 90
    Json cut = talk();
    cut["shots"] = "shots.csv";
    EXPECT_THAT(import_all("talks", {cut}).err, HasSubstr("left out: words that no shot has whole: 1\n"));
}

TEST_F(CorpusImport, RefusesATalkWhoseFaceEndsBeforeItsSound) {
    testing::write_openface(file("face.csv"), {.seconds = 4});
    EXPECT_THAT(
        talk_refusal("id", "t1"),
        HasSubstr("face.csv: it lasts 4.00 s (120 frames at 30 frames/s), and the voice of \"t1\" 6.00 s; "
                  "give files that begin and end together"));
}

// As what is left of a table when the rows in which no face was found are dropped.
TEST_F(CorpusImport, RefusesAFaceWhoseFirstRowsAreNotThere) {
    const std::string why =
        ": its first frame is at 0.60 s and its last one at 6.00 s, where the sound of 6.00 s ends; taken from second "
        "0 on all would come 0.60 s too early. Keep the frames before it (empty, or with success 0)";
    testing::write_openface(file("face.csv"), {.first_row = 18});
    EXPECT_THAT(talk_refusal("id", "t1"), HasSubstr("face.csv" + why));
    testing::write_openface(file("p2.csv"), {.first_row = 18});
    EXPECT_THAT(dyad_refusal(dyad()), HasSubstr("p2.csv" + why));
    // A clock that ran before the recording began.
    testing::write_openface(file("p2.csv"), {.seconds = 7, .first_row = 30});
    EXPECT_EQ(import_all("dyads", {dyad()}).exit_code, 0);
}

TEST_F(CorpusImport, SaysThatFaceAndVoiceEndAtDifferentTimes) {
    testing::write_openface(file("face.csv"), {.seconds = 5.5});
    testing::write_openface(file("p1.csv"), {.seconds = 5.5});
    const std::string note =
        "the face lasts 5.50 s and its sound 6.00 s; what is over at the end is cut off, so they must begin together";
    EXPECT_THAT(import_all("talks", {talk()}).err, HasSubstr("t1: " + note));
    EXPECT_THAT(import_all("dyads", {dyad()}, "dyads").err, HasSubstr("d1, p1: " + note));
}

TEST_F(CorpusImport, RefusesOneVoiceForTwoPeople) {
    Json changed = dyad();
    changed["people"][1]["audio"] = "p1.wav";
    EXPECT_THAT(dyad_refusal(changed),
                AllOf(HasSubstr("m.json: recordings[0].people[1]: "),
                      HasSubstr("p1.wav is the voice of the other person, too; give each "
                                "one's own microphone")));
    fs::copy(file("p1.wav"), file("copy.wav"));
    changed["people"][1]["audio"] = "copy.wav";
    EXPECT_THAT(dyad_refusal(changed),
                HasSubstr("copy.wav is the voice of the other person, too: it has the bytes of " +
                          file("p1.wav").string() + "; give each one's own microphone"));
    const auto write_waving = [&](const std::string& name, double pitch, int rate, float factor) {
        Audio voice = testing::voice_like(pitch, rate, 6);
        for (size_t i = 0; i < voice.samples.size(); ++i)
            voice.samples[i] *=
                factor * static_cast<float>(1 + 0.8 * std::sin(5.0 * static_cast<double>(i) / rate));
        write_wav(file(name), voice);
    };
    write_waving("p1.wav", 120, 16000, 0.5f);
    write_waving("quiet.wav", 120, 22050, 0.1f);
    write_waving("p2.wav", 180, 16000, 0.5f);
    changed["people"][1]["audio"] = "quiet.wav";
    EXPECT_THAT(
        dyad_refusal(changed),
        AllOf(HasSubstr("m.json: dyad \"d1\": " + file("p1.wav").string() + " and " +
                        file("quiet.wav").string() + " are one sound: their loudness correlates by "),
              HasSubstr(", and their pitch is the same in 100 % of the frames; give each person's own "
                        "microphone")));
    EXPECT_EQ(import_all("dyads", {dyad()}).exit_code, 0) << "another pitch, equally loud: another person";
}

TEST_F(CorpusImport, RefusesABrokenManifestWithItsKey) {
    EXPECT_THAT(talk_refusal("words", Json()), HasSubstr("m.json: recordings[0].words: is missing; add it"));
    EXPECT_THAT(talk_refusal("word", "words.csv"),
                HasSubstr("m.json: recordings[0].word: there is no such key; did you mean \"words\"?"));
    EXPECT_THAT(talk_refusal("face", "no.csv"), HasSubstr("recordings[0].face: there is no file "));
    EXPECT_THAT(talk_refusal("audio", Json()),
                HasSubstr("recordings[0]: the voice comes either from a sound"));
    EXPECT_THAT(talk_refusal("speech", "words.csv"),
                HasSubstr("recordings[0]: the voice comes either from a sound"));
    EXPECT_THAT(talk_refusal("speaker", "an/na"),
                HasSubstr("recordings[0].speaker: \"an/na\" cannot name a file"));
    EXPECT_THAT(talk_refusal("speaker", "an+na"), HasSubstr("recordings[0].speaker: \"an+na\" has a +"));
    Json tables = talk();
    tables.erase("audio");
    tables["speech"] = "words.csv";
    EXPECT_THAT(refusal({{"kind", "talks"}, {"recordings", {tables}}}),
                HasSubstr("recordings[0]: there is \"speech\", but not \"voice\" of openSMILE's eGeMAPS"));
    EXPECT_THAT(refusal({{"kind", "talks"}, {"recordings", {talk(), talk()}}}),
                HasSubstr("recordings[1].id: \"t1\" comes twice"));
    Json with_split = talk();
    with_split["id"] = "t2";
    with_split["face"] = "p2.csv";
    with_split["split"] = "test";
    EXPECT_THAT(refusal({{"kind", "talks"}, {"recordings", {talk(), with_split}}}),
                HasSubstr("recordings[1]: some recordings have a \"split\" and some have none"));
    EXPECT_THAT(refusal({{"kind", "talks"}, {"limits", {{"least_sure", 2}}}, {"recordings", {talk()}}}),
                HasSubstr("limits.least_sure"));
    Json alone = dyad();
    alone["people"][1]["participant"] = "p1";
    EXPECT_THAT(dyad_refusal(alone), HasSubstr("people[1].participant: is \"p1\", as the other person is"));
    alone["people"].push_back(person("p3", "novice"));
    EXPECT_THAT(dyad_refusal(alone), HasSubstr("recordings[0].people: there are 3; a dyad has 2"));
}

// Both would put the same motion or the same person into two splits.
TEST_F(CorpusImport, RefusesAFaceThatIsTakenTwice) {
    Json again = talk();
    again["id"] = "t2";
    again["speaker"] = "ben";
    again["face"] = "./face.csv";
    EXPECT_THAT(
        refusal({{"kind", "talks"}, {"recordings", {talk(), again}}}),
        HasSubstr("face.csv is of \"t1\" already; take no part of a recording twice, for a model would be "
                  "judged on what it has learned"));
    fs::copy(file("face.csv"), file("copy.csv"));
    again["face"] = "copy.csv";
    EXPECT_THAT(
        refusal({{"kind", "talks"}, {"recordings", {talk(), again}}}),
        HasSubstr("recordings[1].face: " + file("copy.csv").string() +
                  " is of \"t1\" already: it has the bytes of " + file("face.csv").string() + "; take no"));
    Json alone = dyad();
    alone["people"][1]["face"] = "p1.csv";
    EXPECT_THAT(dyad_refusal(alone), HasSubstr("recordings[0].people[1].face: "));
}

TEST_F(CorpusImport, RefusesNamesOfPeopleThatDifferByCaseAlone) {
    Json again = talk();
    again["id"] = "t2";
    again["face"] = "p2.csv";
    again["speaker"] = "Anna";
    EXPECT_THAT(
        refusal({{"kind", "talks"}, {"recordings", {talk(), again}}}),
        HasSubstr("recordings[1].speaker: is \"Anna\", and \"anna\" comes before; write one person's name in "
                  "one way"));
}

TEST_F(CorpusImport, RefusesASpeakerInTwoSplits) {
    Json first = talk(), second = talk();
    first["split"] = "train";
    second["id"] = "t2";
    second["face"] = "p2.csv";
    second["split"] = "unseen";
    EXPECT_THAT(refusal({{"kind", "talks"}, {"recordings", {first, second}}}),
                HasSubstr("speaker \"anna\" is in the split unseen (record \"t2_0000\") and in train (record "
                          "\"t1_0000\"); keep each unseen speaker to one of them"));
}

TEST_F(CorpusImport, LeavesAFolderWithSomethingInItAlone) {
    write_text(file("out/mine.txt"), "mine");
    const Outcome outcome = import_all("talks", {talk()});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("already holds something; name a new folder or remove this one"));
}

TEST_F(CorpusImport, IsDescribedWithItsSpeakers) {
    ASSERT_EQ(import_all("talks", {talk()}).exit_code, 0);
    const Json described = info_of(file("out"));
    EXPECT_EQ(described["kind"], "talks");
    EXPECT_EQ(described["splits"]["train"]["records"], 2);
    const Json& anna = described["people"].at(0);
    EXPECT_EQ(anna["speaker"], "anna");
    EXPECT_NEAR(anna["minutes"].get<double>(), 1.5 / 60, 1e-9);
    EXPECT_NEAR(anna["words_per_minute"].get<double>(), 3 / (1.5 / 60), 1e-6);
    EXPECT_NEAR(anna["f0_hz"]["mean"].get<double>(), 120, 1.2);
    // 24 frames from 0.5 s on and 12 from 2.5 s on of what rises by 0.1 a second.
    EXPECT_NEAR(anna["units"]["AU1"]["mean"].get<double>(),
                0.1 * (24 * (0.5 + 11.5 / 24) + 12 * (2.5 + 5.5 / 24)) / 36, 1e-5);
    EXPECT_GT(anna["bridged"].get<double>(), 2 / 36.0);
    const Outcome text = run_chironomia({"corpus", "info", file("out").string()});
    EXPECT_THAT(text.out,
                AllOf(HasSubstr("talks of 2 records, 1 speakers, 0.0 min, words by hashbert\n"),
                      HasSubstr("speaker  minutes  splits  words/min  distinct  of 1000  alike  f0 [Hz]"),
                      HasSubstr("\nanna     0.0      train   120        1.00      -        -      120 (")));
    EXPECT_EQ(anna["lexical"]["words"], 3);
    EXPECT_EQ(anna["lexical"]["diversity"], 1.0);
    EXPECT_TRUE(anna["lexical"]["diversity_per_1000"].is_null());
    EXPECT_TRUE(anna["lexical"]["cluster"].is_null()) << "one person is like nobody";
}

TEST_F(CorpusImport, IsDescribedWithItsParticipants) {
    ASSERT_EQ(import_all("dyads", {dyad()}).exit_code, 0);
    const Json described = info_of(file("out"));
    EXPECT_EQ(described["speakers"], 2);
    EXPECT_EQ(described["splits"]["train"]["speakers"], 2);
    EXPECT_EQ(described["people"][1]["speaker"], "p2");
    EXPECT_EQ(described["people"][1]["roles"], Json({"novice"}));
    EXPECT_EQ(described["people"][1]["partners"], Json({"p1"}));
    EXPECT_NEAR(described["people"][0]["face"]["AU12"]["mean"].get<double>(), 0.7 * 74.5 / 25, 1e-3);
}

// Of four people one says ten times the same word, two say others, and one counts up to 1,100.
TEST_F(CorpusImport, IsDescribedWithHowRichTheWordsAre) {
    const auto says = [&](const std::string& who, const std::vector<std::string>& words, double step) {
        std::string table = "start,end,word\n";
        for (std::size_t i = 0; i < words.size(); ++i) {
            const double start = 0.01 + step * static_cast<double>(i);
            table += format("{:.5f},{:.5f},{}\n", start, start + step, words[i]);
        }
        write_text(file(who + ".csv"), table);
        Json said = talk();
        said["id"] = said["speaker"] = who;
        said["face"] = "face of " + who;
        testing::write_openface(file("face of " + who),
                                {.confidence = 0.95 + 1e-5 * static_cast<double>(words.size())});
        said["words"] = who + ".csv";
        return said;
    };
    std::vector<std::string> numbers;
    for (int i = 0; i < 1100; ++i) numbers.push_back(format("n{}", i % 700));
    const std::vector<Json> recordings = {says("anna", std::vector<std::string>(10, "Well"), 0.5),
                                          says("ben", {"mountain", "rivers", "mountain", "RIVERS"}, 0.5),
                                          says("cleo", {"rivers", "mountain", "rivers"}, 0.5),
                                          says("dora", numbers, 0.005)};
    const Outcome made = import_all("talks", recordings);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json people = info_of(file("out"))["people"];
    const auto lexical = [&](std::size_t i) { return people.at(i)["lexical"]; };
    EXPECT_EQ(lexical(0)["diversity"], 0.1);
    EXPECT_EQ(lexical(1)["diversity"], 0.5) << "case does not count";
    EXPECT_NEAR(lexical(3)["diversity"].get<double>(), 700.0 / 1100, 1e-12);
    EXPECT_NEAR(lexical(3)["diversity_per_1000"].get<double>(), 0.7, 1e-12);
    EXPECT_EQ(lexical(0)["cluster"], 1);
    EXPECT_EQ(lexical(1)["cluster"], lexical(2)["cluster"]) << "who say the same words are alike";
    EXPECT_NE(lexical(1)["cluster"], lexical(0)["cluster"]);
    EXPECT_NE(lexical(3)["cluster"], lexical(1)["cluster"]);
}

TEST(CorpusInfo, DescribesPats) {
    const fs::path pats = testing::source_dir() / "tests/fixtures/corpus/pats";
    const Json described = info_of(pats);
    EXPECT_EQ(described["kind"], "intervals");
    EXPECT_EQ(described["text_encoder"], "bert-base-uncased");
    EXPECT_EQ(described["left_out"]["without a file"], 1);
    EXPECT_EQ(described["splits"]["unseen"]["speakers"], 1);
    const Json& oliver = described["people"].at(1);
    EXPECT_EQ(oliver["speaker"], "oliver");
    // Points k of a frame lie at (k, k + 52) / 128: 1 to 31 of the joints, so that the box is 30 by 30 and
    // shoulders are sqrt(2) * 3 apart; everything moves by (1, 1) from frame to frame.
    EXPECT_NEAR(oliver["box_perimeter"]["mean"].get<double>(), 120 / (std::sqrt(2) * 3), 1e-4);
    EXPECT_NEAR(oliver["wrist_speed"]["mean"].get<double>(), 15 * 128 / 3.0, 1e-2);
    EXPECT_NEAR(oliver["words_per_minute"].get<double>(), 6 / (0.8 / 60), 1e-6);
}

TEST(CorpusInfo, RefusesWhatIsNoCorpus) {
    const Outcome outcome = run_chironomia({"corpus", "info", "/nowhere"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("/nowhere: holds no corpus"));
}

}  // namespace
}  // namespace chironomia::study
