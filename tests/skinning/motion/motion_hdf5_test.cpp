#include "skinning/motion/motion_hdf5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>

#include "core/files/files.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_file.h"
#include "tests/support/motion_hdf5.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

// Two joints and one keypoint over three frames.
Motion small_motion() {
    Motion motion{.source = "made",
                  .fps = 29.97,
                  .frames = 3,
                  .joints = JointTrack{},
                  .keypoints = KeypointTrack{},
                  .notes = {"first", "second, longer"}};
    motion.joints->skeleton.joints = {{"Hüfte", -1, {.translation = {0, 0.9f, 0}}},
                                      {"head", 0, {.translation = {0, 0.6f, 0}, .scale = {2, 2, 2}}}};
    for (int t = 0; t < 3; ++t) {
        motion.joints->turns.insert(motion.joints->turns.end(),
                                    {glm::angleAxis(0.1f * float(t), Vec3(0, 1, 0)), kNoTurn});
        motion.joints->translations.insert(motion.joints->translations.end(),
                                           {{0.1f * float(t), 0.9f, 0}, {0, 0.6f, 0}});
    }
    motion.keypoints->names = {"nose"};
    motion.keypoints->points = {{0, 1.6f, 0.1f}, {0, 1.61f, 0.1f}, {0, 0, 0}};
    motion.keypoints->confidence = {1, 0.5f, 0};
    return motion;
}

// Two channels, head, gaze and confidence over three frames.
FaceTrack small_face() {
    return {.channels = {{12, FaceSide::both}, {45, FaceSide::left}},
            .intensities = {0, 1, 2.5f, 5, 5, 0},
            .head = {kNoTurn, glm::angleAxis(0.3f, Vec3(0, 1, 0)), kNoTurn},
            .gaze = {{{0.1f, 0.2f}, {0.3f, 0.4f}}, {}, {}},
            .confidence = {1, 0.5f, 0}};
}

void expect_same_face(const FaceTrack& a, const FaceTrack& b) {
    EXPECT_EQ(a.channels, b.channels);
    EXPECT_EQ(a.intensities, b.intensities);
    EXPECT_EQ(a.head, b.head);
    EXPECT_EQ(a.confidence, b.confidence);
    ASSERT_EQ(a.gaze.size(), b.gaze.size());
    for (size_t t = 0; t < a.gaze.size(); ++t) {
        EXPECT_EQ(a.gaze[t].left, b.gaze[t].left);
        EXPECT_EQ(a.gaze[t].right, b.gaze[t].right);
    }
}

void expect_same(const Motion& a, const Motion& b) {
    EXPECT_EQ(a.fps, b.fps);
    EXPECT_EQ(a.frames, b.frames);
    EXPECT_EQ(a.notes, b.notes);
    ASSERT_EQ(a.joints.has_value(), b.joints.has_value());
    ASSERT_EQ(a.keypoints.has_value(), b.keypoints.has_value());
    if (a.joints) {
        ASSERT_EQ(a.joints->skeleton.joints.size(), b.joints->skeleton.joints.size());
        for (size_t j = 0; j < a.joints->skeleton.joints.size(); ++j) {
            EXPECT_EQ(a.joints->skeleton.joints[j].name, b.joints->skeleton.joints[j].name);
            EXPECT_EQ(a.joints->skeleton.joints[j].parent, b.joints->skeleton.joints[j].parent);
            EXPECT_EQ(a.joints->skeleton.joints[j].rest, b.joints->skeleton.joints[j].rest);
        }
        EXPECT_EQ(a.joints->turns, b.joints->turns);
        EXPECT_EQ(a.joints->translations, b.joints->translations);
    }
    if (a.keypoints) {
        EXPECT_EQ(a.keypoints->names, b.keypoints->names);
        EXPECT_EQ(a.keypoints->points, b.keypoints->points);
        EXPECT_EQ(a.keypoints->confidence, b.keypoints->confidence);
    }
}

class MotionHdf5 : public ::testing::Test {
  protected:
    // The refusal of a file that holds `motion` after a change.
    std::string refusal(const std::function<void(Motion&)>& change) {
        Motion motion = small_motion();
        change(motion);
        write_motion_hdf5(folder_ / "a.h5", motion);
        return refusal_of([&] { testing::read_motion_hdf5(folder_ / "a.h5"); });
    }

    testing::TemporaryFolder folder_;
};

