#include "scenes/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/render/camera.h"
#include "scenes/figures.h"
#include "scenes/framing.h"
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

TEST(MakeScene, ReadsEveryBundledSceneForOne) {
    for (const std::string name : {"full", "head", "object", "upper"}) {
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

TEST(SceneFile, IsTheBundledOneWhateverLiesInTheWorkingDirectory) {
    const TemporaryFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::create_directory(folder / "dyad");
    write_text(folder / "upper", "no scene");
    write_text(folder / "mine", "{}");
    std::filesystem::current_path(folder.path());
    for (const std::string name : {"dyad", "upper"})
        EXPECT_TRUE(std::filesystem::equivalent(scene_file(name),
                                                testing::source_dir() / "scenes" / (name + ".json")));
    EXPECT_EQ(scene_file("mine"), "mine");
    std::filesystem::current_path(before);
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
              "scene \"uper\": there is no such scene; did you mean upper? choose one of dyad, full, head, "
              "object, split, upper, or name a JSON file");
    EXPECT_EQ(refusal("none.json"), "none.json: there is no such file; check the path");
}

TEST(MakeScene, RefusesWhatAFileMustNotHold) {
    EXPECT_EQ(refusal_of_text(R"({"camra": {}})"),
              "camra: unknown key; did you mean camera? use one of $schema, camera, lights, ambient, floor, "
              "backdrop, places, split");
    EXPECT_EQ(
        refusal_of_text(R"({"camera": {"framming": "full"}})"),
        "camera.framming: unknown key; did you mean framing? use one of framing, fov_deg, yaw_deg, pitch_deg, "
        "zoom, eye, target");
    EXPECT_EQ(refusal_of_text(R"({"camera": {"framing": "torso"}})"),
              "camera.framing: \"torso\" is no framing; choose box, full, head or upper");
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
    EXPECT_EQ(refusal_of_text(R"({"camera": {"eye": [0, 1, 2], "target": [0, 1, 0], "zoom": 0.9}})"),
              "camera.zoom: changes nothing beside eye and target; leave it or them out");
    EXPECT_EQ(refusal_of_text(R"({"backdrop": {"top": "blue"}})"),
              "backdrop.top: \"blue\" is no colour; write it as \"#rrggbb\"");
    EXPECT_EQ(refusal_of_text(R"({"floor": {"visible": "yes"}})"),
              "floor.visible: \"yes\" is no answer; write true or false");
    EXPECT_EQ(refusal_of_text(R"({"lights": {}})"), "lights: {} is no list; write it as [...]");
    EXPECT_EQ(refusal_of_text(R"({"lights": [{"azimuth_deg": 0}]})"),
              "lights[0].elevation_deg: is missing; add it");
    EXPECT_EQ(refusal_of_text(R"({"floor": 3})"), "floor: 3 is no object; write it as {...}");
    EXPECT_EQ(refusal_of_text(R"({"places": []})"),
              "places: 0 places, a scene shows 1 to 2 people; list one place for each");
    EXPECT_EQ(refusal_of_text(R"({"places": [{"x": 0, "z": 0, "heading_deg": 200}]})"),
              "places[0].heading_deg: 200 is out of range; give a number from -180 to 180");
    EXPECT_EQ(refusal_of_text(R"({"places": [{"x": 0, "y": 0}]})"),
              "places[0].y: unknown key; did you mean x? use one of x, z, heading_deg");
    EXPECT_EQ(refusal_of_text(R"({"split": {"gap": 0.5, "colour": "#ffffff"}})"),
              "split.gap: 0.5 is out of range; give a number from 0 to 0.2");
    EXPECT_EQ(refusal_of_text(R"({"split": {"gap": 0, "colour": "#ffffff"},
                                  "places": [{"x": 0, "z": 0, "heading_deg": 0}]})"),
              "places: 1 place, but a split scene shows 2 people; list 2 places or none");
    EXPECT_EQ(refusal_of_text("[1]"), "[1] is no object; write it as {...}");
}

// The published schema allows the keys that the reader knows, no more and no less.
TEST(SceneSchema, KnowsTheKeysOfTheBundledScenes) {
    const Json schema = read_json(testing::source_dir() / "scenes/scene.schema.json");
    Json all;
    for (const std::string& name : scene_names()) {
        all.merge_patch(read_json(testing::source_dir() / "scenes" / (name + ".json")));
    }
    const Json& properties = schema.at("properties");
    EXPECT_EQ(properties.size(), all.size());
    for (const auto& [key, value] : all.items()) {
        ASSERT_TRUE(properties.contains(key)) << key;
        const Json& held = value.is_array() ? value[0] : value;
        if (!held.is_object()) continue;
        const Json& schema_of_key = value.is_array() ? properties.at(key).at("items") : properties.at(key);
        for (const auto& [inner, unused] : held.items()) {
            EXPECT_TRUE(schema_of_key.at("properties").contains(inner)) << key << "." << inner;
        }
    }
}

// How far a point lies from the middle of the picture to its nearest edge: 1 is the edge.
float outwards(const View& view, const Vec3& point) {
    const Vec2 pixel = pixel_of(view.scene.camera, view.size, point);
    const Vec2 half = Vec2(static_cast<float>(view.size.width), static_cast<float>(view.size.height)) * 0.5f;
    return std::max(std::abs(pixel.x / half.x - 1), std::abs(pixel.y / half.y - 1));
}

View view_of_box(const std::string& scene, const Bounds& box, RenderSize size = kSize) {
    const Avatar thing = stick_figure(1.7f);
    const Avatar* figure = &thing;
    return stage_scene(scene, std::span(&figure, 1), size, std::span(&box, 1)).views.at(0);
}

TEST(StageScene, FillsThePictureWithABoxAndPutsTheFloorUnderIt) {
    const Bounds box{.low = {-3, 1, -2}, .high = {1, 5, 6}};
    for (const RenderSize size : {kSize, RenderSize{480, 800}}) {
        const View view = view_of_box("object", box, size);
        EXPECT_EQ(view.scene.floor_height, 1);
        const Vec3 eye = view.scene.camera.eye - (box.low + box.high) * 0.5f;
        EXPECT_TRUE(eye.x > 0 && eye.y > 0 && eye.z > 0) << "from its left and from above";
        float farthest = 0;
        for (int i = 0; i < 8; ++i) {
            const Vec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                              i & 4 ? box.high.z : box.low.z);
            EXPECT_LT(outwards(view, corner), 0.95f);
            farthest = std::max(farthest, outwards(view, corner));
        }
        EXPECT_GT(farthest, 0.85f);
    }
}

