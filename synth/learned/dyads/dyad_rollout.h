// Models of dyads frame by frame: each predicted face becomes the past of the next one, beside a partner
// whose behaviour is known as far as it has happened.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "synth/corpus/records.h"

namespace chironomia {

inline constexpr std::size_t kFaceColumns = DyadPerson::kFace, kSpeechColumns = DyadPerson::kSpeech;

using FaceFrame = std::array<float, DyadPerson::kFace>;  // normalised

// All that has happened until now, frame after frame: n frames each, the present one is the last; normalised.
struct DyadPast {
    std::span<const float> a_face, a_speech;  // (n, 10), (n, 16)
    std::span<const float> u_face, u_speech;

    std::size_t frames() const { return a_face.size() / DyadPerson::kFace; }
};

// A's face in the next frame. It may remember what it was shown before, if `past` has grown by one frame
// since; `restarted`: the past of A's face is another.
using DyadStep = std::function<FaceFrame(const DyadPast& past, bool restarted)>;

// Frames of one person; normalised.
struct PersonTrack {
    std::vector<float> face;    // (T, 10)
    std::vector<float> speech;  // (T, 16)

    std::size_t frames() const { return face.size() / DyadPerson::kFace; }
};

// A, whose face is predicted, and the partner U.
struct DyadTrack {
    PersonTrack a, u;
};

// (T - begin, 10): A's face in the frames from `begin` on, in [0, 1]. Before, it is what `dyad.a` has; after,
// what was predicted.
//   horizon  frames after which A's past becomes what `dyad.a` has again; 0: never
std::vector<float> roll_out(const DyadStep& step, const DyadTrack& dyad, std::size_t begin,
                            std::size_t horizon);

// The face stays as it was last seen.
FaceFrame hold_face(const DyadPast& past, bool restarted);

}  // namespace chironomia
