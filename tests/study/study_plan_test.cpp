// What a plan says of the study around the clips: conditions that are made, layouts, questions, who takes
// part.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "study/build/composition.h"
#include "study/build/inputs.h"
#include "study/plan/attention.h"
#include "study/plan/plan.h"
#include "study/plan/presets.h"
#include "tests/study/sample_plan.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::refusal_of;
using testing::sample_plan;
using ::testing::SizeIs;
using ::testing::StartsWith;
using testing::TemporaryFolder;

class StudyPlan : public ::testing::Test {
  protected:
    StudyPlan() { testing::write_sample_inputs(folder_.path()); }

    Plan read(const Json& json) {
        write_json(folder_ / "plan.json", json);
        return read_plan(folder_ / "plan.json");
    }

    // The message without the name of the folder.
    std::string refusal(const Json& json) {
        const std::string folder = folder_.path().string() + "/";
        const std::string message = refusal_of([&] { read(json); });
        return message.starts_with(folder) ? message.substr(folder.size()) : message;
    }

    // The sample plan with some keys set.
    std::string refusal_with(const Json& keys) {
        Json json = sample_plan();
        json.update(keys);
        return refusal(json);
    }

    Plan read_with(const Json& keys) {
        Json json = sample_plan();
        json.update(keys);
        return read(json);
    }

    TemporaryFolder folder_;
};

const Json kRating = {{"id", "natural"}, {"kind", "rating"}, {"text", "How natural?"}, {"points", 7}};

