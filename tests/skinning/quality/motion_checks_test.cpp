// Made motions with one fault each: exactly this fault is found, in exactly these frames.
#include "skinning/quality/motion_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/text.h"
#include "skinning/fit/fit.h"
#include "skinning/motion/motion_file.h"
#include "skinning/quality/verdict.h"
#include "tests/skinning/fit/figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr size_t kFrames = 90;  // 3 s

// Arms in front of the body that gesture, hands whose fingers open and close; a person of 1.7 m.
struct Body {
    std::vector<std::string> names;
    std::vector<std::vector<Vec3>> frames;

    Vec3& at(size_t t, const std::string& name) {
        return frames[t][static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
    }
};

void put(Body& body, size_t t, const std::string& name, const Vec3& place) {
    if (t == 0) body.names.push_back(name);
    body.frames[t].push_back(place);
}

Body gesturing(size_t frames = kFrames) {
    Body body;
    body.frames.resize(frames);
    for (size_t t = 0; t < frames; ++t) {
        const float time = static_cast<float>(t) / 30;
        for (const float side : {1.0f, -1.0f}) {
            const std::string prefix = side > 0 ? "left_" : "right_";
            const float lift = 0.1f * std::sin(4 * time + side);
            const Vec3 wrist(side * (0.15f + 0.5f * lift), 1.2f + lift, 0.3f);
            put(body, t, prefix + "shoulder", {side * 0.18f, 1.43f, 0});
            put(body, t, prefix + "elbow", {side * 0.26f, 1.16f + 0.2f * lift, 0.06f});
            put(body, t, prefix + "wrist", wrist);
            put(body, t, prefix + "hip", {side * 0.1f, 0.93f, 0});
            const float curl = 0.02f * std::sin(3 * time);
            for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
                for (int i = 1; i <= 4; ++i) {
                    const Vec3 way(0, 0.03f * static_cast<float>(i), curl * static_cast<float>(i));
                    put(body, t, prefix + finger + "_" + std::to_string(i), wrist + way);
                }
            }
        }
        put(body, t, "nose", {0, 1.58f, 0.1f});
    }
    return body;
}

Motion motion_of(const Body& body) {
    Motion motion{.source = "made", .fps = 30, .frames = body.frames.size()};
    KeypointTrack& track = motion.keypoints.emplace();
    track.names = body.names;
    for (const auto& frame : body.frames) {
        track.points.insert(track.points.end(), frame.begin(), frame.end());
        track.confidence.insert(track.confidence.end(), frame.size(), 1.0f);
    }
    return motion;
}

void hide(Motion& motion, const std::string& name, size_t first, size_t last) {
    KeypointTrack& track = *motion.keypoints;
    for (size_t k = 0; k < track.names.size(); ++k) {
        if (track.names[k] != name) continue;
        for (size_t t = first; t <= last; ++t) track.confidence[t * track.names.size() + k] = 0;
    }
}

std::vector<Finding> found(const Motion& motion) {
    return check_motion(motion, motion);
}

Judgement verdict(const Motion& motion) {
    return judge(found(motion), {.frames = motion.frames, .fps = motion.fps});
}

void expect_only(const std::vector<Finding>& findings, Check check, const std::string& part,
                 const std::vector<FrameSpan>& spans) {
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].check, check) << name_of(findings[0].check);
    EXPECT_EQ(findings[0].part, part);
    EXPECT_EQ(findings[0].spans, spans);
}

TEST(MotionChecks, ACleanMotionHasNoFindingAndIsFitToShow) {
    const Motion motion = motion_of(gesturing());
    EXPECT_THAT(found(motion), IsEmpty());
    EXPECT_EQ(verdict(motion).verdict, Verdict::fit_to_show);
    EXPECT_THAT(verdict(motion).reasons, IsEmpty());
}

