// The page in a real browser: a participant is led through it, watches, answers, reloads and saves.
#include <map>
#include <set>

#include "study/build/build.h"
#include "tests/study/page_fixture.h"
#include "tests/study/sample_plan.h"

namespace chironomia::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::preference;
using testing::rating;
using testing::ShownPage;

class StudyPage : public testing::PageFixture {};

// What waits inside of a page ends with it.
TEST_F(StudyPage, IsWaitedForWhileItLoadsAnew) {
    write_text(folder_ / "twice.html",
               "<script>if (sessionStorage.length) document.title = 'again'; "
               "else setTimeout(() => { sessionStorage.been = 1; location.reload(); }, 300);</script>");
    browser_->open("file://" + (folder_ / "twice.html").string());
    EXPECT_TRUE(browser_->wait_for("document.title === 'again'"));
}

TEST_F(StudyPage, LetsAParticipantWatchAnswerAndSave) {
    open("?p=1");
    EXPECT_EQ(text_of("title"), "Two ways to move");
    EXPECT_THAT(text_of("requirements"), HasSubstr("There are 2 pages. This takes about one minute."));
    EXPECT_THAT(text_of("requirements"), HasSubstr("If you must stop"));
    evaluate("participation.kept = false, void introduce()");
    EXPECT_THAT(text_of("requirements"), Not(HasSubstr("If you must stop"))) << "nothing is kept";
    evaluate("participation.kept = true");
    reload("?p=1");
    start();
    EXPECT_EQ(text_of("progress-text"), "Page 1 of 2");

    // Nobody answers before both videos were watched to their end.
    EXPECT_EQ(text_of("status"), "Watch both videos to their end to answer.");
    EXPECT_EQ(evaluate("document.getElementById('questions').disabled"), true);
    browser_->press("1");
    EXPECT_EQ(evaluate("document.querySelectorAll('#questions input:checked').length"), 0);
    wait_for("document.querySelector('video').readyState >= 2");
    evaluate("document.querySelector('video').currentTime = 0.45");
    wait_for("document.querySelector('video').currentTime < 0.1");
    evaluate("document.querySelector('video').playbackRate = 16");
    wait_for("document.querySelector('video').playbackRate === 1");

    click("#all");
    wait_for("trial.watched");
    EXPECT_EQ(evaluate("document.getElementById('questions').disabled"), false);
    EXPECT_FALSE(may_go_on());
    browser_->press("4");
    EXPECT_TRUE(may_go_on());
    browser_->press("Enter");
    wait_for("document.getElementById('progress-text').textContent === 'Page 2 of 2'");

    // A reload goes on where it was.
    reload("?p=1");
    EXPECT_EQ(text_of("intro-title"), "Welcome back");
    EXPECT_EQ(text_of("resume-note"), "You have answered one of 2 pages.");
    start();
    EXPECT_EQ(text_of("progress-text"), "Page 2 of 2");
    for (const char* video : {"0", "1"}) {
        browser_->press(" ");
        wait_for(format("trial.stage.screens[{}].watched", video));
    }
    click("#questions label:nth-child(2) input");
    click("#next");
    wait_for_section("finish");

    const Json saved =
        Json::parse(evaluate("document.getElementById('answer-text').value").get<std::string>());
    EXPECT_EQ(evaluate("fetch(document.getElementById('download').href).then((file) => file.json())"), saved);
    EXPECT_EQ(saved["format"], "chironomia answers 2");
    EXPECT_EQ(saved["study"], "3f0c9a5b1e2d4c68");
    EXPECT_EQ(saved["participant"], "1");
    EXPECT_EQ(saved["sheet"], 1);
    EXPECT_EQ(saved["simulated"], false);
    ASSERT_EQ(saved["answers"].size(), 2u);
    EXPECT_EQ(saved["answers"][0]["values"], Json({{"realism", 4}}));
    EXPECT_EQ(saved["answers"][1]["values"], Json({{"realism", 2}}));
    EXPECT_EQ(saved["answers"][1]["reasons"], Json::object());
    EXPECT_EQ(saved["answers"][1]["skipped"], false);
    EXPECT_LE(saved["started"].get<std::string>(), saved["finished"].get<std::string>());
}

