#include "synth/learned/dyads/dyad_jobs.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/features/speech_features.h"
#include "synth/learned/dyads/dyad_loss.h"
#include "synth/learned/dyads/dyad_models.h"
#include "synth/learned/dyads/dyad_pasts.h"
#include "synth/learned/training/job_fields.h"
#include "synth/predictions.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr double kFps = 25;

TrainingPlan plan_of(const DyadTraining& training, std::size_t batches) {
    return {.rate = {.kind = LearningRate::Kind::triangular,
                     .peak = training.peak,
                     .base = training.base,
                     .half_cycle = std::max<std::size_t>(1, training.cycle * batches)},
            .epochs = training.epochs,
            .patience = training.patience > 0 ? std::optional(training.patience) : std::nullopt,
            .clip = training.clip};
}

// The description that a checkpoint of this training holds.
Checkpoint with_features(Checkpoint checkpoint, const DyadFeatures& features) {
    if (checkpoint.model != "il-lstm") checkpoint.inputs = features.speech;
    checkpoint.outputs = features.face;
    checkpoint.inputs.insert(checkpoint.inputs.end(), checkpoint.outputs.begin(), checkpoint.outputs.end());
    return checkpoint;
}

Json all_options(const DyadModel& model, const DyadTraining& training) {
    Json options = model.parts;
    options.update(to_json(training));
    return options;
}

// Random streams beside those of the trainer: for the windows of an epoch, and for those of validation.
constexpr std::uint64_t kEpochStream = 1ULL << 40, kValidationStream = 1ULL << 41;

// The dyads of a split, and the examples made of them for the present epoch or for validation.
struct DyadSet {
    std::vector<DyadFrames> dyads;
    std::vector<DyadWindow> windows;  // recorded
    DyadExamples examples;

    bool has_runs() const { return !examples.runs.empty(); }
    void plan(const OwnPasts& own, const Random& random) {
        examples = plan_examples(dyads, windows, own, random);
    }
    void run(const DyadModel& model) {
        if (has_runs()) examples.faces = run_free(model, dyads, examples);
    }
    std::vector<PastWindow> chosen(const Batch& batch) const {
        std::vector<PastWindow> found;
        for (const std::size_t index : batch) found.push_back(examples.windows[index]);
        return found;
    }
};

DyadSet dyad_set_of(const CorpusIndex& corpus, Split split, const DyadFeatures& features,
                    const DyadTraining& training) {
    const std::size_t least = kWindowFrames + (training.own_past > 0 ? 2 : 1);
    const std::size_t stride =
        split == Split::train ? training.stride : std::max<std::size_t>(20, training.stride);
    DyadSet set{.dyads = read_dyads(corpus, split, features, least)};
    set.windows = windows_over(set.dyads, stride);
    return set;
}

OwnPasts own_pasts_of(const DyadTraining& training) {
    return {.share = training.own_past,
            .frames = static_cast<std::size_t>(std::max(1.0, std::round(training.own_seconds * kFps)))};
}

// The examples of each epoch: from `own_from` on there are windows that follow what the model predicts.
struct EpochExamples {
    DyadSet& set;
    const DyadModel& model;
    const DyadTraining& training;
    std::uint64_t seed = 0;
    const fs::path& file;  // of the checkpoint

    void plan(std::size_t epoch) const {
        set.plan(epoch < training.own_from ? OwnPasts{} : own_pasts_of(training),
                 Random(seed, kEpochStream + epoch));
    }
    Tensors make(std::size_t epoch) const {
        plan(epoch);
        set.run(model);
        if (!set.has_runs()) return {};
        return {{"faces", set.examples.faces}};
    }
    void use(std::size_t epoch, const Tensors& made) const {
        plan(epoch);
        if (set.has_runs())
            set.examples.faces = find_tensor(made, "faces", set.examples.shape_of_faces(), file);
    }
};

Json train_dyads(const std::string& name, const JsonValue& job) {
    const JobRun run = begin_job(job);
    const std::string preset = job.at("preset").choice({"paper", "small"});
    const DyadTraining training = dyad_training(preset, job_options(job));
    const DyadModel model = make_dyad_model(name, preset, job_options(job), run.seed);
    const CorpusIndex corpus = job_corpus(job, CorpusKind::dyads);
    const DyadFeatures features = dyad_features(read_statistics(corpus));
    const Checkpoint description =
        with_features({.model = name, .preset = preset, .options = all_options(model, training)}, features);
    DyadSet train_set = dyad_set_of(corpus, Split::train, features, training);
    DyadSet validation_set = dyad_set_of(corpus, Split::validation, features, training);
    train_set.plan({}, Random(0));
    validation_set.plan(own_pasts_of(training), Random(run.seed, kValidationStream));

    const std::size_t half = training.batch / 2;  // windows come in both orders
    TrainingPlan plan = plan_of(training, (train_set.windows.size() + half - 1) / half);
    apply_job(job, run, plan);
    const fs::path file = job.at("out").text();
    TrainingTask task{
        .model = model.module,
        .unit = "windows in both orders",
        .examples = train_set.windows.size(),
        .batches = [&](Random& random) { return shuffled_batches(train_set.windows.size(), half, random); },
        .loss =
            [&](const Batch& batch) {
                return loss_of(model, train_set.dyads, train_set.examples, train_set.chosen(batch));
            },
        .validation_loss =
            [&] {
                validation_set.run(model);
                return mean_loss(model, validation_set.dyads, validation_set.examples);
            }};
    const EpochExamples examples{
        .set = train_set, .model = model, .training = training, .seed = run.seed, .file = file};
    if (training.own_past > 0) {
        task.make_examples = [&](std::size_t epoch) { return examples.make(epoch); };
        task.use_examples = [&](std::size_t epoch, const Tensors& made) { examples.use(epoch, made); };
    }
    return training_answer(file, train(task, plan, description, file));
}

