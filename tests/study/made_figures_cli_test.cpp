// Avatars as programs write them, and damaged ones, through the real binary: each is drawn as the plain one, or refused
// with its message and exit code 3.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "tests/skinning/gltf/made_figures.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using testing::DamagedFigure;
using testing::FigureForm;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

// difference of a channel that is none of rounding or of a hidden edge [levels of 255]
constexpr int kNoticed = 8;

class MadeFiguresCli : public ::testing::Test {
  protected:
    fs::path frames() const { return folder_ / "frames"; }

    Outcome render(const fs::path& avatar) const {
        fs::remove_all(frames());
        return run_chironomia({"render", "--quiet", "--motion",
                               (testing::source_dir() / "tests/fixtures/gestures/wave.bvh").string(),
                               "--avatar", avatar.string(), "--scene", "full", "--size", "64x64", "--frames",
                               "20:21", "--out", (frames() / "%d.png").string()});
    }

    Frame picture_of(const FigureForm& form) const {
        const fs::path avatar = folder_ / (form.as_text ? "x.gltf" : "x.glb");
        if (form.as_text)
            made_figure(form).write_gltf(avatar);
        else
            made_figure(form).write_glb(avatar);
        const Outcome outcome = render(avatar);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read_image(frames() / "0.png");
    }

    TemporaryFolder folder_;
};

// The share of the pixels in which two pictures differ.
double difference(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    size_t differing = 0;
    for (size_t n = 0; n + 3 < a.rgba.size(); n += 4) {
        for (size_t c = n; c < n + 3; ++c) {
            if (std::abs(a.rgba[c] - b.rgba[c]) <= kNoticed) continue;
            ++differing;
            break;
        }
    }
    return static_cast<double>(4 * differing) / static_cast<double>(a.rgba.size());
}

TEST_F(MadeFiguresCli, AreDrawnTheSameHoweverTheyAreWritten) {
    const Frame plain = picture_of({});
    // The figure is seen: without its colour many pixels are others.
    EXPECT_GT(difference(picture_of({.textured = false}), plain), 0.02);
    for (const std::string& kind : testing::figure_kinds()) {
        if (kind == "no_material" || kind == "no_normals") continue;  // which look different
        SCOPED_TRACE(kind);
        EXPECT_LT(difference(picture_of(testing::figure_of_kind(kind)), plain), 0.005);
    }
}

// A copy of the figure, 0.8 m to its left, on an armature of its own.
void add_another_person(testing::GltfBuilder& file) {
    Json& nodes = file.json["nodes"];
    const size_t joints = nodes.size() - 1;
    for (size_t j = 0; j < joints; ++j) {
        Json node = nodes[j];
        node["name"] = format("other {}", j);
        if (j == 0) node["translation"][0] = node["translation"][0].get<float>() + 0.8f;
        for (Json& child : node["children"]) child = child.get<size_t>() + joints + 1;
        if (node["children"].is_null()) node.erase("children");
        nodes.push_back(std::move(node));
    }
    nodes.push_back({{"name", "Bob"}, {"mesh", 1}, {"skin", 1}});
    file.json["meshes"].push_back(file.json["meshes"][0]);
    file.json["meshes"][1]["name"] = "Bob";
    Json skin = file.json["skins"][0];
    for (Json& joint : skin["joints"]) joint = joint.get<size_t>() + joints + 1;
    file.json["skins"].push_back(std::move(skin));
    file.json["scenes"][0]["nodes"].push_back(joints + 1);
    file.json["scenes"][0]["nodes"].push_back(nodes.size() - 1);
}

TEST_F(MadeFiguresCli, AreShownAloneWhereSomebodyElseStandsInTheFile) {
    const Frame alone = picture_of({});
    testing::GltfBuilder file = testing::made_figure({});
    add_another_person(file);
    file.write_glb(folder_ / "x.glb");
    const Outcome outcome = render(folder_ / "x.glb");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("x.glb: 1 of its meshes (Bob) hang on no joint of the figure"));
    EXPECT_EQ(read_image(frames() / "0.png").rgba, alone.rgba);
}