TEST(StageScene, SeesAPlaneALineAndAPoint) {
    for (const Vec3 high : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0)}) {
        const View view = view_of_box("object", {.low = Vec3(0), .high = high});
        EXPECT_GT(distance(view.scene.camera.eye, high), 0.5f);
        EXPECT_LT(outwards(view, high), 0.95f);
        EXPECT_GT(view.scene.floor_reach, 0);
    }
}

// A mountain is seen as a molehill is, but from farther away.
TEST(StageScene, GrowsWithABox) {
    const View small = view_of_box("object", {.low = Vec3(-1), .high = Vec3(1)});
    const View large = view_of_box("object", {.low = Vec3(-1000), .high = Vec3(1000)});
    EXPECT_LT(distance(large.scene.camera.eye, small.scene.camera.eye * 1000.0f), 1);
    EXPECT_NEAR(large.scene.floor_reach / small.scene.floor_reach, 1000, 0.1);
}

TEST(StageScene, PutsABoxWhereTheSceneSays) {
    const TemporaryFolder folder;
    const std::string file = (folder / "scene.json").string();
    write_text(file, R"({"camera": {"framing": "box"}, "places": [{"x": 50, "z": 0, "heading_deg": 90}]})");
    // The figure stands at the origin and faces +z; what is before it lies at the viewer's right then.
    const View view = view_of_box(file, {.low = {-0.5f, 0, 0}, .high = {0.5f, 2, 10}});
    EXPECT_NEAR(view.scene.camera.target.x, 55, 0.5);
    EXPECT_LT(outwards(view, {60, 1, 0}), 0.95f);
    EXPECT_GT(outwards(view, {60, 1, 0}), 0.8f);
}

