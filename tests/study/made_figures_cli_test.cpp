// Avatars as programs write them, and damaged ones, through the real binary: each is drawn as the plain one, or refused
// with its message and exit code 3.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
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
