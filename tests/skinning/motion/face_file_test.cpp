// Faces of OpenFace, ARKit and our own tables, through read_motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <locale>
#include <map>
#include <numbers>

#include "core/files/files.h"
#include "core/text.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::refusal_of;

class FaceFile : public ::testing::Test {
  protected:
    Motion read(const std::string& text, std::optional<double> fps = {}) {
        write_text(folder_ / "a.csv", text);
        MotionHints hints;
        hints.fps = fps;
        return read_motion(folder_ / "a.csv", hints);
    }

    std::string refusal(const std::string& text, std::optional<double> fps = {}) {
        const std::string message = refusal_of([&] { read(text, fps); });
        return message.substr(std::min(message.size(), message.find("a.csv")));
    }

    static Vec3 ahead(const Quat& head) { return head * Vec3(0, 0, 1); }

    testing::TemporaryFolder folder_;
};

// The line of sight against the head.
Vec3 sight(const Vec2& eye) {
    return {std::sin(eye.x) * std::cos(eye.y), std::sin(eye.y), std::cos(eye.x) * std::cos(eye.y)};
}

void expect_near(const Vec3& a, const Vec3& b, float limit = 1e-6f) {
    EXPECT_LT(distance(a, b), limit) << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y
                                     << ' ' << b.z;
}

using PyFeatFile = FaceFile;

TEST_F(PyFeatFile, ShowsLikelihoodsAsIntensities) {
    const std::string table =
        "FaceRectX,FaceScore,Pitch,Roll,Yaw,AU01,AU11,AU12,AU43,happiness,input,frame\n"
        "10,0.99,5,1,-3,0.2,0.4,1,0,1,v.mp4,0\n10,,,,,,,,,,v.mp4,1\n10,0.9,5,1,-3,0.4,0.4,0.5,0.6,1,v.mp4,2\n";
    const Motion motion = read(table, 25);
    const FaceTrack& face = motion.face.value();
    EXPECT_EQ(motion.frames, 3u);
    EXPECT_EQ(face.channels,
              (std::vector<FaceChannel>{{1, FaceSide::both}, {12, FaceSide::both}, {45, FaceSide::both}}));
    EXPECT_EQ(face.intensities, (std::vector<float>{1, 5, 0, 1.5f, 3.75f, 1.5f, 2, 2.5f, 3}));
    EXPECT_EQ(face.confidence, (std::vector<float>{1, 0, 1}));
    EXPECT_THAT(motion.notes,
                Contains("Py-Feat CSV: 3 action units, how likely each is shown as its intensity"));
    EXPECT_THAT(motion.notes, Contains("units that are not shown, left out: AU11"));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("head: left out")));
    EXPECT_EQ(
        refusal(table),
        "a.csv: there is no column of times, such as \"timestamp\" or \"time_ms\"; set the rate with --motion-fps");
    EXPECT_THAT(refusal("FaceScore,AU12,frame\n0.9,2,0\n0.9,1,1\n", 25),
                HasSubstr("a.csv:2: column \"AU12\": 2 does not lie between 0 and 1"));
}

using OpenFaceFile = FaceFile;

TEST_F(OpenFaceFile, GivesAFaceAlone) {
    const Motion motion = read(
        "frame, timestamp, confidence, success, AU01_r, AU45_r, AU01_c\n"
        "1, 0, 0.9, 1, 0.5, 0, 1\n2, 0.04, 0.8, 1, 1.25, 5, 1\n");
    EXPECT_FALSE(motion.joints || motion.keypoints);
    EXPECT_EQ(motion.fps, 25);
    EXPECT_EQ(motion.frames, 2u);
    const FaceTrack& face = motion.face.value();
    EXPECT_EQ(face.channels, (std::vector<FaceChannel>{{1, FaceSide::both}, {45, FaceSide::both}}));
    EXPECT_EQ(face.intensities, (std::vector<float>{0.5f, 0, 1.25f, 5}));
    EXPECT_EQ(face.confidence, (std::vector<float>{0.9f, 0.8f}));
    EXPECT_TRUE(face.head.empty() && face.gaze.empty());
    EXPECT_THAT(motion.notes, Contains("OpenFace CSV: 2 action units"));
}

TEST_F(OpenFaceFile, TurnsTheHeadAsThePersonDid) {
    const Motion motion = read(
        "timestamp,pose_Rx,pose_Ry,pose_Rz\n"
        "0,0,0,0\n0.04,0.5,0,0\n0.08,0,0.5,0\n0.12,0,0,0.5\n0.16,0.3,-0.4,0.2\n");
    const std::vector<Quat>& head = motion.face->head;
    const float s = std::sin(0.5f), c = std::cos(0.5f);
    expect_near(ahead(head[0]), {0, 0, 1});
    expect_near(ahead(head[1]), {0, -s, c});          // down
    expect_near(ahead(head[2]), {-s, 0, c});          // to the person's right
    expect_near(head[3] * Vec3(0, 1, 0), {s, c, 0});  // the crown to the person's left
    // The three together by the matrix product of theirs, seen after half a turn about x.
    const auto about = [](float angle, const Vec3& axis) {
        return Mat3(glm::mat4_cast(glm::angleAxis(angle, axis)));
    };
    const Mat3 theirs = about(0.3f, {1, 0, 0}) * about(-0.4f, {0, 1, 0}) * about(0.2f, {0, 0, 1});
    const Mat3 flip(1, 0, 0, 0, -1, 0, 0, 0, -1);
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
        expect_near(head[4] * axis, flip * (theirs * (flip * axis)));
}

