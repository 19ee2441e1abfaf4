// What the expressive engine makes of a plan, and the example plans, whose answers are right by design.
#include "study/build/perform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "skinning/motion/motion_file.h"
#include "study/build/build.h"
#include "study/build/study_files.h"
#include "study/models/synthesis.h"
#include "synth/gestures/lexicon.h"
#include "synth/speakers/speakers.h"
#include "tests/study/fake_maker.h"
#include "tests/support/support.h"
#include "tests/synth/motor/manner_metrics.h"

namespace chironomia::study {
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

// The agent stands on the left of the picture unless the partner does, and in the scene dyad they look at each other.
TEST_F(PerformClips, LooksAtThePartnerOfADyad) {
    write_text(folder_ / "partner.bvh", "unread");
    json_["clips"][0]["partner"] = {{"motion", "partner.bvh"}};
    const auto sideways = [&](const char* scene, const char* partner_side) {
        json_["render"]["scene"] = scene;
        json_["render"]["partner_side"] = partner_side;
        const PerformedClips made = perform_clips(plan());
        const Motion motion = read_motion(made.plan.clips[0].motions[0], {});
        float sum = 0;
        for (const Quat& turn : motion.face->head) sum += (turn * Vec3(0, 0, 1)).x;  // to the person's left
        return sum / static_cast<float>(motion.frames);
    };
    EXPECT_GT(sideways("dyad", "right"), 0.3f);
    EXPECT_LT(sideways("dyad", "left"), -0.3f);
    EXPECT_LT(std::abs(sideways("split", "right")), 0.15f);
}

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

// ---- The examples of the two studies of GRETA

Plan example(const std::string& preset) {
    return read_plan(source_dir() / "assets/samples/plans" / (preset + ".json"));
}

MannerMetrics measure(const PlanClip& clip, const PlanCondition& condition) {
    SynthesisJob job{.source = clip.text,
                     .speaker = condition.speaker,
                     .manner = condition.manner,
                     .fps = 60,
                     .seed = clip.seed};
    if (!clip.audio.empty()) job.recording = clip.audio;
    if (!clip.words.empty()) job.words = clip.words;
    const Synthesized made = synthesize(job);
    const Motion& motion = made.performed.motion;
    ArmMotion arms{.turns = motion.joints->turns, .placed = made.performed.gestures};
    return measure_manner(arms, read_lexicon(bundled_lexicon_files()),
                          {.frames = motion.frames, .fps = motion.fps});
}

// What a parameter is seen by, and the part of the answers that names it.
struct Signature {
    Expressivity dimension;
    const char* answer;
    double MannerMetrics::*metric;
    double sign = 1;
};

constexpr Signature kSignatures[] = {
    {Expressivity::overall_activation, "activation", &MannerMetrics::gestures_per_minute},
    {Expressivity::spatial_extent, "spatial", &MannerMetrics::box},
    {Expressivity::temporal_extent, "temporal", &MannerMetrics::pace},
    {Expressivity::fluidity, "fluidity", &MannerMetrics::peak_jerk, -1},
    {Expressivity::power, "power", &MannerMetrics::peak_acceleration},
    {Expressivity::repetition, "repetition", &MannerMetrics::strokes_per_rheme}};

// The one dimension in which two manners differ.
const Signature& only_difference(const PlanCondition& a, const PlanCondition& b) {
    const Manner neutral;
    const Manner from = overridden(neutral, a.manner), to = overridden(neutral, b.manner);
    std::size_t found = 0;
    const Signature* only = nullptr;
    for (const Signature& signature : kSignatures) {
        if (from[signature.dimension] == to[signature.dimension]) continue;
        ++found;
        only = &signature;
    }
    EXPECT_EQ(found, 1u) << b.name;
    return *only;
}

// No other parameter changes which gestures are made, or how often their strokes are.
void expect_the_same_acts(const MannerMetrics& a, const MannerMetrics& b, Expressivity dimension) {
    if (dimension == Expressivity::overall_activation) return;
    EXPECT_EQ(a.gestures_per_minute, b.gestures_per_minute) << symbol_of(dimension);
    if (dimension != Expressivity::repetition) {
        EXPECT_EQ(a.strokes_per_rheme, b.strokes_per_rheme) << symbol_of(dimension);
    }
}

// Each pair differs in one parameter of the engine, whose name and direction is the right answer; and in each clip what
// the parameter is seen by differs in that direction.
TEST(ExamplesOfManners, DifferInTheParameterThatIsTheRightAnswer) {
    const Plan plan = example("greta-parameters");
    const RightAnswers& right = plan.right_answers.at("difference");
    EXPECT_EQ(right.size(), 12u);
    EXPECT_EQ(plan.groups.size(), 12u);
    for (const PlanClip& clip : plan.clips) {
        std::map<std::size_t, MannerMetrics> known;
        for (const auto& group : plan.groups) {
            const PlanCondition &generic = plan.conditions[group[0]], &other = plan.conditions[group[1]];
            const Signature& signature = only_difference(generic, other);
            if (!known.contains(group[0])) known[group[0]] = measure(clip, generic);
            const MannerMetrics &a = known[group[0]], b = measure(clip, other);
            const double difference = signature.sign * (b.*signature.metric - a.*signature.metric);
            EXPECT_EQ(right.at(other.name),
                      format("{}-{}", signature.answer, difference > 0 ? "more" : "less"))
                << clip.id;
            EXPECT_NE(difference, 0) << clip.id << ", " << other.name;
            expect_the_same_acts(a, b, signature.dimension);
        }
    }
}

// Of each intent one manner is right, and each manner of one.
TEST(ExamplesOfManners, HaveAMannerForEachIntent) {
    const Plan plan = example("greta-intents");
    std::vector<std::string> right;
    for (const PlanClip& clip : plan.clips) right.push_back(plan.right_answers.at("fit").at(clip.id));
    std::sort(right.begin(), right.end());
    std::vector<std::string> names = condition_names(plan);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(right, names);
}

}  // namespace
}  // namespace chironomia::study
