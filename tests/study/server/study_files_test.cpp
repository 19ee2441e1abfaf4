// Reading pages.json, key.json and plan.json of a study that is served or exported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/text.h"
#include "study/server/answer_validation.h"
#include "study/server/clock.h"
#include "study/server/secrets.h"
#include "study/server/served_study.h"
#include "tests/study/served_sample.h"
#include "tests/support/support.h"

namespace chironomia::study::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;
using testing::write_sample_study;

class FilesOfAStudy : public ::testing::Test {
  protected:
    FilesOfAStudy() { write_sample_study(folder_.path(), {}); }

    // What is said when one of the files is changed.
    template <typename Change>
    std::string refusal_after(const std::string& file, Change change) {
        const Json before = read_json(folder_ / file);
        Json json = before;
        change(json);
        write_json(folder_ / file, json);
        const std::string refusal = refusal_of([&] { read_served_study(folder_.path()); });
        write_json(folder_ / file, before);
        return refusal;
    }

    TemporaryFolder folder_;
};

TEST_F(FilesOfAStudy, DescribeWhatIsServed) {
    write_json(
        folder_ / "private/plan.json",
        {{"participants", 12}, {"completion", {{"url", "https://a"}, {"code", "C"}, {"failed_url", ""}}}});
    const ServedStudy study = read_served_study(folder_.path());
    EXPECT_EQ(study.pages.pages.size(), 5u);
    EXPECT_EQ(study.sheets.size(), 4u);
    EXPECT_EQ(study.sheets[1][0].page, 1u);
    EXPECT_EQ(study.sheets[1][0].order, (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(study.wanted, 12u);
    EXPECT_EQ(study.completion.code, "C");
    EXPECT_EQ(study.completion.failed_url, "");
    EXPECT_EQ(study.key.pages[4].kind, PageKind::check);
    EXPECT_EQ(study.pages.questions[0].reasons->unless, 3);
    EXPECT_EQ(study.pages.questions[1].labels.at(7), "very");
}

TEST_F(FilesOfAStudy, NeedNoPlan) {
    const ServedStudy study = read_served_study(folder_.path());
    EXPECT_FALSE(study.wanted);
    EXPECT_EQ(study.completion.url, "");
}

TEST_F(FilesOfAStudy, MustHoldEachVideo) {
    const ServedStudy study = read_served_study(folder_.path());
    const std::string video = study.pages.pages[2].videos[1];
    std::filesystem::remove(folder_ / "public" / video);
    EXPECT_THAT(refusal_of([&] { read_served_study(folder_.path()); }),
                AllOf(HasSubstr("public: 1 of "),
                      HasSubstr(format(" videos are missing, the first is {}; build the study again, or copy "
                                       "all of it",
                                       video))));
}

TEST_F(FilesOfAStudy, AreStepsPassByPass) {
    Json pages = read_json(folder_ / "public/pages.json");
    pages["pages"][0]["passes"] = {{{"sound", false}, {"questions", {0}}},
                                   {{"sound", true}, {"questions", {1}}}};
    write_json(folder_ / "public/pages.json", pages);
    const ServedStudy study = read_served_study(folder_.path());
    EXPECT_EQ(study.sheets[0].size(), 6u);
    EXPECT_EQ(study.sheets[0][1].page, 0u);
    EXPECT_EQ(study.sheets[0][1].pass, 1u);
}

TEST_F(FilesOfAStudy, AreRefusedWithTheKeyThatIsWrong) {
    const auto pages = [&](auto change) { return refusal_after("public/pages.json", change); };
    EXPECT_THAT(pages([](Json& json) { json["format"] = "chironomia pages 1"; }),
                HasSubstr("pages.json: format"));
    EXPECT_THAT(pages([](Json& json) { json["title"] = ""; }), HasSubstr("title: is empty"));
    EXPECT_THAT(pages([](Json& json) { json["title"] = 3; }), HasSubstr("title: is 3, a text is needed"));
    EXPECT_THAT(pages([](Json& json) { json["sound"] = 1; }), HasSubstr("sound: is 1, true or false"));
    EXPECT_THAT(pages([](Json& json) { json["layout"] = "wall"; }), HasSubstr("layout"));
    EXPECT_THAT(pages([](Json& json) { json["questions"][0]["kind"] = "guess"; }),
                HasSubstr("questions[0].kind"));
    EXPECT_THAT(pages([](Json& json) { json["questions"][1]["id"] = "realism"; }),
                HasSubstr("\"realism\" is already the id of questions[0]"));
    EXPECT_THAT(pages([](Json& json) { json["questionnaire"][0]["least"] = "x"; }),
                HasSubstr("a whole number from"));
    EXPECT_THAT(pages([](Json& json) { json["questionnaire"][0]["most"] = 1; }),
                HasSubstr("is 1, more than \"least\""));
    EXPECT_THAT(pages([](Json& json) { json["sheets"][0]["pages"][0][0] = 9; }),
                HasSubstr("sheets[0].pages[0][0]"));
    EXPECT_THAT(pages([](Json& json) { json["sheets"][0]["pages"][1] = json["sheets"][0]["pages"][0]; }),
                HasSubstr("stands twice"));
    EXPECT_THAT(pages([](Json& json) {
                    json["sheets"][0]["pages"][0][1] = {0, 0};
                }),
                HasSubstr("each video"));
}

TEST_F(FilesOfAStudy, MustFitTogether) {
    const auto key = [&](auto change) { return refusal_after("private/key.json", change); };
    EXPECT_THAT(key([](Json& json) { json["study"] = "other"; }), HasSubstr("the study is \"other\", but"));
    EXPECT_THAT(
        key([](Json& json) { json["questions"].erase(1); }),
        HasSubstr("its questions are not those of pages.json; the two files are of different builds"));
    EXPECT_THAT(key([](Json& json) { json["pages"].erase(0); }), HasSubstr("there are 4 pages, but 5"));
    EXPECT_THAT(key([](Json& json) { std::swap(json["pages"][0], json["pages"][1]); }),
                HasSubstr("page 0 is"));
    EXPECT_THAT(key([](Json& json) { json["pages"][0]["places"].erase(1); }),
                HasSubstr("has 1 places, but 2"));
    EXPECT_THAT(key([](Json& json) { json["pages"][4]["expected"] = 1; }), HasSubstr("an object is needed"));
    EXPECT_THAT(key([](Json& json) {
                    json["pages"][4]["expected"] = {{"other", 1}};
                }),
                HasSubstr("no question \"other\""));
    EXPECT_THAT(key([](Json& json) {
                    json["pages"][4]["expected"] = {{"realism", 9}};
                }),
                HasSubstr("9 is no answer"));
}

// Null stands for any value of a video.
TEST_F(FilesOfAStudy, MayExpectSomethingOfOneVideoOfSeveral) {
    const auto expect = [&](const Json& expected) {
        return refusal_after("private/key.json", [&](Json& json) {
            json["pages"][4]["expected"] = {{"human", expected}};
        });
    };
    const auto accept = [&](const Json& expected) {
        Json key = read_json(folder_ / "private/key.json");
        key["pages"][4]["expected"] = {{"human", expected}};
        write_json(folder_ / "private/key.json", key);
        read_served_study(folder_.path());
    };
    EXPECT_NO_THROW(accept({7, nullptr}));
    EXPECT_NO_THROW(accept({nullptr, 1}));
    EXPECT_THAT(expect({8, nullptr}), HasSubstr("human: [8,1] is no answer"));
    EXPECT_THAT(expect(Json::array({nullptr})), HasSubstr("for each of 2 videos"));
}

TEST_F(FilesOfAStudy, MayAskForANumberWithoutLimits) {
    Json pages = read_json(folder_ / "public/pages.json");
    pages["questionnaire"][0].erase("least");
    pages["questionnaire"][0].erase("most");
    write_json(folder_ / "public/pages.json", pages);
    EXPECT_EQ(fault_of_questionnaire(read_served_study(folder_.path()).pages, {{"age", -1e6}}), "");
}

TEST(Clock, WritesTimesInUtc) {
    EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00.000Z");
    EXPECT_EQ(utc_text(1'769'853'600'007), "2026-01-31T10:00:00.007Z");
    EXPECT_GT(unix_milliseconds(), 1'700'000'000'000);
    EXPECT_LE(steady_milliseconds(), steady_milliseconds());
}

TEST(Secrets, AreLongAndNeverTheSame) {
    const std::string one = draw_secret();
    EXPECT_EQ(one.size(), 32u);
    EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_NE(one, draw_secret());
}

TEST(Secrets, AreEqualOnlyAsAWhole) {
    EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
    EXPECT_TRUE(equal_in_constant_time("", ""));
    for (const char* other : {"abd", "ab", "abcd", "", "abcabc"}) {
        EXPECT_FALSE(equal_in_constant_time("abc", other)) << other;
        EXPECT_FALSE(equal_in_constant_time(other, "abc")) << other;
    }
}

}  // namespace
}  // namespace chironomia::study::server
