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
#include "core/math.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia {
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

}  // namespace
}  // namespace chironomia
