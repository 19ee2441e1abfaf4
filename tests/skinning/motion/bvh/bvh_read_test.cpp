#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/text.h"
#include "skinning/motion/bvh/bvh.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

// One turning root with a child; four channels of the child let it move, too.
const std::string kHierarchy =
    "HIERARCHY\n"
    "ROOT Hips\n"
    "{\n"
    "  OFFSET 1 2 3\n"
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "  JOINT Head\n"
    "  {\n"
    "    OFFSET 0 10 0\n"
    "    CHANNELS 2 Yrotation Xrotation\n"
    "    End Site\n"
    "    {\n"
    "      OFFSET 0 5 0\n"
    "    }\n"
    "  }\n"
    "}\n";
const std::string kMotion =
    "MOTION\n"
    "Frames: 2\n"
    "Frame Time: 0.0333333\n"
    "10 20 30 90 0 0 0 0\n"
    "11 21 31 0 0 0 90 90\n";

Motion parse(const std::string& text) {
    return parse_bvh(text, "a.bvh");
}

std::string refusal(const std::string& text) {
    return refusal_of([&] { parse(text); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

float far_apart(const Vec3& a, const Vec3& b) {
    return distance(a, b);
}

TEST(ParseBvh, ReadsJointsFramesAndRate) {
    const Motion motion = parse(kHierarchy + kMotion);
    EXPECT_EQ(motion.frames, 2u);
    EXPECT_DOUBLE_EQ(motion.fps, 30);
    ASSERT_EQ(motion.joints->skeleton.joints.size(), 3u);
    EXPECT_EQ(motion.joints->skeleton.joints[1].name, "Head");
    EXPECT_EQ(motion.joints->skeleton.joints[1].parent, 0);
    EXPECT_EQ(motion.joints->skeleton.joints[2].name, "Head_end");
    EXPECT_EQ(motion.joints->skeleton.joints[2].rest.translation, Vec3(0, 5, 0));
    EXPECT_EQ(motion.joints->turns.size(), 6u);
}

TEST(ParseBvh, TurnsBackwardsThroughTheChannels) {
    const Motion motion = parse(kHierarchy + kMotion);
    // A quarter turn about z brings +x to +y.
    EXPECT_LT(far_apart(motion.joints->turns[0] * Vec3(1, 0, 0), Vec3(0, 1, 0)), 1e-6f);
    // Yrotation stands first, so it is applied last: X brings +y to +z, then Y brings +z to +x.
    EXPECT_LT(far_apart(motion.joints->turns[3 + 1] * Vec3(0, 1, 0), Vec3(1, 0, 0)), 1e-6f);
}

TEST(ParseBvh, RootPositionsReplaceItsOffset) {
    const Motion motion = parse(kHierarchy + kMotion);
    EXPECT_EQ(motion.joints->translations[0], Vec3(10, 20, 30));
    EXPECT_EQ(motion.joints->translations[1], Vec3(0, 10, 0));
}

TEST(ParseBvh, RootPositionsThatLeaveOutAHighOffsetAreAdded) {
    std::string text = replaced(kHierarchy + kMotion, "OFFSET 1 2 3", "OFFSET 0 90 0");
    text = replaced(replaced(text, "10 20 30", "1 0 0"), "11 21 31", "2 0 0");
    const Motion motion = parse(text);
    EXPECT_EQ(motion.joints->translations[0], Vec3(1, 90, 0));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("added to its OFFSET")));
}

TEST(ParseBvh, PositionsOfOtherJointsReplaceTheirOffset) {
    std::string text =
        replaced(kHierarchy + kMotion, "CHANNELS 2 Yrotation", "CHANNELS 3 Yposition Yrotation");
    text = replaced(replaced(text, "90 0 0 0 0\n", "90 0 0 11 0 0\n"), "0 0 0 90 90", "0 0 0 9 90 90");
    const Motion motion = parse(text);
    EXPECT_EQ(motion.joints->translations[1], Vec3(0, 11, 0));
    EXPECT_EQ(motion.joints->translations[3 + 1], Vec3(0, 9, 0));
}

TEST(ParseBvh, PositionsOfOtherJointsThatStayNearZeroAreAdded) {
    std::string text =
        replaced(kHierarchy + kMotion, "CHANNELS 2 Yrotation", "CHANNELS 3 Yposition Yrotation");
    text = replaced(replaced(text, "90 0 0 0 0\n", "90 0 0 0.1 0 0\n"), "0 0 0 90 90", "0 0 0 0 90 90");
    const Motion motion = parse(text);
    EXPECT_EQ(motion.joints->translations[1], Vec3(0, 10.1f, 0));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("of the other joints are added to OFFSET")));
}

