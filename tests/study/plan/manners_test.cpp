// Conditions that are a manner of the expressive engine or of a model of style, the clips that they perform, and right
// answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "study/plan/plan.h"
#include "study/plan/right_answers.h"
#include "tests/study/sample_plan.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using testing::refusal_of;
using testing::TemporaryFolder;

Json manner_plan() {
    return Json::parse(R"({
        "title": "Manners", "layout": "pair", "sound_check": false,
        "conditions": [{"name": "generic", "from": "neutral", "manner": {}},
                       {"name": "spc high", "from": "generic", "manner": {"spc": 0.8}}],
        "clips": [{"id": "c1", "text": "There are two ways."}]})");
}

class ReadManners : public ::testing::Test {
  protected:
    ReadManners() { testing::write_sample_inputs(folder_.path()); }

    Plan read(const Json& json) {
        write_json(folder_ / "plan.json", json);
        return read_plan(folder_ / "plan.json");
    }

    // The message after the name of the plan.
    std::string refusal(const Json& json) {
        const std::string before = (folder_ / "plan.json").string() + ": ";
        const std::string message = refusal_of([&] { read(json); });
        return message.starts_with(before) ? message.substr(before.size()) : message;
    }

    // Of a condition that follows those of the plan, which also has one with motions.
    std::string refusal_of_condition(const Json& condition) {
        Json json = manner_plan();
        json["conditions"].push_back("ours");
        json["conditions"].push_back(condition);
        return refusal(json);
    }

    std::string refusal_of_clip(const Json& clip) {
        Json json = manner_plan();
        json["clips"][0] = {{"id", "c1"}};
        json["clips"][0].update(clip);
        return refusal(json);
    }

    TemporaryFolder folder_;
};

TEST_F(ReadManners, BeginWithASpeakerOrAConditionAbove) {
    write_text(folder_ / "mine.json", R"({"expressivity": {"tmp": 0.5}})");
    Json json = manner_plan();
    json["conditions"].push_back({{"name", "both"}, {"from", "spc high"}, {"manner", {{"oac", 0.9}}}});
    json["conditions"].push_back({{"name", "mine"}, {"from", "mine.json"}, {"manner", {{"spc", -1}}}});
    const Plan plan = read(json);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(plan.conditions[i].making, Making::manner);
    EXPECT_EQ(plan.conditions[0].speaker, "neutral");
    EXPECT_EQ(plan.conditions[0].manner, LocalManner{});
    EXPECT_EQ(plan.conditions[2].from, 1u);
    EXPECT_EQ(plan.conditions[2].manner[Expressivity::spatial_extent], 0.8);
    EXPECT_EQ(plan.conditions[2].manner[Expressivity::overall_activation], 0.9);
    EXPECT_EQ(plan.conditions[3].speaker, (folder_ / "mine.json").string());
    EXPECT_EQ(plan.conditions[3].from, 3u);
    EXPECT_EQ(name_of_making(plan.conditions[2]), "manner: neutral, oac 0.9, spc 0.8");
    EXPECT_EQ(name_of_making(plan.conditions[3]), "manner: mine.json, spc -1");
}

TEST_F(ReadManners, AreMadeWorseAndComparedLikeOthers) {
    Json json = manner_plan();
    json["conditions"].push_back({{"name", "late"}, {"from", "spc high"}, {"by", "delayed"}, {"ms", 300}});
    json["compare"] = "made";
    const Plan plan = read(json);
    EXPECT_EQ(plan.conditions[2].from, 1u);
    EXPECT_THAT(plan.groups, ElementsAre(ElementsAre(0, 1), ElementsAre(1, 2)));
}

TEST_F(ReadManners, StandBesideConditionsWithMotions) {
    Json json = manner_plan();
    json["conditions"].push_back("ours");
    json["clips"][0] = {{"id", "c1"}, {"audio", "c1.wav"}, {"motion", {{"ours", "ours/c1.bvh"}}}};
    const Plan plan = read(json);
    EXPECT_THAT(plan.clips[0].motions, ElementsAre("", "", folder_ / "ours/c1.bvh"));
    EXPECT_TRUE(has_sound(plan));
}

