#include "skinning/motion/picture/openpose_write.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/picture/openpose.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr Vec2 kSize{1920, 1080};
constexpr Vec2 kNeck{960, 420};
constexpr double kShoulders = 260;  // [px]

std::optional<size_t> index_of(const PictureTrack& track, std::string_view name) {
    const auto found = std::find(track.names.begin(), track.names.end(), name);
    if (found == track.names.end()) return std::nullopt;
    return static_cast<size_t>(found - track.names.begin());
}

struct Shoulders {
    double width = 0;   // on average
    double offset = 0;  // of their middle from (0, 0), on average
};

// Nothing where they are never seen together.
std::optional<Shoulders> find_shoulders(const PictureTrack& track) {
    const auto left = index_of(track, name_of(Landmark::left_shoulder));
    const auto right = index_of(track, name_of(Landmark::right_shoulder));
    if (!left || !right) return std::nullopt;
    Shoulders sum;
    double frames = 0;
    for (size_t first = 0; first < track.points.size(); first += track.names.size()) {
        if (track.confidence[first + *left] == 0 || track.confidence[first + *right] == 0) continue;
        const Vec2 a = track.points[first + *left], b = track.points[first + *right];
        sum.width += double(glm::distance(a, b));
        sum.offset += double(glm::length(a + b)) / 2;
        ++frames;
    }
    if (frames == 0 || sum.width == 0) return std::nullopt;
    return Shoulders{.width = sum.width / frames, .offset = sum.offset / frames};
}

// Adds the neck at the origin, with full confidence.
void add_neck(PictureTrack& track) {
    if (index_of(track, name_of(Landmark::thorax))) return;
    PictureTrack more{
        .names = track.names, .points = {}, .confidence = {}, .size = track.size, .focal = track.focal};
    more.names.emplace_back(name_of(Landmark::thorax));
    for (size_t first = 0; first < track.points.size(); first += track.names.size()) {
        const auto begin = static_cast<std::ptrdiff_t>(first),
                   end = begin + static_cast<std::ptrdiff_t>(track.names.size());
        more.points.insert(more.points.end(), track.points.begin() + begin, track.points.begin() + end);
        more.confidence.insert(more.confidence.end(), track.confidence.begin() + begin,
                               track.confidence.begin() + end);
        more.points.emplace_back(0);
        more.confidence.push_back(1);
    }
    track = std::move(more);
}

// "x,y,c" of points of one frame; a name that is not known is a missing point.
class FrameWriter {
  public:
    FrameWriter(const PictureTrack& track, size_t t) : track_(track), first_(t * track.names.size()) {}

    bool sees_anything() const {
        const auto begin = track_.confidence.begin() + static_cast<std::ptrdiff_t>(first_);
        return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(track_.names.size()),
                           [](float confidence) { return confidence > 0; });
    }

    std::string numbers(const std::vector<std::string>& names) const {
        std::vector<std::string> words;
        for (const std::string& name : names) {
            const auto k = index_of(track_, name);
            const bool seen = k && track_.confidence[first_ + *k] > 0;
            if (!seen) {
                words.emplace_back("0,0,0");
                continue;
            }
            const Vec2 point = track_.points[first_ + *k];
            words.push_back(format("{},{},{}", point.x, point.y, track_.confidence[first_ + *k]));
        }
        return join(words, ",");
    }

  private:
    const PictureTrack& track_;
    size_t first_;
};

std::vector<std::string> body_names() {
    std::vector<std::string> names;
    for (const KeypointLayout& layout : keypoint_layouts()) {
        if (layout.name != "BODY_25") continue;
        for (const LayoutPoint& point : layout.points) names.push_back(point.name());
    }
    return names;
}

// The root of a hand is its wrist.
std::vector<std::string> hand_names(std::string_view side) {
    std::vector<std::string> names = openpose_hand_names(side);
    names[0] = format("{}_wrist", side);
    return names;
}

struct PersonPart {
    const char* key;
    std::vector<std::string> names;  // none: left out
};

std::vector<PersonPart> parts_of(const PictureTrack& track) {
    std::vector<PersonPart> parts = {{"pose_keypoints_2d", body_names()},
                                     {"face_keypoints_2d", openpose_face_names()},
                                     {"hand_left_keypoints_2d", hand_names("left")},
                                     {"hand_right_keypoints_2d", hand_names("right")}};
    for (size_t p = 1; p < parts.size(); ++p) {
        auto& names = parts[p].names;
        // The wrist belongs to the body, too, and makes no hand.
        const auto first = names.begin() + (p > 1 ? 1 : 0);
        if (std::none_of(first, names.end(), [&](const auto& name) { return index_of(track, name); }))
            names.clear();
    }
    return parts;
}

std::string frame_text(const PictureTrack& track, const std::vector<PersonPart>& parts, size_t t) {
    const FrameWriter frame(track, t);
    if (!frame.sees_anything()) return "{\"version\":1.3,\"people\":[]}\n";
    std::string text = "{\"version\":1.3,\"people\":[{\"person_id\":[-1]";
    for (const PersonPart& part : parts)
        text += format(",\"{}\":[{}]", part.key, part.names.empty() ? "" : frame.numbers(part.names));
    for (const PersonPart& part : parts) {
        const std::string key(part.key);
        text += format(",\"{}3d\":[]", key.substr(0, key.size() - 2));
    }
    return text + "}]}\n";
}

}  // namespace

Motion set_into_picture(Motion motion) {
    if (!motion.picture || motion.picture->size.x > 0) return motion;
    PictureTrack& track = *motion.picture;
    const auto shoulders = find_shoulders(track);
    if (!shoulders || shoulders->offset > 0.2 * shoulders->width) return motion;
    add_neck(track);
    const double scale = kShoulders / shoulders->width;
    for (Vec2& point : track.points) point = kNeck + Vec2(glm::dvec2(point) * scale);
    track.size = kSize;
    motion.notes.push_back(format(
        "picture: places against the neck, set into {} x {} px with the neck at ({}, {}) and {:.6g} px "
        "for one unit",
        kSize.x, kSize.y, kNeck.x, kNeck.y, scale));
    return motion;
}

void write_openpose(const fs::path& folder, const Motion& motion) {
    const std::string where = folder.string();
    if (!motion.picture) {
        throw Error(format("{}: the motion of {} has no points in a picture, and OpenPose holds nothing else",
                           where, motion.source));
    }
    const std::vector<PersonPart> parts = parts_of(*motion.picture);
    PendingOutput output(folder, PendingOutput::Kind::folder);
    const fs::path whole = fs::weakly_canonical(folder);
    const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    for (size_t t = 0; t < motion.frames; ++t) {
        write_text(output.path() / format("{}_{:012}_keypoints.json", name, t),
                   frame_text(*motion.picture, parts, t));
    }
    output.commit();
}

}  // namespace chironomia
