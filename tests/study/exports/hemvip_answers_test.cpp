// Answers to a study that was exported to HEMVIP, or named by its tokens in battles.csv, through the real binary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "study/record/key.h"
#include "tests/study/exports/exported_sample.h"
#include "tests/study/process.h"

namespace chironomia::study {
namespace {

using testing::ExportedSample;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::SampleStudy;

// The condition of a video of the key.
std::string condition_of(const Json& key, const std::string& video) {
    for (const Json& page : key["pages"]) {
        for (const Json& place : page["places"])
            if (place["video"] == video) return place["condition"];
    }
    return "";
}

// What somebody says of the videos of a page, which stand from left to right; "at" is a video of an attention check,
// and the third entry its value.
using Answering = std::function<Json(const Json& stimuli)>;

// As HEMVIP's page stores it (lib/webmushra/pages/VideoPage.js, and VideoPC.js of the branch genea2022).
Json saved_by_hemvip(const Json& config, const std::string& user, const Answering& answering) {
    Json trials = Json::array();
    for (const Json& page : config["pages"]) {
        if (page["type"] != "video" && page["type"] != "videopc") continue;
        const Json scores = answering(page["stimuli"]);
        Json responses = Json::array();
        for (std::size_t i = 0; i < page["stimuli"].size(); ++i)
            responses.push_back({{"stimulus", page["stimuli"][i][0]},
                                 {"score", scores[i]},
                                 {"time", 12500},
                                 {"comment", nullptr}});
        trials.push_back({{"type", page["type"]}, {"id", page["id"]}, {"responses", responses}});
    }
    return {{"testId", config["testId"]},
            {"userId", user},
            {"participant", {{"name", {"age", "remarks"}}, {"response", {"31", ""}}}},
            {"trials", trials}};
}

class HemvipAnswers : public ::testing::Test {
  protected:
    void export_sample(const SampleStudy& sample) { sample_ = std::make_unique<ExportedSample>(sample); }

    // Three answers, as HEMVIP's pairs have them, and no second question.
    void export_pairs() {
        export_sample({});
        const Json questions = Json::parse(R"([{"id": "realism", "kind": "preference", "text": "Which one?",
            "answers": ["left", "equal", "right"]}])");
        sample_->change("public/pages.json", [&](Json& pages) {
            pages["questions"] = questions;
            for (Json& page : pages["pages"]) page["passes"][0]["questions"] = {0};
        });
        sample_->change("private/key.json", [&](Json& key) {
            key["questions"] = questions;
            for (Json& page : key["pages"]) {
                if (page["kind"] == "check") page["expected"] = {{"realism", 1}};
            }
        });
    }

    void write_hemvip() {
        ASSERT_EQ(run_chironomia({"study", "export", sample_->study().string(), "--as", "hemvip", "--out",
                                  sample_->out().string()})
                      .exit_code,
                  0);
        key_ = read_json(sample_->study() / "private/key.json");
    }

    void answer(std::size_t sheet, const std::string& user, const Answering& answering) {
        const Json config =
            read_json(sample_->open(format("configs/3f0c9a5b1e2d4c68/sheet-{:03}.json", sheet + 1)));
        write_json(folder_ / "responses" / (user + ".json"), saved_by_hemvip(config, user, answering));
    }

    Outcome analyse(bool with_study = true) {
        std::vector<std::string> words = {"study", "analyse"};
        if (with_study) words.push_back(sample_->study().string());
        words.insert(words.end(), {"--answers", (folder_ / "responses").string(), "--out",
                                   (folder_ / "out").string(), "--samples", "200"});
        return run_chironomia(words);
    }

    Json strict() const { return read_json(folder_ / "out/analysis.json")["strict"]; }

    // Ours is preferred; `on_check`: whether the video that checks expect is.
    Answering preferring_ours(bool on_check = true) {
        return [this, on_check](const Json& stimuli) {
            bool is_check = false;
            for (const Json& page : key_["pages"])
                is_check =
                    is_check || (page["kind"] == "check" && (page["places"][0]["video"] == stimuli[0][0] ||
                                                             page["places"][1]["video"] == stimuli[0][0]));
            Json scores = Json::array();
            for (const Json& stimulus : stimuli)
                scores.push_back((condition_of(key_, stimulus[0]) == "ours") == (!is_check || on_check));
            return scores;
        };
    }

