// The jobs of Model 2.
#include <torch/utils.h>

#include "synth/learned/faces/face_jobs.h"
#include "synth/learned/faces/face_presets.h"
#include "synth/learned/faces/model2.h"

namespace chironomia {

namespace {

// A checkpoint that does not name an option is older than it, and without it.
FaceModel build_model2(Checkpoint described) {
    const Json kept = described.options;
    described.options = model2_choices("paper", JsonValue(kept, "the checkpoint's options"));
    const Model2Options options = model2_options(described.preset, described.options);
    Model2 model(options);
    return {.described = std::move(described),
            .levels = options.levels,
            .cut = {.by_frames = options.by_frames},
            .takes_unknown_voices = options.unplaced > 0,
            .module = model.get(),
            .learn = [model](const FaceBatch& batch) mutable { return model->forward(batch); },
            .predict = [model](const FaceBatch& batch) mutable { return model->generate(batch); }};
}

// Table 5.7. The small model has too few steps for a warm-up of 4000.
LearningRate rate_of(const Model2Options& options, const std::string& preset) {
    const bool small = preset == "small";
    return {.kind = LearningRate::Kind::noam,
            .warm_up = small ? 400U : 4000U,
            .factor = small ? 0.3 : 1,
            .width = static_cast<std::size_t>(options.width)};
}

Json train_model2(const JsonValue& job) {
    const std::string preset = job.at("preset").choice(model2_presets());
    const Json choices = model2_choices(preset, job_options(job));
    TrainingPlan plan{.optimiser = {.beta1 = 0.9, .beta2 = 0.98, .epsilon = 1e-9},  // table 5.7
                      .rate = rate_of(model2_options(preset, choices), preset),
                      .epochs = preset == "small" ? 40U : 300U,  // A43
                      .patience = 20};                           // alike
    const JobRun run = begin_job(job);
    const FaceCorpus corpus = read_face_corpus(job, {.by_frames = model2_options(preset, choices).by_frames});
    apply_job(job, run, plan);
    torch::manual_seed(plan.seed);
    FaceModel model = build_model2(new_checkpoint(job, corpus, choices));
    const TrainingTask task = face_task(model, corpus, 128);
    const std::string out = job.at("out").text();
    return training_answer(out, train(task, plan, model.described, out));
}

FaceModel read_model2(const JsonValue& job) {
    return read_face_model(job, build_model2);
}

FaceModel asked_model2(const JsonValue& job) {
    if (job.find("checkpoint")) return read_model2(job);
    const std::string preset = job.at("preset").choice(model2_presets());
    return build_model2(
        {.model = "model2", .preset = preset, .options = model2_choices(preset, job_options(job))});
}

}  // namespace

LearnedModel model2_jobs() {
    return {.name = "model2",
            .train = train_model2,
            .predict = [](const JsonValue& job) { return predict_faces(read_model2(job), job); },
            .animate = [](const JsonValue& job) { return animate_faces(read_model2(job), job); },
            .describe = [](const JsonValue& job) { return describe_faces(job, asked_model2(job)); }};
}

}  // namespace chironomia
