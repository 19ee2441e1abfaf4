#include "study/check/prediction.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace chironomia::study {
namespace {

// Clips with a video of each of three conditions. The second trait grows by `effect` from condition to condition; all
// else is chance.
std::vector<VideoTraits> videos_with(std::size_t clips, double effect) {
    Random random(4);
    std::vector<VideoTraits> videos;
    for (std::size_t clip = 0; clip < clips; ++clip) {
        for (std::size_t condition = 0; condition < 3; ++condition) {
            videos.push_back(
                {.clip = clip,
                 .condition = condition,
                 .traits = {random.uniform(), random.uniform() + effect * static_cast<double>(condition),
                            100.0 * static_cast<double>(clip)}});
        }
    }
    return videos;
}

const std::vector<std::string> kNames = {"name", "size", "clip"};

TEST(PredictConditions, FindsTheTraitThatPredicts) {
    const Prediction found = predict_conditions(videos_with(12, 2), kNames, 999, 1);
    EXPECT_EQ(found.trait, "size");
    EXPECT_EQ(found.hit_rate, 1);
    EXPECT_EQ(found.p, 0.001);
    EXPECT_EQ(found.videos, 36u);
}

TEST(PredictConditions, FindsATraitThatPredictsOneConditionInTheMiddle) {
    std::vector<VideoTraits> videos = videos_with(12, 0);
    for (VideoTraits& video : videos)
        video.traits[0] = video.condition == 1 ? 5 : video.condition == 0 ? 1 : 9;
    EXPECT_EQ(predict_conditions(videos, kNames, 999, 1).trait, "name");
    EXPECT_EQ(predict_conditions(videos, kNames, 999, 1).hit_rate, 1);
}

TEST(PredictConditions, IsAtChanceWhereNothingPredicts) {
    const Prediction found = predict_conditions(videos_with(20, 0), kNames, 999, 1);
    EXPECT_GT(found.p, 0.05);
    EXPECT_NEAR(found.chance, 0.42, 0.06);  // the best of four tries to guess one of three
}

// Under no leak p is uniform: a permutation test keeps its level.
TEST(PredictConditions, RaisesNoMoreFalseAlarmsThanItSays) {
    Random random(9);
    int alarms = 0;
    for (int study = 0; study < 200; ++study) {
        std::vector<VideoTraits> videos = videos_with(6, 0);
        for (VideoTraits& video : videos)
            video.traits = {random.uniform(), random.uniform(), random.uniform()};
        alarms += predict_conditions(videos, kNames, 99, 1).p <= 0.05;
    }
    EXPECT_LE(alarms, 20);  // 10 expected; 3 standard deviations
}

TEST(PredictConditions, GuessesByNothingWhereAllIsEqual) {
    std::vector<VideoTraits> videos = videos_with(5, 0);
    for (VideoTraits& video : videos) video.traits = {1, 2, 3};
    const Prediction found = predict_conditions(videos, kNames, 99, 1);
    EXPECT_NEAR(found.hit_rate, 1.0 / 3, 1e-12);
    EXPECT_EQ(found.p, 1);
}

}  // namespace
}  // namespace chironomia::study
