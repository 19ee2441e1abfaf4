#include "synth/learned/training/job_fields.h"

#include <functional>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr long long kMostCount = 1'000'000'000;

Json curve_json(const std::vector<CurvePoint>& curve) {
    Json points = Json::array();
    for (const CurvePoint& p : curve) points.push_back(Json::array({p.step, p.train, p.validation}));
    return points;
}

// "text 0" to "text 767" are "text (768)".
Json feature_names(const std::vector<Feature>& features) {
    Json names = Json::array();
    std::size_t numbered = 0;  // of the same name that were just passed
    for (std::size_t i = 0; i < features.size(); ++i) {
        const std::string& name = features[i].name;
        const std::size_t space = name.rfind(' ');
        const bool continues = space != std::string::npos && name.substr(space + 1) == format("{}", numbered);
        if (!continues) {
            names.push_back(name);
            numbered = 0;
            continue;
        }
        const std::string all = format("{} ({})", name.substr(0, space), ++numbered);
        if (numbered == 1) {
            names.push_back(all);
        } else {
            names.back() = all;
        }
    }
    return names;
}

Json feature_ranges(const std::vector<Feature>& features) {
    Json ranges = Json::array();
    for (const Feature& feature : features) ranges.push_back({feature.low, feature.high});
    return ranges;
}

}  // namespace

JobRun begin_job(const JsonValue& job) {
    JobRun run;
    if (const auto seed = job.find("seed"))
        run.seed = static_cast<std::uint64_t>(seed->integer(0, std::numeric_limits<long long>::max()));
    if (const auto threads = job.find("threads")) run.threads = static_cast<int>(threads->integer(1, 256));
    if (const auto quiet = job.find("quiet")) run.quiet = quiet->json() == Json(true);
    use_threads(run.threads);
    return run;
}

JsonValue job_options(const JsonValue& job) {
    static const Json none = Json::object();
    const auto options = job.find("options");
    return options ? *options : JsonValue(none, "options");
}

CorpusIndex job_corpus(const JsonValue& job, CorpusKind kind) {
    CorpusIndex corpus = read_corpus_index(job.at("corpus").text());
    if (corpus.kind != kind) {
        throw Error(format("{}: a corpus of {}, this model learns from {}; make or import one of {}",
                           corpus.folder.string(), name_of(corpus.kind), name_of(kind), name_of(kind)));
    }
    return corpus;
}

Split job_split(const JsonValue& job) {
    return *split_named(job.at("split").choice({"train", "validation", "test", "unseen"}));
}

void apply_job(const JsonValue& job, const JobRun& run, TrainingPlan& plan) {
    plan.seed = run.seed;
    plan.threads = run.threads;
    plan.quiet = run.quiet;
    const CorpusIndex corpus = read_corpus_index(job.at("corpus").text());
    plan.corpus = hash_of_learned(corpus);
    plan.split = hash_of_split(corpus);
    if (const auto steps = job.find("steps"))
        plan.steps = static_cast<std::size_t>(steps->integer(1, kMostCount));
    if (const auto epochs = job.find("epochs"))
        plan.epochs = static_cast<std::size_t>(epochs->integer(1, kMostCount));
    if (const auto seconds = job.find("save_every")) plan.save_every = seconds->number(0, kMostCount);
}

Json training_answer(const std::filesystem::path& checkpoint, const TrainingResult& result) {
    return {{"checkpoint", (std::filesystem::path(checkpoint_stem(checkpoint)) += ".json").string()},
            {"steps", result.steps},
            {"train_loss", result.train_loss},
            {"validation_loss", result.validation_loss},
            {"stopped_early", result.stopped_early},
            {"curve", curve_json(result.curve)}};
}

Json checkpoint_answer(const Checkpoint& checkpoint) {
    return {{"model", checkpoint.model},
            {"preset", checkpoint.preset},
            {"options", checkpoint.options},
            {"text_encoder", checkpoint.text_encoder},
            {"inputs", feature_names(checkpoint.inputs)},
            {"input_ranges", feature_ranges(checkpoint.inputs)},
            {"outputs", feature_names(checkpoint.outputs)},
            {"seed", checkpoint.seed},
            {"steps", checkpoint.step},
            {"split", checkpoint.training.contains("split") ? checkpoint.training.at("split") : Json()},
            {"curve", curve_json(checkpoint.curve)},
            {"version", checkpoint.version}};
}

std::string shown_name(const Checkpoint& checkpoint) {
    const std::string ablation = checkpoint.options.value("ablation", "none");
    return ablation == "none" ? checkpoint.model : format("{}-{}", checkpoint.model, ablation);
}

Predictions empty_predictions(const std::string& model, const CorpusIndex& corpus, Split split) {
    return {.model = model,
            .corpus = std::filesystem::weakly_canonical(corpus.folder).filename().string(),
            .split = std::string(name_of(split))};
}

ParameterCounts count_parameters(const torch::nn::Module& model, const JsonValue& job) {
    TensorShapes shapes;
    for (const auto& item : model.named_parameters()) shapes[item.key()] = item.value().sizes().vec();
    if (const auto checkpoint = job.find("checkpoint")) {
        shapes = read_weight_shapes(checkpoint->text());
        check_weights(model, shapes, checkpoint->text());
        for (const auto& item : model.named_buffers()) shapes.erase(item.key());
    }
    ParameterCounts counts;
    for (const auto& [name, shape] : shapes)
        counts[name] = std::accumulate(shape.begin(), shape.end(), std::int64_t{1}, std::multiplies<>());
    return counts;
}

std::int64_t sum_of(const ParameterCounts& counts, std::string_view beginning) {
    std::int64_t sum = 0;
    for (const auto& [name, count] : counts) sum += name.starts_with(beginning) ? count : 0;
    return sum;
}

}  // namespace chironomia
