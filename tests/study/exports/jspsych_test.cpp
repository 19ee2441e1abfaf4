// The page for jsPsych: its data, and, where jsPsych is at hand, a participant who walks through it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>

#include "study/analysis/answers.h"
#include "study/server/answer_validation.h"
#include "study/server/served_study.h"
#include "tests/study/browser.h"
#include "tests/study/exports/exported_sample.h"
#include "tests/study/tiny_server.h"

namespace chironomia::study {
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
    const server::ServedStudy study = server::read_served_study(sample.study());
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
            EXPECT_EQ(shown["names"], Json({"A", "B"}));
            EXPECT_EQ(shown["addresses"], Json({page.videos[step.order[0]], page.videos[step.order[1]]}));
            EXPECT_TRUE(fs::exists(sample.open(shown["addresses"][0])));
        }
    }
    EXPECT_EQ(data["questions"][0]["reasons"]["options"][1]["id"], "amount");
    for (const char* name : {"\"ours\"", "\"baseline\"", "expected", "\"c0\""}) {
        EXPECT_THAT(sample.all_that_is_open(), Not(HasSubstr(name)));
    }
}

TEST(Jspsych, NamesTheFiguresAsTheStudysOwnPageDoes) {
    ExportedSample sample({.layout = "triplet"});
    sample.change("public/pages.json", [](Json& pages) { pages["texts"] = {{"reference", "Vorlage"}}; });
    sample.write(ExportForm::jspsych);
    EXPECT_EQ(data_of(sample)["sheets"][0][0]["names"], Json({"A", "Vorlage", "B"}));
    ExportedSample single({.layout = "single"});
    single.write(ExportForm::jspsych);
    EXPECT_EQ(data_of(single)["sheets"][0][0]["names"], Json::array());
}

TEST(Jspsych, IsInTheLanguageOfTheStudy) {
    ExportedSample sample({});
    sample.change("public/pages.json", [](Json& pages) { pages["language"] = "ar"; });
    sample.write(ExportForm::jspsych);
    EXPECT_THAT(read_text(sample.open("index.html")), HasSubstr("<html lang=\"ar\">"));
    ExportedSample french({});
    french.change("public/pages.json", [](Json& pages) {
        pages["language"] = "fr";
        pages["texts"] = {{"next", "Suite"}};
    });
    EXPECT_THAT(french.write(ExportForm::jspsych).notes, Not(::testing::Contains(HasSubstr("English"))));
    EXPECT_EQ(data_of(french)["texts"]["next"], "Suite");
    EXPECT_THAT(read_text(french.open("texts.js")), HasSubstr("Suivant"));
}

TEST(Jspsych, ShowsTheCompletionCodeUnlessOnlyTheServerMay) {
    ExportedSample sample({});
    sample.change("public/pages.json", [](Json& pages) { pages["completion"] = {{"code", "ABC"}}; });
    sample.write(ExportForm::jspsych);
    EXPECT_EQ(data_of(sample)["completion_code"], "ABC");
    EXPECT_EQ(data_of(sample)["agreement"], "I agree");
    ExportedSample other({});
    write_json(other.study() / "private/plan.json",
               {{"completion", {{"code", "ABC"}, {"shown_by", "server"}}}});
    EXPECT_THAT(
        other.write(ExportForm::jspsych).notes,
        ::testing::Contains("the completion link and code are left out: \"shown_by\" of the plan leaves them "
                            "to the server"));
    EXPECT_THAT(other.all_that_is_open(), Not(HasSubstr("ABC")));
}

