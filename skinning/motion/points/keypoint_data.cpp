#include "skinning/motion/points/keypoint_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/quantile.h"
#include "core/text.h"
#include "skinning/body/body_proportions.h"
#include "skinning/motion/points/point_naming.h"

namespace chironomia {
namespace {

constexpr double kSameRate = 0.01;  // ours; 29.97 and 30 are the same
// Ours, of how far a body spreads: 9 cm of a grown-up, 2.6 m/s at 30 frames/s.
constexpr double kSmallStep = 0.05;
constexpr double kFlattest = 0.05;  // ours: of a body's depth, against how far it spreads; a chest has 0.15
constexpr size_t kFewestToJudge = 10;  // ours [frames]: fewer may be as flat by chance
constexpr double kMostOutside = 0.05;  // ours: of the points of a picture

// How far numbers spread.
struct NumberRange {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double number) {
        low = std::min(low, number);
        high = std::max(high, number);
    }
    bool within(double least, double most) const { return low >= least && high <= most; }
    double spread() const { return std::max(0.0, high - low); }
};

// The third numbers of points, beside how far these spread.
struct Thirds {
    NumberRange x, y, third;
    std::vector<double> above_zero{};
    size_t points = 0, outside = 0;  // outside: above or left of a picture

    double spread() const { return std::max(x.spread(), y.spread()); }
    // A body in space has places below 0, or is taller than 1 m.
    bool in_shares() const { return x.within(0, 1) && y.within(0, 1); }
    // Detectors guess few points outside of it; a space has its origin anywhere.
    bool in_picture() const {
        return static_cast<double>(outside) <= kMostOutside * static_cast<double>(points);
    }
};

// Those that were seen; 0 0 is a point that was not found.
Thirds look_at_thirds(const KeypointData& data) {
    Thirds thirds;
    for (size_t i = 0; i < data.frames * data.points; ++i) {
        const double* point = &data.places[3 * i];
        if (std::isnan(point[0]) || std::isnan(point[1]) || std::isnan(point[2])) continue;
        if (!data.confidence.empty() && data.confidence[i] == 0) continue;
        thirds.third.add(point[2]);
        if (point[2] > 0) thirds.above_zero.push_back(point[2]);
        if (point[0] == 0 && point[1] == 0) continue;
        thirds.x.add(point[0]);
        thirds.y.add(point[1]);
        ++thirds.points;
        thirds.outside += point[0] < 0 || point[1] < 0;
    }
    return thirds;
}

// How far the points of a frame spread in x or y, by the median.
double spread_of_frames(const KeypointData& data) {
    std::vector<double> spreads;
    for (size_t t = 0; t < data.frames; ++t) {
        NumberRange x, y;
        for (size_t i = t * data.points; i < (t + 1) * data.points; ++i) {
            const double* point = &data.places[3 * i];
            if (std::isnan(point[0]) || std::isnan(point[1]) || (point[0] == 0 && point[1] == 0)) continue;
            x.add(point[0]);
            y.add(point[1]);
        }
        spreads.push_back(std::max(x.spread(), y.spread()));
    }
    return median(spreads);
}

// Whether the third numbers of a body in a picture are no depth, by residual_changes; nothing where it hardly moves.
// Throws Error where bones contradict it.
std::optional<bool> are_no_depth(const KeypointData& data, const std::filesystem::path& name_map) {
    KeypointData picture = data;
    picture.picture = true;
    for (size_t i = 2; i < picture.places.size(); i += 3) picture.places[i] = 0;
    PointNaming naming;
    try {
        naming = find_naming(picture, name_map);
    } catch (const Error&) {
        return false;  // no body in a picture
    }
    naming.zero_is_missing = true;
    const KeypointTrack track = track_of(data, naming);
    const auto left = residual_changes(track);
    if (!left || *left < kMostResidualOfDepth) return left ? std::optional(false) : std::nullopt;
    const auto in_space = implausible_bones(track),
               in_picture = implausible_bones(track_of(picture, naming), Seen::in_picture);
    if (in_space >= in_picture) return true;
    throw Error(format(
        "{}: the third numbers of points may be a depth or scores of a detector: bones have more of a body's "
        "lengths by them, but do not keep their lengths from frame to frame; name them z in a table or in "
        "JSON, or save x and y as (T, K, 2) beside an array \"confidence\"",
        data.where));
}

// Why the third numbers are no depth. Empty: they may be one.
std::string why_no_depth(KeypointData& data, const Thirds& thirds, const std::filesystem::path& name_map) {
    const NumberRange& third = thirds.third;
    const std::string flat = format("while the points spread over {:.3g}", thirds.spread());
    if (third.within(0, kMostConfidence)) return flat;
    const bool is_long = data.frames >= kFewestToJudge;
    if (is_long && third.spread() <= kFlattest * spread_of_frames(data)) return flat;
    if (third.low < 0 || !thirds.in_picture()) return "";
    const auto no_depth = is_long ? are_no_depth(data, name_map) : std::nullopt;
    if (no_depth == true) return "and are no depth, by which bones would keep their lengths";
    if (!no_depth) {
        data.notes.push_back(
            "third numbers: taken for depth, which the motion is too short or too still to show; scores of a "
            "detector belong into an array \"confidence\" beside (T, K, 2), as shares of 1");
    }
    return "";
}

// Detectors write x and y in pixels and how sure they are, as a share or a score, which looks like a place in space.
void take_third_for_confidence(KeypointData& data, const std::filesystem::path& name_map) {
    if (!data.unnamed_third || data.picture) return;
    const Thirds thirds = look_at_thirds(data);
    const auto [low, high] = thirds.third;
    const double spread = thirds.spread();
    if (low == 0 && high == 0 && spread > 0) {
        data.picture = true;
        data.notes.emplace_back("third numbers: all 0, so the points are those of a picture");
        return;
    }
    if (thirds.above_zero.empty() || !(spread > kMostConfidence / kFlattest || thirds.in_shares())) return;
    const std::string why = why_no_depth(data, thirds, name_map);
    if (why.empty()) return;
    const double usual = high > kMostConfidence ? std::max(1.0, median(thirds.above_zero)) : 1;
    data.notes.push_back(
        format("third numbers: {} of points in a picture, as they lie between {:.2g} and {:.2g} {}{}",
               low < 0 ? "no depth" : "confidences", low, high, why,
               low < 0     ? "; they are left out"
               : usual > 1 ? format("; {:.3g}, the usual one, counts as 1", usual)
                           : ""));
    data.picture = true;
    data.confidence.resize(data.frames * data.points, 1);
    for (size_t i = 0; i < data.confidence.size(); ++i) {
        double* point = &data.places[3 * i];
        const bool is_lost = std::isnan(point[0]) || std::isnan(point[1]) || data.confidence[i] == 0;
        if (is_lost || low >= 0) data.confidence[i] = is_lost ? 0 : std::min(point[2] / usual, 1.0);
        point[2] = 0;
    }
}

// Scores that the file names may count to 10 or 100 as well.
void bring_scores_to_shares(KeypointData& data) {
    std::vector<double> above_zero;
    for (const double confidence : data.confidence)
        if (confidence > 0 && std::isfinite(confidence)) above_zero.push_back(confidence);
    if (above_zero.empty()) return;
    const double usual = median(above_zero);
    if (usual <= kMostConfidence) return;
    for (double& confidence : data.confidence)
        if (confidence > 0) confidence = std::min(confidence / usual, 1.0);
    data.notes.push_back(format("confidences: scores above 1; {:.3g}, the usual one, counts as 1", usual));
}

// A point that lies exactly at the origin in some frames was not found there, unless it comes and goes by small steps,
// as a root that begins there does.
void miss_zeros(KeypointTrack& track, size_t frames, std::vector<std::string>& notes) {
    const size_t points = track.names.size();
    const auto is_seen = [&](size_t t, size_t k) {
        return track.confidence[t * points + k] > 0 && track.points[t * points + k] != Vec3(0);
    };
    const auto spread_of = [&](size_t t) {
        NumberRange axes[3];
        for (size_t k = 0; k < points; ++k) {
            for (int axis = 0; axis < 3 && is_seen(t, k); ++axis)
                axes[axis].add(track.points[t * points + k][axis]);
        }
        return std::max({axes[0].spread(), axes[1].spread(), axes[2].spread()});
    };
    size_t missing = 0;
    for (size_t k = 0; k < points; ++k) {
        for (size_t t = 0; t < frames; ++t) {
            size_t end = t;
            while (end < frames && !is_seen(end, k)) ++end;
            if (t == 0 && end == frames) break;  // a root that never leaves the origin
            double nearest = std::numeric_limits<double>::infinity();
            if (t > 0) nearest = glm::length(track.points[(t - 1) * points + k]);
            if (end < frames)
                nearest = std::min<double>(nearest, glm::length(track.points[end * points + k]));
            for (; t < end; ++t) {
                float& confidence = track.confidence[t * points + k];
                if (confidence == 0 || nearest <= kSmallStep * spread_of(t)) continue;
                confidence = 0;
                ++missing;
            }
        }
    }
    if (missing > 0) notes.push_back(format("points at exactly 0 0 0: {}, which are missing there", missing));
}

// Detectors write the corner of the picture, or -1 -1, for a point that they did not find. Where many points lie left of
// the picture or above it, the origin is another place.
void miss_corners(KeypointData& data) {
    const auto is_corner = [&](size_t i) {
        const double x = data.places[3 * i], y = data.places[3 * i + 1];
        return (x == 0 && y == 0) || (x == -1 && y == -1);
    };
    const size_t count = data.frames * data.points;
    size_t corners = 0, others = 0, outside = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!data.confidence.empty() && data.confidence[i] == 0) continue;
        corners += is_corner(i);
        others += !is_corner(i);
        outside += !is_corner(i) && (data.places[3 * i] < 0 || data.places[3 * i + 1] < 0);
    }
    if (corners == 0 || static_cast<double>(outside) > kMostOutside * static_cast<double>(others)) return;
    data.confidence.resize(count, 1);
    for (size_t i = 0; i < count; ++i)
        if (is_corner(i)) data.confidence[i] = 0;
    data.notes.push_back(format("points at exactly 0 0 or -1 -1: {}, which are missing there", corners));
}