// Whoever turns the head away and still looks into the camera has turned the eyes back by as much.
TEST_F(OpenFaceFile, TakesTheHeadOutOfTheGaze) {
    const Motion motion = read(
        "timestamp,gaze_0_x,gaze_0_y,gaze_0_z,gaze_1_x,gaze_1_y,gaze_1_z,pose_Rx,pose_Ry,pose_Rz\n"
        "0,0,0,-1,0,0,-1,0,0,0\n"
        "0.04,0,0,-1,0,0,-1,0,0.25,0\n"
        "0.08,0,0,-1,0,0,-1,0.25,0,0\n"
        "0.12,0.6,0,-0.8,0,0.6,-0.8,0,0,0\n");
    const std::vector<Gaze>& gaze = motion.face->gaze;
    expect_near(sight(gaze[0].left), {0, 0, 1});
    EXPECT_NEAR(gaze[1].left.x, 0.25, 1e-6);  // the head went to the right, the eyes to the left
    EXPECT_NEAR(gaze[1].right.x, 0.25, 1e-6);
    EXPECT_NEAR(gaze[2].left.y, 0.25, 1e-6);             // the head down, the eyes up
    expect_near(sight(gaze[3].right), {0.6f, 0, 0.8f});  // eye 0 is the person's right; x is their left
    expect_near(sight(gaze[3].left), {0, -0.6f, 0.8f});  // y is down
}

TEST_F(OpenFaceFile, TakesGazeAnglesWithoutVectors) {
    const Motion motion = read("timestamp,gaze_angle_x,gaze_angle_y\n0,0.3,0.2\n0.04,0,0\n");
    expect_near(sight(motion.face->gaze[0].left), normalize(Vec3(std::tan(0.3f), -std::tan(0.2f), 1)));
    EXPECT_EQ(motion.face->gaze[0].left, motion.face->gaze[0].right);
    EXPECT_THAT(motion.notes, Contains("gaze: the head is not known, so it is taken to be still"));
}

TEST_F(OpenFaceFile, GoesByTimeAndNotByRow) {
    // At 25 frames/s the rows 0.08 and 0.12 are missing.
    const Motion motion = read("timestamp,AU12_r\n0,0\n0.04,1\n0.16,4\n0.2,5\n0.24,5\n0.28,5\n");
    EXPECT_EQ(motion.fps, 25);
    EXPECT_THAT(motion.face->intensities,
                ::testing::Pointwise(::testing::FloatEq(), std::vector<float>{0, 1, 2, 3, 4, 5, 5, 5}));
    EXPECT_EQ(motion.face->confidence, (std::vector<float>{1, 1, 0, 0, 1, 1, 1, 1}));
    EXPECT_THAT(
        motion.notes,
        Contains(HasSubstr("tracking: 2 of 8 frames failed (success 0 or confidence under 0.5) or are "
                           "missing, and are bridged from the good ones beside them; the longest stretch "
                           "is 2 frames (0.080 s) at 0.080 s")));
}

TEST_F(OpenFaceFile, BridgesFailedFrames) {
    const Motion motion = read(
        "timestamp,confidence,success,pose_Rx,pose_Ry,pose_Rz,AU12_r\n"
        "0.00,0.02,0,9,9,9,9\n"
        "0.04,0.98,1,0,0,0,2\n"
        "0.08,0.02,0,nonsense,,,\n"
        "0.12,0.4,1,1,1,1,5\n"
        "0.16,0.98,1,0,-0.6,0,5\n"
        "0.20,0.1,1,0,0,0,0\n");
    EXPECT_THAT(motion.face->intensities,
                ::testing::Pointwise(::testing::FloatEq(), std::vector<float>{2, 2, 3, 4, 5, 5}));
    EXPECT_EQ(motion.face->confidence, (std::vector<float>{0, 0.98f, 0, 0, 0.98f, 0}));
    for (size_t t = 0; t < 6; ++t) {
        const float yaw = std::vector<float>{0, 0, 0.2f, 0.4f, 0.6f, 0.6f}[t];
        expect_near(ahead(motion.face->head[t]), {std::sin(yaw), 0, std::cos(yaw)});
    }
    EXPECT_THAT(motion.notes, Contains(HasSubstr("4 of 6 frames failed")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("2 frames (0.080 s) at 0.080 s")));
}

TEST_F(OpenFaceFile, MixesUnevenRowsByTheirTimes) {
    const Motion motion =
        read("timestamp,confidence,AU12_r\n0,1,0\n0.04,0.6,2\n0.085,0.9,4\n0.12,1,0\n0.16,1,0\n");
    EXPECT_EQ(motion.fps, 25);
    EXPECT_NEAR(motion.face->intensities[2], 2 + 2 * 40.0 / 45, 0.05);
    EXPECT_EQ(motion.face->confidence[2], 0.6f);
    EXPECT_EQ(motion.frames, 5u);
}

TEST_F(OpenFaceFile, FindsTheRateBehindRoundedTimes) {
    for (const auto& [rate, meant] : std::map<double, double>{{30, 30},
                                                              {30000.0 / 1001, 30000.0 / 1001},
                                                              {25, 25},
                                                              {60, 60},
                                                              {24000.0 / 1001, 24000.0 / 1001}}) {
        std::string text = "timestamp,AU12_r\n";
        for (int n = 0; n < 300; ++n) text += format("{:.3f},{}\n", n / rate, n % 6);
        const Motion motion = read(text);
        EXPECT_DOUBLE_EQ(motion.fps, meant);
        ASSERT_EQ(motion.frames, 300u);
        for (size_t n = 0; n < 300; ++n) EXPECT_FLOAT_EQ(motion.face->intensities[n], float(n % 6)) << n;
    }
}

