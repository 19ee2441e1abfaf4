#include "synth/markup/bml_lexemes.h"

#include <span>
#include <string>

#include "core/text.h"

namespace chironomia {
namespace {

// By a part of its name without signs, or, of gestures, by the whole.
struct Lexeme {
    std::string_view name, meaning;
};
constexpr Lexeme kHeadLexemes[] = {{"nod", "nod"}, {"shake", "shake"}, {"tilt", "tilt"}};
constexpr Lexeme kFaceLexemes[] = {{"raisemouthcorner", "smile"},
                                   {"lowermouthcorner", "sad mouth"},
                                   {"raisebrow", "brow raise"},
                                   {"raiseeyebrow", "brow raise"},
                                   {"browraise", "brow raise"},
                                   {"browsraise", "brow raise"},
                                   {"lowerbrow", "frown"},
                                   {"lowereyebrow", "frown"},
                                   {"frown", "frown"},
                                   {"smile", "smile"},
                                   {"joy", "smile"},
                                   {"happ", "smile"},
                                   {"sad", "sad mouth"},
                                   {"anger", "angry face"},
                                   {"angry", "angry face"},
                                   {"surpris", "surprised"},
                                   {"fear", "afraid"},
                                   {"afraid", "afraid"},
                                   {"disgust", "disgusted"}};
constexpr Lexeme kGestureLexemes[] = {
    {"beat", "emphasis"}, {"point", "deictic=object"}, {"wave", "performative=greet"}};

// "raiseeyebrows" of "Raise_EyeBrows".
std::string letters_of(std::string_view name) {
    std::string letters;
    for (const char letter : to_lower(name))
        if (letter >= 'a' && letter <= 'z') letters += letter;
    return letters;
}

std::string_view meaning_of(std::string_view name, std::span<const Lexeme> lexemes) {
    const std::string letters = letters_of(name);
    for (const Lexeme& lexeme : lexemes)
        if (letters.find(lexeme.name) != std::string::npos) return lexeme.meaning;
    return "";
}

}  // namespace

std::string_view signal_of_head(std::string_view lexeme) {
    return meaning_of(lexeme, kHeadLexemes);
}

std::string_view signal_of_face(std::string_view lexeme) {
    return meaning_of(lexeme, kFaceLexemes);
}

std::string_view function_of_gesture(std::string_view lexeme) {
    const std::string letters = letters_of(lexeme);
    for (const Lexeme& known : kGestureLexemes)
        if (letters == known.name) return known.meaning;
    return "";
}

}  // namespace chironomia
