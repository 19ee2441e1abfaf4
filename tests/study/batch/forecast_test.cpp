#include "study/batch/forecast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/fake_maker.h"
#include "tests/study/sample_plan.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::FakeMaker;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

// A renderer whose videos take 1000 bytes and 50 for each frame.
ClipMaker sized_maker() {
    ClipMaker maker = FakeMaker{}.maker();
    maker.record = [](const ClipJob& job) {
        const std::size_t frames = *job.frames.last - job.frames.first;
        write_text(job.out, std::string(1000 + 50 * frames, '.'));
        return ClipResult{.frames = frames, .seconds = 1, .warnings = {}, .report = {}};
    };
    return maker;
}

// Four videos of 2 s at 30 frames a second.
class ForecastBuild : public ::testing::Test {
  protected:
    ForecastBuild() {
        testing::write_sample_inputs(folder_.path());
        write_json(folder_ / "plan.json", testing::sample_plan());
    }
    BuildOptions options() const { return {.out = folder_ / "study", .seed = 7, .quiet = true}; }
    Plan plan() const { return read_plan(folder_ / "plan.json"); }

    TemporaryFolder folder_;
};

TEST_F(ForecastBuild, ScalesAFewFramesToAllThatIsMissing) {
    const Forecast forecast = forecast_build(plan(), options(), sized_maker());
    EXPECT_EQ(forecast.videos, 4u);
    EXPECT_EQ(forecast.missing, 4u);
    EXPECT_EQ(forecast.frames, 240u);
    EXPECT_DOUBLE_EQ(forecast.bytes, 4 * 1050 + 240 * 50);
    EXPECT_EQ(forecast.measured_videos, 4u);
    EXPECT_EQ(forecast.measured_frames, 4 * 31u);
    EXPECT_GE(forecast.cpu_seconds, 0);
    EXPECT_FALSE(fs::exists(folder_ / "study"));
}

// Such as a reference that is shown on many pages.
TEST_F(ForecastBuild, CountsTheDiskOfAVideoWhereverItIsShown) {
    Json json = testing::sample_plan();
    Json again = json["clips"][0];
    again["id"] = "again";
    json["clips"].push_back(again);
    write_json(folder_ / "plan.json", json);
    const Forecast forecast = forecast_build(plan(), options(), sized_maker());
    EXPECT_EQ(forecast.videos, 4u);
    EXPECT_DOUBLE_EQ(forecast.distinct_bytes, 4 * 1050 + 240 * 50);
    EXPECT_DOUBLE_EQ(forecast.bytes, 6 * 1050 + 360 * 50);
}

TEST_F(ForecastBuild, CountsOnlyWhatIsMissing) {
    build_shard(plan(), {.number = 1, .count = 4}, options(), FakeMaker{}.maker());
    const Forecast forecast = forecast_build(plan(), options(), sized_maker());
    EXPECT_EQ(forecast.missing, 3u);
    EXPECT_EQ(forecast.frames, 180u);
    build_study(plan(), options(), FakeMaker{}.maker());
    EXPECT_EQ(to_text(forecast_build(plan(), options(), sized_maker())),
              "videos        4, 0 of them to be rendered\n");
}

TEST(Forecast, AsksForTasksOfHalfAnHour) {
    Forecast forecast{.videos = 3000, .missing = 3000, .frames = 966000, .size = {1440, 1080}};
    forecast.cpu_seconds = 100 * 3600;
    forecast.draft_seconds = 60;
    forecast.peak_mb = 300;
    forecast.distinct_bytes = 1.5e9;
    forecast.bytes = 2.5e9;
    const SlurmArray array = array_for(forecast);
    EXPECT_EQ(array.tasks, 200u);
    EXPECT_EQ(array.minutes, 62u);  // twice a minute and half an hour
    EXPECT_EQ(array.megabytes, 500u);
    const std::string text = to_text(forecast);
    EXPECT_THAT(text, HasSubstr("966000 of 1440x1080"));
    EXPECT_THAT(text, HasSubstr("100.00 hours of one core"));
    EXPECT_THAT(text, HasSubstr("2.5 GB at the end; 4.0 GB while it is laid out"));
    EXPECT_THAT(text, HasSubstr("--slurm --array 200 --time 1:02:00 --sbatch \"--mem=500M\""));
}

// Each video that is recorded beside others has a process of its own.
TEST(Forecast, AsksForTheMemoryOfAllProcessesOfATask) {
    Forecast forecast{.videos = 3000, .missing = 3000, .jobs = 8};
    forecast.cpu_seconds = 100 * 3600;
    forecast.peak_mb = 300;
    EXPECT_EQ(array_for(forecast).megabytes, 2600u);
    EXPECT_EQ(array_for(forecast).tasks, 25u);
    EXPECT_THAT(to_text(forecast),
                HasSubstr("--slurm --array 25 --jobs 8 --time 1:00:00 --sbatch \"--mem=2600M\""));
}

TEST(Forecast, AsksForNoMoreTasksThanVideosOrThanSlurmTakes) {
    Forecast forecast{.videos = 5, .missing = 5};
    forecast.cpu_seconds = 1e6;
    EXPECT_EQ(array_for(forecast).tasks, 5u);
    forecast.missing = 100000;
    forecast.cpu_seconds = 1e9;
    EXPECT_EQ(array_for(forecast).tasks, 1000u);
    forecast.cpu_seconds = 1;
    EXPECT_EQ(array_for(forecast).tasks, 1u);
    EXPECT_EQ(array_for(forecast).minutes, 10u);
}

}  // namespace
}  // namespace chironomia::study