// The answers name the videos from left to right as they stood, so that the key gives the condition of each.
TEST_F(StudyPage, NotesWhichVideoStoodWhereAndWhatHappened) {
    open("?sheet=1");
    start();
    wait_for("[...document.querySelectorAll('video')].every((video) => video.readyState >= 2)");
    const Json sources = evaluate("[...document.querySelectorAll('video')].map((video) => video.src)");
    EXPECT_THAT(sources[0].get<std::string>(), HasSubstr(token(1)));
    EXPECT_THAT(sources[1].get<std::string>(), HasSubstr(token(0)));
    click("#all");
    wait_for("trial.watched");
    browser_->press("1");
    browser_->press("Enter");
    wait_for("state.sent.answers.length === 1");
    const Json answer = evaluate("state.sent.answers[0]");
    EXPECT_EQ(answer["page"], "00000000000000p1");
    EXPECT_EQ(answer["videos"], Json({token(1), token(0)}));
    EXPECT_EQ(answer["values"], Json({{"realism", 1}}));
    std::vector<std::string> events;
    for (const Json& event : answer["events"]) {
        EXPECT_LE(event[0].get<double>(), answer["seconds"].get<double>());
        if (event[1].get<std::string>().find("pause") == std::string::npos) events.push_back(event[1]);
    }
    EXPECT_THAT(events, ElementsAre("play 0", "ended 0", "play 1", "ended 1", "answer 0"));
}

TEST_F(StudyPage, ShowsOneVideoWithBothFigures) {
    study_ = study_of("pair", 1, Json::array({preference()}));
    open();
    start();
    EXPECT_EQ(evaluate("document.querySelectorAll('video').length"), 1);
    EXPECT_EQ(evaluate("document.getElementById('all').hidden"), true);
    EXPECT_EQ(evaluate("document.querySelector('.halves').textContent"), "AB");
    browser_->press(" ");
    wait_for("trial.watched");
    browser_->press("3");
    browser_->press("Enter");
    wait_for("state.sent.answers.length === 1");
    EXPECT_EQ(evaluate("state.sent.answers[0].videos"), Json({token(0)}));
}

TEST_F(StudyPage, ShowsOneVideoAfterTheOther) {
    study_["one_by_one"] = true;
    open();
    start();
    const std::string shown =
        "[...document.querySelectorAll('figure')].map((figure) => !figure.hidden).join()";
    EXPECT_EQ(evaluate(shown), "true,false");
    EXPECT_EQ(evaluate("document.querySelectorAll('.tab')[1].disabled"), true);
    browser_->press("b");  // not before A has ended
    EXPECT_EQ(evaluate(shown), "true,false");
    click(".play");
    wait_for("trial.stage.screens[0].watched");
    EXPECT_EQ(text_of("status"), "Watch video B to its end too.");
    browser_->press("b");
    EXPECT_EQ(evaluate(shown), "false,true");
    wait_for("trial.watched");
    browser_->press("a");
    EXPECT_EQ(evaluate(shown), "true,false");
}

TEST_F(StudyPage, ShowsATripletWithTheReferenceInTheMiddle) {
    study_ = study_of("triplet", 3, {preference("overall"), preference("amplitude"), preference("speed")});
    for (Json& page : study_["pages"]) page["passes"][0]["sound"] = false;
    open();
    start();
    EXPECT_EQ(evaluate("[...document.querySelectorAll('figcaption')].map((name) => name.textContent)"),
              Json({"A", "Reference", "B"}));
    EXPECT_EQ(text_of("all"), "Play together");
    click("#all");
    wait_for("[...document.querySelectorAll('video')].every((video) => video.muted)");
    wait_for("trial.watched");
    // Digits go down the lines; a line that has the focus is answered anew.
    for (const char* key : {"5", "1", "3"}) browser_->press(key);
    EXPECT_EQ(values(), Json({{"overall", 5}, {"amplitude", 1}, {"speed", 3}}));
    evaluate("document.querySelectorAll('.line')[1].querySelector('input:checked').focus()");
    browser_->press("2");
    EXPECT_EQ(values(), Json({{"overall", 5}, {"amplitude", 2}, {"speed", 3}}));
    EXPECT_TRUE(may_go_on());
}

