// A preregistration through the real binary: what the plan says, and what it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "tests/study/browser.h"
#include "tests/study/process.h"
#include "tests/study/sample_plan.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using testing::Browser;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::sample_plan;
using testing::TemporaryFolder;

class Preregistered : public ::testing::Test {
  protected:
    Preregistered() { testing::write_sample_inputs(folder_.path()); }

    Outcome preregister(const Json& plan, const std::vector<std::string>& more = {}) {
        write_json(folder_ / "plan.json", plan);
        std::vector<std::string> words = {"study", "plan", (folder_ / "plan.json").string(), "--preregister",
                                          (folder_ / "out.html").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    }

    std::string page() const { return read_text(folder_ / "out.html"); }

    // The JSON in the page.
    Json data() const {
        const std::string text = page();
        const std::string begin = "id=\"preregistration\">";
        const std::size_t at = text.find(begin) + begin.size();
        return Json::parse(text.substr(at, text.find("</script>", at) - at));
    }

    Json item(const std::string& title) const {
        const Json all = data();
        for (const Json& item : all["items"]) {
            if (item["title"] == title) return item;
        }
        return nullptr;
    }

    TemporaryFolder folder_;
};

TEST_F(Preregistered, HasTheItemsOfTheFormInTheirOrder) {
    ASSERT_EQ(preregister(sample_plan()).exit_code, 0);
    std::vector<std::string> titles;
    const Json all = data();
    for (const Json& item : all["items"]) titles.push_back(item["title"]);
    EXPECT_THAT(titles,
                ElementsAre("Description", "Hypotheses", "Study type", "Blinding", "Additional blinding",
                            "Study design", "Randomization", "Existing data", "Explanation of existing data",
                            "Data collection procedures", "Sample size", "Sample size rationale",
                            "Stopping rule", "Manipulated variables", "Measured variables", "Indices",
                            "Statistical models", "Transformations", "Inference criteria", "Data exclusion",
                            "Missing data", "Exploratory analysis", "Other"));
    std::size_t at = 0;
    for (const std::string& title : titles) {
        at = page().find("<h3>" + title + "</h3>", at);
        EXPECT_NE(at, std::string::npos) << title;
    }
}

TEST_F(Preregistered, SaysWhatThePlanDoesNotSayInsteadOfInventingIt) {
    const Outcome outcome = preregister(sample_plan());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("note: Hypotheses: The plan does not say it: \"preregistration\": "
                                       "{\"hypotheses\": ...} is missing."));
    for (const char* title : {"Description", "Hypotheses", "Existing data", "Sample size",
                              "Sample size rationale", "Stopping rule", "Exploratory analysis"}) {
        EXPECT_TRUE(item(title)["missing"].is_string()) << title;
        EXPECT_EQ(item(title)["fixed"], Json::array()) << title;
    }
    EXPECT_EQ(data()["power"], nullptr) << "no effect is given, so none is taken";
    EXPECT_THAT(page(),
                HasSubstr("<p class=\"missing\">The plan does not say it: \"participants\" is missing.</p>"));
    EXPECT_EQ(item("Study design")["missing"], nullptr);
}

