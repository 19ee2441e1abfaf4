#include "study/analysis/answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/files/files.h"
#include "study/analysis/rehearsal.h"
#include "tests/study/analysis/sample_study.h"
#include "tests/support/support.h"

namespace chironomia::study::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

// A study that asks for reasons, and the answers of two simulated raters.
class ReadAnswers : public ::testing::Test {
  protected:
    ReadAnswers() {
        SampleStudy study;
        study.questions[0]["reasons"] = {
            {"text", "Why?"}, {"options", {{{"id", "smoothness"}, {"text", "Smooth"}}}}, {"unless", 3}};
        study.questions.push_back({{"id", "age"},
                                   {"kind", "number"},
                                   {"text", "?"},
                                   {"least", 0},
                                   {"most", 120},
                                   {"optional", true}});
        write_sample_study(study, folder_.path());
        key_ = read_study_key(folder_ / "private/key.json");
        answers_ = rehearse_study({.study = folder_.path(), .participants = 2, .failing = 0, .seed = 1});
    }

    std::vector<Respondent> read() {
        write_json(folder_ / "answers.json", answers_);
        return read_answers({folder_ / "answers.json"}, key_);
    }

    std::string refusal() {
        return refusal_of([&] { read(); });
    }

    Json& first() { return answers_[0]["answers"][0]; }

    TemporaryFolder folder_;
    StudyKey key_;
    Json answers_;
};

TEST_F(ReadAnswers, ReadsOneParticipantOrAList) {
    const auto both = read();
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].name, "simulated-1");
    EXPECT_TRUE(both[0].simulated);
    EXPECT_TRUE(both[0].finished);
    EXPECT_EQ(both[0].answers.size(), 8u);
    EXPECT_EQ(both[1].sheet, 1u);
    answers_ = answers_[0];
    answers_["finished"] = nullptr;
    const auto one = read();
    ASSERT_EQ(one.size(), 1u);
    EXPECT_FALSE(one[0].finished);
}

// A page of jsPsych with DataPipe leaves a file after each answer, and one at the end.
TEST_F(ReadAnswers, TakesOfAVisitThatGrewTheLastFile) {
    const Json whole = answers_[0];
    std::vector<std::filesystem::path> files;
    for (const std::size_t given : {1u, 3u, 8u}) {
        Json some = whole;
        some["finished"] = nullptr;
        some["started"] = "2026-01-31T10:00:00.000Z";
        some["answers"] = Json::array();
        for (std::size_t i = 0; i < given; ++i) some["answers"].push_back(whole["answers"][i]);
        files.push_back(folder_ / ("part-" + std::to_string(given) + ".json"));
        write_json(files.back(), some);
    }
    Json last = read_json(files.back());
    last["finished"] = "2026-01-31T10:20:00.000Z";
    files.insert(files.begin(), folder_ / "whole.json");
    write_json(files.front(), last);
    const auto participants = read_answers(files, key_);
    ASSERT_EQ(participants.size(), 1u);
    EXPECT_EQ(participants[0].file, files.front().string());
    EXPECT_EQ(participants[0].answers.size(), 8u);
    EXPECT_TRUE(participants[0].finished);

    // Another answer at the same place, or another visit, is no beginning.
    Json other = read_json(files[1]);
    other["answers"][0]["seconds"] = 99;
    write_json(files[1], other);
    EXPECT_THAT(refusal_of([&] { read_answers(files, key_); }), HasSubstr("is already in"));
    other = read_json(files[2]);
    other["started"] = "2026-02-01T10:00:00.000Z";
    write_json(files[2], other);
    EXPECT_THAT(refusal_of([&] { read_answers({files[0], files[2]}, key_); }), HasSubstr("is already in"));
}

TEST_F(ReadAnswers, KnowsWhichPlaceStoodWhere) {
    // The first page of the second sheet is page 1, whose sides that sheet leaves; page 0 it turns.
    const auto participants = read();
    for (const PageAnswer& answer : participants[1].answers) {
        if (answer.page == 0) {
            EXPECT_THAT(answer.order, ElementsAre(1, 0));
        } else if (answer.page == 1) {
            EXPECT_THAT(answer.order, ElementsAre(0, 1));
        }
    }
}

TEST_F(ReadAnswers, OneVideoOfBothFiguresStandsAsItsPlacesDo) {
    for (KeyPage& page : key_.pages) page.places[1].video = page.places[0].video;
    for (Json& participant : answers_) {
        for (Json& answer : participant["answers"])
            answer["videos"] = Json::array(
                {key_.pages[std::stoul(answer["page"].get<std::string>(), nullptr, 16)].places[0].video});
    }
    EXPECT_THAT(read()[1].answers[0].order, ElementsAre(0, 1));
}

TEST_F(ReadAnswers, RefusesAnswersOfAnotherStudy) {
    answers_[1]["study"] = "ffff";
    EXPECT_THAT(refusal(),
                HasSubstr("answers.json: [1].study: is \"ffff\", the key is of study \"3f0c9a5b1e2d4c68\""));
    answers_[1]["format"] = "chironomia answers 1";
    EXPECT_THAT(refusal(),
                HasSubstr("format: is \"chironomia answers 1\", \"chironomia answers 2\" is needed"));
}