TEST_F(OpenFaceFile, TakesARateByHandWithoutTimes) {
    const Motion motion = read("frame,AU12_r\n1,0\n2,1\n4,3\n", 10);
    EXPECT_EQ(motion.fps, 10);
    EXPECT_THAT(motion.face->intensities,
                ::testing::Pointwise(::testing::FloatEq(), std::vector<float>{0, 1, 2, 3}));
    EXPECT_EQ(read("AU12_r,AU45_r\n0,0\n1,0\n", 50).frames, 2u);
    EXPECT_EQ(read("AU12_r,AU45_r\n3,4\n", 50).face->intensities, (std::vector<float>{3, 4}));
    EXPECT_THAT(motion.notes, Contains("rate: 10 frames/s, set by hand"));
}

TEST_F(OpenFaceFile, SaysWhatItLeavesOut) {
    const Motion motion = read("timestamp,AU12_r,AU11_r,AU28_c,AU12_c\n2.5,5.04,1,0,1\n2.54,-0.03,1,1,1\n");
    EXPECT_EQ(motion.face->intensities, (std::vector<float>{5, 0}));
    EXPECT_THAT(motion.notes, Contains("units that are not known, left out: AU11_r"));
    EXPECT_THAT(motion.notes, Contains("AU28_c: present in 1 rows, but without intensity, left out"));
    EXPECT_THAT(motion.notes, Contains("time: the first frame is at 2.5 s, which is second 0 here"));
}

TEST_F(OpenFaceFile, RefusesWhatOpenFaceWouldNotWrite) {
    const std::map<std::string, std::string> refusals = {
        {"timestamp,AU12_r\n0,0\n0.04,5.2\n", "a.csv:3: column \"AU12_r\": 5.2 does not lie between 0 and 5"},
        {"timestamp,AU12_r\n0,0\n0.04,-0.2\n",
         "a.csv:3: column \"AU12_r\": -0.2 does not lie between 0 and 5"},
        {"timestamp,AU12_r\n0,0\n0.04,nan\n", "a.csv:3: column \"AU12_r\": nan does not lie between 0 and 5"},
        {"timestamp,AU12_r\n0,0\n0.04,x\n", "a.csv:3: column \"AU12_r\": \"x\" is no number"},
        {"timestamp;AU12_r\n0,00;0,5\n",
         "a.csv:2: column \"timestamp\": \"0,00\" is no number; it is written with a comma, export it with a "
         "decimal point"},
        {"timestamp,AU12_r\n0,00,0,5\n",
         "a.csv:2: 4 values, the header has 2 columns; if numbers are written with a comma, export them with "
         "a decimal point"},
        {"timestamp,AU12_r\n0\n", "a.csv:2: 1 values, the header has 2 columns"},
        {"timestamp,AU12_r\n", "a.csv: no rows follow the header"},
        {"timestamp,AU12_r,AU12_r\n0,0,0\n", "a.csv: the column \"AU12_r\" comes twice"},
        {"timestamp,AU12_r,AU012_r\n0,0,0\n", "a.csv: the column \"AU012_r\" holds action unit 12 again"},
        {"frame,AU12_r\n1,0\n2,0\n",
         "a.csv: there is no column of times, such as \"timestamp\" or \"time_ms\"; set the rate with --motion-fps"},
        {"timestamp,AU12_r\n0,1\n", "a.csv: 1 row, and a rate takes 2; set it with --motion-fps"},
        {"timestamp,AU12_c\n0,1\n0.04,1\n",
         "a.csv: no column holds an intensity (AU01_r), the head (pose_Rx) or the gaze (gaze_0_x); export one of them"},
        {"timestamp,pose_Rx,pose_Rz\n0,0,0\n",
         "a.csv: there is pose_Rx, pose_Rz, but not pose_Ry; export them together"},
        {"timestamp,gaze_0_x,gaze_0_y,gaze_0_z\n0,0,0,-1\n",
         "a.csv: there is gaze_0_x, gaze_0_y, gaze_0_z, but not gaze_1_x, gaze_1_y, gaze_1_z; export them "
         "together"},
        {"timestamp,pose_Rx,pose_Ry,pose_Rz\n0,0,12.5,0\n0.04,0,0,0\n",
         "a.csv:2: column \"pose_Ry\": 12.5 does not lie between -6.3 and 6.3; radians are expected"},
        {"timestamp,gaze_angle_x,gaze_angle_y\n0,0,2\n0.04,0,0\n",
         "a.csv:2: column \"gaze_angle_y\": 2 does not lie between -1.57 and 1.57; radians are expected"},
        {"timestamp,success,AU12_r\n0,2,0\n0.04,1,0\n", "a.csv:2: column \"success\": 2 is neither 0 nor 1"},
        {"timestamp,confidence,AU12_r\n0,98,0\n0.04,1,0\n",
         "a.csv:2: column \"confidence\": 98 does not lie between -1 and 1"},
        {"timestamp,success,AU12_r\n0,0,0\n0.04,0,0\n",
         "a.csv: in none of its 2 rows was a face tracked (success 0 or confidence under 0.5); there is "
         "nothing to show"},
        {"timestamp,face_id,AU12_r\n0,0,0\n0.04,0,0\n0.08,1,0\n",
         "a.csv: it holds 2 faces (face_id 0 in 2 rows, 1 in 1 rows); keep the rows of one person"},
        {"timestamp,AU12_r\n0,0\n0.08,1\n0.04,2\n",
         "a.csv:4: the time 0.04 s comes after 0.08 s in line 3; sort the rows by time"},
        {"timestamp,AU12_r\n0,0\n0.04,1\n0.04,2\n",
         "a.csv:4: the time 0.04 s repeats 0.04 s in line 3; leave one of the rows out"},
        {"timestamp,AU12_r\n0,0\n0.04,1\n400,2\n",
         "a.csv:4: the time jumps from 0.04 s in line 3 to 400 s; at most 60 s can be bridged, cut the file "
         "there"},
        {"timestamp,AU12_r\n0,0\n1e12,1\n",
         "a.csv:3: column \"timestamp\": 1000000000000 is out of every range; a finite number is expected"},
        {"timestamp,AU12_r\n0,0\n0.0001,1\n0.0002,2\n",
         "a.csv: the rows are 0.0001 s apart, which are 10000 frames/s; at most 1000 are read"},
        {"timestamp,AU12_r\n0,0\n0.001,1\n0.002,1\n0.003,1\n59,2\n",
         "a.csv: 5 rows over 59 s would be 59001 frames at 1000 frames/s; their times are too uneven to be "
         "frames"},
    };
    for (const auto& [text, message] : refusals) EXPECT_EQ(refusal(text), message);
}

