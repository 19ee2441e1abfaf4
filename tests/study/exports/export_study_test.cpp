// What is exported is read back and compared with the study.
#include "study/exports/export_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "study/server/served_study.h"
#include "tests/study/exports/exported_sample.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::ExportedSample;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::SampleStudy;

constexpr const char* kUrl = "https://example.org/study/";

// Three answers, as HEMVIP's pairs have them, and no second question.
void ask_for_left_or_right(ExportedSample& sample) {
    const Json questions = Json::parse(R"([{"id": "realism", "kind": "preference", "text": "Which one?",
        "answers": ["left", "equal", "right"]}])");
    sample.change("public/pages.json", [&](Json& pages) {
        pages["questions"] = questions;
        for (Json& page : pages["pages"]) page["passes"][0]["questions"] = {0};
    });
    sample.change("private/key.json", [&](Json& key) {
        key["questions"] = questions;
        for (Json& page : key["pages"]) {
            if (page["kind"] == "check") page["expected"] = {{"realism", 1}};
        }
    });
}

// The preference alone, with its five answers.
void ask_for_a_preference(ExportedSample& sample) {
    sample.change("public/pages.json", [](Json& pages) {
        for (Json& page : pages["pages"]) page["passes"][0]["questions"] = {0};
    });
}

// Names of conditions stand in no file, and the folder for the web has nothing of private/.
void expect_blind(const ExportedSample& sample) {
    const std::string open = sample.all_that_is_open();
    for (const char* name : {"ours", "baseline", "third", "fourth", "expected", "trial"}) {
        EXPECT_THAT(open, Not(HasSubstr(format("\"{}\"", name))));
        EXPECT_THAT(open, Not(HasSubstr(format("{},", name))));
        EXPECT_THAT(open, Not(HasSubstr(format("/{}/", name))));
    }
    EXPECT_EQ(sample.mapping()["format"], "chironomia export 1");
}

// The earliest time that archives can store: a time of the copy would give the order away, one to come confuses
// servers.
TEST(ExportStudy, GivesVideosOneTimeThatSaysNothing) {
    ExportedSample sample({});
    sample.write(ExportForm::jspsych);
    const auto neutral = std::chrono::sys_days(std::chrono::year(1980) / 1 / 1);
    std::size_t videos = 0;
    for (const auto& entry : fs::directory_iterator(sample.open("clips"))) {
        EXPECT_EQ(std::chrono::file_clock::to_sys(entry.last_write_time()), neutral) << entry.path();
        ++videos;
    }
    EXPECT_GT(videos, 0u);
}

// ---- HEMVIP

TEST(Hemvip, HasAFileForEachSheetWithItsVideosInTheirOrder) {
    ExportedSample sample({.layout = "parallel", .trials = 3, .checks = 0, .sheets = 2});
    sample.write(ExportForm::hemvip, kUrl);
    const server::ServedStudy study = server::read_served_study(sample.study());
    for (std::size_t sheet = 0; sheet < 2; ++sheet) {
        const Json config =
            read_json(sample.open(format("configs/{}/sheet-{:03}.json", study.pages.study, sheet + 1)));
        EXPECT_EQ(config["testId"], study.pages.study);
        EXPECT_EQ(config["remoteService"], "/save");
        std::vector<Json> videos;
        for (const Json& page : config["pages"]) {
            if (page["type"] == "video") videos.push_back(page);
        }
        ASSERT_EQ(videos.size(), 3u);
        for (std::size_t i = 0; i < videos.size(); ++i) {
            const Step& step = study.sheets[sheet][i];
            const StudyPage& page = study.pages.pages[step.page];
            EXPECT_EQ(videos[i]["id"], page.id);
            EXPECT_EQ(videos[i]["question"], "How human-like is it?");
            ASSERT_EQ(videos[i]["stimuli"].size(), 4u);
            for (std::size_t place = 0; place < 4; ++place) {
                const std::string& file = page.videos[step.order[place]];
                EXPECT_EQ(videos[i]["stimuli"][place], Json({token_of(file), kUrl + file}));
                EXPECT_EQ(read_text(sample.open(file)), read_text(sample.study() / "public" / file));
            }
        }
        EXPECT_EQ(config["pages"].front()["content"], "You will see two people.<br>Watch both &amp; answer.");
        EXPECT_EQ(config["pages"].back()["type"], "finish");
        EXPECT_EQ(config["pages"].back()["questionnaire"][0]["max"], 120);
    }
    expect_blind(sample);
}

