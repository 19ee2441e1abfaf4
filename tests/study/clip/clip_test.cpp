#include "study/clip/clip.h"

#include <gmock/gmock.h>

#include <fstream>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::source_dir;

ClipJob sample_job() {
    ClipJob job;
    job.performers = {{.motion = source_dir() / "assets/samples/expressive/two-ways.bvh"}};
    job.out = "clip.mp4";
    return job;
}

void append(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary | std::ios::app) << text;
}

// The bundled mannequin as a .gltf with its buffer in a file beside it.
fs::path unpack_mannequin(const fs::path& folder) {
    const std::string glb = read_text(source_dir() / "assets/avatars/mannequin.glb");
    std::uint32_t json_length = 0;
    std::memcpy(&json_length, glb.data() + 12, 4);
    Json json = Json::parse(glb.substr(20, json_length));
    json["buffers"][0]["uri"] = "figure.bin";
    append(folder / "figure.bin", glb.substr(20 + json_length + 8));
    append(folder / "figure.gltf", json.dump());
    return folder / "figure.gltf";
}

TEST(RecipeOf, StaysUntilAnOptionChanges) {
    const ClipJob job = sample_job();
    const Json recipe = recipe_of(job);
    EXPECT_EQ(recipe_of(job), recipe);
    ClipJob other = job;
    other.upper_body = true;
    EXPECT_NE(recipe_of(other), recipe);
    other = job;
    other.performers[0].hints.turn_deg = 90;
    EXPECT_NE(recipe_of(other), recipe);
    other = job;
    other.drawing.renderer = RendererKind::rays;
    const Json of_rays = recipe_of(other);
    EXPECT_NE(of_rays, recipe);
    other.drawing.samples = 4;
    EXPECT_NE(recipe_of(other), of_rays);
    other.drawing.samples = 16;
    other.drawing.motion_blur = 0.5;
    EXPECT_NE(recipe_of(other), of_rays);
    other = job;
    other.performers[0].modes.face_mode = FaceMode::blur;
    EXPECT_NE(recipe_of(other), recipe);
    other = job;
    other.performers[0].modes.hands = HandsMode::relaxed;
    EXPECT_NE(recipe_of(other), recipe);
    other = job;
    other.out = "clip.webm";
    EXPECT_NE(recipe_of(other), recipe);
}

TEST(RecipeOf, ChangesWithABufferBesideTheAvatar) {
    const testing::TemporaryFolder folder;
    ClipJob job = sample_job();
    job.performers[0].avatar = unpack_mannequin(folder.path());
    const Json recipe = recipe_of(job);
    append(folder / "figure.bin", "more");
    EXPECT_NE(recipe_of(job), recipe);
}

TEST(RecipeOf, ChangesWithTheDescriptionBesideAnArray) {
    const testing::TemporaryFolder folder;
    for (const char* name : {"mediapipe_world33_25fps.npy", "mediapipe_world33_25fps.json"}) {
        fs::copy(testing::test_file("tests/fixtures/gestures") / name, folder / name);
    }
    ClipJob job = sample_job();
    job.performers[0].motion = folder / "mediapipe_world33_25fps.npy";
    const Json recipe = recipe_of(job);
    append(folder / "mediapipe_world33_25fps.json", "\n");
    EXPECT_NE(recipe_of(job), recipe);
}

TEST(FindAvatar, NamesTheBundledOnesIfItIsNeither) {
    EXPECT_THAT(refusal_of([] { find_avatar("nobody"); }),
                HasSubstr("nobody: is neither a file nor a bundled avatar; the bundled ones are female, "
                          "female2, male, male2, mannequin, neutral"));
}

}  // namespace
}  // namespace chironomia::study
