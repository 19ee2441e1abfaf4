// Stick figures through the real binary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hash.h"
#include "raster/images/image_file.h"
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
using testing::test_file;

const std::string kMotion = (source_dir() / "assets/samples/expressive/two-ways.bvh").string();

Outcome render_stick(const fs::path& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"render", "--quiet", "--avatar", "stick", "--motion",
                                      kMotion,  "--size",  "160x90",   "--out", out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_chironomia(words);
}

TEST(StickCli, DrawsTheSameBytesWithAnyNumberOfThreads) {
    const TemporaryFolder folder;
    std::vector<std::string> hashes;
    for (const char* threads : {"1", "3"}) {
        const fs::path out = folder / threads / "%d.png";
        const Outcome outcome = render_stick(out, {"--threads", threads, "--frames", "60:61"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, out.string() + "\n");
        hashes.push_back(sha256_of_file(folder / threads / "0.png"));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// Another rasterizer may move an edge by a pixel; `compare` knows how much of that is the same picture.
TEST(StickCli, LooksAsItDid) {
    const TemporaryFolder folder;
    const Outcome drawn =
        run_chironomia({"render", "--quiet", "--avatar", "stick", "--motion", kMotion, "--size", "320x180",
                        "--frames", "60:61", "--out", (folder / "%d.png").string()});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const std::string golden = (source_dir() / "tests/golden/stick").string();
    const Outcome same = run_chironomia({"compare", golden, folder.path().string(), "--quiet"});
    EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
}

TEST(StickCli, IsTracedShownInPairsAndReported) {
    const TemporaryFolder folder;
    const Outcome outcome =
        render_stick(folder / "pair" / "%d.png",
                     {"--motion", kMotion, "--scene", "dyad", "--renderer", "rays", "--samples", "1",
                      "--frames", "9:10", "--report", (folder / "r.json").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json report = read_json(folder / "r.json");
    EXPECT_EQ(report["motions"][0]["fit"]["avatar"], "stick");
    EXPECT_EQ(report["motions"][0]["fit"]["source"], "joint turns");
    EXPECT_EQ(report["recipe"]["performers"][0]["avatar"], "stick");
}

TEST(StickCli, RefusesWhatAStickFigureCannotShow) {
    const TemporaryFolder folder;
    write_text(folder / "f.csv", "time,AU12\n0,1\n0.1,2\n0.2,1\n");
    const auto refusal = [&](const std::vector<std::string>& more) {
        const Outcome outcome = render_stick(folder / "c.mp4", more);
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_FALSE(fs::exists(folder / "c.mp4"));
        return outcome.err;
    };
    EXPECT_THAT(refusal({"--face", (folder / "f.csv").string()}),
                HasSubstr("a stick figure has no face that"));
    EXPECT_THAT(
        refusal({"--face-mode", "blur"}),
        HasSubstr("has no face to show as \"blur\"; choose the face mode \"au\", or \"mask\", which draws no "
                  "more of a face than nose and eyes"));
    EXPECT_THAT(refusal({"--hands", "relaxed"}), HasSubstr("choose \"motion\" or \"hidden\""));
}

// How many pixels show something else; an edge that lies a fifth of a pixel further does not.
int strange_pixels(const Frame& a, const Frame& b) {
    int count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        int most = 0;
        for (size_t c = i; c < i + 3; ++c) most = std::max(most, std::abs(a.rgba[c] - b.rgba[c]));
        if (most > 50) ++count;
    }
    return count;
}

// A recording with face and hands beside one that lacks them, as what models of eleven points make: both are drawn
// alike.
TEST(StickCli, DrawsMotionsWithAndWithoutFaceAndHandsAlike) {
    const TemporaryFolder folder;
    const fs::path seen = test_file("tests/fixtures/gestures/openpose_24fps"), lacking = folder / "lacking";
    fs::create_directory(lacking);
    for (const fs::directory_entry& file : fs::directory_iterator(seen)) {
        Json frame = read_json(file.path());
        for (const char* part : {"face", "hand_left", "hand_right"}) {
            Json& points = frame["people"][0][std::string(part) + "_keypoints_2d"];
            ASSERT_FALSE(points.empty()) << part;
            for (Json& number : points) number = 0;
        }
        write_text(lacking / file.path().filename(), frame.dump());
    }
    const auto drawn = [&](const fs::path& motion, const std::string& name, const std::string& face,
                           const std::string& hands) {
        const Outcome outcome =
            run_chironomia({"render", "--quiet", "--avatar", "stick", "--motion", motion.string(),
                            "--motion-fps", "24", "--size", "320x180", "--frames", "60:61", "--face-mode",
                            face, "--hands", hands, "--out", (folder / name / "%d.png").string()});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return read_image(folder / name / "0.png");
    };
    EXPECT_EQ(strange_pixels(drawn(seen, "a", "mask", "hidden"), drawn(lacking, "b", "mask", "hidden")), 0);
    EXPECT_GT(strange_pixels(drawn(seen, "c", "au", "motion"), drawn(lacking, "d", "au", "motion")), 300);
}

TEST(StickCli, HasNoFileToConvert) {
    const TemporaryFolder folder;
    const Outcome outcome = run_chironomia(
        {"convert", "--motion", kMotion, "--avatar", "stick", "--out", (folder / "a.glb").string()});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("stick: is drawn from a motion by render and study, and has no file; "
                                       "choose one of female, female2, male, male2, mannequin, neutral"));
}

TEST(StickCli, AStudyOfStickFiguresIsBuiltAndBlind) {
    const TemporaryFolder folder;
    write_text(folder / "plan.json", R"({"title": "Lines", "layout": "pair", "conditions": ["ours", "base"],
        "render": {"avatar": "stick", "size": [160, 90], "fps": 10},
        "clips": [{"id": "c1", "motion": {"ours": ")" +
                                         kMotion + R"(", "base": ")" +
                                         (source_dir() / "assets/samples/restrained/two-ways.bvh").string() +
                                         R"("}}]})");
    const std::string study = (folder / "study").string();
    const Outcome built = run_chironomia(
        {"study", "build", (folder / "plan.json").string(), "--out", study, "--seed", "7", "--quiet"});
    EXPECT_EQ(built.exit_code, 0) << built.err;
    const Outcome checked = run_chironomia({"study", "check", study});
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
}

}  // namespace
}  // namespace chironomia::study