TEST_F(StudyPage, ShowsOneOfParallelVideosAtATimeAndMarksItsSlider) {
    Json slider = {{"id", "quality"},     {"kind", "slider"},
                   {"text", "How good?"}, {"least", 0},
                   {"most", 100},         {"labels", {"excellent", "good", "fair", "poor", "bad"}},
                   {"each", true}};
    study_ = study_of("parallel", 8, Json::array({slider}));
    open("?sheet=1");
    start();
    EXPECT_EQ(evaluate("document.querySelectorAll('figure:not([hidden])').length"), 1);
    click("#all");
    wait_for("trial.watched");
    const std::string marked =
        "[...document.querySelectorAll('.line')].findIndex((line) => line.matches('.shown'))";
    EXPECT_EQ(evaluate(marked), 1 + 7);  // after the line of the labels
    browser_->press("c");
    EXPECT_EQ(evaluate(marked), 1 + 2);
    EXPECT_EQ(evaluate("document.querySelector('figure:not([hidden]) video').src").get<std::string>(),
              evaluate("new URL(trial.step.paths[2], location).href"));
    EXPECT_EQ(evaluate("[...document.querySelectorAll('.ticks span')].map((one) => one.textContent)"),
              Json({"bad", "poor", "fair", "good", "excellent"}));

    // Sliders that were not touched are not answers.
    for (int i = 0; i < 8; ++i) {
        EXPECT_FALSE(may_go_on());
        EXPECT_EQ(values()["quality"], Json());
        evaluate(format("document.querySelectorAll('input[type=range]')[{}].focus()", i));
        browser_->press(i % 2 == 0 ? "ArrowRight" : " ");
    }
    EXPECT_TRUE(may_go_on());
    EXPECT_EQ(values(), Json({{"quality", {51, 50, 51, 50, 51, 50, 51, 50}}}));
}

TEST_F(StudyPage, AsksForEachPassAndWantsEverythingWatchedAgain) {
    study_ = study_of("single", 1, {rating("believable"), rating("synchronised")});
    for (Json& page : study_["pages"]) {
        page["passes"] = {{{"sound", false}, {"questions", {0}}}, {{"sound", true}, {"questions", {1}}}};
    }
    open();
    start();
    for (const bool sound : {false, true}) {
        EXPECT_EQ(text_of("pass"), sound ? "With sound" : "Without sound");
        EXPECT_EQ(text_of("progress-text"), "Page 1 of 2");
        EXPECT_EQ(evaluate("document.querySelector('video').muted"), !sound);
        EXPECT_EQ(text_of("status"), "Watch the video to its end to answer.");
        browser_->press(" ");
        wait_for("trial.watched");
        browser_->press(sound ? "7" : "2");
        browser_->press("Enter");
        wait_for(format("state.sent.answers.length === {}", sound ? 2 : 1));
    }
    wait_for("document.getElementById('progress-text').textContent === 'Page 2 of 2'");
    const Json answers = evaluate("state.sent.answers");
    EXPECT_EQ(answers[0]["pass"], 0);
    EXPECT_EQ(answers[0]["values"], Json({{"believable", 2}}));
    EXPECT_EQ(answers[1]["pass"], 1);
    EXPECT_EQ(answers[1]["values"], Json({{"synchronised", 7}}));
    EXPECT_EQ(answers[1]["page"], answers[0]["page"]);
}

TEST_F(StudyPage, SkipsAPageThatMayBeSkipped) {
    study_["skip_after"] = 1;
    open();
    start();
    EXPECT_EQ(evaluate("document.getElementById('skip').disabled"), true);
    wait_for("!document.getElementById('skip').disabled");
    click("#skip");
    wait_for("state.sent.answers.length === 1");
    const Json answer = evaluate("state.sent.answers[0]");
    EXPECT_EQ(answer["skipped"], true);
    EXPECT_EQ(answer["values"], Json::object());
    EXPECT_GE(answer["seconds"].get<double>(), 1.0);
    EXPECT_EQ(evaluate("document.getElementById('skip').disabled"), true);
}

TEST_F(StudyPage, ShowsWhatIsSaid) {
    study_["pages"][0]["caption"] = "Good evening.";
    open();
    start();
    EXPECT_EQ(text_of("caption"), "Good evening.");
    EXPECT_EQ(evaluate("document.getElementById('caption').hidden"), false);
}

