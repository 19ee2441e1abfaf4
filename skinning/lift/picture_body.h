// The landmarks of a body in a picture, without gaps that can be closed.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/body/motion.h"
#include "core/math.h"
#include "skinning/body/keypoint_layout.h"

namespace chironomia {

// What is above it is taken for noise, but where a cutoff is given [Hz]: people hardly move faster.
inline constexpr double kHighestCutoff = 6;

using LandmarkSet = std::bitset<kLandmarks>;

// T frames. A landmark has a place in the frames in which it is there.
struct PictureBody {
    std::vector<std::array<Vec2, kLandmarks>> places;  // (T) x right, y down [the picture's unit]
    std::vector<LandmarkSet> there;                    // (T) seen, or bridged
    LandmarkSet known;                                 // there in at least one frame

    size_t frames() const { return places.size(); }
    bool has(Landmark landmark) const { return known[static_cast<size_t>(landmark)]; }
    bool sees(size_t frame, Landmark landmark) const { return there[frame][static_cast<size_t>(landmark)]; }
    bool sees_shoulders(size_t frame) const {
        return sees(frame, Landmark::left_shoulder) && sees(frame, Landmark::right_shoulder);
    }
    bool sees_hips(size_t frame) const {
        return sees(frame, Landmark::left_hip) && sees(frame, Landmark::right_hip);
    }
    Vec2 at(size_t frame, Landmark landmark) const { return places[frame][static_cast<size_t>(landmark)]; }
};

// What happened to the gaps of one landmark.
struct LandmarkGaps {
    Landmark landmark = Landmark::pelvis;
    size_t bridged = 0;  // frames that go straight from the last place to the next
    size_t rested = 0;   // frames of longer gaps, and of those at the ends: the landmark is not there
};

// How one landmark was filtered.
struct LandmarkCutoff {
    Landmark landmark = Landmark::pelvis;
    double hertz = 0;  // the highest over stretches and both directions
};

// A point and its mirror image, and in how many frames the detector took one for the other.
struct SideSwap {
    Landmark left = Landmark::left_wrist;
    size_t frames = 0;
};

struct CleanPicture {
    PictureBody body;
    std::vector<SideSwap> swaps;          // that were undone (side_swaps.h), in the order of Landmark
    std::vector<LandmarkGaps> gaps;       // of the landmarks that have any, in the order of Landmark
    std::vector<LandmarkCutoff> cutoffs;  // of the landmarks that were filtered, in the order of Landmark
};

struct PictureCleaning {
    double fps = 30;
    double longest_bridge = 0.5;  // [s]
    // Of the zero-phase low-pass over stretches without a gap [Hz]. 0: none, and swaps stay. Not set: chosen for each
    // point (noise_filter.h).
    std::optional<double> cutoff{};
};

// Whether a frame has several points and all of them in one place: nobody is seen there.
bool is_one_place(const PictureTrack& track, size_t frame);

// A point counts as seen from the confidence kSeen on, but for frames in which all points are in one place;
// one that is seen in less than a tenth of the frames counts as missing. `thorax` and `pelvis` are the middle
// of shoulders and hips where the layout has no such points of its own.
CleanPicture clean_picture(const PictureTrack& track, size_t frames, const PictureCleaning& cleaning);

}  // namespace chironomia
