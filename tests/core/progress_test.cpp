#include "core/progress.h"

#include <gmock/gmock.h>

#include <thread>

namespace chironomia {
namespace {

// Off a terminal a line comes every five seconds.
TEST(Progress, KnowsNoTimeBeforeTheFirstIsDone) {
    testing::internal::CaptureStderr();
    Progress waiting("study", "videos", 4, false), half("study", "videos", 4, false);
    std::this_thread::sleep_for(std::chrono::milliseconds(5050));
    waiting.step(0);
    half.step(2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                testing::MatchesRegex("study: 0 of 4 videos\n"
                                      "study: 2 of 4 videos, [0-9.]+ s each, [0-9]+ s left\n"));
}

}  // namespace
}  // namespace chironomia
