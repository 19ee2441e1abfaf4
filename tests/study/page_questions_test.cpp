// Every kind of question in a real browser, and the values that its answers have.
#include "tests/study/page_fixture.h"

namespace chironomia::study {
namespace {

using ::testing::HasSubstr;
using testing::preference;
using testing::preference_with_reasons;
using testing::rating;
using testing::ShownPage;

class StudyPageQuestions : public testing::PageFixture {
  protected:
    void ask(const std::string& layout, int videos, const Json& questions) {
        study_ = study_of(layout, videos, questions);
    }

    void open_watched() {
        open();
        start();
        end_videos();
    }

    // The values of the first page when every question is answered as `answers` says.
    Json values_of(const Json& answers) {
        const Json saved = walk({.answer = [&](const ShownPage&, const Json& question) {
            return answers.at(question["id"].get<std::string>());
        }});
        return saved["answers"][0]["values"];
    }
};

Json options(const std::vector<std::string>& ids) {
    Json list = Json::array();
    for (const std::string& id : ids) list.push_back({{"id", id}, {"text", "Option " + id}});
    return list;
}

TEST_F(StudyPageQuestions, HaveTheValuesOfTheContract) {
    const Json each = {{"id", "each"}, {"kind", "rating"}, {"text", "?"}, {"points", 5}, {"each", true}};
    const Json sure = {{"id", "sure"}, {"kind", "slider"}, {"text", "?"}, {"least", -10}, {"most", 10}};
    const Json quality = {{"id", "quality"}, {"kind", "slider"}, {"text", "?"},
                          {"least", 0},      {"most", 100},      {"each", true}};
    ask("parallel", 3,
        {preference(),
         rating("natural", 11),
         each,
         sure,
         quality,
         {{"id", "what"}, {"kind", "choice"}, {"text", "?"}, {"options", options({"speed", "size"})}},
         {{"id", "which"}, {"kind", "choice"}, {"text", "?"}, {"of_videos", true}},
         {{"id", "order"}, {"kind", "rank"}, {"text", "?"}, {"options", options({"x", "y", "z", "u"})}},
         {{"id", "best"}, {"kind", "rank"}, {"text", "?"}, {"of_videos", true}},
         {{"id", "words"}, {"kind", "text"}, {"text", "?"}},
         {{"id", "open"}, {"kind", "text"}, {"text", "?"}, {"optional", true}},
         {{"id", "count"}, {"kind", "number"}, {"text", "?"}, {"least", 0}, {"most", 9}},
         {{"id", "half"}, {"kind", "number"}, {"text", "?"}}});
    const Json answers = {{"realism", 5},        {"natural", 11},           {"each", {1, 5, 3}},
                          {"sure", -7},          {"quality", {0, 100, 33}}, {"what", "size"},
                          {"which", 2},          {"order", {4, 1, 3, 2}},   {"best", {2, 3, 1}},
                          {"words", "<b>é</b>"}, {"open", nullptr},         {"count", 9},
                          {"half", 0.5}};
    EXPECT_EQ(values_of(answers), answers);
}

TEST_F(StudyPageQuestions, CountBothFiguresOfOneVideo) {
    ask("pair", 1,
        {{{"id", "each"}, {"kind", "rating"}, {"text", "?"}, {"points", 5}, {"each", true}},
         {{"id", "which"}, {"kind", "choice"}, {"text", "?"}, {"of_videos", true}}});
    const Json answers = {{"each", {1, 5}}, {"which", 1}};
    EXPECT_EQ(values_of(answers), answers);
}

TEST_F(StudyPageQuestions, AskForReasonsUnlessTheAnswerNeedsNone) {
    ask("pair", 2, Json::array({preference_with_reasons()}));
    open_watched();
    browser_->press("3");
    EXPECT_TRUE(may_go_on());
    EXPECT_EQ(evaluate("trial.form.reasons()"), Json::object());
    EXPECT_EQ(evaluate("document.querySelector('.reasons').disabled"), true);
    browser_->press("4");
    EXPECT_FALSE(may_go_on());
    EXPECT_EQ(text_of("status"), "Please choose a reason too.");
    click("input[value=smoothness]");
    EXPECT_TRUE(may_go_on());
    click("input[value=smoothness]");
    evaluate(
        "walker = {type(input, value) { input.value = value; "
        "input.dispatchEvent(new Event('input', {bubbles: true})); }}; "
        "walker.type(document.querySelector('.other input'), ' the eyes ')");
    EXPECT_TRUE(may_go_on());
    EXPECT_EQ(evaluate("trial.form.reasons()"),
              Json({{"realism", {{"chosen", Json::array()}, {"other", "the eyes"}}}}));
}

TEST_F(StudyPageQuestions, AreShuffledTheSameWayAfterAReload) {
    Json questions = Json::array();
    for (const char* id : {"a", "b", "c", "d", "e", "f"}) questions.push_back(rating(id));
    ask("single", 1, questions);
    study_["shuffle_questions"] = true;
    const auto order = [&](const std::string& query) {
        reload(query);
        start();
        return evaluate(
                   "[...document.querySelectorAll('[data-question]')].map((one) => "
                   "one.dataset.question).join('')")
            .get<std::string>();
    };
    open();
    const std::string first = order("?p=0");
    EXPECT_EQ(order("?p=0"), first);
    std::set<std::string> orders;
    for (const char* query : {"?p=0", "?p=1", "?p=2", "?p=3"}) orders.insert(order(query));
    EXPECT_EQ(orders.size(), 4u);
    for (std::string one : orders) {
        std::sort(one.begin(), one.end());
        EXPECT_EQ(one, "abcdef");
    }
    // The answers stay with their questions.
    const Json saved = walk({.answer = [](const ShownPage&, const Json& question) {
        return question["id"].get<std::string>()[0] - 'a' + 1;
    }});
    EXPECT_EQ(saved["answers"][0]["values"],
              Json({{"a", 1}, {"b", 2}, {"c", 3}, {"d", 4}, {"e", 5}, {"f", 6}}));
}

TEST_F(StudyPageQuestions, RefuseANumberOutsideItsLimits) {
    ask("single", 1,
        {{{"id", "n"},
          {"kind", "number"},
          {"text", "How many?"},
          {"least", 1},
          {"most", 9},
          {"optional", true}}});
    open_watched();
    EXPECT_TRUE(may_go_on());
    evaluate("document.querySelector('input[type=number]').focus()");
    browser_->press("1");
    browser_->press("0");
    EXPECT_FALSE(may_go_on());
    EXPECT_EQ(text_of("status"), "How many? – A number from 1 to 9");
    EXPECT_EQ(evaluate("document.querySelector('input[type=number]').ariaInvalid"), "true");
    const std::string at_the_field =
        "document.getElementById(document.querySelector('input[type=number]').getAttribute('aria-describedby'))"
        ".textContent";
    EXPECT_EQ(evaluate(at_the_field), "A number from 1 to 9");
    evaluate("document.querySelector('input[type=number]').value = ''");
    browser_->press("7");
    EXPECT_TRUE(may_go_on());
    EXPECT_EQ(evaluate(at_the_field), "");
}

// As the server and the analysis do (answer_values_test.cpp).
TEST_F(StudyPageQuestions, RefuseANumberWithoutLimitsThatIsATypingSlip) {
    ask("single", 1, {{{"id", "n"}, {"kind", "number"}, {"text", "How many?"}, {"optional", true}}});
    open_watched();
    evaluate("document.querySelector('input[type=number]').focus()");
    for (const char* key : {"1", "e", "9"}) browser_->press(key);
    EXPECT_TRUE(may_go_on());
    browser_->press("9");
    EXPECT_FALSE(may_go_on());
    EXPECT_EQ(text_of("status"), "How many? – A number from -1000000000 to 1000000000");
}

// A part of an answer that may be left open would be lost: it is completed, or taken back.
TEST_F(StudyPageQuestions, OfAllVideosAreAnsweredForAllOrForNone) {
    const Json slider = {{"id", "quality"}, {"kind", "slider"}, {"text", "?"},     {"least", 0},
                         {"most", 100},     {"each", true},     {"optional", true}};
    const Json each = {{"id", "each"}, {"kind", "rating"}, {"text", "?"},
                       {"points", 5},  {"each", true},     {"optional", true}};
    ask("parallel", 3, {slider, each});
    open_watched();
    EXPECT_TRUE(may_go_on());
    const auto move = [&](int place, int value) {
        evaluate(
            format("(() => {{ const slider = document.querySelectorAll('[data-question=quality] input')[{}]; "
                   "slider.value = {}; slider.dispatchEvent(new Event('input', {{bubbles: true}})); "
                   "slider.dispatchEvent(new Event('change', {{bubbles: true}})); }})()",
                   place, value));
    };
    const auto rate = [&](int place, int value) {
        evaluate(format("document.querySelectorAll('[data-question=each] input')[{}].click()",
                        5 * place + value - 1));
    };
    move(0, 80);
    move(1, 20);
    EXPECT_FALSE(may_go_on());
    EXPECT_EQ(text_of("status"), "One question is still open.");
    rate(2, 4);
    EXPECT_EQ(text_of("status"), "2 questions are still open.");
    click("[data-question=quality] button.plain");
    click("[data-question=each] button.plain");
    EXPECT_TRUE(may_go_on());
    EXPECT_EQ(values(), Json({{"quality", nullptr}, {"each", nullptr}}));
    EXPECT_EQ(evaluate("document.querySelector('[data-question=quality] .number').textContent"), "–");
    for (int place = 0; place < 3; ++place) move(place, 10 * place);
    for (int place = 0; place < 3; ++place) rate(place, place + 1);
    EXPECT_TRUE(may_go_on());
    EXPECT_EQ(values(), Json({{"quality", {0, 10, 20}}, {"each", {1, 2, 3}}}));
}

TEST_F(StudyPageQuestions, RankAllOptionsOrNone) {
    ask("single", 1,
        {{{"id", "order"},
          {"kind", "rank"},
          {"text", "?"},
          {"options", options({"x", "y", "z"})},
          {"optional", true}}});
    open_watched();
    EXPECT_TRUE(may_go_on());
    browser_->press("3");
    EXPECT_FALSE(may_go_on());
    click("#questions button.plain");
    EXPECT_TRUE(may_go_on());
}

TEST_F(StudyPageQuestions, RankByKeysAndTakeRanksBack) {
    ask("single", 1,
        {{{"id", "order"}, {"kind", "rank"}, {"text", "?"}, {"options", options({"x", "y", "z"})}}});
    open_watched();
    for (const char* key : {"3", "1"}) browser_->press(key);
    EXPECT_FALSE(may_go_on());
    browser_->press("3");  // out again: x moves up
    browser_->press("2");
    browser_->press("3");
    EXPECT_EQ(values(), Json({{"order", {1, 2, 3}}}));
    EXPECT_EQ(evaluate("document.querySelector('button.rank').getAttribute('aria-label')"),
              "Option x, rank 1");
    click("#questions button.plain");
    EXPECT_EQ(values()["order"], Json());
}

}  // namespace
}  // namespace chironomia::study