TEST(Hemvip, MarksAttentionChecksOfSlidersWithTheirValue) {
    ExportedSample sample({.layout = "parallel", .trials = 1, .checks = 1, .sheets = 2});
    const ExportSummary summary = sample.write(ExportForm::hemvip);
    EXPECT_THAT(summary.notes, ::testing::Contains(HasSubstr("marks attention checks")));
    // Sheet 2 begins with the check, its videos from right to left; the first of the key is expected at 100.
    const Json config = read_json(sample.open("configs/3f0c9a5b1e2d4c68/sheet-002.json"));
    const Json stimuli = config["pages"][2]["stimuli"];
    EXPECT_EQ(stimuli[3][0], "at");
    EXPECT_EQ(stimuli[3][2], 100);
    EXPECT_EQ(stimuli[0][2], 0);
}

// Null in the key: any value will do for that video.
TEST(Hemvip, MarksNoVideoThatMayHaveAnyValue) {
    ExportedSample sample({.layout = "parallel", .trials = 1, .checks = 1, .sheets = 2});
    sample.change("private/key.json", [](Json& key) {
        key["pages"][1]["expected"] = {{"human", {75, nullptr, nullptr, nullptr}}};
    });
    sample.write(ExportForm::hemvip);
    const Json stimuli =
        read_json(sample.open("configs/3f0c9a5b1e2d4c68/sheet-002.json"))["pages"][2]["stimuli"];
    EXPECT_EQ(stimuli[3][0], "at");
    EXPECT_EQ(stimuli[3][2], 75);
    for (std::size_t place = 0; place < 3; ++place) EXPECT_EQ(stimuli[place].size(), 2u) << place;
}

TEST(Hemvip, ShowsPairsWithThreeAnswers) {
    ExportedSample sample({});
    ask_for_left_or_right(sample);
    sample.write(ExportForm::hemvip);
    const Json page = read_json(sample.open("configs/3f0c9a5b1e2d4c68/sheet-001.json"))["pages"][2];
    EXPECT_EQ(page["type"], "videopc");
    EXPECT_EQ(page["stimuli"].size(), 2u);
    expect_blind(sample);
}

TEST(Hemvip, RefusesWhatItCannotShow) {
    EXPECT_THAT(
        ExportedSample({.layout = "single"}).refusal(ExportForm::hemvip),
        HasSubstr("hemvip cannot express this study: layout \"single\"; pair and parallel are possible"));
    EXPECT_THAT(ExportedSample({}).refusal(ExportForm::hemvip), HasSubstr("asks 2 questions at a time"));
    ExportedSample five({});
    ask_for_a_preference(five);
    EXPECT_THAT(five.refusal(ExportForm::hemvip), HasSubstr("a preference with 3 answers"));
    ExportedSample points({.layout = "parallel"});
    points.change("public/pages.json", [](Json& pages) { pages["questions"][0]["most"] = 10; });
    points.change("private/key.json", [](Json& key) { key["pages"].back()["expected"] = Json::object(); });
    EXPECT_THAT(points.refusal(ExportForm::hemvip), HasSubstr("a slider from 0 to 100 of each"));
    EXPECT_FALSE(fs::exists(points.out()));
}

// ---- HEMVIP2

