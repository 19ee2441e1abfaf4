// speak_helper: reads a request on stdin, speaks it, and writes a reply on stdout; see helper_protocol.h.
// A program of its own, because the synthesizer keeps what it said before in mind for as long as its process
// lives, and a text must always sound the same.
#include <dlfcn.h>
#include <espeak-ng/speak_lib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/helper_program.h"
#include "core/text.h"
#include "synth/speech/helper_protocol.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

SpeakReply reply;

// A phoneme as the synthesizer writes it. The events of espeak-ng before 1.52 give no stress, only its written
// transcription does.
struct WrittenPhoneme {
    std::string symbol;
    Stress stress = Stress::none;
};

// "ˈoʊ"
WrittenPhoneme parse_phoneme(std::string_view written) {
    WrittenPhoneme phoneme;
    for (const auto& [mark, stress] :
         {std::pair{std::string_view("ˈ"), Stress::primary}, {"ˌ", Stress::secondary}}) {
        if (!written.starts_with(mark)) continue;
        phoneme.stress = stress;
        written.remove_prefix(mark.size());
    }
    phoneme.symbol = written;
    return phoneme;
}

WrittenPhoneme phoneme_in(const espeak_EVENT& event) {
    return parse_phoneme({event.id.string, strnlen(event.id.string, sizeof event.id.string)});
}

int take(short* samples, int count, espeak_EVENT* events) {
    for (; events->type != espeakEVENT_LIST_TERMINATED; ++events) {
        const auto sample = static_cast<std::size_t>(std::max(0, events->sample));
        // Positions count from 1; 0 and less are slips of the synthesizer.
        const auto position = static_cast<std::size_t>(std::max(1, events->text_position) - 1);
        if (events->type == espeakEVENT_WORD) {
            reply.events.push_back({.kind = SpeakEvent::Kind::word, .sample = sample, .position = position});
        } else if (events->type == espeakEVENT_PHONEME) {
            WrittenPhoneme phoneme = phoneme_in(*events);
            reply.events.push_back({.kind = SpeakEvent::Kind::phoneme,
                                    .sample = sample,
                                    .stress = phoneme.stress,
                                    .symbol = std::move(phoneme.symbol)});
        }
    }
    if (samples != nullptr) reply.samples.insert(reply.samples.end(), samples, samples + count);
    return 0;
}

