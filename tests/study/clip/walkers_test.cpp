// People who walk: the camera's path, steps in place, and what the real binary draws.
#include "study/clip/walkers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "core/render/camera.h"
#include "study/clip/camera_path.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::refusal_of;
using testing::run_chironomia;
using testing::TemporaryFolder;

constexpr double kFps = 30;
constexpr float kLimit = 0.3f;  // [m]

// Stands for 2 s, walks 1.2 m a second for 4 s with the sway and bounce of steps, and stands for 2 s.
std::vector<Vec3> walk() {
    std::vector<Vec3> places;
    for (int t = 0; t < 240; ++t) {
        const float s = static_cast<float>(t) / 30;
        const float way = 1.2f * std::clamp(s - 2, 0.0f, 4.0f);
        const float step = way > 0 && way < 4.8f ? 0.04f * std::sin(12 * s) : 0;
        places.emplace_back(way + step, 0.0f, 0.5f * step);
    }
    return places;
}

TEST(CameraPath, StandsStillBeforeAPersonWhoSways) {
    std::vector<Vec3> places;
    for (int t = 0; t < 300; ++t)
        places.emplace_back(0.1f * std::sin(0.2f * static_cast<float>(t)), 0.0f, 0.02f);
    const auto path = camera_path(places, {.limit = kLimit, .fps = kFps});
    for (const Vec3& place : path) EXPECT_LT(distance(place, path.front()), 1e-6f);
}

TEST(CameraPath, KeepsAPersonWhoWalksWithinTheLimit) {
    const auto places = walk();
    const auto path = camera_path(places, {.limit = kLimit, .fps = kFps});
    ASSERT_EQ(path.size(), places.size());
    for (std::size_t t = 0; t < path.size(); ++t) EXPECT_LE(distance(path[t], places[t]), kLimit) << t;
}

// The person's hips are shaken by 0.04 * 12^2 = 5.8 m/s^2 in walking.
TEST(CameraPath, IsSmootherThanTheStepsOfTheWalker) {
    const auto path = camera_path(walk(), {.limit = kLimit, .fps = kFps});
    float hardest = 0;
    for (std::size_t t = 1; t + 1 < path.size(); ++t)
        hardest = std::max(hardest, length(path[t + 1] - 2.0f * path[t] + path[t - 1]) * float(kFps * kFps));
    EXPECT_LT(hardest, 2);
}

TEST(CameraPath, BeginsToMoveBeforeThePersonIsFarOff) {
    const auto path = camera_path(walk(), {.limit = kLimit, .fps = kFps});
    EXPECT_GT(path[66].x - path[30].x, 0.01f) << "0.2 s after the first step";
    EXPECT_LT(path[30].x - path[0].x, 0.1f) << "1 s before it";
}

TEST(CameraPath, FollowsAPersonWhoJumps) {
    std::vector<Vec3> places(100, Vec3(0));
    for (std::size_t t = 50; t < 100; ++t) places[t].x = 3;
    const auto path = camera_path(places, {.limit = kLimit, .fps = kFps});
    for (std::size_t t = 0; t < path.size(); ++t) EXPECT_LE(distance(path[t], places[t]), kLimit) << t;
}

ClipJob job_of(const std::string& motion, Travel travel) {
    ClipJob job;
    job.performers[0].motion = testing::test_file(motion);
    job.scene = "full";
    job.size = {160, 90};
    job.travel = travel;
    job.out = "clip.mp4";
    return job;
}

const std::string kWalk = "tests/fixtures/gestures/walk.bvh";

struct Walked {
    std::vector<Performance> people;
    Stage stage;

    explicit Walked(const ClipJob& job) {
        for (const Performer& performer : job.performers) people.push_back(perform(performer, job));
        stage = make_stage(people, job);
        follow_walkers(people, job, stage);
    }
    // Where the hips are in the picture, from 0 at its left edge to 1.
    float across(std::size_t frame, std::size_t person = 0) const {
        const Pose pose = people[person].pose_at(frame);
        const auto hips = static_cast<std::size_t>(people[person].avatar.humanoid[HumanJoint::hips]);
        const View& view = stage.views[person].view;
        const Vec3 place = origin(world_from_joints(people[person].avatar.skeleton, pose.joints)[hips]);
        return pixel_of(view.scene.camera, view.size, place).x / static_cast<float>(view.size.width);
    }
};

TEST(FollowWalkers, KeepsTheWalkerInTheMiddleThird) {
    const Walked free(job_of(kWalk, Travel::free)), followed(job_of(kWalk, Travel::follow));
    const std::size_t frames = free.people[0].fit.poses.size();
    bool left = false;
    for (std::size_t t = 0; t < frames; ++t) {
        left = left || std::abs(free.across(t) - 0.5f) > 0.5f;
        EXPECT_NEAR(followed.across(t), 0.5f, 1 / 6.0f) << t;
    }
    EXPECT_TRUE(left) << "without, the picture is left";
}

