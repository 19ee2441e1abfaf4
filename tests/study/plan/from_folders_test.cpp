// A plan from the folders of systems and a table of segments, through the real binary: SMPL-X motions as GENEA's
// leaderboard gets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

using Words = std::vector<std::string>;

// Two systems with motions of 4 s, a folder of sounds, and a table.
class PlanFromFolders : public ::testing::Test {
  protected:
    PlanFromFolders() {
        for (const char* name : {"1_wayne_0_1_1", "2_scott_0_1_1"}) {
            write_motion(format("ours/{}.npz", name), 4);
            write_motion(format("base/{}.npz", name), 4);
            write_sound(name);
        }
        write_table("1_wayne_0_1_1.wav,0.5,1.5,1.0\n2_scott_0_1_1.wav,0,2,2\n2_scott_0_1_1.wav,2,4,2\n");
    }

    void write_motion(const std::string& name, int seconds) const {
        const auto frames = static_cast<std::size_t>(30 * seconds);
        fs::create_directories((folder_ / name).parent_path());
        testing::write_npz(folder_ / name, {{"poses", {frames, 165}, std::vector<double>(frames * 165, 0.0)},
                                            {"trans", {frames, 3}, std::vector<double>(frames * 3, 0.0)},
                                            {"mocap_frame_rate", {}, {30}}});
    }
    void write_sound(const std::string& name) const {
        fs::create_directories(folder_ / "wav");
        fs::copy_file(testing::source_dir() / "assets/samples/speech/two-ways.wav",
                      folder_ / "wav" / (name + ".wav"));
    }
    void write_table(const std::string& rows) const {
        write_text(folder_ / "segments.csv", "file_name,start_seconds,end_seconds,duration_seconds\n" + rows);
    }

    Outcome plan(const Words& more = {}) const {
        Words words = {"study",   "plan",    "--from-folders", "ours=" + in("ours"), "baseline=" + in("base"),
                       "--audio", in("wav"), "--segments",     in("segments.csv")};
        words.insert(words.end(), more.begin(), more.end());
        if (std::find(more.begin(), more.end(), "--preset") == more.end())
            words.insert(words.end(), {"--preset", "realism-2025"});
        return run_chironomia(words);
    }
    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    TemporaryFolder folder_;
};

