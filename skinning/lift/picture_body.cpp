#include "skinning/lift/picture_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "core/text.h"
#include "skinning/lift/noise_filter.h"
#include "skinning/lift/side_swaps.h"

namespace chironomia {
namespace {

constexpr size_t index_of(Landmark landmark) {
    return static_cast<size_t>(landmark);
}

PictureBody seen_points(const PictureTrack& track, size_t frames) {
    PictureBody body;
    body.places.resize(frames);
    body.there.resize(frames);
    const size_t count = track.names.size();
    std::vector<bool> empty;
    for (size_t t = 0; t < frames; ++t) empty.push_back(is_one_place(track, t));
    for (size_t k = 0; k < count; ++k) {
        const auto landmark = landmark_named(track.names[k]);
        if (!landmark) continue;
        const auto sees = [&](size_t t) { return !empty[t] && track.confidence[t * count + k] >= kSeen; };
        size_t seen = 0;
        for (size_t t = 0; t < frames; ++t) seen += sees(t);
        if (seen * 10 < frames || seen == 0) continue;
        body.known.set(index_of(*landmark));
        for (size_t t = 0; t < frames; ++t) {
            body.places[t][index_of(*landmark)] = track.points[t * count + k];
            body.there[t][index_of(*landmark)] = sees(t);
        }
    }
    return body;
}

// A landmark and those of OpenPose's 70 points of a face, first to last, in whose middle it lies.
struct FacePoints {
    Landmark landmark;
    int first, last;
};
constexpr std::array<FacePoints, 5> kFacePointsOf = {{{Landmark::nose, 30, 30},
                                                      {Landmark::right_eye, 36, 41},
                                                      {Landmark::left_eye, 42, 47},
                                                      {Landmark::right_mouth, 48, 48},
                                                      {Landmark::left_mouth, 54, 54}}};

// The points of the face show where nose, eyes and mouth are better than those of the body.
void take_face_points(PictureBody& body, const PictureTrack& track) {
    std::map<std::string, size_t> columns;
    for (size_t k = 0; k < track.names.size(); ++k) columns[track.names[k]] = k;
    for (const FacePoints& face : kFacePointsOf) {
        std::vector<size_t> points;
        for (int i = face.first; i <= face.last; ++i) {
            const auto column = columns.find(format("face_{}", i));
            if (column != columns.end()) points.push_back(column->second);
        }
        if (points.size() != static_cast<size_t>(face.last - face.first + 1)) continue;
        const auto sees = [&](size_t t) {
            return !is_one_place(track, t) && std::all_of(points.begin(), points.end(), [&](size_t k) {
                return track.confidence[t * track.names.size() + k] >= kSeen;
            });
        };
        size_t seen = 0;
        for (size_t t = 0; t < body.frames(); ++t) seen += sees(t);
        if (seen * 10 < body.frames() || seen == 0) continue;
        body.known.set(index_of(face.landmark));
        for (size_t t = 0; t < body.frames(); ++t) {
            if (!sees(t)) continue;
            Vec2 middle(0);
            for (const size_t k : points)
                middle += track.points[t * track.names.size() + k] / static_cast<float>(points.size());
            body.places[t][index_of(face.landmark)] = middle;
            body.there[t].set(index_of(face.landmark));
        }
    }
}

LandmarkGaps bridge(PictureBody& body, Landmark landmark, size_t longest) {
    LandmarkGaps gaps{.landmark = landmark};
    const size_t l = index_of(landmark);
    std::optional<size_t> last;
    for (size_t t = 0; t < body.frames(); ++t) {
        if (!body.there[t][l]) continue;
        const size_t missing = last ? t - *last - 1 : t;
        if (last && missing <= longest) {
            for (size_t i = 1; i <= missing; ++i) {
                const float share = static_cast<float>(i) / static_cast<float>(missing + 1);
                body.places[*last + i][l] = glm::mix(body.places[*last][l], body.places[t][l], share);
                body.there[*last + i].set(l);
            }
            gaps.bridged += missing;
        } else {
            gaps.rested += missing;
        }
        last = t;
    }
    gaps.rested += body.frames() - (last ? *last + 1 : 0);
    return gaps;
}

// Over each stretch without a gap. Returns the highest cutoff [Hz].
double smooth(PictureBody& body, size_t l, const NoiseFilter& filter) {
    double highest = 0;
    for (size_t first = 0; first < body.frames();) {
        size_t last = first;
        while (last < body.frames() && body.there[last][l]) ++last;
        for (int axis = 0; axis < 2 && last > first; ++axis) {
            std::vector<double> samples;
            for (size_t t = first; t < last; ++t)
                samples.push_back(static_cast<double>(body.places[t][l][axis]));
            const Smoothed smoothed = filter.smooth(samples);
            for (size_t t = first; t < last; ++t)
                body.places[t][l][axis] = static_cast<float>(smoothed.samples[t - first]);
            highest = std::max(highest, smoothed.cutoff);
        }
        first = last + 1;
    }
    return highest;
}

void add_middle(PictureBody& body, Landmark middle, Landmark left, Landmark right) {
    for (size_t t = 0; t < body.frames(); ++t) {
        if (body.sees(t, middle) || !body.sees(t, left) || !body.sees(t, right)) continue;
        body.places[t][index_of(middle)] = (body.at(t, left) + body.at(t, right)) * 0.5f;
        body.there[t].set(index_of(middle));
        body.known.set(index_of(middle));
    }
}

}  // namespace

bool is_one_place(const PictureTrack& track, size_t t) {
    std::optional<Vec2> place;
    size_t points = 0;
    for (size_t i = t * track.names.size(); i < (t + 1) * track.names.size(); ++i) {
        if (track.confidence[i] < kSeen) continue;
        if (place && *place != track.points[i]) return false;
        place = track.points[i];
        ++points;
    }
    return points > 1;
}

CleanPicture clean_picture(const PictureTrack& track, size_t frames, const PictureCleaning& cleaning) {
    CleanPicture clean{.body = seen_points(track, frames), .swaps = {}, .gaps = {}, .cutoffs = {}};
    PictureBody& body = clean.body;
    take_face_points(body, track);
    if (cleaning.cutoff != 0.0) clean.swaps = undo_side_swaps(body, cleaning.fps);
    std::optional<NoiseFilter> filter;
    if (!cleaning.cutoff) filter = NoiseFilter::adaptive(kHighestCutoff, cleaning.fps);
    if (cleaning.cutoff > 0.0) filter = NoiseFilter::fixed(*cleaning.cutoff, cleaning.fps);
    const auto longest = static_cast<size_t>(std::lround(cleaning.longest_bridge * cleaning.fps));
    for (size_t l = 0; l < kLandmarks; ++l) {
        if (!body.known[l]) continue;
        const LandmarkGaps gaps = bridge(body, static_cast<Landmark>(l), longest);
        if (gaps.bridged + gaps.rested > 0) clean.gaps.push_back(gaps);
        if (filter) clean.cutoffs.push_back({static_cast<Landmark>(l), smooth(body, l, *filter)});
    }
    add_middle(body, Landmark::thorax, Landmark::left_shoulder, Landmark::right_shoulder);
    add_middle(body, Landmark::pelvis, Landmark::left_hip, Landmark::right_hip);
    return clean;
}

}  // namespace chironomia