// A table as OpenFace writes it, 10 s at 30 frames/s: each second one unit more ramps up, the eyes blink
// every 3 s, head and gaze swing, and ten frames failed.
std::string openface_table(const std::string& separator) {
    constexpr std::array kUnits = {1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 20, 23, 25, 26, 45};
    std::vector<std::string> names = {"frame",    "face_id",      "timestamp",    "confidence", "success",
                                      "gaze_0_x", "gaze_0_y",     "gaze_0_z",     "gaze_1_x",   "gaze_1_y",
                                      "gaze_1_z", "gaze_angle_x", "gaze_angle_y", "pose_Tx",    "pose_Ty",
                                      "pose_Tz",  "pose_Rx",      "pose_Ry",      "pose_Rz"};
    for (const int unit : kUnits) names.push_back(format("AU{:02}_r", unit));
    for (const int unit : kUnits) names.push_back(format("AU{:02}_c", unit));
    std::string table = join(names, separator) + "\n";
    for (int t = 0; t < 300; ++t) {
        const double seconds = t / 30.0, swing = std::sin(2 * std::numbers::pi * seconds / 4);
        const bool failed = t >= 140 && t < 150;
        const double across = failed ? 0 : 0.2 * swing, down = failed ? 0 : 0.1 * std::cos(seconds);
        std::vector<std::string> cells = {std::to_string(t + 1), "0", format("{:.3f}", seconds),
                                          failed ? "0.10" : "0.98", failed ? "0" : "1"};
        for (int eye = 0; eye < 2; ++eye) {
            cells.push_back(format("{:.6f}", std::sin(across) * std::cos(down)));
            cells.push_back(format("{:.6f}", std::sin(down)));
            cells.push_back(format("{:.6f}", -std::cos(across) * std::cos(down)));
        }
        for (const double number :
             {across, down, 12 * swing, 5.0, 600.0, 0.15 * std::sin(seconds), 0.25 * swing, 0.1 * swing})
            cells.push_back(format("{:.3f}", failed ? 0.0 : number));
        std::vector<std::string> seen;
        for (std::size_t u = 0; u < kUnits.size(); ++u) {
            const double ramp = 5 * (seconds - static_cast<double>(u % 10));
            double intensity = ramp > 0 && ramp <= 5 ? ramp : 0;
            if (kUnits[u] == 45)
                intensity =
                    t % 90 < 5 ? std::array{1.5, 3.5, 5.0, 3.5, 1.5}[static_cast<std::size_t>(t % 90)] : 0;
            if (failed) intensity = 0;
            cells.push_back(format("{:.2f}", intensity));
            seen.emplace_back(intensity > 1 ? "1.00" : "0.00");
        }
        cells.insert(cells.end(), seen.begin(), seen.end());
        table += join(cells, separator) + "\n";
    }
    return table;
}

// Both styles of header hold the same numbers; the truth is read here by splitting lines.
class OpenFaceData : public FaceFile, public ::testing::WithParamInterface<std::vector<std::string>> {
  protected:
    // The file in both styles: those that are given, or those that are made.
    void SetUp() override {
        commas_ = folder_ / "v22_comma.csv";
        spaces_ = folder_ / "v20_commaspace.csv";
        if (!GetParam().empty()) {
            commas_ = testing::test_file(GetParam()[0]);
            spaces_ = testing::test_file(GetParam()[1]);
            return;
        }
        write_text(commas_, openface_table(","));
        write_text(spaces_, openface_table(", "));
    }

    static std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& file) {
        std::map<std::string, std::vector<double>> columns;
        std::vector<std::string> names;
        const std::string text = read_text(file);
        for (const std::string_view line : split(text, '\n')) {
            const auto cells = split(line, ',');
            for (size_t i = 0; i < cells.size() && cells.size() > 1; ++i) {
                if (names.size() < cells.size())
                    names.emplace_back(trim(cells[i]));
                else
                    columns[names[i]].push_back(parse_number(cells[i]).value());
            }
        }
        return columns;
    }

    std::filesystem::path commas_, spaces_;
};

std::vector<std::vector<std::string>> openface_tables() {
    std::vector<std::vector<std::string>> tables = {{}};
    const auto others =
        testing::present({"../shared/data/motion/openface/openface_synthetic_v22_comma.csv",
                          "../shared/data/motion/openface/openface_synthetic_v20_commaspace.csv"});
    if (others.size() == 2) tables.push_back(others);
    return tables;
}

