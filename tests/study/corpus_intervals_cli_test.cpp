// chironomia corpus import of intervals: the real binary, from OpenPose, sound and words to PATS's tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/motion/picture/openpose_write.h"
#include "skinning/motion/picture/picture_camera.h"
#include "study/corpus/manifest.h"
#include "synth/corpus/corpus.h"
#include "synth/corpus/statistics.h"
#include "synth/features/spectrum.h"
#include "synth/text/dialog_acts.h"
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
using ::testing::FloatNear;
using ::testing::HasSubstr;
using testing::info_of;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

constexpr std::size_t kJoints = IntervalRecord::kJoints, kFace = IntervalRecord::kFacePoints;
constexpr double kSeconds = 14;

// Ten words of 0.4 s every half second from each of these times on. With 0.3 s of silence at its ends, brought to
// whole frames of 15 a second, such a stretch lasts 83 frames, from 10 and from 108 on.
constexpr double kStarts[] = {0.98, 0.98 + 98.0 / 15}, kSpoken = 4.9;
constexpr std::size_t kFirst = 10, kSecond = 108, kFrames = 83;

double time_of(std::size_t frame) {
    return static_cast<double>(frame) / IntervalRecord::kFps;
}

// Each point has a place and a velocity of its own; the shoulders are 160 px apart.
Vec2 place_about_neck(const std::string& name, double time) {
    if (name == "thorax") return Vec2(0);
    if (name == "right_shoulder") return Vec2(-80, 5);
    if (name == "left_shoulder") return Vec2(80, 5);
    double sum = 0;
    for (const char c : name) sum = 0.5 * sum + c;
    return Vec2(sum - 200 + (sum / 10 - 20) * time, 150 - sum + 3 * time);
}

// A person who is seen at 25 frames/s; all points move evenly, so that neither smoothing nor another rate
// changes their places.
struct PictureSpec {
    double seconds = kSeconds;
    bool has_face = false;
    std::set<std::string> lost{};                      // points that are lost
    std::size_t first_lost = 0, end_lost = 1'000'000;  // in these frames
};

Motion pictured(const PictureSpec& spec) {
    constexpr double kFps = 25;
    Motion motion{.source = "made", .fps = kFps, .joints = {}, .keypoints = {}, .notes = {}};
    motion.frames = static_cast<std::size_t>(std::lround(spec.seconds * kFps));
    PictureTrack& track = motion.picture.emplace();
    for (const KeypointLayout& layout : keypoint_layouts()) {
        if (layout.name != "BODY_25") continue;
        for (const LayoutPoint& point : layout.points) track.names.push_back(point.name());
    }
    std::vector<std::vector<std::string>> more = {openpose_hand_names("left"), openpose_hand_names("right")};
    if (spec.has_face) more.push_back(openpose_face_names());
    for (const auto& names : more) {
        for (const std::string& name : names)
            if (!name.empty()) track.names.push_back(name);
    }
    for (std::size_t t = 0; t < motion.frames; ++t) {
        const double time = static_cast<double>(t) / kFps;
        for (const std::string& name : track.names) {
            const bool is_lost = spec.lost.contains(name) && t >= spec.first_lost && t < spec.end_lost;
            track.points.push_back(Vec2(640 + 2 * time, 300 - time) + place_about_neck(name, time));
            track.confidence.push_back(is_lost ? 0 : 0.75f);
        }
    }
    return motion;
}

// What PATS calls its joints, as points of a picture are called.
std::vector<std::string> joint_names() {
    std::vector<std::string> names;
    for (const KeypointLayout& layout : picture_layouts()) {
        if (layout.name != "PATS 52") continue;
        for (const LayoutPoint& point : layout.points) names.push_back(point.name());
    }
    names[10] = "left_wrist";
    names[31] = "right_wrist";
    return names;
}

class IntervalImport : public ::testing::Test {
  protected:
    IntervalImport() {
        write_pose({});
        write_wav(file("voice.wav"), sound_);
        std::string words = "start,end,word\n";
        const std::vector<std::string> texts = {"Hello!", "Is",    "it",    "big?", "I",
                                                "think",  "house", "stood", "on",   "hills."};
        for (const double start : kStarts) {
            for (std::size_t w = 0; w < texts.size(); ++w) {
                const double from = start + 0.5 * static_cast<double>(w);
                words += format("{:.9f},{:.9f},{}\n", from, from + 0.4, texts[w]);
            }
        }
        write_text(file("words.csv"), words);
    }

    fs::path file(const std::string& name) { return folder_ / name; }
    void write_pose(const PictureSpec& spec) {
        fs::remove_all(file("pose"));
        write_openpose(file("pose"), pictured(spec));
    }