TEST_F(MotionHdf5, ReadsBackEveryBit) {
    write_motion_hdf5(folder_ / "a.h5", small_motion());
    expect_same(testing::read_motion_hdf5(folder_ / "a.h5"), small_motion());
    Motion joints = small_motion();
    joints.keypoints.reset();
    joints.notes.clear();
    write_motion_hdf5(folder_ / "a.h5", joints);
    expect_same(testing::read_motion_hdf5(folder_ / "a.h5"), joints);
    EXPECT_TRUE(is_hdf5(read_bytes(folder_ / "a.h5")));
}

TEST_F(MotionHdf5, ReadsBackWhenItBegan) {
    Motion motion = small_motion();
    motion.first_time = 0.6;
    write_motion_hdf5(folder_ / "a.h5", motion);
    EXPECT_EQ(read_motion(folder_ / "a.h5").first_time, 0.6);
}

TEST_F(MotionHdf5, ReadsBackAFace) {
    Motion motion = small_motion();
    motion.face = small_face();
    write_motion_hdf5(folder_ / "a.h5", motion);
    expect_same(testing::read_motion_hdf5(folder_ / "a.h5"), motion);
    expect_same_face(testing::read_motion_hdf5(folder_ / "a.h5").face.value(), *motion.face);
    motion.joints.reset();
    motion.keypoints.reset();
    write_motion_hdf5(folder_ / "a.h5", motion);
    const Motion alone = read_motion(folder_ / "a.h5");
    EXPECT_FALSE(alone.joints || alone.keypoints);
    EXPECT_EQ(alone.frames, 3u);
    expect_same_face(alone.face.value(), *motion.face);
    *motion.face = {
        .channels = {}, .intensities = {}, .head = small_face().head, .gaze = {}, .confidence = {}};
    write_motion_hdf5(folder_ / "a.h5", motion);
    expect_same_face(read_motion(folder_ / "a.h5").face.value(), *motion.face);
}

TEST_F(MotionHdf5, ReadsBackLabels) {
    Motion motion = small_motion();
    motion.labels = {{.name = "phase", .values = {"rest", "stroke"}, .frames = {0, 1, 1}},
                     {.name = "gesture", .values = {"-", "open_offer"}, .frames = {1, 0, 1}}};
    write_motion_hdf5(folder_ / "labels.h5", motion);
    const std::vector<LabelTrack> labels = testing::read_motion_hdf5(folder_ / "labels.h5").labels;
    ASSERT_EQ(labels.size(), 2u);
    EXPECT_EQ(labels[0].name, "phase");
    EXPECT_EQ(labels[0].values, motion.labels[0].values);
    EXPECT_EQ(labels[0].frames, motion.labels[0].frames);
    EXPECT_EQ(labels[1].values, motion.labels[1].values);
    EXPECT_EQ(labels[1].frames, motion.labels[1].frames);
}

TEST_F(MotionHdf5, RefusesALabelWithoutAName) {
    EXPECT_THAT(refusal([](Motion& motion) {
                    motion.labels = {{.name = "phase", .values = {"rest", "stroke"}, .frames = {0, 2, 1}}};
                }),
                HasSubstr("a.h5: /labels/0/frames holds 2; numbers of the 2 values are expected"));
}

TEST_F(MotionHdf5, RefusesAFaceThatMeansNothing) {
    const auto refusal_of_face = [&](const std::function<void(FaceTrack&)>& change) {
        return refusal([&](Motion& motion) {
            motion.face = small_face();
            change(*motion.face);
        });
    };
    EXPECT_THAT(
        refusal_of_face([](FaceTrack& face) { face.channels[0].unit = 3; }),
        HasSubstr("/face/channels: \"AU3\" is no action unit that is known; \"AU12\" or \"AU12_L\" is "
                  "meant"));
    EXPECT_THAT(refusal_of_face([](FaceTrack& face) { face.channels[1] = face.channels[0]; }),
                HasSubstr("/face/channels: \"AU12\" comes twice"));
    EXPECT_THAT(refusal_of_face([](FaceTrack& face) { face.intensities[2] = 6; }),
                HasSubstr("/face/intensities holds 6; numbers from 0 to 5 are expected"));
    EXPECT_THAT(refusal_of_face([](FaceTrack& face) { face.confidence[2] = -0.5f; }),
                HasSubstr("/face/confidence holds -0.5; numbers from 0 to 1 are expected"));
    EXPECT_THAT(refusal_of_face([](FaceTrack& face) { face.head[1] = Quat(0.5f, 0, 0, 0); }),
                HasSubstr("/face/head: the turn 1 has the length 0.5; unit quaternions"));
    EXPECT_THAT(refusal([](Motion& motion) {
                    motion.joints.reset();
                    motion.keypoints.reset();
                    motion.face = FaceTrack{};
                }),
                HasSubstr("/face holds neither intensities nor head nor gaze"));
}

