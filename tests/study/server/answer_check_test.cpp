#include "study/server/answer_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::sample_entry;
using testing::write_sample_study;

AskedQuestion question(QuestionKind kind, double least = 0, double most = 0) {
    return {.id = "q", .kind = kind, .least = least, .most = most};
}

TEST(FaultOfValue, TakesWholeNumbersOfAScale) {
    const AskedQuestion rating = question(QuestionKind::rating, 1, 7);
    EXPECT_EQ(fault_of_value(rating, 1, 1), "");
    EXPECT_EQ(fault_of_value(rating, 7, 1), "");
    EXPECT_EQ(fault_of_value(rating, 8, 1), "q: 8 is no answer; a whole number from 1 to 7 is needed");
    for (const Json& wrong :
         {Json(0), Json(1.5), Json(2.0), Json("3"), Json(true), Json(nullptr), Json({3})}) {
        EXPECT_NE(fault_of_value(rating, wrong, 1), "") << wrong;
    }
}

TEST(FaultOfValue, TakesAnArrayOfThoseForEachVideo) {
    AskedQuestion slider = question(QuestionKind::slider, 0, 100);
    slider.each = true;
    EXPECT_EQ(fault_of_value(slider, {0, 100, 50}, 3), "");
    EXPECT_THAT(fault_of_value(slider, {0, 100}, 3), HasSubstr("for each of 3 videos"));
    EXPECT_NE(fault_of_value(slider, {0, 100, 101}, 3), "");
    EXPECT_NE(fault_of_value(slider, 5, 3), "");
}

TEST(FaultOfValue, TakesAnOptionOrAVideo) {
    AskedQuestion choice = question(QuestionKind::choice);
    choice.options = {{.id = "a", .text = "A"}, {.id = "b", .text = "B"}};
    EXPECT_EQ(fault_of_value(choice, "b", 2), "");
    EXPECT_THAT(fault_of_value(choice, "c", 2), HasSubstr("one of its options"));
    EXPECT_NE(fault_of_value(choice, 0, 2), "");
    choice.of_videos = true;
    EXPECT_EQ(fault_of_value(choice, 1, 2), "");
    EXPECT_THAT(fault_of_value(choice, 2, 2), HasSubstr("a place from 0 to 1"));
}

TEST(FaultOfValue, TakesEachRankOnce) {
    AskedQuestion rank = question(QuestionKind::rank);
    rank.of_videos = true;
    EXPECT_EQ(fault_of_value(rank, {2, 3, 1}, 3), "");
    for (const Json& wrong : {Json({1, 1, 2}), Json({0, 1, 2}), Json({1, 2}), Json({1, 2, 3, 4}), Json(1)}) {
        EXPECT_THAT(fault_of_value(rank, wrong, 3), HasSubstr("ranks 1 to 3")) << wrong;
    }
}

TEST(FaultOfValue, TakesTextsAndNumbers) {
    EXPECT_EQ(fault_of_value(question(QuestionKind::text), "good", 1), "");
    EXPECT_THAT(fault_of_value(question(QuestionKind::text), std::string(20001, 'x'), 1),
                HasSubstr("at most 20000"));
    EXPECT_EQ(fault_of_value(question(QuestionKind::number, 18, 120), 18.5, 1), "");
    EXPECT_THAT(fault_of_value(question(QuestionKind::number, 18, 120), 17, 1), HasSubstr("from 18 to 120"));
    EXPECT_THAT(fault_of_value(question(QuestionKind::number, 18, 120), "20", 1), HasSubstr("a number"));
    constexpr double kAny = std::numeric_limits<double>::infinity();
    EXPECT_EQ(fault_of_value(question(QuestionKind::number, -kAny, kAny), -1e9, 1), "");
    EXPECT_THAT(fault_of_value(question(QuestionKind::number, -kAny, kAny), "20", 1),
                HasSubstr("a number is needed"));
    EXPECT_THAT(fault_of_value(question(QuestionKind::number, 18, kAny), 17, 1), HasSubstr("from 18 on"));
    EXPECT_THAT(fault_of_value(question(QuestionKind::number, -kAny, 9), 10, 1), HasSubstr("up to 9"));
}

class Entries : public ::testing::Test {
  protected:
    Entries() { write_sample_study(folder_.path(), {}); }

    StudyPages study() { return read_study_pages(folder_ / "public/pages.json"); }

    // What is wrong with the sample's answer to the first page of sheet 1 after `change`.
    template <typename Change>
    EntryFault fault_after(Change change) {
        const StudyPages pages = study();
        const Step step = steps_of_sheet(pages, 1).front();
        Json entry = sample_entry(pages, step, "mark");
        change(entry);
        return fault_of_entry(pages, step, entry);
    }

    testing::TemporaryFolder folder_;
};

TEST_F(Entries, FitTheirStep) {
    const EntryFault fault = fault_after([](Json&) {});
    EXPECT_EQ(fault.order, "");
    EXPECT_EQ(fault.fit, "");
}

TEST_F(Entries, OfOtherPagesOrSidesAreOutOfOrder) {
    EXPECT_THAT(fault_after([](Json& entry) { entry["page"] = "0000"; }).order, HasSubstr("is next"));
    EXPECT_THAT(fault_after([](Json& entry) { entry["pass"] = 1; }).order, HasSubstr("is next"));
    EXPECT_THAT(fault_after([](Json& entry) { std::swap(entry["videos"][0], entry["videos"][1]); }).order,
                HasSubstr("the sheet shows"));
}