INSTANTIATE_TEST_SUITE_P(Tables, OpenFaceData, ::testing::ValuesIn(openface_tables()),
                         [](const auto& info) { return info.index == 0 ? "made" : "shared"; });

TEST_P(OpenFaceData, BothStylesAgreeToTheBit) {
    const Motion a = read_motion(commas_), b = read_motion(spaces_);
    EXPECT_EQ(a.fps, 30);
    EXPECT_EQ(a.frames, 300u);
    EXPECT_EQ(a.fps, b.fps);
    EXPECT_EQ(a.notes, b.notes);
    EXPECT_EQ(a.face->channels, b.face->channels);
    EXPECT_EQ(a.face->intensities, b.face->intensities);
    EXPECT_EQ(a.face->head, b.face->head);
    EXPECT_EQ(a.face->confidence, b.face->confidence);
}

TEST_P(OpenFaceData, IsTheRampsAndSinesOfTheFile) {
    const Motion motion = read_motion(commas_);
    const FaceTrack& face = *motion.face;
    auto columns = columns_of(commas_);
    ASSERT_EQ(columns["timestamp"].size(), motion.frames);
    ASSERT_EQ(face.channels.size(), 17u);
    for (size_t t = 0; t < motion.frames; ++t) {
        if (columns["success"][t] == 0) continue;
        EXPECT_EQ(face.confidence[t], 0.98f);
        for (size_t c = 0; c < 17; ++c) {
            const auto& truth = columns[format("AU{:02}_r", face.channels[c].unit)];
            EXPECT_FLOAT_EQ(face.intensities[t * 17 + c], static_cast<float>(truth[t]));
        }
        // The axis that the face looks along, and the line of sight in the camera's space.
        const double x = columns["pose_Rx"][t], y = columns["pose_Ry"][t];
        expect_near(ahead(face.head[t]),
                    Vec3(-std::sin(y), -std::sin(x) * std::cos(y), std::cos(x) * std::cos(y)), 1e-5f);
        const Vec3 way = face.head[t] * sight(face.gaze[t].left);
        expect_near(way, Vec3(columns["gaze_0_x"][t], -columns["gaze_0_y"][t], -columns["gaze_0_z"][t]),
                    1e-5f);
        EXPECT_NEAR(std::atan2(way.x, way.z), columns["gaze_angle_x"][t], 6e-4);
        EXPECT_NEAR(std::asin(-way.y), columns["gaze_angle_y"][t], 6e-4);  // as this file was made
    }
    // One blink every three seconds; its lids close within a few frames.
    const auto blink = static_cast<size_t>(
        std::find(face.channels.begin(), face.channels.end(), FaceChannel{45}) - face.channels.begin());
    for (size_t t = 0; t + 2 < motion.frames; t += 90)
        EXPECT_GT(std::max(face.intensities[(t + 1) * 17 + blink], face.intensities[(t + 2) * 17 + blink]),
                  3);
}

TEST_P(OpenFaceData, BridgesItsTenFailedFrames) {
    const Motion motion = read_motion(commas_);
    const FaceTrack& face = *motion.face;
    for (size_t t = 0; t < 300; ++t) EXPECT_EQ(face.confidence[t] == 0, t >= 140 && t < 150) << t;
    EXPECT_THAT(motion.notes, Contains(HasSubstr("tracking: 10 of 300 frames failed")));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("the longest stretch is 10 frames (0.333 s) at 4.667 s")));
    // Half way between the good frames on both sides.
    const Quat middle = normalize(slerp(face.head[139], face.head[150], 0.5f));
    const Quat bridged = normalize(slerp(face.head[144], face.head[145], 0.5f));
    EXPECT_LT(angle_between(middle, bridged), 1e-3f);
}

// Decimal commas and points between thousands, for streams; for the C library where such a locale is
// installed.
struct CommaNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST_P(OpenFaceData, TakesNoNoticeOfTheLocale) {
    const auto read_and_write = [&](const std::string& name) {
        const Motion motion = read_motion(commas_);
        write_motion_csv(folder_ / name, motion);
        return motion;
    };
    const Motion plain = read_and_write("plain.csv");
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const std::locale cpp_before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    const Motion local = read_and_write("local.csv");
    std::locale::global(cpp_before);
    std::setlocale(LC_ALL, before.c_str());
    EXPECT_EQ(local.face->intensities, plain.face->intensities);
    EXPECT_EQ(local.face->head, plain.face->head);
    EXPECT_EQ(local.notes, plain.notes);
    EXPECT_EQ(read_text(folder_ / "local.csv"), read_text(folder_ / "plain.csv"));
}

using ArkitFile = FaceFile;

float intensity_of(const Motion& motion, size_t frame, const FaceChannel& channel) {
    const FaceTrack& face = motion.face.value();
    const auto found = std::find(face.channels.begin(), face.channels.end(), channel);
    EXPECT_NE(found, face.channels.end()) << to_text(channel);
    if (found == face.channels.end()) return -1;
    return face
        .intensities[frame * face.channels.size() + static_cast<size_t>(found - face.channels.begin())];
}