TEST(Hemvip2, HasRowsOfPairsAndTheFoldersTheyMean) {
    ExportedSample sample({.trials = 3, .checks = 1, .sheets = 2});
    ask_for_a_preference(sample);
    const ExportSummary summary = sample.write(ExportForm::hemvip2);
    EXPECT_THAT(summary.notes, ::testing::Contains(HasSubstr("attention checks are left out")));
    const server::ServedStudy study = server::read_served_study(sample.study());
    const Json mapping = sample.mapping();
    for (std::size_t sheet = 0; sheet < 2; ++sheet) {
        const std::string csv = read_text(sample.open(format("csv/sheet-{:03}.csv", sheet + 1)));
        std::string expected = "clip_name,system_1,system_2\n";
        std::string found = expected;
        for (const Step& step : study.sheets[sheet]) {
            const KeyPage& page = study.key.pages[step.page];
            if (page.kind != PageKind::trial) continue;
            expected += format("{},{},{}\n", page.clip, condition_at(study.key, page.places[step.order[0]]),
                               condition_at(study.key, page.places[step.order[1]]));
        }
        const std::vector<std::string_view> lines = split(csv, '\n');
        for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
            const std::vector<std::string_view> parts = split(lines[i], ',');
            const auto name = [&](const char* kind, std::size_t part) {
                return mapping[kind][std::string(parts[part])].get<std::string>();
            };
            found += format("{},{},{}\n", name("clips", 0), name("conditions", 1), name("conditions", 2));
            EXPECT_TRUE(fs::exists(sample.open(format("videos/systems/{}/{}.mp4", parts[1], parts[0]))));
        }
        EXPECT_EQ(found, expected);
    }
    expect_blind(sample);
}

TEST(Hemvip2, HasRowsOfMismatchedSpeech) {
    ExportedSample sample({.trials = 1, .checks = 0, .sheets = 1});
    ask_for_a_preference(sample);
    sample.change("private/key.json", [](Json& key) {
        key["conditions"][1]["from"] = "ours";
        key["conditions"][1]["made"] = "mismatched speech";
        key["videos"][1]["speech"] = "c9";
        Json other = key["videos"][0];
        other["token"] = "x";
        other["clip"] = other["speech"] = "c9";
        key["videos"].push_back(other);
    });
    sample.write(ExportForm::hemvip2);
    const std::string csv = read_text(sample.open("csv/sheet-001.csv"));
    const std::vector<std::string_view> row = split(split(csv, '\n')[1], ',');
    EXPECT_TRUE(csv.starts_with("clip_name,system,mismatch_type,mismatch_data\n"));
    const Json mapping = sample.mapping();
    EXPECT_EQ(mapping["clips"][std::string(row[0])], "c0");
    EXPECT_EQ(mapping["conditions"][std::string(row[1])], "ours");
    EXPECT_EQ(row[2], "speech");
    EXPECT_EQ(mapping["clips"][std::string(row[3])], "c9");
    EXPECT_TRUE(fs::exists(sample.open(
        format("videos/mismatched/speech/{}/{}_with_speech_from_{}.mp4", row[1], row[0], row[3]))));
}

TEST(Hemvip2, RefusesWhatItCannotShow) {
    EXPECT_THAT(ExportedSample({.layout = "parallel"}).refusal(ExportForm::hemvip2),
                HasSubstr("pairs of two videos"));
    ExportedSample three({});
    ask_for_left_or_right(three);
    EXPECT_THAT(three.refusal(ExportForm::hemvip2), HasSubstr("a preference with 5 answers"));
    ExportedSample motion({});
    ask_for_a_preference(motion);
    motion.change("private/key.json", [](Json& key) {
        key["conditions"][1]["from"] = "ours";
        key["conditions"][1]["made"] = "mismatched motion";
    });
    EXPECT_THAT(motion.refusal(ExportForm::hemvip2), HasSubstr("is not the same motion with other speech"));
}

// ---- webMUSHRA

