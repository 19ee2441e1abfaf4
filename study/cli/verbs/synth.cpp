// chironomia synth
#include <cstdio>

#include "core/error.h"
#include "core/files/wav_file.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/cli/verbs/commands.h"

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

// person-0.h5, .wav and .json, and the same of the other.
int run_dialog(const SynthCommand& command) {
    const std::array<Synthesized, 2> both = synthesize_dialog({.script = command.dialog,
                                                               .lexicons = command.job.lexicons,
                                                               .variants = command.job.variants,
                                                               .fps = command.job.fps,
                                                               .seed = command.job.seed});
    for (std::size_t i = 0; i < 2; ++i) {
        const std::filesystem::path file = command.out / format("person-{}.h5", i);
        complain(both[i].notes);
        complain(both[i].performed.motion.notes);
        write_motion_hdf5(file, both[i].performed.motion);
        write_wav(std::filesystem::path(file).replace_extension(".wav"), both[i].speech.audio);
        write_json(std::filesystem::path(file).replace_extension(".json"), score_of(both[i]));
        std::fputs(format("{}\n{}\n", file.string(), summary(both[i])).c_str(), stdout);
    }
    return kExitYes;
}

}  // namespace

int run(const SynthCommand& command) {
    if (!command.dialog.empty()) return run_dialog(command);
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