std::vector<std::string> naming_notes(const KeypointData& data, const PointNaming& naming,
                                      const KeypointTrack& track) {
    std::vector<std::string> notes;
    if (!naming.how.empty()) notes.push_back(naming.how);
    std::vector<std::string> dropped;
    for (size_t k = 0; k < data.names.size(); ++k) {
        if (naming.names[k].empty()) dropped.push_back(data.names[k]);
    }
    if (!dropped.empty()) notes.push_back("points that are not used: " + join(dropped));
    const auto missing = std::count(track.confidence.begin(), track.confidence.end(), 0.0f);
    if (missing > 0) notes.push_back(format("missing points: {} of {}", missing, track.confidence.size()));
    return notes;
}

PictureTrack flat(KeypointTrack track, const Vec2& size) {
    PictureTrack picture{.names = std::move(track.names),
                         .points = {},
                         .confidence = std::move(track.confidence),
                         .size = size};
    for (const Vec3& point : track.points) picture.points.emplace_back(point);
    return picture;
}

double choose_rate(const KeypointData& data, std::optional<double> fps) {
    if (fps) return *fps;
    if (!data.fps)
        throw Error(format("{}: the file does not give its rate; set it with --motion-fps", data.where));
    if (!(*data.fps > 0 && std::isfinite(*data.fps))) {
        throw Error(format("{}: the rate is {} frames/s; it must be above 0, or set it with --motion-fps",
                           data.where, *data.fps));
    }
    return *data.fps;
}

}  // namespace