TEST(Webmushra, HasAFileForEachSheetWithItsVideosInTheirOrder) {
    ExportedSample sample({.layout = "parallel", .trials = 2, .checks = 0, .sheets = 2});
    sample.write(ExportForm::webmushra);
    const server::ServedStudy study = server::read_served_study(sample.study());
    const Json config = sample.read_yaml(sample.open("configs/sheet-002.yaml"));
    EXPECT_EQ(config["testname"], "Two ways to move");
    // webMUSHRA and its fork know no page that asks for consent.
    for (const Json& page : config["pages"]) {
        EXPECT_THAT((std::vector<std::string>{"generic", "video_synchronized", "video_believable", "finish"}),
                    ::testing::Contains(page["type"].get<std::string>()));
    }
    EXPECT_EQ(config["pages"][1]["name"], "Consent");
    for (std::size_t i = 0; i < 2; ++i) {
        const Step& step = study.sheets[1][i];
        const Json& page = config["pages"][i + 2];
        EXPECT_EQ(page["type"], "video_synchronized");
        EXPECT_EQ(page["question"], "How human-like is it?");
        for (std::size_t place = 0; place < 4; ++place) {
            const std::string& file = study.pages.pages[step.page].videos[step.order[place]];
            EXPECT_EQ(page["stimuli"][format("C{}", place + 1)], Json({token_of(file), file}));
        }
    }
    EXPECT_EQ(config["pages"].back()["type"], "finish");
    EXPECT_EQ(config["pages"].back()["questionnaire"][0]["type"], "number");
    expect_blind(sample);
}

TEST(Webmushra, ShowsSilentPassesAsBelievable) {
    ExportedSample sample({.layout = "parallel"});
    sample.change("public/pages.json", [](Json& pages) {
        for (Json& page : pages["pages"])
            page["passes"] = {{{"sound", false}, {"questions", {0}}}, {{"sound", true}, {"questions", {0}}}};
    });
    sample.write(ExportForm::webmushra);
    const Json config = sample.read_yaml(sample.open("configs/sheet-001.yaml"));
    EXPECT_EQ(config["pages"][2]["type"], "video_believable");
    EXPECT_EQ(config["pages"][3]["type"], "video_synchronized");
}

TEST(Webmushra, RefusesWhatItCannotShow) {
    EXPECT_THAT(ExportedSample({}).refusal(ExportForm::webmushra), HasSubstr("layout \"pair\""));
    ExportedSample points({.layout = "parallel", .checks = 0});
    points.change("public/pages.json", [](Json& pages) {
        pages["questions"][0] = {{"id", "human"}, {"kind", "number"}, {"text", "How human-like is it?"}};
    });
    EXPECT_THAT(points.refusal(ExportForm::webmushra), HasSubstr("a slider from 0 to 100 of each video"));
    ExportedSample ranks({.layout = "parallel"});
    ranks.change("public/pages.json", [](Json& pages) {
        pages["questionnaire"][1] = {
            {"id", "order"},
            {"kind", "rank"},
            {"text", "Which order?"},
            {"options", {{{"id", "a"}, {"text", "A"}}, {{"id", "b"}, {"text", "B"}}}}};
    });
    EXPECT_THAT(ranks.refusal(ExportForm::webmushra),
                HasSubstr("at the end must be a number, a text or a choice"));
    EXPECT_THAT(ranks.refusal(ExportForm::hemvip),
                HasSubstr("at the end must be a number, a text or a choice"));
}

// ---- Qualtrics

