// Made postures and soles with one fault each: exactly this fault is found, in exactly these frames.
#include "skinning/fit/posture_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "skinning/body/body_plan.h"
#include "skinning/quality/verdict.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr float kDegree = kPi / 180;
constexpr size_t kFrames = 90;  // 3 s at 30 a second

// Both arms wave to and fro by 60 degrees, once a second.
std::vector<Posture> waving() {
    std::vector<Posture> postures(kFrames);
    for (size_t t = 0; t < kFrames; ++t) {
        Posture& posture = postures[t];
        posture.spine = {kNoTurn};
        posture.neck = {kNoTurn};
        const Quat swing = glm::angleAxis(60 * kDegree * std::sin(2 * kPi * float(t) / 30), Vec3(0, 0, 1));
        for (const LimbParts& arm : kArms) {
            posture[arm.upper] = kNoTurn;
            posture[arm.lower] = posture[arm.end] = swing;
        }
        for (const LimbParts& leg : kLegs)
            for (const HumanJoint part : {leg.upper, leg.lower, leg.end, *tip_of(leg.end)})
                posture[part] = kNoTurn;
    }
    return postures;
}

Quat about_arm(float degrees) {
    return glm::angleAxis(degrees * kDegree, Vec3(1, 0, 0));
}

TEST(CheckTurns, PassesWaving) {
    EXPECT_THAT(check_turns(waving(), 30), IsEmpty());
}

// The forearm's place does not show that it rolls.
TEST(CheckTurns, FindsARollThatJumps) {
    std::vector<Posture> postures = waving();
    for (size_t t = 40; t < kFrames; ++t) {
        postures[t][HumanJoint::left_lower_arm] = *postures[t][HumanJoint::left_lower_arm] * about_arm(80);
        postures[t][HumanJoint::left_hand] = *postures[t][HumanJoint::left_hand] * about_arm(80);
    }
    const std::vector<Finding> findings = check_turns(postures, 30);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].check, Check::turn_jump);
    EXPECT_EQ(findings[0].part, "left_lower_arm");
    EXPECT_THAT(findings[0].spans, ElementsAre(FrameSpan{40, 40}));
    EXPECT_NEAR(findings[0].worst, 80, 15);
}

TEST(CheckTurns, FindsAHeadingThatJumpsAndComesBack) {
    std::vector<Posture> postures = waving();
    const Quat aside = glm::angleAxis(50 * kDegree, Vec3(0, 1, 0));
    Posture& odd = postures[20];
    odd.hips = odd.spine[0] = odd.neck[0] = aside;
    for (auto& part : odd.parts)
        if (part) part = aside * *part;
    const std::vector<Finding> findings = check_turns(postures, 30);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].part, "hips");
    EXPECT_THAT(findings[0].spans, ElementsAre(FrameSpan{20, 21}));
}

TEST(CheckTurns, SaysThatAHandFlipsInTheSource) {
    std::vector<Posture> postures = waving();
    for (size_t t = 60; t < kFrames; ++t)
        postures[t][HumanJoint::right_hand] = *postures[t][HumanJoint::right_hand] * about_arm(170);
    const std::vector<Finding> findings = check_turns(postures, 30);
    ASSERT_THAT(findings, SizeIs(1));
    const Judgement judgement = judge(findings, {.frames = kFrames, .fps = 30});
    EXPECT_EQ(judgement.verdict, Verdict::look_first);
    EXPECT_EQ(judgement.reasons[0].text,
              "right_hand flips by up to 170 degrees from one frame to the next in frame 60, in the source");
}

TEST(CheckHand, SpeaksOfTheAvatarWhereTheSourceHasNoFlip) {
    std::vector<Quat> turns(kFrames, kNoTurn);
    turns[31] = about_arm(150);
    turns[50] = about_arm(100);
    const Finding finding = check_hand(turns, "left hand of the avatar");
    EXPECT_THAT(finding.spans, ElementsAre(FrameSpan{31, 32}));
    EXPECT_THAT(judge({finding}, {.frames = kFrames, .fps = 30}).reasons[0].text,
                HasSubstr("left hand of the avatar flips by up to 150 degrees"));
}

