#include "scenes/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/files.h"
#include "core/json.h"
#include "tests/scenes/stick_figure.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::refusal_of;
using testing::stick_figure;
using testing::TemporaryFolder;

const RenderSize kSize{1280, 720};

// The refusal of a scene file with this text, without the file's name in front.
std::string refusal_of_text(const std::string& text) {
    const TemporaryFolder folder;
    const std::string file = (folder / "scene.json").string();
    write_text(file, text);
    const std::string refusal = refusal_of([&] { make_scene(file, stick_figure(1.7f), kSize); });
    EXPECT_TRUE(refusal.starts_with(file + ": ")) << refusal;
    return refusal.substr(std::min(refusal.size(), file.size() + 2));
}

Scene scene_of_text(const std::string& text) {
    const TemporaryFolder folder;
    write_text(folder / "scene.json", text);
    return make_scene((folder / "scene.json").string(), stick_figure(1.7f), kSize);
}

TEST(MakeScene, ReadsEveryBundledScene) {
    for (const std::string& name : scene_names()) {
        const Scene scene = make_scene(name, stick_figure(1.7f), kSize);
        EXPECT_EQ(scene.lights.size(), 3u);
        EXPECT_TRUE(scene.lights[0].casts_shadow);
        // The key light comes from the viewer's upper left, in front of the figure.
        EXPECT_LT(scene.lights[0].towards.x, -0.3f);
        EXPECT_GT(scene.lights[0].towards.y, 0.4f);
        EXPECT_GT(scene.lights[0].towards.z, 0.3f);
        EXPECT_NEAR(length(scene.lights[0].towards), 1, 1e-5);
        EXPECT_TRUE(std::filesystem::exists(testing::source_dir() / "scenes" / (name + ".json")));
    }
}

TEST(MakeScene, TakesWhatAFileLeavesOutFromTheUpperScene) {
    const Scene upper = make_scene("upper", stick_figure(1.7f), kSize);
    const Scene empty = scene_of_text("{}");
    EXPECT_EQ(empty.camera.eye, upper.camera.eye);
    EXPECT_EQ(empty.lights.size(), upper.lights.size());
    const Scene green = scene_of_text(R"({"backdrop": {"top": "#00ff00"}})");
    EXPECT_EQ(green.backdrop_top, Vec3(0, 1, 0));
    EXPECT_EQ(green.backdrop_bottom, upper.backdrop_bottom);
}

TEST(MakeScene, ReadsColoursAsSrgb) {
    const Scene scene = scene_of_text(R"({"floor": {"colour": "#bc0080"}})");
    EXPECT_NEAR(scene.floor_colour.r, 0.5, 0.003);  // 188 is half the light
    EXPECT_EQ(scene.floor_colour.g, 0);
    EXPECT_NEAR(scene.floor_colour.b, 0.216, 0.001);
}

TEST(MakeScene, PutsTheCameraWhereTheFileSays) {
    const Scene scene =
        scene_of_text(R"({"camera": {"eye": [1, 2, 3], "target": [0, 1, 0], "fov_deg": 90}})");
    EXPECT_EQ(scene.camera.eye, Vec3(1, 2, 3));
    EXPECT_EQ(scene.camera.target, Vec3(0, 1, 0));
    EXPECT_NEAR(scene.camera.fov_y, kPi / 2, 1e-6);
}

TEST(MakeScene, TurnsTheLightsWithTheCamera) {
    const Scene scene =
        scene_of_text(R"({"camera": {"yaw_deg": 90}, "lights": [{"azimuth_deg": 90, "elevation_deg": 0,
        "colour": "#ffffff", "strength": 2, "shadow": false, "softness_deg": 1, "wrap": 0}]})");
    // The camera stands at the figure's left, +x; the viewer's right is then -z.
    EXPECT_GT(scene.camera.eye.x, 1);
    EXPECT_NEAR(scene.lights[0].towards.z, -1, 1e-5);
    EXPECT_EQ(scene.lights[0].radiance, Vec3(2));
}

