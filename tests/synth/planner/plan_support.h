// Speeches and a lexicon that a planner's test can reckon with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/text.h"
#include "synth/gestures/gesture.h"
#include "synth/markup/functions.h"
#include "synth/markup/markup.h"
#include "synth/speakers/speaker.h"

namespace chironomia::testing {

// Each word lasts 0.4 s, word w from 0.4 w on; no phonemes.
inline Speech spoken(std::string_view words, std::vector<Mark> marks = {}) {
    Speech speech{.language = "en", .marks = std::move(marks)};
    for (const std::string_view word : split_words(words)) {
        const double start = 0.4 * static_cast<double>(speech.words.size());
        speech.words.push_back({.text = std::string(word), .start = start, .end = start + 0.4});
    }
    return speech;
}

// A text as its marks have it, spoken so. A sentence is followed by a pause of 0.5 s, a paragraph by one of 1
// s.
inline Speech spoken(const MarkedText& text, const std::string& language = "en") {
    Speech speech{.language = language, .marks = text.marks};
    double start = 0;
    for (std::size_t w = 0; w < text.words.size(); ++w) {
        speech.words.push_back({.text = text.words[w].text, .start = start, .end = start + 0.35});
        const std::size_t end = text.words[w].end;
        const bool is_last = w + 1 == text.words.size();
        const std::string gap = is_last ? "" : text.script.substr(end, text.words[w + 1].begin - end);
        const bool is_paragraph = gap.find('\n') != std::string::npos;
        const bool is_sentence = gap.find_first_of(".?!") != std::string::npos;
        start += 0.35 + (is_paragraph ? 1 : is_sentence ? 0.5 : 0);
    }
    return speech;
}

inline Gesture gesture(std::string id, std::vector<std::string> functions,
                       GestureCategory category = GestureCategory::metaphoric) {
    return {.id = std::move(id), .category = category, .functions = std::move(functions)};
}

inline Lexicon small_lexicon() {
    return {.gestures = {gesture("beat_down", {"rheme", "emphasis=low"}, GestureCategory::beat),
                         gesture("beat_out", {}, GestureCategory::beat),
                         gesture("wave", {"performative=greet"}, GestureCategory::emblem),
                         gesture("offer", {"performative=ask", "performative"}),
                         gesture("ring", {"world=shape"}, GestureCategory::iconic),
                         gesture("point", {"deictic=place-there"}, GestureCategory::deictic)}};
}

// Three gestures for each kind of act.
inline Lexicon full_lexicon() {
    Lexicon lexicon;
    for (const FunctionKind& kind : function_kinds())
        for (const char* nth : {"1", "2", "3"}) {
            const std::string name(name_of(kind.kind));
            lexicon.gestures.push_back(gesture(name + nth, {name}));
        }
    return lexicon;
}

inline Speaker speaker_of(double activation) {
    Speaker speaker;
    speaker.manner[Expressivity::overall_activation] = activation;
    return speaker;
}

}  // namespace chironomia::testing
