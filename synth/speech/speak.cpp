#include "synth/speech/speak.h"

#include <algorithm>
#include <cstdlib>
#include <span>

#include "core/error.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/speakers/languages.h"
#include "synth/speech/helper.h"
#include "synth/speech/word_times.h"

namespace chironomia {
namespace {

constexpr double kMostSpelt = 0.8;  // of a text with foreign words; ours

void check_setting(const char* name, int value, int least, int most) {
    if (value < least || value > most) {
        throw Error(format("voice: the {} is {}; write a number from {} to {}", name, value, least, most));
    }
}

void check(const SpeakRequest& request) {
    check_setting("pitch", request.voice.pitch, 0, 100);
    check_setting("rate", request.voice.rate, 80, 450);
    check_setting("range", request.voice.range, 0, 100);
    const auto fault =
        std::min(fault_in_utf8(request.text).value_or(request.text.size()), request.text.find('\0'));
    if (fault < request.text.size())
        throw Error(format("text to speak: byte {} is not UTF-8; save it as UTF-8", fault + 1));
    // The synthesizer reports the words of an alias as parts of the word after the element.
    const std::size_t alias = request.is_ssml ? request.text.find("<sub") : std::string::npos;
    if (alias != std::string::npos) {
        throw Error(format(
            "text to speak: <sub> at byte {} hides when its words are said; write its alias in place of it",
            alias + 1));
    }
}

// A long text by its beginning.
std::string quoted(const std::string& text) {
    constexpr std::size_t kShown = 60;  // characters
    const std::vector<std::size_t> starts = starts_of_characters(text);
    if (starts.size() <= kShown) return "\"" + text + "\"";
    return "\"" + text.substr(0, starts[kShown]) + "...\"";
}

[[noreturn]] void refuse_voices() {
    const char* folder = std::getenv("ESPEAK_DATA_PATH");
    if (folder == nullptr)
        throw Error("espeak-ng: its voices are not there; install the package espeak-ng-data");
    throw Error(
        format("espeak-ng: its voices are not in \"{}/espeak-ng-data\"; set ESPEAK_DATA_PATH to the "
               "folder that holds espeak-ng-data, or unset it and install the package espeak-ng-data",
               folder));
}

[[noreturn]] void refuse(const SpeakRequest& request) {
    throw Error(format("espeak-ng: {} cannot be spoken in \"{}\"; write a sentence of that language",
                       quoted(request.text), request.voice.language));
}

bool lies_in(char32_t character, char32_t first, char32_t last) {
    return character >= first && character <= last;
}

// Letters, and what is written like them, that are not Latin.
bool is_of_another_script(char32_t character) {
    const bool is_latin = lies_in(character, 0x1e00, 0x1eff) || lies_in(character, 0xff00, 0xff60);
    const bool is_symbol = lies_in(character, 0x2000, 0x2bff) || lies_in(character, 0x3000, 0x303f);
    return lies_in(character, 0x370, 0x1efff) && !is_latin && !is_symbol;
}

bool is_chinese(char32_t character) {
    return lies_in(character, 0x3400, 0x9fff) || lies_in(character, 0xf900, 0xfaff);
}

// "en" of "en-gb".
std::string_view main_language(const std::string& language) {
    return std::string_view(language).substr(0, language.find('-'));
}

std::vector<std::string> stretches_in_other_scripts(const std::string& text) {
    std::vector<std::string> parts;
    std::u32string part;
    for (const char32_t character : characters_of(text) + U" ") {
        if (is_of_another_script(character)) {
            part += character;
        } else if (!part.empty()) {
            parts.push_back(to_utf8(part));
            part.clear();
        }
    }
    return parts;
}

// None of a script that may change its voice on the way.
std::vector<std::string> parts_in_other_scripts(const SpeakRequest& request) {
    if (request.is_ssml && (request.text.find("xml:lang") != std::string::npos ||
                            request.text.find("<voice") != std::string::npos))
        return {};
    return stretches_in_other_scripts(request.text);
}

// Whether all of the text is to be Japanese: by the voice, or by every xml:lang of SSML.
bool is_japanese(const SpeakRequest& request) {
    constexpr std::string_view kAttribute = "xml:lang", kBefore = " \t\r\n=\"'";
    const std::string_view text = request.text;
    std::size_t at = request.is_ssml ? text.find(kAttribute) : std::string_view::npos;
    if (at == std::string_view::npos) return main_language(request.voice.language) == "ja";
    for (; at != std::string_view::npos; at = text.find(kAttribute, at + 1)) {
        const std::size_t value = text.find_first_not_of(kBefore, at + kAttribute.size());
        if (value == std::string_view::npos || to_lower(text.substr(value, 2)) != "ja") return false;
    }
    return text.find("<voice") == std::string_view::npos;
}

[[noreturn]] void refuse_letters(const std::string& letters, const std::string& language) {
    throw Error(format(
        "espeak-ng: the voice of \"{}\" cannot read {}; give the language of these letters (--language; of Chinese "
        "zh for Mandarin, or yue), write it in letters that the voice reads, such as kana for Japanese, or record it",
        language, quoted(letters)));
}

// A foreign word in a longer text may be spelt, but kanji are no foreign words of Japanese: every sentence has some.
void expect_no_kanji(const SpeakRequest& request) {
    if (!is_japanese(request)) return;
    for (const std::string& part : stretches_in_other_scripts(request.text)) {
        const std::u32string characters = characters_of(part);
        if (std::any_of(characters.begin(), characters.end(), is_chinese)) refuse_letters(part, "ja");
    }
}

bool is_name_of_voice(const std::string& symbol) {
    return symbol.starts_with('(');
}

// A voice says of letters that it cannot read what they are ("Chinese letter"), most of them in English, some in their
// own language. A lone Greek letter is a symbol, which has its name.
bool is_spelt(const std::string& part, const std::vector<std::string>& phonemes,
              const std::string& language) {
    const std::u32string characters = characters_of(part);
    const std::string_view main = main_language(language);
    const bool speaks_chinese = main == "cmn" || main == "yue" || main == "hak";
    if (!speaks_chinese && std::any_of(characters.begin(), characters.end(), is_chinese)) return true;
    // Behind what it leaves to another voice, each voice names itself.
    const std::string own = format("({}", main);
    bool is_left_to_another = false;
    for (const std::string& symbol : phonemes) {
        if (!is_name_of_voice(symbol) || symbol.starts_with(own)) continue;
        if (symbol.starts_with("(en")) return true;
        is_left_to_another = true;
    }
    return !is_left_to_another && characters.size() > 1 &&
           std::ranges::any_of(characters, [&](char32_t letter) { return is_spelt_by(main, letter); });
}

// Refuses a text of which the share `most` or more is spelt.
//   parts, phonemes   what is written in other scripts, and what the voice says of it
void expect_read(const SpeakRequest& request, const std::vector<std::string>& parts,
                 std::span<const std::vector<std::string>> phonemes, double most) {
    std::size_t all = 0, spelt = 0;
    for (const std::string_view word : split_words(request.text)) all += characters_of(word).size();
    const std::string* first = nullptr;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!is_spelt(parts[i], phonemes[i], request.voice.language)) continue;
        if (first == nullptr) first = &parts[i];
        spelt += characters_of(parts[i]).size();
    }
    if (first == nullptr || static_cast<double>(spelt) < most * static_cast<double>(all)) return;
    refuse_letters(*first, request.voice.language);
}