TEST(Qualtrics, HasASurveyAndRowsForItsLoop) {
    ExportedSample sample({.trials = 2, .checks = 0, .sheets = 2});
    sample.write(ExportForm::qualtrics, kUrl);
    const server::ServedStudy study = server::read_served_study(sample.study());
    std::string expected = "clip,urlLeft,urlRight,code\n";
    const Json mapping = sample.mapping();
    const std::string csv = read_text(sample.open("loop_and_merge/sheet-002.csv"));
    for (std::size_t i = 0; i < 2; ++i) {
        const Step& step = study.sheets[1][i];
        const StudyPage& page = study.pages.pages[step.page];
        const std::string clip(split(split(csv, '\n')[i + 1], ',')[0]);
        EXPECT_EQ(mapping["clips"][clip], study.key.pages[step.page].clip);
        expected += format("{},{}{},{}{},{}\n", clip, kUrl, page.videos[step.order[0]], kUrl,
                           page.videos[step.order[1]], page.id);
    }
    EXPECT_EQ(csv, expected);
    const std::string survey = read_text(sample.open("survey.txt"));
    EXPECT_TRUE(survey.starts_with(
        "[[AdvancedFormat]]\n\n[[ED:PROLIFIC_PID]]\n[[ED:STUDY_ID]]\n[[ED:SESSION_ID]]\n"));
    EXPECT_THAT(survey, HasSubstr("<video src=\"${lm://Field/2}\""));
    EXPECT_THAT(survey, HasSubstr("<video src=\"${lm://Field/3}\""));
    EXPECT_THAT(
        survey,
        HasSubstr("[[Question:MC:SingleAnswer:Horizontal]]\n[[ID:realism]]\n"
                  "Which one moves more like a person?\n[[Choices]]\nleft clearly\nleft slightly\nequal\n"
                  "right slightly\nright clearly\n"));
    EXPECT_THAT(survey,
                HasSubstr("[[ID:realism_reasons]]\nWhy?\n[[Choices]]\nsmoothness\namount\nSomething else\n"));
    EXPECT_THAT(survey,
                HasSubstr("[[Question:Matrix]]\n[[ID:human]]\nHow human-like is it?\n[[Choices]]\nA\nB\n"
                          "[[Answers]]\n1 not at all\n2\n3\n4\n5\n6\n7 very\n"));
    expect_blind(sample);
}

TEST(Qualtrics, NamesTheColumnsOfOneAndOfManyVideos) {
    ExportedSample one({.layout = "single"});
    one.write(ExportForm::qualtrics, kUrl);
    EXPECT_TRUE(read_text(one.open("loop_and_merge/sheet-001.csv")).starts_with("clip,url,code\n"));
    ExportedSample three({.layout = "triplet"});
    three.write(ExportForm::qualtrics, kUrl);
    EXPECT_TRUE(
        read_text(three.open("loop_and_merge/sheet-001.csv")).starts_with("clip,url1,url2,url3,code\n"));
}

TEST(Qualtrics, NamesVideosAsTheStudysOwnPageDoes) {
    const auto survey_of = [](const testing::SampleStudy& study) {
        ExportedSample sample(study);
        sample.write(ExportForm::qualtrics, kUrl);
        return read_text(sample.open("survey.txt"));
    };
    const std::string begin = "<b style=\"flex:1;text-align:center\">";
    EXPECT_THAT(survey_of({.layout = "triplet"}),
                HasSubstr(format("{0}A</b>{0}Reference</b>{0}B</b></div>", begin)));
    EXPECT_THAT(survey_of({.layout = "single"}), Not(HasSubstr(begin)));
}

TEST(Qualtrics, RefusesWhatItCannotShow) {
    EXPECT_THAT(ExportedSample({}).refusal(ExportForm::qualtrics), HasSubstr("give --video-url https://"));
    EXPECT_THAT(ExportedSample({.layout = "parallel"}).refusal(ExportForm::qualtrics, kUrl),
                HasSubstr("is a slider"));
    ExportedSample mixed({});
    mixed.change("public/pages.json", [](Json& pages) { pages["pages"][1]["passes"][0]["questions"] = {0}; });
    EXPECT_THAT(mixed.refusal(ExportForm::qualtrics, kUrl), HasSubstr("all with the same questions"));
}

// A text file cannot send those who do not agree to the end.
TEST(Qualtrics, AsksForABranchAfterTheConsent) {
    ExportedSample sample({});
    const ::testing::Matcher<std::string> branch =
        HasSubstr("add a branch after the first block, where \"consent\" is its second choice, to the end");
    EXPECT_THAT(sample.write(ExportForm::qualtrics, kUrl).notes, ::testing::Contains(branch));
    ExportedSample without({});
    without.change("public/pages.json", [](Json& pages) { pages["consent"] = nullptr; });
    EXPECT_THAT(without.write(ExportForm::qualtrics, kUrl).notes, Not(::testing::Contains(branch)));
}