TEST(MotionChecks, FindsNumbersThatAreNoneAndNothingElse) {
    Body body = gesturing();
    body.at(12, "left_elbow").y = std::numeric_limits<float>::quiet_NaN();
    body.at(13, "left_elbow").x = std::numeric_limits<float>::infinity();
    const Motion motion = motion_of(body);
    expect_only(found(motion), Check::not_finite, "left_elbow", {{12, 13}});
    EXPECT_EQ(verdict(motion).verdict, Verdict::do_not_show);
    EXPECT_EQ(verdict(motion).reasons[0].text, "left_elbow is no number in frames 12 to 13");
}

TEST(MotionChecks, ANumberThatIsNoneIsNotFitted) {
    Body body = gesturing();
    body.at(12, "left_elbow").y = std::numeric_limits<float>::quiet_NaN();
    const Avatar avatar = testing::avatar_of(testing::make_figure({}));
    EXPECT_THAT(
        testing::refusal_of([&] { fit_motion(motion_of(body), avatar, {}); }),
        HasSubstr("made: left_elbow is no number in 1 of 90 frames, first in frame 12; a motion needs"));
}

TEST(MotionChecks, FindsAShortDropOutThatIsBridgedAndALongOneThatIsSeen) {
    Motion motion = motion_of(gesturing());
    hide(motion, "right_wrist", 20, 24);
    expect_only(found(motion), Check::drop_out, "right_wrist", {{20, 24}});
    EXPECT_EQ(verdict(motion).verdict, Verdict::fit_to_show) << "5 frames are bridged";
    hide(motion, "right_wrist", 40, 59);
    expect_only(found(motion), Check::drop_out, "right_wrist", {{20, 24}, {40, 59}});
    EXPECT_EQ(verdict(motion).verdict, Verdict::look_first);
    EXPECT_EQ(verdict(motion).reasons[0].text,
              "right_wrist is not seen in frames 40 to 59, at longest 0.7 s; gaps are bridged by a straight "
              "line, which is seen over 0.5 s");
    const FitFacts of_picture{.frames = motion.frames, .fps = motion.fps, .is_picture = true};
    EXPECT_EQ(
        judge(found(motion), of_picture).reasons[0].text,
        "right_wrist is not seen in frames 40 to 59, at longest 0.7 s; gaps over 0.5 s are not bridged, "
        "it rests there");
    hide(motion, "right_wrist", 0, 59);
    hide(motion, "left_wrist", 0, 59);
    EXPECT_EQ(verdict(motion).verdict, Verdict::do_not_show) << "both wrists in two thirds of the clip";
}

TEST(MotionChecks, FindsAShoulderThatIsMostlyAway) {
    Motion motion = motion_of(gesturing());
    hide(motion, "left_shoulder", 0, 50);
    EXPECT_EQ(verdict(motion).verdict, Verdict::do_not_show);
}

// The wrist of a throw: 13 m/s at its fastest, to which it comes and from which it goes over some frames.
TEST(MotionChecks, PassesAThrow) {
    Body body = gesturing();
    const float steps[] = {0.06f, 0.16f, 0.3f, 0.43f, 0.36f, 0.2f, 0.08f};
    Vec3 off(0);
    for (size_t t = 40; t < kFrames; ++t) {
        if (t < 47) off += steps[t - 40] * Vec3(0.2f, 0.3f, 0.93f);
        body.at(t, "right_wrist") += off;
        for (const char* finger : {"thumb", "index", "middle", "ring", "little"})
            for (int i = 1; i <= 4; ++i) body.at(t, format("right_{}_{}", finger, i)) += off;
    }
    for (const Finding& finding : found(motion_of(body)))
        EXPECT_NE(finding.check, Check::speed) << finding.part;
}