TEST_F(StudyPlan, MakesConditionsOfOthers) {
    const Plan plan = read_with({{"conditions",
                                  {"ours",
                                   {{"name", "late"}, {"from", "ours"}, {"by", "delayed"}, {"ms", 400}},
                                   "baseline",
                                   {{"name", "off"}, {"from", "baseline"}, {"by", "mismatched speech"}}}}});
    EXPECT_THAT(condition_names(plan), ElementsAre("ours", "late", "baseline", "off"));
    EXPECT_EQ(plan.conditions[1].making, Making::anchor);
    EXPECT_EQ(plan.conditions[1].from, 0u);
    EXPECT_EQ(plan.conditions[1].anchor, (Degradation{.kind = DegradationKind::delayed, .amount = 400}));
    EXPECT_EQ(plan.conditions[3].making, Making::mismatched_speech);
    EXPECT_EQ(plan.conditions[3].from, 2u);
    EXPECT_EQ(name_of_making(plan.conditions[1]), "delayed:400");
    EXPECT_TRUE(has_mismatch(plan));
    EXPECT_THAT(plan.clips[0].motions, ElementsAre(folder_ / "ours/c1.bvh", "", folder_ / "base/c1.bvh", ""));
    const Json used = plan_as_used(plan);
    EXPECT_EQ(used["conditions"][1],
              (Json{{"name", "late"}, {"from", "ours"}, {"by", "delayed"}, {"ms", 400.0}}));
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(StudyPlan, KnowsEveryWayToMakeACondition) {
    for (const Json& making :
         {Json{{"by", "mismatched motion"}}, Json{{"by", "frozen"}}, Json{{"by", "mirrored"}},
          Json{{"by", "damped"}, {"factor", 0.5}}, Json{{"by", "jittered"}, {"degrees", 3}}}) {
        Json made = {{"name", "made"}, {"from", "ours"}};
        made.update(making);
        const Json used = plan_as_used(read_with({{"conditions", {"ours", "baseline", made}}}));
        for (const auto& [key, value] : making.items())
            EXPECT_EQ(used["conditions"][2][key], value) << making;
    }
}

TEST_F(StudyPlan, RefusesConditionsThatCannotBeMade) {
    const auto refused = [&](const Json& made) {
        return refusal_with({{"conditions", {"ours", "baseline", made}}});
    };
    EXPECT_EQ(
        refused({{"name", "x"}, {"from", "our"}, {"by", "frozen"}}),
        "plan.json: conditions[2].from: is \"our\", which is none of \"ours\", \"baseline\"; did you mean "
        "\"ours\"?");
    EXPECT_THAT(refused({{"name", "x"}, {"from", "ours"}, {"by", "frosen"}}),
                HasSubstr("; did you mean \"frozen\"?"));
    EXPECT_EQ(refused({{"name", "x"}, {"from", "ours"}, {"by", "delayed"}}),
              "plan.json: conditions[2].ms: is missing; add it");
    EXPECT_EQ(refused({{"name", "x"}, {"from", "ours"}, {"by", "damped"}, {"factor", 2}}),
              "plan.json: conditions[2].factor: is 2, a number from 0 to 0.999 is needed");
    EXPECT_EQ(refused({{"name", "OURS"}, {"from", "ours"}, {"by", "frozen"}}),
              "plan.json: conditions[2]: \"OURS\" is already conditions[0]; give each its own name");
}

TEST_F(StudyPlan, GivesEachConditionATwinThatDoesNotFit) {
    const Plan plan = read_with({{"mismatched", "speech"}});
    EXPECT_THAT(condition_names(plan),
                ElementsAre("ours", "baseline", "ours (mismatched)", "baseline (mismatched)"));
    EXPECT_THAT(plan.groups, ElementsAre(ElementsAre(0, 2), ElementsAre(1, 3)));
    const Json used = plan_as_used(plan);
    EXPECT_EQ(plan_as_used(read(used)), used);
}

TEST_F(StudyPlan, RefusesMismatchesThatCannotBeHeard) {
    Json silent = sample_plan();
    for (Json& clip : silent["clips"]) clip.erase("audio");
    silent["mismatched"] = "speech";
    EXPECT_EQ(refusal(silent),
              "plan.json: clips: have no sound that participants hear, but a condition is mismatched; give "
              "every clip an \"audio\"");
    EXPECT_THAT(refusal_with({{"silent", true}, {"mismatched", "motion"}}), HasSubstr("have no sound"));
    EXPECT_EQ(
        refusal_with({{"presentation", "one video"}, {"mismatched", "speech"}}),
        "plan.json: presentation: is \"one video\", where both conditions share a sound, but one of them is "
        "mismatched; show \"two videos\"");
    Json together = sample_plan();
    for (Json& clip : together["clips"]) clip["partner"] = {{"motion", "base/c1.bvh"}};
    together["render"]["scene"] = "dyad";
    together["mismatched"] = "speech";
    EXPECT_THAT(refusal(together), HasSubstr("make it by \"mismatched motion\""));
    together["mismatched"] = "motion";
    EXPECT_NO_THROW(read(together));
}

// Motions and sounds are read as the study is built, which may be hours later.
TEST_F(StudyPlan, RefusesMismatchesOfClipsThatHaveNoOther) {
    Json json = sample_plan();
    json["mismatched"] = "motion";
    json["clips"][1]["speaker"] = "ann";
    EXPECT_EQ(
        refusal(json),
        "plan.json: clips[0]: (\"c1\") is the only one without a \"speaker\", and a mismatched condition "
        "shows it with another one; add clips");
    json["clips"][0]["speaker"] = "bob";
    EXPECT_THAT(refusal(json), HasSubstr("clips[1]: (\"c2\") is the only one of speaker \"ann\""));
    json["clips"][0]["speaker"] = "ann";
    json["clips"][0]["cut"] = {0, 1};
    EXPECT_NO_THROW(read(json)) << "nobody knows yet how long the other one is";
    json["clips"][1]["cut"] = {0, 1.5};
    EXPECT_EQ(
        refusal(json),
        "mismatch: speaker \"ann\" has too few other clips whose lengths are within 10 % of \"c2\" (1.50 "
        "s); allow a tolerance of 33.4 %, or add clips of about this length");
    json["length_tolerance"] = 0.34;
    EXPECT_NO_THROW(read(json));
}

TEST_F(StudyPlan, ShowsWhatTheLayoutSays) {
    EXPECT_THAT(read_with({{"layout", "single"}}).groups, ElementsAre(ElementsAre(0), ElementsAre(1)));
    EXPECT_THAT(read_with({{"layout", "parallel"}}).groups, ElementsAre(ElementsAre(0, 1)));
    const Json three = {"ours", "baseline", {{"name", "still"}, {"from", "ours"}, {"by", "frozen"}}};
    const Plan triplet = read_with({{"layout", "triplet"}, {"conditions", three}, {"reference", "baseline"}});
    EXPECT_EQ(triplet.reference, 1u);
    EXPECT_THAT(triplet.groups, ElementsAre(ElementsAre(0, 1, 2)));
    EXPECT_THAT(read_with({{"conditions", three}, {"compare", "made"}}).groups,
                ElementsAre(ElementsAre(0, 2)));
    const Json listed_pairs = Json::parse(R"([["still", "ours"], ["baseline", "ours"]])");
    const Plan listed = read_with({{"conditions", three}, {"compare", listed_pairs}, {"sides", "fixed"}});
    EXPECT_THAT(listed.groups, ElementsAre(ElementsAre(2, 0), ElementsAre(1, 0)));
    EXPECT_TRUE(listed.fixed_sides);
    EXPECT_EQ(plan_as_used(read(plan_as_used(listed))), plan_as_used(listed));
}

TEST_F(StudyPlan, RefusesWhatTheLayoutHasNoUseFor) {
    EXPECT_EQ(refusal_with({{"layout", "single"}, {"compare", "all"}}),
              "plan.json: compare: is of use for the layouts \"pair\" and \"triplet\" alone");
    EXPECT_EQ(refusal_with({{"reference", "ours"}}),
              "plan.json: reference: is of use for the layout \"triplet\" alone");
    EXPECT_EQ(refusal_with({{"layout", "single"}, {"mismatched", "speech"}}),
              "plan.json: mismatched: is of use for the layout \"pair\" alone; make a condition with \"by\" "
              "for others");
    EXPECT_EQ(refusal_with({{"layout", "single"}, {"presentation", "one video"}}),
              "plan.json: presentation: is \"one video\", which only a \"pair\" can have");
    EXPECT_EQ(refusal_with({{"sides", "fixed"}}),
              "plan.json: sides: is \"fixed\", which needs the layout \"pair\" and \"compare\" with a list "
              "of pairs");
    EXPECT_EQ(refusal_with({{"layout", "triplet"}}), "plan.json: reference: is missing; add it");
    EXPECT_EQ(refusal_with({{"layout", "triplet"}, {"reference", "ours"}}),
              "plan.json: conditions: has 2 entries, at least 3 are needed for this layout");
    EXPECT_EQ(
        refusal_with({{"compare", "made"}}),
        "plan.json: compare: is \"made\", but no condition is made of another; add one, or compare \"all\"");
    EXPECT_EQ(refusal_with({{"compare", Json::parse(R"([["ours", "ours"]])")}}),
              "plan.json: compare[0][1]: \"ours\" stands twice on one page");
    EXPECT_EQ(refusal_with({{"compare", Json::parse(R"([["ours", "baseline", "ours"]])")}}),
              "plan.json: compare[0][2]: \"ours\" stands twice on one page");
    Json nine = sample_plan();
    nine["layout"] = "parallel";
    for (int i = 0; i < 7; ++i)
        nine["conditions"].push_back(
            {{"name", "still " + std::to_string(i)}, {"from", "ours"}, {"by", "frozen"}});
    EXPECT_EQ(refusal(nine), "plan.json: conditions: has 9 entries, at most 8 are needed for this layout");
}

TEST_F(StudyPlan, ReadsQuestionsOfEveryKind) {
    const Json option_a = {{"id", "a"}, {"text", "An A"}}, option_b = {{"id", "b"}, {"text", "A B"}};
    const Json questions = {
        {{"id", "p"},
         {"kind", "preference"},
         {"text", "Which?"},
         {"answers", {"left", "same", "right"}},
         {"reasons",
          {{"text", "Why?"}, {"options", {option_a, option_b}}, {"other", "Else"}, {"unless", 2}}}},
        {{"id", "r"},
         {"kind", "rating"},
         {"text", "How?"},
         {"points", 5},
         {"labels", {{"1", "no"}, {"5", "yes"}}}},
        {{"id", "s"},
         {"kind", "slider"},
         {"text", "How much?"},
         {"least", 0},
         {"most", 10},
         {"labels", {"much", "little"}},
         {"each", true}},
        {{"id", "c"}, {"kind", "choice"}, {"text", "What?"}, {"options", {option_a, option_b}}},
        {{"id", "k"}, {"kind", "rank"}, {"text", "In which order?"}, {"of_videos", true}},
        {{"id", "t"}, {"kind", "text"}, {"text", "Anything else?"}, {"optional", true}},
        {{"id", "n"}, {"kind", "number"}, {"text", "How many?"}, {"least", 0}, {"most", 9}}};
    const Plan plan = read_with({{"questions", questions}});
    ASSERT_THAT(plan.questions, SizeIs(7));
    for (std::size_t i = 0; i < 7; ++i) {
        const Json written = to_json(plan.questions[i]);
        for (const auto& [key, value] : questions[i].items()) EXPECT_EQ(written[key], value) << key;
        EXPECT_EQ(written.size(), questions[i].size());
    }
    EXPECT_THAT(plan.passes, SizeIs(1));
    EXPECT_THAT(plan.passes[0].questions, SizeIs(7));
}

TEST_F(StudyPlan, RefusesQuestionsThatCannotBeAsked) {
    const auto refused = [&](Json question, const Json& keys) {
        question.update(keys);
        return refusal_with({{"questions", Json::array({question})}});
    };
    EXPECT_EQ(refused(kRating, {{"id", "how natural"}}),
              "plan.json: questions[0].id: is \"how natural\"; use letters, digits, - and _");
    EXPECT_THAT(refused(kRating, {{"kind", "ratings"}}), HasSubstr("did you mean \"rating\"?"));
    EXPECT_EQ(refused(kRating, {{"points", 1}}),
              "plan.json: questions[0].points: is 1, a whole number from 2 to 11 is needed");
    EXPECT_THAT(refused(kRating, {{"labels", {{"8", "x"}}}}), HasSubstr("labels.8: there is no such key"));
    EXPECT_THAT(refused(kRating, {{"answers", {"a", "b", "c"}}}), HasSubstr("answers: there is no such key"));
    EXPECT_EQ(refused(kRating, {{"optional", "yes"}}),
              "plan.json: questions[0].optional: is \"yes\", true or false is needed");
    EXPECT_EQ(
        refused(kRating, {{"text", "Is ours natural?"}}),
        "plan.json: questions[0]: shows participants the name of the condition \"ours\"; write it without, or rename the condition");
    const Json slider = {{"id", "s"}, {"kind", "slider"}, {"text", "How?"}};
    EXPECT_EQ(refused(slider, {{"least", 5}, {"most", 5}}),
              "plan.json: questions[0].most: is 5, more than \"least\", which is 5, is needed");
    const Json choice = {{"id", "c"}, {"kind", "choice"}, {"text", "What?"}};
    EXPECT_EQ(refused(choice, Json::object()),
              "plan.json: questions[0]: needs \"options\", or \"of_videos\": true, and not both");
    EXPECT_EQ(refused(choice, {{"options", {{{"id", "a"}, {"text", "A"}}, {{"id", "a"}, {"text", "B"}}}}}),
              "plan.json: questions[0].options[1].id: \"a\" is already the id of questions[0].options[0]; "
              "give each its own");
    const Json preference = {{"id", "p"}, {"kind", "preference"}, {"text", "Which?"}};
    EXPECT_EQ(refused(preference, {{"answers", {"a", "a"}}}),
              "plan.json: questions[0].answers[1]: \"a\" is already questions[0].answers[0]; give each its "
              "own text");
    EXPECT_EQ(
        refused(preference, {{"answers", {"a", "b", "c", "d"}}}),
        "plan.json: questions[0].answers: has 4 entries, 2 or an odd number from 3 to 9 are needed: from A "
        "clearly to B clearly");
    EXPECT_EQ(refusal_with({{"questions", {kRating, kRating}}}),
              "plan.json: questions[1].id: \"natural\" is already the id of questions[0]; give each its own");
    EXPECT_EQ(
        refusal_with({{"questions", {kRating}}, {"question", "Which?"}}),
        "plan.json: question: is the short form of \"questions\", which are given too; keep one of them");
    EXPECT_EQ(refusal_with({{"layout", "single"}, {"answers", {"a", "b", "c"}}}),
              "plan.json: answers: are of use for a pair or a triplet alone; write \"questions\"");
    EXPECT_EQ(refusal_with({{"answers", {"a", "b", "a"}}}),
              "plan.json: answers[2]: \"a\" is already answers[0]; give each its own text");
}

TEST_F(StudyPlan, RefusesQuestionsThatTheLayoutCannotAnswer) {
    const Json preference = {
        {"id", "p"}, {"kind", "preference"}, {"text", "Which?"}, {"answers", {"a", "b", "c"}}};
    EXPECT_EQ(
        refusal_with({{"layout", "single"}, {"questions", {preference}}}),
        "plan.json: questions[0]: \"p\" compares videos, but the layout \"single\" shows one; ask a rating");
    Json each = kRating;
    each["each"] = true;
    EXPECT_EQ(refusal_with({{"presentation", "one video"}, {"questions", {each}}}),
              "plan.json: questions[0]: \"natural\" is of each video, but one video shows both figures");
}

TEST_F(StudyPlan, ShowsAPageInPasses) {
    Json fit = kRating;
    fit["id"] = "fit";
    const Json passes = {{{"sound", false}, {"questions", {"natural"}}}, {{"questions", {"fit"}}}};
    const Plan plan = read_with({{"questions", {kRating, fit}}, {"passes", passes}});
    ASSERT_THAT(plan.passes, SizeIs(2));
    EXPECT_FALSE(plan.passes[0].sound);
    EXPECT_TRUE(plan.passes[1].sound);
    EXPECT_THAT(plan.passes[1].questions, ElementsAre(1));
    EXPECT_EQ(plan_as_used(read(plan_as_used(plan))), plan_as_used(plan));
    EXPECT_THAT(refusal_with({{"questions", {kRating}}, {"passes", {{{"questions", {"naturel"}}}}}}),
                HasSubstr("did you mean \"natural\"?"));
    EXPECT_EQ(refusal_with({{"silent", true},
                            {"questions", {kRating}},
                            {"passes", {{{"sound", true}, {"questions", {"natural"}}}}}}),
              "plan.json: passes[0].sound: is true, but the clips have no sound");
}

TEST_F(StudyPlan, ReadsWhoTakesPart) {
    const Plan plan =
        read_with({{"participants", 40}, {"blocks", 2}, {"pages_per_participant", 1}, {"orders", 8}});
    EXPECT_EQ(plan.participants.wanted, 40u);
    EXPECT_EQ(plan.participants.blocks, 2u);
    EXPECT_EQ(plan.participants.pages_each, 1u);
    EXPECT_EQ(plan.participants.orders, 8u);
    Json placed = sample_plan();
    placed["clips"][0]["block"] = 1;
    EXPECT_EQ(
        refusal(placed),
        "plan.json: clips[1]: has no \"block\" while clips[0] has one; give all clips their block or none");
    placed["clips"][1]["block"] = 0;
    EXPECT_EQ(read(placed).participants.blocks, 2u);
    placed["blocks"] = 1;
    EXPECT_EQ(refusal(placed), "plan.json: blocks: is 1, but a clip stands in block 1; blocks count from 0");
    EXPECT_EQ(refusal_with({{"blocks", 3}}), "plan.json: blocks: is 3, a whole number from 1 to 2 is needed");
    EXPECT_EQ(refusal_with({{"pages_per_participant", 3}}),
              "plan.json: pages_per_participant: is 3, a whole number from 1 to 2 is needed");
}

TEST_F(StudyPlan, KeepsPracticeOutOfTheTrials) {
    Json json = sample_plan();
    json["clips"][1]["practice"] = true;
    const Plan plan = read(json);
    const Composition all = compose(plan, 3);
    EXPECT_THAT(all.judged, ElementsAre(0));
    ASSERT_THAT(all.practice, SizeIs(1));
    EXPECT_EQ(all.pages[all.practice[0]].clip, 1u);
    for (const Sheet& sheet : all.sheets) {
        for (const Showing& shown : sheet.pages) EXPECT_NE(shown.page, all.practice[0]);
    }
    json["clips"][0]["practice"] = true;
    EXPECT_EQ(refusal(json),
              "plan.json: clips: are all for practice; leave \"practice\" out of those that are judged");
}

TEST_F(StudyPlan, RefusesASampleThatWouldNeverShowSomePages) {
    const auto compose_for = [&](std::size_t participants) {
        compose(read_with({{"participants", participants}, {"pages_per_participant", 1}}), 1);
    };
    const std::string message = refusal_of([&] { compose_for(1); });
    const std::string begin =
        (folder_ / "plan.json").string() +
        ": 1 participant sees 1 pages together, 1 of them different, so 1 of the 2 pages would never be shown; let "
        "\"participants\" be ";
    ASSERT_THAT(message, ::testing::StartsWith(begin));
    // The least number that would do.
    const std::size_t enough = std::stoul(message.substr(begin.size()));
    EXPECT_GE(enough, 2u);
    compose_for(enough);
    for (std::size_t fewer = 2; fewer < enough; ++fewer)
        EXPECT_THAT(refusal_of([&] { compose_for(fewer); }), ::testing::HasSubstr("would never be shown"));
}

// Ten participants of 24 pages: those of the first ten rows of 24 would see some pages at 4.5 on average, others at 18.5.
TEST_F(StudyPlan, LetsNoPageComeEarlyForAllOfFewParticipants) {
    Json json = sample_plan();
    json["layout"] = "single";
    json["participants"] = 10;
    for (std::size_t i = 3; i <= 12; ++i) {
        json["clips"].push_back(json["clips"][0]);
        json["clips"].back()["id"] = format("c{}", i);
    }
    const Composition all = compose(read(json), 3);
    ASSERT_THAT(all.sheets, SizeIs(10));
    std::vector<std::size_t> sum(24);
    for (const Sheet& sheet : all.sheets) {
        for (std::size_t at = 0; at < 24; ++at) sum[sheet.pages[at].page] += at;
    }
    EXPECT_THAT(sum, ::testing::Each(115)) << "11.5 each";
    json["orders"] = 24;
    EXPECT_THAT(compose(read(json), 3).sheets, SizeIs(24)) << "as the plan says";
}

TEST_F(StudyPlan, ReadsCutsOfClips) {
    Json json = sample_plan();
    json["clips"][0]["cut"] = {0.5, 2};
    const Plan plan = read(json);
    EXPECT_EQ(plan.clips[0].cut->begin, 0.5);
    EXPECT_EQ(plan.clips[0].cut->end, 2);
    for (const auto& [cut, message] :
         {std::pair<Json, std::string>{{1}, "has 1 entries, at least 2 are needed"},
          {{1, 2, 3}, "is [1,2,3], a begin and an end in seconds are needed"},
          {{2, 2}, "is [2,2], the end must be later than the begin"}}) {
        json["clips"][0]["cut"] = cut;
        EXPECT_EQ(refusal(json), "plan.json: clips[0].cut: " + message);
    }
    json["clips"][0]["cut"] = {-1, 2};
    EXPECT_EQ(refusal(json), "plan.json: clips[0].cut[0]: is -1, a number from 0 to 36000 is needed");
}

TEST_F(StudyPlan, ReadsWhichChecksAreAmongTheFirstPages) {
    const std::pair<Json, EarlyChecks> cases[] = {
        {true, EarlyChecks::first}, {false, EarlyChecks::none}, {"all", EarlyChecks::all}};
    for (const auto& [at, early] : cases) {
        const Plan plan = read_with({{"checks", {{"count", 2}, {"at_beginning", at}}}});
        EXPECT_EQ(plan.checks.at_beginning, early);
        EXPECT_EQ(plan_as_used(plan)["checks"]["at_beginning"], at);
    }
    EXPECT_EQ(refusal_with({{"checks", {{"count", 2}, {"at_beginning", "both"}}}}),
              "plan.json: checks.at_beginning: is \"both\", true, false or \"all\" is needed");
}

TEST_F(StudyPlan, ReadsChecksRulesAndCompletion) {
    const Plan plan =
        read_with({{"checks", {{"count", 2}, {"kinds", {"text", "audio"}}, {"at_beginning", false}}},
                   {"exclusions", {{"failed_checks", 2}, {"fastest_seconds", 3}}},
                   {"completion", {{"url", "https://example.org/done"}, {"shown_by", "server"}}},
                   {"skip_after", 5},
                   {"shuffle_questions", true}});
    EXPECT_EQ(plan.checks.count, 2u);
    EXPECT_EQ(plan.checks.at_beginning, EarlyChecks::none);
    EXPECT_EQ(plan.exclusions.failed_checks, 2);
    EXPECT_EQ(plan.exclusions.fastest_seconds, 3);
    EXPECT_TRUE(plan.completion.by_server);
    EXPECT_EQ(plan.skip_after, 5);
    EXPECT_EQ(plan_as_used(read(plan_as_used(plan))), plan_as_used(plan));
    EXPECT_EQ(
        refusal_with({{"silent", true}, {"checks", {{"count", 1}, {"kinds", {"audio"}}}}}),
        "plan.json: checks.kinds[0]: is \"audio\", but the clips have no sound that participants hear; use "
        "\"text\"");
    const Json passes = {{{"sound", false}, {"questions", {"natural"}}}, {{"questions", {"natural"}}}};
    EXPECT_EQ(
        refusal_with(
            {{"questions", {kRating}}, {"passes", passes}, {"checks", {{"count", 1}, {"kinds", {"audio"}}}}}),
        "plan.json: checks.kinds[0]: is \"audio\", but a pass is silent, where nobody hears it; use "
        "\"text\"");
    EXPECT_EQ(refusal_with({{"checks", {{"count", 1}, {"instruction", "Choose B."}}}}),
              "plan.json: checks.instruction: is \"Choose B.\", which lacks {answer}, where the answer to "
              "give stands");
    EXPECT_EQ(
        refusal_with(
            {{"questions", {{{"id", "t"}, {"kind", "text"}, {"text", "Why?"}}}}, {"checks", {{"count", 1}}}}),
        "plan.json: checks: no question has an answer that a check can ask for; ask a preference, a rating, "
        "a slider or a choice of options");
    EXPECT_EQ(refusal_with({{"silent", true}, {"sound_check", true}}),
              "plan.json: sound_check: is true, but the clips have no sound");
    EXPECT_EQ(refusal_with({{"render", {{"loudness", "loud"}}}}),
              "plan.json: render.loudness: is \"loud\", a number of LUFS from -40 to -10 or \"as recorded\" "
              "is needed");
}

// ---- Attention checks

// A participant who leaves it open would neither pass nor fail.
TEST_F(StudyPlan, RefusesAttentionChecksThatNobodyNeedAnswer) {
    Json open = kRating, same = kRating;
    open["optional"] = true;
    same["id"] = "same";
    same["optional"] = true;
    EXPECT_EQ(
        refusal_with({{"questions", {open}}, {"checks", {{"count", 1}}}}),
        "plan.json: checks: expects an answer to \"natural\", which is optional, so that a participant who leaves "
        "it open would neither pass nor fail; remove \"optional\" from it, or give it a set of answers that "
        "differs from that of the first question that checks ask for");
    EXPECT_THAT(refusal_with({{"questions", {kRating, same}}, {"checks", {{"count", 1}}}}),
                HasSubstr("checks: expects an answer to \"same\", which is optional"));
    same["points"] = 5;
    EXPECT_NO_THROW(read_with({{"questions", {kRating, same}}, {"checks", {{"count", 1}}}}));
    EXPECT_NO_THROW(read_with({{"questions", {open}}, {"checks", {{"count", 0}}}}));
    EXPECT_EQ(
        refusal_with({{"questions", {kRating, same}},
                      {"passes", {{{"questions", {"same"}}}}},
                      {"checks", {{"count", 1}}}}),
        "plan.json: checks: expects an answer to \"natural\", which no pass asks; add it to one of \"passes\", or "
        "remove it");
}

TEST_F(StudyPlan, PutsEveryCheckOnEverySheet) {
    Json json = sample_plan();
    json["checks"] = {{"count", 3}, {"kinds", {"text"}}};
    const Composition all = compose(read(json), 2);
    for (const Sheet& sheet : all.sheets) {
        std::vector<std::size_t> at;
        for (std::size_t i = 0; i < sheet.pages.size(); ++i) {
            if (all.pages[sheet.pages[i].page].kind == PageKind::check) at.push_back(i);
        }
        ASSERT_THAT(at, SizeIs(3));
        EXPECT_LE(at[0], 2u);
    }
    std::size_t left = 0, right = 0;
    for (const PlannedPage& page : all.pages) {
        if (page.kind != PageKind::check) continue;
        (page.notice->place == 0 ? left : right) += 1;
        EXPECT_EQ(page.expected.size(), 1u);
    }
    EXPECT_EQ(left, 2u);
    EXPECT_EQ(right, 1u);
}

TEST_F(StudyPlan, GivesTheAnswerThatACheckExpects) {
    const Plan plan = read_with({{"checks", {{"count", 1}}}});
    AttentionCheck check = make_check(plan, 0, 0, 2);
    EXPECT_EQ(check.instruction, "Attention check: on this page, please answer “B is slightly better”.");
    EXPECT_EQ(check.expected, Json({{"preference", 4}}));
    EXPECT_EQ(make_check(plan, 1, 0, 2).expected, Json({{"preference", 2}}));

    Json fit = kRating;
    fit["id"] = "fit";
    const Plan ratings = read_with({{"layout", "single"},
                                    {"questions", {kRating, fit}},
                                    {"language", "fr"},
                                    {"checks", {{"count", 1}}}});
    check = make_check(ratings, 1, 0, 1);
    EXPECT_EQ(check.instruction, "Test d’attention : sur cette page, veuillez répondre « 2 ».");
    EXPECT_EQ(check.expected, Json({{"natural", 2}, {"fit", 2}}));

    const Plan sliders = read_with({{"layout", "parallel"}, {"checks", {{"count", 1}}}});
    check = make_check(sliders, 0, 1, 2);
    EXPECT_EQ(check.instruction, "Attention check: please give this video the value 75.");
    EXPECT_EQ(check.expected, Json({{"rating", {nullptr, 75}}}));
}

// ---- Languages

TEST_F(StudyPlan, SpeaksFrench) {
    const Plan plan = read_with({{"language", "fr"}});
    EXPECT_EQ(plan.questions[0].text,
              "Dans quelle vidéo les mouvements du personnage vont‑ils mieux avec ce qu’il dit ?");
    EXPECT_EQ(plan.questions[0].answers[2], "Elles se valent");
    EXPECT_THAT(plan.texts.instructions, StartsWith("Chaque page montre deux vidéos"));
}

TEST_F(StudyPlan, AsksForTheTextsOfOtherLanguages) {
    EXPECT_EQ(refusal_with({{"language", "de"}}),
              "plan.json: language: is \"de\", and the program's own texts are in en and fr alone; write "
              "\"questions\" too");
    EXPECT_THAT(refusal_with({{"language", "de"}, {"questions", {kRating}}}),
                HasSubstr("write \"instructions\" too"));
    EXPECT_THAT(refusal_with({{"language", "de"}, {"questions", {kRating}}, {"instructions", "Bitte."}}),
                HasSubstr("write \"texts\" too"));
    EXPECT_NO_THROW(read_with({{"language", "de"},
                               {"questions", {kRating}},
                               {"instructions", "Bitte."},
                               {"texts", {{"next", "Weiter"}}}}));
    EXPECT_THAT(refusal_with({{"language", "de"},
                              {"questions", {kRating}},
                              {"instructions", "Bitte."},
                              {"texts", {{"next", "Weiter"}}},
                              {"checks", {{"count", 1}}}}),
                HasSubstr("checks: has no \"instruction\", which the program can say in en and fr alone; "
                          "write it in \"de\""));
    EXPECT_EQ(refusal_with({{"language", "d"}}),
              "plan.json: language: is \"d\", a language tag such as \"en\" or \"pt-BR\" is needed");
    EXPECT_EQ(
        refusal_with({{"texts", {{"next", "To ours"}}}}),
        "plan.json: texts.next: shows participants the name of the condition \"ours\"; write it without, or rename the condition");
}

TEST_F(StudyPlan, KnowsTheNamesOfThePagesTexts) {
    EXPECT_NO_THROW(read_with({{"texts", {{"pages.one", "1"}, {"pages.few", "2"}, {"agree", "Zgoda"}}}}));
    EXPECT_EQ(refusal_with({{"texts", {{"nxt", "Dalej"}}}}),
              "plan.json: texts.nxt: there is no such key; did you mean \"next\"?");
}

TEST_F(StudyPlan, WarnsOfTextsInEnglishAndOfConditionsThatAreTheSame) {
    EXPECT_THAT(plan_warnings(read_with(Json::object())), IsEmpty());
    const Plan german = read_with({{"language", "de"},
                                   {"questions", {kRating}},
                                   {"instructions", "Bitte."},
                                   {"texts", {{"next", "Weiter"}, {"pages.other", "{n} Seiten"}}}});
    EXPECT_THAT(plan_warnings(german),
                ElementsAre(HasSubstr("texts of the page are left in English, such as \"agree\""),
                            HasSubstr("\"natural\" is asked once of all videos")));
    Json clips = sample_plan()["clips"];
    clips[1]["motion"]["baseline"] = clips[1]["motion"]["ours"];
    EXPECT_THAT(plan_warnings(read_with({{"clips", clips}})),
                ElementsAre(HasSubstr(
                    "\"ours\" and \"baseline\" show the same in 1 of 2 clips, such as ours/c2.bvh")));
}

// One form may be about one number alone, and a list of paragraphs is one text.
TEST_F(StudyPlan, WarnsOfTextsWithoutWhatThePagePutsThere) {
    const auto warnings = [&](const Json& texts) { return plan_warnings(read_with({{"texts", texts}})); };
    EXPECT_THAT(warnings({{"page_of", "Page"}, {"pages.few", "A few"}, {"pages.two", "Two pages."}}),
                ElementsAre(HasSubstr("plan.json: texts: \"page_of\" has no {all}, in whose place"),
                            HasSubstr("plan.json: texts: \"page_of\" has no {n}, in whose place"),
                            HasSubstr("\"pages.few\" has no {n}")));
    EXPECT_THAT(
        warnings(
            {{"page_of", "{n}/{all}"}, {"answered.one", "{n} of {all}"}, {"refused", {"No.", "{error}"}}}),
        IsEmpty());
    EXPECT_THAT(warnings({{"answered.one", "One."}}), ElementsAre(HasSubstr("has no {all}")));
}

TEST_F(StudyPlan, WarnsOfScoresThatBelongToNoCondition) {
    const Json slider = {{"id", "hl"}, {"kind", "slider"}, {"text", "How human-like?"}};
    Json each = slider;
    each["each"] = true;
    EXPECT_THAT(plan_warnings(read_with({{"questions", {slider}}})),
                ElementsAre(HasSubstr(
                    "questions: \"hl\" is asked once of all videos of a page, so no condition gets a "
                    "score; if each video is to be rated, give the question \"each\": true")));
    EXPECT_THAT(plan_warnings(read_with({{"questions", {each}}})), IsEmpty());
    EXPECT_THAT(plan_warnings(read_with({{"questions", {slider}}, {"layout", "single"}})), IsEmpty());
    // Of a triplet a rating has a score, whatever it asks.
    const Json three = {"ours", "baseline", {{"name", "still"}, {"from", "ours"}, {"by", "frozen"}}};
    const Json sure = {{"id", "sure"}, {"kind", "rating"}, {"text", "How sure?"}, {"points", 5}};
    EXPECT_THAT(plan_warnings(read_with({{"layout", "triplet"},
                                         {"conditions", three},
                                         {"reference", "baseline"},
                                         {"questions", {sure}}})),
                Contains(HasSubstr(
                    "questions: \"sure\" is analysed as similarity of the reference to A (1) or to B (5)")));
}

// Which side is better, or how the whole page is: a plan may say it, and then nothing is in doubt.
TEST_F(StudyPlan, KnowsQuestionsThatGoFromAToB) {
    Json slider = {{"id", "better"}, {"kind", "slider"}, {"text", "Which one?"}, {"least", -3}, {"most", 3}};
    EXPECT_THAT(plan_warnings(read_with({{"questions", {slider}}})),
                ElementsAre(HasSubstr(
                    "if it goes from A to B, \"sided\": true, which is turned with the videos; if it "
                    "is about the page as a whole, \"sided\": false")));
    for (const bool sided : {true, false}) {
        slider["sided"] = sided;
        const Plan plan = read_with({{"questions", {slider}}});
        EXPECT_EQ(plan.questions[0].sided, sided);
        EXPECT_EQ(plan_as_used(plan)["questions"][0]["sided"], sided);
        EXPECT_THAT(plan_warnings(plan), IsEmpty());
    }
    slider["sided"] = true;
    EXPECT_EQ(
        refusal_with({{"questions", {slider}}, {"layout", "parallel"}}),
        "plan.json: questions[0]: \"better\" has \"sided\", but the layout \"parallel\" has no A and B; leave it "
        "out");
    slider["each"] = true;
    EXPECT_EQ(
        refusal_with({{"questions", {slider}}}),
        "plan.json: questions[0].sided: is true, but each video is rated by itself (\"each\"); leave one of them "
        "out");
}

TEST_F(StudyPlan, ExcludesByTheLenientRuleNoMoreThanByTheStrictOne) {
    const Plan plan = read_with({{"exclusions", {{"failed_checks", 3}}}});
    EXPECT_EQ(plan.exclusions.lenient_failed_checks, 3u);
    EXPECT_EQ(read_with({{"exclusions", {{"failed_checks", 1}}}}).exclusions.lenient_failed_checks, 2u);
    EXPECT_EQ(
        refusal_with({{"exclusions", {{"failed_checks", 3}, {"lenient_failed_checks", 2}}}}),
        "plan.json: exclusions.lenient_failed_checks: is 2, and failed_checks 3; the lenient rule excludes no more "
        "than the strict one");
    EXPECT_THAT(
        plan_warnings(read_with({{"exclusions", {{"failed_checks", 3}}}, {"checks", {{"count", 1}}}})),
        ElementsAre(HasSubstr("exclusions: nobody can fail 3 of 1 attention checks")));
}

// "é" as one letter in the folder, and as e with an accent in the plan.
TEST_F(StudyPlan, FindsFilesWhoseAccentsAreWrittenOtherwise) {
    std::filesystem::create_directory(folder_ / "Zo\u00e9");
    std::filesystem::copy_file(folder_ / "ours/c2.bvh", folder_ / "Zo\u00e9/caf\u00e9.bvh");
    Json clips = sample_plan()["clips"];
    clips[1]["motion"]["ours"] = "Zoe\u0301/cafe\u0301.bvh";
    EXPECT_EQ(read_with({{"clips", clips}}).clips[1].motions[0], folder_ / "Zo\u00e9/caf\u00e9.bvh");
}

TEST_F(StudyPlan, TakesFoldersOfOpenPoseForMotions) {
    const std::filesystem::path tracks = testing::test_file("tests/fixtures/gestures/openpose_24fps");
    std::filesystem::copy(tracks, folder_ / "tracks");
    Json json = sample_plan();
    for (Json& clip : json["clips"]) clip["motion"]["ours"] = "tracks";
    json["hints"]["ours"]["fps"] = 24;
    const Plan plan = read(json);
    EXPECT_EQ(plan.clips[0].motions[0], folder_ / "tracks");
    EXPECT_THAT(list_inputs(plan),
                ::testing::Contains(::testing::Field(&InputFile::path, HasSubstr("tracks/"))));
    json["clips"][0]["motion"]["ours"] = "base";
    EXPECT_EQ(refusal(json),
              "plan.json: clips[0].motion.ours: \"base\" is a folder, a file is needed; name a file in it");
}

// The folder of a plan that is named alone is the current one, which has no parent in its name.
TEST_F(StudyPlan, FindsFilesBesideTheFolderOfAPlanThatIsNamedAlone) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::create_directory(folder_ / "plans");
    Json clips = sample_plan()["clips"];
    for (Json& clip : clips) {
        for (Json& motion : clip["motion"]) motion = "../" + motion.get<std::string>();
        if (clip.contains("audio")) clip["audio"] = "../" + clip["audio"].get<std::string>();
    }
    Json plan = sample_plan();
    plan["clips"] = clips;
    write_json(folder_ / "plans/plan.json", plan);
    std::filesystem::current_path(folder_ / "plans");
    const auto back = std::shared_ptr<void>(nullptr, [&](void*) { std::filesystem::current_path(before); });
    EXPECT_EQ(read_plan("plan.json").clips[1].motions[0], std::filesystem::path("../ours/c2.bvh"));
}

