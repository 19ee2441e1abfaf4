#include "synth/speech/speak.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"
#include "core/text.h"
#include "synth/speech/helper.h"
#include "synth/speech/utf8.h"
#include "synth/speech/word_times.h"

namespace chironomia {
namespace {

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

SpeakReply ask(const SpeakRequest& request) {
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
    const bool is_heard = std::any_of(reply.samples.begin(), reply.samples.end(),
                                      [](std::int16_t sample) { return sample != 0; });
    if (!is_heard) refuse(request);
    return reply;
}

}  // namespace

Speech speak(const MarkedText& text, const Voice& voice) {
    SpeakRequest request{.text = text.script, .is_ssml = text.is_ssml, .voice = voice};
    for (const ScriptWord& word : text.words) request.words.push_back(word.text);
    check(request);
    const SpeakReply reply = ask(request);
    const bool has_phonemes =
        std::any_of(reply.events.begin(), reply.events.end(), [](const SpeakEvent& event) {
            return event.kind == SpeakEvent::Kind::phoneme && !event.symbol.empty();
        });
    if (!has_phonemes || text.words.empty()) refuse(request);
    return time_words(text, reply, voice.language);
}

Audio speak(const std::string& text, const std::string& language) {
    const SpeakRequest request{.text = text, .voice = {.language = language, .rate = 175}};
    check(request);
    return sound_of(ask(request));
}

}  // namespace chironomia
