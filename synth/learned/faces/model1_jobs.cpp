// The jobs of Model 1, which learns in three parts: the auto-encoders of pitch and face, then all of it. Each
// auto-encoder is a checkpoint of its own, FILE-speech and FILE-face (or FILE-face-AU1 ...), so that training
// goes on in any part.
#include <torch/nn/functional/loss.h>
#include <torch/utils.h>

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "synth/features/contour.h"
#include "synth/learned/faces/face_jobs.h"
#include "synth/learned/faces/face_presets.h"
#include "synth/learned/faces/model1.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr double kHit = 0.05;  // how near a restored number is to count as accurate (A36)

FaceModel as_face_model(Model1 model, Checkpoint described) {
    const Model1Options options = model1_options(described.preset, described.options);
    const auto learn = [model](const FaceBatch& batch) mutable { return model->forward(batch); };
    return {.described = std::move(described),
            .levels = options.levels,
            .cut = {.most_frames = options.most_frames},
            .module = model.get(),
            .learn = learn,
            .predict = learn};
}

// A checkpoint that does not name an option is older than it, and without it.
FaceModel build_model1(Checkpoint described) {
    const Json kept = described.options;
    described.options = model1_choices(JsonValue(kept, "the checkpoint's options"));
    Model1 model(model1_options(described.preset, described.options));
    return as_face_model(std::move(model), std::move(described));
}

// Contours in [0, 1], none empty.
using Contours = std::vector<std::vector<float>>;

Contours pitch_contours(const std::vector<FaceUnit>& units) {
    Contours contours;
    for (const FaceUnit& unit : units) {
        for (const FaceWord& word : unit.words) {
            if (word.f0.empty()) continue;
            std::vector<float>& contour = contours.emplace_back();
            for (const float f0 : word.f0) contour.push_back(static_cast<float>(normalized_pitch(f0)));
        }
    }
    return contours;
}

// Those of the channels from `first` to before `past`.
Contours face_contours(const std::vector<FaceUnit>& units, std::size_t first, std::size_t past) {
    Contours contours;
    for (const FaceUnit& unit : units) {
        for (const FaceWord& word : unit.words) {
            for (std::size_t c = first; c < past && word.length > 0; ++c) {
                std::vector<float>& contour = contours.emplace_back(word.length);
                for (std::size_t k = 0; k < word.length; ++k)
                    contour[k] = word.contours[k * kFaceChannels + c];
            }
        }
    }
    return contours;
}

struct PackedContours {
    Tensor values;  // (E)
    Packed packed;
};

PackedContours pack(const Contours& contours, const Batch& chosen) {
    std::vector<float> values;
    std::vector<std::int64_t> counts;
    for (const std::size_t i : chosen) {
        values.insert(values.end(), contours[i].begin(), contours[i].end());
        counts.push_back(static_cast<std::int64_t>(contours[i].size()));
    }
    return {torch::tensor(values), pack_series(counts)};
}

// How an auto-encoder restores all of the contours.
struct Restored {
    double loss = 0;      // mean squared error
    double accuracy = 0;  // share of numbers within kHit
};

Restored restore(ContourAutoencoder& autoencoder, const Contours& contours) {
    constexpr std::size_t kAtATime = 1024;
    double squares = 0, hits = 0, count = 0;
    for (std::size_t first = 0; first < contours.size(); first += kAtATime) {
        Batch chosen;
        for (std::size_t i = first; i < std::min(first + kAtATime, contours.size()); ++i) chosen.push_back(i);
        const PackedContours batch = pack(contours, chosen);
        const Tensor error = (autoencoder->forward(batch.values, batch.packed) - batch.values).abs();
        squares += error.square().sum().item<double>();
        hits += (error <= kHit).sum().item<double>();
        count += static_cast<double>(batch.values.size(0));
    }
    return {squares / std::max(count, 1.0), hits / std::max(count, 1.0)};
}

// Everything that the steps of a training share.
struct Model1Job {
    const JsonValue& job;
    JobRun run;
    Model1Options options;
    Model1Training training;
    FaceCorpus corpus;
    Checkpoint described;
    fs::path out;

    TrainingPlan plan(const LearningSize& size, const OptimiserKind& optimiser) const {
        TrainingPlan plan{.optimiser = optimiser, .epochs = size.epochs};
        apply_job(job, run, plan);
        return plan;
    }
    // An auto-encoder's learning can be shortened, a longer one is of the model alone.
    TrainingPlan pre_net_plan(const LearningSize& size) const {
        TrainingPlan pre_net = plan(size, {.rule = OptimiserKind::Rule::adam});  // section 5.5.2
        pre_net.epochs = std::min(pre_net.epochs, size.epochs);
        return pre_net;
    }
};

// What an auto-encoder learns, and where it is kept.
struct PreNet {
    std::string part;  // "speech", "face", "face-AU1"
    Contours train, validation;
    LearningSize size;  // in contours
};

