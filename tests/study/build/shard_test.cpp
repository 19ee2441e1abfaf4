// Parts of a study that several processes record, as several machines with one folder do.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>

#include "study/build/build.h"
#include "study/record/study_folder.h"
#include "tests/study/fake_maker.h"
#include "tests/study/limits.h"
#include "tests/study/sample_plan.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::FakeMaker;
using ::testing::HasSubstr;
using testing::LowLimit;
using testing::refusal_of;
using testing::TemporaryFolder;

// The sample plan with its four videos, and studies of it with a fake renderer.
class BuildShard : public ::testing::Test {
  protected:
    BuildShard() {
        testing::write_sample_inputs(folder_.path());
        write_json(folder_ / "plan.json", testing::sample_plan());
    }

    BuildOptions options(const std::string& name, std::uint64_t seed) const {
        return {.out = folder_ / name, .seed = seed, .quiet = true};
    }
    BuildSummary build(const std::string& name = "study", std::uint64_t seed = 7) const {
        return build_study(read_plan(folder_ / "plan.json"), options(name, seed), fake_.maker());
    }
    ShardSummary record(const Shard& shard, const std::string& name = "study", std::uint64_t seed = 7) const {
        return build_shard(read_plan(folder_ / "plan.json"), shard, options(name, seed), fake_.maker());
    }

    std::map<std::string, std::string> files_of(const std::string& name) const {
        std::map<std::string, std::string> files;
        for (const std::string& file : list_files(folder_ / name))
            files[file] = read_text(folder_ / name / file);
        return files;
    }

    bool has_work() const { return fs::exists(folder_ / "study/private/work"); }

    TemporaryFolder folder_;
    FakeMaker fake_;
};

// Does something in a process of its own, and says whether it threw nothing.
class Elsewhere {
  public:
    template <typename Work>
    explicit Elsewhere(Work work) : child_(::fork()) {
        if (child_ != 0) return;
        try {
            work();
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
            ::_exit(1);
        }
        ::_exit(0);
    }
    bool ends_well() const {
        int status = 0;
        ::waitpid(child_, &status, 0);
        return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }

  private:
    pid_t child_;
};

TEST_F(BuildShard, MakesTheBytesOfOneMachineInAnyOrder) {
    build("whole");
    std::size_t recorded = 0;
    for (const std::size_t number : {3, 1, 2}) {
        const ShardSummary summary = record({.number = number, .count = 3});
        EXPECT_EQ(summary.videos, number == 1 ? 2u : 1u);
        EXPECT_EQ(summary.recorded, summary.videos);
        EXPECT_FALSE(fs::exists(folder_ / "study/public"));
        recorded += summary.recorded;
    }
    EXPECT_EQ(recorded, 4u);
    EXPECT_EQ(build().recorded, 0u);
    EXPECT_EQ(files_of("study"), files_of("whole"));
}

// The motions of c1 are of different lengths: the shorter one holds its last pose.
TEST_F(BuildShard, GivesTheWarningsOfOneMachineTogether) {
    fake_.lengths = {{"base/c1.bvh", 1.5}};
    const std::vector<std::string> all = build("whole").warnings;
    EXPECT_THAT(all, ::testing::ElementsAre("clip \"c1\", baseline: the last pose is held for a while"));
    std::vector<std::string> of_parts;
    for (const std::size_t number : {1, 2, 3, 4}) {
        const std::vector<std::string> more = record({.number = number, .count = 4}).warnings;
        of_parts.insert(of_parts.end(), more.begin(), more.end());
    }
    EXPECT_EQ(of_parts, all);
    EXPECT_EQ(build().warnings, all);
    EXPECT_EQ(files_of("study"), files_of("whole"));
    const StudyDraft draft = draft_study(read_plan(folder_ / "plan.json"), 7, fake_.maker());
    EXPECT_EQ(warnings_of_finished(draft, folder_ / "study"), all);
}

// A motion that was copied under the name of another one.
TEST_F(BuildShard, WarnsOfVideosThatNobodyCanTellApart) {
    fs::copy_file(folder_ / "ours/c1.bvh", folder_ / "base/c1.bvh", fs::copy_options::overwrite_existing);
    const std::vector<std::string> all = build().warnings;
    ASSERT_EQ(all.size(), 1u);
    EXPECT_THAT(all[0],
                ::testing::MatchesRegex("clip \"c1\": the videos of (ours and of baseline|baseline and of "
                                        "ours) are the same, byte for byte"));
    const StudyDraft draft = draft_study(read_plan(folder_ / "plan.json"), 7, fake_.maker());
    EXPECT_EQ(warnings_of_finished(draft, folder_ / "study"), all);
}

