#include "study/server/answer_validation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::HasSubstr;
using testing::sample_entry;
using testing::write_sample_study;

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
    EXPECT_EQ(fault_after([](Json& entry) { std::swap(entry["videos"][0], entry["videos"][1]); }).order,
              "videos: they are not those of this page in the order of the sheet; load the page again");
}

TEST_F(Entries, AnswerWhatWasAsked) {
    const auto fit = [&](auto change) { return fault_after(change).fit; };
    EXPECT_THAT(fit([](Json& entry) { entry["values"]["realism"] = 6; }),
                HasSubstr("realism: 6 is no answer"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"].erase("human"); }),
                HasSubstr("human: it must be answered"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"]["realism"] = std::string(20001, 'x'); }),
                HasSubstr("a text of at most 20000 bytes"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"]["more"] = 1; }), HasSubstr("not asked"));
    EXPECT_THAT(fit([](Json& entry) { entry["values"] = 1; }), HasSubstr("not asked"));
    EXPECT_THAT(fit([](Json& entry) { entry["pass"] = 0.0; }), HasSubstr("pass: 0.0 is no whole number"));
    EXPECT_THAT(fit([](Json& entry) { entry["skipped"] = true; }), HasSubstr("cannot be skipped"));
    EXPECT_THAT(fit([](Json& entry) { entry["skipped"] = 1; }), HasSubstr("true or false"));
}

// A part of an optional answer is none.
TEST_F(Entries, RateAllVideosOrNone) {
    write_sample_study(folder_.path(), {});
    Json pages = read_json(folder_ / "public/pages.json");
    pages["questions"][1]["optional"] = true;
    write_json(folder_ / "public/pages.json", pages);
    EXPECT_EQ(fault_after([](Json& entry) { entry["values"]["human"] = nullptr; }).fit, "");
    for (const Json& part : {Json({3, nullptr}), Json({nullptr, nullptr})})
        EXPECT_THAT(fault_after([&](Json& entry) { entry["values"]["human"] = part; }).fit,
                    HasSubstr("for each of 2 videos a whole number from 1 to 7 is needed"));
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
}  // namespace chironomia::study::server
