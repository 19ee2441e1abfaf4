#include "study/plan/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "core/files/files.h"
#include "core/text.h"
#include "tests/study/sample_plan.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::sample_plan;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using testing::write_sample_inputs;

// A folder with the inputs of the sample plan, and what reading a plan in it says.
class ReadPlan : public ::testing::Test {
  protected:
    ReadPlan() { write_sample_inputs(folder_.path()); }

    Plan read(const Json& json) {
        write_json(folder_ / "plan.json", json);
        return read_plan(folder_ / "plan.json");
    }

    // The message without the name of the folder.
    std::string refusal(const Json& json) {
        std::string message = refusal_of([&] { read(json); });
        const std::string folder = folder_.path().string() + "/";
        for (std::size_t at; (at = message.find(folder)) != std::string::npos;)
            message.erase(at, folder.size());
        return message;
    }

    // A partner for every clip, and a scene for two.
    void add_partners(Json& json) {
        for (const char* name : {"partner.bvh", "partner.wav"}) write_text(folder_ / name, name);
        for (Json& clip : json["clips"]) {
            clip["partner"] = {{"motion", "partner.bvh"}, {"audio", "partner.wav"}};
        }
        json["render"]["scene"] = "dyad";
    }

    TemporaryFolder folder_;
};

TEST_F(ReadPlan, TakesTheSmallestPlan) {
    Json json = sample_plan();
    json.erase("render");
    const Plan plan = read(json);
    EXPECT_EQ(plan.texts.title, "Two ways to move");
    EXPECT_THAT(condition_names(plan), ElementsAre("ours", "baseline"));
    EXPECT_EQ(plan.presentation, Presentation::two_videos);
    EXPECT_EQ(plan.questions[0].text, "In which video do the character's movements fit the speech better?");
    EXPECT_EQ(plan.questions[0].answers.size(), 5u);
    EXPECT_EQ(plan.render.avatar, "neutral");
    EXPECT_EQ(plan.render.scene, "upper");
    EXPECT_EQ(plan.render.size.width, 1280);
    EXPECT_EQ(plan.render.fps, (Rate{30, 1}));
    ASSERT_EQ(plan.clips.size(), 2u);
    EXPECT_EQ(plan.clips[1].audio, folder_ / "c2.wav");
    EXPECT_THAT(plan.clips[1].motions, ElementsAre(folder_ / "ours/c2.bvh", folder_ / "base/c2.bvh"));
}

TEST_F(ReadPlan, TakesEveryKey) {
    Json json = sample_plan();
    json["$schema"] = "plan.schema.json";
    json["presentation"] = "one video";
    json["instructions"] = "Watch.";
    json["question"] = "Who moves better?";
    json["answers"] = {"1", "2", "3", "4", "5"};
    json["orders"] = 12;
    write_text(folder_ / "figure.glb", "x");
    write_text(folder_ / "stage.json", "{}");
    json["render"] = {{"avatar", "figure.glb"}, {"scene", "stage.json"}, {"size", {640, 360}},
                      {"fps", "30000/1001"},    {"body", "upper"},       {"format", "webm"}};
    const Plan plan = read(json);
    EXPECT_EQ(plan.presentation, Presentation::one_video);
    EXPECT_EQ(plan.texts.instructions, "Watch.");
    EXPECT_EQ(plan.questions[0].text, "Who moves better?");
    EXPECT_THAT(plan.questions[0].answers, ElementsAre("1", "2", "3", "4", "5"));
    EXPECT_EQ(plan.participants.orders, 12u);
    EXPECT_EQ(plan.render.avatar, folder_ / "figure.glb");
    EXPECT_EQ(plan.render.scene, folder_ / "stage.json");
    EXPECT_EQ(plan.render.size.height, 360);
    EXPECT_EQ(plan.render.fps, (Rate{30000, 1001}));
    EXPECT_TRUE(plan.render.upper_body);
    EXPECT_EQ(plan.render.format, "webm");
}

TEST_F(ReadPlan, TakesTheRayTracerWithItsOptions) {
    Json json = sample_plan();
    EXPECT_EQ(read(json).render.drawing, Drawing{});
    json["render"]["renderer"] = "rays";
    json["render"]["samples"] = 64;
    json["render"]["motion_blur"] = 0.5;
    const Plan plan = read(json);
    EXPECT_EQ(plan.render.drawing,
              (Drawing{.renderer = RendererKind::rays, .samples = 64, .motion_blur = 0.5}));
    EXPECT_EQ(plan_as_used(plan)["render"]["samples"], 64);
    EXPECT_EQ(plan_as_used(plan)["render"]["motion_blur"], 0.5);
}