TEST(StageScene, GivesAPersonInABoxTheRoomOfAWholeFigure) {
    const TemporaryFolder folder;
    const auto eye = [&](const std::string& framing) {
        const std::string file = (folder / "scene.json").string();
        write_text(file, R"({"camera": {"framing": ")" + framing + R"("}})");
        return make_scene(file, stick_figure(1.7f), kSize).camera.eye;
    };
    EXPECT_EQ(eye("box"), eye("full"));
}

// Two people of different size who gesture with both arms.
struct TwoPeople {
    Avatar left = stick_figure(1.8f);
    Avatar right = stick_figure(1.55f, 0.7f);
    std::vector<const Avatar*> both = {&left, &right};
};

// Where a point of a figure at rest lies in the picture of a dyad, as shares of width and height.
Vec2 share_in(const View& view, const Avatar& avatar, std::size_t person, const Vec3& point) {
    const Transform place = world_from_figure(measure_figure(avatar), view.scene.places[person]);
    const Vec2 pixel = pixel_of(view.scene.camera, view.size, Vec3(to_matrix(place) * Vec4(point, 1)));
    return pixel / Vec2(static_cast<float>(view.size.width), static_cast<float>(view.size.height));
}

TEST(StageScene, ShowsBothOfADyadWithTheRoomOfTheirGestures) {
    const TwoPeople people;
    for (const RenderSize size : {RenderSize{1280, 720}, RenderSize{1024, 768}, RenderSize{1920, 800}}) {
        const Staging staging = stage_scene("dyad", people.both, size);
        ASSERT_EQ(staging.views.size(), 1u);
        const View& view = staging.views[0];
        EXPECT_EQ(view.figures, (std::vector<std::size_t>{0, 1}));
        EXPECT_EQ(view.left, 0);
        for (const std::size_t person : {0, 1}) {
            const Avatar& avatar = *people.both[person];
            const FigureMeasures figure = measure_figure(avatar);
            const Vec3 side = cross(Vec3(0, 1, 0), figure.forward);
            // The top of the head, and hands in front of the chest and out to the sides at arm's bend.
            std::vector<Vec3> seen = {Vec3(0, figure.top, 0)};
            for (const float to : {-1.0f, 1.0f}) {
                seen.push_back(figure.forward * (0.45f * figure.top / 1.7f) + side * (to * 0.2f) +
                               Vec3(0, 0.7f * figure.top, 0));
                seen.push_back(side * (to * 0.27f * figure.top) + Vec3(0, 0.6f * figure.top, 0));
            }
            for (const Vec3& point : seen) {
                const Vec2 share = share_in(view, avatar, person, point);
                EXPECT_GT(std::min({share.x, share.y, 1 - share.x, 1 - share.y}), 0.03f);
            }
            // Each on their own side of the picture.
            EXPECT_EQ(share_in(view, avatar, person, {0, 1, 0}).x < 0.5f, person == 0);
        }
    }
}

TEST(StageScene, TurnsTheTwoOfADyadToEachOtherAndHalfToTheViewer) {
    const TwoPeople people;
    const Scene scene = stage_scene("dyad", people.both, kSize).views[0].scene;
    ASSERT_EQ(scene.places.size(), 2u);
    std::vector<Vec3> facing, standing;
    for (const std::size_t person : {0, 1}) {
        const FigureMeasures figure = measure_figure(*people.both[person]);
        const Transform place = world_from_figure(figure, scene.places[person]);
        facing.push_back(place.rotation * figure.forward);
        standing.push_back(place.translation + place.rotation * figure.middle);
        EXPECT_NEAR(standing.back().y, scene.floor_height, 1e-6);
    }
    const float apart = distance(standing[0], standing[1]);
    EXPECT_GE(apart, 1.2f);
    EXPECT_LE(apart, 1.5f);
    const float between = angle_between(facing[0], facing[1]);
    EXPECT_GE(between, radians(90.0f));
    EXPECT_LE(between, radians(120.0f));
    // Nobody looks past the other by more than their own half of what is open to the viewer.
    EXPECT_LE(angle_between(facing[0], standing[1] - standing[0]), radians(45.0f));
    EXPECT_LE(angle_between(facing[1], standing[0] - standing[1]), radians(45.0f));
    for (const Vec3& direction : facing) EXPECT_GT(direction.z, 0.4f);
}

