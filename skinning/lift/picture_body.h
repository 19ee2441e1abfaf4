// The landmarks of a body in a picture, without gaps that can be closed.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <string>
#include <vector>

#include "core/math.h"
#include "core/motion.h"
#include "skinning/motion/keypoint_layout.h"

namespace chironomia {

using LandmarkSet = std::bitset<kLandmarks>;

// T frames. A landmark has a place in the frames in which it is there.
struct PictureBody {
    std::vector<std::array<Vec2, kLandmarks>> places;  // (T) x right, y down [the picture's unit]
    std::vector<LandmarkSet> there;                    // (T) seen, or bridged
    LandmarkSet known;                                 // there in at least one frame

    size_t frames() const { return places.size(); }
    bool has(Landmark landmark) const { return known[static_cast<size_t>(landmark)]; }
    bool sees(size_t frame, Landmark landmark) const { return there[frame][static_cast<size_t>(landmark)]; }
    Vec2 at(size_t frame, Landmark landmark) const { return places[frame][static_cast<size_t>(landmark)]; }
};

// What happened to the gaps of one landmark.
struct LandmarkGaps {
    Landmark landmark = Landmark::pelvis;
    size_t bridged = 0;  // frames that go straight from the last place to the next
    size_t rested = 0;   // frames of longer gaps, and of those at the ends: the landmark is not there
};

struct CleanPicture {
    PictureBody body;
    std::vector<LandmarkGaps> gaps;            // of the landmarks that have any, in the order of Landmark
    std::array<double, kLandmarks> cutoffs{};  // at which each landmark was filtered [Hz]; 0: not at all
};

struct PictureCleaning {
    double fps = 30;
    double longest_bridge = 0.5;  // [s]
    double cutoff = 6;  // highest of the low-pass over stretches without a gap (noise_filter.h) [Hz]; 0: none
};

// A point counts as seen from the confidence kSeen on; one that is seen in less
// than a tenth of the frames counts as missing. `thorax` and `pelvis` are the middle of shoulders and hips
// where the layout has no such points of its own.
CleanPicture clean_picture(const PictureTrack& track, size_t frames, const PictureCleaning& cleaning);

}  // namespace chironomia
