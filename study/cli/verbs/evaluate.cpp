// chironomia evaluate
#include <cstdio>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/models/evaluation_baselines.h"
#include "study/models/evaluation_tables.h"
#include "synth/learning.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

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

std::string text_of(const Table& table) {
    return format("{}\n{}{}\n\n", table.title, to_text(table), table.note);
}

std::string text_of(const Evaluation& evaluation) {
    std::string text;
    for (const Table& table : tables_of(evaluation)) text += text_of(table);
    for (const Table& table : published_beside(evaluation)) text += text_of(table);
    return text;
}

}  // namespace

int run(const EvaluateCommand& command) {
    const std::vector<fs::path> files = predict_all(command);
    std::vector<Predictions> models;
    for (const fs::path& file : files) models.push_back(read_predictions(file));
    name_apart(models, files);
    for (const std::string& name : command.against)
        models.push_back(baseline_of(command, name, models.front()));
    const Evaluation evaluation = evaluate(models, command.evaluation);
    for (const std::string& note : evaluation.notes) std::fputs((note + "\n").c_str(), stderr);
    write_evaluation(command.out, evaluation);
    std::fputs((command.json ? to_json(evaluation).dump(2) + "\n"
                             : text_of(evaluation) + command.out.string() + "\n")
                   .c_str(),
               stdout);
    return kExitYes;
}

}  // namespace chironomia