// A participant who likes one video of each page more, wherever it stands, in a study that the program built.
TEST_F(StudyPage, LeadsThroughAStudyThatWasBuilt) {
    testing::write_sample_inputs(folder_.path());
    Json plan = testing::sample_plan();
    plan["render"]["size"] = {64, 48};
    write_json(folder_ / "plan.json", plan);
    testing::FakeMaker fake;
    fake.lengths = {{"ours/c1.bvh", 0.6}, {"base/c1.bvh", 0.6}, {"ours/c2.bvh", 0.5}, {"base/c2.bvh", 0.5}};
    build_study(read_plan(folder_ / "plan.json"), {.out = folder_ / "study", .seed = 5, .quiet = true},
                testing::tiny_maker(fake));
    const std::string url = "file://" + (folder_ / "study/public/index.html").string();
    std::map<std::string, std::set<std::string>> liked;  // by page
    for (const char* query : {"?p=0", "?p=1", "?p=2", "?p=3"}) {
        const Json saved = testing::walk_study(
            *browser_, url + query,
            {.answer = [](const ShownPage& page,
                          const Json&) { return page.videos[0] < page.videos[1] ? 1 : 5; },
             .play = query == std::string("?p=0")});
        ASSERT_EQ(saved["answers"].size(), 2u);
        for (const Json& answer : saved["answers"]) {
            ASSERT_EQ(answer["values"].size(), 1u);
            const bool left = *answer["values"].begin() == 1;
            liked[answer["page"]].insert(answer["videos"][left ? 0 : 1].get<std::string>());
        }
    }
    EXPECT_EQ(liked.size(), 2u);
    for (const auto& [page, videos] : liked) EXPECT_EQ(videos.size(), 1u) << page;
}

// ---- Before and after the pages

TEST_F(StudyPage, KeepsNothingOfThoseWhoDoNotAgree) {
    study_["consent"] = {{"text", "You may stop at any time."}};
    study_["texts"] = {{"agree", "I take part"}};
    study_["completion"] = {{"url", nullptr}, {"code", nullptr}, {"declined_url", "https://example.org/no"}};
    open("?PROLIFIC_PID=abc");
    EXPECT_EQ(text_of("consent-text"), "You may stop at any time.");
    EXPECT_EQ(text_of("agree"), "I take part");
    click("#decline");
    wait_for_section("message");
    EXPECT_EQ(text_of("message-title"), "You are not taking part");
    EXPECT_EQ(evaluate("document.querySelector('#message-actions a').href"), "https://example.org/no");
    EXPECT_EQ(evaluate("localStorage.length"), 0);
    reload("?PROLIFIC_PID=abc");
    EXPECT_EQ(evaluate("document.getElementById('consent').hidden"), false);
}

TEST_F(StudyPage, PractisesFirstAndKeepsNothingOfIt) {
    study_["training"] = {{"text", "Two pages to practise."}, {"pages", {0, 1}}};
    study_["sheets"] = {{{"pages", {{1, {1, 0}}}}}};
    open();
    click("#start");
    wait_for_section("message");
    EXPECT_EQ(text_of("message-text"), "Two pages to practise.");
    click("#message-actions button");
    wait_for_section("trial");
    EXPECT_EQ(text_of("progress-text"), "Practice page 1 of 2");
    end_videos();
    browser_->press("2");
    browser_->press("Enter");
    wait_for("document.getElementById('progress-text').textContent === 'Practice page 2 of 2'");
    reload();
    start();
    EXPECT_EQ(text_of("progress-text"), "Practice page 2 of 2");
    const Json saved = walk();
    ASSERT_EQ(saved["answers"].size(), 1u);
    EXPECT_EQ(saved["answers"][0]["page"], "00000000000000p1");
    EXPECT_EQ(saved["answers"][0]["videos"], Json({token(1), token(0)}));
}