// A model as its checkpoint has it, and how its numbers are scaled.
struct TrainedDyadModel {
    Checkpoint checkpoint;
    DyadModel model;
    DyadFeatures features;
};

// The options of a checkpoint that made it, not those that a job may set.
DyadModel model_of_checkpoint(const Checkpoint& checkpoint, const fs::path& file) {
    return make_dyad_model(checkpoint.model, checkpoint.preset, JsonValue(checkpoint.options, file.string()),
                           checkpoint.seed);
}

TrainedDyadModel trained_model(const JsonValue& job) {
    const fs::path file = job.at("checkpoint").text();
    auto [checkpoint, weights, unused] = read_checkpoint(file, CheckpointParts::weights);
    DyadModel model = model_of_checkpoint(checkpoint, file);
    std::vector<std::string> inputs;
    if (checkpoint.model != "il-lstm") inputs = speech_columns();
    for (const std::string& column : face_column_names()) inputs.push_back(column);
    check_fits(file, checkpoint, {.inputs = inputs, .outputs = face_column_names()});
    set_weights(*model.module, weights, file);
    model.module->eval();
    DyadFeatures features{.face = checkpoint.outputs,
                          .speech = {checkpoint.inputs.begin(), checkpoint.inputs.end() - DyadPerson::kFace}};
    // A model without speech inputs takes speech of any scale.
    if (features.speech.empty())
        for (const std::string& column : speech_columns()) features.speech.push_back({.name = column});
    return {.checkpoint = std::move(checkpoint), .model = std::move(model), .features = std::move(features)};
}

PersonTrack track_of(const DyadFrames::Person& person) {
    const auto numbers = [](const torch::Tensor& rows) {
        return std::vector<float>(rows.data_ptr<float>(), rows.data_ptr<float>() + rows.numel());
    };
    return {.face = numbers(person.face), .speech = numbers(person.speech)};
}

std::vector<float> from_frame(const std::vector<float>& face, std::size_t frame) {
    return {face.begin() + static_cast<std::ptrdiff_t>(frame * DyadPerson::kFace), face.end()};
}

// How a model predicts the people of dyads.
struct DyadPredictor {
    std::string name;
    std::function<DyadStep()> start;
    DyadFeatures features;
};

Json predict_dyads(const DyadPredictor& predictor, const JsonValue& job, const JobRun& run) {
    const JsonValue options = job_options(job);
    options.allow_only({"horizon"});
    const auto seconds = options.find("horizon");
    const auto horizon = static_cast<std::size_t>(
        seconds ? std::max(1.0, std::round(seconds->number(1 / kFps, 1e6) * kFps)) : 0.0);
    const CorpusIndex corpus = job_corpus(job, CorpusKind::dyads);
    const Split split = job_split(job);
    const auto dyads = read_dyads(corpus, split, predictor.features, kWindowFrames + 1);
    Predictions predictions = empty_predictions(predictor.name, corpus, split);
    predictions.fps = kFps;
    predictions.features = face_column_names();
    for (const Feature& feature : predictor.features.face)
        predictions.scale.push_back({feature.low, feature.high});
    Progress progress("predicting", "faces", 2 * dyads.size(), run.quiet);
    for (const DyadFrames& dyad : dyads) {
        for (const std::size_t person : {0, 1}) {
            const DyadTrack track{.a = track_of(dyad.people[person]), .u = track_of(dyad.people[1 - person])};
            predictions.items.push_back(
                {.id = format("{}:{}", dyad.id, person),
                 .speaker = dyad.people[person].participant,
                 .truth = from_frame(track.a.face, kWindowFrames),
                 .prediction = roll_out(predictor.start(), track, kWindowFrames, horizon),
                 .partner = from_frame(track.u.face, kWindowFrames)});
            progress.step();
        }
    }
    const fs::path out = job.at("out").text();
    write_predictions(out, predictions);
    return {{"predictions", out.string()}, {"items", predictions.items.size()}};
}

