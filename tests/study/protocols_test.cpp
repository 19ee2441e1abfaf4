// Every protocol from its example plan to the answers of scripted participants: built with tiny videos,
// proved, and walked through in a browser by two of them. The others answer in the same form without one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/files/files.h"
#include "core/text.h"
#include "study/analysis/analysis.h"
#include "study/analysis/rehearsal.h"
#include "study/build/build.h"
#include "study/check/check.h"
#include "study/plan/presets.h"
#include "tests/study/tiny_maker.h"
#include "tests/study/walk.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::Browser;
using testing::FakeMaker;
using testing::ShownPage;
using ::testing::SizeIs;
using testing::source_dir;
using testing::TemporaryFolder;
using testing::Walker;

fs::path example_of(const std::string& preset) {
    return source_dir() / "assets/samples/plans" / (preset + ".json");
}

// A participant who likes some conditions better than others, and does as the checks say.
class Rater {
  public:
    Rater(const Json& key, std::size_t number) : number_(number) {
        double strength = 0;
        for (const Json& condition : key["conditions"]) strength_[condition["name"]] = strength++;
        for (const Json& page : key["pages"]) pages_[page["page"]] = page;
    }

    Json answer(const ShownPage& seen, const Json& question) const {
        const Json& page = pages_.at(seen.page);
        if (page["kind"] == "check" && page["expected"].contains(question["id"])) {
            Json expected = page["expected"][question["id"]];
            if (!expected.is_array()) return expected;
            for (Json& value : expected) value = value.is_null() ? question["least"] : value;
            return expected;
        }
        const std::vector<double> likes = likes_of(seen, page);
        if (question["kind"] == "preference") return preference(question["answers"].size(), likes);
        if (question["kind"] == "rank") return ranks(likes);
        const int mood = static_cast<int>(number_ % 2);
        if (question["kind"] == "rating" && likes.size() == 1)
            return 2 + mood + static_cast<int>(likes.front());
        if (question["kind"] == "rating" && likes.size() == 3) return resemblance(question["points"], likes);
        if (!question.value("each", false)) return testing::plain_answer(question, seen.videos.size());
        Json values = Json::array();
        for (const double like : likes) values.push_back(20 + 10 * mood + static_cast<int>(15 * like));
        return values;
    }

    // The answer of a participant who answers checks like any other page.
    Json careless_answer(const ShownPage& seen, const Json& question) const {
        const Json plain = testing::plain_answer(question, seen.videos.size());
        const Json& page = pages_.at(seen.page);
        const bool is_instructed = page["kind"] == "check" && page["expected"].contains(question["id"]);
        return is_instructed && page["expected"][question["id"]] == plain ? Json(1) : plain;
    }

    // How much more the condition at the place is liked.
    double like(const std::string& condition) const { return strength_.at(condition); }

  private:
    // From left to right as shown.
    std::vector<double> likes_of(const ShownPage& seen, const Json& page) const {
        std::vector<double> likes;
        for (const std::string& token : seen.videos) {
            for (const Json& place : page["places"]) {
                if (place["video"] == token) likes.push_back(like(place["condition"]));
            }
        }
        return likes;
    }

    // One in five sees it the other way round.
    Json preference(std::size_t answers, const std::vector<double>& likes) const {
        const int most = static_cast<int>(answers);
        if (likes.front() == likes.back()) return (most + 1) / 2;
        return (likes.front() > likes.back()) != (number_ % 5 == 0) ? 1 : most;
    }

    // Of the left one at 1, of the right one at the most; the reference stands between them.
    Json resemblance(int most, const std::vector<double>& likes) const {
        const int strong = 1 + static_cast<int>(number_ % 2);
        return (most + 1) / 2 + (likes.back() > likes.front() ? strong : -strong);
    }

    static Json ranks(const std::vector<double>& likes) {
        Json ranks = Json::array();
        for (const double like : likes)
            ranks.push_back(
                1 + std::count_if(likes.begin(), likes.end(), [&](double each) { return each > like; }));
        return ranks;
    }

    std::size_t number_;
    std::map<std::string, double> strength_;
    std::map<std::string, Json> pages_;
};