// What a text has in common with a tag, or with HTML, is shown as it is.
TEST(Qualtrics, TakesNoTextForATag) {
    ExportedSample sample({});
    sample.change("public/pages.json", [](Json& pages) {
        pages["questions"][0]["text"] = "Which? [[Choices]]";
        pages["questions"][0]["answers"] = {"<left", "[[Question:MC]]", "a & b", "[[[", "right"};
        pages["consent"]["text"] = "Kept.\n[[Block:End]]";
        pages["questionnaire"][0]["text"] = "[[[PageBreak]]";
    });
    sample.write(ExportForm::qualtrics, kUrl);
    const std::string survey = read_text(sample.open("survey.txt"));
    EXPECT_THAT(survey, HasSubstr("[[ID:realism]]\nWhich? &#91;&#91;Choices]]\n[[Choices]]\n&lt;left\n"
                                  "&#91;&#91;Question:MC]]\na &amp; b\n&#91;&#91;[\nright\n[[Question:"));
    EXPECT_THAT(survey, HasSubstr("[[ID:consent]]\nKept.<br>&#91;&#91;Block:End]]\n[[Choices]]\n"));
    EXPECT_THAT(survey, HasSubstr("[[ID:age]]\n&#91;&#91;[PageBreak]]\n"));
}

// Words that the plan gives are there; the others are English, and a note says so.
TEST(Qualtrics, AsksInTheWordsOfTheStudy) {
    ExportedSample sample({});
    sample.change("public/pages.json", [](Json& pages) {
        pages["language"] = "fr";
        pages["consent"]["agree"] = "J’accepte";
        pages["texts"] = {{"decline", "Je refuse"}};
    });
    const ExportSummary summary = sample.write(ExportForm::qualtrics, kUrl);
    const std::string survey = read_text(sample.open("survey.txt"));
    EXPECT_THAT(survey, HasSubstr("[[Choices]]\nJ’accepte\nJe refuse\n"));
    EXPECT_THAT(survey, HasSubstr("[[Choices]]\nA\nB\n"));
    EXPECT_THAT(summary.notes, Not(::testing::Contains(HasSubstr("is in English"))));
    ExportedSample three({.layout = "triplet"});
    three.change("public/pages.json", [](Json& pages) { pages["language"] = "fr"; });
    EXPECT_THAT(three.write(ExportForm::qualtrics, kUrl).notes,
                ::testing::IsSupersetOf(
                    {"without \"reference\" in \"texts\" of the plan \"Reference\" is in English, "
                     "not in \"fr\""}));
}

// ---- All

std::vector<std::string> notes_of(
    ExportForm form, const SampleStudy& shape, const std::function<void(Json&)>& change = [](Json&) {}) {
    ExportedSample sample(shape);
    sample.change("public/pages.json", change);
    write_json(
        sample.study() / "private/plan.json",
        {{"completion", {{"code", "ABC"}, {"failed_code", "NO"}, {"declined_url", "https://example.org/"}}}});
    return sample.write(form, kUrl).notes;
}

void add_frame(Json& pages) {
    pages["language"] = "de";
    pages["training"] = {{"text", "Look."}, {"pages", {0}}};
    pages["sound_check"] = {{"files", {"clips/a.wav"}}, {"choices", {"1"}}};
    pages["skip_after"] = 5;
    pages["shuffle_questions"] = true;
    pages["completion"] = {{"code", "ABC"}};
}

TEST(ExportStudy, SaysWhatNoFormHas) {
    for (const ExportForm form : {ExportForm::hemvip, ExportForm::webmushra, ExportForm::jspsych}) {
        const std::vector<std::string> notes = notes_of(form, {.layout = "parallel"}, add_frame);
        EXPECT_THAT(notes,
                    ::testing::IsSupersetOf({"the training is left out, its text and 1 page for practice",
                                             "the sound check is left out",
                                             "no page can be skipped: \"skip_after\" is left out",
                                             "questions keep their order: \"shuffle_questions\" is left out",
                                             "link and code of those who fail attention checks are left out",
                                             "the link of those who decline is left out"}));
        const std::size_t others = form == ExportForm::jspsych ? 0 : 1;
        for (const char* note : {"the completion link and code are left out; give them to the platform",
                                 "the labels of the slider are left out",
                                 "the titles of pages, such as \"Thank you\", are in English, not in \"de\""})
            EXPECT_EQ(static_cast<std::size_t>(std::count(notes.begin(), notes.end(), note)), others) << note;
        const std::string words =
            "buttons and messages that \"texts\" of the plan leaves out are in English, not in \"de\"";
        EXPECT_EQ(static_cast<std::size_t>(std::count(notes.begin(), notes.end(), words)), 1 - others);
    }
}

