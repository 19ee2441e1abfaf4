// The page for jsPsych: its data, and, where jsPsych is at hand, a participant who walks through it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "study/server/answer_validation.h"
#include "study/server/served_study.h"
#include "tests/study/browser.h"
#include "tests/study/exports/exported_sample.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using testing::Browser;
using testing::ExportedSample;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::SampleStudy;

Json data_of(const ExportedSample& sample) {
    const std::string text = read_text(sample.open("study.js"));
    const std::string begin = "const study = ";
    EXPECT_TRUE(text.starts_with(begin));
    return Json::parse(text.substr(begin.size(), text.rfind(';') - begin.size()));
}

TEST(Jspsych, HasTheSheetsOfTheStudy) {
    ExportedSample sample({.trials = 3, .checks = 1, .sheets = 2});
    sample.write(ExportForm::jspsych);
    const ServedStudy study = read_served_study(sample.study());
    const Json data = data_of(sample);
    ASSERT_EQ(data["sheets"].size(), 2u);
    for (std::size_t sheet = 0; sheet < 2; ++sheet) {
        ASSERT_EQ(data["sheets"][sheet].size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) {
            const Step& step = study.sheets[sheet][i];
            const StudyPage& page = study.pages.pages[step.page];
            const Json& shown = data["sheets"][sheet][i];
            EXPECT_EQ(shown["page"], page.id);
            EXPECT_EQ(shown["videos"], Json(tokens_as_shown(page, step.order)));
            EXPECT_EQ(shown["addresses"], Json({page.videos[step.order[0]], page.videos[step.order[1]]}));
            EXPECT_TRUE(fs::exists(sample.open(shown["addresses"][0])));
        }
    }
    EXPECT_EQ(data["questions"][0]["reasons"]["options"][1]["id"], "amount");
    for (const char* name : {"\"ours\"", "\"baseline\"", "expected", "\"c0\""}) {
        EXPECT_THAT(sample.all_that_is_open(), Not(HasSubstr(name)));
    }
}

TEST(Jspsych, RefusesRankings) {
    ExportedSample sample({});
    sample.change("public/pages.json", [](Json& pages) {
        pages["questions"].push_back(
            {{"id", "order"}, {"kind", "rank"}, {"text", "Which order?"}, {"of_videos", true}});
    });
    sample.change("private/key.json", [](Json& key) {
        key["questions"].push_back(
            {{"id", "order"}, {"kind", "rank"}, {"text", "Which order?"}, {"of_videos", true}});
    });
    EXPECT_THAT(sample.refusal(ExportForm::jspsych), HasSubstr("\"order\" is a ranking"));
}

// The folder that CHIRONOMIA_JSPSYCH names holds jspsych.js and the others, as the note of the export lists
// them.
class JspsychPage : public ::testing::TestWithParam<SampleStudy> {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("CHIRONOMIA_JSPSYCH");
        if (!Browser::is_installed() || !folder)
            GTEST_SKIP() << "needs chromium, and jsPsych in $CHIRONOMIA_JSPSYCH";
        sample_.write(ExportForm::jspsych);
        fs::copy(folder, sample_.open("jspsych"), fs::copy_options::recursive);
    }

    ExportedSample sample_{GetParam()};
};

// What a participant does on a page: watches, takes the first of everything, and goes on.
constexpr const char* kGoOn = R"((() => {
    for (const video of document.querySelectorAll('video')) video.dispatchEvent(new Event('ended'));
    for (const radio of document.querySelectorAll('input[type=radio]')) {
        if (!document.querySelector(`input[name="${radio.name}"]:checked`)) radio.checked = true;
    }
    for (const slider of document.querySelectorAll('input[type=range]')) slider.dispatchEvent(new Event('input'));
    for (const box of document.querySelectorAll('input[type=checkbox]')) box.checked = true;
    const buttons = [...document.querySelectorAll('input[type=submit], button')].filter((one) => !one.disabled);
    if (buttons.length > 0) buttons[0].click();
    return document.getElementById('save') !== null;
})())";

TEST_P(JspsychPage, LetsAParticipantAnswerAllInTheFormOfTheContract) {
    testing::TemporaryFolder profile;
    Browser browser(profile.path());
    browser.open("file://" + sample_.open("index.html").string() + "?sheet=2&p=somebody");
    ASSERT_TRUE(browser.wait_for(kGoOn));
    const Json answers = browser.evaluate("answers()");
    EXPECT_EQ(answers["participant"], "somebody");
    EXPECT_EQ(answers["sheet"], 1);
    const ServedStudy study = read_served_study(sample_.study());
    ASSERT_EQ(answers["answers"].size(), study.sheets[1].size());
    for (std::size_t i = 0; i < study.sheets[1].size(); ++i) {
        const EntryFault fault = fault_of_entry(study.pages, study.sheets[1][i], answers["answers"][i]);
        EXPECT_EQ(fault.order + fault.fit, "") << answers["answers"][i];
    }
    EXPECT_EQ(fault_of_questionnaire(study.pages, answers["questionnaire"]), "");
}

INSTANTIATE_TEST_SUITE_P(Layouts, JspsychPage,
                         ::testing::Values(SampleStudy{.layout = "pair", .sheets = 2},
                                           SampleStudy{.layout = "single", .sheets = 2},
                                           SampleStudy{.layout = "parallel", .sheets = 2}),
                         [](const auto& info) { return info.param.layout; });

class JspsychSliders : public JspsychPage {};

TEST_P(JspsychSliders, HaveNoAnswerUntilTheyAreTouched) {
    testing::TemporaryFolder profile;
    Browser browser(profile.path());
    browser.open("file://" + sample_.open("index.html").string() + "?sheet=2&p=somebody");
    // Goes on to the first page with sliders, watches its videos and presses the button.
    ASSERT_TRUE(browser.wait_for(R"((() => {
        for (const video of document.querySelectorAll('video')) video.dispatchEvent(new Event('ended'));
        const button = [...document.querySelectorAll('input[type=submit], button')].find((one) => !one.disabled);
        if (button) button.click();
        return button && document.querySelector('input[type=range]') !== null;
    })())"));
    const std::string answered = R"((() => {
        document.querySelector('input[type=submit]').click();
        return {sliders: document.querySelectorAll('input[type=range]').length,
                asked: document.querySelectorAll('input[type=range]:invalid').length,
                fields: [...new FormData(document.querySelector('form')).keys()].length};
    })())";
    EXPECT_EQ(browser.evaluate(answered), (Json{{"sliders", 4}, {"asked", 4}, {"fields", 0}}));
    browser.evaluate("document.querySelector('input[type=range]').dispatchEvent(new Event('pointerdown'))");
    EXPECT_EQ(browser.evaluate(answered), (Json{{"sliders", 4}, {"asked", 3}, {"fields", 1}}));
}

INSTANTIATE_TEST_SUITE_P(Layouts, JspsychSliders,
                         ::testing::Values(SampleStudy{.layout = "parallel", .sheets = 2}),
                         [](const auto& info) { return info.param.layout; });

}  // namespace
}  // namespace chironomia