TEST_F(StudyPage, GoesOnOnlyWhenTheTonesWereCounted) {
    study_["sound_check"] = {{"files", {format("clips/{}.mp4", token(0)), format("clips/{}.mp4", token(1))}},
                             {"choices", {"one", "two"}}};
    open();
    click("#start");
    wait_for_section("sound");
    const auto cannot_check = [this] {
        return evaluate("document.getElementById('sound-check').disabled") == true;
    };
    EXPECT_TRUE(cannot_check());
    click("#sound-choices label:nth-child(1) input");
    EXPECT_TRUE(cannot_check()) << "nothing was played";
    click("#tones");
    wait_for("document.getElementById('tones').textContent === 'Play the tones again'");
    const Json played = evaluate("study.sound_check.files.findIndex((path) => tones.src.endsWith(path))");
    click(format("#sound-choices label:nth-child({}) input", played == 0 ? 2 : 1));
    click("#sound-check");
    EXPECT_THAT(text_of("sound-problem"), HasSubstr("That is not how many there were."));
    EXPECT_EQ(evaluate("document.activeElement.id"), "tones");
    EXPECT_EQ(evaluate("document.querySelectorAll('#sound-choices input:checked').length"), 0);
    click(format("#sound-choices label:nth-child({}) input", played.get<int>() + 1));
    EXPECT_TRUE(cannot_check()) << "the other file was not played yet";
    click("#tones");
    wait_for("!document.getElementById('sound-check').disabled");
    const Json now = evaluate("study.sound_check.files.findIndex((path) => tones.src.endsWith(path))");
    EXPECT_NE(now, played);
    click(format("#sound-choices label:nth-child({}) input", now.get<int>() + 1));
    click("#sound-check");
    wait_for_section("trial");
}

TEST_F(StudyPage, AsksTheQuestionnaireAndSendsParticipantsOn) {
    study_["questionnaire"] = {{{"id", "age"},
                                {"kind", "number"},
                                {"text", "Age"},
                                {"least", 18},
                                {"most", 120},
                                {"optional", true}},
                               {{"id", "job"},
                                {"kind", "choice"},
                                {"text", "Job"},
                                {"options", {{{"id", "s"}, {"text", "Student"}}}}}};
    study_["completion"] = {{"url", "https://app.prolific.com/submissions/complete?cc=ABC"},
                            {"code", "ABC"},
                            {"declined_url", nullptr}};
    open("?PROLIFIC_PID=p1&STUDY_ID=s1&SESSION_ID=e1&other=x");
    const Json saved = walk(
        {.about_me = [](const Json& question) { return question["id"] == "age" ? Json(31) : Json("s"); }},
        "?PROLIFIC_PID=p1&STUDY_ID=s1&SESSION_ID=e1&other=x");
    EXPECT_EQ(saved["participant"], "p1");
    EXPECT_EQ(saved["arrived_with"],
              Json({{"PROLIFIC_PID", "p1"}, {"STUDY_ID", "s1"}, {"SESSION_ID", "e1"}}));
    EXPECT_EQ(saved["questionnaire"], Json({{"age", 31}, {"job", "s"}}));
    EXPECT_EQ(text_of("code"), "ABC");
    EXPECT_EQ(evaluate("document.getElementById('complete').href"),
              "https://app.prolific.com/submissions/complete?cc=ABC");
    // Answers that are not saved yet must not be left behind.
    EXPECT_EQ(text_of("redirect"), "");
}

// A link that was pasted without the panel filling it in: all who come by it would be one.
TEST_F(StudyPage, TakesAMarkThatWasNotFilledInForNoName) {
    for (const char* query :
         {"?p=wave1&PROLIFIC_PID={{%PROLIFIC_PID%}}", "?PROLIFIC_PID=%7B%7B%25PROLIFIC_PID%25%7D%7D",
          "?PROLIFIC_PID=${e://Field/PROLIFIC_PID}", "?p=${e://Field/ResponseID}"}) {
        open(query);
        EXPECT_THAT(evaluate("state.sent.participant").get<std::string>(),
                    ::testing::MatchesRegex("[0-9a-f]{12}"))
            << query;
    }
}

TEST_F(StudyPage, IsLaidOutFromRightToLeftHoweverTheLanguageIsSpelled) {
    study_["language"] = "AR-eg";
    open();
    EXPECT_EQ(evaluate("document.documentElement.dir"), "rtl");
    start();
    EXPECT_EQ(evaluate("document.querySelector('#questions legend').dir"), "auto");
    EXPECT_THAT(read_text(folder_ / "public/index.html"), HasSubstr("<html lang=\"AR-eg\">"));
}

