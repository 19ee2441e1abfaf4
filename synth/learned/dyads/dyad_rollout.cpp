#include "synth/learned/dyads/dyad_rollout.h"

#include <algorithm>

namespace chironomia {

std::vector<float> roll_out(const DyadStep& step, const DyadTrack& dyad, std::size_t begin,
                            std::size_t horizon) {
    const auto& [a, u] = dyad;
    std::vector<float> past = a.face;
    std::vector<float> predicted;
    for (std::size_t frame = begin; frame < a.frames(); ++frame) {
        const bool restarts = frame == begin || (horizon > 0 && (frame - begin) % horizon == 0);
        if (restarts) std::copy_n(a.face.begin(), frame * kFaceColumns, past.begin());
        FaceFrame face = step({.a_face = std::span(past).first(frame * kFaceColumns),
                               .a_speech = std::span(a.speech).first(frame * kSpeechColumns),
                               .u_face = std::span(u.face).first(frame * kFaceColumns),
                               .u_speech = std::span(u.speech).first(frame * kSpeechColumns)},
                              restarts);
        for (float& value : face) value = std::clamp(value, 0.0f, 1.0f);
        std::copy(face.begin(), face.end(), past.begin() + static_cast<std::ptrdiff_t>(frame * kFaceColumns));
        predicted.insert(predicted.end(), face.begin(), face.end());
    }
    return predicted;
}

FaceFrame hold_face(const DyadPast& past, bool /*restarted*/) {
    FaceFrame face{};
    std::copy_n(past.a_face.end() - static_cast<std::ptrdiff_t>(kFaceColumns), kFaceColumns, face.begin());
    return face;
}

}  // namespace chironomia