TEST_F(StudyPlan, WarnsOfAPartnerWhoIsTheAgent) {
    Json clips = sample_plan()["clips"];
    for (Json& clip : clips)
        clip["partner"] = {{"motion", clip["motion"]["baseline"]}, {"audio", clip["audio"]}};
    EXPECT_THAT(
        plan_warnings(read_with({{"clips", clips}, {"render", {{"scene", "dyad"}}}})),
        ElementsAre(HasSubstr("agent and partner have the same motion in 2 of 2 clips, such as \"c1\""),
                    HasSubstr("agent and partner have the same audio in 2 of 2 clips, such as \"c1\"")));
}

// GENEA's question is about the person on the left.
TEST_F(StudyPlan, RefusesTextsOfAPresetThatSpeakOfTheOtherSide) {
    const Json left = {{"preset", "genea-2023-interlocutor"}, {"render", {{"partner_side", "left"}}}};
    EXPECT_THAT(
        refusal_with(left),
        HasSubstr("plan.json: render.partner_side: is \"left\", so the study is about the person on the "
                  "right, and the preset's instructions speak of the one on the left; write the plan's own"));
}

TEST_F(StudyPlan, ShowsAllClipsWhereThePresetHasMorePages) {
    const Plan plan = read_with({{"preset", "realism-2025"}});
    EXPECT_EQ(plan.participants.pages_each, std::nullopt);
    EXPECT_THAT(
        plan_warnings(plan),
        Contains(HasSubstr("plan.json: a participant sees all clips, as there are fewer than the 25 pages of "
                           "\"realism-2025\"")));
    EXPECT_EQ(refusal_with({{"preset", "realism-2025"}, {"pages_per_participant", 25}}),
              "plan.json: pages_per_participant: is 25, a whole number from 1 to 2 is needed");
}