TEST(MotionChecks, FindsASpikeOfOneFrame) {
    Body body = gesturing();
    body.at(33, "left_wrist") += Vec3(0.5f, 0.3f, 0);
    // The hand comes along, so that only its wrist's way is odd.
    const std::vector<Finding> findings = found(motion_of(body));
    expect_only(findings, Check::speed, "left_wrist", {{33, 33}});
    EXPECT_NEAR(findings[0].worst, std::hypot(0.5, 0.3) / 0.36 * 30, 3);
    EXPECT_EQ(verdict(motion_of(body)).verdict, Verdict::look_first);
}

TEST(MotionChecks, FindsAJumpThatStays) {
    Body body = gesturing();
    for (size_t t = 50; t < kFrames; ++t) body.at(t, "right_elbow") += Vec3(-0.3f, 0, 0);
    expect_only(found(motion_of(body)), Check::speed, "right_elbow", {{50, 50}});
}

TEST(MotionChecks, ManyJumpsAreNotToBeShown) {
    Body body = gesturing();
    for (size_t t = 10; t < kFrames; t += 8) body.at(t, "left_wrist") += Vec3(0.5f, 0, 0);
    EXPECT_EQ(verdict(motion_of(body)).verdict, Verdict::do_not_show);
}

TEST(MotionChecks, FindsABoneThatFlipsInDepth) {
    Body body = gesturing();
    for (size_t t = 40; t <= 60; ++t) {
        const float elbow = body.at(t, "left_elbow").z;
        body.at(t, "left_wrist").z = 2 * elbow - body.at(t, "left_wrist").z;
        for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
            for (int i = 1; i <= 4; ++i)
                body.at(t, std::string("left_") + finger + "_" + std::to_string(i)).z -= 0.48f;
        }
    }
    const std::vector<Finding> findings = found(motion_of(body));
    std::vector<Check> checks;
    for (const Finding& finding : findings) checks.push_back(finding.check);
    // A wrist that is mirrored through its elbow also goes far in one frame.
    EXPECT_THAT(checks, ElementsAre(Check::speed, Check::sign_flip));
    EXPECT_EQ(findings[1].part, "left_forearm");
    EXPECT_EQ(findings[1].spans, (std::vector<FrameSpan>{{40, 40}, {61, 61}}));
    EXPECT_NE(verdict(motion_of(body)).verdict, Verdict::fit_to_show);
}

TEST(MotionChecks, FindsFingersThatFreezeWhileTheHandTravels) {
    Body body = gesturing();
    for (size_t t = 21; t <= 80; ++t) {
        for (const char* finger : {"thumb", "index", "middle", "ring", "little"}) {
            for (int i = 1; i <= 4; ++i) {
                const std::string name = std::string("right_") + finger + "_" + std::to_string(i);
                body.at(t, name) = body.at(t, "right_wrist") + body.at(20, name) - body.at(20, "right_wrist");
            }
        }
    }
    expect_only(found(motion_of(body)), Check::frozen_hand, "right hand", {{21, 80}});
    EXPECT_EQ(verdict(motion_of(body)).verdict, Verdict::look_first);
}

TEST(MotionChecks, FingersThatNeverMoveAreNoFault) {
    Body body = gesturing();
    for (size_t t = 0; t < kFrames; ++t) {
        for (size_t k = 0; k < body.names.size(); ++k) {
            const bool left = body.names[k].starts_with("left_");
            if (body.names[k].find("_1") == std::string::npos &&
                body.names[k].find("_2") == std::string::npos &&
                body.names[k].find("_3") == std::string::npos &&
                body.names[k].find("_4") == std::string::npos)
                continue;
            const std::string wrist = left ? "left_wrist" : "right_wrist";
            body.frames[t][k] = body.at(t, wrist) + body.frames[0][k] - body.at(0, wrist);
        }
    }
    EXPECT_THAT(found(motion_of(body)), IsEmpty());
}

