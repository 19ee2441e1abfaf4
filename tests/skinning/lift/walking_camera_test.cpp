#include "skinning/lift/walking_camera.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "skinning/lift/lifted_motion.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/lift/lift_trial.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kFps = 30;
const Vec2 kSize(1000, 600);  // [px]; the focal length is 1000 px

const std::map<Landmark, Vec3> kStanding = {
    {Landmark::thorax, {0, 0.5f, 0}},
    {Landmark::pelvis, {0, 0, 0}},
    {Landmark::left_shoulder, {0.18f, 0.5f, 0}},
    {Landmark::right_shoulder, {-0.18f, 0.5f, 0}},
    {Landmark::left_elbow, {0.2f, 0.22f, 0}},
    {Landmark::right_elbow, {-0.2f, 0.22f, 0}},
    {Landmark::left_wrist, {0.21f, -0.04f, 0}},
    {Landmark::right_wrist, {-0.21f, -0.04f, 0}},
    {Landmark::left_hip, {0.1f, 0, 0}},
    {Landmark::right_hip, {-0.1f, 0, 0}},
    {Landmark::left_knee, {0.1f, -0.43f, 0}},
    {Landmark::right_knee, {-0.1f, -0.43f, 0}},
    {Landmark::left_ankle, {0.1f, -0.85f, 0}},
    {Landmark::right_ankle, {-0.1f, -0.85f, 0}},
};

// Standing people whose hips are at these places [m] before the camera; -z is away from it.
PictureBody filmed(const std::vector<Vec3>& path, const std::map<Landmark, Vec3>& person = kStanding) {
    PictureBody body;
    body.places.resize(path.size());
    body.there.resize(path.size());
    for (size_t t = 0; t < path.size(); ++t) {
        for (const auto& [landmark, place] : person) {
            const Vec3 seen = path[t] + place;
            const auto l = static_cast<size_t>(landmark);
            body.places[t][l] = kSize * 0.5f + Vec2(seen.x, -seen.y) * (kSize.x / -seen.z);
            body.there[t].set(l);
            body.known.set(l);
        }
    }
    return body;
}

// From 3 m away to 6, and a metre aside.
std::vector<Vec3> walk() {
    std::vector<Vec3> path;
    for (int t = 0; t <= 120; ++t) path.emplace_back(t / 120.0f, -0.1f, -3 - t / 40.0f);
    return path;
}

PictureBody without(PictureBody body, std::initializer_list<Landmark> landmarks) {
    for (LandmarkSet& there : body.there) {
        for (const Landmark landmark : landmarks) there.reset(static_cast<size_t>(landmark));
    }
    return body;
}

TEST(FindDistances, FollowFromTheSizeOfThePerson) {
    const std::vector<Vec3> path = walk();
    const std::vector<double> far = find_distances(filmed(path), kFps);
    ASSERT_EQ(far.size(), path.size());
    for (size_t t = 0; t < path.size(); ++t) EXPECT_NEAR(far[t] * 4.5, -path[t].z, 0.05) << t;
}

TEST(FindDistances, AreEmptyForAPersonWhoStays) {
    EXPECT_TRUE(find_distances(filmed(std::vector<Vec3>(90, {0.5f, 0, -4})), kFps).empty());
}

TEST(FindDistances, IgnoreAPersonWhoBowsOrTurns) {
    std::map<Landmark, Vec3> bowed = kStanding, turned = kStanding;
    for (const Landmark landmark : {Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder})
        bowed[landmark].y = 0.2f;
    for (auto& [landmark, place] : turned) place.x *= 0.3f;
    PictureBody body = filmed(std::vector<Vec3>(90, {0, 0, -4}));
    const PictureBody bows = filmed(std::vector<Vec3>(30, {0, 0, -4}), bowed),
                      turns = filmed(std::vector<Vec3>(30, {0, 0, -4}), turned);
    std::copy(bows.places.begin(), bows.places.end(), body.places.begin() + 20);
    std::copy(turns.places.begin(), turns.places.end(), body.places.begin() + 55);
    EXPECT_TRUE(find_distances(body, kFps).empty());
}