TEST_F(StudyPlan, SendsParticipantsToWebAddressesAlone) {
    EXPECT_NO_THROW(read_with({{"completion", {{"url", "https://example.org/done?cc=1"}}}}));
    for (const char* address :
         {"example.org/done", "javascript:alert(1)", "https://example.org/all done", "http://"}) {
        EXPECT_EQ(
            refusal_with({{"completion", {{"failed_url", address}}}}),
            format("plan.json: completion.failed_url: is \"{}\"; write an address that begins with https://",
                   address));
    }
}

TEST_F(StudyPlan, TakesTextsInParagraphs) {
    const Plan plan = read_with({{"consent", {"You may stop.", "Nothing is kept."}}, {"training", "Look."}});
    EXPECT_EQ(plan.texts.consent, "You may stop.\nNothing is kept.");
    EXPECT_EQ(plan_as_used(plan)["consent"], Json({"You may stop.", "Nothing is kept."}));
    EXPECT_EQ(plan_as_used(plan)["training"], "Look.");
}

// ---- Presets

TEST_F(StudyPlan, TakesWhatThePresetSaysWhereItSaysNothing) {
    Json json = {{"preset", "realism-2025"}, {"title", "Mine"}, {"pages_per_participant", 2}};
    for (const char* key : {"conditions", "clips"}) json[key] = sample_plan()[key];
    json["render"] = {{"size", {320, 240}}};
    const Plan plan = read(json);
    EXPECT_EQ(plan.texts.title, "Mine");
    EXPECT_TRUE(plan.silent);
    EXPECT_EQ(plan.render.modes.face_mode, FaceMode::mask);
    EXPECT_EQ(plan.render.size.width, 320);
    EXPECT_EQ(plan.questions[0].text, "In which video does the character gesture more like a real person?");
    EXPECT_EQ(plan.questions[0].answers[0], "Left Clearly Better");
    EXPECT_EQ(plan.questions[0].reasons->unless, 3);
    EXPECT_EQ(plan_as_used(read(plan_as_used(plan))), plan_as_used(plan));
    json["preset"] = "realism-2024";
    EXPECT_THAT(refusal(json), HasSubstr("preset: is \"realism-2024\", which is none of "));
    EXPECT_THAT(refusal(json), HasSubstr("did you mean \"realism-2025\"?"));
}