TEST_F(MotionHdf5, GivesTheSameBytesEveryTime) {
    write_motion_hdf5(folder_ / "a.h5", small_motion());
    write_motion_hdf5(folder_ / "b.h5", small_motion());
    EXPECT_EQ(read_bytes(folder_ / "a.h5"), read_bytes(folder_ / "b.h5"));
}

TEST_F(MotionHdf5, KeepsMotionsOfOtherFormsAsTheyAre) {
    for (const std::string& file : testing::present(
             {"tests/fixtures/gestures/wave.bvh", "tests/fixtures/gestures/mediapipe_world33_25fps.json",
              "../shared/data/motion/bvh/ad_wave_hello.bvh",
              "../shared/data/motion/keypoints3d/mediapipe_world33.json"})) {
        const Motion motion = read_motion(testing::test_file(file));
        write_motion_hdf5(folder_ / "a.h5", motion);
        expect_same(read_motion(folder_ / "a.h5"), motion);
    }
}

TEST_F(MotionHdf5, TakesWhatIsSetByHand) {
    write_motion_hdf5(folder_ / "a.h5", small_motion());
    MotionHints hints;
    hints.unit = 2;
    hints.fps = 50;
    const Motion motion = read_motion(folder_ / "a.h5", hints);
    EXPECT_EQ(motion.fps, 50);
    EXPECT_FLOAT_EQ(motion.joints->translations[0].y, 1.8f);
    EXPECT_THAT(motion.notes, Contains("rate: 50 frames/s, set by hand (in the file: 29.97)"));
}

TEST_F(MotionHdf5, ReadsWhatH5pyWrites) {
    for (const char* name : {"h5py.h5", "variable_texts.h5", "chunked.h5"}) {
        const Motion motion = read_motion(testing::source_dir() / "tests/fixtures/motion" / name);
        EXPECT_EQ(motion.fps, 25) << name;
        EXPECT_EQ(motion.keypoints->names, (std::vector<std::string>{"nose", "left_wrist"})) << name;
        EXPECT_EQ(motion.keypoints->points[3], Vec3(0.4f, 1.25f, 0.2f)) << name;
    }
}

TEST_F(MotionHdf5, RefusesWhatIsNoMotionOfOurs) {
    write_text(folder_ / "a.h5", "\x89HDF\r\n\x1a\n and nothing else");
    EXPECT_THAT(refusal_of([&] { read_motion(folder_ / "a.h5"); }),
                HasSubstr("a.h5: the HDF5 file is broken or truncated"));
    EXPECT_THAT(
        refusal([](Motion& motion) {
            motion.joints.reset();
            motion.keypoints.reset();
        }),
        HasSubstr("this HDF5 file is no motion that is known: it holds /fps, /frames, /notes; /fps and "
                  "/joints, /keypoints3d, /keypoints2d or /face are expected, or"));
    EXPECT_THAT(
        refusal_of([] { read_motion(testing::source_dir() / "tests/fixtures/motion/old_layout.h5"); }),
        HasSubstr("old_layout.h5: this HDF5 file is no motion that is known: it holds /fps; "));
}

TEST_F(MotionHdf5, RefusesArraysThatDoNotFit) {
    const auto refusal_of_fixture = [](const char* name) {
        return refusal_of([&] { read_motion(testing::source_dir() / "tests/fixtures/motion" / name); });
    };
    EXPECT_THAT(refusal_of_fixture("wrong_shape.h5"),
                HasSubstr("/keypoints3d/points has the shape (2, 3, 3); (2, 2, 3) is expected"));
    EXPECT_THAT(refusal_of_fixture("no_confidence.h5"), HasSubstr("/keypoints3d/confidence is missing"));
    EXPECT_THAT(refusal_of_fixture("names_are_numbers.h5"), HasSubstr("/keypoints3d/names holds no texts"));
    EXPECT_THAT(refusal_of_fixture("points_are_texts.h5"), HasSubstr("/keypoints3d/points holds no numbers"));
    EXPECT_THAT(refusal_of_fixture("no_names.h5"), HasSubstr("/keypoints3d/names is empty"));
    EXPECT_THAT(refusal_of_fixture("no_frames.h5"), HasSubstr("the motion has no frames"));
}