// Not only what the plan says: the study would be built, and study check would find it.
TEST_F(ReadPlan, RefusesAConditionWhoseNameTheBundledTextsHave) {
    Json json = sample_plan();
    json["conditions"][0] = "better";
    for (Json& clip : json["clips"])
        clip["motion"] = {{"better", clip["motion"]["ours"]}, {"baseline", clip["motion"]["baseline"]}};
    EXPECT_THAT(refusal(json), HasSubstr("conditions: \"better\" stands in what participants read, \""));
}

TEST_F(ReadPlan, TakesEveryNameOfARenderer) {
    Json json = sample_plan();
    for (const auto& [name, kind] : renderer_names()) {
        json["render"]["renderer"] = name;
        const Plan plan = read(json);
        EXPECT_EQ(plan.render.drawing.renderer, kind) << name;
        EXPECT_EQ(plan_as_used(plan)["render"]["renderer"], to_text(kind)) << name;
    }
    json["render"]["renderer"] = "paint";
    EXPECT_THAT(refusal(json), HasSubstr("is \"paint\", which is none of"));
}

TEST_F(ReadPlan, RefusesWhatTheRendererCannotDo) {
    Json json = sample_plan();
    json["render"]["renderer"] = "tiles";
    json["render"]["samples"] = 4;
    EXPECT_THAT(refusal(json),
                HasSubstr("asks for samples or motion_blur, which the ray tracer alone knows"));
    json["render"].erase("renderer");
    EXPECT_EQ(refusal(json),
              "plan.json: render: asks for samples or motion_blur, which the ray tracer alone knows; add "
              "\"renderer\": \"rays\" or leave them out");
    json["render"]["renderer"] = "rays";
    json["render"]["motion_blur"] = 1.5;
    EXPECT_EQ(refusal(json), "plan.json: render.motion_blur: is 1.5, 0 to 1 is needed");
    json["render"]["motion_blur"] = "much";
    EXPECT_EQ(refusal(json), "plan.json: render.motion_blur: is \"much\", 0 to 1 is needed");
    json["render"]["motion_blur"] = 0;
    json["render"]["samples"] = 2000;
    EXPECT_THAT(refusal(json), StartsWith("plan.json: render.samples: "));
}

TEST_F(ReadPlan, AsksAboutTheMovementAloneWhenThereIsNoSound) {
    Json json = sample_plan();
    for (Json& clip : json["clips"]) clip.erase("audio");
    EXPECT_EQ(read(json).questions[0].text,
              "In which video does the character move more like a real person?");
    json["presentation"] = "one video";
    EXPECT_EQ(read(json).questions[0].text, "Which character moves more like a real person?");
}

TEST_F(ReadPlan, TakesHintsForTheMotionsOfACondition) {
    write_text(folder_ / "names.json", "{}");
    Json json = sample_plan();
    json["hints"]["baseline"] = {
        {"fps", 119.88},      {"up", "z"},   {"unit", "cm"},          {"facing", -90},
        {"lift_filter", 4.5}, {"smooth", 6}, {"names", "names.json"}, {"picture_size", "1280x720"},
        {"field_of_view", 65}};
    const Plan plan = read(json);
    EXPECT_FALSE(plan.hints[0].fps.has_value());
    EXPECT_NEAR(*plan.hints[1].fps, 119.88, 1e-3);
    EXPECT_EQ(plan.hints[1].up, UpAxis::z);
    EXPECT_EQ(plan.hints[1].unit, 0.01);
    EXPECT_EQ(plan.hints[1].turn_deg, -90);
    EXPECT_EQ(plan.hints[1].lift_cutoff, 4.5);
    EXPECT_EQ(plan.hints[1].picture.size, Vec2(1280, 720));
    EXPECT_EQ(plan.hints[1].picture.field_of_view, 65);
    EXPECT_EQ(plan.hints[1].smoothing, 6);
    EXPECT_EQ(plan.hints[1].name_map, folder_ / "names.json");
    EXPECT_EQ(plan_as_used(plan)["hints"], json["hints"]);
}

