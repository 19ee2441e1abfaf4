// Motions whose files hide how the body stands, put onto an avatar by the real binary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/math.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

// The bones of a person that stands with slightly bent knees, without any turn: each lies along the axis of its own
// joint, +x on the left and in the middle, -x on the right.
class OwnAxesBvh {
  public:
    // `knee`: how far the knees are bent [degrees].
    explicit OwnAxesBvh(double knee) {
        turns_ = {{"Hips", {90, 0, 0}},
                  {"Spine", {0, 90, 0}},
                  {"Shoulder_L", {0, 0, -90}},
                  {"Shoulder_R", {0, 0, -90}},
                  {"UpperArm_L", {0, 0, -80}},
                  {"UpperArm_R", {0, 0, 80}},
                  {"LowerArm_L", {20, 0, 0}},
                  {"LowerArm_R", {-20, 0, 0}},
                  {"UpperLeg_L", {180, 0, -knee / 2}},
                  {"UpperLeg_R", {180, 0, 180 - knee / 2}},
                  {"LowerLeg_L", {0, 0, knee}},
                  {"LowerLeg_R", {0, 0, knee}},
                  {"Foot_L", {0, 0, -66 - knee / 2}},
                  {"Foot_R", {0, 0, -66 - knee / 2}},
                  {"Toes_L", {0, 0, -24}},
                  {"Toes_R", {0, 0, -24}}};
    }

    void write(const fs::path& file) {
        text_ =
            "HIERARCHY\nROOT Hips\n{\nOFFSET 0 93 0\nCHANNELS 6 Xposition Yposition Zposition "
            "Zrotation Xrotation Yrotation\n";
        frame_ = "0 93 0 90 0 0";
        chain({{"Spine", "16 0 0"}, {"Chest", "9 0 0"}}, false);
        chain({{"Neck", "16 0 0"}, {"Head", "6.5 0 0"}, {"", "10 0 0"}}, true);
        for (const int side : {1, -1}) {
            const std::string end = side > 0 ? "_L" : "_R";
            chain({{"Shoulder" + end, format("13 0 {}", 5 * side)},
                   {"UpperArm" + end, format("{} 0 0", 5.3 * side)},
                   {"LowerArm" + end, format("{} 0 0", 24 * side)},
                   {"Hand" + end, format("{} 0 0", 22 * side)},
                   {"", format("{} 0 0", 5 * side)}},
                  true);
        }
        text_ += "}\n}\n";
        for (const int side : {1, -1}) {
            const std::string end = side > 0 ? "_L" : "_R";
            chain({{"UpperLeg" + end, format("-2 {} 0", -6.5 * side)},
                   {"LowerLeg" + end, format("{} 0 0", 39 * side)},
                   {"Foot" + end, format("{} 0 0", 41 * side)},
                   {"Toes" + end, format("{} 0 0", 12 * side)},
                   {"", format("{} 0 0", 5 * side)}},
                  true);
        }
        text_ += "}\nMOTION\nFrames: 20\nFrame Time: 0.0333333\n";
        for (int t = 0; t < 20; ++t) text_ += frame_ + "\n";
        write_text(file, text_);
    }

  private:
    struct Bone {
        std::string name;  // "": an end site
        std::string offset;
    };

    void chain(const std::vector<Bone>& bones, bool closed) {
        for (const Bone& bone : bones) {
            if (bone.name.empty()) {
                text_ += format("End Site\n{{\nOFFSET {}\n}}\n", bone.offset);
                continue;
            }
            text_ += format("JOINT {}\n{{\nOFFSET {}\nCHANNELS 3 Zrotation Xrotation Yrotation\n", bone.name,
                            bone.offset);
            const auto turn = turns_.find(bone.name);
            frame_ += turn == turns_.end()
                          ? " 0 0 0"
                          : format(" {} {} {}", turn->second[0], turn->second[1], turn->second[2]);
        }
        if (!closed) return;
        for (const Bone& bone : bones) text_ += bone.name.empty() ? "" : "}\n";
    }

