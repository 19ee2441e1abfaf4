// Motions with frames that show nothing, in every form of file: the real binary reads, judges, converts and
// renders them, or refuses them, whatever frames are broken and whatever the rate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hdf5/writer.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "skinning/motion/picture/openpose_write.h"
#include "skinning/signal/resample.h"
#include "tests/study/process.h"
#include "tests/support/numpy_files.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using testing::TemporaryFolder;

constexpr size_t kFrames = 6;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kNothing = "nan";

// What a frame shows.
enum class Shows { person, nobody, zero, one_place, no_numbers };
using Clip = std::array<Shows, kFrames>;

struct NamedClip {
    std::string name;
    Clip clip{};
};

std::vector<NamedClip> broken_clips() {
    const std::vector<std::pair<std::string, std::vector<size_t>>> places = {
        {"first", {0}}, {"last", {kFrames - 1}}, {"middle", {kFrames / 2}}, {"half", {0, 2, 4}}};
    const std::vector<std::pair<std::string, Shows>> faults = {{"nobody", Shows::nobody},
                                                               {"zero", Shows::zero},
                                                               {"one-place", Shows::one_place},
                                                               {"no-numbers", Shows::no_numbers}};
    std::vector<NamedClip> clips;
    for (const auto& [place, frames] : places) {
        for (const auto& [fault, shows] : faults) {
            NamedClip clip{.name = place + "-" + fault};
            for (const size_t t : frames) clip.clip[t] = shows;
            clips.push_back(clip);
        }
    }
    return clips;
}

fs::path sample(const std::string& name) {
    return testing::source_dir() / "assets/samples" / name;
}

// Every tenth frame of the sample.
const Motion& sample_points() {
    static const Motion motion = [] {
        const std::array<size_t, kFrames> frames = {0, 10, 20, 30, 40, 50};
        return frames_of(read_motion(sample("keypoints/two-ways.npz")), frames);
    }();
    return motion;
}

Vec3 person_at(size_t t, std::string_view name) {
    const KeypointTrack& track = *sample_points().keypoints;
    const auto k = size_t(std::find(track.names.begin(), track.names.end(), name) - track.names.begin());
    return k < track.names.size() ? track.points[t * track.names.size() + k] : Vec3(0, 1.6f, 0.1f);
}

glm::dvec3 place_at(Shows shows, size_t t, std::string_view name) {
    if (shows == Shows::no_numbers) return glm::dvec3(kNaN);
    if (shows == Shows::zero || shows == Shows::nobody) return glm::dvec3(0);
    return shows == Shows::one_place ? glm::dvec3(0.5, 1, 0.25) : glm::dvec3(person_at(t, name));
}

// As a camera sees it.
Vec2 pixel_at(Shows shows, size_t t, std::string_view name) {
    const glm::dvec3 place = place_at(shows, t, name);
    if (place == glm::dvec3(0)) return Vec2(0);
    return Vec2(640 + 300 * place.x, 600 - 300 * place.y);
}

const KeypointLayout& layout_named(const std::vector<KeypointLayout>& layouts, std::string_view name) {
    return *std::find_if(layouts.begin(), layouts.end(),
                         [&](const KeypointLayout& layout) { return layout.name == name; });
}

double confidence_of(Shows shows) {
    return shows == Shows::nobody ? 0 : 1;
}

Motion points_of(const Clip& clip) {
    Motion motion = sample_points();
    KeypointTrack& track = *motion.keypoints;
    for (size_t i = 0; i < track.points.size(); ++i) {
        const size_t t = i / track.names.size();
        track.points[i] = place_at(clip[t], t, track.names[i % track.names.size()]);
        track.confidence[i] = static_cast<float>(confidence_of(clip[t]));
    }
    return motion;
}

Motion picture_of(const Clip& clip) {
    Motion motion = points_of(clip);
    PictureTrack picture{.names = motion.keypoints->names,
                         .points = {},
                         .confidence = motion.keypoints->confidence,
                         .size = {1280, 720}};
    for (size_t i = 0; i < picture.confidence.size(); ++i) {
        const size_t t = i / picture.names.size();
        picture.points.push_back(pixel_at(clip[t], t, picture.names[i % picture.names.size()]));
    }
    motion.picture = std::move(picture);
    motion.keypoints.reset();
    return motion;
}