TEST(FindDistances, AreEmptyWithoutLegs) {
    const PictureBody body = without(filmed(walk()), {Landmark::left_knee, Landmark::right_knee,
                                                      Landmark::left_ankle, Landmark::right_ankle});
    EXPECT_TRUE(find_distances(body, kFps).empty());
}

TEST(FindDistances, IgnoreATrunkThatTurnsWhileLegsAreHidden) {
    std::map<Landmark, Vec3> turned = kStanding;
    for (auto& [landmark, place] : turned) place.x *= 0.3f;
    PictureBody body = filmed(std::vector<Vec3>(90, {0, 0, -4}));
    const PictureBody turns = filmed(std::vector<Vec3>(40, {0, 0, -4}), turned);
    for (size_t t = 0; t < 40; ++t) {
        body.places[t + 30] = turns.places[t];
        for (const Landmark leg : {Landmark::left_knee, Landmark::right_knee, Landmark::left_ankle,
                                   Landmark::right_ankle, Landmark::pelvis})
            body.there[t + 30].reset(static_cast<size_t>(leg));
    }
    EXPECT_TRUE(find_distances(body, kFps).empty());
}

TEST(FindDistances, AreLinearOverFramesThatShowNobody) {
    PictureBody body = filmed(walk());
    for (size_t t = 40; t < 60; ++t) body.there[t].reset();
    const std::vector<double> far = find_distances(body, kFps);
    for (size_t t = 0; t < far.size(); ++t) EXPECT_NEAR(far[t] * 4.5, 3 + double(t) / 40, 0.05) << t;
}

TEST(WalkingCamera, IsTheRealCameraForAPersonWhoStays) {
    const PictureBody body = filmed(std::vector<Vec3>(90, {0.5f, 0, -4}));
    const WalkingCamera camera(body, {.size = kSize}, kFps);
    EXPECT_EQ(camera.seen(body).places, body.places);
    EXPECT_EQ(camera.place(7, {1, 2, 3}), Vec3(1, 2, 3));
    EXPECT_EQ(camera.nearest(), 4);
    EXPECT_EQ(camera.farthest(), 4);
}

TEST(WalkingCamera, KeepsThePersonInItsMiddleAndOfOneSize) {
    const PictureBody body = filmed(walk());
    const PictureBody seen = WalkingCamera(body, {.size = kSize}, kFps).seen(body);
    const auto length = [&](size_t t) {
        return glm::distance(seen.at(t, Landmark::thorax), seen.at(t, Landmark::pelvis));
    };
    for (size_t t = 0; t < seen.frames(); ++t) {
        const Vec2 centre = (seen.at(t, Landmark::thorax) + seen.at(t, Landmark::pelvis)) * 0.5f;
        EXPECT_LT(glm::distance(centre, kSize * 0.5f), 3) << t;
        EXPECT_NEAR(length(t) / length(60), 1, 0.02) << t;
    }
}

TEST(WalkingCamera, PutsEveryPlaceWhereTheRealCameraSawIt) {
    const std::vector<Vec3> path = walk();
    const PictureBody body = filmed(path);
    const WalkingCamera camera(body, {.size = kSize}, kFps);
    EXPECT_NEAR(camera.nearest(), 3, 0.15);
    EXPECT_NEAR(camera.farthest(), 6, 0.3);
    const PictureBody seen = camera.seen(body);
    const double focal = 1000;
    for (size_t t = 0; t < path.size(); t += 10) {
        // A hand that is held 40 cm before the hips, in the axes of the walking camera.
        const Vec2 off = seen.at(t, Landmark::left_wrist) - camera.middle();
        const auto scale = static_cast<float>((camera.distance() - 0.4) / focal);
        const Vec3 place = camera.place(t, {off.x * scale, -off.y * scale, 0.4f});
        const auto share = static_cast<float>(focal / (camera.distance() - double(place.z)));
        const Vec2 point = kSize * 0.5f + Vec2(place.x, -place.y) * share;
        EXPECT_LT(glm::distance(point, body.at(t, Landmark::left_wrist)), 0.05f) << t;
        const Vec3 hips = camera.place(t, {0, 0, 0});
        EXPECT_NEAR(double(hips.x), double(path[t].x), 0.1) << t;
        EXPECT_NEAR(camera.distance() - double(hips.z), double(-path[t].z), 0.3) << t;
    }
}