    std::map<std::string, std::array<double, 3>> turns_;
    std::string text_, frame_;
};

// Where the joints of the mannequin are in the last frame when it takes on the motion [m].
std::map<std::string, Vec3> places_on_avatar(const fs::path& motion, const TemporaryFolder& folder) {
    const std::string glb = (folder / "on_avatar.glb").string(), table = (folder / "places.csv").string();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"convert", "--motion", motion.string(), "--out", glb},
          {"convert", "--motion", glb, "--out", table}}) {
        const Outcome outcome = run_chironomia(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    const std::string text = read_text(table);
    const std::vector<std::string_view> lines = split(trim(text), '\n');
    const std::vector<std::string_view> names = split(lines.front(), ','), cells = split(lines.back(), ',');
    std::map<std::string, Vec3> places;
    for (size_t c = 0; c < names.size(); ++c) {
        const std::string_view name = trim(names[c]);
        if (name.size() < 3 || name[name.size() - 2] != '_' || name.back() < 'x' || name.back() > 'z')
            continue;
        places[std::string(name.substr(0, name.size() - 2))][name.back() - 'x'] =
            std::stof(std::string(cells[c]));
    }
    return places;
}

// How far a foot points below the floor [degrees].
float slope_of(const std::map<std::string, Vec3>& places, const std::string& side) {
    const Vec3 foot = places.at(side + "_toe") - places.at(side + "_ankle");
    EXPECT_GT(foot.z, 0) << side;
    return glm::degrees(std::atan2(-foot.y, std::hypot(foot.x, foot.z)));
}

// Both feet of the file slope alike, although the bones of the right leg lie along the other direction of their axes.
// The knees show the roll of the legs when they bend by more than 15 degrees, the feet when they do not.
TEST(RetargetCli, StandsOnBothFeetWhereTheRightLegHasTheOtherSign) {
    for (const double knee : {8.0, 30.0}) {
        const TemporaryFolder folder;
        OwnAxesBvh(knee).write(folder / "own_axes.bvh");
        const auto places = places_on_avatar(folder / "own_axes.bvh", folder);
        EXPECT_NEAR(slope_of(places, "left"), slope_of(places, "right"), 1) << knee;
        EXPECT_LT(slope_of(places, "right"), 25) << knee;
        EXPECT_NEAR(places.at("left_toe").y, places.at("right_toe").y, 0.002) << knee;
    }
}

// A person who stands and faces the front, in six channels a joint; pelvis, chest and head are turned aside by so many
// degrees, and the places of the joints that hang from them, and the turns of the limbs, make up for it.
std::string aside_bvh(int degrees) {
    const double cosine = std::cos(degrees * kPi / 180), sine = std::sin(degrees * kPi / 180);
    const auto turned_back = [&](double x, double y, double z) {
        return format("{:.4f} {:.4f} {:.4f}", cosine * x - sine * z, y, sine * x + cosine * z);
    };
    std::string text = "HIERARCHY\n", frame;
    const auto open = [&](const char* name, const Vec3& offset, const std::string& now,
                          const std::string& turn) {
        text += format(
            "{} {}\n{{\nOFFSET {} {} {}\nCHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation "
            "Zrotation\n",
            frame.empty() ? "ROOT" : "JOINT", name, offset.x, offset.y, offset.z);
        frame += format("{}{} {}", frame.empty() ? "" : " ", now, turn);
    };
    const auto at = [](const Vec3& offset) { return format("{} {} {}", offset.x, offset.y, offset.z); };
    const std::string none = "0 0 0", back = format("{} 0 0", -degrees);
    const auto limb = [&](const std::array<const char*, 3>& names, const std::array<Vec3, 4>& bones) {
        open(names[0], bones[0], turned_back(bones[0].x, bones[0].y, bones[0].z), back);
        open(names[1], bones[1], at(bones[1]), none);
        open(names[2], bones[2], at(bones[2]), none);
        text += format("End Site\n{{\nOFFSET {}\n}}\n}}\n}}\n}}\n", at(bones[3]));
    };
    open("Hips", {0, 95, 0}, "0 95 0", format("{} 0 0", degrees));
    open("Spine", {0, 10, 0}, "0 10 0", none);
    open("Chest", {0, 20, 0}, "0 20 0", none);
    open("Neck", {0, 22, 0}, "0 22 0", none);
    open("Head", {0, 10, 0}, "0 10 0", none);
    text += "End Site\n{\nOFFSET 0 20 0\n}\n}\n}\n";
    limb({"LeftArm", "LeftForeArm", "LeftHand"},
         {Vec3(18, 15, 0), Vec3(28, 0, 0), Vec3(25, 0, 0), Vec3(10, 0, 0)});
    limb({"RightArm", "RightForeArm", "RightHand"},
         {Vec3(-18, 15, 0), Vec3(-28, 0, 0), Vec3(-25, 0, 0), Vec3(-10, 0, 0)});
    text += "}\n}\n";
    limb({"LeftUpLeg", "LeftLeg", "LeftFoot"},
         {Vec3(9, -3, 0), Vec3(0, -42, 0), Vec3(0, -42, 0), Vec3(0, -6, 14)});
    limb({"RightUpLeg", "RightLeg", "RightFoot"},
         {Vec3(-9, -3, 0), Vec3(0, -42, 0), Vec3(0, -42, 0), Vec3(0, -6, 14)});
    text += "}\nMOTION\nFrames: 20\nFrame Time: 0.0333333\n";
    for (int t = 0; t < 20; ++t) text += frame + "\n";
    return text;
}

// How far the line between two joints of a pair lies from left to right [degrees].
float aside_of(const std::map<std::string, Vec3>& places, const std::string& part) {
    const Vec3 line = places.at("left_" + part) - places.at("right_" + part);
    return glm::degrees(std::abs(std::atan2(line.z, line.x)));
}

TEST(RetargetCli, TakesTheTrunkFromItsJointsWhereTheTurnsContradictThem) {
    for (const int degrees : {0, 85, -85, 180}) {
        const TemporaryFolder folder;
        const fs::path motion = folder / "aside.bvh";
        write_text(motion, aside_bvh(degrees));
        const auto places = places_on_avatar(motion, folder);
        EXPECT_LT(aside_of(places, "hip"), 2) << degrees;
        EXPECT_LT(aside_of(places, "shoulder"), 2) << degrees;
        EXPECT_LT(aside_of(places, "eye"), 2) << degrees;
        EXPECT_LT(aside_of(places, "wrist"), 2) << degrees;

        const fs::path report = folder / "report.json";
        const Outcome outcome = run_chironomia({"convert", "--motion", motion.string(), "--report",
                                                report.string(), "--out", (folder / "b.glb").string()});
        const Json json = read_json(report);
        EXPECT_EQ(json.contains("trunk_faces_by_joints"), degrees != 0) << degrees;
        if (degrees == 0) {
            EXPECT_EQ(outcome.err, "");
            continue;
        }
        EXPECT_NEAR(json["trunk_faces_by_joints"]["pelvis_was_aside_deg"], std::abs(degrees), 0.5);
        EXPECT_NEAR(json["trunk_faces_by_joints"]["chest_was_aside_deg"], std::abs(degrees), 0.5);
        EXPECT_EQ(
            outcome.err,
            format(
                "{}: its turns contradict its joints: in most frames it turns its pelvis {} degrees aside from "
                "its hip joints and its chest {} degrees aside from its shoulders; the trunk was turned to "
                "where the joints lie\n",
                motion.string(), std::abs(degrees), std::abs(degrees)));
    }
}

}  // namespace
}  // namespace chironomia::study