TEST_F(ReadManners, TakeTextsScriptsAndRecordings) {
    write_text(folder_ / "talk.aplm", "<APLM><rheme>There are two ways.</rheme></APLM>");
    write_text(folder_ / "c1.csv", "word,start_s,end_s\nThere,0.1,0.4\n");
    Json json = manner_plan();
    json["clips"].push_back({{"id", "c2"}, {"script", "talk.aplm"}, {"voice", "beth"}, {"seed", 3}});
    json["clips"].push_back({{"id", "c3"}, {"audio", "c1.wav"}, {"words", "c1.csv"}});
    const Plan plan = read(json);
    EXPECT_EQ(plan.clips[0].text->text, "There are two ways.");
    EXPECT_EQ(plan.clips[0].voice, "neutral");
    EXPECT_EQ(plan.clips[1].text->name, (folder_ / "talk.aplm").string());
    EXPECT_EQ(plan.clips[1].seed, 3u);
    EXPECT_FALSE(plan.clips[2].text);
    EXPECT_EQ(plan.clips[2].words, folder_ / "c1.csv");
    EXPECT_TRUE(has_sound(plan));
    const Json used = plan_as_used(plan);
    EXPECT_EQ(used["clips"][1]["script"], "talk.aplm");
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(ReadManners, AreRefusedWithoutAMeaning) {
    const Json values = {{"spc", 1}};
    EXPECT_EQ(
        refusal_of_condition({{"name", "x"}, {"from", "ours"}, {"manner", values}}),
        "conditions[3].from: \"ours\" has movements of its own, which no manner changes; name a condition "
        "with a \"manner\", or a speaker");
    EXPECT_THAT(refusal_of_condition({{"name", "x"}, {"from", "genric"}, {"manner", values}}),
                HasSubstr("conditions[3].from: is \"genric\", which is none of \"generic\", \"spc high\", "));
    EXPECT_THAT(refusal_of_condition({{"name", "x"}, {"from", "none.json"}, {"manner", values}}),
                HasSubstr("conditions[3].from: there is no file \"none.json\""));
    EXPECT_EQ(refusal_of_condition({{"name", "x"}, {"from", "generic"}, {"manner", {{"spc", 2}}}}),
              "conditions[3].manner.spc: is 2, a number from -1 to 1 is needed");
    EXPECT_EQ(refusal_of_condition({{"name", "x"}, {"from", "generic"}, {"manner", {{"oac", -0.5}}}}),
              "conditions[3].manner.oac: is -0.5, a number from 0 to 1 is needed");
    EXPECT_THAT(refusal_of_condition({{"name", "x"}, {"from", "generic"}, {"manner", {{"spd", 1}}}}),
                HasSubstr("conditions[3].manner.spd: there is no such key"));
    EXPECT_THAT(
        refusal_of_condition({{"name", "x"}, {"from", "generic"}, {"manner", values}, {"by", "frozen"}}),
        HasSubstr("conditions[3].by: there is no such key"));
    EXPECT_EQ(refusal_of_condition({{"name", "x"}, {"from", "generic"}}),
              "conditions[3].by: is missing; add it");
}

TEST_F(ReadManners, RefuseClipsThatTheyCannotPerform) {
    EXPECT_EQ(refusal_of_clip(Json::object()),
              "clips[0]: says nothing that a condition could perform; give it a \"text\", a "
              "\"script\" or an \"audio\"");
    EXPECT_EQ(refusal_of_clip({{"text", "a"}, {"script", "c1.wav"}}),
              "clips[0].text: stands beside \"script\"; give what is said once");
    EXPECT_EQ(refusal_of_clip({{"text", "a"}, {"words", "c1.wav"}}),
              "clips[0].words: has no \"audio\", whose words they are; add it");
    EXPECT_EQ(refusal_of_clip({{"text", "a"}, {"audio", "c1.wav"}}),
              "clips[0].text: stands beside an \"audio\", and nobody knows when its words are said; add "
              "\"words\", or leave the \"audio\" out for a synthetic voice");
    EXPECT_EQ(
        refusal_of_clip({{"audio", "c1.wav"}, {"voice", "beth"}}),
        "clips[0].voice: is that of a synthetic voice, but the clip has an \"audio\"; leave one of them "
        "out");
    EXPECT_THAT(refusal_of_clip({{"text", "a"}, {"voice", "bett"}}),
                HasSubstr("clips[0].voice: is \"bett\", which is none of "));
    EXPECT_EQ(refusal_of_clip({{"text", "a"}, {"motion", {{"ours", "ours/c1.bvh"}}}}),
              "clips[0].motion: names motions, but all conditions are made; leave it out");
    EXPECT_THAT(refusal_of_clip({{"text", "<APLM><rheme>a</APLM>"}}), HasSubstr("clip \"c1\", text:1:"));
}

TEST_F(ReadManners, RefuseWhatOnlyTheyCouldUse) {
    for (const char* key : {"text", "script", "words", "voice", "seed"}) {
        Json json = testing::sample_plan();
        json["clips"][0][key] = "x";
        EXPECT_EQ(
            refusal(json),
            std::string("clips[0].") + key +
                ": is of use for conditions that perform it alone, with a \"manner\" or a \"style_of\", and the "
                "plan has none");
    }
}

// Two people's intervals of PATS, and what a model makes of them.
Json style_plan() {
    return Json::parse(R"({
        "title": "Styles", "layout": "triplet", "sound_check": false, "reference": "target",
        "conditions": ["source", {"name": "model", "from": "source", "style_of": "target"}, "target"],
        "clips": [{"id": "c1", "motion": {"source": "a.h5", "target": "b.h5"}}]})");
}