// The voice that is meant for a language most; "" for none. `languages` is a list of a rank and a name each.
std::string voice_for(const std::string& language) {
    std::string best;
    int best_rank = 256;
    for (const espeak_VOICE** voice = espeak_ListVoices(nullptr); *voice != nullptr; ++voice) {
        for (const char* entry = (*voice)->languages; *entry != '\0'; entry += std::strlen(entry) + 1) {
            if (entry + 1 != language || *entry >= best_rank) continue;
            best_rank = *entry;
            best = (*voice)->name;
        }
    }
    return best;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::vector<std::string> language_names() {
    std::vector<std::string> names;
    for (const espeak_VOICE** voice = espeak_ListVoices(nullptr); *voice != nullptr; ++voice)
        for (const char* entry = (*voice)->languages; *entry != '\0'; entry += std::strlen(entry) + 1)
            names.emplace_back(entry + 1);
    return sorted(names);
}

// Their files are "!v/f2".
std::vector<std::string> variant_names() {
    espeak_VOICE variants{.languages = "variant"};
    std::vector<std::string> names;
    for (const espeak_VOICE** voice = espeak_ListVoices(&variants); *voice != nullptr; ++voice)
        names.push_back(fs::path((*voice)->identifier).filename().string());
    return sorted(names);
}

// Asked to look for its voices in one place the synthesizer would go on to others.
bool are_voices_where_they_should_be() {
    const char* folder = std::getenv("ESPEAK_DATA_PATH");
    std::error_code ignored;
    return folder == nullptr || fs::exists(fs::path(folder) / "espeak-ng-data/phontab", ignored);
}

SpeakReply refused(SpeakReply::Outcome outcome, std::vector<std::string> names = {}) {
    return {.outcome = outcome, .names = std::move(names)};
}

constexpr char kSeparator = '\x1f';

// "h<separator>ə<separator>l<separator>ˈoʊ world": words between spaces, the stress before the vowel.
std::vector<WrittenPhoneme> read_account(const std::string& account) {
    std::vector<WrittenPhoneme> phonemes;
    for (const std::string_view word : split_words(account)) {
        for (const std::string_view part : split(word, kSeparator)) {
            WrittenPhoneme phoneme = parse_phoneme(part);
            if (!phoneme.symbol.empty()) phonemes.push_back(std::move(phoneme));
        }
    }
    return phonemes;
}

// The account writes lengths and tones with their phonemes that are events of their own or none, so the
// next few phonemes are searched.
void add_stress(std::vector<SpeakEvent>& events, const std::vector<WrittenPhoneme>& written) {
    std::size_t next = 0;
    for (SpeakEvent& event : events) {
        if (event.symbol.empty()) continue;
        for (std::size_t i = next; i < std::min(next + 4, written.size()); ++i) {
            if (!written[i].symbol.starts_with(event.symbol)) continue;
            event.stress = written[i].stress;
            next = i + 1;
            break;
        }
    }
}

bool speaks(const SpeakRequest& request) {
    char* account = nullptr;
    std::size_t length = 0;
    std::FILE* stream = open_memstream(&account, &length);
    if (stream == nullptr) return false;
    espeak_SetPhonemeTrace(espeakPHONEMES_IPA | kSeparator << 8, stream);
    espeak_SetSynthCallback(take);
    const unsigned flags = espeakCHARS_UTF8 | espeakENDPAUSE | (request.is_ssml ? espeakSSML : 0);
    const espeak_ERROR problem = espeak_Synth(request.text.c_str(), request.text.size() + 1, 0, POS_CHARACTER,
                                              0, flags, nullptr, nullptr);
    espeak_SetPhonemeTrace(0, nullptr);
    std::fclose(stream);
    add_stress(reply.events, read_account({account, length}));
    std::free(account);
    return problem == EE_OK;
}

// How a word sounds without its neighbours; "(en)" where another voice goes on.
std::vector<std::string> phonemes_alone(const std::string& word) {
    std::vector<std::string> symbols;
    const void* rest = word.c_str();
    while (rest != nullptr) {
        const char* account =
            espeak_TextToPhonemes(&rest, espeakCHARS_UTF8, espeakPHONEMES_IPA | kSeparator << 8);
        for (WrittenPhoneme& phoneme : read_account(account)) symbols.push_back(std::move(phoneme.symbol));
    }
    return symbols;
}

// From 1.52 on noises come from a generator whose seed is the time, unless one is set. 1.51 has no such function.
void set_seed_of_noises() {
    constexpr long kSeed = 1;
    if (void* set_seed = dlsym(RTLD_DEFAULT, "espeak_ng_SetRandSeed"))
        reinterpret_cast<int (*)(long)>(set_seed)(kSeed);
}

SpeakReply answer(const SpeakRequest& request) {
    if (!are_voices_where_they_should_be()) return refused(SpeakReply::Outcome::no_voices);
    reply.rate = espeak_Initialize(
        AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr,
        espeakINITIALIZE_PHONEME_EVENTS | espeakINITIALIZE_PHONEME_IPA | espeakINITIALIZE_DONT_EXIT);
    if (reply.rate <= 0) return refused(SpeakReply::Outcome::no_voices);
    set_seed_of_noises();
    // Without a region that has no voice of its own: "de" of "de-at".
    std::string language = request.voice.language;
    std::string voice = voice_for(language);
    while (voice.empty() && language.find('-') != std::string::npos) {
        language.resize(language.rfind('-'));
        voice = voice_for(language);
    }
    if (voice.empty()) return refused(SpeakReply::Outcome::no_language, language_names());
    if (!request.voice.variant.empty()) {
        const std::vector<std::string> variants = variant_names();
        if (!std::binary_search(variants.begin(), variants.end(), request.voice.variant))
            return refused(SpeakReply::Outcome::no_variant, variants);
        voice += "+" + request.voice.variant;
    }
    if (espeak_SetVoiceByName(voice.c_str()) != EE_OK)
        return refused(SpeakReply::Outcome::no_language, language_names());
    espeak_SetParameter(espeakPITCH, request.voice.pitch, 0);
    espeak_SetParameter(espeakRATE, request.voice.rate, 0);
    espeak_SetParameter(espeakRANGE, request.voice.range, 0);
    if (!speaks(request)) return refused(SpeakReply::Outcome::failed);
    for (const std::string& word : request.words) reply.alone.push_back(phonemes_alone(word));
    reply.outcome = SpeakReply::Outcome::spoken;
    return reply;
}

int run() {
    const auto request = read_request(read_stream(stdin));
    if (!request) return 1;
    const std::string bytes = to_bytes(answer(*request));
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    return std::fclose(stdout) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace chironomia

int main() {
    return chironomia::run();
}