TEST_F(PlanFromFolders, HasAClipForEachSegment) {
    const Outcome made = plan({"--out", in("plan.json"), "--seed", "3"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr(in("plan.json") + "\n3 of 3 segments are clips; all match\n"));
    EXPECT_THAT(made.out, HasSubstr("conditions    ours, baseline"));
    const Json plan = read_json(folder_ / "plan.json");
    EXPECT_EQ(plan["preset"], "realism-2025");
    EXPECT_EQ(plan["conditions"], Json({"ours", "baseline"}));
    ASSERT_EQ(plan["clips"].size(), 3u);
    const Json& clip = plan["clips"][2];
    EXPECT_EQ(clip["id"], "2_scott_0_1_1_60-120");
    EXPECT_EQ(clip["speaker"], "scott");
    EXPECT_EQ(clip["cut"], Json({2.0, 4.0}));
    EXPECT_EQ(clip["audio"], "wav/2_scott_0_1_1.wav");
    EXPECT_EQ(clip["motion"],
              Json({{"ours", "ours/2_scott_0_1_1.npz"}, {"baseline", "base/2_scott_0_1_1.npz"}}));
}

// GENEA 2023 calls the two "main-agent" and "interloctr".
TEST_F(PlanFromFolders, PutsPartnersIntoTheClips) {
    for (const char* name : {"tst_0_main-agent", "tst_1_main-agent"}) {
        for (const char* system : {"ours", "base"}) write_motion(format("{}/{}.npz", system, name), 4);
        write_sound(name);
    }
    for (const char* name : {"tst_0_interloctr", "1_wayne_0_1_1", "eve"}) {
        write_motion(format("partner/{}.npz", name), 4);
        fs::create_directories(folder_ / "partner_wav");
        fs::copy_file(testing::source_dir() / "assets/samples/speech/simple-idea.wav",
                      folder_ / format("partner_wav/{}.wav", name));
    }
    testing::write_npz(folder_ / "partner/eve.npz", {{"poses", {60, 165}, std::vector<double>(60 * 165, 0.0)},
                                                     {"trans", {60, 3}, std::vector<double>(60 * 3, 0.0)}});
    write_text(folder_ / "segments.csv",
               "file_name,partner_file_name,start_seconds,end_seconds,speaker\n"
               "tst_0_main-agent.wav,,0,1,a\n1_wayne_0_1_1,,1,2,a\n2_scott_0_1_1,eve.wav,0.5,1.5,a\n");
    const Words partners = {"--partner",       in("partner"),  "--partner-audio",
                            in("partner_wav"), "--motion-fps", "20"};
    Words more = partners;
    more.insert(more.end(), {"--out", in("plan.json"), "--preset", "genea-2023-interlocutor"});
    const Outcome lacking = plan(more);
    EXPECT_EQ(lacking.exit_code, 1);
    EXPECT_THAT(lacking.err, HasSubstr("ours: no segment names tst_1_main-agent\n"));
    const Json clips = read_json(folder_ / "plan.json")["clips"];
    ASSERT_EQ(clips.size(), 3u);
    EXPECT_EQ(clips[0]["partner"], Json({{"motion", "partner/tst_0_interloctr.npz"},
                                         {"audio", "partner_wav/tst_0_interloctr.wav"}}));
    EXPECT_EQ(clips[1]["partner"]["motion"], "partner/1_wayne_0_1_1.npz");
    EXPECT_EQ(
        clips[2]["partner"],
        Json({{"motion", "partner/eve.npz"}, {"hints", {{"fps", 20.0}}}, {"audio", "partner_wav/eve.wav"}}));
    EXPECT_EQ(read_json(folder_ / "plan.json").contains("hints"), false);

    write_table("tst_1_main-agent,0,1,1\n1_wayne_0_1_1,0,1,1\n");
    const Outcome missing = plan(partners);
    EXPECT_THAT(missing.err,
                HasSubstr(":2: tst_1_main-agent_0-30: tst_1_interloctr is not among the motions of the "
                          "partners\n"));
    EXPECT_THAT(missing.err, HasSubstr("tst_1_interloctr is not among the sounds of the partners\n"));
    EXPECT_THAT(missing.err, HasSubstr(in("partner") + ": no segment names eve, tst_0_interloctr\n"));
    EXPECT_EQ(Json::parse(missing.out)["clips"].size(), 1u);
    const Outcome alone = plan({"--partner-audio", in("partner_wav")});
    EXPECT_EQ(alone.exit_code, 2);
    EXPECT_THAT(alone.err, HasSubstr("--partner-audio requires --partner"));
}

// A study whose agents move as in another segment, beside the partner of this one.
TEST_F(PlanFromFolders, BecomesAStudyOfWhoRespondsToThePartner) {
    for (const char* name : {"1_wayne_0_1_1", "2_scott_0_1_1"})
        write_motion(format("partner/{}.npz", name), 4);
    write_text(folder_ / "segments.csv",
               "file_name,start_seconds,end_seconds,speaker\n1_wayne_0_1_1,0,0.2,a\n2_scott_0_1_1,3,3.2,a\n");
    ASSERT_EQ(
        plan({"--partner", in("partner"), "--out", in("plan.json"), "--preset", "genea-2023-interlocutor"})
            .exit_code,
        0);
    Json written = read_json(folder_ / "plan.json");
    written["render"] = {{"size", {64, 36}}, {"avatar", "mannequin"}};
    written["checks"] = {{"count", 0}};
    written["participants"] = 2;
    write_json(folder_ / "plan.json", written);
    const Outcome built =
        run_chironomia({"study", "build", in("plan.json"), "--out", in("study"), "--seed", "1", "--quiet"});
    ASSERT_EQ(built.exit_code, 0) << built.err;
    std::size_t moved = 0;
    const Json key = read_json(folder_ / "study/private/key.json");
    for (const Json& video : key["videos"]) {
        const std::string condition = video["conditions"][0];
        EXPECT_EQ(video["speech"], video["clip"]);
        EXPECT_EQ(video["motion"] != video["clip"], condition.ends_with("(mismatched)"));
        EXPECT_EQ(video["frames"], 6);
        moved += video["motion"] != video["clip"];
    }
    EXPECT_EQ(moved, 4u);
    EXPECT_EQ(run_chironomia({"study", "check", in("study")}).exit_code, 0);
}

TEST_F(PlanFromFolders, HintsTheRateOfMotionsThatCarryNone) {
    for (const auto& entry : fs::directory_iterator(folder_ / "base")) {
        testing::write_npz(entry.path(), {{"poses", {90, 165}, std::vector<double>(90 * 165, 0.0)},
                                          {"trans", {90, 3}, std::vector<double>(90 * 3, 0.0)}});
    }
    const Outcome lacking = plan();
    EXPECT_EQ(lacking.exit_code, 3);
    EXPECT_THAT(lacking.err, HasSubstr("the file does not give its rate; set it with --motion-fps"));
    const Outcome made = plan({"--motion-fps", "15"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(Json::parse(made.out)["hints"], Json::parse(R"({"baseline": {"fps": 15.0}})"));
}

TEST_F(PlanFromFolders, KeepsAPlanThatWasChanged) {
    for (int i = 0; i < 2; ++i) EXPECT_EQ(plan({"--out", in("plan.json")}).exit_code, 0);
    Json changed = read_json(folder_ / "plan.json");
    changed["title"] = "Mine";
    write_json(folder_ / "plan.json", changed);
    const Outcome refused = plan({"--out", in("plan.json")});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err,
                HasSubstr("plan.json: is there already, and is not the plan of these folders; name a "
                          "new file, or remove it"));
    EXPECT_EQ(read_json(folder_ / "plan.json"), changed);
}

TEST_F(PlanFromFolders, IsPrintedWhereNoFileIsNamed) {
    const Outcome made = plan();
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(Json::parse(made.out)["clips"].size(), 3u);
    EXPECT_EQ(made.err, "3 of 3 segments are clips; all match\n");
}

TEST_F(PlanFromFolders, TakesTheSamplesOfAStochasticSystemInTurn) {
    fs::remove(folder_ / "ours/2_scott_0_1_1.npz");
    for (const int sample : {2, 10}) write_motion(format("ours/2_scott_0_1_1_sample_{}.npz", sample), 4);
    const Outcome made = plan();
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err,
                HasSubstr("ours: gives up to 2 samples for a name; its segments take them in turn\n"));
    std::vector<std::string> motions;
    const Json plan = Json::parse(made.out);
    for (const Json& clip : plan["clips"])
        motions.push_back(fs::path(clip["motion"]["ours"].get<std::string>()).filename());
    EXPECT_THAT(motions, ElementsAre("1_wayne_0_1_1.npz", "2_scott_0_1_1_sample_2.npz",
                                     "2_scott_0_1_1_sample_10.npz"));
}

TEST_F(PlanFromFolders, TakesFoldersOfOpenPoseForMotions) {
    fs::remove_all(folder_ / "base");
    fs::create_directory(folder_ / "base");
    for (const char* name : {"1_wayne_0_1_1", "2_scott_0_1_1"})
        fs::copy(testing::test_file("tests/fixtures/gestures/openpose_24fps"),
                 folder_ / format("base/{}", name), fs::copy_options::recursive);
    write_table("1_wayne_0_1_1.wav,0,0.5,0.5\n2_scott_0_1_1.wav,0,0.5,0.5\n");
    const Outcome made = plan({"--motion-fps", "24", "--out", in("plan.json")});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const Json plan = read_json(folder_ / "plan.json");
    EXPECT_EQ(plan["clips"][0]["motion"]["baseline"], "base/1_wayne_0_1_1");
    EXPECT_EQ(plan["hints"]["baseline"]["fps"], 24);
}

// As the cache of Hugging Face and git-annex keep files.
TEST_F(PlanFromFolders, NamesLinksAndNotTheFilesWithoutNamesThatTheyLeadTo) {
    for (const char* file : {"ours/1_wayne_0_1_1.npz", "wav/1_wayne_0_1_1.wav"}) {
        const fs::path blob = folder_ / "blobs" / std::to_string(fs::file_size(folder_ / file));
        fs::create_directories(blob.parent_path());
        fs::rename(folder_ / file, blob);
        fs::create_symlink(blob, folder_ / file);
    }
    fs::create_directory_symlink(folder_ / "ours", folder_ / "latest");
    fs::create_directory(folder_ / "plans");
    const Outcome made = plan({"--out", in("plans/plan.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json clip = read_json(folder_ / "plans/plan.json")["clips"][0];
    EXPECT_EQ(clip["motion"]["ours"], "../ours/1_wayne_0_1_1.npz");
    EXPECT_EQ(clip["audio"], "../wav/1_wayne_0_1_1.wav");
}

TEST_F(PlanFromFolders, TakesTablesOfPointsAndFilmsWhereNothingElseIsThere) {
    for (const char* name : {"1_wayne_0_1_1", "2_scott_0_1_1"}) {
        fs::remove(folder_ / format("base/{}.npz", name));
        Json frames = Json::array();
        for (int i = 0; i < 100; ++i)
            frames.push_back({{0, 1.7, 0}, {0.2, 1.4, 0}, {-0.2, 1.4, 0}, {0.1, 0.9, 0}, {-0.1, 0.9, 0}});
        write_json(folder_ / format("base/{}.json", name),
                   {{"fps", 25},
                    {"names", {"nose", "left_shoulder", "right_shoulder", "left_hip", "right_hip"}},
                    {"frames", frames}});
        fs::rename(folder_ / format("wav/{}.wav", name), folder_ / format("wav/{}.mp4", name));
        write_text(folder_ / format("base/._{}.json", name), "of macOS");
        write_json(folder_ / format("ours/{}.json", name), {{"fps", 30}});  // beside a motion: no motion
    }
    const Outcome made = plan();
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const Json clip = Json::parse(made.out)["clips"][0];
    EXPECT_THAT(clip["motion"]["baseline"], HasSubstr("base/1_wayne_0_1_1.json"));
    EXPECT_THAT(clip["motion"]["ours"], HasSubstr("ours/1_wayne_0_1_1.npz"));
    EXPECT_THAT(clip["audio"], HasSubstr("wav/1_wayne_0_1_1.mp4"));
}

TEST_F(PlanFromFolders, ReportsWhatDoesNotMatch) {
    write_motion("base/2_scott_0_1_1.npz", 3);
    write_motion("base/9_lu_0_1_1.npz", 1);
    write_table("1_wayne_0_1_1,0,1,1\n2_scott_0_1_1,0,2,2\n2_scott_0_1_1,2,4,2\n3_zhao_0_1_1,0,1,1\n");
    fs::copy_file(folder_ / "wav/1_wayne_0_1_1.wav", folder_ / "wav/1_wayne_0_1_1.flac");
    const Outcome made = plan();
    EXPECT_EQ(made.exit_code, 1);
    EXPECT_THAT(made.err, HasSubstr("2_scott_0_1_1_60-120: baseline: 2_scott_0_1_1.npz lasts 3.00 s, and the "
                                    "segment ends at 4.00 s\n"));
    EXPECT_THAT(made.err, HasSubstr(in("segments.csv") + ":5: 3_zhao_0_1_1_0-30: is not among the sounds\n"));
    EXPECT_THAT(made.err, HasSubstr("3_zhao_0_1_1_0-30: is not among the motions of ours\n"));
    EXPECT_THAT(made.err, HasSubstr("1_wayne_0_1_1_0-30: is twice among the sounds, 1_wayne_0_1_1."));
    EXPECT_THAT(made.err, HasSubstr(in("base") + ": no segment names 9_lu_0_1_1\n"));
    EXPECT_THAT(made.err, HasSubstr("1 of 4 segments are clips; 6 things do not match\n"));
    EXPECT_EQ(Json::parse(made.out)["clips"].size(), 1u);
}

// macOS writes "Zoë" with an e and a dots that combines with it, most tables have it in one character.
TEST_F(PlanFromFolders, FindsNamesWhateverTheirFormOfUnicode) {
    const std::string one = "3_zo\u00eb_0_1_1", two = "3_zoe\u0308_0_1_1";
    ASSERT_NE(one, two);
    write_motion(format("ours/{}.npz", two), 4);
    write_motion(format("base/{}.npz", one), 4);
    write_sound(two);
    write_table(format("{}.wav,0,2,2\n{}.wav,2,4,2\n1_wayne_0_1_1,0,1,1\n2_scott_0_1_1,0,1,1\n", one, two));
    const Outcome made = plan();
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("4 of 4 segments are clips; all match\n"));
    const Json clips = Json::parse(made.out)["clips"];
    for (const int i : {0, 1}) {
        EXPECT_EQ(clips[i]["id"], format("{}_{}-{}", one, 60 * i, 60 * i + 60));
        EXPECT_THAT(clips[i]["audio"].get<std::string>(), ::testing::EndsWith("/wav/" + two + ".wav"));
        EXPECT_THAT(clips[i]["motion"]["baseline"].get<std::string>(),
                    ::testing::EndsWith("/base/" + one + ".npz"));
    }
    write_motion(format("ours/{}.npz", one), 4);
    EXPECT_THAT(plan().err,
                HasSubstr(format("segments.csv:2: {0}_0-60: is twice among the motions of ours, "
                                 "{1}.npz and {0}.npz, which differ in their Unicode form alone\n",
                                 one, two)));
}

// The speech lasts 8.97 s.
TEST_F(PlanFromFolders, TakesOnlyTheEndingOfAFileForOne) {
    for (const char* name : {"ours/3_ann_0_1_1.v2.npz", "base/3_ann_0_1_1.v2.npz"}) write_motion(name, 4);
    write_sound("3_ann_0_1_1.v2");
    write_table(
        "3_ann_0_1_1.v2,0,2,2\n3_ann_0_1_1.v2.WAV,2,4,2\n1_wayne_0_1_1,0,2,2\n2_scott_0_1_1.npz,0,2,2\n");
    const Outcome outcome = plan();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\"id\": \"3_ann_0_1_1.v2_0-60\""));
    EXPECT_THAT(outcome.out, HasSubstr("\"id\": \"3_ann_0_1_1.v2_60-120\""));
}

TEST_F(PlanFromFolders, ComparesSegmentsWithTheirSounds) {
    for (const char* system : {"ours", "base"}) {
        for (const char* name : {"1_wayne_0_1_1", "2_scott_0_1_1"})
            write_motion(format("{}/{}.npz", system, name), 20);
    }
    write_table("1_wayne_0_1_1.wav,8,9.5,1.5\n1_wayne_0_1_1.wav,10,12,2\n2_scott_0_1_1.wav,0,2,2\n");
    const Outcome made = plan({"--out", in("plan.json")});
    EXPECT_THAT(made.out, HasSubstr("2 of 3 segments are clips; 1 things do not match"));
    EXPECT_THAT(made.err, HasSubstr("1_wayne_0_1_1.wav: lasts 8.97 s, and 1 segment begins later: "
                                    "1_wayne_0_1_1_300-360, by 1.03 s\n"));
    EXPECT_THAT(made.err, HasSubstr("1_wayne_0_1_1.wav: lasts 8.97 s, and 1 segment ends later, in silence: "
                                    "1_wayne_0_1_1_240-285, by 0.53 s\n"));
}

TEST_F(PlanFromFolders, HasOneLineForEachSoundThatIsTooShort) {
    for (const char* system : {"ours", "base"}) write_motion(format("{}/1_wayne_0_1_1.npz", system), 20);
    write_table(
        "1_wayne_0_1_1,8,9.5,1.5\n1_wayne_0_1_1,8,11,3\n1_wayne_0_1_1,8,9,1\n1_wayne_0_1_1,9,12,3\n"
        "1_wayne_0_1_1,14,15,1\n1_wayne_0_1_1,10,12,2\n2_scott_0_1_1,0,2,2\n");
    const Outcome made = plan();
    EXPECT_EQ(made.exit_code, 1);
    EXPECT_EQ(made.err,
              "1_wayne_0_1_1.wav: lasts 8.97 s, and 3 segments end later, in silence; the worst is "
              "1_wayne_0_1_1_240-330, by 2.03 s\n"
              "1_wayne_0_1_1.wav: lasts 8.97 s, and 3 segments begin later; the worst is "
              "1_wayne_0_1_1_420-450, by 5.03 s\n"
              "4 of 7 segments are clips; 1 things do not match\n");
}

TEST_F(PlanFromFolders, RefusesWhatCannotBecomeAPlan) {
    const auto refusal = [&](const std::string& rows) {
        write_table(rows);
        const Outcome refused = plan({"--out", in("plan.json")});
        EXPECT_EQ(refused.exit_code, 3);
        EXPECT_FALSE(fs::exists(folder_ / "plan.json"));
        return refused.err;
    };
    EXPECT_THAT(refusal("1_wayne_0_1_1,2,1,1\n"),
                HasSubstr("segments.csv:2: start_seconds is 2 and end_seconds is 1; the end must be later"));
    EXPECT_THAT(
        refusal("1_wayne_0_1_1,0,1,2\n"),
        HasSubstr("segments.csv:2: duration_seconds is 2, but from start_seconds, 0, to end_seconds, 1, it "
                  "lasts 1.000 s; mend one of them"));
    EXPECT_THAT(refusal("1_wayne_0_1_1,-1,1,2\n"),
                HasSubstr("segments.csv:2: start_seconds is -1; a time from 0 to 36000 s is needed"));
    EXPECT_THAT(refusal("1_wayne_0_1_1,0,1,1\n1_wayne_0_1_1,0,40000,40000\n"),
                HasSubstr("segments.csv:3: end_seconds is 40000; a time from 0 to 36000 s is needed"));
    EXPECT_THAT(
        refusal("1_wayne_0_1_1,1,1.01,0.01\n"),
        HasSubstr("segments.csv:2: from start_seconds, 1, to end_seconds, 1.01, it lasts 0.010 s; a frame of "
                  "0.033 s is the least"));
    EXPECT_THAT(refusal(" ,0,1,1\n"),
                HasSubstr("segments.csv:2: file_name is empty; write the name of the segment's files"));
    EXPECT_THAT(refusal("1_wayne_0_1_1,0,1,1\n2_scott_0_1_1,0,1,1\n1_Wayne_0_1_1.wav,0.01,1,0.99\n"),
                HasSubstr("segments.csv:4: \"1_Wayne_0_1_1.wav\" from 0.01 s to 1 s is the same clip, "
                          "1_Wayne_0_1_1_0-30, as \"1_wayne_0_1_1\" from 0 s to 1 s in line 2; leave one of "
                          "them out, or rename it, as names that differ in case alone are one\n"));
    EXPECT_THAT(refusal("1_wayne_0_1_1,0,1,1\n1_wayne_0_1_1.wav,0.01,1,0.99\n"),
                HasSubstr("in line 2; leave one of them out\n"));
    EXPECT_THAT(refusal("1_wayne_0_1_1,0,1,1\nzo\xeb,0,1,1\n"),
                HasSubstr("segments.csv:3: the byte 0xeb is not UTF-8; save the table as UTF-8"));
    EXPECT_THAT(refusal("5_zhao_0_1_1,0,1,1\n"),
                HasSubstr("segments.csv: no segment has a motion of every system: " + in("segments.csv") +
                          ":2: 5_zhao_0_1_1_0-30: is not among"));
    write_text(folder_ / "segments.csv", "name,start_seconds,end_seconds\na,0,1\n");
    EXPECT_THAT(plan().err, HasSubstr("has no column file_name; its columns are name, start_seconds"));
    fs::remove_all(folder_ / "wav");
    EXPECT_THAT(plan().err, HasSubstr("wav: there is no such folder; check the path"));
    fs::create_directory(folder_ / "wav");
    EXPECT_THAT(
        plan().err,
        HasSubstr(
            "wav: holds no file that ends in .flac, .mp3, .ogg, .wav, .aac, .m4a, .mkv, .mov, .mp4, .opus, "
            ".webm; name the folder"));
}

// The paths in it are relative to a folder that is not there yet.
TEST_F(PlanFromFolders, GoesIntoANewFolder) {
    ASSERT_EQ(plan({"--out", in("plan.json")}).exit_code, 0);
    const Outcome made = plan({"--out", in("new/deep/plan.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json here = read_json(folder_ / "plan.json"), there = read_json(folder_ / "new/deep/plan.json");
    EXPECT_EQ(there["clips"][0]["audio"], "../../" + here["clips"][0]["audio"].get<std::string>());
    EXPECT_EQ(run_chironomia({"study", "plan", in("new/deep/plan.json")}).exit_code, 0);
}

TEST_F(PlanFromFolders, NeedsAllItsOptions) {
    const auto refusal = [](const Words& words) {
        const Outcome refused = run_chironomia(words);
        EXPECT_EQ(refused.exit_code, 2);
        return refused.err;
    };
    EXPECT_THAT(refusal({"study", "plan"}), HasSubstr("PLAN.json or --from-folders is required"));
    EXPECT_THAT(refusal({"study", "plan", "--from-folders", "ours"}),
                HasSubstr("\"ours\" is no folder of a condition; write NAME=DIR such as ours=motions/ours"));
    EXPECT_THAT(refusal({"study", "plan", "--from-folders", "a=b", "--preset", "hemvip"}),
                HasSubstr("--segments"));
    EXPECT_THAT(refusal({"study", "plan", "plan.json", "--preset", "hemvip"}), HasSubstr("--from-folders"));
    EXPECT_THAT(refusal({"study", "plan", "--from-folders", "a=b", "--segments", "s.csv", "--preset",
                         "hemvip", "--preregister", "p.html"}),
                HasSubstr("--preregister requires plan"));
}

}  // namespace
}  // namespace chironomia::study