    // Another recording, in which a point is lost in another frame.
    void write_other_pose(const std::string& name, std::size_t lost = 0) {
        write_openpose(file(name), pictured({.lost = {"nose"}, .first_lost = lost, .end_lost = lost + 1}));
    }

    static Json recording() {
        return {{"id", "r1"}, {"speaker", "anna"},    {"pose", "pose"},
                {"fps", 25},  {"audio", "voice.wav"}, {"words", "words.csv"}};
    }
    static Json with(const std::string& key, const Json& value) {
        Json changed = recording();
        if (value.is_null())
            changed.erase(key);
        else
            changed[key] = value;
        return changed;
    }
    Outcome import_all(const std::vector<Json>& recordings, const Json& limits = Json::object(),
                       const std::string& out = "out") {
        fs::remove_all(file(out));
        write_json(file("m.json"), {{"kind", "intervals"}, {"limits", limits}, {"recordings", recordings}});
        return run_chironomia(
            {"corpus", "import", file("m.json").string(), "--out", file(out).string(), "--quiet"});
    }
    // What a manifest that must be refused as wrong input says.
    std::string refusal(const Json& recording, const Json& limits = Json::object()) {
        const Outcome outcome = import_all({recording}, limits);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
        EXPECT_FALSE(fs::exists(file("out")));
        return outcome.err;
    }
    std::vector<IntervalRecord> imported(const Json& recording, const Json& limits = Json::object()) {
        const Outcome made = import_all({recording}, limits);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        if (made.exit_code != 0) return {};
        const CorpusIndex corpus = read_corpus_index(file("out"));
        std::vector<IntervalRecord> records;
        for (const CorpusEntry& entry : corpus.entries) records.push_back(read_interval(corpus, entry));
        return records;
    }

    // A tone while somebody speaks.
    const Audio sound_ = testing::sound_of(kSeconds, 22050, [](double time) {
        const bool speaks = std::any_of(std::begin(kStarts), std::end(kStarts), [time](double start) {
            return time >= start && time < start + kSpoken;
        });
        return speaks ? 0.5 * testing::sine(1000 * time) : 0;
    });
    TemporaryFolder folder_;
};

// Calls `check` for x and y of each point of a frame: the place in the arrays, and what is expected there.
void for_points(const std::vector<std::string>& names, std::size_t t, double time,
                const std::function<void(std::size_t, double)>& check) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        const Vec2 place = place_about_neck(names[k], time);
        check(t * 2 * names.size() + k, static_cast<double>(place.x));
        check(t * 2 * names.size() + names.size() + k, static_cast<double>(place.y));
    }
}

