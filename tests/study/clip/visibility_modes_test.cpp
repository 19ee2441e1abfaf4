// Face modes and hands modes through the real binary.
#include "study/clip/visibility_modes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "core/text.h"
#include "tests/study/process.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Outcome;
using testing::run_chironomia;
using testing::source_dir;
using testing::TemporaryFolder;

std::vector<std::string> render(const fs::path& out, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", "--size",  "160x120", "--frames",
                                      "0:3",    "--quiet", "--out",   out.string()};
    const std::string sample = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();
    for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{
             {"--motion", sample}, {"--avatar", "mannequin"}, {"--scene", "head"}}) {
        if (std::find(more.begin(), more.end(), option) == more.end())
            words.insert(words.end(), {option, value});
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// The bytes of all frames of a stack.
std::string hash_of_stack(const std::vector<std::string>& more) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia(render(folder / "frames/%05d.png", more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::string bytes;
    for (int frame = 0; frame < 3; ++frame) bytes += read_text(folder / format("frames/{:05}.png", frame));
    return sha256(bytes);
}

// The mannequin with a head joint that carries nothing: its head is bound to another joint in the same place.
fs::path write_headless(const fs::path& folder) {
    const std::string glb = read_text(source_dir() / "assets/avatars/mannequin.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    Json json = Json::parse(glb.substr(20, length));
    Json& nodes = json["nodes"];
    const auto named = [&](const std::string& name) {
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].value("name", "") == name) return i;
        }
        ADD_FAILURE() << name;
        return size_t{0};
    };
    const size_t head = named("head"), neck = named("neck");
    Json other = nodes[head];
    other["name"] = "ball";
    other.erase("children");
    nodes.push_back(other);
    nodes[neck]["children"].push_back(nodes.size() - 1);
    for (Json& skin : json["skins"]) {
        for (Json& joint : skin["joints"]) {
            if (joint == head) joint = nodes.size() - 1;
        }
    }
    json["buffers"][0]["uri"] = "headless.bin";
    write_text(folder / "headless.bin", glb.substr(20 + length + 8));
    write_text(folder / "headless.gltf", json.dump());
    return folder / "headless.gltf";
}

TEST(Modes, AreFoundByTheirWords) {
    for (const auto& [word, mode] : face_modes()) EXPECT_EQ(to_text(mode), word);
    for (const auto& [word, mode] : hands_modes()) EXPECT_EQ(to_text(mode), word);
    EXPECT_EQ(to_json({.face_mode = FaceMode::mask}), Json({{"face_mode", "mask"}, {"hands", "motion"}}));
}

// The mannequin's face does nothing, so that it looks the same at rest.
TEST(FaceModes, EachGivesItsOwnPictureAndTheSameForAnyNumberOfThreads) {
    const std::string plain = hash_of_stack({});
    std::set<std::string> hashes;
    for (const auto& [word, mode] : face_modes()) {
        const std::string hash = hash_of_stack({"--face-mode", word, "--threads", "1"});
        EXPECT_EQ(hash_of_stack({"--face-mode", word, "--threads", "4"}), hash) << word;
        if (mode == FaceMode::au || mode == FaceMode::neutral) {
            EXPECT_EQ(hash, plain) << word;
        }
        hashes.insert(hash);
    }
    EXPECT_EQ(hashes.size(), face_modes().size() - 1);
}

TEST(HandsModes, EachGivesItsOwnPictureAndTheSameForAnyNumberOfThreads) {
    const std::string motion = testing::test_file("tests/fixtures/gestures/beats.bvh").string();
    std::set<std::string> hashes;
    for (const auto& [word, mode] : hands_modes()) {
        const std::vector<std::string> words = {"--motion", motion, "--scene", "upper", "--hands", word};
        const std::string hash = hash_of_stack(words);
        hashes.insert(hash);
        if (mode != HandsMode::hidden) continue;
        std::vector<std::string> on_one = words;
        on_one.insert(on_one.end(), {"--threads", "1"});
        EXPECT_EQ(hash_of_stack(on_one), hash);
    }
    EXPECT_EQ(hashes.size(), hands_modes().size());
}

TEST(FaceModes, AreDescribedByTheReport) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia(
        render(folder / "clip.mp4", {"--face-mode", "blur", "--report", (folder / "report.json").string()}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json report = read_json(folder / "report.json");
    const std::string modes = report["motions"][0]["modes"].dump();
    EXPECT_THAT(modes, HasSubstr("blurred with a sigma of 0.11 of the height of the face, "));
    EXPECT_THAT(modes, HasSubstr("eyes by the shape of the head"));
    EXPECT_EQ(report["recipe"]["performers"][0]["modes"]["face_mode"], "blur");
}

TEST(FaceModes, AnUnknownOneIsRefusedWithTheWords) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia(render(folder / "clip.mp4", {"--face-mode", "pixels"}));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("\"pixels\" is none of au, blur, mask, mouth-blur, neutral"));
}

TEST(FaceModes, ThatNeedAFaceRefuseAHeadWithoutOne) {
    const TemporaryFolder inputs, folder;
    const std::string avatar = write_headless(inputs.path()).string();
    for (const char* mode : {"blur", "mouth-blur", "mask"}) {
        const Outcome outcome =
            run_chironomia(render(folder / "clip.mp4", {"--avatar", avatar, "--face-mode", mode}));
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_THAT(outcome.err,
                    HasSubstr("headless.gltf: its head joint \"head\" carries no surface, so its "
                              "face cannot be found; choose --face-mode au or neutral"));
        EXPECT_TRUE(fs::is_empty(folder.path()));
    }
    EXPECT_EQ(run_chironomia(render(folder / "clip.mp4", {"--avatar", avatar})).exit_code, 0);
}

}  // namespace
}  // namespace chironomia::study