// The same motion however its text is laid out.
TEST(ParseBvh, ReadsEveryLayoutOfTheText) {
    const Motion plain = parse(kHierarchy + kMotion);
    const auto expect_same = [&](const std::string& text) {
        const Motion other = parse(text);
        EXPECT_EQ(other.joints->turns, plain.joints->turns);
        EXPECT_EQ(other.joints->translations, plain.joints->translations);
        EXPECT_EQ(other.fps, plain.fps);
    };
    const std::string text = kHierarchy + kMotion;
    std::string carriage;
    for (const char c : text) carriage += c == '\n' ? "\r\n" : std::string(1, c);
    expect_same(carriage);
    expect_same(replaced(text, "ROOT Hips\n{\n", "ROOT Hips {\n\n\n"));
    expect_same(replaced(text, "Frame Time: 0.0333333", "Frame Time:\t3.33333e-02"));
    expect_same(replaced(text, "Frames: 2", "Frames : 2"));
    expect_same(replaced(text, "10 20 30 90", "\t+10  2.0e1\t30. 90"));
    expect_same(replaced(text, "11 21 31", "\n\n11 21 31") + "\n  \n");
    expect_same(replaced(text, "HIERARCHY", "Hierarchy"));
    expect_same(replaced(text, "End Site", "End Site HeadTop"));
    expect_same(replaced(text, "    End Site\n    {", "\t\tEnd Site {"));
}

TEST(ParseBvh, KeepsNamesWithSpacesAndNamesThatComeTwice) {
    const Motion spaces = parse(replaced(kHierarchy, "JOINT Head", "JOINT Upper  Head \t") + kMotion);
    EXPECT_EQ(spaces.joints->skeleton.joints[1].name, "Upper  Head");
    const Motion twice = parse(replaced(kHierarchy, "JOINT Head", "JOINT Hips") + kMotion);
    EXPECT_THAT(twice.notes, Contains(HasSubstr("names of several joints: Hips")));
}

TEST(ParseBvh, TakesTheRateThatIsSetByHand) {
    const std::string text = replaced(kHierarchy + kMotion, "0.0333333", "0");
    EXPECT_DOUBLE_EQ(parse_bvh(text, "a.bvh", 25).fps, 25);
}

TEST(ParseBvh, RefusesWhatIsNoHierarchy) {
    EXPECT_THAT(refusal("x,y,z\n1,2,3\n"),
                HasSubstr("a.bvh:1: this is no BVH motion: it begins with \"x,y,z\""));
    EXPECT_THAT(refusal("HIERARCHY\nMOTION\n"), HasSubstr("a.bvh:2: the hierarchy has no ROOT"));
    EXPECT_THAT(refusal("HIERARCHY\n"), HasSubstr("the file ends before the word MOTION"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "ROOT", "JOINT") + kMotion),
                HasSubstr("a.bvh:2: \"JOINT\" stands outside the joints"));
    EXPECT_THAT(refusal("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\n"),
                HasSubstr("no joint has CHANNELS"));
}