// Both arms straight out to the sides.
void spread_arms(Body& body, size_t t) {
    for (const float side : {1.0f, -1.0f}) {
        const std::string prefix = side > 0 ? "left_" : "right_";
        const Vec3 wrist(side * 0.7f, 1.43f, 0);
        const Vec3 moved = wrist - body.at(t, prefix + "wrist");
        for (size_t k = 0; k < body.names.size(); ++k) {
            if (body.names[k].starts_with(prefix) && body.names[k].back() >= '1' &&
                body.names[k].back() <= '4')
                body.frames[t][k] += moved;
        }
        body.at(t, prefix + "elbow") = {side * 0.45f, 1.43f, 0};
        body.at(t, prefix + "wrist") = wrist;
    }
}

std::vector<FrameSpan> t_poses(const Body& body) {
    for (const Finding& finding : found(motion_of(body))) {
        if (finding.check == Check::t_pose) return finding.spans;
    }
    return {};
}

TEST(MotionChecks, FindsATPoseAtTheBeginningAndInOneFrameAlone) {
    Body body = gesturing();
    for (size_t t = 0; t <= 14; ++t) spread_arms(body, t);
    spread_arms(body, 60);
    EXPECT_EQ(t_poses(body), (std::vector<FrameSpan>{{0, 14}, {60, 60}}));
    EXPECT_NE(verdict(motion_of(body)).verdict, Verdict::fit_to_show);
    for (size_t t = 0; t <= 50; ++t) {
        if (t > 14) spread_arms(body, t);
    }
    EXPECT_EQ(verdict(motion_of(body)).verdict, Verdict::do_not_show) << "most of the clip";
}

TEST(MotionChecks, ArmsThatSwingThroughAreNoTPose) {
    // A jumping jack of half a second, up and down: straight arms at an angle that changes all the time.
    Body body = gesturing(15);
    for (size_t t = 0; t < 15; ++t) {
        const float angle = 1.2f * std::sin(2 * kPi * static_cast<float>(t) / 15);
        for (const float side : {1.0f, -1.0f}) {
            const std::string prefix = side > 0 ? "left_" : "right_";
            const Vec3 along(side * std::cos(angle), std::sin(angle), 0);
            body.at(t, prefix + "elbow") = body.at(t, prefix + "shoulder") + 0.28f * along;
            body.at(t, prefix + "wrist") = body.at(t, prefix + "shoulder") + 0.53f * along;
        }
    }
    EXPECT_THAT(t_poses(body), IsEmpty());
}

TEST(Verdicts, FollowTheErrorsOfTheAvatar) {
    const auto at = [](double median) {
        FitFacts facts{.frames = 30, .fps = 30};
        facts.errors.push_back({.part = "left_wrist", .reprojected = {.n = 30, .median = median}});
        return judge({}, facts);
    };
    EXPECT_EQ(at(0.05).verdict, Verdict::fit_to_show);
    EXPECT_EQ(at(0.15).verdict, Verdict::look_first);
    EXPECT_EQ(at(0.3).verdict, Verdict::do_not_show);
    EXPECT_EQ(at(0.15).reasons[0].text,
              "left_wrist of the avatar is 15 % of a shoulder width from the motion's in the picture, by the "
              "median; the limit is 10 %");
}

TEST(Verdicts, NameJointsThatAreHeldBackMostOfTheTime) {
    FitFacts facts{.frames = 30, .fps = 30, .limits_applied = true, .fit_frames = 30};
    facts.limited = {{"left_elbow", 10}};
    EXPECT_EQ(judge({}, facts).verdict, Verdict::fit_to_show);
    facts.limited = {{"left_elbow", 20}};
    EXPECT_EQ(judge({}, facts).verdict, Verdict::look_first);
    facts.limits_applied = false;
    EXPECT_EQ(judge({}, facts).verdict, Verdict::fit_to_show) << "joint turns are only counted";
}

