#include "study/cli/train_verbs.h"

#include <map>
#include <memory>

#include "study/cli/model_options.h"
#include "study/cli/option_kinds.h"
#include "study/cli/option_values.h"
#include "study/models/evaluation_baselines.h"

namespace chironomia {
namespace {

void add_threads(CLI::App& verb, int& threads) {
    verb.add_option("--threads", threads, "Threads that compute [1]")
        ->type_name("N")
        ->check(CLI::Range(1, 256));
}

void add_model_options(CLI::App& verb, ModelOptions& options) {
    const auto read = [&options](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            const auto option = model_option(text);
            if (!option) throw CLI::ValidationError("--option", format("\"{}\" is no KEY=VALUE", text));
            options[option->first] = option->second;
        }
    };
    verb.add_option_function<std::vector<std::string>>(
            "--option", read, "An option of the model, by its name (docs/learning.md)")
        ->type_name("KEY=VALUE");
    for (const Reading& reading : readings()) {
        verb.add_option_function<std::string>(
                "--" + reading.name,
                [&options, key = reading.key](const std::string& text) { options[key] = option_value(text); },
                reading.help)
            ->type_name(reading.values)
            ->group("Readings of the papers, of those models that have them (docs/learning.md)");
    }
}

}  // namespace

void add_train(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<TrainCommand>();
    CLI::App* verb = app.add_subcommand("train", "Train a learned model on a corpus");
    verb->footer(
        "Examples:\n"
        "  $ chironomia train model2 --corpus talks --preset small --out model2.safetensors\n"
        "  $ chironomia train amii --corpus dyads --preset small --option ablation=noE_m --epochs 5 --seed 2 "
        "--out amii-noE_m.safetensors\n"
        "Trained again with the same command, a checkpoint that was interrupted goes on.");
    verb->add_option("model", command->model, "amii, il-lstm, sym-il-lstm, model1 or model2")
        ->type_name("MODEL")
        ->required();
    verb->add_option("--corpus", command->corpus, "Folder of the corpus (docs/corpora.md)")
        ->type_name("DIR")
        ->required();
    verb->add_option("--preset", command->preset, "Sizes and training: paper, small, ... [small]")
        ->type_name("P");
    verb->add_option("--out", command->out, "The checkpoint; FILE.json and more lie beside it")
        ->type_name("FILE.safetensors")
        ->required();
    verb->add_option("--seed", command->seed, "Of the weights and of the order of examples [1]")
        ->type_name("N");
    add_threads(*verb, command->threads);
    verb->add_option("--epochs", command->epochs, "Passes over the corpus [the preset's]")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    verb->add_option("--steps", command->steps, "Steps after which it ends, if that comes first")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000000));
    add_model_options(*verb, command->options);
    verb->add_flag("--quiet", command->quiet, "No progress");
    verb->add_flag("--json", command->json, "Print what training came to, with the curve of the loss");
    verb->callback([&result, command, verb] { result = *command; });
}

void add_evaluate(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<EvaluateCommand>();
    CLI::App* verb = app.add_subcommand(
        "evaluate", "Compare what models predict with what people did, beside the published numbers");
    verb->footer(
        "Examples:\n"
        "  $ chironomia evaluate --checkpoint model1.safetensors model2.safetensors --corpus talks --split "
        "test --out results\n"
        "  $ chironomia evaluate --checkpoint amii.safetensors --corpus dyads --split test --against "
        "hold,mean --out results --json");
    verb->add_option("--checkpoint", command->checkpoints, "Checkpoints of models")->type_name("C...");
    verb->add_option("--predictions", command->predictions,
                     "What other models predicted, in files of synth/predictions.h")
        ->type_name("P.h5...");
    verb->add_option("--corpus", command->corpus, "Folder of the corpus")->type_name("DIR");
    verb->add_option("--split", command->split, "Which records [test]")
        ->type_name("test|unseen")
        ->check(CLI::IsMember({"test", "unseen", "validation", "train"}));
    verb->add_option("--against", command->against,
                     "Baselines: hold (what was half a second ago), mean (of the training records)")
        ->type_name("hold,mean")
        ->delimiter(',')
        ->check(CLI::IsMember(baseline_names()));
    verb->add_option("--out", command->out, "Folder of the tables and predictions")
        ->type_name("DIR2")
        ->required();
    verb->add_option("--samples", command->evaluation.resampling.samples, "Resamples of the records [1000]")
        ->type_name("N")
        ->check(CLI::Range(100, 1000000));
    verb->add_option("--seed", command->evaluation.resampling.seed, "Of the resamples [42]")->type_name("N");
    add_choice<ActivationScale>(*verb, "--activation-scale", command->evaluation.activation,
                                {{"raw", ActivationScale::raw}, {"normalised", ActivationScale::normalised}},
                                "On which scale an action unit above 0.5 is active [raw]");
    add_choice<LagSummary>(*verb, "--lag-summary", command->evaluation.lag_summary,
                           {{"signed", LagSummary::signed_most},
                            {"absolute", LagSummary::absolute_most},
                            {"mean", LagSummary::mean}},
                           "TLCC: the largest r of all lags, the largest without its sign, or their mean "
                           "[signed]");
    add_model_options(*verb, command->options);
    add_threads(*verb, command->threads);
    verb->add_flag("--quiet", command->quiet, "No progress");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command, verb] {
        if (command->checkpoints.empty() && command->predictions.empty())
            throw CLI::RequiredError("--checkpoint or --predictions");
        if (command->corpus.empty() && !command->checkpoints.empty()) throw CLI::RequiredError("--corpus");
        if (command->corpus.empty() && !command->against.empty())
            throw CLI::RequiredError("--corpus, for --against");
        result = *command;
    });
}

void add_measure(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<MeasureCommand>();
    CLI::App* verb = app.add_subcommand(
        "measure", "Measure how bodies and faces move, and how near they are to a reference");
    verb->footer(
        "Examples:\n"
        "  $ chironomia measure ours.bvh baseline.bvh --json\n"
        "  $ chironomia measure predicted.h5 --against recorded.csv --partner listener.csv");
    verb->add_option("motions", command->motions, "Motion files of any kind that is read")
        ->type_name("M...")
        ->required();
    verb->add_option("--against", command->against, "What people did: RMSE, PCC, AHR, distances ...")
        ->type_name("REF");
    verb->add_option("--partner", command->partner, "Who they talk with: TLCC, DTW, Sync, EL of smiles")
        ->type_name("U");
    add_read_option(
        *verb, "--motion-fps",
        [command](const std::string& text) { command->hints.fps = parse_motion_rate(text); },
        "Frames per second of motions that do not carry a rate")
        ->type_name("R");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] { result = *command; });
}

}  // namespace chironomia