TEST(Jspsych, NamesTheExperimentOfDataPipe) {
    ExportedSample sample({});
    const auto write = [&](ExportForm form, const std::string& pipe) {
        export_study(
            {.study = sample.study(), .out = sample.out(), .form = form, .video_url = "", .pipe = pipe});
    };
    EXPECT_THAT(testing::refusal_of([&] { write(ExportForm::jspsych, "a/b"); }),
                HasSubstr("--pipe: \"a/b\" is no ID of an experiment of DataPipe"));
    EXPECT_THAT(testing::refusal_of([&] { write(ExportForm::hemvip, "AbC123"); }),
                HasSubstr("--pipe: is for jspsych alone"));
    write(ExportForm::jspsych, "AbC123");
    EXPECT_EQ(data_of(sample)["pipe"],
              (Json{{"url", "https://pipe.jspsych.org/api/data/"}, {"experiment", "AbC123"}}));
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

// The first page with questions, without jsPsych: what takes its place shows the form of a trial again and again.
class JspsychForm : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!Browser::is_installed()) GTEST_SKIP() << "needs chromium";
        browser_.emplace(profile_.path());
    }

    // `index` of the question that may be left open; the others are not asked.
    void open(const std::string& layout, std::size_t index, const std::string& query = "?sheet=0&p=ada") {
        sample_.emplace(SampleStudy{.layout = layout, .checks = 0, .sheets = 1});
        const auto make_optional = [&](Json& json) { json["questions"][index]["optional"] = true; };
        sample_->change("private/key.json", make_optional);
        sample_->change("public/pages.json", [&](Json& pages) {
            make_optional(pages);
            for (Json& page : pages["pages"]) page["passes"][0]["questions"] = {index};
        });
        sample_->write(ExportForm::jspsych);
        write_text(sample_->open("jspsych/jspsych.js"), R"(
const jsPsychPreload = {}, jsPsychHtmlButtonResponse = {}, jsPsychVideoButtonResponse = {}, jsPsychSurveyHtmlForm = {};
const initJsPsych = () => ({
    randomization: {randomID: (length) => 'drawn'.padEnd(length, '0'), randomInt: (least) => least},
    getDisplayElement: () => document.body,
    run(timeline) {
        const trial = timeline.find((one) => one.type === jsPsychSurveyHtmlForm);
        document.body.innerHTML = `<form>${trial.html}<input type="submit"></form>`;
        const form = document.querySelector('form');
        form.addEventListener('submit', (event) => {
            event.preventDefault();
            trial.on_finish({response: Object.fromEntries(new FormData(form)), rt: 1000});
        });
        trial.on_load();
    },
}); )");
        browser_->open("file://" + sample_->open("index.html").string() + query);
        browser_->evaluate(
            "document.querySelectorAll('video').forEach((video) => video.dispatchEvent(new Event('ended')))");
    }

    // The values that were sent so far.
    Json sent() {
        return browser_->evaluate(
            "(document.querySelector('[type=submit]').click(), kept.answers.map((answer) => "
            "answer.values.human))");
    }

    void touch(const std::string& selector, int which, const std::string& how) {
        browser_->evaluate(format("document.querySelectorAll('{}')[{}].{}", selector, which, how));
    }

    testing::TemporaryFolder profile_;
    std::optional<Browser> browser_;
    std::optional<ExportedSample> sample_;
};

TEST_F(JspsychForm, LeavesSlidersOpenOrAsksForAll) {
    open("parallel", 0);
    EXPECT_EQ(sent(), Json::array({nullptr}));
    touch("input[type=range]", 1, "dispatchEvent(new Event('input', {bubbles: true}))");
    EXPECT_EQ(sent(), Json::array({nullptr})) << "three are asked for";
    for (const int slider : {0, 2, 3})
        touch("input[type=range]", slider, "dispatchEvent(new Event('pointerdown'))");
    EXPECT_EQ(sent(), Json::array({nullptr, {50, 50, 50, 50}}));
}

TEST_F(JspsychForm, NamesWhatItAsksAndSaysWhyItWaits) {
    open("pair", 1);
    EXPECT_THAT(browser_->evaluate("document.querySelector('h1').textContent").get<std::string>(),
                ::testing::StartsWith("Page 1 of "));
    EXPECT_EQ(browser_->evaluate("document.querySelector('[role=status]').textContent"),
              "You may answer now, and watch again.");
    EXPECT_EQ(browser_->evaluate(R"([...document.querySelectorAll('[role=group]')].map((group) =>
        group.getAttribute('aria-labelledby').split(' ').map((id) => document.getElementById(id).textContent))
        .map(([question, video]) => `${question.length > 0} ${video}`))"),
              Json({"true A", "true B"}));
    EXPECT_EQ(browser_->evaluate(R"((() => {
        const [first, second] = document.querySelectorAll('video');
        let paused = false;
        second.pause = () => { paused = true; };
        first.muted = false;
        first.dispatchEvent(new Event('play'));
        return paused;
    })())"),
              true);
}

// The analysis takes what it sends.
TEST_F(JspsychForm, LeavesRatingsOpenOrAsksForAll) {
    open("pair", 1);
    EXPECT_EQ(sent(), Json::array({nullptr}));
    const fs::path file = profile_ / "answers.json";
    write_json(file, browser_->evaluate("answers()"));
    const StudyKey key = read_study_key(sample_->study() / "private/key.json");
    EXPECT_EQ(analysis::read_answers({file}, key)[0].answers[0].values, (Json{{"human", nullptr}}));
    touch("input[name=\"human.0\"]", 2, "click()");
    EXPECT_EQ(sent(), Json::array({nullptr})) << "the other one is asked for";
    touch("input[name=\"human.1\"]", 4, "click()");
    EXPECT_EQ(sent(), Json::array({nullptr, {3, 5}}));
}