TEST(FollowWalkers, HoldsTheHipsInPlaceAndMovesTheLegs) {
    const Walked walked(job_of(kWalk, Travel::in_place));
    const Performance& person = walked.people[0];
    const auto at = [&](HumanJoint part, std::size_t frame) {
        const Pose pose = person.pose_at(frame);
        return origin(world_from_joints(person.avatar.skeleton,
                                        pose.joints)[static_cast<std::size_t>(person.avatar.humanoid[part])]);
    };
    float farthest = 0, reach = 0;
    for (std::size_t t = 0; t < person.fit.poses.size(); ++t) {
        const Vec3 hips = at(HumanJoint::hips, t) - at(HumanJoint::hips, 0);
        farthest = std::max(farthest, std::hypot(hips.x, hips.z));
        reach = std::max(reach, distance(at(HumanJoint::left_foot, t), at(HumanJoint::left_foot, 0)));
    }
    EXPECT_LT(farthest, 1e-4f);
    EXPECT_GT(reach, 0.2f);
}

// Each is followed by the camera of the other, too, so both have the same path, the middle of their ways.
TEST(FollowWalkers, HasOneCameraForAllThatItFollows) {
    ClipJob walker = job_of(kWalk, Travel::follow),
            waver = job_of("tests/fixtures/gestures/wave.bvh", Travel::follow);
    const std::vector<Performer> both = {walker.performers[0], waver.performers[0]};
    walker.performers[0].followed = waver.performers[0].followed = both;
    const Walked a(walker), b(waver);
    ASSERT_EQ(a.people[0].travelled.size(), b.people[0].travelled.size());
    EXPECT_EQ(a.people[0].travelled, b.people[0].travelled);
    EXPECT_GT(a.people[0].travelled.size(), b.people[0].fit.poses.size())
        << "goes on when the shorter one has ended";
    ClipJob alone = job_of(kWalk, Travel::follow);
    EXPECT_NE(recipe_of(walker), recipe_of(alone));
}

TEST(FollowWalkers, RefusesTwoPeopleInOnePicture) {
    ClipJob job = job_of(kWalk, Travel::follow);
    job.performers.push_back(job.performers[0]);
    job.scene = "dyad";
    EXPECT_EQ(
        refusal_of([&] { Walked walked(job); }),
        "scene dyad: shows 2 people in one picture, a camera that follows goes along with 1; choose split, "
        "let them step in place, or leave the camera where it is");
    job.scene = "split";
    EXPECT_NO_THROW(Walked walked(job));
}

// The middle of the picture is where the avatar stands, wherever the origin of its file is.
TEST(MakeStage, ShowsAnAvatarBesideItsOriginInTheMiddle) {
    for (const Travel travel : {Travel::free, Travel::follow, Travel::in_place}) {
        ClipJob job = job_of("tests/fixtures/gestures/wave.bvh", travel);
        const float own = Walked(job).across(10);
        job.performers[0].avatar = testing::test_file("made/beside.glb");
        EXPECT_NEAR(Walked(job).across(10), own, 0.005f);
    }
}

Outcome render_walk(const TemporaryFolder& folder, std::vector<std::string> more) {
    std::vector<std::string> words = {"render",  "--motion", testing::test_file(kWalk).string(),
                                      "--scene", "full",     "--size",
                                      "64x64",   "--frames", "125:137",
                                      "--quiet", "--out",    (folder / "a.mp4").string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_chironomia(words);
}

TEST(FollowCli, KeepsTheWalkerInThePicture) {
    const TemporaryFolder folder;
    const Outcome free = render_walk(folder, {});
    EXPECT_THAT(free.err,
                HasSubstr("the head is outside the picture in 12 of 12 frames; go along with --follow, "
                          "or hold the figure with --in-place or --body upper"));
    for (const std::string option : {"--follow", "--in-place"}) {
        const Outcome kept = render_walk(folder, {option, "--report", (folder / "r.json").string()});
        EXPECT_EQ(kept.exit_code, 0) << option;
        EXPECT_EQ(kept.err, "") << option;
        EXPECT_EQ(read_json(folder / "r.json")["recipe"]["options"]["travel"], option.substr(2));
    }
}

TEST(FollowCli, IsTheSameForAnyNumberOfThreads) {
    const TemporaryFolder folder;
    std::vector<std::string> hashes;
    for (const std::string threads : {"1", "3"}) {
        ASSERT_EQ(render_walk(folder, {"--follow", "--threads", threads}).exit_code, 0);
        hashes.push_back(sha256_of_file(folder / "a.mp4"));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(FollowCli, RefusesWhatHasNoHipsToFollow) {
    const TemporaryFolder folder;
    EXPECT_THAT(render_walk(folder, {"--follow", "--in-place"}).err,
                HasSubstr("--follow excludes --in-place"));
    EXPECT_THAT(render_walk(folder, {"--follow", "--body", "upper"}).err, HasSubstr("excludes"));
    const Outcome still = run_chironomia({"render", "--avatar", "neutral", "--follow", "--out", "x.mp4"});
    EXPECT_EQ(still.exit_code, 2);
    EXPECT_THAT(still.err, HasSubstr("--follow: needs --motion or --face"));
    const std::string motion = testing::test_file(kWalk).string();
    const Outcome dyad = run_chironomia({"render", "--motion", motion, "--motion", motion, "--scene", "dyad",
                                         "--follow", "--quiet", "--out", (folder / "a.mp4").string()});
    EXPECT_EQ(dyad.exit_code, 3);
    EXPECT_THAT(dyad.err, HasSubstr("a camera that follows goes along with 1"));
}

}  // namespace
}  // namespace chironomia::study
