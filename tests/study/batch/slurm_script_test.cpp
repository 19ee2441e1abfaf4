#include "study/batch/slurm_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "study/batch/slurm_queue.h"
#include "tests/support/support.h"

namespace chironomia::study {
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

// sbatch takes %a for the number of a task, in folders too.
TEST(SlurmScript, KeepsPercentSignsOfFolders) {
    const std::string text = to_text({.job_name = "chironomia-1",
                                      .program = "/opt/chironomia",
                                      .build = {"study", "build"},
                                      .study = "/data/50%a",
                                      .logs = "/data/50%a.slurm",
                                      .parts = 2,
                                      .wanted = {1, 2}});
    EXPECT_THAT(text, HasSubstr("mkdir -p '/data/50%a.slurm'"));
    EXPECT_THAT(text, HasSubstr("--output='/data/50%%a.slurm/part-%a.log'"));
    EXPECT_THAT(text, HasSubstr("--output='/data/50%%a.slurm/layout.log'"));
}

TEST(SlurmQueue, SaysWhereThereIsNoSlurm) {
    const std::string before = std::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    const std::string no_slurm = testing::refusal_of([] { require_slurm(); });
    const std::string silent = testing::refusal_of([] { ask_slurm("x"); });
    ::setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(no_slurm,
              "sbatch: there is no Slurm on this machine; run this where jobs are submitted, or write the "
              "script with --slurm-script FILE");
    EXPECT_EQ(
        silent,
        "squeue: does not answer (exit code 127); jobs that were submitted go on: run the same command again later");
}

TEST(SlurmQueue, CountsTasksByTheirStates) {
    const SlurmTasks tasks = read_squeue(
        "7 7_1 RUNNING\n7 7_2 PENDING\n7 7_3 COMPLETED\n7 7_4 FAILED\n7 7_5 NODE_FAIL\n8 8 PENDING\n"
        "5 5_1 FAILED\n7 7_6 COMPLETING\n");
    EXPECT_EQ(tasks.running, 2u);
    EXPECT_EQ(tasks.waiting, 2u);
    EXPECT_THAT(tasks.failed, ElementsAre("5_1", "7_4", "7_5"));
    EXPECT_THAT(tasks.active, ElementsAre("7", "8"));
    EXPECT_FALSE(tasks.is_over());
    EXPECT_TRUE(read_squeue("7 7_1 FAILED\n").is_over());
}

// Slurm forgets tasks some minutes after they have ended, and starts those of a lost node again.
TEST(SlurmQueue, RemembersTheTasksThatFailed) {
    FailedTasks failed({"7", "8"});
    failed.add(read_squeue("7 7_1 FAILED\n7 7_2 NODE_FAIL\n7 7_3 RUNNING\n5 5_1 FAILED\n"));
    EXPECT_EQ(failed.count(), 2u);  // those of job 5 were of an earlier command
    failed.add(read_squeue("7 7_3 RUNNING\n"));
    EXPECT_EQ(failed.count(), 2u);
    failed.add(read_squeue("7 7_2 RUNNING\n7 7_3 TIMEOUT\n"));
    EXPECT_EQ(failed.count(), 2u);
    failed.add(read_squeue("8 8 CANCELLED\n"));
    EXPECT_EQ(failed.count(), 3u);
}

}  // namespace
}  // namespace chironomia::study