TEST_F(ReadPlan, RefusesHintsThatMeanNothing) {
    Json json = sample_plan();
    json["hints"]["baseline"]["up"] = "w";
    EXPECT_EQ(refusal(json),
              "plan.json: hints.baseline.up: up axis: \"w\" is not known; use auto, x, y, z, -x, -y or -z");
    json["hints"]["baseline"] = {{"lift_filter", "on"}};
    EXPECT_EQ(refusal(json),
              "plan.json: hints.baseline.lift_filter: lift filter: \"on\" is not known; use auto, off or a "
              "cutoff of 0.1 to 100 Hz");
    json["hints"]["baseline"] = {{"fps", 0}};
    EXPECT_THAT(refusal(json),
                StartsWith("plan.json: hints.baseline.fps: is 0, a number of frames a second from 5 "
                           "to 1000 is needed"));
    json["hints"] = {{"basline", {{"up", "z"}}}};
    EXPECT_EQ(refusal(json), "plan.json: hints.basline: there is no such key; did you mean \"baseline\"?");
    json["hints"] = {{"ours", {{"upp", "z"}}}};
    EXPECT_EQ(refusal(json), "plan.json: hints.ours.upp: there is no such key; did you mean \"up\"?");
}

TEST_F(ReadPlan, RefusesUnlikeHintsForFiguresThatShareAVideo) {
    Json json = sample_plan();
    json["presentation"] = "one video";
    json["hints"]["baseline"]["up"] = "z";
    EXPECT_EQ(refusal(json),
              "plan.json: hints: differ between \"ours\" and \"baseline\", which share one video; give every "
              "condition the same hints or show \"two videos\"");
    json["hints"]["ours"]["up"] = "z";
    EXPECT_EQ(read(json).hints[1].up, UpAxis::z);
}

TEST_F(ReadPlan, TakesModesForAllAndForACondition) {
    Json json = sample_plan();
    json["render"]["face_mode"] = "mask";
    EXPECT_THAT(read(json).modes, ::testing::Each(Modes{.face_mode = FaceMode::mask}));
    json["modes"]["baseline"] = {{"face_mode", "mouth-blur"}, {"hands", "hidden"}};
    json["modes"]["ours"] = {{"hands", "relaxed"}};
    json["clips"][0]["motion"]["baseline"] = "ours/c1.bvh";  // conditions that differ in their modes alone
    const Plan plan = read(json);
    EXPECT_THAT(plan.modes,
                ElementsAre(Modes{.face_mode = FaceMode::mask, .hands = HandsMode::relaxed},
                            Modes{.face_mode = FaceMode::mouth_blur, .hands = HandsMode::hidden}));
    EXPECT_EQ(plan_as_used(plan)["modes"], json["modes"]);
    EXPECT_EQ(plan_as_used(plan)["render"]["face_mode"], "mask");
    EXPECT_EQ(modes_by_condition(plan)["baseline"], Json({{"face_mode", "mouth-blur"}, {"hands", "hidden"}}));
}

TEST_F(ReadPlan, SaysHowPeopleWhoWalkAreShown) {
    Json json = sample_plan();
    EXPECT_EQ(read(json).render.travel, Travel::free);
    EXPECT_FALSE(plan_as_used(read(json))["render"].contains("travel"));
    json["render"]["travel"] = "follow";
    EXPECT_EQ(read(json).render.travel, Travel::follow);
    EXPECT_EQ(plan_as_used(read(json))["render"]["travel"], "follow");
    json["render"]["travel"] = "along";
    EXPECT_THAT(refusal(json), StartsWith("plan.json: render.travel: "));
    json["render"]["travel"] = "in-place";
    json["render"]["body"] = "upper";
    EXPECT_EQ(refusal(json),
              "plan.json: render.travel: is \"in-place\", but \"body\" is \"upper\", whose hips "
              "stand still; leave one of them out");
}

TEST_F(ReadPlan, RefusesModesThatThereAreNot) {
    Json json = sample_plan();
    json["render"]["face_mode"] = "blurr";
    EXPECT_THAT(refusal(json), StartsWith("plan.json: render.face_mode: "));
    EXPECT_THAT(refusal(json), HasSubstr("\"au\", \"blur\", \"mask\", \"mouth-blur\", \"neutral\""));
    json = sample_plan();
    json["modes"] = {{"ours", {{"hands", "gone"}}}};
    EXPECT_THAT(refusal(json), StartsWith("plan.json: modes.ours.hands: "));
    json["modes"] = {{"our", {{"hands", "hidden"}}}};
    EXPECT_EQ(refusal(json), "plan.json: modes.our: there is no such key; did you mean \"ours\"?");
    json["modes"] = {{"ours", {{"hand", "hidden"}}}};
    EXPECT_EQ(refusal(json), "plan.json: modes.ours.hand: there is no such key; did you mean \"hands\"?");
}

