// A study's public folder written by hand, with tiny real videos, and a browser that shows it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "core/files/files.h"
#include "core/text.h"
#include "study/build/pages.h"
#include "tests/study/tiny_maker.h"
#include "tests/study/walk.h"
#include "tests/support/support.h"

namespace chironomia::testing {

using namespace study;

inline Json preference(const std::string& id = "realism") {
    return {{"id", id},
            {"kind", "preference"},
            {"text", "Which moves more like a real person?"},
            {"answers", {"A clearly", "A slightly", "They are equal", "B slightly", "B clearly"}}};
}

inline Json preference_with_reasons() {
    Json question = preference();
    question["reasons"] = {{"text", "Why?"},
                           {"options",
                            {{{"id", "smoothness"}, {"text", "Smoothness"}},
                             {{"id", "amount"}, {"text", "Amount of movement"}}}},
                           {"other", "Something else"},
                           {"unless", 3}};
    return question;
}

inline Json rating(const std::string& id, int points = 7) {
    return {{"id", id},
            {"kind", "rating"},
            {"text", format("How {} are the gestures?", id)},
            {"points", points},
            {"labels", {{"1", "not at all"}, {std::to_string(points), "very"}}}};
}

class PageFixture : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
        for (int i = 0; i < 8; ++i) {
            write_tiny_video(folder_ / "public/clips" / (token(i) + ".mp4"),
                             {.size = {.width = 64, .height = 36},
                              .fps = Rate{10, 1},
                              .frames = 5,
                              .grey = static_cast<std::uint8_t>(40 + 20 * i)});
        }
        for (const PlayerFile& file : player_files())
            write_text(folder_ / "public" / file.name, file.content);
        browser_ = std::make_unique<Browser>(folder_.path());
        browser_->resize(1280, 800);
    }

    static std::string token(int video) { return format("aa0000000000000{}", video); }

    // Two pages in two sheets; `videos` of each page, and the questions are asked in one pass.
    static Json study_of(const std::string& layout, int videos, const Json& questions) {
        Json page = {{"videos", Json::array()}, {"seconds", 0.5}, {"caption", ""}};
        Json order = Json::array(), turned = Json::array();
        for (int i = 0; i < videos; ++i) {
            page["videos"].push_back(format("clips/{}.mp4", token(i)));
            order.push_back(i);
            turned.push_back(videos - 1 - i);
        }
        Json asked = Json::array();
        for (std::size_t i = 0; i < questions.size(); ++i) asked.push_back(i);
        page["passes"] = {{{"sound", true}, {"questions", asked}}};
        Json pages = Json::array();
        for (const char* id : {"00000000000000p0", "00000000000000p1"}) {
            page["id"] = id;
            pages.push_back(page);
        }
        return {{"format", "chironomia pages 2"},
                {"study", "3f0c9a5b1e2d4c68"},
                {"language", "en"},
                {"title", "Two ways to move"},
                {"texts", Json::object()},
                {"layout", layout},
                {"one_by_one", false},
                {"width", 64},
                {"height", 36},
                {"sound", true},
                {"shuffle_questions", false},
                {"skip_after", nullptr},
                {"instructions", "Watch, then answer."},
                {"consent", nullptr},
                {"training", nullptr},
                {"sound_check", nullptr},
                {"questions", questions},
                {"pages", pages},
                {"sheets", {{{"pages", {{0, order}, {1, order}}}}, {{"pages", {{1, turned}, {0, turned}}}}}},
                {"questionnaire", Json::array()},
                {"completion", nullptr}};
    }

    void write_study() {
        write_text(folder_ / "public/index.html", make_index_page(study_));
        url_ = "file://" + (folder_ / "public/index.html").string();
    }

    // Shows the study as a file.
    void open(const std::string& query = "?p=0") {
        write_study();
        reload(query);
    }

    void reload(const std::string& query = "?p=0") {
        browser_->open("about:blank");
        browser_->open(url_ + query);
    }

    Json walk(const Walker& walker = {}, const std::string& query = "?p=0") {
        write_study();
        return walk_study(*browser_, url_ + query, walker);
    }

    Json evaluate(const std::string& script) { return browser_->evaluate(script); }
    std::string text_of(const std::string& id) {
        return evaluate(format("document.getElementById('{}').textContent", id));
    }
    void click(const std::string& selector) {
        evaluate(format("document.querySelector('{}').click()", selector));
    }
    void wait_for(const std::string& script) {
        ASSERT_TRUE(browser_->wait_for(script)) << script << "\n" << evaluate("document.body.innerText");
    }
    void wait_for_section(const std::string& id) {
        wait_for(format("!document.getElementById('{}').hidden", id));
    }
    // Clicks on what loads the page again, and waits until that is done.
    void click_and_reload(const std::string& selector) {
        evaluate("window.isOld = true");
        click(selector);
        wait_for("document.readyState === 'complete' && window.isOld === undefined");
    }
    void start() {
        click("#start");
        wait_for_section("trial");
    }
    void end_videos() {
        evaluate("trial.stage.screens.forEach(({video}) => video.dispatchEvent(new Event('ended')))");
    }
    // Of the page that is shown.
    Json values() { return evaluate("trial.form.values()"); }
    bool may_go_on() { return evaluate("!document.getElementById('next').disabled"); }

    TemporaryFolder folder_;
    std::unique_ptr<Browser> browser_;
    Json study_ = study_of("pair", 2, Json::array({preference()}));
    std::string url_;
};

}  // namespace chironomia::testing
