#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/exports/exported_sample.h"
#include "tests/study/process.h"

namespace chironomia::study {
namespace {

using testing::ExportedSample;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;

Outcome export_as(const ExportedSample& sample, const std::string& form) {
    return run_chironomia(
        {"study", "export", sample.study().string(), "--as", form, "--out", sample.out().string()});
}

TEST(ExportCli, WritesAFolderAndSaysWhatIsLeftToDo) {
    const ExportedSample sample({});
    const Outcome outcome = export_as(sample, "jspsych");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("4 sheets, 10 videos; private/ is not for the web"));
    EXPECT_THAT(outcome.err, HasSubstr("note: put the files of jsPsych"));
    EXPECT_TRUE(std::filesystem::exists(sample.open("index.html")));
}

TEST(ExportCli, SaysWhyItCannot) {
    const ExportedSample sample({});
    const Outcome outcome = export_as(sample, "webmushra");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("webmushra cannot express this study: layout \"pair\""));
    EXPECT_EQ(export_as(sample, "powerpoint").exit_code, 2);
    EXPECT_THAT(export_as(sample, "powerpoint").err,
                HasSubstr("none of hemvip, hemvip2, jspsych, qualtrics, webmushra"));
}

}  // namespace
}  // namespace chironomia::study