// As Blender writes an armature that was mirrored by a scale of -1: what is named left stands on the right.
TEST_F(MadeFiguresCli, AreDrawnWholeBelowAMirroredNode) {
    const Frame plain = picture_of({.textured = false});
    testing::GltfBuilder file = testing::made_figure({.textured = false});
    Json& nodes = file.json["nodes"];
    nodes.push_back({{"name", "Armature"}, {"scale", {-1, 1, 1}}, {"children", {0}}});
    file.json["scenes"][0]["nodes"][0] = nodes.size() - 1;
    file.write_glb(folder_ / "x.glb");
    const Outcome outcome = render(folder_ / "x.glb");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_LT(difference(read_image(frames() / "0.png"), plain), 0.005);
}

// "mixamorig:LeftArm" is "DEF-upper_arm.L".
std::string rigify_name(std::string name) {
    static const std::map<std::string, std::string> kNames = {
        {"Hips", "spine"},    {"Spine", "spine.003"}, {"Neck", "spine.004"}, {"Head", "spine.006"},
        {"Arm", "upper_arm"}, {"ForeArm", "forearm"}, {"Hand", "hand"},      {"UpLeg", "thigh"},
        {"Leg", "shin"},      {"Foot", "foot"},       {"ToeBase", "toe"}};
    name = name.substr(name.find(':') + 1);
    std::string side;
    for (const std::string word : {"Left", "Right"}) {
        if (!name.starts_with(word)) continue;
        side = word == "Left" ? ".L" : ".R";
        name = name.substr(word.size());
    }
    return "DEF-" + kNames.at(name) + side;
}

// The joints of the figure by their numbers: hips 0, spine 1, neck 2, arms 4 and 7, legs 10 and 14.
// With the deform joints of Rigify as Blender exports them: the trunk beside the arms and legs, which hang from the
// joints that Rigify's controls move; or, where deform joints alone were exported, from the armature.
testing::GltfBuilder rigify_figure(bool with_controls) {
    testing::GltfBuilder file = testing::made_figure({});
    Json& nodes = file.json["nodes"];
    const size_t mesh_node = nodes.size() - 1;
    for (size_t j = 0; j < mesh_node; ++j) nodes[j]["name"] = rigify_name(nodes[j]["name"]);
    nodes[0]["children"] = {1};
    nodes[1]["children"] = {2};
    Json armature = {{"name", "rig"}, {"children", {0}}};
    if (with_controls) {
        nodes.push_back({{"name", "ORG-spine"},
                         {"translation", nodes[0]["translation"]},
                         {"children", {10, 14, nodes.size() + 1}}});
        nodes.push_back(
            {{"name", "ORG-spine.003"}, {"translation", nodes[1]["translation"]}, {"children", {4, 7}}});
        armature["children"].push_back(nodes.size() - 2);
    } else {
        for (const size_t limb : {4, 7, 10, 14}) {
            for (size_t axis = 0; axis < 3; ++axis) {
                float place = nodes[limb]["translation"][axis].get<float>();
                place += nodes[0]["translation"][axis].get<float>();
                if (limb < 10) place += nodes[1]["translation"][axis].get<float>();
                nodes[limb]["translation"][axis] = place;
            }
            armature["children"].push_back(limb);
        }
    }
    nodes.push_back(std::move(armature));
    file.json["scenes"][0]["nodes"][0] = nodes.size() - 1;
    return file;
}

TEST_F(MadeFiguresCli, AreDrawnWholeWithRigifysDeformJointsInPieces) {
    const Frame plain = picture_of({});
    for (const bool with_controls : {true, false}) {
        SCOPED_TRACE(with_controls ? "below its controls" : "alone");
        rigify_figure(with_controls).write_glb(folder_ / "x.glb");
        const Outcome outcome = render(folder_ / "x.glb");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_LT(difference(read_image(frames() / "0.png"), plain), 0.005);
        const Outcome info = run_chironomia({"info", (folder_ / "x.glb").string()});
        EXPECT_THAT(info.out, HasSubstr("they were hung from one another"));
        EXPECT_THAT(info.out, HasSubstr("DEF-spine.003"));
    }
}