class ReadStyles : public ReadManners {
  protected:
    ReadStyles() {
        for (const char* name : {"a.h5", "b.h5", "mix.safetensors"}) write_text(folder_ / name, name);
    }

    std::string refusal_with(const Json& condition) {
        Json json = style_plan();
        json["conditions"][1] = {{"name", "model"}};
        json["conditions"][1].update(condition);
        return refusal(json);
    }
};

TEST_F(ReadStyles, ShowWhatOneConditionSaysAsAnotherMoves) {
    const Plan plan = read(style_plan());
    const PlanCondition& model = plan.conditions[1];
    EXPECT_EQ(model.making, Making::style);
    EXPECT_EQ(model.style.content, 0u);
    EXPECT_EQ(model.style.of, 2u);
    EXPECT_EQ(name_of_making(model), "zs-mstm: source in the style of target");
    EXPECT_THAT(plan.groups, ElementsAre(ElementsAre(0, 2, 1))) << "with the reference in the middle";
    const Json used = plan_as_used(plan);
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(ReadStyles, PerformSpeechAndKnowOthersByFilesAndNames) {
    Json json = style_plan();
    json["layout"] = "pair";
    json.erase("reference");
    json["conditions"] = {{{"name", "zs"}, {"style_of", "a.h5"}},
                          {{"name", "mix"},
                           {"style_of", "oliver"},
                           {"engine", "mix-stage"},
                           {"checkpoint", "mix.safetensors"}}};
    json["clips"][0] = {{"id", "c1"}, {"text", "There are two ways."}};
    const Plan plan = read(json);
    EXPECT_EQ(plan.conditions[0].style.speaker, (folder_ / "a.h5").string());
    EXPECT_EQ(plan.conditions[1].style.speaker, "oliver");
    EXPECT_EQ(plan.conditions[1].style.checkpoint, folder_ / "mix.safetensors");
    EXPECT_EQ(plan.clips[0].text->text, "There are two ways.");
    json["clips"][0] = {{"id", "c1"}, {"audio", "c1.wav"}};
    EXPECT_EQ(refusal(json),
              "clips[0].audio: is performed by \"zs\", which needs to know when its words are said; add "
              "\"words\"");
}

TEST_F(ReadStyles, LetMixStageMoveAsTheTargetOfEachClip) {
    Json json = style_plan();
    json["conditions"][1].update({{"engine", "mix-stage"}, {"checkpoint", "mix.safetensors"}});
    const Plan plan = read(json);
    EXPECT_EQ(plan.conditions[1].style.of, 2u);
    EXPECT_EQ(plan.conditions[1].style.speaker, "") << "is that of the target's interval";
    EXPECT_EQ(name_of_making(plan.conditions[1]), "mix-stage: source in the style of target");
    json["clips"][0]["motion"]["target"] = "ours/c1.bvh";
    EXPECT_THAT(refusal(json), HasSubstr("is \"ours/c1.bvh\", but \"model\" is performed from an interval"));
}

TEST_F(ReadStyles, AreRefusedWithoutAMeaning) {
    EXPECT_EQ(
        refusal_with({{"from", "source"}, {"style_of", "taget"}}),
        "conditions[1].style_of: is \"taget\", but a condition with motions (source, target) or the file "
        "of an interval of PATS (.h5) is needed");
    EXPECT_EQ(refusal_with({{"from", "model"}, {"style_of", "target"}}),
              "conditions[1].from: is \"model\", which is none of \"source\", \"target\"");
    EXPECT_EQ(refusal_with({{"style_of", "oliver"}, {"engine", "mix-stage"}}),
              "conditions[1].checkpoint: is missing; add it");
    EXPECT_THAT(refusal_with({{"style_of", "none.h5"}}),
                HasSubstr("conditions[1].style_of: there is no file \"none.h5\""));
    EXPECT_THAT(refusal_with({{"style_of", "target"}, {"by", "frozen"}}),
                HasSubstr("conditions[1].by: there is no such key"));
    Json json = style_plan();
    json["clips"][0]["motion"]["target"] = "ours/c1.bvh";
    EXPECT_EQ(refusal(json),
              "clips[0].motion.target: is \"ours/c1.bvh\", but \"model\" is performed from an interval of "
              "PATS (.h5)");
}

Json plan_with_right_answers() {
    Json json = manner_plan();
    json["conditions"].push_back({{"name", "spc low"}, {"from", "generic"}, {"manner", {{"spc", -0.8}}}});
    json["compare"] = Json::parse(R"([["generic", "spc high"], ["generic", "spc low"]])");
    json["questions"] = Json::parse(R"([
        {"id": "difference", "kind": "choice", "text": "What do you see?",
         "options": [{"id": "more", "text": "wider"}, {"id": "less", "text": "narrower"}]},
        {"id": "best", "kind": "choice", "text": "Which one?", "of_videos": true},
        {"id": "why", "kind": "text", "text": "Why?"}])");
    json["right_answers"] = {{"difference", {{"spc high", "more"}, {"spc low", "less"}}},
                             {"best", {{"c1", "spc low"}}}};
    return json;
}

