// chironomia train
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/error.h"
#include "core/text.h"
#include "study/cli/options/model_options.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "synth/learning.h"

namespace chironomia::study {
namespace {

Json job_of(const TrainCommand& command) {
    Json job = {{"verb", "train"},
                {"model", command.model},
                {"preset", command.preset},
                {"corpus", std::filesystem::absolute(command.corpus).lexically_normal().string()},
                {"out", std::filesystem::absolute(command.out).lexically_normal().string()},
                {"seed", command.seed},
                {"threads", command.threads},
                {"quiet", command.quiet},
                {"options", Json::object()}};
    for (const auto& [name, value] : command.options) job["options"][name] = value;
    if (command.ast) job["ast"] = std::filesystem::absolute(*command.ast).lexically_normal().string();
    if (command.epochs) job["epochs"] = *command.epochs;
    if (command.steps) job["steps"] = *command.steps;
    if (command.save_every) job["save_every"] = *command.save_every;
    return job;
}

Json train(const TrainCommand& command) {
    try {
        return ask_to_learn(job_of(command));
    } catch (const Error& error) {
        throw Error(in_options(error.what()));
    }
}

}  // namespace

void add_train(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<TrainCommand>();
    CLI::App* verb = add_verb(
        app, "train", "Train a learned model on a corpus",
        ""
        "  $ chironomia train model2 --corpus talks --preset small --out model2.safetensors\n"
        "  $ chironomia train amii --corpus dyads --preset small --option ablation=noE_m --epochs 5 --seed 2 "
        "--out amii-noE_m.safetensors\n"
        "Trained again with the same command, a checkpoint that was interrupted goes on.");
    const std::vector<std::string> models = {"amii",      "il-lstm",   "sym-il-lstm",
                                             "model1",    "model2",    "zs-mstm-1",
                                             "zs-mstm-2", "mix-stage", "style-classifier"};
    verb->add_option("model", command->model, "What is trained (docs/learning.md)")
        ->type_name("MODEL")
        ->check(CLI::IsMember(models))
        ->required();
    verb->add_option("--corpus", command->corpus, "Folder of the corpus (docs/corpora.md)")
        ->type_name("DIR")
        ->required();
    verb->add_option("--preset", command->preset, "Sizes and training: paper, small, ... [small]")
        ->type_name("P");
    verb->add_option("--out", command->out, "The checkpoint; FILE.json and more lie beside it")
        ->type_name("FILE.safetensors")
        ->required();
    add_seed(*verb, command->seed, "Random seed of the weights and of the order of examples [1]");
    add_threads(*verb, command->threads);
    verb->add_option("--epochs", command->epochs, "Passes over the corpus [the preset's]")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    verb->add_option("--steps", command->steps, "Steps after which it ends, if that comes first")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000000));
    verb->add_option(
            "--save-every", command->save_every,
            "Seconds between checkpoints, or longer where writing one takes long; 0: before each step [60]")
        ->type_name("S")
        ->check(CLI::Range(0.0, 1e6));
    verb->add_option("--ast", command->ast,
                     "zs-mstm: the audio spectrogram transformer's weights, model.safetensors in DIR "
                     "(docs/learned_styles.md)")
        ->type_name("DIR");
    add_model_options(*verb, command->options);
    verb->add_flag("--quiet", command->quiet, "No progress");
    verb->add_flag("--json", command->json, "Print what training came to, with the curve of the loss");
    verb->callback([&result, command, verb] { result = *command; });
}

int run(const TrainCommand& command) {
    Json answer;
    try {
        answer = train(command);
    } catch (const Interrupted&) {
        std::fputs("chironomia: interrupted; the same command goes on from here\n", stderr);
        return kExitInterrupted;
    }
    if (command.json) {
        print(answer.dump(2) + "\n");
        return kExitYes;
    }
    print(format("{}\n{} steps, loss {:.4f} in training and {:.4f} in validation\n",
                 answer.at("checkpoint").get<std::string>(), answer.at("steps").get<long long>(),
                 answer.at("train_loss").get<double>(), answer.at("validation_loss").get<double>()));
    return kExitYes;
}

}  // namespace chironomia::study