TEST(WalkingCamera, SupposesAUsualSizeForPixels) {
    const PictureBody body = filmed(walk());
    EXPECT_EQ(WalkingCamera(body, {}, kFps).middle(), Vec2(640, 360));
    PictureBody shares = body;
    for (auto& places : shares.places) {
        for (Vec2& place : places) place /= 1000.0f;
    }
    EXPECT_NEAR(WalkingCamera(shares, {}, kFps).distance(), 4, 1e-6);
}

TEST(WalkingCamera, KeepsALeastDistance) {
    std::vector<Vec3> path;
    for (int t = 0; t < 120; ++t) path.emplace_back(0, 0, -1 - t / 20.0f);
    EXPECT_NEAR(WalkingCamera(filmed(path), {.size = kSize}, kFps).nearest(), 1.5, 0.05);
}

TEST(WalkingCamera, FindsTheDistanceByAKnownLens) {
    const PictureBody stays = filmed(std::vector<Vec3>(90, {0.5f, 0, -7})), walks = filmed(walk());
    EXPECT_NEAR(WalkingCamera(stays, {.size = kSize, .focal = 1000}, kFps).distance(), 7, 0.2);
    EXPECT_NEAR(WalkingCamera(stays, {.size = kSize, .focal = 100}, kFps).distance(), 0.8, 1e-6);
    EXPECT_NEAR(WalkingCamera(walks, {.size = kSize, .focal = 1000}, kFps).farthest(), 6, 0.3);
    EXPECT_NEAR(WalkingCamera(walks, {.size = kSize, .focal = 2000}, kFps).farthest(), 12, 0.6);
}

// People who walk some 7.6 m towards a camera that stays, and away again. The distance is known only as well as
// the person's height; the ratio of two distances is known better.
struct Walk {
    std::string file;
    double ratio = 1;  // of the farthest distance to the nearest
    double limit = 0;  // of the farthest distance [m]
    std::string note;
};

void PrintTo(const Walk& walk, std::ostream* out) {
    *out << walk.file;
}

class WalkingCameraOnFiles : public ::testing::TestWithParam<Walk> {};

TEST_P(WalkingCameraOnFiles, LiftsAsIfTheRealCameraWalked) {
    const auto& [file, ratio, limit, note] = GetParam();
    const Motion motion = read_motion(testing::test_file(file));
    const testing::Trial along = testing::film(motion, {.distance = 12}),
                         stays = testing::film(motion, {.stays = true, .distance = 12});
    const Lift lifted = lift(stays.picture);
    EXPECT_LT(testing::judge(stays, lifted).mean, 0.1);
    EXPECT_LT(testing::judge(along, lift(along.picture)).mean, 0.12);
    EXPECT_NEAR(lifted.nearest, 4.5, 0.5);
    EXPECT_NEAR(lifted.farthest, 12, limit);
    EXPECT_NEAR(lifted.farthest / lifted.nearest, ratio, 0.05);
    EXPECT_THAT(with_lifted_points(stays.picture).notes, ::testing::Contains(HasSubstr(note)));
    EXPECT_THAT(with_lifted_points(along.picture).notes, Each(Not(HasSubstr("walks"))));
}

// The person of our own file is a little narrower than the lifter supposes.
INSTANTIATE_TEST_SUITE_P(
    Bvh, WalkingCameraOnFiles,
    ::testing::ValuesIn(testing::present<Walk>({{"tests/fixtures/gestures/walk.bvh", 12 / 4.4, 0.7,
                                                 "the person walks, 4.6 to 12.7 m before the camera"},
                                                {"../shared/data/motion/bvh/ad_zombie.bvh", 2.73, 0.5,
                                                 "the person walks, 4.5 to 12.3 m before the camera"}})));

}  // namespace
}  // namespace chironomia