TEST_F(ArkitFile, BecomesUnitsWithSides) {
    const Motion motion = read(
        "time,eyeBlinkLeft,eyeBlinkRight,jawOpen,mouthClose,mouthSmileLeft,mouthRollLower,mouthRollUpper,"
        "jawLeft,cheekPuff,browInnerUp,tongueOut\n"
        "0,1,0.2,0.6,0.2,0.5,0.1,0.4,0.3,0.2,0.4,1\n0.04,0,0,0.2,0.4,0,0,0,0,0,0,0\n");
    EXPECT_EQ(motion.fps, 25);
    const auto at = [&](int unit, FaceSide side = FaceSide::both) {
        return intensity_of(motion, 0, {unit, side});
    };
    EXPECT_FLOAT_EQ(at(45, FaceSide::left), 5);
    EXPECT_FLOAT_EQ(at(45, FaceSide::right), 1);
    EXPECT_FLOAT_EQ(at(26), 5 * 0.6f / 0.7f);  // 0.7 are a whole drop
    EXPECT_FLOAT_EQ(at(25), 5 * 0.4f / 0.7f);  // 0.6 open, 0.2 of it closed again
    EXPECT_FLOAT_EQ(at(8), 5 * 0.2f / 0.7f);
    EXPECT_FLOAT_EQ(at(12, FaceSide::left), 2.5f);
    EXPECT_FLOAT_EQ(at(28), 2);  // the larger lip
    EXPECT_FLOAT_EQ(at(30, FaceSide::left), 1.5f);
    EXPECT_FLOAT_EQ(at(34), 1);
    EXPECT_FLOAT_EQ(at(1), 2);
    EXPECT_FLOAT_EQ(at(19), 5);
    EXPECT_EQ(intensity_of(motion, 1, {25, FaceSide::both}), 0);
    EXPECT_THAT(motion.notes, Contains("ARKit: 11 of 52 coefficients, as 11 channels of action units"));
}

TEST_F(ArkitFile, ReadsLiveLinkFace) {
    const Motion motion = read(
        "Timecode,BlendshapeCount,EyeBlinkLeft,JawOpen,MouthLeft,MouthShrugUpper,HeadYaw,HeadPitch,HeadRoll\n"
        "23:59:59:58.500,61,0,0,0,0,0.1,0,0\n"
        "23:59:59:59.500,61,0.2,0,0.25,0,0.5,0,0\n"
        "00:00:00:00.500,61,0.4,0,0,0,0,0.5,0\n"
        "00:00:00:01.500,0\n"
        "00:00:00:02.500,61,0.8,0,0,0,0,0,0.5\n");
    EXPECT_EQ(motion.fps, 60);
    EXPECT_EQ(motion.frames, 5u);
    for (size_t t = 0; t < 5; ++t)
        EXPECT_NEAR(intensity_of(motion, t, {45, FaceSide::left}), static_cast<double>(t), 1e-4);
    EXPECT_EQ(motion.face->confidence, (std::vector<float>{1, 1, 1, 0, 1}));
    const float s = std::sin(0.5f), c = std::cos(0.5f);
    expect_near(ahead(motion.face->head[1]), {s, 0, c}, 1e-5f);           // to the left
    expect_near(ahead(motion.face->head[2]), {0, s, c}, 1e-5f);           // up
    expect_near(motion.face->head[4] * Vec3(1, 0, 0), {c, s, 0}, 1e-5f);  // the left ear up
    EXPECT_THAT(motion.notes, Contains("time codes: they count 60 frames in a second"));
    EXPECT_THAT(motion.notes, Contains("no action unit, left out: mouthLeft (up to 0.25)"));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("1 of 5 frames failed (BlendshapeCount 0)")));
}

constexpr const char* kLooks =
    "eyeLookOutLeft,eyeLookInLeft,eyeLookUpLeft,eyeLookDownLeft,"
    "eyeLookOutRight,eyeLookInRight,eyeLookUpRight,eyeLookDownRight";

TEST_F(ArkitFile, MayHoldTheJawAlone) {
    const Motion motion = read("time,jawOpen\n0,0\n0.04,0.7\n");
    ASSERT_TRUE(motion.face);
    EXPECT_EQ(motion.frames, 2u);
}

TEST_F(ArkitFile, LooksWhereTheCoefficientsSay) {
    const Motion motion =
        read(format("time,{}\n0,0.4,0,0.5,0,0,0.4,0.5,0\n0.04,0,0.2,0,0.1,0.2,0,0,0.1\n", kLooks));
    const std::vector<Gaze>& gaze = motion.face->gaze;
    for (const Vec2& eye : {gaze[0].left, gaze[0].right}) {
        EXPECT_NEAR(glm::degrees(eye.x), 18, 1e-4);
        EXPECT_NEAR(glm::degrees(eye.y), 15, 1e-4);
    }
    for (const Vec2& eye : {gaze[1].left, gaze[1].right}) {
        EXPECT_NEAR(glm::degrees(eye.x), -9, 1e-4);
        EXPECT_NEAR(glm::degrees(eye.y), -3, 1e-4);
    }
}

TEST_F(ArkitFile, TurnsEyeColumnsThatRunAgainstTheCoefficients) {
    const std::string header = format("time,{},LeftEyeYaw,LeftEyePitch,RightEyeYaw,RightEyePitch\n", kLooks);
    const Motion same =
        read(header + "0,0.4,0,0.5,0,0,0.4,0.5,0,0.3,0.2,0.31,0.2\n0.04,0,0,0,0,0,0,0,0,0,0,0,0\n");
    EXPECT_EQ(same.face->gaze[0].left, Vec2(0.3f, 0.2f));
    EXPECT_EQ(same.face->gaze[0].right, Vec2(0.31f, 0.2f));
    const Motion other =
        read(header + "0,0.4,0,0.5,0,0,0.4,0.5,0,-0.3,-0.2,-0.31,-0.2\n0.04,0,0,0,0,0,0,0,0,0,0,0,0\n");
    EXPECT_EQ(other.face->gaze[0].left, Vec2(0.3f, 0.2f));
    EXPECT_THAT(
        other.notes,
        Contains("gaze: the eyes' yaw counts to the person's right, as the eyeLook coefficients show"));
    EXPECT_THAT(other.notes, Contains("gaze: the eyes' pitch counts down, as the eyeLook coefficients show"));
    const Motion off = read(header + "0,0.4,0,0,0,0,0.4,0,0,0,0,0,0\n0.04,0,0,0,0,0,0,0,0,0,0,0,0\n");
    EXPECT_NEAR(glm::degrees(off.face->gaze[0].left.x), 18, 1e-4);
    EXPECT_THAT(off.notes,
                Contains("LeftEyeYaw, LeftEyePitch, RightEyeYaw, RightEyePitch: 0 in every row, so "
                         "nothing is known of it"));
}

