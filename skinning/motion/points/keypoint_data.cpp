#include "skinning/motion/points/keypoint_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "skinning/motion/points/point_naming.h"

namespace chironomia {
namespace {

constexpr double kSameRate = 0.01;  // ours; 29.97 and 30 are the same
// Ours, of how far a body spreads: 9 cm of a grown-up, 2.6 m/s at 30 frames/s.
constexpr double kSmallStep = 0.05;
constexpr double kFlattest = 0.05;  // ours: of a body's depth, against how far it spreads; a chest has 0.15

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

// Detectors write x and y in pixels and how sure they are, which looks like a place in space.
void take_third_for_confidence(KeypointData& data) {
    if (!data.unnamed_third || data.picture || !data.confidence.empty()) return;
    NumberRange x, y, third;
    for (size_t i = 0; i + 2 < data.places.size(); i += 3) {
        const double* point = &data.places[i];
        if (std::isnan(point[0]) || std::isnan(point[1]) || std::isnan(point[2])) continue;
        third.add(point[2]);
        // 0 0 is a point that was not found.
        if (point[0] == 0 && point[1] == 0) continue;
        x.add(point[0]);
        y.add(point[1]);
    }
    const double spread = std::max(x.spread(), y.spread());
    if (third.low == 0 && third.high == 0 && spread > 0) {
        data.picture = true;
        data.notes.emplace_back("third numbers: all 0, so the points are those of a picture");
        return;
    }
    const bool in_range = third.low >= 0 && third.high > 0 && third.high <= kMostConfidence;
    // A body in space has places below 0, or is taller than 1 m.
    const bool in_shares = x.within(0, 1) && y.within(0, 1);
    if (!in_range || (kMostConfidence > kFlattest * spread && !in_shares)) return;
    data.picture = true;
    for (size_t i = 0; i + 2 < data.places.size(); i += 3) {
        const bool is_lost = std::isnan(data.places[i]) || std::isnan(data.places[i + 1]);
        data.confidence.push_back(is_lost ? 0 : data.places[i + 2]);
        data.places[i + 2] = 0;
    }
    data.notes.push_back(format(
        "third numbers: confidences of points in a picture, as they lie between {:.2g} and {:.2g} while "
        "the points spread over {:.3g}",
        third.low, third.high, spread));
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
    take_third_for_confidence(data);
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
    KeypointTrack track = track_of(data, naming);
    if (!data.picture && !naming.zero_is_missing) miss_zeros(track, data.frames, data.notes);
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