TEST(ParseBvh, RefusesASecondFigure) {
    EXPECT_THAT(refusal(kHierarchy + "ROOT Other\n{\nOFFSET 0 0 0\n}\n" + kMotion),
                HasSubstr("a.bvh:16: a second ROOT \"Other\" after \"Hips\""));
}

TEST(ParseBvh, RefusesBracesThatDoNotMatch) {
    EXPECT_THAT(refusal(replaced(kHierarchy, "    }\n  }\n}\n", "    }\n  }\n") + kMotion),
                HasSubstr("the hierarchy ends inside joint \"Hips\" with 1 braces open"));
    EXPECT_THAT(refusal(kHierarchy + "}\n" + kMotion),
                HasSubstr("a.bvh:16: \"}\" stands outside the joints"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "ROOT Hips\n{\n", "ROOT Hips\n") + kMotion),
                HasSubstr("joint \"Hips\" is followed by \"OFFSET\", not by {"));
}

TEST(ParseBvh, RefusesBrokenJoints) {
    EXPECT_THAT(refusal(replaced(kHierarchy, "    OFFSET 0 10 0\n", "") + kMotion),
                HasSubstr("joint \"Head\" has no OFFSET"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "OFFSET 0 10 0", "OFFSET 0 nan 0") + kMotion),
                HasSubstr("a.bvh:8: OFFSET of joint \"Head\": \"nan\" is no number"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "OFFSET 0 10 0", "OFFSET 0 10 0\nOFFSET 0 10 0") + kMotion),
                HasSubstr("a.bvh:9: joint \"Head\" has a second OFFSET"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "JOINT Head", "JOINT") + kMotion),
                HasSubstr("a joint has no name"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "End Site", "End Effector") + kMotion),
                HasSubstr("\"End Effector\" is not known"));
    EXPECT_THAT(
        refusal(replaced(kHierarchy, "      OFFSET 0 5 0\n", "OFFSET 0 5 0\nEnd Site\n{\n") + kMotion),
        HasSubstr("an End Site inside an End Site"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "  JOINT Head", "  BONE Head") + kMotion),
                HasSubstr("\"BONE\" in joint \"Hips\" is not known"));
}

TEST(ParseBvh, RefusesBrokenChannels) {
    EXPECT_THAT(refusal(replaced(kHierarchy, "CHANNELS 2", "CHANNELS 3") + kMotion),
                HasSubstr("channel 3 of 3 of joint \"Head\" is \"End\""));
    EXPECT_THAT(refusal(replaced(kHierarchy, "CHANNELS 2", "CHANNELS x") + kMotion),
                HasSubstr("CHANNELS of joint \"Head\": \"x\" is no count"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "6 Xposition Yposition", "6 Xposition Xposition") + kMotion),
                HasSubstr("joint \"Hips\" has the channel Xposition twice"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "    End Site", "CHANNELS 1 Xrotation\nEnd Site") + kMotion),
                HasSubstr("joint \"Head\" has a second CHANNELS"));
    EXPECT_THAT(refusal(replaced(kHierarchy, "OFFSET 0 5 0", "OFFSET 0 5 0 CHANNELS 1 Xrotation") + kMotion),
                HasSubstr("the End Site of \"Head_end\" has CHANNELS"));
}

TEST(ParseBvh, RefusesRowsThatDoNotFit) {
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "Frames: 2", "Frames: 3")),
                HasSubstr("Frames says 3, but 2 rows follow"));
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "Frames: 2", "Frames: 999999999999")),
                HasSubstr("Frames says 999999999999, but 2 rows follow"));
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "10 20 30 90 0 0 0 0", "10 20 30 90 0 0 0")),
                HasSubstr("a.bvh:19: row 1 has 7 values, the joints have 8 channels"));
    EXPECT_THAT(refusal(kHierarchy + kMotion + "end of the file\n"),
                HasSubstr("a.bvh:21: \"end\" follows after row 2"));
}