TEST_F(StudyPage, SpreadsNamesOverTheSheets) {
    study_["sheets"] = {study_["sheets"][0], study_["sheets"][1], study_["sheets"][0], study_["sheets"][1]};
    open("?p=ann");
    const Json counts = evaluate(
        "(() => { const counts = study.sheets.map(() => 0); const none = new URLSearchParams(''); "
        "for (let i = 0; i < 400; ++i) ++counts[findSheet(none, 'person ' + i)]; return counts; })()");
    ASSERT_EQ(counts.size(), 4u);
    for (const Json& count : counts) EXPECT_NEAR(count.get<int>(), 100, 40);
    EXPECT_EQ(evaluate("findSheet(new URLSearchParams('?sheet=6'), 'ann')"), 2);
    EXPECT_EQ(evaluate("findSheet(new URLSearchParams('?order=3'), 'ann')"), 3);
    EXPECT_EQ(evaluate("findSheet(new URLSearchParams(''), '5')"), 1);
}

// ---- Room, keys and words

TEST_F(StudyPage, FitsIntoCommonWindowsWithoutScrolling) {
    const Json sliders = {{{"id", "quality"},
                           {"kind", "slider"},
                           {"text", "How good?"},
                           {"least", 0},
                           {"most", 100},
                           {"labels", {"excellent", "good", "fair", "poor", "bad"}},
                           {"each", true}}};
    const Json six = {preference("a"), preference("b"), preference("c"),
                      preference("d"), preference("e"), preference("f")};
    const Json five = {rating("natural"), rating("coherent"), rating("human-like"), rating("synchronised"),
                       rating("aligned")};
    const Json reasons = Json::array({testing::preference_with_reasons()});
    Json many = {{{"id", "what"}, {"kind", "choice"}, {"text", "What differs?"}, {"options", Json::array()}}};
    for (const char* id : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"}) {
        many[0]["options"].push_back({{"id", id}, {"text", "more repetition of strokes"}});
    }
    for (const Json& study :
         {study_of("single", 1, five), study_of("pair", 2, many), study_of("pair", 2, reasons),
          study_of("pair", 1, reasons), study_of("triplet", 3, six), study_of("parallel", 8, sliders)}) {
        study_ = study;
        study_["width"] = 1280;
        study_["height"] = 720;
        open();
        start();
        for (const auto& [width, height, least] : {std::tuple{1280, 800, 220}, {1920, 1080, 330}}) {
            browser_->resize(width, height);
            wait_for(
                format("innerWidth === {} && document.documentElement.scrollHeight <= innerHeight && "
                       "document.querySelector('.screen').offsetHeight >= {}",
                       width, least));
            EXPECT_EQ(evaluate("document.documentElement.scrollWidth <= innerWidth"), true)
                << study["layout"];
            EXPECT_EQ(evaluate("[...document.querySelectorAll('#questions label, button')].filter((one) => "
                               "one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent)"),
                      Json::array());
        }
        EXPECT_NEAR(
            evaluate("(() => { const box = document.querySelector('.screen').getBoundingClientRect(); "
                     "return box.width / box.height; })()")
                .get<double>(),
            16.0 / 9, 0.02);
    }
}

TEST_F(StudyPage, SaysWhenTheWindowIsTooNarrow) {
    open();
    start();
    browser_->resize(600, 800);
    wait_for("document.getElementById('narrow').open");
    browser_->resize(1280, 800);
    wait_for("!document.getElementById('narrow').open");
    browser_->resize(600, 800);
    wait_for("document.getElementById('narrow').open");
    browser_->press("Escape");
    wait_for("!document.getElementById('narrow').open");
    EXPECT_EQ(evaluate("document.activeElement.id"), "trial-title");
    EXPECT_EQ(evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
}

// What a participant on a phone must reach, and what must not stand over something else.
constexpr const char* kMisplaced = R"((() => {
    const found = [];
    if (document.documentElement.scrollWidth > innerWidth) found.push('the page is wider than the window');
    for (const input of document.querySelectorAll('#questions input, #questions button')) {
        const {left, right} = input.getBoundingClientRect();
        if (left < 0 || right > innerWidth) found.push(`${input.ariaLabel} is cut off`);
    }
    for (const box of document.querySelectorAll('#questions label, button')) {
        if (box.scrollWidth > box.clientWidth + 1) found.push(`${box.textContent} overruns`);
    }
    const words = [...document.querySelectorAll('.ticks span, .ends span')].map((span) => {
        const range = document.createRange();
        range.selectNodeContents(span);
        return [span.textContent, range.getBoundingClientRect()];
    }).filter(([, {width}]) => width > 0);
    words.forEach(([text, a], i) => words.slice(i + 1).forEach(([other, b]) => {
        const meet = a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
        if (meet) found.push(`${text} over ${other}`);
    }));
    return found;
})())";