TEST_F(IntervalImport, CutsSpeechBetweenSilences) {
    const Outcome made = import_all({recording()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("out\n2 intervals, 0.2 min: 2 train, 0 validation, 0 test, 0 unseen\n"));
    EXPECT_THAT(made.err, HasSubstr("r1: OpenPose: BODY_25, 350 frames\n"));
    const CorpusIndex corpus = read_corpus_index(file("out"));
    ASSERT_EQ(corpus.entries.size(), 2u);
    EXPECT_EQ(corpus.entries[1].id, "r1_0001");
    EXPECT_EQ(corpus.entries[1].seconds, time_of(kFrames));
    const IntervalRecord interval = read_interval(corpus, corpus.entries[1]);
    EXPECT_EQ(interval.speaker, "anna");
    ASSERT_EQ(interval.frames(), kFrames);
    ASSERT_EQ(interval.words.size(), 10u);
    EXPECT_EQ(interval.words[3].text, "big");
    for (std::size_t w = 0; w < 10; ++w) {
        const double start = kStarts[1] + 0.5 * static_cast<double>(w) - time_of(kSecond);
        EXPECT_NEAR(interval.words[w].start, start, 1e-6);
        EXPECT_NEAR(interval.words[w].end, start + 0.4, 1e-6);
    }
    EXPECT_EQ(corpus.entries[1].recording, "r1");
    EXPECT_EQ(corpus.entries[1].start, time_of(kSecond));  // 7.2 s
    EXPECT_THAT(read_text(file("out/data/cmu_intervals_df.csv")),
                HasSubstr(",0 days 00:00:12.733333,r1_0001,anna,0 days 00:00:07.200000,r1,\n"));
}

TEST_F(IntervalImport, PutsJointsWhereTheyAreFromTheNeck) {
    const std::vector<IntervalRecord> records = imported(recording());
    ASSERT_EQ(records.size(), 2u);
    const std::vector<std::string> names = joint_names();
    for (std::size_t i = 0; i < 2; ++i) {
        const IntervalRecord& record = records[i];
        EXPECT_THAT(record.pose_confidence, Each(FloatNear(0.75f, 1e-6f)));
        EXPECT_THAT(record.face, IsEmpty());
        for (std::size_t t = 0; t < kFrames; ++t) {
            for_points(names, t, time_of((i == 0 ? kFirst : kSecond) + t), [&](std::size_t at, double place) {
                ASSERT_NEAR(record.pose[at], place, 2e-3) << names[at % kJoints] << " in frame " << t;
                // The shoulders are 160 px apart.
                ASSERT_NEAR(record.pose_normalized[at], place * 100 / 160, 2e-3);
            });
        }
    }
}

TEST_F(IntervalImport, BridgesWhatWasLostAndSaysSo) {
    // The frames 50 to 54 of 25 a second: 2 to 2.2 s.
    write_pose({.lost = {"right_wrist", "nose"}, .first_lost = 50, .end_lost = 55});
    const Outcome made = import_all({recording()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    // So the frames 30 to 32 of 15 a second have a neighbour without a wrist.
    EXPECT_THAT(made.err, HasSubstr("\n3 of 166 frames were bridged\n"));
    const CorpusIndex corpus = read_corpus_index(file("out"));
    const IntervalRecord record = read_interval(corpus, corpus.entries[0]);
    for (std::size_t t = 0; t < kFrames; ++t) {
        const double time = time_of(kFirst + t);
        const bool is_lost = time > 49.01 / 25 && time < 54.99 / 25;
        for (const std::size_t joint : {3u, 7u, 31u}) {  // wrist, nose, root of the hand
            for (const std::size_t axis : {std::size_t{0}, kJoints})
                EXPECT_EQ(record.pose_confidence[t * 2 * kJoints + axis + joint] == 0, is_lost) << time;
        }
        EXPECT_GT(record.pose_confidence[t * 2 * kJoints + 2], 0);
        const double x = static_cast<double>(place_about_neck("right_wrist", time).x);
        // Beside lost frames the median has one neighbour, and lags by half a frame of up to 1 px.
        EXPECT_NEAR(record.pose[t * 2 * kJoints + 3], x, 0.5);
    }
}

TEST_F(IntervalImport, TakesTheMiddleOfTheShouldersWhereThereIsNoNeck) {
    write_pose({.lost = {"thorax"}});
    const std::vector<IntervalRecord> records = imported(recording());
    ASSERT_EQ(records.size(), 2u);
    EXPECT_NEAR(records[0].pose[0], 0, 1e-4);
    EXPECT_NEAR(records[0].pose[1], -80, 1e-3);          // x of the right shoulder
    EXPECT_NEAR(records[0].pose[kJoints + 1], 0, 1e-3);  // y, which is 5 px below the neck
}

TEST_F(IntervalImport, HoldsFacesWhereThereAreSome) {
    write_pose({.has_face = true});
    const std::vector<IntervalRecord> records = imported(recording());
    ASSERT_EQ(records.size(), 2u);
    ASSERT_EQ(records[1].face.size(), kFrames * 2 * kFace);
    for (const std::size_t t : {0u, 40u, 82u}) {
        for_points(openpose_face_names(), t, time_of(kSecond + t), [&](std::size_t at, double place) {
            ASSERT_NEAR(records[1].face[at], place, 2e-3);
            ASSERT_NEAR(records[1].face_normalized[at], place * 100 / 160, 2e-3);
        });
    }
    EXPECT_TRUE(read_statistics(read_corpus_index(file("out"))).scales.contains("face/data"));
    EXPECT_THAT(imported(with("face", false)).at(0).face, IsEmpty());
    EXPECT_EQ(imported(with("face", true)).at(0).face.size(), kFrames * 2 * kFace);
}

TEST_F(IntervalImport, MeasuresTheSoundOfEachInterval) {
    const std::vector<IntervalRecord> records = imported(recording());
    ASSERT_EQ(records.size(), 2u);

    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t first = i == 0 ? kFirst : kSecond;
        Audio part = sound_;
        part.samples = {sound_.samples.begin() + std::lround(time_of(first) * 22050),
                        sound_.samples.begin() + std::lround(time_of(first + kFrames) * 22050)};
        const IntervalSpectra expected = interval_spectra(part);
        ASSERT_EQ(records[i].mel_400.size(), expected.mel_400.size());
        ASSERT_EQ(records[i].mel_512.size(), expected.mel_512.size());
        for (std::size_t k = 0; k < expected.mel_400.size(); ++k)
            ASSERT_NEAR(records[i].mel_400[k], expected.mel_400[k], 0.01) << k;  // of 16 bits
        for (std::size_t k = 0; k < expected.mel_512.size(); ++k)
            ASSERT_NEAR(records[i].mel_512[k], expected.mel_512[k], 0.02) << k;
    }
    // Speech begins 0.313 s behind the second interval; a row every 10 ms looks 32 ms ahead.
    const auto loudest = [&](std::size_t row) {
        const float* first = &records[1].mel_400[row * IntervalRecord::kMel400];
        return *std::max_element(first, first + IntervalRecord::kMel400);
    };
    EXPECT_LT(loudest(26), loudest(31) - 3);
    EXPECT_NEAR(loudest(31), loudest(200), 0.5);
}

TEST_F(IntervalImport, SaysWhichSpectraASoundLeavesEmpty) {
    testing::write_voice(file("voice.wav"), kSeconds);
    EXPECT_THAT(import_all({recording()}).err,
                HasSubstr("r1: sound: 16000 samples/s, so spectra have nothing above "
                          "8000 Hz; give the same rate of all recordings\n"));
}

TEST_F(IntervalImport, HoldsTheWordOfEachFrame) {
    const IntervalRecord record = imported(recording()).at(0);
    const TextEncoder encoder = hashbert_encoder();
    const std::vector<float> vectors = encoder.vectors({texts_in(record.words)}).at(0);

    const auto act_named = [](std::string_view name) {
        return static_cast<std::size_t>(std::find(kDialogActNames.begin(), kDialogActNames.end(), name) -
                                        kDialogActNames.begin());
    };
    for (std::size_t t = 0; t < kFrames; ++t) {
        const double place = (time_of(kFirst + t) - kStarts[0]) / 0.5;
        const auto word = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, 9.0));
        const bool is_said = place >= 0 && place - static_cast<double>(word) < 0.8;
        EXPECT_EQ(record.silence[t], is_said ? 0 : 1) << t;
        EXPECT_EQ(record.tokens[t], is_said ? encoder.token(record.words[word].text) : 0);
        for (std::size_t i = 0; i < kWordVector; i += 97) {
            EXPECT_NEAR(record.vectors[t * kWordVector + i], is_said ? vectors[word * kWordVector + i] : 0,
                        3e-3);
        }
        const char* act = word == 0  ? "Conventional-opening"
                          : word < 4 ? "Yes-No-Question"
                                     : "Statement-opinion";
        for (std::size_t a = 0; a < IntervalRecord::kDialogActs; ++a)
            EXPECT_EQ(record.dialog_acts[t * IntervalRecord::kDialogActs + a], a == act_named(act) ? 1 : 0);
    }
    write_text(file("words.csv"), "start,end,word\n1,3,bonjour!\n3,5.9,oui\n");
    const Outcome french = import_all({with("language", "fr")});
    ASSERT_EQ(french.exit_code, 0) << french.err;
    EXPECT_THAT(french.err, HasSubstr("r1: language \"fr\": dialog acts are found in English alone\n"));
    const CorpusIndex corpus = read_corpus_index(file("out"));
    EXPECT_THAT(read_interval(corpus, corpus.entries.at(0)).dialog_acts, IsEmpty());
}

