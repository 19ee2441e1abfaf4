#include "skinning/fit/keypoint_ik.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "skinning/body/body_plan.h"
#include "skinning/fit/shoulder_rhythm.h"
#include "tests/skinning/fit/figure.h"

namespace chironomia {
namespace {

using testing::make_figure;

constexpr float kDegree = kPi / 180;

using Points = std::map<Landmark, Vec3>;

// A person of 1.7 m who stands in front of the camera with hanging, slightly bent arms.
Points standing() {
    using enum Landmark;
    Points points = {{neck, {0, 1.46f, 0}}};
    for (const float side : {1.0f, -1.0f}) {
        const bool left = side > 0;
        points[left ? left_shoulder : right_shoulder] = {side * 0.18f, 1.4f, 0};
        points[left ? left_elbow : right_elbow] = {side * 0.22f, 1.13f, -0.04f};
        points[left ? left_wrist : right_wrist] = {side * 0.22f, 0.9f, 0.06f};
        points[left ? left_hip : right_hip] = {side * 0.09f, 0.9f, 0};
        points[left ? left_knee : right_knee] = {side * 0.09f, 0.5f, 0.03f};
        points[left ? left_ankle : right_ankle] = {side * 0.09f, 0.09f, 0};
        points[left ? left_heel : right_heel] = {side * 0.09f, 0.02f, -0.04f};
        points[left ? left_toe : right_toe] = {side * 0.09f, 0.02f, 0.15f};
    }
    return points;
}

// Ears, eyes and nose of a head about its middle, turned from looking straight ahead.
void add_face(Points& points, const Quat& turn) {
    const Vec3 middle(0, 1.6f, 0);
    const auto at = [&](float x, float up_degrees) {
        const float angle = up_degrees * kDegree;
        return middle + turn * Vec3(x, 0.1f * std::sin(angle), 0.1f * std::cos(angle));
    };
    points[Landmark::left_ear] = middle + turn * Vec3(0.07f, 0, 0);
    points[Landmark::right_ear] = middle + turn * Vec3(-0.07f, 0, 0);
    points[Landmark::left_eye] = at(0.03f, 8);
    points[Landmark::right_eye] = at(-0.03f, 8);
    points[Landmark::nose] = at(0, -14);
}

LandmarkTrack track_of(const std::vector<Points>& frames) {
    LandmarkTrack track;
    for (const Points& points : frames) {
        auto& row = track.points.emplace_back();
        for (const auto& [landmark, place] : points) {
            row[static_cast<size_t>(landmark)] = place;
            track.known.set(static_cast<size_t>(landmark));
        }
        for (const auto& [middle, left, right] :
             {std::tuple{Landmark::pelvis, Landmark::left_hip, Landmark::right_hip},
              std::tuple{Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder}}) {
            if (!points.contains(left)) continue;
            row[static_cast<size_t>(middle)] = 0.5f * (points.at(left) + points.at(right));
            track.known.set(static_cast<size_t>(middle));
        }
    }
    return track;
}

PostureRig rig() {
    const testing::Figure figure = make_figure({});
    return posture_rig(figure.skeleton, figure.parts);
}

std::vector<SolvedFrame> solve(const std::vector<Points>& frames) {
    return solve_keypoints(track_of(frames), rig(), 30);
}

Vec3 direction(const Posture& posture, HumanJoint part) {
    return *posture[part] * tpose_direction(part);
}

TEST(SolveKeypoints, StandsUprightForAPersonWhoStandsUpright) {
    const SolvedFrame frame = solve({standing()})[0];
    EXPECT_LT(angle_between(frame.posture.hips, kNoTurn), 1 * kDegree);
    EXPECT_LT(angle_between(frame.posture.spine.back(), kNoTurn), 1 * kDegree);
    EXPECT_LT(angle_between(*frame.posture[HumanJoint::left_foot], kNoTurn), 2 * kDegree);
    EXPECT_TRUE(frame.limited.none());
    for (const bool reached : frame.reached) EXPECT_TRUE(reached);
}

TEST(SolveKeypoints, TurnsTheShouldersAgainstTheHips) {
    Points points = standing();
    const Quat turn = glm::angleAxis(30 * kDegree, Vec3(0, 1, 0));
    for (auto& [landmark, place] : points) {
        if (place.y > 1) place = turn * place;
    }
    const Posture posture = solve({points})[0].posture;
    EXPECT_LT(angle_between(posture.hips, kNoTurn), 1 * kDegree);
    EXPECT_LT(angle_between(posture.spine.back(), turn), 1 * kDegree);
    EXPECT_LT(angle_between(posture.spine[0], glm::angleAxis(10 * kDegree, Vec3(0, 1, 0))), 1 * kDegree);
}

TEST(SolveKeypoints, SharesASlopingShoulderLineBetweenSpineAndClavicles) {
    Points points = standing();
    points[Landmark::left_shoulder].y += 0.06f;
    const Posture posture = solve({points})[0].posture;
    const float slope = std::atan(0.06f / 0.36f);
    EXPECT_NEAR(angle_between(posture.spine.back(), kNoTurn), slope / 2, 1 * kDegree);
    EXPECT_GT(angle_between(*posture[HumanJoint::left_shoulder], posture.spine.back()), 3 * kDegree);
}

// De Groot and Brand's slope, from 30 degrees on.
TEST(ClavicleElevation, BeginsAtThirtyDegrees) {
    EXPECT_EQ(clavicle_elevation(0), 0);
    EXPECT_EQ(clavicle_elevation(30 * kDegree), 0);
    EXPECT_NEAR(clavicle_elevation(90 * kDegree), 0.123f * 60 * kDegree, 1e-4f);
    EXPECT_NEAR(clavicle_elevation(kPi), 18.45f * kDegree, 1e-3f);
}

Points with_raised_arms(bool left, bool right) {
    Points points = standing();
    const auto raise = [&](Landmark shoulder, Landmark elbow, Landmark wrist, float side) {
        points[elbow] = points[shoulder] + Vec3(side * 0.02f, 0.28f, 0);
        points[wrist] = points[elbow] + Vec3(0, 0.25f, 0.02f);
    };
    if (left) raise(Landmark::left_shoulder, Landmark::left_elbow, Landmark::left_wrist, 1);
    if (right) raise(Landmark::right_shoulder, Landmark::right_elbow, Landmark::right_wrist, -1);
    return points;
}

// How far the joint of an arm is above the pelvis, and how far its wrist is from there [m].
struct PosedArm {
    float shoulder = 0;
    Vec3 wrist{0};
};
PosedArm posed_arm(const Posture& posture, size_t side) {
    const PostureRig body = rig();
    const PosedSkeleton posed = pose_skeleton(body, posture, {});
    const auto at = [&](HumanJoint part) { return posed.places[size_t(body.parts[part])]; };
    return {.shoulder = at(kArms[side].upper).y - at(HumanJoint::hips).y,
            .wrist = at(kArms[side].end) - at(kArms[side].upper)};
}

TEST(SolveKeypoints, RaisesTheClaviclesWithTheArms) {
    const Posture still = solve({standing()})[0].posture,
                  both = solve({with_raised_arms(true, true)})[0].posture;
    for (size_t side = 0; side < 2; ++side) {
        const PosedArm hanging = posed_arm(still, side), raised = posed_arm(both, side);
        const float lift = raised.shoulder - hanging.shoulder;
        EXPECT_GT(lift, 0.02f);
        EXPECT_LT(lift, 0.06f);
        EXPECT_GT(angle_between(*both[kArms[side].base], both.spine.back()), 8 * kDegree);
        // The arm is solved after the clavicle: the wrist is where the source's is from its shoulder.
        EXPECT_GT(raised.wrist.y, 0.95f * length(raised.wrist));
    }
}

TEST(SolveKeypoints, KeepsTheGirdleOfASourceThatHasOne) {
    const Points still = standing(), rigid = with_raised_arms(true, true);
    Points shrugged = rigid;
    for (const Landmark shoulder : {Landmark::left_shoulder, Landmark::right_shoulder})
        shrugged[shoulder].y += 0.02f;
    const auto lift = [&](const Points& raised) {
        std::vector<Points> frames(20, still);
        frames.insert(frames.end(), 20, raised);
        const std::vector<SolvedFrame> solved = solve(frames);
        return posed_arm(solved.back().posture, 0).shoulder - posed_arm(solved.front().posture, 0).shoulder;
    };
    EXPECT_GT(lift(rigid), 0.02f);
    EXPECT_NEAR(lift(shrugged), 0, 0.005f);
}

// The line between the shoulders stays as it is seen; the arm that hangs keeps its girdle.
TEST(SolveKeypoints, RaisesOneClavicleWithOneArm) {
    Points points = with_raised_arms(true, false);
    const float level_before = posed_arm(solve({standing()})[0].posture, 1).shoulder;
    const PosedArm level[] = {posed_arm(solve({points})[0].posture, 0),
                              posed_arm(solve({points})[0].posture, 1)};
    EXPECT_NEAR(level[0].shoulder, level[1].shoulder, 0.002f) << "the source's shoulders are level";
    points[Landmark::left_shoulder].y += 0.04f;
    points[Landmark::left_elbow].y += 0.04f;
    points[Landmark::left_wrist].y += 0.04f;
    const Posture posture = solve({points})[0].posture;
    EXPECT_GT(posed_arm(posture, 0).shoulder, level_before + 0.02f);
    EXPECT_NEAR(posed_arm(posture, 1).shoulder, level_before, 0.012f);
}

TEST(SolveKeypoints, TurnsTheHeadAsEarsEyesAndNoseShow) {
    for (const Quat& turn :
         {kNoTurn, glm::angleAxis(40 * kDegree, Vec3(0, 1, 0)), glm::angleAxis(20 * kDegree, Vec3(1, 0, 0)),
          glm::angleAxis(15 * kDegree, Vec3(0, 0, 1))}) {
        Points points = standing();
        add_face(points, turn);
        EXPECT_LT(angle_between(solve({points})[0].posture.neck.back(), turn), 1 * kDegree);
    }
}

// As of points in a picture that were given a depth of 0: the head goes along with the shoulders.
TEST(SolveKeypoints, HoldsTheHeadOfAFlatFace) {
    Points points = standing();
    add_face(points, kNoTurn);
    const Vec3 middle = 0.5f * (points[Landmark::left_ear] + points[Landmark::right_ear]);
    for (const Landmark part : {Landmark::left_eye, Landmark::right_eye}) points[part] = middle;
    points[Landmark::nose] = middle + Vec3(0.03f, 0, 0);
    const Posture posture = solve({points})[0].posture;
    for (const Quat& turn : posture.neck) EXPECT_LT(angle_between(turn, kNoTurn), 1 * kDegree);
}

// SMPL-X has eyes but no ears.
TEST(SolveKeypoints, TurnsTheHeadAsTheEyesShowAgainstItsJoint) {
    const Vec3 joint(0, 1.55f, 0);
    for (const Quat& turn : {kNoTurn, glm::angleAxis(-50 * kDegree, Vec3(0, 1, 0)),
                             glm::angleAxis(15 * kDegree, Vec3(1, 0, 0))}) {
        Points points = standing();
        points[Landmark::head] = joint;
        for (const float side : {1.0f, -1.0f}) {
            points[side > 0 ? Landmark::left_eye : Landmark::right_eye] =
                joint + turn * Vec3(0.032f * side, 0.06f, 0.07f);
        }
        EXPECT_LT(angle_between(solve({points})[0].posture.neck.back(), turn), 2 * kDegree);
    }
}

TEST(SolveKeypoints, HoldsTheHeadLevelWhereOnlyItsTopIsGiven) {
    Points points = standing();
    points[Landmark::head_top] = {0, 1.72f, 0};
    EXPECT_LT(angle_between(solve({points})[0].posture.neck.back(), kNoTurn), 1 * kDegree);
    points[Landmark::head_top] =
        Vec3(0, 1.46f, 0) + glm::angleAxis(20 * kDegree, Vec3(0, 0, 1)) * Vec3(0, 0.26f, 0);
    EXPECT_LT(
        angle_between(solve({points})[0].posture.neck.back(), glm::angleAxis(20 * kDegree, Vec3(0, 0, 1))),
        1 * kDegree);
}

TEST(SolveKeypoints, BendsTheElbowWhereTheSourceDoes) {
    Points points = standing();
    points[Landmark::left_elbow] = {0.42f, 1.25f, 0};
    points[Landmark::left_wrist] = {0.25f, 1.1f, 0.15f};
    const Posture posture = solve({points})[0].posture;
    const Vec3 wanted = points[Landmark::left_elbow] - points[Landmark::left_shoulder];
    EXPECT_LT(angle_between(direction(posture, HumanJoint::left_upper_arm), wanted), 5 * kDegree);
}

TEST(SolveKeypoints, PutsAnElbowThatIsNotGivenBelowAndOutside) {
    Points points = standing();
    points.erase(Landmark::left_elbow);
    points.erase(Landmark::right_elbow);
    points[Landmark::left_wrist] = {0.2f, 1.3f, 0.35f};
    const Vec3 arm = direction(solve({points})[0].posture, HumanJoint::left_upper_arm);
    const Vec3 to_wrist = normalize(points[Landmark::left_wrist] - points[Landmark::left_shoulder]);
    const Vec3 off = arm - to_wrist * dot(arm, to_wrist);
    EXPECT_LT(off.y, -0.1f);
    EXPECT_GT(off.x, 0.05f);
}

TEST(SolveKeypoints, MirrorsAKneeThatNoisePutsBehindTheLeg) {
    Points points = standing();
    points[Landmark::left_knee].z = -0.04f;
    const SolvedFrame frame = solve({points})[0];
    EXPECT_GT(direction(frame.posture, HumanJoint::left_upper_leg).z, 0);
    // Toes and kneecap face forward still.
    EXPECT_GT((*frame.posture[HumanJoint::left_upper_leg] * Vec3(0, 0, 1)).z, 0.9f);
    EXPECT_GT((*frame.posture[HumanJoint::left_foot] * Vec3(0, 0, 1)).z, 0.9f);
}

// A leg bent by 40 degrees that is raised forward, past the height of the hip.
TEST(SolveKeypoints, DoesNotTurnAKneeOverThatIsRaisedAboveTheHip) {
    std::vector<Points> frames;
    for (int t = 0; t <= 30; ++t) {
        Points& points = frames.emplace_back(standing());
        const auto along = [](float degrees) {
            return Vec3(0, -std::cos(degrees * kDegree), std::sin(degrees * kDegree));
        };
        const float raised = 60 + 2 * float(t);
        points[Landmark::left_knee] = points[Landmark::left_hip] + 0.4f * along(raised + 20);
        points[Landmark::left_ankle] = points[Landmark::left_knee] + 0.4f * along(raised - 20);
    }
    const std::vector<SolvedFrame> solved = solve(frames);
    for (size_t t = 1; t < solved.size(); ++t) {
        for (const HumanJoint part : {HumanJoint::left_upper_leg, HumanJoint::left_lower_leg})
            EXPECT_LT(angle_between(*solved[t - 1].posture[part], *solved[t].posture[part]), 5 * kDegree)
                << t;
    }
}

// Both arms bend upward from a posture in front, stretch and bend again; a straight elbow passes its line by a degree.
std::vector<Points> stretching() {
    using enum Landmark;
    std::vector<Points> frames;
    for (int t = 0; t <= 40; ++t) {
        Points& points = frames.emplace_back(standing());
        const float bend = (41 * std::abs(std::cos(float(t) * kPi / 40)) - 1) * kDegree;
        for (const bool left : {true, false}) {
            const Vec3 shoulder = points[left ? left_shoulder : right_shoulder];
            points[left ? left_elbow : right_elbow] = shoulder + Vec3(0, -0.1f, 0.25f);
            const Quat upward = glm::angleAxis(-bend, Vec3(1, 0, 0));
            points[left ? left_wrist : right_wrist] =
                points[left ? left_elbow : right_elbow] + upward * Vec3(0, -0.09f, 0.22f);
        }
    }
    return frames;
}

TEST(SolveKeypoints, DoesNotTurnAnArmOverThatStretchesAndBendsAgain) {
    const std::vector<SolvedFrame> frames = solve(stretching());
    for (const HumanJoint part : {HumanJoint::left_upper_arm, HumanJoint::right_upper_arm}) {
        for (const SolvedFrame& frame : frames)
            EXPECT_LT(angle_between(*frame.posture[part], *frames[0].posture[part]), 8 * kDegree);
    }
}

TEST(SolveKeypoints, FollowsEachBoneOfAFinger) {
    using enum Landmark;
    Points points = standing();
    const Vec3 wrist = points[left_wrist];
    // The hand hangs with the palm towards the thigh; the index finger's middle joint is bent inward by 60
    // degrees.
    const auto inward = [](float degrees) {
        return Vec3(-std::sin(degrees * kDegree), -std::cos(degrees * kDegree), 0);
    };
    points[left_index_1] = wrist + Vec3(0, -0.09f, 0.03f);
    points[left_little_1] = wrist + Vec3(0, -0.08f, -0.03f);
    points[left_index_2] = points[left_index_1] + 0.04f * inward(0);
    points[left_index_3] = points[left_index_2] + 0.03f * inward(60);
    points[left_index_4] = points[left_index_3] + 0.02f * inward(60);
    const Posture posture = solve({points})[0].posture;
    EXPECT_LT(angle_between(direction(posture, HumanJoint::left_index_1), inward(0)), 1 * kDegree);
    EXPECT_LT(angle_between(direction(posture, HumanJoint::left_index_2), inward(60)), 1 * kDegree);
    // The palm faces the thigh.
    EXPECT_LT((*posture[HumanJoint::left_hand] * Vec3(0, -1, 0)).x, -0.9f);
    EXPECT_FALSE(posture[HumanJoint::left_middle_1].has_value());
}

}  // namespace
}  // namespace chironomia
