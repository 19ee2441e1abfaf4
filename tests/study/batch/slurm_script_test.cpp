#include "study/batch/slurm_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/batch/slurm_queue.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SlurmScript, ListsNumbersAsRanges) {
    EXPECT_EQ(ranges_of({1, 2, 3, 4}), "1-4");
    EXPECT_EQ(ranges_of({1, 3, 4, 7}), "1,3-4,7");
    EXPECT_EQ(ranges_of({5}), "5");
}

TEST(SlurmScript, QuotesWordsForAShell) {
    EXPECT_EQ(quoted_for_shell("a b"), "'a b'");
    EXPECT_EQ(quoted_for_shell("it's $HOME"), "'it'\\''s $HOME'");
}

TEST(SlurmScript, SubmitsAnArrayAndAJobThatWaitsForIt) {
    SlurmScript script{.job_name = "chironomia-1",
                       .program = "/opt/it's/chironomia",
                       .build = {"study", "build", "/data/plan.json"},
                       .study = "/data/study",
                       .logs = "/data/study.slurm",
                       .parts = 9,
                       .wanted = {2, 3, 8},
                       .cores = 2,
                       .time = "1:00:00",
                       .more = "--mem=2G"};
    const std::string text = to_text(script);
    EXPECT_THAT(text, HasSubstr("--array=2-3,8 "));
    EXPECT_THAT(text, HasSubstr("--cpus-per-task=2 --time='1:00:00'"));
    EXPECT_THAT(text, HasSubstr("--mem=2G"));
    EXPECT_THAT(text, HasSubstr("exec '/opt/it'\\''s/chironomia' 'study' 'build' '/data/plan.json' --shard "
                                "\"$SLURM_ARRAY_TASK_ID/9\"\n"));
    EXPECT_THAT(text, HasSubstr("--dependency=\"afterok:${parts%%;*}\" --kill-on-invalid-dep=yes"));
    script.wanted.clear();
    EXPECT_THAT(to_text(script), Not(HasSubstr("--array")));
    EXPECT_THAT(to_text(script), Not(HasSubstr("--dependency")));
}

TEST(SlurmQueue, CountsTasksByTheirStates) {
    const SlurmTasks tasks = read_squeue(
        "7 RUNNING\n7 PENDING\n7 COMPLETED\n7 FAILED\n7 NODE_FAIL\n8 PENDING\n5 FAILED\n7 COMPLETING\n",
        {"7", "8"});
    EXPECT_EQ(tasks.running, 2u);
    EXPECT_EQ(tasks.waiting, 2u);
    EXPECT_EQ(tasks.failed, 2u);  // those of job 5 were counted by an earlier command
    EXPECT_THAT(tasks.active, ElementsAre("7", "8"));
    EXPECT_FALSE(tasks.is_over());
    EXPECT_TRUE(read_squeue("7 FAILED\n", {}).is_over());
}

}  // namespace
}  // namespace chironomia
