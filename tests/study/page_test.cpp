// The page in a real browser: a participant watches, answers, reloads and saves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "study/build.h"
#include "tests/study/browser.h"
#include "tests/study/sample_plan.h"
#include "tests/study/tiny_maker.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::Browser;
using testing::FakeMaker;
using ::testing::HasSubstr;
using testing::sample_plan;
using testing::TemporaryFolder;

class StudyPage : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
        testing::write_sample_inputs(folder_.path());
        json_["render"]["size"] = {64, 48};
        fake_.lengths = {
            {"ours/c1.bvh", 0.6}, {"base/c1.bvh", 0.6}, {"ours/c2.bvh", 0.5}, {"base/c2.bvh", 0.5}};
    }

    void build_and_open(const std::string& query) {
        write_json(folder_ / "plan.json", json_);
        build_study(read_plan(folder_ / "plan.json"), {.out = folder_ / "study", .seed = 5, .quiet = true},
                    testing::tiny_maker(fake_));
        browser_ = std::make_unique<Browser>(folder_.path());
        url_ = "file://" + (folder_ / "study/public/index.html").string() + query;
        browser_->open(url_);
    }

    Json evaluate(const std::string& script) { return browser_->evaluate(script); }
    std::string text_of(const std::string& id) {
        return evaluate(format("document.getElementById('{}').textContent", id));
    }
    void click(const std::string& selector) {
        evaluate(format("document.querySelector('{}').click()", selector));
    }
    bool is_shown(const std::string& id) {
        return evaluate(format("!document.getElementById('{}').hidden", id)) == true;
    }

    Json key() { return read_json(folder_ / "study/private/key.json"); }

    Json json_ = sample_plan();
    FakeMaker fake_;
    TemporaryFolder folder_;
    std::unique_ptr<Browser> browser_;
    std::string url_;
};

constexpr const char* kAllWatched =
    "[...document.querySelectorAll('.watched')].every((mark) => mark.textContent)";

TEST_F(StudyPage, LetsAParticipantWatchAnswerAndSave) {
    build_and_open("?p=1");
    EXPECT_EQ(text_of("title"), "Two ways to move");
    EXPECT_TRUE(is_shown("intro"));
    click("#start");
    EXPECT_TRUE(is_shown("trial"));
    EXPECT_EQ(text_of("progress-text"), "Page 1 of 2");

    // Nobody answers before both videos were watched to their end.
    EXPECT_EQ(evaluate("document.getElementById('choices').disabled"), true);
    browser_->press("1");
    EXPECT_EQ(evaluate("document.querySelectorAll('input:checked').length"), 0);
    ASSERT_TRUE(browser_->wait_for("document.querySelector('video').readyState >= 2"));
    evaluate("document.querySelector('video').currentTime = 0.55");
    EXPECT_TRUE(browser_->wait_for("document.querySelector('video').currentTime < 0.1"));

    click("#both");
    ASSERT_TRUE(browser_->wait_for(kAllWatched));
    EXPECT_EQ(evaluate("document.getElementById('choices').disabled"), false);
    EXPECT_EQ(evaluate("document.getElementById('next').disabled"), true);
    browser_->press("4");
    EXPECT_EQ(evaluate("document.getElementById('next').disabled"), false);
    browser_->press("Enter");
    EXPECT_EQ(text_of("progress-text"), "Page 2 of 2");

    // A reload goes on where it was.
    browser_->open("about:blank");
    browser_->open(url_);
    EXPECT_EQ(text_of("start"), "Go on");
    EXPECT_EQ(text_of("resume-note"), "You have answered 1 of 2 pages.");
    click("#start");
    EXPECT_EQ(text_of("progress-text"), "Page 2 of 2");
    for (int video = 0; video < 2; ++video) {
        browser_->press(" ");
        ASSERT_TRUE(
            browser_->wait_for(format("document.querySelectorAll('.watched')[{}].textContent", video)));
    }
    click("#answers label:nth-child(2) input");
    click("#next");
    ASSERT_TRUE(is_shown("finish"));

    const Json saved =
        Json::parse(evaluate("document.getElementById('answer-text').value").get<std::string>());
    EXPECT_EQ(evaluate("fetch(document.getElementById('download').href).then((file) => file.json())"), saved);
    EXPECT_EQ(saved["participant"], "1");
    EXPECT_EQ(saved["order"], 1);
    EXPECT_EQ(saved["answers"].size(), 2u);
    EXPECT_EQ(saved["answers"][0]["answer"], 4);
    EXPECT_EQ(saved["answers"][1]["answer"], 2);
    EXPECT_EQ(saved["study"], key()["study"]);
}

// The answers name the videos from left to right as they stood, so that the key can tell who was better.
TEST_F(StudyPage, NotesWhichVideoStoodWhere) {
    build_and_open("?order=1");
    const Json order = read_json(folder_ / "study/public/pages.json")["orders"][1];
    ASSERT_EQ(order["swapped"], true);
    click("#start");
    const Json sources = evaluate("[...document.querySelectorAll('video')].map((video) => video.src)");
    const Json page = key()["pages"][order["pages"][0].get<std::size_t>()];
    EXPECT_THAT(sources[0].get<std::string>(), HasSubstr(page["videos"][1].get<std::string>()));
    EXPECT_THAT(sources[1].get<std::string>(), HasSubstr(page["videos"][0].get<std::string>()));
    click("#both");
    ASSERT_TRUE(browser_->wait_for(kAllWatched));
    browser_->press("1");
    browser_->press("Enter");
    const Json answer = evaluate("state.answers[0]");
    EXPECT_EQ(answer["page"], page["page"]);
    EXPECT_EQ(answer["videos"], Json::array({page["videos"][1], page["videos"][0]}));
    EXPECT_EQ(answer["swapped"], true);
    EXPECT_EQ(answer["answer"], 1);
}

TEST_F(StudyPage, ShowsOneVideoWithBothFigures) {
    json_["presentation"] = "one video";
    json_["render"]["format"] = "webm";
    build_and_open("?p=ann");
    click("#start");
    EXPECT_EQ(evaluate("document.querySelectorAll('video').length"), 1);
    EXPECT_FALSE(is_shown("both"));
    EXPECT_EQ(evaluate("document.querySelector('.halves').textContent"), "AB");
    browser_->press(" ");
    ASSERT_TRUE(browser_->wait_for(kAllWatched));
    browser_->press("3");
    browser_->press("Enter");
    EXPECT_EQ(text_of("progress-text"), "Page 2 of 2");
}

TEST_F(StudyPage, SpreadsNamesOverTheOrders) {
    build_and_open("?p=ann");
    const Json counts = evaluate(
        "(() => { const counts = study.orders.map(() => 0); for (let i = 0; i < 400; ++i) "
        "++counts[findOrder('person "
        "' + i)]; return counts; })()");
    ASSERT_EQ(counts.size(), 4u);
    for (const Json& count : counts) EXPECT_NEAR(count.get<int>(), 100, 40);
}

TEST_F(StudyPage, SaysWhenAVideoCannotBeLoaded) {
    build_and_open("");
    evaluate("study.pages.forEach((page) => { page.videos = page.videos.map((path) => path + 'x'); })");
    click("#start");
    EXPECT_TRUE(browser_->wait_for("document.querySelectorAll('.message').length === 2"));
    EXPECT_THAT(evaluate("document.querySelector('.message').textContent").get<std::string>(),
                HasSubstr("This video could not be loaded. Please check your connection."));
}

}  // namespace
}  // namespace chironomia
