// What the expressive engine makes of a plan.
#include "study/build/perform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "study/build/build.h"
#include "study/build/study_files.h"
#include "study/models/synthesis.h"
#include "synth/speakers/speakers.h"
#include "tests/study/fake_maker.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::source_dir;
using testing::TemporaryFolder;

// Two manners of one clip, of which one is also late.
Json small_plan() {
    return Json::parse(R"({
        "title": "Manners", "layout": "pair", "sound_check": false,
        "conditions": [{"name": "generic", "from": "neutral", "manner": {}},
                       {"name": "spc high", "from": "generic", "manner": {"spc": 0.8}},
                       {"name": "late", "from": "spc high", "by": "delayed", "ms": 300}],
        "render": {"size": [64, 36], "fps": 25},
        "clips": [{"id": "c1", "script": "talk.txt"}]})");
}

class PerformClips : public ::testing::Test {
  protected:
    PerformClips() { write_text(folder_ / "talk.txt", "There are two ways to do it."); }

    Plan plan() {
        write_json(folder_ / "plan.json", json_);
        return read_plan(folder_ / "plan.json");
    }

    std::map<std::string, std::string> build(const std::string& name) {
        build_study(plan(), {.out = folder_ / name, .seed = 7, .quiet = true}, testing::FakeMaker().maker());
        std::map<std::string, std::string> files;
        for (const std::string& file : list_files(folder_ / name))
            files[file] = read_text(folder_ / name / file);
        return files;
    }

    TemporaryFolder folder_;
    Json json_ = small_plan();
};

TEST_F(PerformClips, GivesEachMannerAMotionOfTheSameSpeech) {
    const PerformedClips made = perform_clips(plan());
    const PlanClip& clip = made.plan.clips[0];
    EXPECT_EQ(clip.motions[2], "");
    const Motion generic = read_motion(clip.motions[0], {}), wide = read_motion(clip.motions[1], {});
    EXPECT_EQ(generic.fps, 25);
    EXPECT_EQ(generic.frames, wide.frames);
    EXPECT_NE(read_text(clip.motions[0]), read_text(clip.motions[1]));
    EXPECT_TRUE(fs::exists(clip.audio));
    EXPECT_TRUE(plan().clips[0].audio.empty());
}

// As `chironomia synth` has it with the same words, voice, seed and manner.
TEST_F(PerformClips, MakesWhatTheEngineMakes) {
    json_["clips"][0]["seed"] = 5;
    json_["clips"][0]["voice"] = "beth";
    const PerformedClips made = perform_clips(plan());
    const Synthesized alone = synthesize({.script = "There are two ways to do it.",
                                          .manner = plan().conditions[1].manner,
                                          .voice = speaker_named("beth").voice,
                                          .fps = 25,
                                          .seed = 5});
    const Motion motion = read_motion(made.plan.clips[0].motions[1], {});
    EXPECT_EQ(motion.frames, alone.performed.motion.frames);
    EXPECT_EQ(motion.joints->turns, alone.performed.motion.joints->turns);
}

TEST_F(PerformClips, LeavesNothingBehindAndNothingUndone) {
    fs::path folder;
    {
        const PerformedClips made = perform_clips(plan());
        folder = made.folder->path();
        EXPECT_TRUE(fs::exists(folder));
    }
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(PerformClips, IsInTheKeyAndTheManifestWithTheSameBytesEachTime) {
    const auto files = build("study");
    EXPECT_EQ(build("again"), files);
    const Json key = Json::parse(files.at("private/key.json"));
    EXPECT_EQ(key["conditions"][0], Json({{"name", "generic"}, {"made", "manner: neutral"}}));
    EXPECT_EQ(key["conditions"][1], Json({{"name", "spc high"}, {"made", "manner: neutral, spc 0.8"}}));
    EXPECT_EQ(key["conditions"][2]["from"], "spc high");
    const Json manifest = Json::parse(files.at("private/manifest.json"));
    ASSERT_EQ(manifest["inputs"].size(), 2u);
    EXPECT_EQ(manifest["inputs"][1]["path"], "talk.txt");
    const Json plan = Json::parse(files.at("private/plan.json"));
    EXPECT_EQ(plan["clips"][0]["script"], "talk.txt");
    EXPECT_EQ(plan["conditions"][1]["manner"]["spc"], 0.8);
    // Another manner, and another text, make another study.
    json_["conditions"][1]["manner"]["spc"] = 0.7;
    EXPECT_NE(build("narrower").at("private/recordings.json"), files.at("private/recordings.json"));
    json_ = small_plan();
    write_text(folder_ / "talk.txt", "There are three ways to do it.");
    EXPECT_NE(build("other").at("private/recordings.json"), files.at("private/recordings.json"));
}

TEST_F(PerformClips, PassesOnWhatAScriptDoesNotShow) {
    json_["clips"][0] = {{"id", "c1"}, {"audio", "c1.wav"}};
    fs::copy(source_dir() / "assets/samples/speech/two-ways.wav", folder_ / "c1.wav");
    const BuildSummary summary = build_study(plan(), {.out = folder_ / "study", .seed = 7, .quiet = true},
                                             testing::FakeMaker().maker());
    ASSERT_EQ(summary.warnings.size(), 1u);
    EXPECT_THAT(summary.warnings[0], HasSubstr("clip \"c1\": "));
    EXPECT_THAT(summary.warnings[0], HasSubstr("its words are not known"));
}

}  // namespace
}  // namespace chironomia
