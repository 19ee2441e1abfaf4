#include "skinning/motion/picture/picture_hints.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr long long kSmallestSide = 16, kLargestSide = 16384;  // [px]
constexpr double kNarrowest = 5, kWidest = 160;                // [deg]
constexpr float kFarthestShare = 4;  // of a picture's sides; beyond it places are pixels
constexpr double kMost = 0.9;        // of the points
constexpr float kSure = 0.5f;        // confidence

// Of the points that are seen surely the share that lies in a picture of this size; of all, if none is sure.
// Detectors guess at what is out of the picture, and say so.
double share_inside(const PictureTrack& track, const Vec2& size) {
    const bool any_sure = std::any_of(track.confidence.begin(), track.confidence.end(),
                                      [](float confidence) { return confidence >= kSure; });
    double inside = 0, seen = 0;
    for (size_t i = 0; i < track.points.size(); ++i) {
        if (track.confidence[i] == 0 || (any_sure && track.confidence[i] < kSure)) continue;
        const Vec2& point = track.points[i];
        inside += point.x >= 0 && point.y >= 0 && point.x <= size.x && point.y <= size.y;
        ++seen;
    }
    return seen > 0 ? inside / seen : 1;
}

// In a picture of known size they are shares of it.
bool are_no_pixels(const PictureTrack& track) {
    bool any = false;
    for (size_t i = 0; i < track.points.size(); ++i) {
        if (track.confidence[i] == 0) continue;
        const Vec2 far = glm::abs(track.points[i]);
        if (std::max(far.x, far.y) > kFarthestShare) return false;
        any = true;
    }
    return any;
}

// Places against the neck are as often below 0 as above it.
bool look_like_shares(const PictureTrack& track) {
    return share_inside(track, Vec2(kFarthestShare)) >= kMost && share_inside(track, Vec2(1)) >= 0.5;
}

void refuse_hints(const Motion& motion, const PictureHints& hints) {
    if (!hints.size && !hints.field_of_view) return;
    if (!motion.picture) {
        throw Error(format("{}: {} was set, but the motion has no points of a picture; leave it out",
                           motion.source, hints.size ? "the size of a picture" : "a field of view"));
    }
    const Vec2 given = motion.picture->size;
    if (hints.size && given.x > 0 && given != *hints.size) {
        throw Error(format("{}: a picture of {} x {} was set, but the file says {} x {}; leave the size out",
                           motion.source, hints.size->x, hints.size->y, given.x, given.y));
    }
    if (!hints.size && given.x == 0) {
        throw Error(
            format("{}: a field of view was set, but the size of the picture is not known; set it, too",
                   motion.source));
    }
}

void set_size(Motion& motion, const Vec2& size) {
    PictureTrack& track = *motion.picture;
    if (track.size.x > 0) return;
    track.size = size;
    const double inside = share_inside(track, are_no_pixels(track) ? Vec2(kFarthestShare) : size);
    if (inside >= kMost) return;
    throw Error(
        format("{}: a picture of {} x {} was set, but {:.0f} % of the points that are seen lie outside of "
               "it; set the size of the video that they were found in, or leave it out",
               motion.source, size.x, size.y, 100 * (1 - inside)));
}

// Without a size, width and height may be anything.
void leave_shares_out(Motion& motion) {
    if (!motion.joints && !motion.keypoints) {
        throw Error(format(
            "{}: the places look like shares of the width and height of a picture whose size is not known; "
            "set it with --picture-size (a square if both were divided by the same), or give width and "
            "height in MediaPipe's JSON",
            motion.source));
    }
    motion.picture.reset();
    motion.notes.emplace_back("landmarks in the picture are left out: the file gives no width and height");
}

}  // namespace

Vec2 picture_size_named(std::string_view text) {
    const auto sides = split(trim(text), 'x');
    const auto width = parse_integer(sides.front()), height = parse_integer(sides.back());
    if (sides.size() != 2 || !width || !height || std::min(*width, *height) < kSmallestSide ||
        std::max(*width, *height) > kLargestSide) {
        throw Error(format(
            "picture size: \"{}\" is not known; use WIDTHxHEIGHT such as 1280x720, each side {} to {} pixels",
            text, kSmallestSide, kLargestSide));
    }
    return Vec2(*width, *height);
}

double field_of_view_named(std::string_view text) {
    const auto degrees = parse_number(trim(text));
    if (degrees && *degrees >= kNarrowest && *degrees <= kWidest) return *degrees;
    throw Error(format("field of view: \"{}\" is not known; use {} to {} degrees, across the longer side",
                       text, kNarrowest, kWidest));
}

Motion with_picture_hints(Motion motion, const PictureHints& hints) {
    refuse_hints(motion, hints);
    if (!motion.picture) return motion;
    PictureTrack& track = *motion.picture;
    if (hints.size) {
        set_size(motion, *hints.size);
        motion.notes.push_back(format("picture: {} x {} px, set by hand", track.size.x, track.size.y));
    }
    if (are_no_pixels(track)) {
        if (track.size.x > 0)
            for (Vec2& point : track.points) point *= track.size;
        else if (look_like_shares(track))
            leave_shares_out(motion);
    }
    if (hints.field_of_view) {
        const double longer = std::max(track.size.x, track.size.y);
        track.focal = longer / 2 / std::tan(glm::radians(*hints.field_of_view) / 2);
        motion.notes.push_back(format("field of view: {} degrees, set by hand", *hints.field_of_view));
    }
    return motion;
}

}  // namespace chironomia
