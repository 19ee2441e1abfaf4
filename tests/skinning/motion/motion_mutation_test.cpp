// Thousands of damaged motion files: each is read or refused, and never crashes, hangs or eats the memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "skinning/motion/bvh.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using Bytes = std::vector<std::byte>;

constexpr int kMutations = 2000;

// Cuts, flips, doubles, removes or overwrites a piece; one to four times.
Bytes mutated(Bytes bytes, Random& random) {
    const auto place = [&] {
        return static_cast<std::ptrdiff_t>(random.below(static_cast<uint32_t>(bytes.size())));
    };
    for (uint32_t i = 0, times = 1 + random.below(4); i < times && !bytes.empty(); ++i) {
        const auto from = place(),
                   length = std::min<std::ptrdiff_t>(1 + random.below(16), std::ssize(bytes) - from);
        const auto begin = bytes.begin() + from, end = begin + length;
        switch (random.below(6)) {
            case 0:
                bytes.resize(static_cast<size_t>(from));
                break;
            case 1:
                *begin ^= static_cast<std::byte>(1u << random.below(8));
                break;
            case 2: {
                const Bytes piece(begin, end);
                bytes.insert(begin, piece.begin(), piece.end());
                break;
            }
            case 3:
                bytes.erase(begin, end);
                break;
            case 4:
                for (auto at = begin; at != end; ++at) *at = static_cast<std::byte>(random.below(256));
                break;
            default:  // digits and signs reach deeper into texts than noise does
                for (auto at = begin; at != end; ++at)
                    *at = static_cast<std::byte>("0123456789-.e{}[],:\n"[random.below(20)]);
        }
    }
    return bytes;
}

// What every motion that was read must be.
void expect_sound(const Motion& motion) {
    ASSERT_GE(motion.frames, 1u);
    ASSERT_GT(motion.fps, 0);
    if (motion.joints) {
        const size_t count = motion.joints->skeleton.joints.size();
        ASSERT_EQ(motion.joints->turns.size(), motion.frames * count);
        ASSERT_EQ(motion.joints->translations.size(), motion.frames * count);
        for (size_t j = 0; j < count; ++j)
            ASSERT_LT(motion.joints->skeleton.joints[j].parent, static_cast<int>(j));
        for (const Quat& turn : motion.joints->turns) ASSERT_NEAR(glm::length(turn), 1, 1e-3);
        for (const Vec3& place : motion.joints->translations) ASSERT_TRUE(std::isfinite(length(place)));
    }
    if (motion.keypoints) {
        ASSERT_EQ(motion.keypoints->points.size(), motion.frames * motion.keypoints->names.size());
        for (const float confidence : motion.keypoints->confidence)
            ASSERT_TRUE(confidence >= 0 && confidence <= 1);
        for (const Vec3& place : motion.keypoints->points) ASSERT_TRUE(std::isfinite(length(place)));
    }
}

class MutatedMotion : public ::testing::TestWithParam<const char*> {
  protected:
    // The small file of that ending that is to be damaged.
    Bytes original(const std::string& name) {
        const auto fixtures = testing::source_dir() / "tests/fixtures/motion";
        if (name != "ours.h5" && name != "ours.csv" && name != "ours.bvh" && name != "ours.json") {
            return read_bytes(fixtures / name);
        }
        MotionHints hints;
        hints.fps = 50;
        Motion motion = read_motion(fixtures / "stored.npz", hints);
        motion.joints = JointTrack{};
        motion.joints->skeleton.joints = {{"Hips", -1, {.translation = {0, 0.9f, 0}}},
                                          {"Head", 0, {.translation = {0, 0.7f, 0}}},
                                          {"Head_end", 1, {.translation = {0, 0.2f, 0}}}};
        for (int t = 0; t < 2; ++t) {
            for (const Joint& joint : motion.joints->skeleton.joints) {
                motion.joints->turns.push_back(kNoTurn);
                motion.joints->translations.push_back(joint.rest.translation);
            }
        }
        if (name == "ours.h5") write_motion_hdf5(folder_ / name, motion);
        if (name == "ours.csv") write_motion_csv(folder_ / name, motion);
        if (name == "ours.bvh") write_bvh(folder_ / name, motion);
        if (name == "ours.json") write_text(folder_ / name, kJson);
        return read_bytes(folder_ / name);
    }

    static constexpr std::string_view kJson =
        R"({"fps": 25, "names": ["nose", "left_shoulder", "right_shoulder", "pelvis"], "frames": [
            [[0, 1.6, 0.1, 1], [0.2, 1.4, 0, 0.5], [-0.2, 1.4, 0], null],
            {"nose": [0, 1.6, 0.1], "pelvis": {"x": 0, "y": 0.9, "z": 0, "visibility": 0.5}}]})";

    testing::TemporaryFolder folder_;
};

TEST_P(MutatedMotion, IsReadOrRefused) {
    const Bytes whole = original(GetParam());
    Random random(11);
    int read = 0, refused = 0;
    MotionHints hints;
    hints.fps = 30;
    for (int i = 0; i < kMutations; ++i) {
        const auto file = folder_ / ("mutated" + std::filesystem::path(GetParam()).extension().string());
        write_bytes(file, mutated(whole, random));
        try {
            const Motion motion = read_motion(file, i % 2 ? hints : MotionHints{});
            ++read;
            expect_sound(motion);
            if (HasFatalFailure()) FAIL() << "mutation " << i;
        } catch (const Error& error) {
            ++refused;
            EXPECT_GT(std::string(error.what()).size(), file.string().size()) << error.what();
        }
    }
    EXPECT_EQ(read + refused, kMutations);
    // Damage that nobody notices is rare, but the test must reach beyond the first bytes, too.
    EXPECT_GT(refused, kMutations / 10);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 2 << 20) << "kilobytes at the highest";
}

INSTANTIATE_TEST_SUITE_P(Files, MutatedMotion,
                         ::testing::Values("ours.bvh", "ours.csv", "ours.json", "ours.h5", "deflated.npz",
                                           "stored.npz", "fortran.npy", "h5py.h5"),
                         [](const auto& name) {
                             std::string word = name.param;
                             std::replace(word.begin(), word.end(), '.', '_');
                             return word;
                         });

}  // namespace
}  // namespace chironomia
