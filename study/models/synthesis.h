// Speech and motion of one person, made from a text or for a recording.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "core/manner.h"
#include "core/speech.h"
#include "study/models/learned_engine.h"
#include "synth/expressive.h"
#include "synth/markup/markup.h"
#include "synth/planner/variants.h"
#include "synth/speech/channels.h"

namespace chironomia::study {

struct SynthesisJob {
    std::string script;                              // a file, or the text itself; empty: a recording alone
    std::string option = "--text";                   // what messages call the script
    std::optional<MarkupLanguage> language;          // of the script; none: it is recognised
    std::optional<MarkupSource> source;              // the script as it was read, in place of `script`
    std::optional<std::filesystem::path> recording;  // speech in place of a synthetic voice
    SpeechChannel channel = SpeechChannel::mean;     // of the recording
    std::optional<std::filesystem::path> words;      // of the recording, in time (synth/speech/timed_words.h)
    std::string words_speaker;                       // whose words count of a file that names several people
    std::string gestures;             // shown one after the other in place of speech: an id, or "all"
    std::string speaker = "neutral";  // one of the bundled, or a file
    LocalManner manner;               // in place of the speaker's
    std::optional<Voice> voice;       // the same
    std::optional<std::string> spoken_language{};  // of words and voice, as espeak-ng names it; the same
    std::vector<std::filesystem::path> lexicons;   // beside the bundled one
    Variants variants;
    double fps = 30;  // of the motion
    std::uint64_t seed = 0;
    double partner_deg = 0;                // how far to the person's left stands whom they look at
    std::optional<LearnedEngine> learned;  // in place of the expressive engine, at its own rate
    bool fill = false;  // what the learned engine does not say comes from the expressive one
};

struct Synthesized {
    Speech speech;
    Speaker speaker;  // in the manner that was asked for
    Performed performed;
    std::vector<std::string> gestures;  // ids of the lexicon
    std::vector<std::string> notes;     // of the script: what is not shown
};

// Silence before a synthetic voice, so that a hand can be up at the first word, and behind it, so that the
// hands come to rest.
inline constexpr double kSilence = 1.2;  // [s]

// AMII without speech of its own listens to its partner; a model of style may show what an interval of PATS says, of
// which there is no sound. Throws Error as the readers of texts, sounds, words,
// speakers and lexicons and the learned engines do; if a recording has a script but no words; or if there is
// no such gesture.
Synthesized synthesize(const SynthesisJob& job);

struct DialogJob {
    std::filesystem::path script;                 // docs/dialogs.md
    std::vector<std::filesystem::path> lexicons;  // beside the bundled one
    Variants variants;
    double fps = 30;
    std::uint64_t seed = 0;
};

// Both people on one timeline. Throws Error as the readers of dialogs and lexicons do.
std::array<Synthesized, 2> synthesize_dialog(const DialogJob& job);

// What was said, meant and done when: words, marks, gestures with their phases, signals. Times in seconds.
Json score_of(const Synthesized& made);

}  // namespace chironomia::study