// A limit on the size of files is the small sister of a full disk.
TEST_F(MotionHdf5, LeavesNothingBehindOnAFullDisk) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string refusal = refusal_of([&] { write_motion_hdf5(folder_ / "a.h5", small_motion()); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(refusal, HasSubstr("a.h5: cannot be written; check free space and permissions"));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(MotionHdf5, RefusesValuesThatMeanNothing) {
    EXPECT_THAT(refusal([](Motion& motion) { motion.fps = -1; }),
                HasSubstr("/fps is -1; it must be above 0"));
    EXPECT_THAT(
        refusal([](Motion& motion) { motion.joints->skeleton.joints[1].parent = 1; }),
        HasSubstr(
            "/joints/parents: joint 1 (\"head\") has the parent 1; an earlier joint or -1 is expected"));
    EXPECT_THAT(refusal([](Motion& motion) {
                    motion.joints->turns[2] = {0.5f, 0, 0, 0};
                }),
                HasSubstr("/joints/turns: the turn 2 has the length 0.5; unit quaternions"));
    EXPECT_THAT(refusal([](Motion& motion) { motion.joints->translations[1].y = NAN; }),
                HasSubstr("/joints/translations: element 4 is nan; all must be finite and below 1000000000"));
    EXPECT_THAT(refusal([](Motion& motion) { motion.keypoints->confidence[0] = 1.5f; }),
                HasSubstr("/keypoints3d/confidence holds 1.5; numbers from 0 to 1 are expected"));
}

TEST_F(MotionHdf5, RefusesDamage) {
    write_motion_hdf5(folder_ / "a.h5", small_motion());
    std::vector<std::byte> bytes = read_bytes(folder_ / "a.h5");
    bytes.resize(bytes.size() / 2);
    write_bytes(folder_ / "a.h5", bytes);
    EXPECT_THAT(refusal_of([&] { read_motion(folder_ / "a.h5"); }), HasSubstr("a.h5: "));
}

TEST(MotionCsv, WritesKeypointsThatReadBack) {
    const testing::TemporaryFolder folder;
    Motion motion = small_motion();
    motion.fps = 30;
    motion.keypoints->names = {"nose", "left_shoulder", "right_shoulder", "pelvis"};
    motion.keypoints->points = {{0, 1.6f, 0.1f}, {0.2f, 1.4f, 0}, {-0.2f, 1.4f, 0}, {0, 0.9f, 0},
                                {0, 1.7f, 0.1f}, {0.2f, 1.4f, 0}, {-0.2f, 1.4f, 0}, {0, 0.9f, 0},
                                {0, 0, 0},       {0.2f, 1.4f, 0}, {-0.2f, 1.4f, 0}, {0, 0.9f, 0}};
    motion.keypoints->confidence = {1, 1, 1, 1, 0.5f, 1, 1, 1, 0, 1, 1, 1};
    write_motion_csv(folder / "a.csv", motion);
    const Motion again = read_motion(folder / "a.csv");
    EXPECT_EQ(again.fps, 30);
    EXPECT_EQ(again.keypoints->names, motion.keypoints->names);
    EXPECT_EQ(again.keypoints->confidence, motion.keypoints->confidence);
    for (size_t i = 0; i < 12; ++i) {
        EXPECT_LT(distance(again.keypoints->points[i], motion.keypoints->points[i]), 1e-6f) << i;
    }
}

TEST(MotionCsv, WritesWorldPlacesOfJoints) {
    const testing::TemporaryFolder folder;
    Motion motion = small_motion();
    motion.keypoints.reset();
    motion.fps = 10;
    motion.joints->skeleton.joints[0].name = "hip,s";
    write_motion_csv(folder / "a.csv", motion);
    EXPECT_EQ(read_text(folder / "a.csv"),
              "time,hip_s_x,hip_s_y,hip_s_z,joint head_x,joint head_y,joint head_z\n"
              "0,0,0.9,0,0,1.5,0\n0.1,0.1,0.9,0,0.1,1.5,0\n0.2,0.2,0.9,0,0.2,1.5,0\n");
}

}  // namespace
}  // namespace chironomia
