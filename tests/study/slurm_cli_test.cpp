// chironomia study build --slurm with a real Slurm of two nodes: what is lost, killed or submitted twice ends in the
// study that one machine builds, or in a message that says what is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <thread>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "study/record/study_folder.h"
#include "tests/study/process.h"
#include "tests/study/slurm_cluster.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::RunningChironomia;
using testing::SlurmCluster;
using testing::source_dir;
using testing::TemporaryFolder;

using Words = std::vector<std::string>;

// The sample plan with its four videos, large enough to take a second each.
class SlurmCli : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const std::string why = testing::why_no_slurm(); !why.empty()) GTEST_SKIP() << why;
        fs::copy(source_dir() / "assets/samples", folder_.path(), fs::copy_options::recursive);
        write_plan({320, 180}, 3);
        cluster_.emplace();
    }

    void write_plan(std::array<int, 2> size, double seconds) const {
        Json plan = read_json(source_dir() / "assets/samples/plan.json");
        plan["render"]["size"] = size;
        plan["render"]["fps"] = 10;
        for (Json& clip : plan["clips"]) clip["cut"] = {0, seconds};
        write_json(folder_ / "plan.json", plan);
    }

    Words words(const Words& more, const std::string& out = "study") const {
        Words all = {"study",  "build", (folder_ / "plan.json").string(), "--out", (folder_ / out).string(),
                     "--seed", "3"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Outcome build(const Words& more = {}, const std::string& out = "study") const {
        return run_chironomia(words(more, out));
    }

    std::map<std::string, std::string> files_of(const std::string& name) const {
        std::map<std::string, std::string> files;
        for (const std::string& file : list_files(folder_ / name))
            files[file] = read_text(folder_ / name / file);
        return files;
    }
    void expect_bytes_of_one_machine() const {
        ASSERT_EQ(build({}, "whole").exit_code, 0);
        EXPECT_EQ(files_of("study"), files_of("whole"));
    }

    // The tasks that run on one of the nodes, as soon as there are any.
    std::string wait_for_node_at_work() const {
        for (int i = 0; i < 6000; ++i) {
            for (const char* node : {"n1", "n2"}) {
                if (!cluster_->jobs_on(node).empty()) return node;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        ADD_FAILURE() << "no task ran";
        return "n1";
    }

    TemporaryFolder folder_;
    std::optional<SlurmCluster> cluster_;
};

TEST_F(SlurmCli, BuildsWhatOneMachineBuilds) {
    const Outcome built = build({"--slurm", "--array", "3", "--sbatch", "--partition=main --comment='a b'"});
    ASSERT_EQ(built.exit_code, 0) << built.err;
    EXPECT_THAT(built.err, HasSubstr("study: submitted job "));
    EXPECT_THAT(built.err, HasSubstr("of 4 videos; "));
    EXPECT_THAT(built.out, HasSubstr("yes  every video is what the key says"));
    EXPECT_THAT(built.out, HasSubstr("4 videos (4 recorded now)"));
    expect_bytes_of_one_machine();
    const Outcome again = build({"--slurm"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("4 videos (0 recorded now)"));
    EXPECT_THAT(again.err, ::testing::Not(HasSubstr("submitted")));
}

// Such as one whose check was killed, or has failed: the job of the check alone is submitted.
TEST_F(SlurmCli, ChecksAStudyUntilItPasses) {
    ASSERT_EQ(build().exit_code, 0);
    const auto time = fs::last_write_time(folder_ / "study/public");
    write_text(folder_ / "study/public/notes.txt", "expressive");
    for (int i = 0; i < 2; ++i) {
        const Outcome failed = build({"--slurm"});
        EXPECT_EQ(failed.exit_code, 1) << failed.err;
        EXPECT_THAT(failed.err, HasSubstr("study: submitted job "));
        EXPECT_THAT(failed.out, HasSubstr("notes.txt"));
    }
    fs::remove(folder_ / "study/public/notes.txt");
    fs::last_write_time(folder_ / "study/public", time);
    const Outcome passed = build({"--slurm"});
    EXPECT_EQ(passed.exit_code, 0) << passed.err;
    EXPECT_THAT(passed.out, HasSubstr("yes  every video is what the key says"));
}

TEST_F(SlurmCli, SubmitsOnlyWhatAKilledTaskLeft) {
    RunningChironomia first(words({"--slurm", "--array", "2"}));
    const std::vector<pid_t> tasks = cluster_->jobs_on(wait_for_node_at_work());
    ASSERT_FALSE(tasks.empty());
    ::kill(tasks.front(), SIGKILL);
    const Outcome failed = first.wait();
    EXPECT_EQ(failed.exit_code, 3) << failed.err;
    EXPECT_THAT(failed.err, HasSubstr("of 4 videos are missing, of the parts "));
    EXPECT_THAT(failed.err, ::testing::ContainsRegex("[12] tasks failed, see .*/study.slurm/"));
    EXPECT_THAT(failed.err, HasSubstr("the same command submits what is missing"));
    EXPECT_FALSE(fs::exists(folder_ / "study/public"));
    const Outcome again = build({"--slurm", "--array", "2"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("4 videos (2 recorded now)"));
    expect_bytes_of_one_machine();
}

// All videos are there, so the only job lays the study out.
TEST_F(SlurmCli, LaysOutAgainWhenTheJobThatLaysOutIsKilled) {
    ASSERT_EQ(build({"--shard", "1/1"}).exit_code, 0);
    RunningChironomia first(words({"--slurm"}));
    for (const pid_t process : cluster_->jobs_on(wait_for_node_at_work())) ::kill(process, SIGKILL);
    const Outcome failed = first.wait();
    EXPECT_EQ(failed.exit_code, 3) << failed.err << failed.out;
    EXPECT_THAT(failed.err, HasSubstr("all videos are there, but it was not laid out"));
    EXPECT_FALSE(fs::exists(folder_ / "study/public"));
    const Outcome again = build({"--slurm"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("4 videos (0 recorded now)"));
    expect_bytes_of_one_machine();
}

// Slurm gives the tasks of a dead node to the other one.
TEST_F(SlurmCli, OutlivesANode) {
    RunningChironomia building(words({"--slurm", "--array", "4"}));
    cluster_->kill_node(wait_for_node_at_work());
    const Outcome built = building.wait();
    ASSERT_EQ(built.exit_code, 0) << built.err;
    expect_bytes_of_one_machine();
}

TEST_F(SlurmCli, IsSubmittedTwiceAtOnce) {
    RunningChironomia first(words({"--slurm", "--array", "2"}));
    RunningChironomia second(words({"--slurm", "--array", "3"}));
    const Outcome one = first.wait(), other = second.wait();
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(other.exit_code, 0) << other.err;
    expect_bytes_of_one_machine();
}

TEST_F(SlurmCli, LeavesTheJobsToThemselvesAndComesBack) {
    RunningChironomia first(words({"--slurm", "--array", "2"}));
    EXPECT_THAT(first.wait_for_err("submitted job"), HasSubstr("submitted job"));
    const Outcome left = first.end(SIGINT);
    EXPECT_EQ(left.exit_code, 130);
    EXPECT_THAT(left.err, HasSubstr("the jobs go on. The same command comes back to them; scancel --name="));
    const Outcome back = build({"--slurm", "--array", "2"});
    ASSERT_EQ(back.exit_code, 0) << back.err;
    EXPECT_THAT(back.err, HasSubstr("study: goes on with job "));
    EXPECT_THAT(back.err, ::testing::Not(HasSubstr("submitted")));
    expect_bytes_of_one_machine();
}

// The shared folder is a file system of its own that takes some of the videos, then more.
TEST_F(SlurmCli, SaysWhatAFullDiskLeavesMissing) {
    const fs::path disk = folder_ / "disk";
    fs::create_directory(disk);
    if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=80k") != 0)
        GTEST_SKIP() << "only root can make a disk that is full";
    const Outcome full = build({"--slurm", "--array", "2"}, "disk/study");
    EXPECT_EQ(full.exit_code, 3) << full.err;
    EXPECT_THAT(full.err, HasSubstr(" of 4 videos are missing, of the parts "));
    EXPECT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=100m"), 0);
    const Outcome again = build({"--slurm", "--array", "2"}, "disk/study");
    EXPECT_EQ(again.exit_code, 0) << again.err;
    ASSERT_EQ(build({}, "study").exit_code, 0);
    EXPECT_EQ(files_of("disk/study"), files_of("study"));
    cluster_.reset();
    ::umount(disk.c_str());
}

TEST_F(SlurmCli, WritesTheScriptThatItWouldRun) {
    const fs::path script = folder_ / "submit.sh";
    const Outcome written = build({"--slurm-script", script.string(), "--array", "2", "--time", "0:10:00"});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_FALSE(fs::exists(folder_ / "study"));
    EXPECT_EQ(std::system(format("bash '{}' >'{}'", script.string(), (folder_ / "jobs").string()).c_str()),
              0);
    EXPECT_EQ(split_words(read_text(folder_ / "jobs")).size(), 2u);
    const Outcome followed = build({"--slurm"});
    EXPECT_EQ(followed.exit_code, 0) << followed.err;
    EXPECT_THAT(followed.err, HasSubstr("study: goes on with job "));
    expect_bytes_of_one_machine();
}

TEST_F(SlurmCli, PassesOnWhatSlurmRefuses) {
    const Outcome refused = build({"--slurm", "--sbatch", "--partition=none"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("invalid partition specified: none"));
    EXPECT_THAT(refused.err, HasSubstr("sbatch: refuses a job (exit code 1; its message stands above); mend "
                                       "--array, --time or --sbatch"));
}

}  // namespace
}  // namespace chironomia::study