TEST_F(ReadManners, HaveRightAnswersOnTheirPages) {
    const Plan plan = read(plan_with_right_answers());
    EXPECT_THAT(right_answers_on(plan, 0, {0, 1}), ElementsAre(Pair("difference", "more")));
    EXPECT_THAT(right_answers_on(plan, 0, {2, 0}),
                ElementsAre(Pair("best", "spc low"), Pair("difference", "less")));
    const Json used = plan_as_used(plan);
    EXPECT_EQ(used["right_answers"]["difference"], Json({{"spc high", "more"}, {"spc low", "less"}}));
    EXPECT_EQ(used["right_answers"]["best"], Json({{"c1", "spc low"}}));
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(ReadManners, RefuseRightAnswersThatThereAreNot) {
    const auto refused = [&](const char* question, const Json& answers) {
        Json json = plan_with_right_answers();
        json["right_answers"] = {{question, answers}};
        return refusal(json);
    };
    EXPECT_THAT(refused("differences", Json::object()),
                HasSubstr("right_answers.differences: there is no such key"));
    EXPECT_THAT(refused("difference", {{"wide", "more"}}),
                HasSubstr("right_answers.difference.wide: there is no such key"));
    EXPECT_THAT(refused("difference", {{"spc high", "mor"}}),
                HasSubstr("right_answers.difference[\"spc high\"]: is \"mor\", which is none of"));
    EXPECT_EQ(
        refused("difference", {{"generic", "less"}, {"spc high", "more"}}),
        "right_answers.difference: \"generic\" and \"spc high\" stand on one page, and both have a right "
        "answer; leave one out");
    EXPECT_THAT(refused("best", {{"c2", "generic"}}),
                HasSubstr("right_answers.best.c2: there is no such key"));
    EXPECT_EQ(
        refused("why", Json::object()),
        "right_answers.why: is of a question without a right answer; give right answers to a choice, or to "
        "a ranking of videos");
    Json json = plan_with_right_answers();
    json["compare"] = Json::parse(R"([["generic", "spc high"]])");
    EXPECT_EQ(refusal(json),
              "right_answers.best.c1: is \"spc low\", which is compared with nothing; name another");
}

}  // namespace
}  // namespace chironomia::study