TEST_F(IntervalImport, TakesAPartOfARecording) {
    Json part = with("start", 6.5);
    part["end"] = 13;
    std::vector<IntervalRecord> records = imported(part);
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0].id, "r1_0000");
    ASSERT_EQ(records[0].frames(), kFrames);
    EXPECT_NEAR(records[0].words[0].start, kStarts[1] - time_of(kSecond), 1e-6);
    const Vec2 nose = place_about_neck("nose", time_of(kSecond));
    EXPECT_NEAR(records[0].pose[7], nose.x, 2e-3);
    // The tenth word begins at 12.01 s.
    part["end"] = 12.1;
    records = imported(part);
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0].words.size(), 9u);
    // A pose that is too short is no fault before it ends.
    write_pose({.seconds = 6.5});
    EXPECT_EQ(imported(with("end", 6.4)).size(), 1u);
}

TEST_F(IntervalImport, CutsLongStretchesInTwo) {
    const std::vector<IntervalRecord> records =
        imported(recording(), {{"least_seconds", 1}, {"most_seconds", 3}, {"most_edge_seconds", 0}});
    ASSERT_EQ(records.size(), 4u);
    // All silences last 0.1 s; the sixth word, which begins at 3.48 s, is nearest to the middle, 3.43 s.
    EXPECT_EQ(records[0].words.size(), 5u);
    EXPECT_EQ(records[1].words.size(), 5u);
    EXPECT_EQ(records[1].words[0].text, "think");
    EXPECT_NEAR(records[1].words[0].start, 3.48 - time_of(52), 1e-6);
    EXPECT_EQ(imported(recording(), {{"most_pause_seconds", 2}}).size(), 1u);
}