// A link that was pasted without the panel filling it in: all who come by it would be one.
TEST_F(JspsychForm, TakesAMarkThatWasNotFilledInForNoName) {
    for (const char* query : {"?sheet=0&p=wave1&PROLIFIC_PID={{%PROLIFIC_PID%}}",
                              "?sheet=0&PROLIFIC_PID=${e://Field/PROLIFIC_PID}"}) {
        open("pair", 1, query);
        EXPECT_EQ(browser_->evaluate("kept.participant"), "drawn0000000") << query;
    }
}

// The folder that CHIRONOMIA_JSPSYCH names holds jspsych.js and the others, as the note of the export lists
// them.
class JspsychPage : public ::testing::TestWithParam<SampleStudy> {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("CHIRONOMIA_JSPSYCH");
        if (!Browser::is_installed() || !folder)
            GTEST_SKIP() << "needs chromium, and jsPsych in $CHIRONOMIA_JSPSYCH";
        sample_.change("public/pages.json", [](Json& pages) { pages["completion"] = {{"code", "A<B"}}; });
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
    browser.open("file://" + sample_.open("index.html").string() + "?sheet=3&p=somebody");
    ASSERT_TRUE(browser.wait_for(kGoOn));
    EXPECT_EQ(browser.evaluate("document.getElementById('code').textContent"), "A<B");
    const Json answers = browser.evaluate("answers()");
    EXPECT_EQ(answers["participant"], "somebody");
    EXPECT_EQ(answers["sheet"], 1);
    const server::ServedStudy study = server::read_served_study(sample_.study());
    ASSERT_EQ(answers["answers"].size(), study.sheets[1].size());
    for (std::size_t i = 0; i < study.sheets[1].size(); ++i) {
        const server::EntryFault fault =
            server::fault_of_entry(study.pages, study.sheets[1][i], answers["answers"][i]);
        EXPECT_EQ(fault.order + fault.fit, "") << answers["answers"][i];
    }
    EXPECT_EQ(server::fault_of_questionnaire(study.pages, answers["questionnaire"]), "");
}

TEST_P(JspsychPage, FitsAPhone) {
    testing::TemporaryFolder profile;
    Browser browser(profile.path());
    browser.resize(390, 844);
    browser.open("file://" + sample_.open("index.html").string() + "?sheet=0");
    ASSERT_TRUE(browser.wait_for(
        "document.querySelector('video') !== null || (document.querySelector('button')?.click(), false)"));
    EXPECT_LE(browser.evaluate("document.documentElement.scrollWidth").get<int>(), 390);
}

INSTANTIATE_TEST_SUITE_P(Layouts, JspsychPage,
                         ::testing::Values(SampleStudy{.layout = "pair", .sheets = 2},
                                           SampleStudy{.layout = "single", .sheets = 2},
                                           SampleStudy{.layout = "parallel", .sheets = 2}),
                         [](const auto& info) { return info.param.layout; });

// ---- Answers are kept as soon as they are given

// The page on a host that stands for DataPipe too.
class JspsychKeeping : public JspsychPage {
  protected:
    void SetUp() override {
        JspsychPage::SetUp();
        if (IsSkipped()) return;
        std::string study = read_text(sample_.open("study.js"));
        const std::string address = R"("pipe": null)";
        study.replace(study.find(address), address.size(),
                      R"("pipe": {"url": "/api/data/", "experiment": "AbC123"})");
        write_text(sample_.open("study.js"), study);
        server_.emplace(sample_.open(""), [this](const std::string&, const Json& body) {
            const std::lock_guard lock(mutex_);
            if (refuse)
                return testing::TinyServer::Reply{.status = 400,
                                                  .body = R"({"error": "EXPERIMENT_NOT_FOUND"})"};
            EXPECT_EQ(body["experimentID"], "AbC123");
            const bool is_new =
                files_.emplace(body["filename"], Json::parse(body["data"].get<std::string>())).second;
            if (!is_new)
                return testing::TinyServer::Reply{.status = 400, .body = R"({"error": "OSF_FILE_EXISTS"})"};
            return testing::TinyServer::Reply{.status = 201, .body = R"({"message": "Success"})"};
        });
        browser_.emplace(profile_.path());
    }

    std::map<std::string, Json> files() {
        const std::lock_guard lock(mutex_);
        return files_;
    }

    // Goes on until so many answers are kept.
    void answer(std::size_t count) {
        ASSERT_TRUE(browser_->wait_for(format("({}, kept.answers.length >= {})", kGoOn, count)));
    }

    std::atomic<bool> refuse = false;
    testing::TemporaryFolder profile_;
    std::mutex mutex_;
    std::map<std::string, Json> files_;
    std::optional<testing::TinyServer> server_;
    std::optional<Browser> browser_;
};