TEST_F(StudyPlan, SpeaksTheLanguageOfThePreset) {
    Json json = {{"preset", "face-and-head"}, {"language", "fr"}};
    for (const char* key : {"conditions", "clips"}) json[key] = sample_plan()[key];
    const Plan plan = read(json);
    EXPECT_EQ(plan.texts.title, "Des visages qui parlent");
    EXPECT_THAT(plan.passes, SizeIs(2));
    EXPECT_EQ(plan.questions[0].marks[0], "excellent");
}

TEST_F(StudyPlan, AsksForThePresetsTextsInOtherLanguages) {
    Json json = {{"preset", "realism-2025"}, {"language", "fr"}};
    for (const char* key : {"conditions", "clips"}) json[key] = sample_plan()[key];
    EXPECT_EQ(
        refusal(json),
        "plan.json: language: is \"fr\", and the preset has \"title\", \"instructions\", \"questions\", "
        "\"texts\" in English alone; write the plan's own");
    json["title"] = "Qui bouge le mieux ?";
    json["instructions"] = "Regardez les deux vidéos.";
    json["questions"] = {kRating};
    EXPECT_THAT(refusal(json), HasSubstr("the preset has \"texts\" in English alone"));
    json["texts"] = {{"video_1", "Gauche"}, {"video_2", "Droite"}};
    EXPECT_EQ(read(json).texts.page["video_2"], "Droite");
}