TEST(ParseBvh, RefusesValuesThatAreNoNumbers) {
    const std::vector<std::pair<const char*, const char*>> words = {
        {"nan", "no finite number"},    {"-inf", "no finite number"},
        {"1.#IND", "no finite number"}, {"0x10", "no finite number"},
        {"1e999", "no finite number"},  {"1,5", "no number; numbers have a decimal point, not a comma"},
        {"1e12", "above 1e9, which no"}};
    for (const auto& [word, fault] : words) {
        EXPECT_THAT(
            refusal(replaced(kHierarchy + kMotion, "10 20 30 90", format("10 20 30 {}", word))),
            HasSubstr(format("a.bvh:19: row 1, Zrotation of joint \"Hips\": \"{}\" is {}", word, fault)));
    }
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "90 0 0 0 0\n", "90 0 0 0 0 x\n")),
                HasSubstr("value 1 after the last channel"));
}

TEST(ParseBvh, RefusesCountsAndRatesThatMeanNothing) {
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "Frames: 2", "Frames: 0")),
                HasSubstr("a.bvh:17: Frames is \"0\"; a count of at least 1 is expected"));
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "Frames: 2\n", "")),
                HasSubstr("\"Frames:\" is expected here, not \"Frame Time: 0.0333333\""));
    EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "Frame Time: 0.0333333\n", "")),
                HasSubstr("\"Frame Time:\" is expected here"));
    for (const char* time : {"0", "-0.1", "nan", "", "1e-320"}) {
        EXPECT_THAT(refusal(replaced(kHierarchy + kMotion, "0.0333333", time)),
                    HasSubstr(format(
                        "Frame Time is \"{}\"; a time above 0 s with a decimal point is expected", time)));
    }
    const std::string no_time = replaced(kHierarchy + kMotion, "0.0333333", "none");
    EXPECT_THAT(testing::refusal_of([&] { parse_bvh(no_time, "a.bvh", 5000); }),
                HasSubstr("Frame Time is none s, which are 5000 frames/s; a motion has 1 to 1000, or set"));
}

TEST(ParseBvh, SaysWhatAFrameTimeOfNoMotionProbablyMeans) {
    const auto with_time = [](const char* time) {
        return refusal(replaced(kHierarchy + kMotion, "0.0333333", time));
    };
    EXPECT_THAT(with_time("33.333"),
                HasSubstr("a.bvh:18: Frame Time is 33.333 s, which are 0.0300003 frames/s; a motion has 1 to "
                          "1000; it is probably in milliseconds: write 0.033333, or set the rate with "
                          "--motion-fps"));
    EXPECT_THAT(with_time("30"), HasSubstr("it is probably the rate: write 0.033333, or set"));
    EXPECT_THAT(with_time("1e9"), HasSubstr("which are 1e-09 frames/s; a motion has 1 to 1000, or set"));
    EXPECT_THAT(with_time("0.0009"), HasSubstr("a motion has 1 to 1000, or set"));
    const std::string text = replaced(kHierarchy + kMotion, "0.0333333", "33.333");
    EXPECT_DOUBLE_EQ(parse_bvh(text, "a.bvh", 30).fps, 30);
    EXPECT_DOUBLE_EQ(parse_bvh(replaced(kHierarchy + kMotion, "0.0333333", "1"), "a.bvh", {}).fps, 1);
    EXPECT_DOUBLE_EQ(parse_bvh(replaced(kHierarchy + kMotion, "0.0333333", ".001"), "a.bvh", {}).fps, 1000);
}

// Every beginning of a file is refused, whatever it cuts.
TEST(ParseBvh, RefusesEveryTruncation) {
    const std::string text = kHierarchy + kMotion;
    for (size_t length = 0; length < text.size() - 3; ++length) {
        EXPECT_THAT(refusal(text.substr(0, length)), HasSubstr("a.bvh:")) << length;
    }
}

}  // namespace
}  // namespace chironomia