//   most_spelt   of its characters, share that makes no sense
SpeakReply ask(SpeakRequest request, double most_spelt) {
    const std::size_t words = request.words.size();
    const std::vector<std::string> parts = parts_in_other_scripts(request);
    request.words.insert(request.words.end(), parts.begin(), parts.end());
    SpeakReply reply = ask_helper(request);
    switch (reply.outcome) {
        case SpeakReply::Outcome::no_voices:
            refuse_voices();
        case SpeakReply::Outcome::no_language:
            throw Error(format("espeak-ng: no voice speaks \"{}\"; write one of {}", request.voice.language,
                               join(reply.names)));
        case SpeakReply::Outcome::no_variant:
            throw Error(format("espeak-ng: there is no variant \"{}\" of a voice; write one of {}",
                               request.voice.variant, join(reply.names)));
        case SpeakReply::Outcome::failed:
            refuse(request);
        case SpeakReply::Outcome::spoken:
            break;
    }
    expect_read(request, parts, std::span(reply.alone).subspan(words), most_spelt);
    reply.alone.resize(words);
    for (std::vector<std::string>& phonemes : reply.alone) std::erase_if(phonemes, is_name_of_voice);
    const bool is_heard = std::any_of(reply.samples.begin(), reply.samples.end(),
                                      [](std::int16_t sample) { return sample != 0; });
    if (!is_heard) refuse(request);
    return reply;
}

}  // namespace

Speech speak(const MarkedText& text, const Voice& voice) {
    SpeakRequest request{.text = text.script, .is_ssml = text.is_ssml, .voice = voice};
    request.voice.language = language_named(voice.language);
    for (const ScriptWord& word : text.words) request.words.push_back(word.text);
    check(request);
    expect_no_kanji(request);
    const SpeakReply reply = ask(request, kMostSpelt);
    const bool has_phonemes =
        std::any_of(reply.events.begin(), reply.events.end(), [](const SpeakEvent& event) {
            return event.kind == SpeakEvent::Kind::phoneme && !event.symbol.empty();
        });
    if (!has_phonemes || text.words.empty()) refuse(request);
    return time_words(text, reply, request.voice.language);
}

Audio speak(const std::string& text, const std::string& language) {
    const SpeakRequest request{.text = text, .voice = {.language = language_named(language), .rate = 175}};
    check(request);
    return sound_of(ask(request, 0));
}

}  // namespace chironomia