TEST_F(StudyPage, CutsNothingOffOnPhonesAndOverprintsNoLabel) {
    Json sliders = {{{"id", "quality"},
                     {"kind", "slider"},
                     {"text", "Wie gut?"},
                     {"least", 0},
                     {"most", 100},
                     {"labels", {"ausgezeichnet", "gut", "befriedigend", "médiocre", "mauvais"}},
                     {"each", true}}};
    for (const Json& labels : {Json({"überhaupt nicht natürlich", "ungenügend", "hervorragend"}),
                               Json({"ausgezeichnet", "mangelhaft"})}) {
        sliders.push_back(sliders[0]);
        sliders.back()["id"] = format("quality{}", labels.size());
        sliders.back()["labels"] = labels;
    }
    Json labelled = rating("labelled", 5);
    labelled["labels"] = {{"1", "ungenügend"},
                          {"2", "mangelhaft"},
                          {"3", "befriedigend"},
                          {"4", "gut"},
                          {"5", "ausgezeichnet"}};
    const Json reasons = Json::array({testing::preference_with_reasons()});
    for (const Json& study :
         {study_of("single", 1, {rating("natural"), rating("coherent"), rating("all", 11)}),
          study_of("single", 1, Json::array({labelled})), study_of("parallel", 3, sliders),
          study_of("triplet", 3, {preference("a"), preference("b")}), study_of("pair", 2, reasons)}) {
        study_ = study;
        study_["width"] = 1280;
        study_["height"] = 720;
        study_["language"] = "ar";
        browser_->resize(1280, 800);
        open();
        wait_for_section("intro");
        start();
        end_videos();
        evaluate("narrowAllowed = true");
        for (const int width : {1920, 1280, 700, 390, 360, 320}) {
            browser_->resize(width, 800);
            // No bars above and below the picture but for the width of a scrollbar, once the page has taken the width in.
            wait_for(
                format("innerWidth === {} && [...document.querySelectorAll('.screen')].every((box) => "
                       "box.offsetHeight <= box.offsetWidth * 9 / 16 * 1.05)",
                       width));
            EXPECT_EQ(evaluate(kMisplaced), Json::array()) << study["layout"] << width;
        }
    }
}