TEST_F(IntervalImport, SplitsBySpeakersUnlessSplitsAreGiven) {
    std::vector<Json> recordings;
    for (const char* who : {"anna", "ben", "cleo", "dora", "emil"}) {
        recordings.push_back(with("speaker", who));
        recordings.back()["id"] = recordings.back()["pose"] = who;
        write_other_pose(who, recordings.size());
    }
    const Outcome made = import_all(recordings);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("10 intervals, 0.9 min: 6 train, 1 validation, 1 test, 2 unseen\n"));
    CorpusIndex corpus = read_corpus_index(file("out"));
    ASSERT_EQ(corpus.of(Split::unseen).size(), 2u);
    EXPECT_EQ(corpus.of(Split::unseen)[0].speaker, corpus.of(Split::unseen)[1].speaker);
    recordings.resize(2);
    recordings[0]["split"] = "unseen";
    recordings[1]["split"] = "train";
    ASSERT_EQ(import_all(recordings).exit_code, 0);
    corpus = read_corpus_index(file("out"));
    ASSERT_EQ(corpus.of(Split::unseen).size(), 2u);
    EXPECT_EQ(corpus.of(Split::unseen)[0].speaker, "anna");
    EXPECT_EQ(corpus.of(Split::train).size(), 2u);
}

TEST_F(IntervalImport, GivesTheSameBytes) {
    Json second = with("id", "r2");
    second["pose"] = "other";
    write_other_pose("other");
    ASSERT_EQ(import_all({recording(), second}, Json::object(), "a").exit_code, 0);
    ASSERT_EQ(import_all({recording(), second}, Json::object(), "b").exit_code, 0);
    for (const char* name : {"corpus.json", "statistics.json", "data/cmu_intervals_df.csv",
                             "data/processed/anna/r1_0000.h5", "data/processed/anna/r2_0001.h5"})
        EXPECT_EQ(read_bytes(file("a") / name), read_bytes(file("b") / name)) << name;
}

TEST_F(IntervalImport, IsDescribedWithItsSpeakers) {
    ASSERT_EQ(import_all({recording()}).exit_code, 0);
    const Json described = info_of(file("out"));
    EXPECT_EQ(described["kind"], "intervals");
    EXPECT_EQ(described["splits"]["train"]["records"], 2);
    const Json& anna = described["people"].at(0);
    EXPECT_NEAR(anna["words_per_minute"].get<double>(), 20 / (2 * time_of(kFrames) / 60), 1e-6);
    double speed = 0;
    for (const char* wrist : {"left_wrist", "right_wrist"})
        speed += distance(place_about_neck(wrist, 1), place_about_neck(wrist, 0)) / 160.0 / 2;
    EXPECT_NEAR(anna["wrist_speed"]["mean"].get<double>(), speed, 1e-3);
}

// A talk that the engine speaks and gestures, seen by a camera of its own.
TEST_F(IntervalImport, TakesWhatTheEngineDid) {
    const Outcome spoken = run_chironomia(
        {"synth", "--text",
         "There are two ways to see this. The first one is large, and the second one is small. I think both "
         "of them are good, and we should try them now.",
         "--out", file("m.h5").string(), "--speech-out", file("s.wav").string(), "--score-out",
         file("score.json").string()});
    ASSERT_EQ(spoken.exit_code, 0) << spoken.err;
    const Json words = read_json(file("score.json"))["words"];
    write_json(file("words.json"), words);
    const Outcome seen = run_chironomia({"convert", "--motion", file("m.h5").string(), "--out",
                                         file("seen").string(), "--camera", "weak", "--distance", "4"});
    ASSERT_EQ(seen.exit_code, 0) << seen.err;
    const Motion motion = read_motion(file("m.h5"));
    Json recording = with("pose", "seen");
    recording["fps"] = motion.fps;
    recording["audio"] = "s.wav";
    recording["words"] = "words.json";
    const std::vector<IntervalRecord> records = imported(recording);
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0].words.size(), words.size());
    // From 0.3 s before the first word on.
    const auto first = static_cast<std::size_t>((words[0]["start"].get<double>() - 0.3) * 15);
    EXPECT_NEAR(records[0].words[2].start, words[2]["start"].get<double>() - time_of(first), 1e-6);
    const Motion projected = project(motion, {.distance = 4, .perspective = false});
    const PictureTrack& track = *projected.picture;
    const auto place = [&](const std::string& name, std::size_t frame) {
        const auto found = std::find(track.names.begin(), track.names.end(), name);
        return track.points.at(frame * track.names.size() +
                               static_cast<std::size_t>(found - track.names.begin()));
    };
    const std::vector<std::string> names = joint_names();
    ASSERT_EQ(motion.fps, 30) << "every second frame is taken";
    for (std::size_t t = 0; t < records[0].frames(); ++t) {
        const std::size_t frame = 2 * (first + t);
        for (std::size_t k = 0; k < kJoints; ++k) {
            const Vec2 expected = place(names[k], frame) - place("thorax", frame);
            const std::size_t at = t * 2 * kJoints + k;
            const Vec2 found(records[0].pose[at], records[0].pose[at + kJoints]);
            ASSERT_LT(distance(found, expected), 1) << names[k] << " in frame " << t;
        }
    }
    EXPECT_EQ(info_of(file("out"))["records"], 1);
}