// By eq. (5.3).
Json train_pre_net(const Model1Job& asked, ContourAutoencoder& autoencoder, const PreNet& net) {
    Checkpoint described = asked.described;
    described.model = "model1-" + net.part;
    const TrainingTask task{
        .model = autoencoder.get(),
        .unit = "contours of " + net.part,
        .examples = net.train.size(),
        .batches = [&](Random& random) { return shuffled_batches(net.train.size(), net.size.batch, random); },
        .loss =
            [&](const Batch& chosen) {
                const PackedContours batch = pack(net.train, chosen);
                return torch::nn::functional::mse_loss(autoencoder->forward(batch.values, batch.packed),
                                                       batch.values);
            },
        .validation_loss = [&] { return restore(autoencoder, net.validation).loss; }};
    fs::path file = checkpoint_stem(asked.out);
    file += "-" + net.part;
    const TrainingResult result = train(task, asked.pre_net_plan(net.size), described, file);
    const torch::NoGradGuard no_gradients;
    autoencoder->eval();
    return {{"steps", result.steps},
            {"validation_loss", result.validation_loss},
            {"accuracy", restore(autoencoder, net.validation).accuracy}};
}

// One for all nine channels, or one for each of them (A35).
std::vector<ContourAutoencoder> face_autoencoders(const Model1Options& options) {
    std::vector<ContourAutoencoder> faces;
    for (std::size_t c = 0; c < (options.nine_autoencoders ? kFaceChannels : 1); ++c)
        faces.emplace_back(options);
    return faces;
}

// The auto-encoders' part of the answer; leaves what they have learned in them.
Json train_pre_nets(const Model1Job& asked, ContourAutoencoder& speech,
                    std::vector<ContourAutoencoder>& faces) {
    const FaceCorpus& corpus = asked.corpus;
    Json answer;
    answer["speech"] = train_pre_net(asked, speech,
                                     {.part = "speech",
                                      .train = pitch_contours(corpus.train),
                                      .validation = pitch_contours(corpus.validation),
                                      .size = asked.training.speech});
    const std::size_t channels = kFaceChannels / faces.size();
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::size_t first = i * channels, past = first + channels;
        const std::string part = faces.size() > 1 ? format("face-{}", kFaceChannelNames[i]) : "face";
        answer[part] = train_pre_net(asked, faces[i],
                                     {.part = part,
                                      .train = face_contours(corpus.train, first, past),
                                      .validation = face_contours(corpus.validation, first, past),
                                      .size = asked.training.face});
    }
    return answer;
}

Model1Job read_job(const JsonValue& job) {
    const std::string preset = job.at("preset").choice(model1_presets());
    const Json choices = model1_choices(job_options(job));
    const Model1Options options = model1_options(preset, choices);
    const JobRun run = begin_job(job);
    FaceCorpus corpus = read_face_corpus(job, {.most_frames = options.most_frames});
    Checkpoint described = new_checkpoint(job, corpus, choices);
    return {.job = job,
            .run = run,
            .options = options,
            .training = model1_training(preset),
            .corpus = std::move(corpus),
            .described = std::move(described),
            .out = job.at("out").text()};
}

Json train_model1(const JsonValue& job) {
    const Model1Job asked = read_job(job);
    torch::manual_seed(asked.run.seed);
    ContourAutoencoder speech(asked.options);
    std::vector<ContourAutoencoder> faces = face_autoencoders(asked.options);
    Model1 model(asked.options);
    const Json pre_nets = train_pre_nets(asked, speech, faces);
    model->take_over(speech, faces);
    FaceModel whole = as_face_model(std::move(model), asked.described);
    const OptimiserKind rmsprop{.rule = OptimiserKind::Rule::rmsprop, .alpha = 0.9};  // section 5.5.4
    const LearningSize& size = asked.training.model;
    const TrainingTask task = face_task(whole, asked.corpus, size.batch);
    Json answer =
        training_answer(asked.out, train(task, asked.plan(size, rmsprop), asked.described, asked.out));
    answer["autoencoders"] = pre_nets;
    return answer;
}

FaceModel read_model1(const JsonValue& job) {
    return read_face_model(job, build_model1);
}

FaceModel asked_model1(const JsonValue& job) {
    if (job.find("checkpoint")) return read_model1(job);
    const std::string preset = job.at("preset").choice(model1_presets());
    return build_model1({.model = "model1", .preset = preset, .options = model1_choices(job_options(job))});
}

}  // namespace

LearnedModel model1_jobs() {
    return {.name = "model1",
            .train = train_model1,
            .predict = [](const JsonValue& job) { return predict_faces(read_model1(job), job); },
            .animate = [](const JsonValue& job) { return animate_faces(read_model1(job), job); },
            .describe = [](const JsonValue& job) { return describe_faces(job, asked_model1(job)); }};
}

}  // namespace chironomia
