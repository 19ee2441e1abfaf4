// Who speaks in made corpora: the bundled speakers of known style, each with a genre and an idiolect.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "synth/corpus/make/make_corpus.h"
#include "synth/corpus/make/text.h"
#include "synth/corpus/records.h"
#include "synth/speakers/speaker.h"

namespace chironomia {

struct CorpusSpeaker {
    Speaker speaker;
    std::size_t number = 0;  // among all of the corpus, also if only some are chosen
    bool is_seen = true;     // in training
    std::string genre;
    Idiolect idiolect;  // its temperature goes weakly with the overall activation
};

// Those of the names; all if there are none. Throws Error if one of the names is no speaker's, or none of the
// chosen is seen.
std::vector<CorpusSpeaker> chosen_speakers(const std::vector<CorpusSpeaker>& all,
                                           const std::vector<std::string>& names);

// The seen in the order of speaker_names(SpeakerGroup::seen), then as many of the unseen, of both kinds by
// turns.
std::vector<CorpusSpeaker> corpus_speakers(std::size_t seen, std::size_t unseen, std::uint64_t seed);

// oac, spc, tmp, flt, pwr, rep, handedness, lean [rad], turn [rad], height, brow gain, nod gain.
std::array<float, IntervalRecord::kStyle> style_of_corpus(const Speaker& speaker);

// The part of the index that describes how the corpus was made.
Json origin_of(const CorpusOrder& order, const std::vector<CorpusSpeaker>& speakers);

// A seed of its own for each thing that is drawn.
std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t first, std::uint64_t second = 0);

}  // namespace chironomia