TEST_F(ArkitFile, TakesTheRateOfTimeCodesByHand) {
    const std::string text =
        "Timecode,eyeBlinkLeft,jawOpen,cheekPuff\n10:00:00:01,0,0,0\n10:00:00:02,1,0,0\n";
    EXPECT_THAT(refusal(text), HasSubstr("a.csv: how many frames in a second the time codes count cannot be "
                                         "found from them; set it with --motion-fps"));
    EXPECT_EQ(read(text, 24).fps, 24);
    EXPECT_THAT(refusal(text, 2), HasSubstr("a.csv:3: frame 2 of a second that has 2; set another rate with "
                                            "--motion-fps"));
}

TEST_F(ArkitFile, KnowsTheUnitsInTheNamesOfTimes) {
    for (const auto& [name, step] :
         {std::pair("Time (Seconds)", "0.04"), {"timestamp_us", "40000"}, {"Time [ms]", "40"}}) {
        const Motion motion =
            read(format("{},eyeBlinkLeft,jawOpen,cheekPuff\n0,0,0,0\n{},0,1,0\n", name, step));
        EXPECT_EQ(motion.fps, 25) << name;
    }
}

TEST_F(ArkitFile, TakesTimesOfAClockAndDates) {
    const std::string rows = "{0}0.040,0,0,0\n{0}0.080,0,1,0\n{0}0.120,0,0,0\n";
    for (const std::string before : {"00:00:1", "9:1", "2026-05-01 12:30:1", "177763680"}) {
        const Motion motion =
            read("time,eyeBlinkLeft,jawOpen,cheekPuff\n" + fmt::format(fmt::runtime(rows), before));
        EXPECT_EQ(motion.fps, 25) << before;
        EXPECT_EQ(motion.frames, 3u) << before;
    }
    EXPECT_THAT(refusal("time,eyeBlinkLeft,jawOpen,cheekPuff\n1e12,0,0,0\n"),
                HasSubstr("a.csv:2: column \"time\": 1000000000000 is out of every range"));
}

TEST_F(ArkitFile, RefusesWhatCannotBeMeant) {
    const std::string header = "time,eyeBlinkLeft,jawOpen,cheekPuff";
    const std::map<std::string, std::string> refusals = {
        {header + "\n0,0,45,0\n0.1,0,0,0\n", "a.csv:2: column \"jawOpen\": 45 does not lie between 0 and 1"},
        {header + "\n0,0,0\n0.1,0,0,0\n", "a.csv:2: 3 values, the header has 4 columns"},
        {header + ",JawOpen\n0,0,0,0,0\n", "a.csv: the column \"JawOpen\" comes twice"},
        {header + ",HeadYaw\n0,0,0,0,0\n",
         "a.csv: there is HeadYaw, but not HeadPitch, HeadRoll; export them together"},
        {header + ",HeadYaw,HeadPitch,HeadRoll\n0,0,0,0,0,30,0\n0.1,0,0,0,0,0,0\n",
         "a.csv:2: column \"HeadPitch\": 30 does not lie between -3.2 and 3.2; radians are expected"},
        {"eyeBlinkLeft,jawOpen,cheekPuff\n0,0,0\n",
         "a.csv: there is no column of times, such as \"timestamp\" or \"time_ms\"; set the rate with --motion-fps"},
        {"Timecode,eyeBlinkLeft,jawOpen,cheekPuff\nlate,0,0,0\n",
         "a.csv:2: column \"Timecode\": \"late\" is no time code; HH:MM:SS:FF.fff is expected"},
        {header + ",BlendshapeCount\n0,0,0,0,0\n0.1,0,0,0,0\n",
         "a.csv: in none of its 2 rows was a face tracked (BlendshapeCount 0); there is nothing to show"},
    };
    for (const auto& [text, message] : refusals) EXPECT_EQ(refusal(text), message);
}

// As BEAT has its faces: the names once, then a list for each frame.
TEST_F(ArkitFile, IsReadAsJson) {
    const std::string names = R"({"names": ["jawOpen", "mouthSmileLeft", "cheekPuff"], )";
    const Motion motion = read(names + R"("frames": [{"weights": [0.6, 0.5, 0], "time": 0, "rotation": []},
        {"weights": [0.2, 0, 0.4], "time": 0.016667, "rotation": []},
        {"weights": [0, 0, 1.004], "time": 0.033333, "rotation": [0, 0.1, 0]}]})");
    EXPECT_EQ(motion.fps, 60);
    ASSERT_EQ(motion.frames, 3u);
    EXPECT_FLOAT_EQ(intensity_of(motion, 0, {26, FaceSide::both}), 5 * 0.6f / 0.7f);
    EXPECT_FLOAT_EQ(intensity_of(motion, 0, {12, FaceSide::left}), 2.5f);
    EXPECT_NEAR(intensity_of(motion, 1, {34, FaceSide::both}), 2, 1e-3);
    EXPECT_FLOAT_EQ(intensity_of(motion, 2, {34, FaceSide::both}), 5);
    EXPECT_THAT(motion.notes, Contains("ARKit: 3 of 52 coefficients, as 4 channels of action units"));
    EXPECT_THAT(motion.notes, Contains(HasSubstr("rotation: left out")));
    const std::string frames = R"("frames": [{"weights": [0, 0, 0]}, {"weights": [0, 1, 0]}]})";
    EXPECT_EQ(read(names + R"("metadata": {"fps": 30}, )" + frames).fps, 30);
    EXPECT_EQ(read(names + frames, 25).fps, 25);
}