void write_bvh_clip(const fs::path& file, const Clip& clip) {
    const std::string text = read_text(sample("expressive/two-ways.bvh"));
    const size_t motion = text.find("MOTION");
    const std::vector<std::string_view> lines = split(std::string_view(text).substr(motion), '\n');
    std::string made = text.substr(0, motion) + format("MOTION\nFrames: {}\nFrame Time: 0.1\n", kFrames);
    for (size_t t = 0; t < kFrames; ++t) {
        const std::string_view line = lines[3 + 10 * t];
        const std::string number = clip[t] == Shows::zero        ? "0 "
                                   : clip[t] == Shows::one_place ? "1 "
                                                                 : "nan ";
        const size_t count = split_words(line).size();
        if (clip[t] == Shows::person) made += line;
        for (size_t i = 0; i < count && clip[t] != Shows::person && clip[t] != Shows::nobody; ++i)
            made += number;
        made += "\n";
    }
    write_text(file, made);
}

void write_csv_clip(const fs::path& file, const Clip& clip) {
    const std::vector<std::string>& names = sample_points().keypoints->names;
    std::string text = "frame,name,x,y,z,confidence\n";
    for (size_t t = 0; t < kFrames; ++t) {
        for (const std::string& name : names) {
            const glm::dvec3 place = place_at(clip[t], t, name);
            text += clip[t] == Shows::nobody
                        ? format("{},{},,,,0\n", t, name)
                        : format("{},{},{},{},{},1\n", t, name, place.x, place.y, place.z);
        }
    }
    write_text(file, text);
}

// JSON has no NaN; Python writes it all the same.
void write_json_text(const fs::path& file, const Json& json) {
    std::string text = json.dump();
    for (size_t at; (at = text.find("\"nan\"")) != std::string::npos;) text.replace(at, 5, "NaN");
    write_text(file, text);
}

Json number_or_nan(double value) {
    return std::isnan(value) ? Json(kNothing) : Json(value);
}

Json json_place(Shows shows, size_t t, std::string_view name) {
    const glm::dvec3 place = place_at(shows, t, name);
    return {number_or_nan(place.x), number_or_nan(place.y), number_or_nan(place.z)};
}

void write_json_clip(const fs::path& file, const Clip& clip) {
    const std::vector<std::string>& names = sample_points().keypoints->names;
    Json frames = Json::array();
    for (size_t t = 0; t < kFrames; ++t) {
        Json frame = Json::array();
        for (const std::string& name : names)
            frame.push_back(clip[t] == Shows::nobody ? Json() : json_place(clip[t], t, name));
        frames.push_back(frame);
    }
    write_json_text(file, {{"names", names}, {"frames", frames}});
}

void write_mediapipe_clip(const fs::path& file, const Clip& clip) {
    Json frames = Json::array();
    for (size_t t = 0; t < kFrames; ++t) {
        Json points = Json::array();
        for (const LayoutPoint& point : layout_named(keypoint_layouts(), "MediaPipe 33").points)
            points.push_back(json_place(clip[t], t, point.name()));
        frames.push_back(clip[t] == Shows::nobody ? Json() : Json{{"pose_world_landmarks", points}});
    }
    write_json_text(file, {{"frames", frames}});
}

// Without names, so that the number of points must do.
void write_npz_clip(const fs::path& file, const Clip& clip) {
    const KeypointLayout& layout = layout_named(keypoint_layouts(), "Human3.6M 17");
    std::vector<double> numbers, sure;
    for (size_t t = 0; t < kFrames; ++t) {
        for (const LayoutPoint& point : layout.points) {
            const glm::dvec3 place = place_at(clip[t], t, point.name());
            numbers.insert(numbers.end(), {place.x, place.y, place.z});
            sure.push_back(confidence_of(clip[t]));
        }
    }
    testing::write_npz(file, {{"keypoints", {kFrames, layout.points.size(), 3}, numbers},
                              {"confidence", {kFrames, layout.points.size()}, sure}});
}

void write_smpl_clip(const fs::path& file, const Clip& clip) {
    std::vector<double> turns, places;
    for (const Shows shows : clip) {
        const double all = shows == Shows::one_place ? 1 : shows == Shows::no_numbers ? kNaN : 0;
        for (int i = 0; i < 165; ++i) turns.push_back(shows == Shows::person ? 0.01 * (i % 7) : all);
        places.insert(places.end(), {all, all, shows == Shows::nobody ? kNaN : all});
    }
    testing::write_npz(file, {{"poses", {kFrames, 165}, turns}, {"trans", {kFrames, 3}, places}});
}