TEST(ExportStudy, SaysNothingOfWhatAStudyDoesNotHave) {
    ExportedSample sample({.layout = "parallel", .checks = 0});
    for (const std::string& note : sample.write(ExportForm::webmushra).notes) {
        for (const char* part :
             {"training", "sound check", "skip", "order", "completion", "caption", "English"})
            EXPECT_THAT(note, Not(HasSubstr(part)));
    }
}

TEST(ExportStudy, SaysWhatPairsLose) {
    const auto in_turn = [](Json& pages) {
        pages["one_by_one"] = true;
        for (Json& page : pages["pages"]) page["caption"] = "What is said";
    };
    EXPECT_THAT(
        notes_of(ExportForm::qualtrics, {}, in_turn),
        ::testing::IsSupersetOf({"the captions of the pages are left out",
                                 "videos are not shown one after the other: \"presentation\" is left out"}));
    ExportedSample three({});
    ask_for_left_or_right(three);
    three.change("public/pages.json", [](Json& pages) {
        pages["questions"][0]["reasons"] = {{"text", "Why?"}, {"options", {{{"id", "a"}, {"text", "A"}}}}};
    });
    EXPECT_THAT(three.write(ExportForm::hemvip).notes,
                ::testing::IsSupersetOf({"HEMVIP names the three answers in its own words",
                                         "the reasons for preferences are left out"}));
    ExportedSample five({});
    ask_for_a_preference(five);
    EXPECT_THAT(
        five.write(ExportForm::hemvip2).notes,
        ::testing::Contains("HEMVIP2 has pages of its own; left out: instructions, consent, questionnaire"));
}

TEST(ExportStudy, RefusesAnAddressThatTablesCannotHold) {
    EXPECT_EQ(
        ExportedSample({}).refusal(ExportForm::qualtrics, "https://example.org/stu dy/"),
        "--video-url: \"https://example.org/stu dy/\" has at place 24 a character that no table of addresses "
        "can hold; write it as %20");
    EXPECT_THAT(ExportedSample({}).refusal(ExportForm::jspsych, "https://example.org/\n"),
                HasSubstr("\"https://example.org/\\n\" has at place 21"));
    EXPECT_THAT(ExportedSample({}).refusal(ExportForm::jspsych, "a,b/"), HasSubstr("write it as %2C"));
}

TEST(ExportStudy, NeedsEveryVideoAndAnEmptyPlace) {
    ExportedSample sample({});
    const std::string video = read_json(sample.study() / "public/pages.json")["pages"][0]["videos"][0];
    fs::remove(sample.study() / "public" / video);
    EXPECT_THAT(sample.refusal(ExportForm::jspsych),
                HasSubstr("1 of 10 videos are missing, the first is " + video));
    EXPECT_FALSE(fs::exists(sample.out()));
    write_text(sample.out() / "file", "somebody's");
    EXPECT_NE(sample.refusal(ExportForm::jspsych), "");
    EXPECT_EQ(read_text(sample.out() / "file"), "somebody's");
}

TEST(ExportStudy, GivesTheSameBytesEachTime) {
    ExportedSample first({}), second({});
    first.write(ExportForm::jspsych);
    second.write(ExportForm::jspsych);
    EXPECT_EQ(first.all_that_is_open(), second.all_that_is_open());
    EXPECT_EQ(first.mapping(), second.mapping());
}

}  // namespace
}  // namespace chironomia::study
