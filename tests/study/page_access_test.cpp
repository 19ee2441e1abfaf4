// What a page gives to those who see, hear or move in other ways.
#include "tests/study/page_fixture.h"

namespace chironomia::study {
namespace {

using testing::rating;

// What WCAG 2.1 AA asks for and a program can see: names of controls, and the contrast of texts.
class StudyPageAccess : public testing::PageFixture {
  protected:
    void look_at(const std::string& what) {
        EXPECT_EQ(evaluate("access.nameless()"), Json::array()) << what;
        EXPECT_EQ(evaluate("access.pale()"), Json::array()) << what;
    }

    void open_with_eyes() {
        open();
        evaluate(read_text(testing::source_dir() / "tests/study/access.js"));
    }
};

TEST_F(StudyPageAccess, IsThereInEverySection) {
    study_["consent"] = {{"text", "You may stop at any time."}};
    study_["questions"] = {testing::preference_with_reasons(), rating("natural"), rating("fluent")};
    for (Json& page : study_["pages"]) page["passes"][0]["questions"] = {0, 1, 2};
    study_["questionnaire"] = Json::parse(
        R"([{"id": "age", "kind": "number", "text": "Age", "least": 18, "most": 99, "optional": true},
            {"id": "note", "kind": "text", "text": "Notes", "optional": true}])");
    open_with_eyes();
    look_at("consent");
    click("#agree");
    wait_for_section("intro");
    look_at("intro");
    start();
    look_at("a page");
    EXPECT_EQ(evaluate("[...document.querySelectorAll('.controls progress')].map((bar) => bar.ariaLabel)"),
              Json({"Video A: How far the video has played", "Video B: How far the video has played"}));
    EXPECT_EQ(evaluate("byId('shortcuts').getAttribute('aria-describedby')"), "keys-text");
    end_videos();
    look_at("a watched page");
    evaluate("byId('lost').showModal()");
    look_at("the lost connection");
    evaluate("byId('lost').close(); void fillQuestionnaireIn()");
    look_at("questionnaire");
    evaluate("state.finished = true; showEnd()");
    look_at("end");
}

TEST_F(StudyPageAccess, IsThereForVideosOneAtATime) {
    study_ = study_of("parallel", 4,
                      Json::parse(R"([{"id": "quality", "kind": "slider", "text": "How good?", "least": 0,
                                       "most": 100, "labels": ["good", "bad"], "each": true},
                                      {"id": "best", "kind": "rank", "text": "Which is best?", "of_videos": true},
                                      {"id": "real", "kind": "rating", "text": "How real?", "points": 5, "each": true}])"));
    open_with_eyes();
    start();
    look_at("a page");
    end_videos();
    for (const char* key : {"2", "1"}) browser_->press(key);
    look_at("a watched page");
}

TEST_F(StudyPageAccess, KeepsTheFocusWhereItIsWhenTheWindowChanges) {
    study_ = study_of("single", 1, {{{"id", "words"}, {"kind", "text"}, {"text", "?"}}, rating("natural")});
    study_["pages"][0]["passes"][0]["questions"] = {0};
    study_["pages"][1]["passes"][0]["questions"] = {0, 1};  // another form is measured
    open();
    start();
    end_videos();
    evaluate("document.querySelector('textarea').focus()");
    for (const int width : {1100, 900, 1280}) {
        browser_->press("2");
        browser_->resize(width, 700);
        wait_for(format("innerWidth === {} && new Promise((done) => requestAnimationFrame(() => done(true)))",
                        width));
        EXPECT_EQ(evaluate("document.activeElement.tagName"), "TEXTAREA") << width;
    }
    EXPECT_EQ(values(), Json({{"words", "222"}}));
    EXPECT_EQ(evaluate("document.querySelectorAll('.questions, .aside').length"), 1);
}

TEST_F(StudyPageAccess, StopsVideosThatNobodySees) {
    open();
    start();
    evaluate("trial.stage.screens[0].video.loop = true");
    click(".play");
    wait_for("!document.querySelector('video').paused");
    click("#your-data");
    EXPECT_EQ(evaluate("document.querySelector('video').paused"), true);
    wait_for("byId('data').open");
    click("#data-close");
    click(".play");
    wait_for("!document.querySelector('video').paused");
    evaluate(
        "Object.defineProperty(document, 'hidden', {value: true}); "
        "document.dispatchEvent(new Event('visibilitychange'))");
    EXPECT_EQ(evaluate("document.querySelector('video').paused"), true);
    EXPECT_EQ(evaluate("trial.events.filter(([, what]) => what === 'hidden').length"), 1);
}

}  // namespace
}  // namespace chironomia::study