// Answers such as "Left Clearly Better" are of no use beside videos that are called A and B.
TEST_F(StudyPlan, CallsVideosAsTheAnswersOfThePresetDo) {
    std::size_t found = 0;
    for (const Preset& preset : presets()) {
        if (preset.plan["questions"].dump().find("\"Left") == std::string::npos) continue;
        ++found;
        EXPECT_EQ(preset.plan["texts"], Json({{"video_1", "Left"}, {"video_2", "Right"}})) << preset.name;
    }
    EXPECT_EQ(found, 5u);
}

// A preset knows nothing of conditions and clips; with them it is a plan.
TEST_F(StudyPlan, HasAPlanForEveryPreset) {
    const Json three = {"ours", "baseline", {{"name", "still"}, {"from", "ours"}, {"by", "frozen"}}};
    for (const Preset& preset : presets()) {
        Json json = {{"preset", preset.name},
                     {"conditions", sample_plan()["conditions"]},
                     {"clips", sample_plan()["clips"]}};
        const std::string layout = preset.plan["layout"];
        if (layout == "triplet") {
            json["conditions"] = three;
            json["reference"] = "baseline";
        }
        if (preset.plan.value("sides", "") == "fixed")
            json["compare"] = Json::parse(R"([["ours", "baseline"]])");
        if (preset.plan.contains("pages_per_participant")) json["pages_per_participant"] = 2;
        if (preset.plan.contains("blocks")) json["blocks"] = 2;
        if (preset.plan.value("render", Json::object()).value("scene", "") == "dyad") {
            for (Json& clip : json["clips"]) clip["partner"] = {{"motion", "base/c1.bvh"}};
        }
        SCOPED_TRACE(preset.name);
        const Plan plan = read(json);
        EXPECT_FALSE(preset.source.empty());
        EXPECT_NO_THROW(compose(plan, 1));
        EXPECT_EQ(plan_as_used(read(plan_as_used(plan))), plan_as_used(plan));
    }
}

}  // namespace
}  // namespace chironomia::study