TEST_F(StudyPage, BreaksWordsThatAreLongerThanAPhoneIsWide) {
    const std::string address = "https://www.example.org/" + std::string(80, 'a');
    study_["consent"] = {{"text", address}};
    study_["instructions"] = address;
    browser_->resize(320, 640);
    open();
    evaluate("narrowAllowed = true; byId('narrow').close()");
    wait_for_section("consent");
    EXPECT_EQ(evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
    click("#agree");
    wait_for_section("intro");
    EXPECT_EQ(evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
}

// Goes through every section with the keyboard only.
TEST_F(StudyPage, NeedsNoPointer) {
    study_["consent"] = {{"text", "You may stop at any time."}};
    study_["training"] = {{"text", "One page to practise."}, {"pages", {0}}};
    study_["questions"] = Json::array({testing::preference_with_reasons()});
    study_["questionnaire"] = {
        {{"id", "age"}, {"kind", "number"}, {"text", "Age"}, {"least", 18}, {"most", 99}}};
    const auto tab_to = [&](const std::string& selector) {
        for (int i = 0; i < 30; ++i) {
            if (evaluate(format("document.activeElement.matches('{}')", selector)) == true) return;
            browser_->press("Tab");
        }
        FAIL() << selector << " is not reached by Tab";
    };
    open();
    tab_to("#agree");
    browser_->press("Enter");
    wait_for_section("intro");
    tab_to("#start");
    browser_->press("Enter");
    wait_for_section("message");
    for (int page = 0; page < 3; ++page) {
        if (page < 2) {
            tab_to("#message-actions button");
            browser_->press("Enter");
        }
        wait_for(format("!!trial && state.sent.answers.length === {}", std::max(0, page - 1)));
        for (const char* video : {"0", "1"}) {
            browser_->press(" ");
            wait_for(format("trial.stage.screens[{}].watched", video));
        }
        browser_->press("1");
        EXPECT_FALSE(may_go_on());
        EXPECT_EQ(text_of("status"), "Please choose a reason too.");
        tab_to("input[value=amount]");
        browser_->press(" ");
        EXPECT_TRUE(may_go_on());
        browser_->press("Enter");
        if (page == 0) wait_for_section("message");
    }
    wait_for_section("questionnaire");
    tab_to("input[type=number]");
    for (const char* digit : {"3", "1"}) browser_->press(digit);
    browser_->press("Enter");
    wait_for_section("finish");
    const Json saved = evaluate("state.sent");
    EXPECT_EQ(saved["questionnaire"]["age"], 31);
    EXPECT_EQ(saved["answers"][1]["reasons"]["realism"], Json({{"chosen", {"amount"}}, {"other", ""}}));
}

TEST_F(StudyPage, LeavesKeysAloneWhenShortcutsAreOff) {
    open();
    start();
    end_videos();
    click("#shortcuts");
    browser_->press("2");
    EXPECT_EQ(values()["realism"], Json());
}

TEST_F(StudyPage, SpeaksFrenchWithItsPlurals) {
    study_["language"] = "fr";
    open();
    EXPECT_EQ(evaluate("document.documentElement.lang"), "fr");
    EXPECT_EQ(text_of("start"), "Commencer");
    EXPECT_THAT(text_of("requirements"), HasSubstr("Il y a 2 pages."));
    EXPECT_EQ(evaluate("say('answered', {n: 0, all: 4})"), "Vous avez répondu à 0 page sur 4.");
    EXPECT_EQ(evaluate("say('finish_title')"), "Merci\u202f!");
    start();
    EXPECT_EQ(text_of("next"), "Suivant");
    EXPECT_EQ(text_of("status"), "Regardez les deux vidéos jusqu’au bout pour répondre.");
}

TEST_F(StudyPage, TakesTextsOfAnyLanguageFromTheStudy) {
    study_["language"] = "pl";
    study_["texts"] = {{"begin", "Zaczynamy"},
                       {"pages.one", "Jest jedna strona."},
                       {"pages.few", "Są {n} strony."},
                       {"pages.many", "Jest {n} stron."}};
    open();
    EXPECT_EQ(text_of("start"), "Zaczynamy");
    EXPECT_THAT(text_of("requirements"), HasSubstr("Są 2 strony."));
    EXPECT_EQ(evaluate("say('pages', {n: 5})"), "Jest 5 stron.");
    EXPECT_EQ(evaluate("say('next')"), "Next");  // what the study leaves out
}

TEST_F(StudyPage, HasTheSameTextsInEveryLanguageAndInTheDocs) {
    open();
    EXPECT_EQ(evaluate("Object.keys(kTexts.fr)"), evaluate("Object.keys(kTexts.en)"));
    const Json odd = evaluate(
        "Object.keys(kTexts.en).filter((name) => { const marks = (text) => "
        "(text.match(/\\{\\w+\\}/g) || []).filter((mark) => mark !== '{n}').sort().join(); "
        "return marks(kTexts.en[name]) !== marks(kTexts.fr[name]); })");
    EXPECT_EQ(odd, Json::array());
    const std::string docs = read_text(testing::source_dir() / "docs/page.md");
    for (const Json& name : evaluate("Object.keys(kTexts.en)")) {
        EXPECT_THAT(docs, HasSubstr(format("`{}`", name.get<std::string>())));
    }
}

TEST_F(StudyPage, DeletesWhatIsOnThisDeviceAlone) {
    testing::Walker first;
    first.pages_at_most = 1;
    walk(first, "?p=ada");
    click("#your-data");
    wait_for("document.getElementById('data').open");
    EXPECT_THAT(text_of("data-text"), HasSubstr("on this device alone"));
    EXPECT_EQ(Json::parse(text_of("data-stored"))["answers"].size(), 1u);
    click("#withdraw");
    EXPECT_EQ(evaluate("document.activeElement.id"), "data-close");
    click_and_reload("#withdraw-sure");
    wait_for("document.getElementById('message-title').textContent === 'You have withdrawn'");
    EXPECT_THAT(text_of("message-text"), HasSubstr("deleted from this device"));
    EXPECT_EQ(evaluate("Object.keys(localStorage).length"), 0);
}

}  // namespace
}  // namespace chironomia::study