class Protocol : public ::testing::TestWithParam<std::string> {
  protected:
    Protocol() {
        const Json pages = build();
        key_ = read_json(study_ / "private/key.json");
        pages_ = pages;
    }

    Json build() {
        const fs::path samples = folder_ / "samples";
        fs::copy(source_dir() / "assets/samples", samples, fs::copy_options::recursive);
        Json plan = read_json(example_of(GetParam()));
        plan["render"]["size"] = {160, 120};
        plan["render"]["fps"] = 10;
        // The clips last 2 s: what is said in them must be short.
        if (with_preset(plan, "").contains("checks")) plan["checks"]["instruction"] = "{answer}";
        write_json(samples / "plans/tiny.json", plan);
        build_study(read_plan(samples / "plans/tiny.json"), {.out = study_, .seed = 11, .quiet = true},
                    testing::tiny_maker(FakeMaker()));
        return read_json(study_ / "public/pages.json");
    }

    // A careless participant gives plain answers, and on checks wrong ones.
    Json walk(Browser& browser, std::size_t participant, bool cares) {
        const Rater rater(key_, participant);
        Walker walker;
        walker.answer = [&](const ShownPage& seen, const Json& question) {
            return cares ? rater.answer(seen, question) : rater.careless_answer(seen, question);
        };
        return testing::walk_study(
            browser, format("file://{}?p={}", (study_ / "public/index.html").string(), participant), walker);
    }

    // The answers hold each page of the sheet once in each pass, as shown.
    void expect_whole(const Json& answers) {
        const Json& sheet = pages_["sheets"][answers["sheet"].get<std::size_t>()]["pages"];
        std::size_t at = 0;
        for (const Json& shown : sheet) {
            const Json& page = pages_["pages"][shown[0].get<std::size_t>()];
            for (std::size_t pass = 0; pass < page["passes"].size(); ++pass) {
                ASSERT_LT(at, answers["answers"].size());
                const Json& answer = answers["answers"][at++];
                EXPECT_EQ(answer["page"], page["id"]);
                EXPECT_EQ(answer["pass"], pass);
                EXPECT_THAT(answer["videos"], SizeIs(shown[1].size()));
                EXPECT_THAT(answer["values"], SizeIs(page["passes"][pass]["questions"].size()));
            }
        }
        EXPECT_EQ(at, answers["answers"].size());
        EXPECT_FALSE(answers["finished"].is_null());
    }

    // What a participant would have answered in the browser.
    void answer_as(std::size_t participant, bool cares, Json& answers) const {
        const Rater rater(key_, participant);
        for (Json& answer : answers["answers"]) {
            const Json& page = page_named(answer["page"]);
            const ShownPage seen{.page = answer["page"],
                                 .pass = answer["pass"],
                                 .videos = answer["videos"].get<std::vector<std::string>>()};
            const auto pass = answer["pass"].get<std::size_t>();
            for (const Json& index : page["passes"][pass]["questions"]) {
                const Json& question = pages_["questions"][index.get<std::size_t>()];
                answer["values"][question["id"].get<std::string>()] =
                    cares ? rater.answer(seen, question) : rater.careless_answer(seen, question);
            }
        }
    }

    const Json& page_named(const Json& id) const {
        return *std::ranges::find_if(pages_["pages"], [&](const Json& page) { return page["id"] == id; });
    }

    static void expect_same_answers(const Json& walked, const Json& made) {
        EXPECT_EQ(walked["sheet"], made["sheet"]);
        ASSERT_EQ(walked["answers"].size(), made["answers"].size());
        for (std::size_t i = 0; i < made["answers"].size(); ++i)
            for (const char* key : {"page", "pass", "videos", "values"})
                EXPECT_EQ(walked["answers"][i][key], made["answers"][i][key]) << i;
    }