TEST_F(ReadAnswers, RefusesWhatComesTwice) {
    answers_[1]["participant"] = "simulated-1";
    EXPECT_THAT(refusal(), HasSubstr("participant \"simulated-1\" is already in"));
    answers_[1]["participant"] = "other";
    answers_[0]["arrived_with"] = answers_[1]["arrived_with"] = {{"PROLIFIC_PID", "abc"}};
    EXPECT_THAT(refusal(), HasSubstr("the PROLIFIC_PID \"abc\" is already in"));
    answers_[1]["arrived_with"] = nullptr;
    answers_[0]["answers"].push_back(first());
    EXPECT_THAT(refusal(), HasSubstr("pass 0 of page \"0000000000000000\" is answered a second time"));
}

// Anybody can change the name in a link.
TEST_F(ReadAnswers, ShowsNamesThatNoTableCanHold) {
    answers_[0]["participant"] = std::string("a\0b\n", 4);
    answers_[1]["participant"] = "  ";
    EXPECT_EQ(read()[0].name, "\"a\\u0000b\\n\"");
    EXPECT_EQ(read()[1].name, "\"  \"");
    answers_[1]["participant"] = 7;
    EXPECT_THAT(refusal(), HasSubstr("participant: is 7, a text in quotes is needed"));
}

TEST_F(ReadAnswers, RefusesUnknownPagesAndVideos) {
    first()["videos"][0] = "nowhere";
    EXPECT_THAT(refusal(), HasSubstr("is \"nowhere\", which is no video of this page"));
    first()["videos"] = Json::array({first()["videos"][1]});
    EXPECT_THAT(refusal(), HasSubstr("has 1 entries, the page has 2 videos"));
    first()["page"] = "nowhere";
    EXPECT_THAT(refusal(), HasSubstr("[0].answers[0].page: is \"nowhere\", which is no page of the study"));
}

TEST_F(ReadAnswers, RefusesUnknownQuestionsAndReasons) {
    first()["reasons"] = {{"realism", {{"chosen", {"smooth"}}, {"other", ""}}}};
    EXPECT_THAT(refusal(), HasSubstr("\"smooth\" is none of its reasons, or is there twice"));
    first()["reasons"] = {{"realism", {{"chosen", {"smoothness", "smoothness"}}, {"other", ""}}}};
    EXPECT_THAT(refusal(), HasSubstr("reasons.realism: is {"));
    first()["reasons"] = {{"realism", {{"chosen", Json::array()}, {"other", 3}}}};
    EXPECT_THAT(refusal(), HasSubstr("3 is no other reason"));
    first()["reasons"] = {{"age", {{"chosen", Json::array()}, {"other", ""}}}};
    EXPECT_THAT(refusal(), HasSubstr("reasons.age: the question asks for no reasons"));
    first()["values"]["realis"] = 1;
    EXPECT_THAT(refusal(), HasSubstr("did you mean \"realism\"?"));
}

TEST_F(ReadAnswers, RefusesValuesOffTheScale) {
    first()["values"]["realism"] = 6;
    EXPECT_THAT(refusal(), HasSubstr("values.realism: is 6; a whole number from 1 to 5 is needed"));
}

TEST_F(ReadAnswers, ASkippedPageHasNoAnswersAndAnotherHasSome) {
    first()["skipped"] = true;
    EXPECT_THAT(refusal(), HasSubstr("but the page was skipped; it can have no answers"));
    first()["values"] = Json::object();
    EXPECT_TRUE(read()[0].answers[0].skipped);
    first()["skipped"] = false;
    EXPECT_THAT(refusal(), HasSubstr("is empty, but the page was not skipped"));
    first()["skipped"] = 1;
    EXPECT_THAT(refusal(), HasSubstr("skipped: is 1, true or false is needed"));
}

TEST_F(ReadAnswers, RefusesTimesThatAreNone) {
    first()["seconds"] = -1;
    EXPECT_THAT(refusal(), HasSubstr("seconds: is -1, a number of seconds is needed"));
}

TEST_F(ReadAnswers, DoesNotMixPeopleWithSimulatedRaters) {
    answers_[1]["simulated"] = false;
    EXPECT_THAT(refusal(), HasSubstr("1 participants are simulated and 1 are not; analyse them apart"));
}

TEST(FilesOfAnswers, AreThoseOfFoldersToo) {
    const TemporaryFolder folder;
    write_text(folder / "a/2.json", "{}");
    write_text(folder / "a/1.json", "{}");
    write_text(folder / "a/notes.txt", "");
    write_text(folder / "b.csv", "");
    EXPECT_THAT(files_of_answers({folder / "a", folder / "b.csv"}).files,
                ElementsAre(folder / "a/1.json", folder / "a/2.json", folder / "b.csv"));
    std::filesystem::create_directory(folder / "empty");
    EXPECT_THAT(refusal_of([&] { files_of_answers({folder / "empty"}); }),
                HasSubstr("holds no .json and no .csv file"));
    EXPECT_THAT(refusal_of([&] { files_of_answers({folder / "none"}); }),
                HasSubstr("there is no such file or folder"));
}

}  // namespace
}  // namespace chironomia::study::analysis