TEST(Verdicts, FollowTheDepthOfAHandInTheBodyAndItsDuration) {
    const auto judged = [](float depth, size_t frames) {
        FitFacts facts{.frames = 60, .fps = 30, .fit_frames = 60, .fit_fps = 30};
        Interpenetration one{
            .part = "left hand", .in = "trunk", .deepest = double(depth), .spans = {}, .course = {}};
        one.course.assign(60, 0);
        std::fill_n(one.course.begin() + 10, frames, depth);
        facts.interpenetrations = {one};
        return judge({}, facts);
    };
    EXPECT_EQ(judged(0.035f, 40).verdict, Verdict::fit_to_show);
    EXPECT_EQ(judged(0.05f, 2).verdict, Verdict::fit_to_show) << "too short to be seen";
    EXPECT_EQ(judged(0.05f, 3).verdict, Verdict::look_first);
    EXPECT_EQ(judged(0.09f, 14).verdict, Verdict::look_first);
    EXPECT_EQ(judged(0.09f, 15).verdict, Verdict::do_not_show);
    EXPECT_EQ(
        judged(0.05f, 3).reasons[0].text,
        "left hand of the avatar is in its trunk in frames 10 to 12, up to 5 cm deep; the limit is 4 cm for "
        "0.1 s");
}

Fit fit_of(const std::string& file, const MotionHints& hints) {
    const Avatar avatar = testing::avatar_of(testing::make_figure({}));
    return fit_motion(read_motion(testing::test_file(file), hints), avatar, {});
}

TEST(FitReportOfFiles, GoodRecordingsAreFitToShow) {
    for (const std::string& file :
         testing::present({"tests/fixtures/gestures/jacks.bvh", "tests/fixtures/gestures/beats.bvh",
                           "tests/fixtures/gestures/mediapipe_world33_25fps.json",
                           "../shared/data/motion/bvh/ad_jumping_jacks.bvh",
                           "../shared/data/motion/bvh/genea_named_synthetic_30fps.bvh",
                           "../shared/data/motion/bvh/mh_walk1.bvh",
                           "../shared/data/motion/keypoints3d/mediapipe_world33.json"})) {
        const Judgement judgement = judge(fit_of(file, {}).report);
        EXPECT_EQ(judgement.verdict, Verdict::fit_to_show) << file << ": " << to_json(judgement).dump(1);
    }
    EXPECT_EQ(judge(fit_of("tests/fixtures/gestures/t_pose.bvh", {}).report).verdict, Verdict::do_not_show);
}

TEST(FitReportOfFiles, ClipsThatBeginWithSpreadArmsAreToBeLookedAt) {
    for (const std::string& file : testing::present(
             {"tests/fixtures/gestures/wave.bvh", "tests/fixtures/gestures/walk.bvh",
              "../shared/data/motion/bvh/ad_wave_hello.bvh", "../shared/data/motion/bvh/ad_zombie.bvh"})) {
        const FitReport report = fit_of(file, {}).report;
        EXPECT_EQ(judge(report).verdict, Verdict::look_first) << file;
        ASSERT_THAT(report.findings, SizeIs(1)) << file;
        EXPECT_EQ(report.findings[0].check, Check::t_pose);
        EXPECT_EQ(report.findings[0].spans.front().first, 0u);
    }
}

TEST(FitReportOfFiles, TheAvatarIsWhereThePictureHasThePerson) {
    const FitReport report = fit_of("tests/fixtures/gestures/openpose_24fps", {.fps = 24}).report;
    ASSERT_THAT(report.errors, SizeIs(6));
    for (const JointError& error : report.errors) {
        RecordProperty(error.part, std::to_string(error.reprojected.median));
        EXPECT_LT(error.reprojected.median, 0.03) << error.part;
        EXPECT_FALSE(error.in_space) << "the truth in depth is not known";
    }
    // The left arm hangs out of the picture in the beginning and at the end.
    EXPECT_EQ(judge(report).verdict, Verdict::look_first);
}

}  // namespace
}  // namespace chironomia