TEST(CheckTurns, FindsToesThatTurnRound) {
    std::vector<Posture> postures = waving();
    for (size_t t = 30; t < 50; ++t)
        postures[t][HumanJoint::left_foot] = glm::angleAxis(140 * kDegree, Vec3(0, 1, 0));
    std::vector<std::string> parts;
    for (const Finding& finding : check_turns(postures, 30)) parts.push_back(finding.part);
    EXPECT_THAT(parts, ElementsAre("left_foot", "left_toes"));
}

TEST(CheckTurns, FindsShouldersThatAreTurnedTooFarAgainstTheHips) {
    std::vector<Posture> postures = waving();
    for (size_t t = 0; t < kFrames; ++t) {
        const float degrees = 110 * std::min(1.0f, float(t) / 45);
        postures[t].spine = {glm::angleAxis(degrees * kDegree, Vec3(0, 1, 0))};
        postures[t].neck = postures[t].spine;
        for (const LimbParts& arm : kArms)
            for (const HumanJoint part : {arm.upper, arm.lower, arm.end})
                postures[t][part] = postures[t].spine[0] * *postures[t][part];
    }
    const std::vector<Finding> findings = check_turns(postures, 30);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].check, Check::trunk_twist);
    EXPECT_NEAR(findings[0].worst, 110, 0.1);
    EXPECT_EQ(findings[0].spans[0].last, kFrames - 1);
    EXPECT_THAT(judge(findings, {.frames = kFrames, .fps = 30}).reasons[0].text,
                HasSubstr("shoulders are turned by up to 110 degrees against the hips in frames "));
}

// Both feet on the floor.
std::vector<Soles> standing_soles() {
    return std::vector<Soles>(
        kFrames, Soles{Vec3(0.1f, 0, 0), Vec3(0.1f, 0, 0.15f), Vec3(-0.1f, 0, 0), Vec3(-0.1f, 0, 0.15f)});
}

TEST(CheckFeet, FindsAFootThatSlidesWhileItStands) {
    std::vector<Soles> soles = standing_soles();
    EXPECT_THAT(check_feet(soles, 30), IsEmpty());
    for (size_t t = 31; t < kFrames; ++t)
        for (const size_t point : {2u, 3u}) soles[t][point].x -= 0.02f * float(std::min<size_t>(t, 60) - 30);
    const std::vector<Finding> findings = check_feet(soles, 30);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].part, "right_foot");
    EXPECT_THAT(findings[0].spans, ElementsAre(FrameSpan{31, 60}));
    EXPECT_NEAR(findings[0].worst, 0.6, 0.01);
    EXPECT_THAT(judge(findings, {.frames = kFrames, .fps = 30}).reasons[0].text,
                HasSubstr("right_foot slides over the floor in frames 31 to 60, at up to 0.60 m/s"));
}

TEST(CheckFeet, FindsFeetThatHoverLongerThanAnybodyJumps) {
    std::vector<Soles> soles = standing_soles();
    const auto raise = [&](size_t from, size_t to) {
        for (size_t t = from; t < to; ++t)
            for (Vec3& point : soles[t]) point.y += 0.2f;
    };
    raise(10, 28);  // 0.6 s
    EXPECT_THAT(check_feet(soles, 30), IsEmpty()) << "a jump";
    raise(40, 75);
    const std::vector<Finding> findings = check_feet(soles, 30);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].check, Check::hover);
    EXPECT_THAT(findings[0].spans, ElementsAre(FrameSpan{40, 74}));
    EXPECT_THAT(judge(findings, {.frames = kFrames, .fps = 30}).reasons[0].text,
                HasSubstr("feet hover in frames 40 to 74, up to 0.20 m above the floor"));
}

}  // namespace
}  // namespace chironomia