    testing::TemporaryFolder folder_;
    std::unique_ptr<ExportedSample> sample_;
    Json key_;
};

// Sliders whose values are texts, as browsers have them; checks expect 100 of one video and 0 of the others.
TEST_F(HemvipAnswers, HaveTheConditionsAndChecksOfTheStudy) {
    export_sample({.layout = "parallel"});
    write_hemvip();
    const auto scoring = [&](bool fails) {
        return [this, fails](const Json& stimuli) {
            const std::map<std::string, int> scores = {
                {"ours", 90}, {"baseline", 60}, {"third", 40}, {"fourth", 10}};
            Json given = Json::array();
            for (const Json& stimulus : stimuli) {
                const int score = stimulus[0] == "at" ? (fails ? 50 : stimulus[2].get<int>())
                                                      : scores.at(condition_of(key_, stimulus[0]));
                given.push_back(std::to_string(score));
            }
            return given;
        };
    };
    for (std::size_t i = 0; i < 4; ++i) answer(i, format("u{}", i + 1), scoring(i == 3));
    const Outcome outcome = analyse();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("4 participants: 3 counted by the strict rule, 4 by the lenient one"));
    EXPECT_THAT(outcome.out, HasSubstr("  u4: failed 1 check: human is [50,50,50,50], expected [100,0,0,0]"));
    std::map<std::string, double> means;
    const Json strict = this->strict();
    for (const Json& row : strict["scores"]) means[row["condition"]] = row["mean"];
    EXPECT_EQ(means,
              (std::map<std::string, double>{{"ours", 90}, {"baseline", 60}, {"third", 40}, {"fourth", 10}}));
    EXPECT_THAT(read_text(folder_ / "out/questionnaire.csv"), HasSubstr("u1,age,31,counted"));
    EXPECT_THAT(read_text(folder_ / "out/answers.csv"), HasSubstr(",12.5,counted"));
}

TEST_F(HemvipAnswers, OfPairsAreVotesAndChecks) {
    export_pairs();
    write_hemvip();
    answer(0, "u1", preferring_ours());
    answer(1, "u2", preferring_ours());
    answer(2, "u3", preferring_ours(false));
    const Outcome outcome = analyse();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("3 participants: 2 counted by the strict rule, 3 by the lenient one"));
    const Json pair = strict()["preferences"][0];
    EXPECT_EQ(pair["first"], "ours");
    EXPECT_EQ(pair["wins"], 8) << pair;
    EXPECT_EQ(pair["losses"], 0);
    EXPECT_EQ(read_json(folder_ / "out/analysis.json")["lenient"]["preferences"][0]["wins"], 12);
    const Json side = strict()["side_bias"];
    EXPECT_EQ(side[0]["left"], 4) << side;
}

// A page that was reported as broken has no answer, and is no reason to leave all others out.
TEST_F(HemvipAnswers, CountABrokenPageAsSkipped) {
    export_pairs();
    write_hemvip();
    bool is_first = true;
    answer(0, "u1", [&](const Json& stimuli) {
        Json scores = preferring_ours()(stimuli);
        if (is_first) scores = {99, 99};
        is_first = false;
        return scores;
    });
    const Outcome outcome = analyse();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("1 page was reported as broken and counts as skipped."));
    EXPECT_THAT(outcome.out, HasSubstr("1 participant: 1 counted by the strict rule"));
    EXPECT_EQ(strict()["preferences"][0]["wins"], 3);
}

// A time that is not known is not 0: nobody was too fast.
TEST_F(HemvipAnswers, MayHaveNoTime) {
    export_pairs();
    sample_->change("private/key.json", [](Json& key) { key["exclusions"]["fastest_seconds"] = 3; });
    write_hemvip();
    answer(0, "u1", preferring_ours());
    const std::filesystem::path file = folder_ / "responses/u1.json";
    Json saved = read_json(file);
    for (Json& trial : saved["trials"]) {
        for (Json& response : trial["responses"]) response.erase("time");
    }
    write_json(file, saved);
    const Outcome outcome = analyse();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("1 participant: 1 counted by the strict rule"));
    EXPECT_THAT(outcome.out, HasSubstr("5 pages have no time, so \"fastest_seconds\" does not judge them."));
    EXPECT_THAT(read_text(folder_ / "out/answers.csv"), HasSubstr(",,counted"));
}

