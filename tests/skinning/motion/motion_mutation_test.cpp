// Thousands of damaged motion files: each is read or refused, and never crashes, hangs or eats the memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/random.h"
#include "core/text.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/support/sanitizers.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using Bytes = std::vector<std::byte>;

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

void expect_sound_face(const FaceTrack& face, size_t frames) {
    ASSERT_EQ(face.intensities.size(), frames * face.channels.size());
    for (const float intensity : face.intensities) ASSERT_TRUE(intensity >= 0 && intensity <= 5);
    ASSERT_TRUE(face.head.empty() || face.head.size() == frames);
    for (const Quat& turn : face.head) ASSERT_NEAR(glm::length(turn), 1, 1e-3);
    ASSERT_TRUE(face.gaze.empty() || face.gaze.size() == frames);
    for (const Gaze& gaze : face.gaze)
        ASSERT_TRUE(std::isfinite(length(gaze.left)) && std::isfinite(length(gaze.right)));
    ASSERT_TRUE(face.confidence.empty() || face.confidence.size() == frames);
    for (const float confidence : face.confidence) ASSERT_TRUE(confidence >= 0 && confidence <= 1);
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
    if (motion.face) expect_sound_face(*motion.face, motion.frames);
}

class MutatedMotion : public ::testing::TestWithParam<const char*> {
  protected:
    // The small file of that ending that is to be damaged.
    Bytes original(const std::string& name) {
        const auto fixtures = testing::source_dir() / "tests/fixtures/motion";
        if (name.starts_with("face")) return face_of(name);
        if (!name.starts_with("ours")) return read_bytes(fixtures / name);
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
        if (name == "ours_mediapipe.json") write_text(folder_ / name, mediapipe());
        return read_bytes(folder_ / name);
    }

    // Two frames of a pose and a hand.
    static std::string mediapipe() {
        const auto list = [](int count) {
            std::string points;
            for (int k = 0; k < count; ++k)
                points += format("{}[0.1{},0.{},0.2,0.9]", k ? "," : "", k, 9 * k);
            return points;
        };
        const std::string frame =
            format(R"({{"pose_world_landmarks":[{}],"left_hand_world_landmarks":[{}]}})", list(33), list(21));
        return format(R"({{"fps":25,"frames":[{},{}]}})", frame, frame);
    }

    Bytes face_of(const std::string& name) {
        const auto text = name == "face_arkit.csv" ? kArkit : kOpenFace;
        write_text(folder_ / name, text);
        if (name.ends_with("open.csv") || name.ends_with("arkit.csv")) return read_bytes(folder_ / name);
        write_text(folder_ / "open.csv", text);
        const Motion motion = read_motion(folder_ / "open.csv");
        if (name == "face.h5") write_motion_hdf5(folder_ / name, motion);
        if (name == "face_ours.csv") write_motion_csv(folder_ / name, motion);
        return read_bytes(folder_ / name);
    }

    static constexpr std::string_view kOpenFace =
        "frame, face_id, timestamp, confidence, success, gaze_0_x, gaze_0_y, gaze_0_z, gaze_1_x, gaze_1_y, "
        "gaze_1_z, gaze_angle_x, gaze_angle_y, pose_Rx, pose_Ry, pose_Rz, AU01_r, AU12_r, AU45_r, AU28_c\n"
        "1, 0, 0.000, 0.98, 1, 0.1, 0.2, -0.97, 0.1, 0.2, -0.97, 0.1, 0.2, 0.01, -0.2, 0.03, 0.5, 0, 5, 1\n"
        "2, 0, 0.040, 0.98, 1, 0.2, 0.1, -0.97, 0.1, 0.2, -0.97, 0.1, 0.2, 0.02, -0.1, 0.03, 1.5, 1, 3, 0\n"
        "3, 0, 0.080, 0.02, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0\n"
        "4, 0, 0.120, 0.95, 1, 0.2, 0.1, -0.97, 0.1, 0.2, -0.97, 0.1, 0.2, 0.02, 0.1, 0.03, 2.5, 3, 0, 0\n";
    static constexpr std::string_view kArkit =
        "Timecode,BlendshapeCount,EyeBlinkLeft,EyeLookDownLeft,EyeLookInLeft,EyeLookOutLeft,EyeLookUpLeft,"
        "EyeLookDownRight,EyeLookInRight,EyeLookOutRight,EyeLookUpRight,JawOpen,MouthClose,MouthLeft,HeadYaw,"
        "HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,RightEyePitch,RightEyeRoll\n"
        "11:59:59:58.250,61,0,0.1,0,0.2,0,0.1,0.2,0,0,0.5,0.1,0,0.1,0.2,-0.1,-0.1,0.05,0,-0.1,0.05,0\n"
        "11:59:59:59.250,61,1,0.1,0,0.2,0,0.1,0.2,0,0,0.4,0.1,0,0.2,0.2,-0.1,-0.1,0.05,0,-0.1,0.05,0\n"
        "12:00:00:00.250,0\n"
        "12:00:00:01.250,61,0,0.1,0,0.2,0,0.1,0.2,0,0,0.3,0.1,0,0.3,0.2,-0.1,-0.1,0.05,0,-0.1,0.05,0\n";
    static constexpr std::string_view kJson =
        R"({"fps": 25, "names": ["nose", "left_shoulder", "right_shoulder", "pelvis"], "frames": [
            [[0, 1.6, 0.1, 1], [0.2, 1.4, 0, 0.5], [-0.2, 1.4, 0], null],
            {"nose": [0, 1.6, 0.1], "pelvis": {"x": 0, "y": 0.9, "z": 0, "visibility": 0.5}}]})";

    testing::TemporaryFolder folder_;
};

TEST_P(MutatedMotion, IsReadOrRefused) {
    const Bytes whole = original(GetParam());
    const bool is_slow = testing::has_sanitizers();
    const int mutations = is_slow ? 500 : 2000;
    Random random(is_slow ? 12 : 11);
    int read = 0, refused = 0;
    MotionHints hints;
    hints.fps = 30;
    for (int i = 0; i < mutations; ++i) {
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
    EXPECT_EQ(read + refused, mutations);
    // Damage that nobody notices is rare, but the test must reach beyond the first bytes, too.
    EXPECT_GT(refused, mutations / 10);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 2 << 20) << "kilobytes at the highest";
}

INSTANTIATE_TEST_SUITE_P(Files, MutatedMotion,
                         ::testing::Values("ours.bvh", "ours.csv", "ours.json", "ours_mediapipe.json",
                                           "ours.h5", "deflated.npz", "stored.npz", "fortran.npy", "h5py.h5",
                                           "pats.h5", "pats_packed.h5", "smpl.npz", "models.npz",
                                           "face_open.csv", "face_arkit.csv", "face_ours.csv", "face.h5"),
                         [](const auto& name) {
                             std::string word = name.param;
                             std::replace(word.begin(), word.end(), '.', '_');
                             return word;
                         });

}  // namespace
}  // namespace chironomia
