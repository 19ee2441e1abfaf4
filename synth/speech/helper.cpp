#include "synth/speech/helper.h"

#include <utility>

#include "core/error.h"
#include "core/files/helper_program.h"
#include "core/text.h"

namespace chironomia {
namespace {

// espeak-ng asks a sound server for a device, which is of no use here and may never answer: no server is there.
constexpr const char* kNoSoundServer[] = {"PULSE_SERVER=unix:/dev/null/none",
                                          "PULSE_RUNTIME_PATH=/dev/null/none"};

constexpr HelperProgram kSpeak{.name = "chironomia_speak",
                               .variable = "CHIRONOMIA_SPEAK",
                               .needed_by = "speech",
                               .built_folder = CHIRONOMIA_SPEAK_FOLDER,
                               .remedy = "install chironomia again",
                               .environment = kNoSoundServer};

}  // namespace

SpeakReply ask_helper(const SpeakRequest& request) {
    const std::filesystem::path helper = find_helper(kSpeak);
    auto reply = read_reply(ask_program(helper, kSpeak, to_bytes(request)).bytes);
    if (!reply) {
        throw Error(format("{}: does not answer as this version of chironomia expects; install both again",
                           helper.string()));
    }
    return std::move(*reply);
}

}  // namespace chironomia