void write_openpose_clip(const fs::path& folder, const Clip& clip) {
    write_openpose(folder, picture_of(Clip{}));
    for (size_t t = 0; t < kFrames; ++t) {
        const fs::path file = folder / format("{}_{:012}_keypoints.json", folder.filename().string(), t);
        Json json = read_json(file);
        if (clip[t] == Shows::person) continue;
        if (clip[t] == Shows::nobody) json["people"] = Json::array();
        for (Json& person : json["people"]) {
            for (auto& [key, numbers] : person.items()) {
                if (!key.ends_with("_2d")) continue;
                for (size_t i = 0; i < numbers.size(); ++i)
                    numbers[i] = clip[t] == Shows::zero        ? Json(0)
                                 : clip[t] == Shows::one_place ? Json(i % 3 == 2 ? 1 : 300)
                                                               : Json(kNothing);
            }
        }
        write_json_text(file, json);
    }
}

void write_pats_clip(const fs::path& file, const Clip& clip) {
    const KeypointLayout& layout = layout_named(picture_layouts(), "PATS 52");
    const size_t count = layout.points.size();
    std::vector<double> numbers, sure;
    for (size_t t = 0; t < kFrames; ++t) {
        for (int axis = 0; axis < 2; ++axis) {
            for (const LayoutPoint& point : layout.points) {
                numbers.push_back(static_cast<double>(pixel_at(clip[t], t, point.name())[axis]));
                sure.push_back(confidence_of(clip[t]));
            }
        }
    }
    Hdf5Writer writer(file, file.string());
    writer.make_group("pose");
    writer.write_doubles("pose/data", {kFrames, 2 * count}, numbers);
    writer.write_doubles("pose/confidence", {kFrames, 2 * count}, sure);
    writer.close();
}

struct Form {
    std::string name;
    std::string ending;
    void (*write)(const fs::path& file, const Clip& clip);
    bool flat = false;  // a picture, which can be lifted
};

void PrintTo(const Form& form, std::ostream* out) {
    *out << form.name;
}

const std::vector<Form>& forms() {
    static const std::vector<Form> all = {
        {"bvh", ".bvh", write_bvh_clip},
        {"npz", ".npz", write_npz_clip},
        {"csv", ".csv", write_csv_clip},
        {"json", ".json", write_json_clip},
        {"mediapipe", ".json", write_mediapipe_clip},
        {"smpl", ".npz", write_smpl_clip},
        {"openpose", "", write_openpose_clip, true},
        {"pats", ".h5", write_pats_clip, true},
        {"points_h5", ".h5",
         [](const fs::path& file, const Clip& clip) { write_motion_hdf5(file, points_of(clip)); }},
        {"picture_h5", ".h5",
         [](const fs::path& file, const Clip& clip) { write_motion_hdf5(file, picture_of(clip)); }, true},
    };
    return all;
}

class BrokenFrames : public ::testing::TestWithParam<Form> {
  protected:
    std::string write(const NamedClip& clip) {
        const fs::path file = folder_ / "clips" / (clip.name + GetParam().ending);
        fs::create_directories(file.parent_path());
        GetParam().write(file, clip.clip);
        return file.string();
    }

    // The program shows or refuses the file and ends in no other way. Written files hold no NaN or infinity.
    void expect_sound(std::vector<std::string> words, const std::string& rate) {
        words.insert(words.end(), {"--motion-fps", rate});
        const Outcome outcome = run_chironomia(words);
        EXPECT_THAT(outcome.exit_code, AnyOf(Eq(0), Eq(3)))
            << fmt::format("{}", fmt::join(words, " ")) << "\n"
            << outcome.err;
        if (outcome.exit_code != 3) return;
        EXPECT_THAT(outcome.err, HasSubstr("chironomia: ")) << fmt::format("{}", fmt::join(words, " "));
    }

    void convert(const std::string& motion, const std::string& rate) {
        const fs::path out = folder_ / "out.csv";
        std::vector<std::string> words = {"convert", "--motion", motion, "--out", out.string()};
        if (GetParam().flat) words.emplace_back("--lift");
        expect_sound(words, rate);
        if (!fs::exists(out)) return;
        EXPECT_THAT(to_lower(read_text(out)), Not(AnyOf(HasSubstr(",nan"), HasSubstr("inf")))) << motion;
        fs::remove(out);
    }