// As recordings of motion capture are; the same as of the folder that `convert` makes of them.
TEST_F(IntervalImport, SeesABodyInSpaceByACamera) {
    const fs::path samples = testing::source_dir() / "assets/samples";
    const std::string bvh = (samples / "expressive/two-ways.bvh").string();
    Json captured = {{"id", "r1"},
                     {"speaker", "anna"},
                     {"pose", bvh},
                     {"audio", (samples / "speech/two-ways.wav").string()},
                     {"words", (samples / "speech/two-ways.words.csv").string()}};
    const std::vector<IntervalRecord> direct = imported(captured);
    ASSERT_FALSE(direct.empty());
    EXPECT_THAT(import_all({captured}).err, HasSubstr("r1: camera: pinhole, 1280 x 720 px"));
    ASSERT_EQ(run_chironomia({"convert", "--motion", bvh, "--out", file("seen").string()}).exit_code, 0);
    captured["pose"] = "seen";
    captured["fps"] = read_motion(bvh).fps;
    const std::vector<IntervalRecord> seen = imported(captured);
    ASSERT_EQ(seen.size(), direct.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        EXPECT_THAT(direct[i].pose, ::testing::Pointwise(FloatNear(0.01f), seen[i].pose));
        EXPECT_THAT(direct[i].pose_confidence, Each(1.0f));
    }
}

TEST_F(IntervalImport, TakesPointsOfAPictureInOtherForms) {
    const Outcome converted = run_chironomia({"convert", "--motion", file("pose").string(), "--motion-fps",
                                              "25", "--out", file("pose.h5").string()});
    ASSERT_EQ(converted.exit_code, 0) << converted.err;
    const std::vector<IntervalRecord> folder = imported(recording());
    Json file_of_ours = with("pose", "pose.h5");
    file_of_ours.erase("fps");
    const std::vector<IntervalRecord> records = imported(file_of_ours);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[1].pose, folder.at(1).pose);
    // Its own intervals are poses of PATS.
    fs::copy(file("out/data/processed/anna/r1_0000.h5"), file("interval.h5"));
    Json again = with("pose", "interval.h5");
    again.erase("fps");
    again["end"] = 5;
    write_text(file("words.csv"), "start,end,word\n0.4,4.9,hello\n");
    const std::vector<IntervalRecord> repeated = imported(again);
    ASSERT_EQ(repeated.size(), 1u);
    EXPECT_NEAR(repeated[0].pose[7], records[0].pose[2 * kJoints + 7], 0.02) << "a frame later";
}

TEST_F(IntervalImport, RefusesABrokenManifestWithItsKey) {
    EXPECT_THAT(refusal(with("pose", Json())), HasSubstr("m.json: recordings[0].pose: is missing; add it"));
    EXPECT_THAT(refusal(with("audio", Json())), HasSubstr("recordings[0].audio: is missing; add it"));
    EXPECT_THAT(refusal(with("words", Json())), HasSubstr("recordings[0].words: is missing; add it"));
    EXPECT_THAT(refusal(with("poses", "pose")),
                HasSubstr("recordings[0].poses: there is no such key; did you mean \"pose\"?"));
    EXPECT_THAT(refusal(with("fps", Json())),
                HasSubstr("m.json: recordings[0]: OpenPose does not write the frame rate; give that of the "
                          "video as \"fps\""));
    EXPECT_THAT(refusal(with("fps", 0)), HasSubstr("recordings[0].fps: is 0, a number from 1 to 1000"));
    EXPECT_THAT(refusal(with("pose", "nowhere")),
                AllOf(HasSubstr("recordings[0].pose: "),
                      HasSubstr("nowhere is neither a file nor a folder with files \"..._keypoints.json\"")));
    EXPECT_THAT(refusal(with("end", 0)), HasSubstr("recordings[0].end: is 0 s, and the part starts at 0 s"));
    EXPECT_THAT(refusal(with("face", 1)), HasSubstr("recordings[0].face: is 1, true or false is needed"));
    const Outcome twice = import_all({recording(), recording()});
    EXPECT_EQ(twice.exit_code, 3);
    EXPECT_THAT(twice.err, HasSubstr("recordings[1].id: \"r1\" comes twice"));
    const Outcome half = import_all({recording(), with("split", "train")});
    EXPECT_EQ(half.exit_code, 3);
    write_json(file("m.json"), {{"kind", "intervalls"}, {"recordings", {recording()}}});
    const Outcome kind =
        run_chironomia({"corpus", "import", file("m.json").string(), "--out", file("out").string()});
    EXPECT_THAT(kind.err, HasSubstr("intervals"));
    EXPECT_EQ(kind.exit_code, 3);
}

