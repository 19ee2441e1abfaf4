// chironomia evaluate
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <set>
#include <span>

#include "core/error.h"
#include "core/text.h"
#include "study/cli/options/model_options.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/models/evaluation_baselines.h"
#include "study/models/evaluation_tables.h"
#include "study/models/recorded_rows.h"
#include "study/models/style_maps.h"
#include "synth/learning.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLeastMapped = 7;  // segments: fewer have no t-SNE

fs::path whole(const fs::path& path) {
    return fs::absolute(path).lexically_normal();
}

// Lets the helper predict; `who` says with which model.
fs::path predict(const EvaluateCommand& command, Json who, const std::string& name) {
    const fs::path file = whole(command.out) / "predictions" / (name + ".h5");
    std::error_code problem;
    fs::create_directories(file.parent_path(), problem);
    Json options = Json::object();
    for (const auto& [key, value] : command.options) options[key] = value;
    who.update({{"verb", "predict"},
                {"corpus", whole(command.corpus).string()},
                {"split", command.split},
                {"out", file.string()},
                {"threads", command.threads},
                {"quiet", command.quiet},
                {"options", std::move(options)}});
    ask_to_learn(who);
    return file;
}

Json description_of(const fs::path& checkpoint) {
    return ask_to_learn({{"verb", "describe"}, {"checkpoint", whole(checkpoint).string()}});
}

// Of models that have learned from other records than those that the corpus has for it, as of one that was imported
// again with another seed. Bundled checkpoints, and those of earlier versions, do not say from which.
std::vector<std::string> notes_of_splits(const EvaluateCommand& command) {
    if (command.split == "train" || command.split == "validation") return {};
    std::vector<std::string> notes;
    std::vector<fs::path> learned = command.checkpoints;
    if (command.classifier) learned.push_back(*command.classifier);
    for (const fs::path& checkpoint : learned) {
        const Json split = description_of(checkpoint).value("split", Json());
        if (!split.is_string() || split == hash_of_split(read_corpus_index(command.corpus))) continue;
        notes.push_back(
            format("{}: it has learned from other records than those in \"train\" and \"validation\" of {}; "
                   "where some of these are in \"{}\", it {} on what it has learned",
                   checkpoint.string(), command.corpus.string(), command.split,
                   checkpoint == command.classifier ? "judges" : "is judged"));
    }
    return notes;
}

// Before any of them predicts, which takes minutes.
void check_same_outputs(const std::vector<fs::path>& checkpoints) {
    if (checkpoints.size() < 2) return;
    const Json first = description_of(checkpoints.front()).at("outputs");
    for (const fs::path& checkpoint : std::span(checkpoints).subspan(1)) {
        const Json other = description_of(checkpoint).at("outputs");
        if (other == first) continue;
        throw Error(
            format("--checkpoint {} and {}: they predict {} and {}; evaluate together models that "
                   "predict the same",
                   checkpoints.front().string(), checkpoint.string(),
                   join(first.get<std::vector<std::string>>()), join(other.get<std::vector<std::string>>())));
    }
}

// A file of predictions for each checkpoint, named as the checkpoint is.
std::vector<fs::path> predict_all(const EvaluateCommand& command) {
    std::vector<fs::path> files;
    std::set<std::string> names;
    for (const fs::path& checkpoint : command.checkpoints) {
        const std::string name = checkpoint.stem().string();
        if (!names.insert(name).second) {
            throw Error(
                format("--checkpoint {}: another one is called \"{}\" too; give each a name of its own",
                       checkpoint.string(), name));
        }
    }
    check_same_outputs(command.checkpoints);
    for (const fs::path& checkpoint : command.checkpoints) {
        files.push_back(
            predict(command, {{"checkpoint", whole(checkpoint).string()}}, checkpoint.stem().string()));
    }
    files.insert(files.end(), command.predictions.begin(), command.predictions.end());
    return files;
}

// Of dyads, what is held is held as long as the models predict on their own, which the helper knows.
Predictions baseline_of(const EvaluateCommand& command, const std::string& name, const Predictions& like) {
    const CorpusIndex corpus = read_corpus_index(command.corpus);
    if (name == "hold" && corpus.kind == CorpusKind::dyads && !command.checkpoints.empty())
        return read_predictions(predict(command, {{"model", "hold"}}, "hold"));
    return baseline(name, like, corpus);
}