    void render(const std::string& motion, const std::string& rate) {
        expect_sound({"render", "--quiet", "--motion", motion, "--avatar", "mannequin", "--size", "64x36",
                      "--frames", "0:3", "--out", (folder_ / "out.mp4").string()},
                     rate);
    }

    // Of a file or all of a folder.
    static Outcome judge(const std::string& motions, const std::string& rate) {
        const Outcome judged =
            run_chironomia({"fit", "--quiet", motions, "--avatar", "mannequin", "--motion-fps", rate});
        EXPECT_THAT(judged.exit_code, AnyOf(Eq(0), Eq(1), Eq(3))) << rate << "\n" << judged.err;
        return judged;
    }

    TemporaryFolder folder_;
};

TEST_P(BrokenFrames, AreShownOrRefused) {
    for (const NamedClip& clip : broken_clips()) {
        const std::string motion = write(clip);
        convert(motion, "10");
        if (clip.name.starts_with("half"))
            render(motion, "10");  // the others differ by nothing that is drawn
    }
    // All of them in one go; a broken one does not keep the others from being judged.
    const Outcome judged = judge((folder_ / "clips").string(), "10");
    EXPECT_THAT(judged.out, HasSubstr("middle-zero")) << judged.err;
}

TEST_P(BrokenFrames, AreShownOrRefusedAtAnyRate) {
    const std::string motion = write({.name = "clip", .clip = {Shows::nobody}});
    for (const char* rate : {"0.01", "0.5", "1000"}) {
        convert(motion, rate);
        judge(motion, rate);
    }
    render(motion, "1000");
}

INSTANTIATE_TEST_SUITE_P(Forms, BrokenFrames, ::testing::ValuesIn(forms()),
                         [](const auto& info) { return info.param.name; });

// A clip often begins before the person is found.
TEST(BrokenFramesOfOpenPose, AreBridgedAtTheBeginning) {
    TemporaryFolder folder;
    write_openpose_clip(folder / "clip", {Shows::nobody});
    const std::string report = (folder / "report.json").string();
    const Outcome outcome = run_chironomia({"convert", "--motion", (folder / "clip").string(), "--motion-fps",
                                            "10", "--out", (folder / "a.bvh").string(), "--report", report});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(read_json(report)["rested_gaps"].dump(), HasSubstr("left_shoulder: 1 frames"));
}

TEST(BrokenFramesOfKeypoints, AreBridgedWhereShouldersAreInOnePlace) {
    TemporaryFolder folder;
    Motion motion = points_of({});
    KeypointTrack& track = *motion.keypoints;
    const auto index = [&](const char* name) {
        return size_t(std::find(track.names.begin(), track.names.end(), name) - track.names.begin());
    };
    const size_t row = 2 * track.names.size();
    track.points[row + index("left_shoulder")] = track.points[row + index("right_shoulder")];
    write_motion_hdf5(folder / "a.h5", motion);
    const std::string report = (folder / "report.json").string();
    const Outcome outcome = run_chironomia({"convert", "--motion", (folder / "a.h5").string(), "--out",
                                            (folder / "a.bvh").string(), "--report", report});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(
        read_json(report)["bridged_gaps"].dump(),
        ::testing::AllOf(HasSubstr("left_shoulder: 1 frames"), HasSubstr("right_shoulder: 1 frames")));
}

TEST(BrokenFramesOfUnits, AreRefusedWithTheUnitThatIsMeant) {
    TemporaryFolder folder;
    const std::string out = (folder / "a.csv").string();
    const Outcome huge = run_chironomia(
        {"convert", "--motion", sample("expressive/two-ways.bvh").string(), "--unit", "1e300", "--out", out});
    EXPECT_EQ(huge.exit_code, 3);
    EXPECT_THAT(huge.err, HasSubstr("two-ways.bvh: a unit of 1e+300 m was set, which makes the body"));
    EXPECT_FALSE(fs::exists(out));
    const Outcome metres = run_chironomia(
        {"convert", "--motion", sample("expressive/two-ways.bvh").string(), "--unit", "m", "--out", out});
    EXPECT_EQ(metres.exit_code, 3);
    EXPECT_THAT(metres.err, HasSubstr("people are 0.3 to 4 m tall, set cm (1."));
}

}  // namespace
}  // namespace chironomia::study
