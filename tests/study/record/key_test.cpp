#include "study/record/key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/study/analysis/sample_study.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::SampleStudy;
using testing::TemporaryFolder;
using testing::write_sample_study;

// The message about a key that `change` damaged.
std::string refusal_of_key(const std::function<void(Json&)>& change) {
    const TemporaryFolder folder;
    write_sample_study({}, folder.path());
    const std::filesystem::path file = folder / "private/key.json";
    Json key = read_json(file);
    change(key);
    write_json(file, key);
    return refusal_of([&] { read_study_key(file); });
}

TEST(ReadStudyKey, ReadsWhatTheStudyWas) {
    const TemporaryFolder folder;
    SampleStudy study;
    study.conditions.push_back(
        {{"name", "ours, mismatched"}, {"from", "ours"}, {"made", "mismatched speech"}});
    study.exclusions["fastest_seconds"] = 3.5;
    write_sample_study(study, folder.path());
    const StudyKey key = read_study_key(folder / "private/key.json");
    EXPECT_EQ(key.study, "3f0c9a5b1e2d4c68");
    EXPECT_EQ(key.seed, 7u);
    EXPECT_EQ(key.layout, Layout::pair);
    ASSERT_EQ(key.conditions.size(), 3u);
    EXPECT_EQ(key.conditions[2].from, 0u);
    EXPECT_EQ(key.conditions[2].made, "mismatched speech");
    EXPECT_FALSE(key.conditions[0].from);
    EXPECT_EQ(key.exclusions.failed_checks, 1u);
    EXPECT_EQ(key.exclusions.lenient_failed_checks, 2u);
    EXPECT_EQ(key.exclusions.fastest_seconds, 3.5);
    ASSERT_EQ(key.pages.size(), 8u);
    EXPECT_EQ(key.pages[7].kind, PageKind::check);
    EXPECT_EQ(key.pages[7].expected["realism"], 4);
    EXPECT_EQ(key.pages[1].clip, "c2");
    EXPECT_EQ(key.pages[1].places[1].condition, 1u);
}

TEST(ReadStudyKey, SaysWhatIsWrong) {
    EXPECT_THAT(
        refusal_of_key([](Json& key) { key["format"] = "chironomia key 1"; }),
        HasSubstr("format: is \"chironomia key 1\", \"chironomia key 2\" is needed; build the study again"));
    EXPECT_THAT(refusal_of_key([](Json& key) { key["pages"][0]["right"] = 5; }),
                HasSubstr("pages[0].right: is 5, an object"));
    EXPECT_THAT(refusal_of_key([](Json& key) {
                    key["pages"][0]["right"] = {{"realism", 5}};
                }),
                HasSubstr("pages[0].right.realism: is 5, a text in quotes is needed"));
    EXPECT_THAT(refusal_of_key([](Json& key) { key["seed"] = "x"; }),
                HasSubstr("seed: is \"x\", a whole number is needed"));
    EXPECT_THAT(refusal_of_key([](Json& key) { key["pages"][0]["places"][0]["condition"] = "our"; }),
                HasSubstr("did you mean \"ours\"?"));
    EXPECT_THAT(refusal_of_key([](Json& key) { key["pages"][6]["expected"] = nullptr; }),
                HasSubstr("is null, but the page is a check; say which answer it expects"));
    EXPECT_THAT(refusal_of_key([](Json& key) { key["exclusions"]["fastest_seconds"] = "x"; }),
                HasSubstr("is \"x\", a number of seconds is needed"));
    EXPECT_THAT(refusal_of_key([](Json& key) {
                    key["scales"] = {{{"id", "s"}, {"items", {"realism", "realism"}}}};
                }),
                HasSubstr("key.json: scales[0].items[0]: is \"realism\", which is no rating and no slider"));
    EXPECT_THAT(refusal_of_key([](Json& key) { key.erase("conditions"); }),
                HasSubstr("conditions: is missing"));
}

}  // namespace
}  // namespace chironomia::study
