// Broken keypoints through the real binary: each is refused with a clear message, or repaired within bounds
// and reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

constexpr int kFrames = 60;

// A folder of OpenPose, two seconds of a real gesture, to be broken.
class BrokenOpenPose : public ::testing::Test {
  protected:
    void SetUp() override {
        const std::string motion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();
        const Outcome made = run_chironomia({"convert", "--motion", motion, "--out", clip().string()});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        for (int t = kFrames; fs::exists(file(t)); ++t) fs::remove(file(t));
    }

    fs::path clip() const { return folder_ / "clip"; }
    fs::path file(int t) const { return clip() / format("clip_{:012}_keypoints.json", t); }

    void change(int t, const std::function<void(Json& people)>& change) const {
        Json json = read_json(file(t));
        change(json["people"]);
        write_json(file(t), json);
    }
    // Point k of the body becomes 0 0 0.
    static void hide(Json& people, size_t k) {
        for (size_t i = 0; i < 3; ++i) people[0]["pose_keypoints_2d"][3 * k + i] = 0;
    }

    // Onto an avatar, with its report.
    Outcome fit() const {
        return run_chironomia({"convert", "--motion", clip().string(), "--motion-fps", "30", "--report",
                               (folder_ / "report.json").string(), "--out", (folder_ / "a.bvh").string()});
    }
    std::string info() const {
        const Outcome described = run_chironomia({"info", clip().string(), "--motion-fps", "30"});
        EXPECT_EQ(described.exit_code, 0) << described.err;
        return described.out;
    }
    // All points as they were read.
    std::string table() const {
        const fs::path out = folder_ / "table.csv";
        EXPECT_EQ(run_chironomia(
                      {"convert", "--motion", clip().string(), "--motion-fps", "30", "--out", out.string()})
                      .exit_code,
                  0);
        return read_text(out);
    }
    std::string refusal() const {
        const Outcome outcome = fit();
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        EXPECT_FALSE(fs::exists(folder_ / "a.bvh"));
        return outcome.err;
    }
    void expect_fitted() const {
        const Outcome outcome = fit();
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const Outcome described = run_chironomia({"info", (folder_ / "a.bvh").string()});
        EXPECT_THAT(described.out, HasSubstr(format("{} frames at 30 frames/s", kFrames)));
        EXPECT_THAT(read_text(folder_ / "a.bvh"), Not(HasSubstr("nan")));
    }

    TemporaryFolder folder_;
};

TEST_F(BrokenOpenPose, ATruncatedFileIsRefused) {
    const std::string text = read_text(file(20));
    write_text(file(20), text.substr(0, text.size() / 2));
    EXPECT_THAT(refusal(), AllOf(HasSubstr("clip_000000000020_keypoints.json:"), HasSubstr("no valid JSON")));
    write_text(file(20), "");
    EXPECT_THAT(refusal(), HasSubstr("clip_000000000020_keypoints.json"));
}

TEST_F(BrokenOpenPose, AFrameMissingInTheMiddleIsBridgedAndReported) {
    fs::remove(file(20));
    EXPECT_THAT(info(), HasSubstr("1 frames have no file"));
    expect_fitted();
    const Json report = read_json(folder_ / "report.json");
    EXPECT_THAT(report.dump(), HasSubstr("left_wrist: 1 frames"));
}

// A second person walks past from right to left, and is now first and now last in the list.
TEST_F(BrokenOpenPose, TwoPeopleWhoSwapPlacesAreDistinguished) {
    const std::string alone = table();
    for (int t = 0; t < kFrames; ++t) {
        change(t, [t](Json& people) {
            Json other = people[0];
            for (const char* part :
                 {"pose_keypoints_2d", "hand_left_keypoints_2d", "hand_right_keypoints_2d"}) {
                for (size_t i = 0; i < other[part].size(); i += 3)
                    if (other[part][i] != 0) other[part][i] = other[part][i].get<double>() + 600 - 12 * t;
            }
            people.insert(t % 2 ? people.begin() : people.end(), other);
        });
    }
    EXPECT_THAT(info(), HasSubstr("several people in 60 frames; followed one by place, "));
    EXPECT_THAT(info(), Not(HasSubstr(" 0 choices were close")));
    EXPECT_EQ(table(), alone);
}

