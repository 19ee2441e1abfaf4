// Text in any of the four input languages, made ready to be spoken and acted.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "synth/markup/marked_text.h"

namespace chironomia {

// docs/markup.md shows each by an example.
enum class MarkupLanguage {
    plain,  // rules mark it (text_rules.h)
    aplm,   // De Carolis, Pelachaud, Poggi, Steedman, 2004: what the speaker means to do
    bml,    // as GRETA writes it: which gestures, and when; with FML's functions beside it
    ssml,   // how it is spoken; rules mark it
};

// "aplm"
std::string_view name_of(MarkupLanguage language);
std::optional<MarkupLanguage> markup_language_named(std::string_view name);

struct MarkupSource {
    std::string text;                // UTF-8, at most 1 MiB
    std::string name = "text";       // what messages call it: a file, or an option
    std::string language = "en-us";  // of the words, as espeak-ng names it
    bool is_heard = false;           // its words are those of a recording, in which signs are no Markdown
};

// By the first element; plain text if there is none.
MarkupLanguage recognise_markup(std::string_view text);

// Throws Error that begins with name:line:column if the text is not UTF-8, holds no word, is not well-formed,
// has an element, attribute or value that the language has not, a number out of its range, an act without
// words, or a time that refers to a word that is not there.
MarkedText parse_marked_text(const MarkupSource& source, MarkupLanguage language);
MarkedText parse_marked_text(const MarkupSource& source);  // in the language that it is recognised as

// What an option may hold: the name of a file, or the text itself. What has the form of a file's name
// ("my talk.aplm", "talk.docx") and is none is refused.
MarkupSource read_markup_source(const std::string& file_or_text, std::string_view option);

}  // namespace chironomia