TEST(StageScene, LightsBothOfADyadAlike) {
    const TwoPeople people;
    const Scene scene = stage_scene("dyad", people.both, kSize).views[0].scene;
    EXPECT_EQ(std::count_if(scene.lights.begin(), scene.lights.end(),
                            [](const Light& light) { return light.casts_shadow; }),
              1);
    float on_face[2] = {};
    for (const std::size_t person : {0, 1}) {
        const Vec3 facing(std::sin(scene.places[person].heading), 0, std::cos(scene.places[person].heading));
        for (const Light& light : scene.lights) {
            on_face[person] += light.radiance.g * std::max(0.0f, dot(facing, light.towards));
        }
    }
    EXPECT_NEAR(on_face[0] / on_face[1], 1, 0.2);
}

TEST(StageScene, GivesEachOfASplitTheUpperSceneAndAGapOfWholePixels) {
    const TwoPeople people;
    for (const RenderSize size : {kSize, RenderSize{1281, 720}, RenderSize{64, 36}}) {
        const Staging staging = stage_scene("split", people.both, size);
        ASSERT_EQ(staging.views.size(), 2u);
        const View& left = staging.views[0];
        const View& right = staging.views[1];
        EXPECT_EQ(left.size.width, right.size.width);
        EXPECT_EQ(left.left, 0);
        EXPECT_EQ(right.left + right.size.width, size.width);
        const int gap = right.left - left.size.width;
        EXPECT_GE(gap, 0);
        EXPECT_NEAR(gap, 0.006 * size.width, 1.001);
        for (const std::size_t person : {0, 1}) {
            const View& view = staging.views[person];
            EXPECT_EQ(view.figures, std::vector<std::size_t>{person});
            EXPECT_TRUE(view.scene.places.empty());
            EXPECT_EQ(view.scene.camera.eye, make_scene("upper", *people.both[person], view.size).camera.eye);
        }
    }
}

TEST(StageScene, PlacesTheTwoOfAUsersSplitScene) {
    const TemporaryFolder folder;
    write_text(folder / "scene.json", R"({"split": {"gap": 0.01, "colour": "#000000"},
        "places": [{"x": 0, "z": 0, "heading_deg": 20}, {"x": 0, "z": 0, "heading_deg": -20}]})");
    const TwoPeople people;
    const Staging staging = stage_scene((folder / "scene.json").string(), people.both, kSize);
    EXPECT_NEAR(staging.views.at(0).scene.places.at(0).heading, radians(20.0f), 1e-6);
    EXPECT_NEAR(staging.views.at(1).scene.places.at(0).heading, radians(-20.0f), 1e-6);
    // The camera stays in front of the place and does not turn with the figure.
    EXPECT_NEAR(staging.views[1].scene.camera.eye.x, 0, 0.2);
    EXPECT_EQ(staging.gap_colour, Vec3(0));
}

TEST(StageScene, RefusesAnotherNumberOfPeopleThanItShows) {
    const TwoPeople people;
    const auto refusal = [&](const char* name, std::size_t count) {
        return refusal_of([&] { stage_scene(name, std::span(people.both).first(count), kSize); });
    };
    EXPECT_EQ(refusal("dyad", 1),
              "scene dyad: shows 2 people, but there is 1; give two motions, or choose upper, full or head");
    EXPECT_EQ(refusal("upper", 2),
              "scene upper: shows 1 people, but there are 2; choose dyad or split for two");
    EXPECT_EQ(refusal_of([&] { stage_beside("dyad", people.both, kSize); }),
              "scene dyad: shows 2 people, a scene for one is needed; choose upper, full or head");
    EXPECT_EQ(people_in_scene("dyad"), 2u);
    EXPECT_EQ(people_in_scene("split"), 2u);
    EXPECT_EQ(people_in_scene("head"), 1u);
}

TEST(StageBeside, ShowsEachAsAlone) {
    const TwoPeople people;
    const Staging staging = stage_beside("upper", people.both, kSize);
    ASSERT_EQ(staging.views.size(), 2u);
    EXPECT_EQ(staging.views[1].left, 640);
    EXPECT_EQ(staging.views[1].scene.camera.eye, make_scene("upper", people.right, {640, 720}).camera.eye);
}

}  // namespace
}  // namespace chironomia