TEST_F(HemvipAnswers, NeedTheStudy) {
    export_pairs();
    write_hemvip();
    answer(0, "u1", preferring_ours());
    const Outcome outcome = analyse(false);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("responses[0].stimulus: is \""));
    EXPECT_THAT(outcome.err,
                HasSubstr("the token of a video of a study, which hides the condition; give the folder "
                          "of the study too: chironomia study analyse DIR --answers ..."));
}

TEST_F(HemvipAnswers, RefuseWhatIsNotOfTheStudy) {
    export_pairs();
    write_hemvip();
    answer(0, "u1", preferring_ours());
    const std::filesystem::path file = folder_ / "responses/u1.json";
    const Json right = read_json(file);
    const auto refusal = [&](const std::function<void(Json&)>& change) {
        Json wrong = right;
        change(wrong);
        write_json(file, wrong);
        const Outcome outcome = analyse();
        EXPECT_EQ(outcome.exit_code, 3);
        return outcome.err;
    };
    EXPECT_THAT(
        refusal([](Json& one) { one["trials"][0]["id"] = "p1"; }),
        HasSubstr("u1.json: trials[0].id: is \"p1\", which is no page of the study; give the folder of the "
                  "study that was exported"));
    EXPECT_THAT(refusal([](Json& one) { std::swap(one["trials"][0], one["trials"][1]); }),
                HasSubstr("u1.json: trials: has pages or videos in an order that no sheet of the study has"));
    EXPECT_THAT(refusal([](Json& one) {
                    for (Json& response : one["trials"][0]["responses"]) response["score"] = true;
                }),
                HasSubstr("trials[0]: has two scores that are true; one of two is preferred, or none"));
    EXPECT_THAT(refusal([](Json& one) { one["trials"][0]["responses"][0]["score"] = 3; }),
                HasSubstr("trials[0]: has scores that are not two of true and false"));
    EXPECT_THAT(refusal([](Json& one) {
                    one = Json::array({one, one});
                }),
                HasSubstr("userId: \"u1\" is already in " + file.string()));
    EXPECT_THAT(refusal([](Json& one) { one["participant"]["name"][0] = "shoe"; }),
                HasSubstr("shoe is \"31\": the study asks no such question at its end"));
}

TEST_F(HemvipAnswers, RefuseAScoreOffTheScale) {
    export_sample({.layout = "parallel", .checks = 0});
    write_hemvip();
    answer(0, "u1", [](const Json&) { return Json({"40", "101", "3", "4"}); });
    EXPECT_THAT(analyse().err,
                HasSubstr("trials[0]: has the scores [40,101,3,4]: for each of 4 videos a whole number "
                          "from 0 to 100 is needed"));
}

// Configs of one's own, as the export makes none of five answers.
TEST_F(HemvipAnswers, RefusePairsThatWereAskedOtherwise) {
    export_pairs();
    write_hemvip();
    answer(0, "u1", preferring_ours());
    for (const char* file : {"public/pages.json", "private/key.json"}) {
        sample_->change(file, [](Json& json) {
            for (const char* more : {"right clearly", "right very clearly"})
                json["questions"][0]["answers"].push_back(more);
        });
    }
    EXPECT_THAT(
        analyse().err,
        HasSubstr("trials[0]: is of type \"videopc\", but \"realism\" is no preference with 3 answers"));
}

// The page may ask two questions at a time of other front ends, but HEMVIP asks one.
TEST_F(HemvipAnswers, RefuseAPageOfTwoQuestions) {
    export_pairs();
    write_hemvip();
    answer(0, "u1", preferring_ours());
    sample_->change("public/pages.json", [](Json& pages) {
        Json more = pages["questions"][0];
        more["id"] = "human";
        pages["questions"].push_back(more);
        for (Json& page : pages["pages"]) page["passes"][0]["questions"] = {0, 1};
    });
    sample_->change("private/key.json", [](Json& key) {
        Json more = key["questions"][0];
        more["id"] = "human";
        key["questions"].push_back(more);
    });
    EXPECT_THAT(analyse().err, HasSubstr("trials[0]: asks 2 questions in the study, HEMVIP one"));
}

// ---- battles.csv

constexpr const char* kHeader =
    "user,input_code,model_a,model_b,winner,is_strong,juiceOptions,juiceOtherReason\n";