TEST(MakeScene, StandsTheFloorUnderTheSoles) {
    Avatar avatar = stick_figure(1.7f);
    avatar.skeleton.joints[0].rest.translation.y = 0.25f;
    EXPECT_NEAR(make_scene("full", avatar, kSize).floor_height, 0.25, 1e-6);
}

TEST(MakeScene, RefusesAnUnknownName) {
    const auto refusal = [](const char* name) {
        return refusal_of([&] { make_scene(name, stick_figure(1.7f), kSize); });
    };
    EXPECT_EQ(refusal("uper"),
              "scene \"uper\": there is no such scene; did you mean upper? choose one of full, head, upper, "
              "or name a "
              "JSON file");
    EXPECT_EQ(refusal("none.json"), "none.json: there is no such file; check the path");
}

TEST(MakeScene, RefusesWhatAFileMustNotHold) {
    EXPECT_EQ(refusal_of_text(R"({"camra": {}})"),
              "camra: unknown key; did you mean camera? use one of $schema, camera, lights, ambient, floor, "
              "backdrop");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"framming": "full"}})"),
              "camera.framming: unknown key; did you mean framing? use one of framing, fov_deg, yaw_deg, "
              "pitch_deg, "
              "zoom, eye, target");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"framing": "torso"}})"),
              "camera.framing: \"torso\" is no framing; choose full, head or upper");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"fov_deg": 0}})"),
              "camera.fov_deg: 0 is out of range; give a number from 5 to 120");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"eye": [0, 1, 2]}})"), "camera.target: is missing; add it");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"eye": [0, 1], "target": [0, 0, 0]}})"),
              "camera.eye: [0,1] is no place; write it as [x, y, z] in metres");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"eye": [0, "1", 0], "target": [0, 0, 0]}})"),
              "camera.eye[1]: \"1\" is out of range; give a number from -1000 to 1000");
    EXPECT_EQ(
        refusal_of_text(R"({"camera": {"eye": [0, 9, 0], "target": [0, 0, 0]}})"),
        "camera.eye: lies straight above or below the target, up has no meaning there; move it sideways");
    EXPECT_EQ(refusal_of_text(R"({"backdrop": {"top": "blue"}})"),
              "backdrop.top: \"blue\" is no colour; write it as \"#rrggbb\"");
    EXPECT_EQ(refusal_of_text(R"({"floor": {"visible": "yes"}})"),
              "floor.visible: \"yes\" is no answer; write true or false");
    EXPECT_EQ(refusal_of_text(R"({"lights": {}})"), "lights: {} is no list; write it as [...]");
    EXPECT_EQ(refusal_of_text(R"({"lights": [{"azimuth_deg": 0}]})"),
              "lights[0].elevation_deg: is missing; add it");
    EXPECT_EQ(refusal_of_text(R"({"floor": 3})"), "floor: 3 is no object; write it as {...}");
    EXPECT_EQ(refusal_of_text("[1]"), "[1] is no object; write it as {...}");
}

// The published schema allows the keys that the reader knows, no more and no less.
TEST(SceneSchema, KnowsTheKeysOfTheUpperScene) {
    const Json schema = read_json(testing::source_dir() / "scenes/scene.schema.json");
    const Json upper = read_json(testing::source_dir() / "scenes/upper.json");
    const Json& properties = schema.at("properties");
    EXPECT_EQ(properties.size(), upper.size());
    for (const auto& [key, value] : upper.items()) {
        ASSERT_TRUE(properties.contains(key)) << key;
        if (!value.is_object()) continue;
        for (const auto& [inner, unused] : value.items()) {
            EXPECT_TRUE(properties.at(key).at("properties").contains(inner)) << key << "." << inner;
        }
    }
    for (const auto& [key, unused] : upper.at("lights")[0].items()) {
        EXPECT_TRUE(properties.at("lights").at("items").at("properties").contains(key)) << key;
    }
}

}  // namespace
}  // namespace chironomia