TEST_F(Entries, AnswerWhatWasAsked) {
    const auto fit = [&](auto change) { return fault_after(change).fit; };
    EXPECT_THAT(fit([](Json& entry) { entry["values"]["realism"] = 6; }),
                HasSubstr("realism: 6 is no answer"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"].erase("human"); }),
                HasSubstr("human: it must be answered"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"]["more"] = 1; }), HasSubstr("not asked"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"] = 1; }), HasSubstr("not asked"));
    EXPECT_THAT(fit([](Json& entry) { entry["pass"] = 0.0; }), HasSubstr("pass: 0.0 is no whole number"));
    EXPECT_THAT(fit([](Json& entry) { entry["skipped"] = true; }), HasSubstr("cannot be skipped"));
    EXPECT_THAT(fit([](Json& entry) { entry["skipped"] = 1; }), HasSubstr("true or false"));
}

TEST_F(Entries, GiveReasonsWhereTheyAreAskedFor) {
    const auto fit = [&](auto change) { return fault_after(change).fit; };
    EXPECT_THAT(fit([](Json& entry) { entry["reasons"] = Json::object(); }), HasSubstr("a reason is needed"));
    EXPECT_THAT(fit([](Json& entry) {
                    entry["reasons"]["realism"] = {{"chosen", Json::array()}, {"other", ""}};
                }),
                HasSubstr("a reason is needed"));
    EXPECT_THAT(fit([](Json& entry) { entry["reasons"]["realism"]["chosen"] = {"none"}; }),
                HasSubstr("\"none\""));
    EXPECT_THAT(fit([](Json& entry) {
                    entry["reasons"]["realism"]["chosen"] = {"smooth", "smooth"};
                }),
                HasSubstr("twice"));
    EXPECT_THAT(fit([](Json& entry) { entry["reasons"]["realism"]["other"] = 3; }),
                HasSubstr("no other reason"));
    EXPECT_THAT(fit([](Json& entry) { entry["reasons"]["realism"] = "smooth"; }), HasSubstr("chosen"));
    EXPECT_THAT(fit([](Json& entry) { entry["reasons"]["human"] = Json::object(); }),
                HasSubstr("none were asked"));
    EXPECT_EQ(fit([](Json& entry) {
                  entry["values"]["realism"] = 3;  // equal
                  entry["reasons"] = Json::object();
              }),
              "");
}

TEST_F(Entries, HaveTheFormOfTheContract) {
    const auto fit = [&](auto change) { return fault_after(change).fit; };
    EXPECT_THAT(fit([](Json& entry) { entry["extra"] = 1; }), HasSubstr("a key that answers do not have"));
    EXPECT_THAT(fit([](Json& entry) { entry.erase("videos"); }), HasSubstr("lacks \"videos\""));
    EXPECT_THAT(fit([](Json& entry) { entry["seconds"] = -1; }), HasSubstr("seconds"));
    EXPECT_THAT(fit([](Json& entry) { entry["events"] = {{1}}; }), HasSubstr("events"));
    EXPECT_THAT(fit([](Json& entry) {
                    entry["events"] = {{1, std::string(101, 'x')}};
                }),
                HasSubstr("events"));
    EXPECT_THAT(fit([](Json& entry) { entry = Json::array(); }), HasSubstr("a key"));
}

TEST_F(Entries, MayBeSkippedWhereTheStudyAllowsIt) {
    write_sample_study(folder_.path(), {.may_skip = true});
    const auto skip = [](Json& entry) {
        entry["skipped"] = true;
        entry["values"] = Json::object();
        entry["reasons"] = Json::object();
    };
    EXPECT_EQ(fault_after(skip).fit, "");
    EXPECT_THAT(fault_after([](Json& entry) { entry["skipped"] = true; }).fit, HasSubstr("has no answers"));
}

TEST_F(Entries, AreKeptInOneForm) {
    const StudyPages pages = study();
    Json entry = sample_entry(pages, steps_of_sheet(pages, 0).front(), "mark");
    Json bare = {
        {"values", entry["values"]}, {"seconds", 1}, {"videos", entry["videos"]}, {"pass", 0}, {"page", "p"}};
    EXPECT_EQ(as_stored(bare).dump(),
              R"({"page":"p","pass":0,"videos":)" + entry["videos"].dump() +
                  R"(,"values":{"realism":2,"human":[3,4]},"reasons":{},"skipped":false,)" +
                  R"("seconds":1,"events":[]})");
}

TEST_F(Entries, QuestionnairesAreJudgedToo) {
    const StudyPages pages = study();
    EXPECT_EQ(fault_of_questionnaire(pages, {{"age", 30}, {"remarks", "fine"}}), "");
    EXPECT_EQ(fault_of_questionnaire(pages, Json::object()), "");
    EXPECT_EQ(fault_of_questionnaire(pages, {{"age", nullptr}}), "");
    EXPECT_THAT(fault_of_questionnaire(pages, {{"age", 5}}), HasSubstr("age: 5 is no answer"));
    EXPECT_THAT(fault_of_questionnaire(pages, {{"name", "x"}}), HasSubstr("not asked"));
    EXPECT_THAT(fault_of_questionnaire(pages, Json::array({1})), HasSubstr("not asked"));
}

TEST(ParseBody, RefusesWhatIsNoJsonOrTooDeep) {
    EXPECT_EQ(parse_body(R"({"a": [1]})").value().dump(), R"({"a":[1]})");
    for (const char* text : {"", "{", "{\"a\": 1e999}", "\"\xff\"", "nan"})
        EXPECT_FALSE(parse_body(text)) << text;
    EXPECT_TRUE(parse_body(std::string(16, '[') + std::string(16, ']')));
    EXPECT_FALSE(parse_body(std::string(17, '[') + std::string(17, ']')));
    EXPECT_FALSE(parse_body(std::string(200'000, '[')));
}

}  // namespace
}  // namespace chironomia
