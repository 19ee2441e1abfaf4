// What a page gives to those who see, hear or move in other ways.
#include "study/html/html.h"
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

    static Json slider() {
        return {{"id", "quality"},     {"kind", "slider"},
                {"text", "How good?"}, {"least", 0},
                {"most", 100},         {"labels", {"excellent", "good", "fair", "poor", "bad"}}};
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
    evaluate("byId('lost').close(); study.questionnaire[0].optional = false; void fillQuestionnaireIn()");
    look_at("questionnaire");
    EXPECT_EQ(text_of("questionnaire-problem"), "One question is still open.");
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
    EXPECT_EQ(evaluate("[...document.querySelectorAll('[role=radiogroup]')].map((group) => group.ariaLabel)"),
              Json({"How real? A", "How real? B", "How real? C", "How real? D"}));
}

TEST_F(StudyPageAccess, ReadsTheLabelsOfSliders) {
    study_ = study_of("single", 1, Json::array({slider()}));
    open();
    start();
    EXPECT_EQ(
        evaluate("byId(document.querySelector('[type=range]').getAttribute('aria-describedby')).textContent"),
        "bad poor fair good excellent ");
    end_videos();
    evaluate("document.querySelector('[type=range]').focus()");
    browser_->press("ArrowRight");
    EXPECT_EQ(evaluate("document.querySelector('[type=range]').getAttribute('aria-valuetext')"), "51, fair");
    EXPECT_EQ(evaluate("document.querySelectorAll('#trial output').length"), 0);
}

// How many colors there are between the edges of an element, but for those of its frame.
constexpr const char* kColors = R"((async () => {
    const {left, top, width, height} = document.querySelector('@element').getBoundingClientRect();
    const image = await createImageBitmap(await (await fetch('data:image/png;base64,@picture')).blob());
    const paper = new OffscreenCanvas(width, height).getContext('2d');
    paper.drawImage(image, -left, -top);
    const {data} = paper.getImageData(2, 2, width - 4, height - 4);
    return new Set(new Uint32Array(data.buffer)).size;
})())";

TEST_F(StudyPageAccess, ShowsSlidersAndProgressInForcedColors) {
    study_ = study_of("single", 1, Json::array({slider()}));
    open();
    start();
    end_videos();
    evaluate("document.querySelector('[type=range]').focus()");
    browser_->press("ArrowRight");
    evaluate("document.activeElement.blur(), document.querySelector('.controls progress').value = 0.5");
    browser_->force_colors();
    const std::string picture = browser_->picture();
    const auto colors = [&](const std::string& element) {
        std::string script = kColors;
        replace_mark(script, "@element", element);
        replace_mark(script, "@picture", picture);
        return evaluate(script).get<int>();
    };
    EXPECT_GE(colors("[type=range]"), 3) << "ground, track and thumb";
    EXPECT_GE(colors(".controls progress"), 2);
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
        wait_for(format("innerWidth === {}", width));
        evaluate("new Promise((done) => requestAnimationFrame(() => setTimeout(done)))");
        EXPECT_EQ(evaluate("document.activeElement.tagName"), "TEXTAREA") << width;
    }
    EXPECT_EQ(values(), Json({{"words", "222"}}));
    EXPECT_EQ(evaluate("document.querySelectorAll('.questions, .aside').length"), 1);
}

TEST_F(StudyPageAccess, SaysBesideNextOfANarrowWindowWhyItIsClosed) {
    open();
    start();
    evaluate("narrowAllowed = true");
    browser_->resize(390, 800);
    wait_for("document.querySelector('.next #status') !== null");
    EXPECT_EQ(evaluate("byId('shortcuts').checkVisibility()"), true) << "keys can be switched off";
    browser_->resize(1280, 800);
    wait_for("document.querySelector('.row #status') !== null");
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