TEST_F(ArkitFile, RefusesJsonThatCannotBeMeant) {
    const auto refused = [&](const std::string& frames) {
        return refusal(R"({"names": ["jawOpen", "mouthSmileLeft", "cheekPuff"], "frames": [)" + frames +
                       "]}");
    };
    const std::string first = R"({"weights": [0, 0, 0], "time": 0}, )";
    EXPECT_EQ(refused(first + R"({"weights": [0, 0], "time": 0.1})"),
              "a.csv: frame 1: has no list \"weights\" of 3 numbers, one for each of \"names\"");
    EXPECT_EQ(refused(first + R"({"weights": [0, 0, 0]})"),
              "a.csv: frame 1: has no \"time\", and the first frame has one");
    EXPECT_EQ(refused(first + R"({"weights": [0, "a", 0], "time": 0.1})"),
              "a.csv: frame 1: \"mouthSmileLeft\" is \"a\", a number is needed");
    EXPECT_EQ(
        refused(first + R"({"weights": [0, 1.3, 0], "time": 0.1})"),
        "a.csv: frame 1: \"mouthSmileLeft\" is 1.3; 0 to 1 is expected, cut off what a model puts out beyond");
    EXPECT_EQ(refused(first + R"({"weights": [0, 0, 0], "time": 0})"),
              "a.csv: frame 1: its time is 0 s, and the frame before is at 0 s; frames go on in time");
    EXPECT_THAT(refused(R"({"weights": [0, 0, 0]}, {"weights": [0, 0, 0]})"),
                HasSubstr("set the rate with --motion-fps"));
}

using OurFaceTable = FaceFile;

Motion small_face() {
    Motion motion{.source = "made", .fps = 30, .frames = 3, .joints = {}, .keypoints = {}, .notes = {}};
    motion.face = FaceTrack{.channels = {{12, FaceSide::both}, {45, FaceSide::left}},
                            .intensities = {0, 1, 2.5f, 5, 5, 0},
                            .head = {kNoTurn, glm::angleAxis(0.3f, Vec3(0, 1, 0)), kNoTurn},
                            .gaze = {{{0.1f, 0.2f}, {0.3f, 0.4f}}, {}, {}},
                            .confidence = {1, 0.5f, 1}};
    return motion;
}

TEST_F(OurFaceTable, ReadsBackWhatItWrote) {
    const Motion motion = small_face();
    write_motion_csv(folder_ / "b.csv", motion);
    const Motion again = read_motion(folder_ / "b.csv");
    EXPECT_EQ(again.fps, 30);
    EXPECT_EQ(again.frames, 3u);
    EXPECT_EQ(again.face->channels, motion.face->channels);
    EXPECT_EQ(again.face->intensities, motion.face->intensities);
    EXPECT_EQ(again.face->confidence, motion.face->confidence);
    EXPECT_EQ(again.face->gaze[0].right, Vec2(0.3f, 0.4f));
    EXPECT_LT(angle_between(again.face->head[1], motion.face->head[1]), 1e-6f);
}

TEST_F(OurFaceTable, KeepsTheRightSideApartFromOpenFacesIntensities) {
    const Motion motion = read("time,AU12,AU45_L,AU45_R\n0,1,2,3\n0.1,1,2,3\n");
    EXPECT_EQ(motion.face->channels, (std::vector<FaceChannel>{{.unit = 12},
                                                               {.unit = 45, .side = FaceSide::left},
                                                               {.unit = 45, .side = FaceSide::right}}));
}

TEST_F(OurFaceTable, RefusesAFaceBesideABody) {
    Motion motion = small_face();
    motion.keypoints = KeypointTrack{.names = {"nose"}, .points = {3, Vec3(0)}, .confidence = {1, 1, 1}};
    EXPECT_THAT(
        refusal_of([&] { write_motion_csv(folder_ / "b.csv", motion); }),
        HasSubstr("b.csv: a table holds a body or a face, and made has both; write .h5, which keeps both"));
}

TEST_F(OurFaceTable, RefusesWhatIsNoFace) {
    const std::map<std::string, std::string> refusals = {
        {"time,AU12,AU12\n0,0,0\n", "a.csv: the column \"AU12\" comes twice"},
        {"time,AU12,confidence\n0,0,2\n0.1,0,0\n",
         "a.csv:2: column \"confidence\": 2 does not lie between 0 and 1"},
        {"time,head_qx,head_qy,head_qz\n0,0,0,0\n",
         "a.csv: there is head_qx, head_qy, head_qz, but not head_qw; export them together"},
        {"time,head_qx,head_qy,head_qz,head_qw\n0,0,0,0,2\n",
         "a.csv:2: head_qx, head_qy, head_qz, head_qw: the turn has the length 2; a unit quaternion is "
         "expected"},
    };
    for (const auto& [text, message] : refusals) EXPECT_EQ(refusal(text), message);
}

}  // namespace
}  // namespace chironomia