TEST_P(JspsychKeeping, SendsEachAnswerAndGoesOnAfterAReload) {
    browser_->open(server_->url("?sheet=0&p=ada"));
    answer(2);
    ASSERT_TRUE(browser_->wait_for("delivering === null"));
    const Json before = browser_->evaluate("kept.answers");
    server_->lose_answers(1);  // arrives, but is not acknowledged
    browser_->open("about:blank");
    browser_->open(server_->url("?sheet=0&p=ada"));
    EXPECT_EQ(browser_->evaluate("kept.answers"), before) << "kept over a reload";
    ASSERT_TRUE(browser_->wait_for(kGoOn));
    const Json all = browser_->evaluate("answers()");
    EXPECT_EQ(browser_->evaluate("document.getElementById('not-stored')"), nullptr);
    const std::map<std::string, Json> kept = files();
    ASSERT_GE(kept.size(), 3u);
    EXPECT_THAT(kept.begin()->first, ::testing::MatchesRegex("ada-[A-Za-z0-9]+-000[12].json"));
    EXPECT_EQ(kept.rbegin()->second, all);
    EXPECT_TRUE(all["finished"].is_string());
    const server::ServedStudy study = server::read_served_study(sample_.study());
    ASSERT_EQ(all["answers"].size(), study.sheets[0].size());
    // The analysis takes the last of them.
    std::vector<fs::path> paths;
    for (const auto& [name, json] : kept) {
        paths.push_back(profile_ / name);
        write_json(paths.back(), json);
    }
    const std::vector<analysis::Respondent> read = analysis::read_answers(paths, study.key);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].answers.size(), study.sheets[0].size());
}

TEST_P(JspsychKeeping, SaysThatNothingWasStored) {
    refuse = true;
    browser_->open(server_->url("?sheet=0&p=eve"));
    ASSERT_TRUE(browser_->wait_for(kGoOn));
    EXPECT_THAT(browser_->evaluate("document.getElementById('not-stored').textContent").get<std::string>(),
                HasSubstr("could not be stored"));
    EXPECT_THAT(browser_->evaluate("document.body.textContent").get<std::string>(),
                HasSubstr("EXPERIMENT_NOT_FOUND"));
    EXPECT_EQ(files().size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Layouts, JspsychKeeping,
                         ::testing::Values(SampleStudy{.layout = "pair", .sheets = 2}),
                         [](const auto& info) { return info.param.layout; });

// A pair whose question asks for reasons unless the two are equal.
class JspsychReasons : public JspsychPage {};

TEST_P(JspsychReasons, AreAskedForOnceTheAnswerNeedsThem) {
    testing::TemporaryFolder profile;
    Browser browser(profile.path());
    browser.open("file://" + sample_.open("index.html").string() + "?sheet=0&p=somebody");
    ASSERT_TRUE(browser.wait_for(R"((() => {
        if (document.getElementById('questions')) return true;
        const button = [...document.querySelectorAll('button')].find((one) => !one.disabled);
        if (button) button.click();
        return false;
    })())"));
    EXPECT_EQ(browser.evaluate("document.getElementById('questions').disabled"), true) << "not watched yet";
    EXPECT_EQ(browser.evaluate("[...document.querySelectorAll('figure b')].map((name) => name.textContent)"),
              Json({"A", "B"}));
    browser.evaluate("document.querySelector('video').playbackRate = 16");
    EXPECT_TRUE(browser.wait_for("document.querySelector('video').playbackRate === 1"));
    // Chooses an answer, gives the first reason if it may, and says whether the page can be sent.
    const auto sent = [&](int answer, bool with_reason) {
        return browser.evaluate(format(
            R"((() => {{
                for (const video of document.querySelectorAll('video')) video.dispatchEvent(new Event('ended'));
                document.querySelector('input[type=radio][value="{}"]').click();
                const box = document.querySelector('input[type=checkbox]');
                if (box.checked !== {}) box.click();
                return {{sent: box.validity.valid, asked: !box.closest('fieldset').disabled}};
            }})())",
            answer, with_reason));
    };
    EXPECT_EQ(sent(1, false), (Json{{"sent", false}, {"asked", true}}));
    EXPECT_EQ(sent(1, true), (Json{{"sent", true}, {"asked", true}}));
    EXPECT_EQ(sent(3, false), (Json{{"sent", true}, {"asked", false}}));
    browser.evaluate(
        "document.querySelectorAll('input[name^=human][value=\"4\"]').forEach((radio) => radio.click()); "
        "document.querySelector('input[type=submit]').click()");
    ASSERT_TRUE(browser.wait_for("kept.answers.length === 1"));
    EXPECT_EQ(browser.evaluate("kept.answers[0].reasons"), Json::object());
}

INSTANTIATE_TEST_SUITE_P(Layouts, JspsychReasons,
                         ::testing::Values(SampleStudy{.layout = "pair", .sheets = 2}),
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
        for (const video of document.querySelectorAll('video')) video.dispatchEvent(new Event('ended'));
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
}  // namespace chironomia::study
