// What one person says: the sound, its words and phonemes in time, and what they mean to do.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/audio.h"
#include "core/manner.h"

namespace chironomia {

enum class Stress { none, secondary, primary };

struct SpokenPhoneme {
    std::string symbol;  // in the International Phonetic Alphabet, without marks of stress; "_" for a pause
    double start = 0;    // [s]
    double end = 0;      // [s] > start
    Stress stress = Stress::none;  // of the syllable; only its vowel has it
};

struct SpokenWord {
    std::string text;               // as written, without the punctuation around it
    double start = 0;               // [s]
    double end = 0;                 // [s] > start, at most the start of the next word
    std::size_t first_phoneme = 0;  // of Speech::phonemes
    std::size_t end_phoneme = 0;    // one behind the last; first_phoneme if the phonemes are not known
};

// What a stretch of speech does: the communicative functions of APLM (De Carolis, Pelachaud, Poggi, Steedman,
// 2004), pitch accents and boundary tones, and gestures that were asked for by name.
enum class MarkKind {
    theme,            // what the utterance is about
    rheme,            // what it says that is new
    emphasis,         // value "low", "medium", "high"
    pitch_accent,     // value "Hstar", "Lstar", "LplusHstar", "LstarplusH", "HplusLstar", "HstarplusL"
    boundary,         // value "LL", "LH", "HL", "HH"; at a place between words
    performative,     // value "greet", "inform", "ask", "order", "suggest", ...
    certainty,        // value "certain", "uncertain", ...
    belief_relation,  // value "cause-effect", "contrast", "enumerate", ...
    deictic,          // value "place", "object", "person", ...
    world,            // value "shape", "quantity", "size", ...: a property that hands can show
    emotion,          // value "joy", "sadness", "anger", "fear", "surprise", "disgust", ...
    turn,             // value "take", "give", "keep"
    backchannel,      // value "agreement", "understanding", ... of a listener
    gesture,          // value: the name of a gesture of the lexicon
    signal,  // value: of a movement of head, face or gaze, as synth/planner/behaviour.h names it: "nod"
};

// "belief-relation"
std::string_view name_of(MarkKind kind);

// A time relative to the words: `offset` seconds after the start of a word, or of the speech.
struct SyncPoint {
    std::optional<std::size_t> word;  // the number of words: the end of the last one
    double offset = 0;                // [s]

    bool operator==(const SyncPoint&) const = default;
};

// When the phases of an act should lie, where its author said so.
struct MarkTimes {
    std::optional<SyncPoint> start, ready, stroke_start, stroke, stroke_end, relax, end;

    bool operator==(const MarkTimes&) const = default;
};

// One act, over the words [first_word, end_word); an act at a place lies before the word `first_word`.
struct Mark {
    MarkKind kind = MarkKind::rheme;
    std::string value;
    std::size_t first_word = 0;
    std::size_t end_word = 0;
    double weight = 0.5;  // importance of showing it, in [0, 1]
    LocalManner manner;
    MarkTimes times{};
    std::string reference{};  // of a gesture: what it shows, if its name is unknown: "performative=ask"

    bool operator==(const Mark&) const = default;
};

struct Speech {
    Audio audio;                          // mono
    std::string language;                 // "en-us"
    std::vector<SpokenWord> words;        // ascending in time
    std::vector<SpokenPhoneme> phonemes;  // ascending in time; may be empty
    std::vector<Mark> marks;              // ascending by first_word; an act that holds others before these
};

// Where a point lies in the speech [s].
double time_of(const SyncPoint& point, const Speech& speech);

}  // namespace chironomia