TEST_F(IntervalImport, RefusesLimitsThatCannotBe) {
    EXPECT_THAT(refusal(recording(), {{"least_sure", 1}}),
                HasSubstr("limits.least_sure: there is no such key; did you mean \"least_seen\"?"));
    EXPECT_THAT(refusal(recording(), {{"least_seen", 2}}),
                HasSubstr("limits.least_seen: is 2, a number from 0 to 1 is needed"));
    EXPECT_THAT(refusal(recording(), {{"median_frames", 4}}),
                HasSubstr("limits.median_frames: is 4; a median of as many frames before as behind is odd, "
                          "such as 5"));
    EXPECT_THAT(
        refusal(recording(), {{"most_seconds", 6}}),
        HasSubstr("limits: most_seconds is 6 and least_seconds 4.5; what is longer than the one is cut "
                  "in two, neither shorter than the other, so set it to 9 or more"));
}

TEST_F(IntervalImport, RefusesPosesThatAreNone) {
    testing::write_openface(file("face.csv"), {});
    EXPECT_THAT(refusal(with("pose", "face.csv")),
                HasSubstr("face.csv: it holds neither points of a picture nor a body in space"));
    write_text(
        file("few.json"),
        R"({"fps": 25, "names": ["neck", "left_shoulder", "right_shoulder", "left_elbow", "right_elbow",
                   "left_wrist", "right_wrist", "nose"], "frames": [[[9, 9], [20, 9], [3, 9], [20, 30], [3, 30],
                   [20, 50], [3, 50], [300, 200]]]})");
    EXPECT_THAT(
        refusal(with("pose", "few.json")),
        HasSubstr("few.json: it has no right_eye, left_eye, which intervals need; let the tracker find "
                  "the whole upper body"));
    write_pose({.lost = {"thorax", "left_shoulder"}});
    EXPECT_THAT(
        refusal(recording()),
        HasSubstr("pose: from 0.00 to 14.00 s neither the neck nor both shoulders are seen in any frame"));
    write_pose({.lost = {"left_shoulder"}});
    EXPECT_THAT(refusal(recording()),
                HasSubstr("pose: from 0.00 to 14.00 s no frame shows the shoulders apart"));
    write_pose({});
    EXPECT_THAT(refusal(with("face", true)),
                HasSubstr("no face of 70 points is seen, and \"face\" is true; run OpenPose with --face"));
}

TEST_F(IntervalImport, RefusesAPoseThatDoesNotLastAsLongAsTheSound) {
    write_pose({.seconds = 10});
    EXPECT_THAT(
        refusal(recording()),
        HasSubstr("m.json: recording \"r1\": its pose lasts 10.00 s (250 frames at 25 frames/s) and its "
                  "sound 14.00 s, 4.00 s more; correct \"fps\""));
    EXPECT_THAT(
        refusal(with("fps", 15)),
        HasSubstr("its pose lasts 16.67 s (250 frames at 15 frames/s) and its sound 14.00 s, 2.67 s less"));
    EXPECT_THAT(
        refusal(with("end", 12)),
        HasSubstr("m.json: recording \"r1\": the part from 0 to 12 s is taken, but its pose lasts 10.00 "
                  "s and its sound 14.00 s; take what both have"));
    write_pose({});
    EXPECT_THAT(refusal(with("start", 15)), HasSubstr("the part from 15 to 14 s is taken"));
}

TEST_F(IntervalImport, RefusesAPoseWhoseFirstFramesAreNotThere) {
    for (int number = 0; number < 15; ++number)
        fs::remove(file("pose") / format("pose_{:012}_keypoints.json", number));
    EXPECT_THAT(
        refusal(recording()),
        HasSubstr(
            "pose: its first frame is at 0.60 s and its last one at 14.00 s, where the sound of 14.00 s "
            "ends; taken from second 0 on all would come 0.60 s too early"));
}

