// Talks of a corpus out of recordings: Fares 2023, section 4.1.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/corpus/manifest.h"
#include "study/corpus/recording.h"
#include "synth/text/word_vectors.h"

namespace chironomia::study {

// How often something was left out, by why.
using LeftOut = std::map<std::string, std::size_t>;

struct CutTalk {
    std::vector<IpuRecord> units;
    LeftOut left_out;
    std::vector<std::string> notes;  // of the readers, each a sentence
};

// The units of one recording: of each shot that keeps the limits, the stretches of speech that lie in it,
// with a pitch that is bridged word by word and the face at 24 frames/s. Throws Error as the readers do, and
// if face and voice differ by more than kLooseEnd.
CutTalk cut_talk(const TalkRecording& talk, const ShotLimits& limits, const TextEncoder& encoder);

// Why a shot cannot be learned from, such as "shots under 2 s"; empty: it can.
//   face   its frames as they were tracked, in the columns of a talk
std::string fault_of(const TrackedValues& face, const ShotLimits& limits);

}  // namespace chironomia::study
