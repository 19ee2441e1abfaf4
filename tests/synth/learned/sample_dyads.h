// Dyads of which the second person does what the first did some frames before.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"

namespace chironomia::testing {

inline constexpr std::size_t kLag = 10;  // frames

// The last column of the face, AU12, goes up and down in about two seconds; the others are as slow waves,
// each at its own pace; speech alike.
inline DyadRecord following_dyad(const std::string& id, const std::string& first, const std::string& second,
                                 std::size_t frames, double phase) {
    const auto wave = [&](double t, std::size_t column) {
        return 1 + std::sin(2 * M_PI * t / (50 + 7 * static_cast<double>(column)) + phase);
    };
    DyadRecord record{.id = id};
    for (const std::size_t p : {0, 1}) {
        DyadPerson& person = record.people[p];
        person.participant = p == 0 ? first : second;
        person.role = p == 0 ? "expert" : "novice";
        for (std::size_t t = 0; t < frames; ++t) {
            const double time = static_cast<double>(t) - static_cast<double>(p * kLag);
            for (std::size_t c = 0; c < DyadPerson::kFace; ++c)
                person.face.push_back(static_cast<float>(wave(time, DyadPerson::kFace - 1 - c)));
            for (std::size_t c = 0; c < DyadPerson::kSpeech; ++c)
                person.speech.push_back(static_cast<float>(0.5 * wave(time, 3 + c)));
        }
    }
    return record;
}

// Three dyads of `frames` frames, one each to learn from, to stop by and to be judged on.
inline void write_following_dyads(const std::filesystem::path& folder, std::size_t frames) {
    const Split splits[] = {Split::train, Split::validation, Split::test};
    CorpusIndex index{.folder = folder, .kind = CorpusKind::dyads, .origin = {{"command", "a test"}}};
    for (int i = 0; i < 3; ++i) {
        const std::string n = std::to_string(i), first = "p" + n, second = "q" + n;
        const DyadRecord record = following_dyad("d" + n, first, second, frames, i);
        write_dyad(folder, record);
        index.entries.push_back({.id = record.id,
                                 .speaker = first + "+" + second,
                                 .split = splits[i],
                                 .seconds = static_cast<double>(frames) / record.fps});
    }
    write_corpus_index(index);
}

}  // namespace chironomia::testing
