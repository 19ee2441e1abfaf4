// chironomia demo
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDemoSeed = 1;  // everybody gets the same demo

void say(const std::string& line) {
    print(line + "\n");
    std::fflush(stdout);
}

// Speaks a script once and performs it in the manner of each condition, which is a speaker's name.
void make_clip(const std::string& id, const Json& speakers, const fs::path& inputs) {
    for (const Json& speaker : speakers) {
        const std::string name = speaker.get<std::string>();
        const Synthesized made =
            synthesize({.script = find_asset(format("assets/samples/demo/{}.aplm", id)).string(),
                        .option = "demo",
                        .language = MarkupLanguage::aplm,
                        .speaker = name,
                        .seed = kDemoSeed});
        write_motion_hdf5(inputs / name / (id + ".h5"), made.performed.motion);
        write_wav(inputs / (id + ".wav"), made.speech.audio);  // all have one voice
        say(format("{}: {:.1f} s of speech, {}: {} gestures", id, made.speech.audio.duration(), name,
                   made.performed.gestures.size()));
    }
}

// The plan with the scene, the speech and the motions that it names beside it.
fs::path make_inputs(const fs::path& inputs) {
    const Json plan = read_json(find_asset("assets/samples/demo/plan.json"));
    for (const Json& clip : plan["clips"]) make_clip(clip["id"], plan["conditions"], inputs);
    // The camera of "upper", a little farther away, so that the highest hand stays in the picture.
    write_json(inputs / "scene.json", read_json(find_asset("assets/samples/demo/scene.json")));
    write_json(inputs / "plan.json", plan);
    return inputs / "plan.json";
}

}  // namespace

void add_demo(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<DemoCommand>();
    CLI::App* verb = add_verb(
        app, "demo", "Speak two texts, gesture them in two manners, and build a blinded A/B study of it",
        "  $ chironomia demo\n  $ chironomia demo --out /tmp/demo");
    verb->add_option("--out", command->out, "Folder of the study [chironomia-demo]")->type_name("DIR");
    verb->add_flag("--replace", command->replace,
                   "Replace another finished study there, if nobody answered it");
    verb->add_flag("--quiet", command->quiet, "No progress");
    verb->callback([&result, command] { result = *command; });
}

int run(const DemoCommand& command) {
    const std::string folder = command.out.string();
    const fs::path inputs = folder + "-inputs";
    const int code = run(StudyBuildCommand{.plan = make_inputs(inputs),
                                           .out = command.out,
                                           .seed = kDemoSeed,
                                           .jobs = 1,
                                           .replace = command.replace,
                                           .quiet = command.quiet});
    say(
        format("\nOpen {0}/public/index.html in a browser to take part in the study.\n"
               "{0}/private/key.json says which video is which; {1} holds the speech and the motions.",
               folder, inputs.string()));
    return code;
}

}  // namespace chironomia::study
