// speak_helper LANGUAGE TEXT: the text spoken, as 16-bit samples on stdout behind their rate (4 bytes).
// A program of its own, because the synthesizer keeps what it said before in mind for as long as its process
// lives, and a text must always sound the same. Exit: 1 without voices, 2 for an unknown language, 3 if the
// text cannot be spoken.
#include <espeak-ng/speak_lib.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

std::vector<short> spoken;

int take_samples(short* samples, int count, espeak_EVENT*) {
    if (samples != nullptr) spoken.insert(spoken.end(), samples, samples + count);
    return 0;
}

// The voice that is meant for a language most; "" for none. `languages` is a list of a rank and a name each.
std::string voice_for(const char* language) {
    std::string best;
    int best_rank = 256;
    for (const espeak_VOICE** voice = espeak_ListVoices(nullptr); *voice != nullptr; ++voice) {
        for (const char* entry = (*voice)->languages; *entry != '\0'; entry += std::strlen(entry) + 1) {
            if (std::strcmp(entry + 1, language) != 0 || *entry >= best_rank) continue;
            best_rank = *entry;
            best = (*voice)->name;
        }
    }
    return best;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 3;
    const int rate = espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr, espeakINITIALIZE_DONT_EXIT);
    if (rate <= 0) return 1;
    const std::string voice = voice_for(argv[1]);
    if (voice.empty() || espeak_SetVoiceByName(voice.c_str()) != EE_OK) return 2;
    espeak_SetSynthCallback(take_samples);
    const std::size_t bytes = std::strlen(argv[2]) + 1;
    if (espeak_Synth(argv[2], bytes, 0, POS_CHARACTER, 0, espeakCHARS_UTF8 | espeakENDPAUSE, nullptr,
                     nullptr) != EE_OK)
        return 3;
    const auto header = static_cast<std::uint32_t>(rate);
    std::fwrite(&header, sizeof header, 1, stdout);
    std::fwrite(spoken.data(), sizeof spoken[0], spoken.size(), stdout);
    return std::fclose(stdout) == 0 ? 0 : 3;
}