    // Seven participants, the last of whom does not care. The first and the last walk through the page, and
    // answer there what is made without it for the others.
    Json answers_of_seven() {
        constexpr std::size_t kMany = 7;
        Browser browser(folder_.path());
        browser.resize(1280, 800);
        Json all = analysis::rehearse_study({.study = study_, .participants = kMany});
        for (std::size_t participant = 0; participant < kMany; ++participant) {
            const bool cares = participant + 1 < kMany;
            answer_as(participant, cares, all[participant]);
            all[participant]["simulated"] = false;
            if (participant > 0 && cares) continue;
            const Json walked = walk(browser, participant, cares);
            expect_whole(walked);
            expect_same_answers(walked, all[participant]);
            all[participant] = walked;
        }
        return all;
    }

    Json analyse_answers(const Json& answers) {
        write_json(folder_ / "answers.json", answers);
        return to_json(analysis::analyse({.study = study_,
                                          .answers = {folder_ / "answers.json"},
                                          .resampling = {.samples = 200, .seed = 1}}))
            .at("strict");
    }

    Json question_of(const Json& row) const {
        for (const Json& question : key_["questions"])
            if (question["id"] == row["question"]) return question;
        ADD_FAILURE() << row;
        return {};
    }

    bool has_checks() const {
        return std::any_of(key_["pages"].begin(), key_["pages"].end(),
                           [](const Json& page) { return page["kind"] == "check"; });
    }

    double strength_of(const std::string& condition) const { return Rater(key_, 0).like(condition); }

    // What was liked more has the better ranks, or means around what each rater felt.
    void expect_planted_score(const Json& row) const {
        const std::string condition = row["condition"];
        const Json question = question_of(row);
        if (const std::size_t over = condition.find(" over "); over != std::string::npos) {
            const bool is_liked =
                strength_of(condition.substr(0, over)) > strength_of(condition.substr(over + 6));
            EXPECT_EQ(row["mean"] > 3, is_liked) << row;
            return;
        }
        double planted = question["kind"] == "slider" ? 25 + 15 * strength_of(condition) : 0;
        if (question["kind"] == "rating")
            planted = condition.find(" + ") == std::string::npos ? 2.5 + strength_of(condition)
                                                                 : (question["points"].get<int>() + 1) / 2;
        if (question["kind"] == "rank")
            planted = static_cast<double>(key_["conditions"].size()) - strength_of(condition) - 0.25;
        const bool all_agree = row["mean_low"].is_null();  // and there is no interval
        EXPECT_LE(row[all_agree ? "mean" : "mean_low"], planted + 0.25) << row;
        EXPECT_GE(row[all_agree ? "mean" : "mean_high"], planted - 0.25) << row;
    }

    void expect_planted_order(const Json& elo) const {
        for (const Json& a : elo) {
            for (const Json& b : elo) {
                if (strength_of(a["condition"]) <= strength_of(b["condition"])) continue;
                EXPECT_GT(a["elo"], b["elo"]) << a << b;
            }
        }
    }

    TemporaryFolder folder_;
    fs::path study_ = folder_ / "study";
    Json key_, pages_;
};

// What the careful ones like is found again, and the careless are left out where there are checks.
TEST_P(Protocol, IsProvedAndWalkedThroughAndFindsWhatWasLiked) {
    const CheckReport report = check_study(study_);
    EXPECT_TRUE(report.passed()) << to_text(report);
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    const Json found = analyse_answers(answers_of_seven());
    EXPECT_EQ(found["participants"], has_checks() ? 6 : 7);
    for (const Json& row : found.value("scores", Json::array())) expect_planted_score(row);
    for (const Json& row : found.value("preferences", Json::array()))
        EXPECT_EQ(row["share"] > 0.5, strength_of(row["first"]) > strength_of(row["second"])) << row;
    expect_planted_order(found.value("elo", Json::array()));
    for (const Json& row : found.value("choices", Json::array()))
        EXPECT_TRUE(row["share"] == 0 || row["share"] == 1);
    EXPECT_TRUE(found.contains("scores") || found.contains("preferences") || found.contains("choices"));
}

std::string as_identifier(const ::testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::vector<std::string> names_of_presets() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Presets, Protocol, ::testing::ValuesIn(names_of_presets()), as_identifier);

}  // namespace
}  // namespace chironomia::study