// Blender writes each action of a file, in the order of their names.
TEST_F(MadeFiguresCli, MoveByTheFirstAnimationThatIsNotStill) {
    testing::GltfBuilder file = testing::made_figure({});
    add_animation(file, {.times = {0}, .values = {0, 1, 0}}, "A-pose");
    add_animation(file, {.times = {0, 0.5f, 1}, .values = {0, 1, 0, 0, 1.1f, 0, 0, 1, 0}}, "Talk");
    file.write_glb(folder_ / "x.glb");
    const fs::path motion = folder_ / "x.h5";
    const Outcome made =
        run_chironomia({"convert", "--motion", (folder_ / "x.glb").string(), "--out", motion.string()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Outcome info = run_chironomia({"info", motion.string()});
    EXPECT_THAT(info.out, HasSubstr("3 frames at 2 frames/s"));
    EXPECT_THAT(info.out, HasSubstr("animation \"Talk\", number 2 of 2: those before it are still"));
}

TEST_F(MadeFiguresCli, MoveByTheAnimationThatIsChosen) {
    testing::GltfBuilder file = testing::made_figure({});
    add_animation(file, {.times = {0, 0.5f, 1}, .values = {0, 1, 0, 0, 1.1f, 0, 0, 1, 0}}, "Talk");
    add_animation(file, {.times = {0, 0.5f}, .values = {0, 1, 0, 0, 1.2f, 0}}, "Nod");
    file.write_glb(folder_ / "x.glb");
    const fs::path out = folder_ / "x.h5";
    const auto convert = [&](const fs::path& motion, const std::string& animation) {
        fs::remove(out);
        return run_chironomia(
            {"convert", "--motion", motion.string(), "--animation", animation, "--out", out.string()});
    };
    for (const char* asked : {"Nod", "1"}) {
        const Outcome made = convert(folder_ / "x.glb", asked);
        ASSERT_EQ(made.exit_code, 0) << made.err;
        const Outcome info = run_chironomia({"info", out.string()});
        EXPECT_THAT(info.out, HasSubstr("2 frames at 2 frames/s"));
        EXPECT_THAT(info.out, HasSubstr("animation \"Nod\", number 2 of 2"));
    }
    const Outcome none = convert(folder_ / "x.glb", "Wave");
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_THAT(none.err, HasSubstr("x.glb: has no animation \"Wave\"; choose one of 0 \"Talk\", 1 \"Nod\""));
    const Outcome bvh = convert(testing::source_dir() / "assets/samples/expressive/simple-idea.bvh", "Nod");
    EXPECT_EQ(bvh.exit_code, 3);
    EXPECT_THAT(
        bvh.err,
        HasSubstr("simple-idea.bvh: an animation was chosen, which glTF files alone have; leave it out"));
}

TEST_F(MadeFiguresCli, AreRefusedWhenTheyAreDamaged) {
    std::set<std::string> seen;
    for (const DamagedFigure& figure : testing::damaged_figures(200, 24)) {
        if (!seen.insert(figure.kind).second) continue;
        SCOPED_TRACE(figure.kind);
        write_bytes(folder_ / "x.glb", std::as_bytes(std::span(figure.glb)));
        const Outcome outcome = render(folder_ / "x.glb");
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_THAT(outcome.out, IsEmpty());
        EXPECT_THAT(outcome.err, HasSubstr((folder_ / "x.glb").string() + ": "));
        EXPECT_THAT(outcome.err, HasSubstr(figure.message));
        EXPECT_FALSE(fs::exists(frames()));
    }
}

}  // namespace
}  // namespace chironomia::study