Motion name_keypoints(KeypointData data, std::optional<double> fps, const std::filesystem::path& name_map) {
    take_third_for_confidence(data, name_map);
    bring_scores_to_shares(data);
    if (data.frames == 0 || data.points == 0) {
        throw Error(format("{}: {} frames of {} points; there is nothing to show", data.where, data.frames,
                           data.points));
    }
    const double rate = choose_rate(data, fps);
    const PointNaming naming = find_naming(data, name_map);
    Motion motion{.source = data.where,
                  .companions = data.companions,
                  .fps = rate,
                  .frames = data.frames,
                  .joints = {},
                  .keypoints = {},
                  .notes = {},
                  .first_time = data.first_number > 0 ? data.first_number / rate : data.first_time};
    if (data.picture && !data.known_order) miss_corners(data);
    KeypointTrack track = track_of(data, naming);
    if (!naming.zero_is_missing) miss_zeros(track, data.frames, data.notes);
    motion.notes = data.notes;
    for (std::string& note : naming_notes(data, naming, track)) motion.notes.push_back(std::move(note));
    if (data.picture)
        motion.picture = flat(std::move(track), data.size);
    else
        motion.keypoints = std::move(track);
    const bool contradicts = fps && data.fps && !(std::abs(*data.fps / *fps - 1) < kSameRate);
    motion.notes.push_back(format("rate: {:.6g} frames/s{}{}", rate, fps ? ", set by hand" : "",
                                  contradicts ? format(" (in the file: {:.6g})", *data.fps) : ""));
    return motion;
}

}  // namespace chironomia
