// chironomia synth
#include <cstdio>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/cli/commands.h"

namespace chironomia {
namespace {

void complain(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) std::fputs((note + "\n").c_str(), stderr);
}

std::string summary(const Synthesized& made) {
    const Motion& motion = made.performed.motion;
    return format("{:.2f} s, {} frames at {:g} frames/s, {} words, {} gestures", duration(motion),
                  motion.frames, motion.fps, made.speech.words.size(), made.performed.gestures.size());
}

}  // namespace

int run(const SynthCommand& command) {
    if (to_lower(command.out.extension().string()) != ".h5") {
        throw Error(
            format("--out {}: a motion is written as .h5; name it so, and convert it with chironomia convert",
                   command.out.string()));
    }
    const Synthesized made = synthesize(command.job);
    complain(made.notes);
    complain(made.performed.motion.notes);
    write_motion_hdf5(command.out, made.performed.motion);
    if (command.speech_out) write_wav(*command.speech_out, made.speech.audio);
    if (command.score_out) write_json(*command.score_out, score_of(made));
    std::fputs(format("{}\n{}\n", command.out.string(), summary(made)).c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
