// What tests of Models 1 and 2 share: small talks whose brows follow the pitch and the words, and losses that
// must fall.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
#include "synth/corpus/records.h"
#include "synth/learned/faces/face_batch.h"

namespace chironomia::testing {

// A talk of `words` words of 0.2 to 0.5 s. Every third word, whose vector says so, lifts the brows and nods;
// the brows also rise with the pitch.
inline IpuRecord small_talk(std::size_t words, std::uint64_t seed) {
    Random random(seed);
    IpuRecord talk{.id = "talk_" + std::to_string(seed), .speaker = "s00"};
    double end = 0;
    for (std::size_t i = 0; i < words; ++i) {
        const double start = end;
        end += 0.2 + 0.3 * random.uniform();
        talk.words.push_back({.text = "w" + std::to_string(i), .start = start, .end = end});
        for (std::size_t k = 0; k < kWordVector; ++k) {
            talk.vectors.push_back(
                static_cast<float>(0.1 * random.normal() + (i % 3 == 0 && k < 64 ? 1 : 0)));
        }
    }
    for (std::size_t s = 0; static_cast<double>(s) / IpuRecord::kSpeechRate < end; ++s) {
        talk.f0.push_back(static_cast<float>(150 + 60 * std::sin(static_cast<double>(s) * 0.05)));
        talk.f0_strength.push_back(0.8F);
        talk.voice.insert(talk.voice.end(), IpuRecord::kVoice, 0.0F);
    }
    std::size_t word = 0;
    for (std::size_t t = 0; static_cast<double>(t) / talk.fps < end; ++t) {
        const double now = static_cast<double>(t) / talk.fps;
        while (now >= talk.words[word].end) ++word;
        const double lift = word % 3 == 0 ? std::sin(M_PI * (now - talk.words[word].start) /
                                                     (talk.words[word].end - talk.words[word].start))
                                          : 0;
        const double pitch = (talk.f0[static_cast<std::size_t>(now * IpuRecord::kSpeechRate)] - 90) / 120;
        for (std::size_t u = 0; u < IpuRecord::kUnits; ++u) {
            talk.units.push_back(static_cast<float>(2 * lift + (u < 2 ? pitch : 0)));
        }
        talk.head.insert(talk.head.end(),
                         {static_cast<float>(0.3 * lift), static_cast<float>(0.1 * pitch), 0.0F});
        talk.success.push_back(1);
        talk.confidence.push_back(1);
    }
    return talk;
}

inline std::vector<FaceUnit> small_units(std::size_t talks, std::size_t words) {
    std::vector<FaceUnit> units;
    for (std::size_t i = 0; i < talks; ++i) {
        for (FaceUnit& unit : face_units(small_talk(words + i, i + 1))) units.push_back(std::move(unit));
    }
    return units;
}

inline FaceBatch batch_of(const std::vector<FaceUnit>& units,
                          const FaceLevels& levels = face_levels(101, 101)) {
    std::vector<const FaceUnit*> pointers;
    for (const FaceUnit& unit : units) pointers.push_back(&unit);
    return make_face_batch(pointers, levels);
}

// The largest difference of two tensors of one shape.
inline double distance(const torch::Tensor& a, const torch::Tensor& b) {
    if (a.sizes() != b.sizes()) return 1e30;
    return a.numel() > 0 ? (a - b).abs().max().item<double>() : 0;
}

inline double distance(const FaceLogits& a, const FaceLogits& b) {
    double most = 0;
    for (std::size_t c = 0; c < kFaceChannels; ++c) most = std::max(most, distance(a[c], b[c]));
    return most;
}

// Those of the frames [first, first + count).
inline FaceLogits frames_of(const FaceLogits& logits, int64_t first, int64_t count) {
    FaceLogits part;
    for (const torch::Tensor& channel : logits) part.push_back(channel.narrow(0, first, count));
    return part;
}

// The frames of words before the one given, in a batch.
inline int64_t frames_before(const FaceBatch& batch, std::size_t word) {
    int64_t frames = 0;
    for (std::size_t w = 0; w < word; ++w) frames += batch.frames.counts[w];
    return frames;
}

}  // namespace chironomia::testing