// Lines of one sheet with the tokens of videos, of somebody who prefers ours; `on_check`: the check is answered as it
// asks, with the left video clearly.
std::string lines_of(const Json& key, const std::string& user, bool on_check) {
    std::string lines;
    for (const Json& page : key["pages"]) {
        const bool is_check = page["kind"] == "check";
        lines += format("{},{},{},{},{},{},[],\n", user, page["page"].get<std::string>(),
                        page["places"][1]["video"].get<std::string>(),
                        page["places"][0]["video"].get<std::string>(),
                        is_check && !on_check ? "model_a" : "model_b", is_check ? "True" : "False");
    }
    return lines;
}

TEST_F(HemvipAnswers, InBattlesAreVotesAndChecksToo) {
    export_sample({});
    write_text(folder_ / "responses/battles.csv", "");
    const Json key = read_json(sample_->study() / "private/key.json");
    write_text(folder_ / "responses/battles.csv",
               kHeader + lines_of(key, "u1", true) + lines_of(key, "u2", false));
    const Outcome outcome = analyse();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("2 participants: 1 counted by the strict rule, 2 by the lenient one"));
    EXPECT_THAT(outcome.out, HasSubstr("  u2: failed 1 check: realism is 5, expected 1 on page "));
    EXPECT_EQ(strict()["preferences"][0]["first"], "ours");
    EXPECT_EQ(strict()["preferences"][0]["wins"], 4);
    EXPECT_EQ(strict()["preferences"][0]["losses"], 0);
    const Outcome alone = analyse(false);
    EXPECT_EQ(alone.exit_code, 3);
    EXPECT_THAT(alone.err, HasSubstr("battles.csv:2: model_a is \""));
    EXPECT_THAT(alone.err,
                HasSubstr("the token of a video of a study, which hides the condition; give the folder"));
}

// As HEMVIP2's export names them.
TEST_F(HemvipAnswers, InBattlesMayNameConditionsByTheirTokens) {
    export_sample({});
    const StudyKey key = read_study_key(sample_->study() / "private/key.json");
    const std::string ours = condition_token(key, "ours"), baseline = condition_token(key, "baseline");
    write_text(folder_ / "responses/battles.csv",
               kHeader + format("u1,{},{},{},model_a,True,[],\nu1,c1,baseline,ours,model_b,False,[],\n",
                                clip_token(key, "c0"), ours, baseline));
    const Outcome outcome = analyse();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(
        outcome.out,
        HasSubstr("These files have no attention checks of the study: nobody is excluded for failing one."));
    EXPECT_EQ(strict()["preferences"][0]["wins"], 2);
    EXPECT_THAT(read_text(folder_ / "out/battles.csv"), HasSubstr("u1,c0,ours,baseline,model_a,True"));
}

TEST_F(HemvipAnswers, InBattlesAreRefusedIfTheStudyDoesNotKnowThem) {
    export_sample({});
    const Json key = read_json(sample_->study() / "private/key.json");
    const std::string a = key["pages"][0]["places"][0]["video"], b = key["pages"][1]["places"][1]["video"];
    const auto refusal = [&](const std::string& left, const std::string& right) {
        write_text(folder_ / "responses/battles.csv",
                   kHeader + format("u1,c1,{},{},tie,,[],\n", left, right));
        return analyse().err;
    };
    EXPECT_THAT(refusal("ours", "SA"),
                HasSubstr("battles.csv:2: model_b is \"SA\", which is no condition of the study "
                          "and no token of one; give the folder of the study that was answered"));
    EXPECT_THAT(refusal("ours", "ours"), HasSubstr("model_a and model_b are both \"ours\""));
    EXPECT_THAT(refusal(a, b),
                HasSubstr(format("no page of the study shows \"{}\" and \"{}\" together", a, b)));
    write_json(folder_ / "responses/u.json", {{"userId", "u"}});
    EXPECT_THAT(refusal("ours", "baseline"),
                HasSubstr("u.json: is of another kind than the files before it; analyse them apart"));
    std::filesystem::remove(folder_ / "responses/u.json");
    export_sample({.layout = "parallel"});
    EXPECT_THAT(refusal("ours", "baseline"),
                HasSubstr("battles.csv: the study asks for no preference; give the answers of this study"));
}

}  // namespace
}  // namespace chironomia::study