// What the checkpoints of models of style encode; their predictions are the first ones.
std::vector<StyleEncodings> encodings_of(const EvaluateCommand& command,
                                         const std::vector<Predictions>& models) {
    std::vector<StyleEncodings> all;
    for (std::size_t i = 0; i < command.checkpoints.size(); ++i) {
        if (models[i].items.front().style.empty()) continue;
        const std::string file = whole(command.checkpoints[i]).string();
        const std::string model = description_of(command.checkpoints[i]).at("model");
        if (!model.starts_with("zs-mstm")) continue;
        const JobFolder folder;
        ask_to_learn({{"verb", "encode_styles"},
                      {"checkpoint", file},
                      {"corpus", whole(command.corpus).string()},
                      {"split", command.split},
                      {"out", folder.result().string()},
                      {"threads", command.threads}});
        all.push_back(read_encodings(folder.result(), command.checkpoints[i].stem().string()));
    }
    return all;
}

// Behind the tables, which stay if a map cannot be made.
void write_maps(const EvaluateCommand& command, const std::vector<StyleEncodings>& all) {
    for (const StyleEncodings& encodings : all) {
        if (encodings.speakers.size() >= kLeastMapped) {
            write_style_maps(command.out, encodings);
        } else {
            std::fputs(format("{}: {} segments are too few for a map, which needs {}\n", encodings.model,
                              encodings.speakers.size(), kLeastMapped)
                           .c_str(),
                       stderr);
        }
    }
}

// What a classifier of styles says of the clips of each file.
std::vector<analysis::Table> judgements_of(const EvaluateCommand& command, const std::vector<fs::path>& files,
                                           const std::vector<Predictions>& models) {
    if (!command.classifier) return {};
    const std::string classifier = whole(*command.classifier).string();
    const Json own = ask_to_learn({{"verb", "predict"},
                                   {"checkpoint", classifier},
                                   {"corpus", whole(command.corpus).string()},
                                   {"split", command.split},
                                   {"threads", command.threads},
                                   {"quiet", command.quiet}});
    std::vector<StyleJudgement> all;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!has_transfers(models[i])) continue;
        const Json judged = ask_to_learn({{"verb", "predict"},
                                          {"checkpoint", classifier},
                                          {"predictions", whole(files[i]).string()},
                                          {"threads", command.threads},
                                          {"quiet", command.quiet}});
        all.push_back({.model = models[i].model,
                       .clips = judged.at("clips").get<std::size_t>(),
                       .as_style = judged.at("as_style").get<std::size_t>(),
                       .as_source = judged.at("as_source").get<std::size_t>()});
    }
    return {strength_table(all, own.at("accuracy").get<double>())};
}

// Systems of the same name get the names of their files too, so that tables distinguish them.
void name_apart(std::vector<Predictions>& models, const std::vector<fs::path>& files) {
    std::set<std::string> names, twice;
    for (const Predictions& model : models) {
        if (!names.insert(model.model).second) twice.insert(model.model);
    }
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (twice.contains(models[i].model))
            models[i].model = format("{} ({})", models[i].model, files[i].stem().string());
    }
}

// What other programs predicted must be of the records that the command names, and of what people did in them. Says
// which of these it lacks.
std::vector<std::string> check_records(const EvaluateCommand& command, const fs::path& file,
                                       const Predictions& predictions) {
    if (predictions.split != command.split) {
        throw Error(format("{}: /split is \"{}\", and --split is \"{}\"; give the split that was predicted",
                           file.string(), predictions.split, command.split));
    }
    std::set<std::string> asked, predicted;
    const CorpusIndex corpus = read_corpus_index(command.corpus);
    for (const CorpusEntry& entry : corpus.of(*split_named(command.split))) asked.insert(entry.id);
    for (const PredictedItem& item : predictions.items) {
        const std::string record = record_of(item);
        if (!asked.contains(record)) {
            throw Error(
                format("{}: /ids: {} has no record \"{}\" in \"{}\"; give the corpus that was predicted",
                       file.string(), command.corpus.string(), record, command.split));
        }
        predicted.insert(record);
    }
    std::vector<std::string> notes = check_truth(predictions, corpus, file.string());
    if (predicted.size() == asked.size()) return notes;
    const std::string lacks =
        *std::ranges::find_if(asked, [&](const std::string& id) { return !predicted.contains(id); });
    notes.push_back(
        format("{}: {} of the {} records of {} in \"{}\" are predicted; \"{}\" is the first that is not",
               file.string(), predicted.size(), asked.size(), command.corpus.string(), command.split, lacks));
    return notes;
}