TEST_F(ReadPlan, IsReadAgainFromThePlanAsUsed) {
    Json json = sample_plan();
    json["modes"]["baseline"]["face_mode"] = "blur";
    json["orders"] = 3;
    const Json used = plan_as_used(read(json));
    EXPECT_EQ(used["clips"][0]["motion"]["baseline"], "base/c1.bvh");
    EXPECT_EQ(used["render"]["avatar"], "mannequin");
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(ReadPlan, RefusesAnUnknownKeyAndNamesTheNearest) {
    Json json = sample_plan();
    json["condition"] = 1;
    EXPECT_EQ(refusal(json), "plan.json: condition: there is no such key; did you mean \"conditions\"?");
    json = sample_plan();
    json["render"]["framerate"] = 30;
    EXPECT_EQ(
        refusal(json),
        "plan.json: render.framerate: there is no such key; write one of \"avatar\", \"scene\", \"size\", "
        "\"fps\", \"body\", \"travel\", \"renderer\", \"samples\", \"motion_blur\", \"face_mode\", \"hands\", "
        "\"format\", \"partner_side\", \"cue\", \"loudness\"");
    json = sample_plan();
    json["clips"][1]["audioo"] = "c2.wav";
    EXPECT_EQ(refusal(json), "plan.json: clips[1].audioo: there is no such key; did you mean \"audio\"?");
}

TEST_F(ReadPlan, RefusesAMissingKey) {
    for (const char* key : {"title", "layout", "conditions", "clips"}) {
        Json json = sample_plan();
        json.erase(key);
        EXPECT_EQ(refusal(json), std::string("plan.json: ") + key + ": is missing; add it");
    }
    Json json = sample_plan();
    json["clips"][0].erase("id");
    EXPECT_EQ(refusal(json), "plan.json: clips[0].id: is missing; add it");
}

TEST_F(ReadPlan, TakesTheFacesOfAClip) {
    Json json = sample_plan();
    for (const char* name : {"ours/f1.csv", "base/f1.csv"}) write_text(folder_ / name, name);
    json["clips"][0]["face"] = {{"ours", "ours/f1.csv"}, {"baseline", "base/f1.csv"}};
    const Plan plan = read(json);
    EXPECT_THAT(plan.clips[0].faces, ElementsAre(folder_ / "ours/f1.csv", folder_ / "base/f1.csv"));
    EXPECT_TRUE(plan.clips[1].faces.empty());
    const Json used = plan_as_used(plan);
    EXPECT_EQ(used["clips"][0]["face"], json["clips"][0]["face"]);
    EXPECT_FALSE(used["clips"][1].contains("face"));
}

TEST_F(ReadPlan, RefusesAFaceThatAConditionLacks) {
    Json json = sample_plan();
    write_text(folder_ / "ours/f2.csv", "x");
    json["clips"][1]["face"] = {{"ours", "ours/f2.csv"}};
    EXPECT_EQ(refusal(json),
              "plan.json: clips[1].face: has no face of the condition \"baseline\" in the clip \"c2\"; give "
              "every condition a face or none");
    json["clips"][1]["face"]["baseline"] = "base/none.csv";
    EXPECT_THAT(refusal(json),
                StartsWith("plan.json: clips[1].face.baseline: there is no file \"base/none.csv\""));
}

TEST_F(ReadPlan, RefusesAClipWithoutTheMotionOfACondition) {
    Json json = sample_plan();
    json["clips"][1]["motion"].erase("baseline");
    EXPECT_EQ(refusal(json), "plan.json: clips[1].motion.baseline: is missing; add it");
    json["clips"][1]["motion"]["basline"] = "base/c2.bvh";
    EXPECT_EQ(refusal(json),
              "plan.json: clips[1].motion.basline: there is no such key; did you mean \"baseline\"?");
    json = sample_plan();
    json["conditions"] = {"ours", "our net 2"};
    json["clips"][0]["motion"] = {{"ours", "ours/c1.bvh"}};
    EXPECT_EQ(refusal(json), "plan.json: clips[0].motion[\"our net 2\"]: is missing; add it");
}

TEST_F(ReadPlan, RefusesAFileThatIsNotThere) {
    Json json = sample_plan();
    json["clips"][1]["motion"]["baseline"] = "base/c3.bvh";
    EXPECT_EQ(
        refusal(json),
        "plan.json: clips[1].motion.baseline: there is no file \"base/c3.bvh\" (looked for base/c3.bvh); "
        "check the path, it is taken relative to the plan");
    json = sample_plan();
    json["clips"][0]["audio"] = "ours";
    EXPECT_EQ(refusal(json),
              "plan.json: clips[0].audio: \"ours\" is a folder, a file is needed; name a file in it");
}

TEST_F(ReadPlan, RefusesDoubledNames) {
    Json json = sample_plan();
    json["clips"][1]["id"] = "C1";
    EXPECT_EQ(refusal(json),
              "plan.json: clips[1].id: \"C1\" is already the id of clips[0]; give each clip its own");
    json = sample_plan();
    json["conditions"] = {"ours", "Ours"};
    EXPECT_EQ(refusal(json),
              "plan.json: conditions[1]: \"Ours\" is already conditions[0]; give each its own name");
}

TEST_F(ReadPlan, RefusesFewerThanTwoConditionsAndNoClips) {
    Json json = sample_plan();
    json["conditions"] = {"ours"};
    EXPECT_EQ(refusal(json), "plan.json: conditions: has 1 entries, at least 2 are needed for this layout");
    json = sample_plan();
    json["clips"] = Json::array();
    EXPECT_EQ(refusal(json), "plan.json: clips: has 0 entries, at least 1 are needed");
}

TEST_F(ReadPlan, RefusesSoundOnSomeClipsOnly) {
    Json json = sample_plan();
    json["clips"][1].erase("audio");
    EXPECT_EQ(
        refusal(json),
        "plan.json: clips[1]: has no \"audio\" while clips[0] has one; give all clips their sound or none");
    json = sample_plan();
    json["clips"][0].erase("audio");
    EXPECT_EQ(
        refusal(json),
        "plan.json: clips[1]: has an \"audio\" while clips[0] has none; give all clips their sound or none");
}

TEST_F(ReadPlan, RefusesSizesThatCannotBeEncoded) {
    Json json = sample_plan();
    json["render"]["size"] = {1281, 720};
    EXPECT_EQ(refusal(json),
              "plan.json: render.size[0]: is 1281 pixels, which is no multiple of 2; use 1280 or 1282");
    json["render"]["size"] = {1280, 16};
    EXPECT_EQ(refusal(json), "plan.json: render.size[1]: is 16, a whole number from 32 to 4096 is needed");
    json["render"]["size"] = {1280, 99999999999ull};
    EXPECT_EQ(refusal(json),
              "plan.json: render.size[1]: is 99999999999, a whole number from 32 to 4096 is needed");
    for (const Json& size : {Json{1280}, Json{1280, 720, 3}, Json("1280x720")}) {
        json["render"]["size"] = size;
        EXPECT_EQ(refusal(json),
                  format("plan.json: render.size: is {}, a width and a height in pixels are needed, "
                         "such as [1280, 720]",
                         size.dump()));
    }
    json["render"]["size"] = {1282, 720};
    json["presentation"] = "one video";
    EXPECT_EQ(refusal(json),
              "plan.json: render.size[0]: is 1282 pixels, which is no multiple of 4; use 1280 or 1284");
}

TEST_F(ReadPlan, RefusesRatesOutOfRange) {
    for (const Json& fps :
         {Json(0), Json(-30), Json(4.5), Json(240), Json("fast"), Json(true), Json("1/0")}) {
        Json json = sample_plan();
        json["render"]["fps"] = fps;
        EXPECT_EQ(refusal(json), "plan.json: render.fps: is " + fps.dump() +
                                     ", a number of frames a second from 5 to 120 is needed, such as 30 or "
                                     "\"30000/1001\"");
    }
}

TEST_F(ReadPlan, RefusesAChoiceThatIsNotThere) {
    Json json = sample_plan();
    json["layout"] = "pairs";
    EXPECT_EQ(refusal(json),
              "plan.json: layout: is \"pairs\", which is none of \"single\", \"pair\", \"triplet\", "
              "\"parallel\"; did you mean \"pair\"?");
    json = sample_plan();
    json["presentation"] = "three";
    EXPECT_EQ(refusal(json),
              "plan.json: presentation: is \"three\", which is none of \"two videos\", \"one video\", \"one "
              "after the other\"");
    json = sample_plan();
    json["render"]["scene"] = "uper";
    EXPECT_EQ(
        refusal(json),
        "plan.json: render.scene: is \"uper\", which is none of \"upper\", \"full\", \"head\", \"dyad\", "
        "\"split\"; did you mean \"upper\"?");
    json = sample_plan();
    json["render"]["avatar"] = "manequin";
    EXPECT_THAT(refusal(json), StartsWith("plan.json: render.avatar: is \"manequin\", which is none of "));
    EXPECT_THAT(refusal(json), EndsWith("; did you mean \"mannequin\"?"));
}

TEST_F(ReadPlan, RefusesValuesOfAnotherKind) {
    Json json = sample_plan();
    json["title"] = 3;
    EXPECT_EQ(refusal(json), "plan.json: title: is 3, a text in quotes is needed");
    json["title"] = " ";
    EXPECT_EQ(refusal(json), "plan.json: title: is an empty text; fill it in or leave the key out");
    json["title"] = "a\nb";
    EXPECT_EQ(refusal(json), "plan.json: title: is \"a\\nb\", which has control characters; remove them");
    json = sample_plan();
    json["conditions"] = "ours";
    EXPECT_EQ(refusal(json), "plan.json: conditions: is \"ours\", a list in square brackets is needed");
    json = sample_plan();
    json["render"] = "nice";
    EXPECT_EQ(refusal(json), "plan.json: render: is \"nice\", an object in curly brackets is needed");
    json = sample_plan();
    json["clips"][0] = "nice";
    EXPECT_EQ(refusal(json), "plan.json: clips[0]: is \"nice\", an object in curly brackets is needed");
    json = sample_plan();
    json["orders"] = 2.5;
    EXPECT_EQ(refusal(json), "plan.json: orders: is 2.5, a whole number from 1 to 10000 is needed");
    EXPECT_EQ(refusal(Json::array({1, 2})), "plan.json: is [1,2], an object in curly brackets is needed");
}

TEST_F(ReadPlan, RefusesAnswersWithoutSides) {
    Json json = sample_plan();
    json["answers"] = {"a", "b", "c", "d"};
    EXPECT_EQ(refusal(json),
              "plan.json: answers: has 4 entries, 2 or an odd number from 3 to 9 are needed: from A clearly "
              "to B clearly");
    json["answers"] = {"a", "b", "c", "d", "e", "f"};
    EXPECT_EQ(refusal(json),
              "plan.json: answers: has 6 entries, 2 or an odd number from 3 to 9 are needed: from A clearly "
              "to B clearly");
}

TEST_F(ReadPlan, RefusesATextThatShowsParticipantsACondition) {
    for (const char* key : {"title", "question", "instructions"}) {
        Json json = sample_plan();
        json[key] = "Is Ours the best?";
        EXPECT_EQ(
            refusal(json),
            std::string("plan.json: ") + key +
                ": shows participants the name of the condition \"ours\"; write it without, or rename the condition");
    }
    Json json = sample_plan();
    json["answers"] = {"1", "2", "3", "4", "the baseline"};
    EXPECT_EQ(
        refusal(json),
        "plan.json: answers[4]: shows participants the name of the condition \"baseline\"; write it without, or rename the condition");
}

TEST_F(ReadPlan, RefusesWhatIsNoJson) {
    write_text(folder_ / "plan.json", "{\"title\": ");
    EXPECT_THAT(refusal_of([&] { read_plan(folder_ / "plan.json"); }), HasSubstr("plan.json:1:"));
}

TEST_F(ReadPlan, TakesThePartnersOfItsClips) {
    Json json = sample_plan();
    add_partners(json);
    write_text(folder_ / "bob.glb", "x");
    json["clips"][0]["partner"]["avatar"] = "bob.glb";
    json["clips"][1]["partner"] = {
        {"motion", "partner.bvh"}, {"hints", {{"up", "z"}}}, {"audio", "partner.wav"}};
    json["render"]["partner_side"] = "left";
    json["render"]["cue"] = "light";
    const Plan plan = read(json);
    ASSERT_TRUE(plan.clips[0].partner && plan.clips[1].partner);
    EXPECT_EQ(plan.clips[0].partner->motion, folder_ / "partner.bvh");
    EXPECT_EQ(plan.clips[0].partner->audio, folder_ / "partner.wav");
    EXPECT_EQ(plan.clips[0].partner->avatar, folder_ / "bob.glb");
    EXPECT_EQ(plan.clips[1].partner->avatar, "");
    EXPECT_EQ(plan.clips[1].partner->hints.up, UpAxis::z);
    EXPECT_TRUE(plan.render.partner_on_left);
    EXPECT_EQ(plan.render.cue, SpeakingCue::light);
    EXPECT_EQ(plan.questions[0].text,
              "In which video do the movements of the person on the right fit the conversation better?");
    EXPECT_THAT(plan.texts.instructions, HasSubstr("Please look at the person on the right."));
    // What was used is a plan again.
    const Json used = plan_as_used(plan);
    EXPECT_EQ(used["clips"][1]["partner"], json["clips"][1]["partner"]);
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(ReadPlan, AsksAboutThePersonOnTheLeftUnlessThePartnerStandsThere) {
    Json json = sample_plan();
    add_partners(json);
    for (Json& clip : json["clips"]) {
        clip.erase("audio");
        clip["partner"].erase("audio");
    }
    EXPECT_EQ(read(json).questions[0].text,
              "In which video does the person on the left move more like a real person?");
}

TEST_F(ReadPlan, RefusesPartnersThatCannotBeShown) {
    Json with_partners = sample_plan();
    add_partners(with_partners);

    Json json = with_partners;
    json["clips"][1].erase("partner");
    EXPECT_EQ(refusal(json),
              "plan.json: clips[1]: has no \"partner\" while clips[0] has one; give all clips "
              "a partner or none");
    json = with_partners;
    json["render"]["scene"] = "upper";
    EXPECT_EQ(refusal(json),
              "plan.json: clips: have a partner, but the scene \"upper\" shows 1 person; let "
              "render.scene be dyad or split");
    json = sample_plan();
    json["render"]["scene"] = "split";
    EXPECT_EQ(
        refusal(json),
        "plan.json: render.scene: \"split\" shows 2 people, but the clips have no partner; give each clip "
        "a \"partner\", or choose upper, full or head");
    json = with_partners;
    json["presentation"] = "one video";
    EXPECT_EQ(refusal(json),
              "plan.json: presentation: is \"one video\", where both conditions share a picture, "
              "but the clips have a partner; show \"two videos\"");
    json = with_partners;
    json["clips"][1]["partner"].erase("audio");
    json["render"]["cue"] = "light";
    EXPECT_EQ(refusal(json),
              "plan.json: render.cue: needs two voices in each clip; give every partner an "
              "\"audio\"");
    json = with_partners;
    for (Json& clip : json["clips"]) clip.erase("audio");
    EXPECT_EQ(refusal(json),
              "plan.json: clips[0].partner.audio: is the voice of the partner, and clip \"c1\" "
              "has no \"audio\" of the agent; give both or neither");
    json = with_partners;
    json["clips"][0]["partner"]["sound"] = "partner.wav";
    EXPECT_THAT(refusal(json), StartsWith("plan.json: clips[0].partner.sound: "));
    json = with_partners;
    json["clips"][0]["partner"].erase("motion");
    EXPECT_THAT(refusal(json), HasSubstr("clips[0].partner"));
    json = with_partners;
    json["render"]["partner_side"] = "behind";
    EXPECT_THAT(refusal(json), StartsWith("plan.json: render.partner_side: "));
}

Json plan_with_scale() {
    Json json = sample_plan();
    json["layout"] = "single";
    for (const char* id : {"friendly", "kind", "awful"})
        json["questions"].push_back({{"id", id}, {"kind", "rating"}, {"text", "?"}, {"points", 5}});
    json["scales"] = {
        {{"id", "likeability"}, {"items", {"friendly", "kind", "awful"}}, {"reversed", {"awful"}}}};
    return json;
}

TEST_F(ReadPlan, TakesScalesOfQuestions) {
    const Plan plan = read(plan_with_scale());
    ASSERT_EQ(plan.scales.size(), 1u);
    EXPECT_EQ(plan.scales[0].id, "likeability");
    EXPECT_THAT(plan.scales[0].items, ElementsAre(0, 1, 2));
    EXPECT_THAT(plan.scales[0].reversed, ElementsAre(false, false, true));
    EXPECT_EQ(plan_as_used(plan)["scales"], plan_with_scale()["scales"]);
}

TEST_F(ReadPlan, RefusesScalesWithoutOneScore) {
    const auto refused = [&](const std::function<void(Json&)>& change) {
        Json json = plan_with_scale();
        change(json);
        return refusal(json);
    };
    EXPECT_EQ(refused([](Json& json) {
                  json["questions"][1] = {{"id", "kind"}, {"kind", "text"}, {"text", "?"}};
              }),
              "plan.json: scales[0].items[1]: is \"kind\", which is no rating and no slider; leave it out");
    EXPECT_EQ(
        refused([](Json& json) { json["questions"][1]["points"] = 7; }),
        "plan.json: scales[0].items[1]: is \"kind\", a rating from 1 to 7, but \"friendly\" is a rating from 1 "
        "to 5; the items of a scale are rated alike");
    EXPECT_THAT(
        refused([](Json& json) { json["questions"][2]["each"] = true; }),
        HasSubstr(
            "is \"awful\", a rating from 1 to 5, of every video, but \"friendly\" is a rating from 1 to 5; "));
    EXPECT_THAT(refused([](Json& json) {
                    json["questions"][2] = {
                        {"id", "awful"}, {"kind", "slider"}, {"text", "?"}, {"least", 1}, {"most", 5}};
                }),
                HasSubstr("is \"awful\", a slider from 1 to 5, but \"friendly\" is a rating from 1 to 5; "));
    EXPECT_EQ(refused([](Json& json) { json["scales"][0]["items"][2] = "kind"; }),
              "plan.json: scales[0].items[2]: is \"kind\", which is an item already; name each once");
    EXPECT_EQ(
        refused([](Json& json) { json["scales"][0]["id"] = "kind"; }),
        "plan.json: scales[0].id: \"kind\" is already the id of a question or of a scale; give each its own");
    EXPECT_THAT(refused([](Json& json) { json["scales"].push_back(json["scales"][0]); }),
                HasSubstr("scales[1].id: \"likeability\" is already the id of a question or of a scale"));
    EXPECT_EQ(refused([](Json& json) { json["scales"][0]["id"] = "how kind"; }),
              "plan.json: scales[0].id: is \"how kind\"; use letters, digits, - and _");
    EXPECT_THAT(refused([](Json& json) { json["scales"][0]["items"] = {"kind"}; }),
                HasSubstr("scales[0].items: has 1 entries, at least 2"));
    EXPECT_THAT(refused([](Json& json) { json["scales"][0]["items"][0] = "freindly"; }),
                HasSubstr("did you mean \"friendly\"?"));
    EXPECT_THAT(refused([](Json& json) {
                    json["scales"][0]["items"] = {"friendly", "kind"};
                }),
                HasSubstr("scales[0].reversed[0]: is \"awful\""));
    EXPECT_EQ(
        refused([](Json& json) {
            json["passes"] = {{{"sound", false}, {"questions", {"friendly", "kind"}}},
                              {{"questions", {"awful"}}}};
        }),
        "plan.json: scales[0].items: has \"friendly\" and \"awful\", which are asked in different passes; ask "
        "all items of a scale in one");
}

std::set<std::string> as_set(const std::vector<std::string>& names) {
    return {names.begin(), names.end()};
}

// The published schema and the reader know the same keys, objects and required keys.
TEST(PlanSchema, HasTheKeysOfTheReader) {
    const Json schema = read_json(testing::source_dir() / "study/plan/plan.schema.json");
    const Json& all = schema["properties"];
    const std::map<std::string, Json> objects = {
        {"", schema},
        {"conditions[]", all["conditions"]["items"]["anyOf"][1]},
        {"render", all["render"]},
        {"hints.*", all["hints"]["additionalProperties"]},
        {"modes.*", all["modes"]["additionalProperties"]},
        {"clips[]", all["clips"]["items"]},
        {"clips[].partner", all["clips"]["items"]["properties"]["partner"]},
        {"questions[]", all["questions"]["items"]},
        {"scales[]", all["scales"]["items"]},
        {"passes[]", all["passes"]["items"]},
        {"checks", all["checks"]},
        {"exclusions", all["exclusions"]},
        {"completion", all["completion"]},
        {"preregistration", all["preregistration"]}};
    EXPECT_EQ(plan_keys().size(), objects.size());
    for (const PlanKeys& known : plan_keys()) {
        const Json& object = objects.at(known.object);
        std::set<std::string> described;
        for (const auto& [name, value] : object["properties"].items()) described.insert(name);
        EXPECT_EQ(described, as_set(known.keys)) << known.object;
        EXPECT_EQ(as_set(object["required"].get<std::vector<std::string>>()), as_set(known.required));
        EXPECT_EQ(object["additionalProperties"], false);
    }
}

// What the schema says of a value is what the reader says: each choice and each default is taken.
TEST_F(ReadPlan, TakesTheChoicesAndDefaultsOfTheSchema) {
    const Json properties = read_json(testing::source_dir() / "study/plan/plan.schema.json")["properties"];
    for (const char* key : {"layout", "presentation"}) {
        for (const Json& choice : properties[key]["enum"]) {
            Json json = sample_plan();
            json[key] = choice;
            if (choice == "triplet") {
                json["conditions"].push_back({{"name", "still"}, {"from", "ours"}, {"by", "frozen"}});
                json["reference"] = "ours";
            }
            EXPECT_NO_THROW(read(json)) << key << " " << choice;
        }
    }
    Json with_defaults = sample_plan();
    with_defaults["render"] = Json::object();
    Json without = with_defaults;
    for (const auto& [key, schema] : properties["render"]["properties"].items()) {
        with_defaults["render"][key] = schema["default"];
        for (const Json& choice : schema.value("enum", Json::array())) {
            Json json = sample_plan();
            json["render"][key] = choice;
            if (key == "cue") add_partners(json);
            EXPECT_NO_THROW(read(json)) << key << " " << choice;
        }
    }
    EXPECT_EQ(plan_as_used(read(with_defaults)), plan_as_used(read(without)));
}

}  // namespace
}  // namespace chironomia::study