TEST_F(BuildShard, RecordsNothingTwice) {
    record({.number = 1, .count = 2});
    EXPECT_EQ(record({.number = 1, .count = 2}).recorded, 0u);
    EXPECT_EQ(record({.number = 1, .count = 1}).recorded, 2u);
    EXPECT_EQ(record({.number = 4, .count = 9}).videos, 1u);
    EXPECT_EQ(record({.number = 5, .count = 9}).videos, 0u);
    EXPECT_EQ(*fake_.recorded, 4);
}

TEST_F(BuildShard, LeavesTheRestToTheBuild) {
    build("whole");
    record({.number = 2, .count = 4});
    EXPECT_EQ(build().recorded, 3u);
    EXPECT_EQ(files_of("study"), files_of("whole"));
}

TEST_F(BuildShard, AddsNothingToAFinishedStudy) {
    build();
    const auto before = files_of("study");
    EXPECT_EQ(record({.number = 1, .count = 2}).recorded, 0u);
    EXPECT_EQ(files_of("study"), before);
    EXPECT_EQ(
        refusal_of([&] { record({.number = 1, .count = 2}, "study", 8); }),
        (folder_ / "study").string() +
            ": holds a finished study of another seed, plan, input or program; name a new folder, or give "
            "--replace");
}

// Two submissions of the same array.
TEST_F(BuildShard, IsRecordedByTwoProcessesAtOnce) {
    build("whole");
    for (int round = 0; round < 5; ++round) {
        const Elsewhere first([&] { record({}); }), second([&] { record({}); });
        EXPECT_TRUE(first.ends_well());
        EXPECT_TRUE(second.ends_well());
        EXPECT_EQ(build().recorded, 0u);
        EXPECT_EQ(files_of("study"), files_of("whole"));
        fs::remove_all(folder_ / "study");
    }
}

// While a part is recorded the study is built, which takes the recordings away.
TEST_F(BuildShard, EndsWellWhereTheStudyIsFinishedMeanwhile) {
    build("whole");
    fake_.before = [this, first = true](const ClipJob&) mutable {
        if (!std::exchange(first, false)) return;
        FakeMaker other;
        const Elsewhere built(
            [&] { build_study(read_plan(folder_ / "plan.json"), options("study", 7), other.maker()); });
        EXPECT_TRUE(built.ends_well());
    };
    record({.number = 1, .count = 2});
    EXPECT_FALSE(has_work());
    EXPECT_EQ(files_of("study"), files_of("whole"));
}

// The same of a build that has no lock, as on a file system without any.
TEST_F(BuildShard, EndsWellWhereAnotherMachineLaysTheStudyOut) {
    build("whole");
    fake_.before = [this, first = true](const ClipJob&) mutable {
        if (!std::exchange(first, false)) return;
        build_study(read_plan(folder_ / "plan.json"), options("other", 7), FakeMaker{}.maker());
        fs::rename(folder_ / "other/public", folder_ / "study/public");
        for (const std::string& name : list_files(folder_ / "other/private"))
            fs::rename(folder_ / "other/private" / name, folder_ / "study/private" / name);
        fs::remove_all(folder_ / "study/private/work");
    };
    EXPECT_EQ(build().videos, 4u);
    EXPECT_FALSE(has_work());
    EXPECT_EQ(files_of("study"), files_of("whole"));
}

TEST_F(BuildShard, LocksNothing) {
    fs::create_directories(folder_ / "study/private");
    const int other = ::open((folder_ / "study/private").c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
    EXPECT_EQ(record({}).recorded, 4u);
    ::close(other);
    EXPECT_EQ(build().recorded, 0u);
}

TEST_F(BuildShard, LeavesNothingHalfWrittenOnAFullDisk) {
    build("whole");
    {
        const LowLimit disk(RLIMIT_FSIZE, 40);
        EXPECT_THAT(refusal_of([&] { record({}); }), HasSubstr("check free space and permissions"));
    }
    EXPECT_THAT(list_files(folder_ / "study"), ::testing::IsEmpty());
    EXPECT_EQ(record({}).recorded, 4u);
    build();
    EXPECT_EQ(files_of("study"), files_of("whole"));
}

}  // namespace
}  // namespace chironomia::study
