#include "study/plan/secret_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files/files.h"
#include "study/plan/plan.h"
#include "study/plan/presets.h"
#include "tests/study/tiny_clips.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using testing::TemporaryFolder;
using testing::tiny_mp4;
using testing::tiny_webm;
using ::testing::UnorderedElementsAre;

TEST(SecretNames, AreConditionsClipsAvatarAndThePartsOfPathsThatDiffer) {
    Plan plan;
    plan.file = "/lab/plan.json";
    plan.conditions = {{.name = "ours"}, {.name = "baseline", .from = 1}};
    plan.render.avatar = "/lab/figures/zoe.glb";
    plan.clips = {{.id = "greeting",
                   .audio = "/lab/wav/talk7.wav",
                   .motions = {"/lab/bvh/net12/take3.bvh", "/lab/bvh/graph/take3.bvh"}}};
    EXPECT_THAT(secret_names(plan),
                UnorderedElementsAre("ours", "baseline", "greeting", "zoe", "talk7", "net12", "graph"));
}

TEST(SecretNames, ArePartsOfTheFacesThatDifferToo) {
    Plan plan;
    plan.file = "/lab/plan.json";
    plan.conditions = {{.name = "ours"}, {.name = "baseline", .from = 1}};
    plan.render.avatar = "/lab/zoe.glb";
    plan.clips = {{.id = "greeting",
                   .audio = {},
                   .motions = {"/lab/bvh/a.bvh", "/lab/bvh/a.bvh"},
                   .faces = {"/lab/au/lstm/a.csv", "/lab/au/copy/a.csv"}}};
    EXPECT_THAT(secret_names(plan),
                UnorderedElementsAre("ours", "baseline", "greeting", "zoe", "lstm", "copy"));
}

TEST(SecretNames, AreTheFilesOfPartnersToo) {
    Plan plan;
    plan.file = "/lab/plan.json";
    plan.conditions = {{.name = "ours"}, {.name = "baseline", .from = 1}};
    plan.clips = {
        {.id = "greeting",
         .audio = "/lab/talk7.wav",
         .motions = {"/lab/x.bvh", "/lab/x.bvh"},
         .partner = PlanPartner{
             .motion = "/lab/bob3.bvh", .audio = "/lab/bob3_voice.wav", .avatar = "/lab/figures/carl.glb"}}};
    EXPECT_THAT(secret_names(plan),
                UnorderedElementsAre("ours", "baseline", "greeting", "talk7", "bob3", "bob3_voice", "carl"));
}

TEST(SecretNames, AreNotTheBundledAvatarsUnlessAConditionIsCalledSo) {
    Plan plan;
    plan.file = "/lab/plan.json";
    plan.conditions = {{.name = "ours"}, {.name = "baseline", .from = 1}};
    plan.render.avatar = "neutral";
    EXPECT_THAT(secret_names(plan), UnorderedElementsAre("ours", "baseline"));
    plan.conditions = {{.name = "ours"}, {.name = "neutral", .from = 1}};
    EXPECT_THAT(secret_names(plan), UnorderedElementsAre("ours", "neutral"));
}

TEST(FindWord, FindsWholeWordsOfAnyCase) {
    EXPECT_EQ(find_word("Is OURS better?", {"theirs", "ours"}), "ours");
    EXPECT_EQ(find_word("ours-v2", {"ours"}), "ours");
    EXPECT_EQ(find_word("It took hours", {"ours"}), std::nullopt);
    EXPECT_EQ(find_word("ours2, ours_b, oursé", {"ours"}), std::nullopt);
    EXPECT_EQ(find_word("hours of ours", {"ours"}), "ours");
    EXPECT_EQ(find_word("Which is better, A or B?", {"b"}), "b");
}

// A question of the thesis has the word "baseline", whatever the conditions are called.
TEST(FindCondition, PassesOverSentencesOfAPresetAlone) {
    const std::string printed = "Which video resembles the most to the baseline video ?";
    const std::vector<std::string> names = {"ours", "baseline"};
    EXPECT_EQ(find_word(printed, names), "baseline");
    EXPECT_EQ(find_condition(printed, names), std::nullopt);
    EXPECT_EQ(find_condition(printed + "\n" + printed, names), std::nullopt);
    EXPECT_EQ(find_condition(printed + "\nThe baseline is B.", names), "baseline");
    EXPECT_EQ(find_condition(printed + " Not ours!", names), "ours");
    EXPECT_EQ(find_condition("A", {"a", "b"}), "a");
}

// The instructions are shown in French; "agent" is a word of theirs.
TEST(FindCondition, KnowsPresetsInEveryLanguage) {
    const auto face = std::ranges::find(presets(), "face-and-head", &Preset::name);
    const std::string french = face->plan["in_language"]["fr"]["instructions"];
    EXPECT_EQ(find_word(french, {"agent"}), "agent");
    EXPECT_EQ(find_condition(french, {"agent"}), std::nullopt);
}

std::optional<std::string> found_in(const std::string& bytes, const std::vector<std::string>& names) {
    const TemporaryFolder folder;
    write_text(folder / "clip", bytes);
    return NamesInClips(names).find(folder / "clip");
}

TEST(FindNameInClip, FindsANameInATagWhateverItsForm) {
    EXPECT_EQ(found_in(tiny_mp4("x", "by Baseline"), {"ours", "baseline"}), "baseline");
    EXPECT_EQ(found_in(tiny_mp4("x", std::string("b\0a\0s\0e\0l\0i\0n\0e\0", 16)), {"baseline"}), "baseline");
    EXPECT_EQ(found_in(tiny_mp4("x", std::string("\0o\0u\0r\0s", 8)), {"ours"}), "ours");
    EXPECT_EQ(found_in(tiny_webm("x", "made by baseline 3"), {"baseline"}), "baseline");
}

// printf 'baseline' | base64, with none, one and two bytes before it.
TEST(FindNameInClip, FindsANameInBase64WhereverItBegins) {
    for (const char* encoded : {"YmFzZWxpbmU=", "eGJhc2VsaW5l", "eHhiYXNlbGluZQ=="}) {
        EXPECT_EQ(found_in(tiny_mp4("x", encoded), {"baseline"}), "baseline") << encoded;
    }
    EXPECT_EQ(found_in(tiny_mp4("x", "YmFzZWxhbmU="), {"baseline"}), std::nullopt);
}

TEST(FindNameInClip, FindsALongNameInThePicturesToo) {
    EXPECT_EQ(found_in(tiny_mp4("..baseline.."), {"baseline"}), "baseline");
    EXPECT_EQ(found_in(tiny_webm("..baseline.."), {"baseline"}), "baseline");
}

// Letters that come up by chance, and texts that every clip holds, are no leaks.
TEST(FindNameInClip, PassesOverWhatRevealsNothing) {
    EXPECT_EQ(found_in(tiny_mp4("..ours.."), {"ours"}), std::nullopt);
    EXPECT_EQ(found_in(tiny_mp4("x", "c1 or b"), {"c1", "b"}), std::nullopt);
    EXPECT_EQ(found_in(tiny_mp4("x", "VideoHandler"), {"video"}), std::nullopt);
    EXPECT_EQ(found_in(tiny_mp4("x", "my video"), {"video"}), "video");
}

}  // namespace
}  // namespace chironomia::study
