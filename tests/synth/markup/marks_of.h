// The marks of a text as lines that a test can read.
#pragma once

#include <string>
#include <vector>

#include "core/text.h"
#include "synth/markup/functions.h"
#include "synth/markup/marked_text.h"

namespace chironomia::testing {

// "performative=greet(Good morning)"; an act at a place holds nothing.
inline std::string mark_text(const Mark& mark, const MarkedText& text) {
    std::string words;
    for (std::size_t word = mark.first_word; word < mark.end_word; ++word)
        words += (words.empty() ? "" : " ") + text.words[word].text;
    return function_of(mark) + "(" + words + ")";
}

inline std::vector<std::string> marks_in(const MarkedText& text) {
    std::vector<std::string> lines;
    for (const Mark& mark : text.marks) lines.push_back(mark_text(mark, text));
    return lines;
}

// The marks of one kind.
inline std::vector<std::string> marks_in(const MarkedText& text, MarkKind kind) {
    std::vector<std::string> lines;
    for (const Mark& mark : text.marks)
        if (mark.kind == kind) lines.push_back(mark_text(mark, text));
    return lines;
}

inline std::vector<std::string> words_in(const MarkedText& text) {
    std::vector<std::string> words;
    for (const ScriptWord& word : text.words) words.push_back(word.text);
    return words;
}

}  // namespace chironomia::testing