std::string text_of(const analysis::Table& table) {
    return format("{}\n{}{}\n\n", table.title, to_text(table), table.note);
}

std::string text_of(const Evaluation& evaluation) {
    std::string text;
    for (const analysis::Table& table : tables_of(evaluation)) text += text_of(table);
    for (const analysis::Table& table : published_beside(evaluation)) text += text_of(table);
    return text;
}

void add_metric_options(CLI::App& verb, EvaluationOptions& options) {
    verb.add_option("--samples", options.resampling.samples, "Resamples of the records [1000]")
        ->type_name("N")
        ->check(CLI::Range(100, 1000000));
    add_seed(verb, options.resampling.seed, "Of the resamples [42]");
    add_choice<ActivationScale>(verb, "--activation-scale", options.activation,
                                {{"raw", ActivationScale::raw}, {"normalised", ActivationScale::normalised}})
        ->description("On which scale an action unit above 0.5 is active [raw]");
    add_choice<LagSummary>(verb, "--lag-summary", options.lag_summary,
                           {{"signed", LagSummary::signed_most},
                            {"absolute", LagSummary::absolute_most},
                            {"mean", LagSummary::mean}})
        ->description("TLCC of all lags: the largest |r|, the mean r, or the largest r [signed]");
    add_choice<StylePoints>(verb, "--style-points", options.style_points,
                            {{"raw", StylePoints::raw}, {"smoothed", StylePoints::smoothed}})
        ->description(
            "Dist_avg of points as they are, or of their means over three frames, without most of the "
            "noise of trackers [raw]");
}

// What is judged must be there, and a corpus for whatever works on its records.
void check_inputs(const EvaluateCommand& command) {
    if (command.checkpoints.empty() && command.predictions.empty())
        throw CLI::RequiredError("--checkpoint or --predictions");
    if (!command.corpus.empty()) return;
    if (!command.checkpoints.empty()) throw CLI::RequiredError("--corpus");
    if (command.classifier) throw CLI::RequiredError("--corpus, for --classifier");
    if (!command.against.empty()) throw CLI::RequiredError("--corpus, for --against");
}

}  // namespace

void add_evaluate(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<EvaluateCommand>();
    CLI::App* verb = add_verb(
        app, "evaluate", "Compare what models predict with what people did, beside the published numbers",
        ""
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
    verb->add_option("--classifier", command->classifier,
                     "Checkpoint of a style-classifier, which says whose style clips are taken for")
        ->type_name("C");
    verb->add_option("--out", command->out, "Folder of the tables and predictions")
        ->type_name("DIR2")
        ->required();
    add_metric_options(*verb, command->evaluation);
    add_model_options(*verb, command->options);
    add_threads(*verb, command->threads);
    verb->add_flag("--quiet", command->quiet, "No progress");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] {
        check_inputs(*command);
        result = *command;
    });
}

int run(const EvaluateCommand& command) {
    for (const std::string& name : command.against) check_baseline(name, read_corpus_index(command.corpus));
    const std::vector<fs::path> files = predict_all(command);
    std::vector<Predictions> models;
    for (const fs::path& file : files) models.push_back(read_predictions(file));
    if (!command.corpus.empty()) {
        for (std::size_t i = command.checkpoints.size(); i < files.size(); ++i)
            warn(check_records(command, files[i], models[i]));
    }
    name_apart(models, files);
    for (const std::string& name : command.against)
        models.push_back(baseline_of(command, name, models.front()));
    Evaluation evaluation = evaluate(models, command.evaluation);
    for (std::string& note : notes_of_splits(command)) evaluation.notes.push_back(std::move(note));
    const std::vector<StyleEncodings> encodings = encodings_of(command, models);
    if (!encodings.empty()) evaluation.more.push_back(encodings_table(encodings));
    for (analysis::Table& table : judgements_of(command, files, models))
        evaluation.more.push_back(std::move(table));
    warn(evaluation.notes);
    write_evaluation(command.out, evaluation);
    write_maps(command, encodings);
    print(command.json ? to_json(evaluation).dump(2) + "\n"
                       : text_of(evaluation) + command.out.string() + "\n");
    return kExitYes;
}

}  // namespace chironomia::study