Json predict_with_checkpoint(const JsonValue& job) {
    const JobRun run = begin_job(job);
    const TrainedDyadModel trained = trained_model(job);
    return predict_dyads(
        {.name = shown_name(trained.checkpoint), .start = trained.model.start, .features = trained.features},
        job, run);
}

Json predict_hold(const JsonValue& job) {
    const JobRun run = begin_job(job);
    const CorpusIndex corpus = job_corpus(job, CorpusKind::dyads);
    return predict_dyads({.name = "hold",
                          .start = [] { return DyadStep(hold_face); },
                          .features = dyad_features(read_statistics(corpus))},
                         job, run);
}

// (T, columns) of an inputs file, normalised.
std::vector<float> input_rows(const Hdf5File& file, const char* name, const std::vector<Feature>& features,
                              std::size_t frames) {
    const std::vector<double> rows = file.read_numbers(name, {frames, features.size()});
    const torch::Tensor scaled = normalised(std::vector<float>(rows.begin(), rows.end()), features);
    return {scaled.data_ptr<float>(), scaled.data_ptr<float>() + scaled.numel()};
}

// Four seconds before the first frame in which everything is as in it.
std::vector<float> led_in(const std::vector<float>& rows, std::size_t columns) {
    std::vector<float> all;
    for (std::size_t t = 0; t < kWindowFrames; ++t)
        all.insert(all.end(), rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(columns));
    all.insert(all.end(), rows.begin(), rows.end());
    return all;
}

Json animate_dyad(const JsonValue& job) {
    begin_job(job);
    const TrainedDyadModel trained = trained_model(job);
    const DyadFeatures& features = trained.features;
    const fs::path inputs = job.at("inputs").text(), out = job.at("out").text();
    const std::vector<std::byte> bytes = read_bytes(inputs);
    const Hdf5File file(bytes, inputs.string());
    if (!file.has("speech")) file.refuse("has no array \"speech\", that of the agent; write it");
    const std::size_t frames = file.shape_of("speech").at(0);
    if (frames == 0) file.refuse("\"speech\" has no frames; give it at least one");
    const std::vector<float> neutral(DyadPerson::kFace * frames, 0.0f);
    const torch::Tensor rest = normalised(neutral, features.face);
    const DyadTrack dyad{
        .a = {.face =
                  led_in({rest.data_ptr<float>(), rest.data_ptr<float>() + rest.numel()}, DyadPerson::kFace),
              .speech = led_in(input_rows(file, "speech", features.speech, frames), DyadPerson::kSpeech)},
        .u = {
            .face = led_in(input_rows(file, "user/face", features.face, frames), DyadPerson::kFace),
            .speech = led_in(input_rows(file, "user/speech", features.speech, frames), DyadPerson::kSpeech)}};
    const std::vector<float> predicted = roll_out(trained.model.start(), dyad, kWindowFrames, 0);
    const torch::Tensor face =
        torch::from_blob(const_cast<float*>(predicted.data()),
                         {static_cast<int64_t>(frames), static_cast<int64_t>(DyadPerson::kFace)});
    PendingOutput pending(out, PendingOutput::Kind::file);
    Hdf5Writer writer(pending.path(), out.string());
    writer.write_floats("face", {frames, DyadPerson::kFace}, denormalised(face, features.face));
    writer.write_texts("features", face_column_names());
    writer.write_number("fps", kFps);
    writer.close();
    pending.commit();
    return {{"frames", frames}, {"fps", kFps}};
}

Json describe_dyad_model(const std::string& name, const JsonValue& job) {
    if (job.find("checkpoint")) {
        const fs::path file = job.at("checkpoint").text();
        const Checkpoint checkpoint = read_checkpoint(file, CheckpointParts::description).description;
        Json answer = checkpoint_answer(checkpoint);
        answer["parameters"] = sum_of(count_parameters(*model_of_checkpoint(checkpoint, file).module, job));
        return answer;
    }
    const std::string preset = job.at("preset").choice({"paper", "small"});
    const DyadModel model = make_dyad_model(name, preset, job_options(job), 1);
    return {{"model", name},
            {"preset", preset},
            {"options", all_options(model, dyad_training(preset, job_options(job)))},
            {"parameters", sum_of(count_parameters(*model.module, job))}};
}

}  // namespace

LearnedModel dyad_learned_model(const std::string& name) {
    return {.name = name,
            .train = [name](const JsonValue& job) { return train_dyads(name, job); },
            .predict = predict_with_checkpoint,
            .animate = animate_dyad,
            .describe = [name](const JsonValue& job) { return describe_dyad_model(name, job); }};
}

LearnedModel hold_model() {
    const auto refuse = [](const JsonValue&) -> Json {
        throw Error("hold: this model repeats the last face and has nothing to learn; predict with it");
    };
    return {.name = "hold",
            .train = refuse,
            .predict = predict_hold,
            .animate = refuse,
            .describe = [](const JsonValue&) -> Json {
                return {{"model", "hold"}, {"parameters", 0}};
            }};
}

}  // namespace chironomia