TEST_F(IntervalImport, SaysThatPoseAndSoundEndAtDifferentTimes) {
    const std::string note =
        "the pose lasts 14.58 s and its sound 14.00 s; what is over at the end is cut off";
    EXPECT_THAT(import_all({with("fps", 24)}).err, HasSubstr("r1: " + note));
    EXPECT_THAT(import_all({recording()}).err, Not(HasSubstr("what is over")));
}

TEST_F(IntervalImport, SaysThatWordsLieInSilence) {
    EXPECT_THAT(import_all({recording()}).err, Not(HasSubstr("silent")));
    write_wav(file("muted.wav"), testing::sound_of(kSeconds, 22050, [](double) { return 0.0; }));
    const Outcome muted = import_all({with("audio", "muted.wav")});
    EXPECT_EQ(muted.exit_code, 0);
    EXPECT_THAT(muted.err, AllOf(HasSubstr("r1: "), HasSubstr("words.csv: 20 of 20 words lie where "),
                                 HasSubstr("muted.wav is silent, the first is \"Hello\" at "),
                                 HasSubstr(" s; are its times those of this sound?\n")));
}

TEST_F(IntervalImport, TakesNoPartOfARecordingTwice) {
    Json first = with("end", 7), second = with("start", 6.9);
    second["id"] = "r2";
    second["speaker"] = "ben";
    const Outcome twice = import_all({first, second});
    EXPECT_EQ(twice.exit_code, 3);
    EXPECT_THAT(twice.err, HasSubstr("pose is of \"r1\" already; take no part of a recording twice"));
    second["start"] = 7;
    EXPECT_EQ(import_all({first, second}).exit_code, 0) << "these are two parts";
    fs::copy(file("pose"), file("copy"));
    second["pose"] = "copy";
    EXPECT_EQ(import_all({first, second}).exit_code, 0) << "these are two parts";
    second["start"] = 6.9;
    EXPECT_THAT(import_all({first, second}).err, HasSubstr("recordings[1].pose: " + file("copy").string() +
                                                           " is of \"r1\" already: it has the bytes of " +
                                                           file("pose").string() + "; take no part"));
}

TEST_F(IntervalImport, NeedsNoSoundForWordsBehindItsEnd) {
    const std::string words = read_text(file("words.csv"));
    write_text(file("words.csv"), words + "13.7,14.2,late\n14.3,14.5,later\n");
    EXPECT_THAT(refusal(recording()),
                HasSubstr("\"late\" lies from 13.700 to 14.200 s, and the sound ends at"));
    EXPECT_THAT(refusal(with("end", 13.8)), HasSubstr("\"late\" lies from 13.700 to 14.200 s"));
    const Outcome cut = import_all({with("end", 13)});
    ASSERT_EQ(cut.exit_code, 0) << cut.err;
    EXPECT_THAT(cut.out, HasSubstr("2 intervals"));
    EXPECT_THAT(cut.err,
                HasSubstr("words.csv: 2 words from 13.700 s on lie behind \"end\", 13 s, and the sound of "
                          "14.000 s; left out"));
}

TEST_F(IntervalImport, LeavesNothingBehindIfTheLastRecordingIsBroken) {
    Json second = with("words", "broken.csv");
    second["id"] = "r2";
    second["pose"] = "other";
    write_other_pose("other");
    write_text(file("broken.csv"), "start,end,word\n3,2,back\n");
    const Outcome outcome = import_all({recording(), second});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("broken.csv: "));
    EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(IntervalImport, SaysWhyNothingIsLeft) {
    const auto reason = [&](const Json& limits) { return refusal(recording(), limits); };
    EXPECT_THAT(reason({{"least_seconds", 6}}), AllOf(HasSubstr("m.json: nothing is left to learn from: "),
                                                      HasSubstr("left out: intervals under 6 s: 2")));
    EXPECT_THAT(reason({{"least_words", 11}}), HasSubstr("left out: intervals under 11 words: 2"));
    EXPECT_THAT(reason({{"least_confidence", 0.8}}), HasSubstr("neither the neck nor both shoulders"));
    write_pose({.lost = {"left_wrist"}, .first_lost = 60});
    EXPECT_THAT(refusal(recording()),
                HasSubstr("left out: intervals with the left wrist in under 50 % of the frames: 2"));
    write_text(file("words.csv"), "start,end,word\n1,13,endless\n");
    EXPECT_THAT(reason({{"least_seconds", 1}, {"most_seconds", 5}}),
                HasSubstr("left out: stretches over 5 s without a place to cut: 1"));
    EXPECT_THAT(refusal(with("start", 2)), HasSubstr("left out: recordings without a whole word: 1"));
    write_text(file("words.csv"), "start,end,word\n13,15,late\n");
    EXPECT_THAT(refusal(recording()), HasSubstr("words.csv: "));
}

}  // namespace
}  // namespace chironomia::study