TEST_F(BrokenOpenPose, ArmsThatAreNeverSeenRest) {
    for (int t = 0; t < kFrames; ++t) {
        change(t, [](Json& people) {
            for (const size_t k : {3, 4, 6, 7}) hide(people, k);
            people[0]["hand_left_keypoints_2d"] = Json::array();
            people[0]["hand_right_keypoints_2d"] = Json::array();
        });
    }
    EXPECT_THAT(info(), HasSubstr("rarely seen"));
    expect_fitted();
    EXPECT_THAT(read_json(folder_ / "report.json").dump(),
                HasSubstr("left_lower_arm"));  // among what is held
}

TEST_F(BrokenOpenPose, APersonWithoutAnyPointIsRefused) {
    for (int t = 0; t < kFrames; ++t) {
        change(t, [](Json& people) {
            for (const char* part :
                 {"pose_keypoints_2d", "hand_left_keypoints_2d", "hand_right_keypoints_2d"})
                for (Json& number : people[0][part]) number = 0;
        });
    }
    EXPECT_THAT(refusal(), HasSubstr("nobody is seen in any of its 60 frames"));
}

TEST_F(BrokenOpenPose, NumbersThatAreNoneAreRefused) {
    change(5, [](Json& people) { people[0]["pose_keypoints_2d"][6] = nullptr; });
    EXPECT_THAT(refusal(),
                HasSubstr("clip_000000000005_keypoints.json: pose_keypoints_2d: number 6 is null"));
    std::string text = read_text(file(5));
    text.replace(text.find("null"), 4, "NaN");
    write_text(file(5), text);
    EXPECT_THAT(refusal(),
                HasSubstr("clip_000000000005_keypoints.json: pose_keypoints_2d: number 6 is null"));
    for (int i = 7; i < 9; ++i)
        change(5, [&](Json& people) { people[0]["pose_keypoints_2d"][size_t(i)] = nullptr; });
    expect_fitted();
}

TEST_F(BrokenOpenPose, AnotherNumberOfPointsIsRefused) {
    change(5, [](Json& people) { people[0]["pose_keypoints_2d"].erase(0); });
    EXPECT_THAT(refusal(), HasSubstr("pose_keypoints_2d has 74 numbers, 75 are expected"));
    change(5, [](Json& people) { people[0]["hand_left_keypoints_2d"] = {1, 2, 3}; });
    change(5, [](Json& people) {
        people[0]["pose_keypoints_2d"].insert(people[0]["pose_keypoints_2d"].begin(), 1);
    });
    EXPECT_THAT(refusal(), HasSubstr("hand_left_keypoints_2d has 3 numbers, 63 are expected"));
}

TEST(BrokenHdf5, WithoutAPoseIsRefused) {
    const TemporaryFolder folder;
    const auto outcome_of = [&](const std::string& name) {
        return run_chironomia({"convert", "--motion",
                               (source_dir() / "tests/fixtures/motion" / name).string(), "--out",
                               (folder / "a.bvh").string()});
    };
    const Outcome none = outcome_of("pats_no_pose.h5");
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_THAT(none.err,
                AllOf(HasSubstr("it holds /audio"), HasSubstr("/pose/data or /pose/normalize of PATS")));
    const Outcome nan = outcome_of("pats_nan.h5");
    EXPECT_EQ(nan.exit_code, 3);
    EXPECT_THAT(nan.err, HasSubstr("frame 0, point \"Neck\": the place (nan, nan, 0) is no place"));
    // A body of 11 points is lifted and fitted.
    EXPECT_EQ(outcome_of("pats_models.h5").exit_code, 0);
}

}  // namespace
}  // namespace chironomia::study