// Without an answer in the middle nobody ties. Of several questions the one with the fewest counts.
TEST_F(Preregistered, FindsThePowerOfAsManyAnswersAsThePlanHas) {
    Json plan = sample_plan();
    const auto needed = [&](std::vector<std::size_t> counts) {
        plan["questions"] = Json::array();
        for (const std::size_t count : counts) {
            plan["questions"].push_back({{"id", format("of{}", count)},
                                         {"kind", "preference"},
                                         {"text", "Which?"},
                                         {"answers", Json::array()}});
            for (std::size_t i = 0; i < count; ++i)
                plan["questions"].back()["answers"].push_back(format("answer {}", i));
        }
        const Outcome outcome = preregister(plan, {"--power", "--effect", "100"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const std::size_t fewest = *std::min_element(counts.begin(), counts.end());
        EXPECT_THAT(outcome.out,
                    HasSubstr(format("of each participant with {} answers to choose from)", fewest)));
        const Json power = data()["power"];
        EXPECT_EQ(power["choices"], fewest);
        return power["participants_needed"].get<std::size_t>();
    };
    const std::size_t of_two = needed({2});
    EXPECT_NE(needed({3}), of_two);
    EXPECT_EQ(needed({7, 2}), of_two);
}

// Four clips in one block and one in the other: which of them is called the first must not matter.
TEST_F(Preregistered, FindsThePowerOfUnequalBlocksWhicheverComesFirst) {
    Json plan = sample_plan();
    plan["blocks"] = 2;
    for (const char* id : {"c3", "c4", "c5"}) {
        plan["clips"].push_back(plan["clips"][0]);
        plan["clips"].back()["id"] = id;
    }
    const auto needed = [&](int block_of_four) {
        for (std::size_t i = 0; i < 5; ++i)
            plan["clips"][i]["block"] = i < 4 ? block_of_four : 1 - block_of_four;
        const Outcome outcome = preregister(plan, {"--power", "--effect", "100"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("1 to 4 comparisons of each participant"));
        EXPECT_EQ(data()["power"]["answers_each"], block_of_four == 0 ? Json({4, 1}) : Json({1, 4}));
        return data()["power"]["participants_needed"].get<double>();
    };
    EXPECT_NEAR(needed(0) / needed(1), 1, 0.15);
}

// A CMOS of two clips, as the analysis tests it: t of one sample. The sd of a participant's mean is that of the participant
// and of a half of the rest: n = 7.85 (0.3^2 + 0.82 / 2) / 0.5^2 + 2 = 17.7.
TEST_F(Preregistered, FindsThePowerOfASidedSliderAgainstTheMiddleOfItsScale) {
    Json plan = sample_plan();
    plan["questions"] = Json::array({{{"id", "better"},
                                      {"kind", "slider"},
                                      {"text", "Which?"},
                                      {"least", -3},
                                      {"most", 3},
                                      {"labels", {"B", "equal", "A"}},
                                      {"sided", true}}});
    const Outcome outcome = preregister(plan, {"--power", "--effect", "0.5"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\na mean of 0.5 sd from the middle of the scale needs "));
    EXPECT_THAT(outcome.out, HasSubstr(", 2 scores of each participant)"));
    EXPECT_NEAR(data()["power"]["participants_needed"].get<double>(), 17.7, 1.7);
    EXPECT_EQ(data()["power"]["answers"], "sided scores");
    EXPECT_EQ(data()["power"]["pairs"], 1);
    EXPECT_THAT(item("Sample size rationale")["fixed"].dump(),
                HasSubstr("0.5 standard deviations of an answer from the middle of the scale"));
    EXPECT_THAT(item("Statistical models")["fixed"].dump(), HasSubstr("against the middle of the scale"));
    EXPECT_THAT(item("Statistical models")["fixed"].dump(), Not(HasSubstr("paired t")));
}

TEST_F(Preregistered, RefusesThePowerOfWhatComparesNothing) {
    Json plan = sample_plan();
    plan["questions"] = Json::array(
        {{{"id", "natural"}, {"kind", "rating"}, {"points", 7}, {"sided", false}, {"text", "How natural?"}}});
    EXPECT_EQ(preregister(plan).exit_code, 0) << "without an effect";
    const auto refusal = [&] {
        const Outcome outcome = preregister(plan, {"--power"});
        EXPECT_EQ(outcome.exit_code, 3);
        return outcome.err;
    };
    EXPECT_THAT(refusal(),
                HasSubstr("plan.json: no effect can be found, because its questions are about the page as a "
                          "whole and all pages show the same conditions; leave --power and "
                          "\"smallest_effect\" out, or ask with \"each\": true of every video, or with "
                          "\"sided\": true from A to B"));
    // Of three pairs the pages are compared with each other.
    plan["conditions"].push_back({{"name", "frozen"}, {"from", "ours"}, {"by", "frozen"}});
    EXPECT_EQ(preregister(plan, {"--power"}).exit_code, 0);
    plan = sample_plan();
    plan["questions"] =
        Json::array({{{"id", "who"}, {"kind", "choice"}, {"of_videos", true}, {"text", "Which?"}}});
    EXPECT_THAT(refusal(), HasSubstr("because it asks for neither preferences nor scores; leave --power and "
                                     "\"smallest_effect\" out, or ask for a preference, a rating,"));
    plan["layout"] = "single";
    plan["questions"] =
        Json::array({{{"id", "natural"}, {"kind", "rating"}, {"points", 7}, {"text", "How?"}}});
    plan["conditions"].erase(1);
    for (Json& clip : plan["clips"]) clip["motion"].erase("baseline");
    EXPECT_THAT(refusal(),
                HasSubstr("because there is one condition alone; leave --power and \"smallest_effect\" out, "
                          "or name another condition"));
}

TEST_F(Preregistered, SaysWhatThePlanSays) {
    Json plan = sample_plan();
    plan["participants"] = 12;
    plan["exclusions"] = {{"failed_checks", 3}, {"fastest_seconds", 2.5}};
    plan["checks"] = {{"count", 1}, {"kinds", {"text"}}};
    plan["preregistration"] = {{"description", "<b>About</b> gestures of ours & baseline."},
                               {"hypotheses", {"H1: ours is preferred.", "H2: more so on c1."}},
                               {"smallest_effect", 150},
                               {"stopping_rule", "In May."}};
    const Outcome outcome = preregister(plan);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(item("Hypotheses")["said"], plan["preregistration"]["hypotheses"]);
    EXPECT_EQ(item("Hypotheses")["missing"], nullptr);
    EXPECT_THAT(page(), HasSubstr("&lt;b&gt;About&lt;/b&gt; gestures of ours &amp; baseline."));
    EXPECT_THAT(page(), Not(HasSubstr("<b>About")));
    EXPECT_THAT(item("Sample size")["fixed"].dump(), HasSubstr("12 participants"));
    EXPECT_THAT(item("Data exclusion")["fixed"].dump(), HasSubstr("3 or more failed checks"));
    EXPECT_THAT(item("Data exclusion")["fixed"].dump(), HasSubstr("less than 2.5 s"));
    EXPECT_THAT(item("Data exclusion")["fixed"].dump(), Not(HasSubstr("slider")));
    EXPECT_EQ(item("Stopping rule")["said"], Json::array({"In May."}));
    // The power is the one that --power finds.
    const Json power = data()["power"];
    const Outcome asked =
        run_chironomia({"study", "plan", (folder_ / "plan.json").string(), "--power", "--effect", "150"});
    const std::string needed =
        format("150 Elo between two conditions needs {} participants", power["participants_needed"].dump());
    EXPECT_THAT(asked.out, HasSubstr(needed));
    EXPECT_THAT(
        item("Sample size rationale")["fixed"].dump(),
        HasSubstr(format("{} participants find it with 80 % power", power["participants_needed"].dump())));
    EXPECT_EQ(data()["plan_sha256"], sha256(data()["plan"].dump()));
    // A plan as used says the same.
    write_json(folder_ / "used.json", data()["plan"]);
    const std::string first = page();
    ASSERT_EQ(preregister(data()["plan"]).exit_code, 0);
    EXPECT_EQ(page(), first);
}

TEST_F(Preregistered, SaysHowNearASliderOfACheckMustBe) {
    Json plan = sample_plan();
    plan["layout"] = "parallel";
    plan["checks"] = {{"count", 1}, {"kinds", {"text"}}};
    plan["questions"] = {{{"id", "s"},
                          {"kind", "slider"},
                          {"text", "How good?"},
                          {"least", 0},
                          {"most", 100},
                          {"labels", {"good", "bad"}},
                          {"each", true}}};
    const Outcome outcome = preregister(plan);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(item("Data exclusion")["fixed"].dump(), HasSubstr("A slider may be up to 3 % of its width"));
}

TEST_F(Preregistered, NamesTestsOfAllConditionsWhereThereAreThree) {
    Json plan = sample_plan();
    plan["layout"] = "single";
    plan["questions"] = {{{"id", "natural"}, {"kind", "rating"}, {"text", "How natural?"}, {"points", 5}}};
    ASSERT_EQ(preregister(plan).exit_code, 0);
    EXPECT_THAT(item("Statistical models")["fixed"].dump(), Not(HasSubstr("Friedman")));
    plan["conditions"].push_back({{"name", "frozen"}, {"from", "ours"}, {"by", "frozen"}});
    const Outcome outcome = preregister(plan);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(
        item("Statistical models")["fixed"].dump(),
        HasSubstr("Over all conditions, of the participants who rated each of them: Friedman's test"));
}

// Of one page each, participants are groups of different people, as `study analyse` takes them.
TEST_F(Preregistered, NamesTestsOfGroupsWhereEachSeesOneCondition) {
    Json plan = sample_plan();
    plan["layout"] = "single";
    plan["pages_per_participant"] = 1;
    plan["questions"] =
        Json::array({{{"id", "natural"}, {"kind", "rating"}, {"text", "How?"}, {"points", 5}}});
    ASSERT_EQ(preregister(plan).exit_code, 0);
    EXPECT_THAT(item("Statistical models").dump(), HasSubstr("For each two conditions Welch's t test"));
    EXPECT_THAT(item("Statistical models").dump(), Not(HasSubstr("paired t")));
    EXPECT_THAT(item("Randomization").dump(), Not(HasSubstr("Sides")));
}

TEST_F(Preregistered, NamesScalesWithTheirItems) {
    Json plan = sample_plan();
    plan["layout"] = "single";
    for (const char* id : {"kind", "friendly", "awful"})
        plan["questions"].push_back({{"id", id}, {"kind", "rating"}, {"text", "?"}, {"points", 5}});
    plan["scales"] = {
        {{"id", "likeability"}, {"items", {"kind", "friendly", "awful"}}, {"reversed", {"awful"}}}};
    const Outcome outcome = preregister(plan);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("likeability"));
    EXPECT_THAT(
        item("Indices")["fixed"].dump(),
        HasSubstr("Scale likeability, of each answer that has all items and analysed like a rating, with "
                  "Cronbach's alpha: Mean of kind, friendly and awful (reversed)."));
}

TEST_F(Preregistered, HasTheSameBytesForAnySeedAndNoneInIt) {
    Json plan = sample_plan();
    plan["preregistration"] = {{"smallest_effect", 200}};
    ASSERT_EQ(preregister(plan, {"--seed", "918273645"}).exit_code, 0);
    const std::string first = page();
    EXPECT_THAT(first, Not(HasSubstr("918273645")));
    ASSERT_EQ(preregister(plan, {"--seed", "5"}).exit_code, 0);
    EXPECT_EQ(page(), first);
}

TEST_F(Preregistered, IsShownByABrowserAndNeedsNoOtherFile) {
    if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
    Json plan = sample_plan();
    plan["preregistration"] = {{"other", "</script><script>document.title = 'broken'</script>"}};
    ASSERT_EQ(preregister(plan).exit_code, 0);
    const TemporaryFolder profile;
    Browser browser(profile.path());
    browser.open("file://" + (folder_ / "out.html").string());
    EXPECT_EQ(browser.evaluate("document.title"), "Preregistration: Two ways to move");
    EXPECT_EQ(
        browser.evaluate("JSON.parse(document.getElementById('preregistration').textContent).items.length"),
        23);
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('[src], link').length"), 0);
}

TEST_F(Preregistered, RefusesWhatIsNoPreregistration) {
    Json plan = sample_plan();
    plan["preregistration"] = {{"hypothesis", "H1"}};
    Outcome outcome = preregister(plan);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("preregistration.hypothesis"));
    EXPECT_THAT(outcome.err, HasSubstr("did you mean \"hypotheses\"?"));
    plan["preregistration"] = {{"smallest_effect", 0}};
    outcome = preregister(plan);
    EXPECT_THAT(outcome.err,
                HasSubstr("preregistration.smallest_effect: is 0, a number from 0.001 to 2000 is needed"));
    plan["preregistration"] = {{"hypotheses", Json::array()}};
    EXPECT_EQ(preregister(plan).exit_code, 3);
    EXPECT_EQ(run_chironomia({"study", "plan", (folder_ / "plan.json").string(), "--effect", "5"}).exit_code,
              2);
}

}  // namespace
}  // namespace chironomia::study::analysis
