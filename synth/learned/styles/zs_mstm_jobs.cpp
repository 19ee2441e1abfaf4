// The jobs of both versions of ZS-MSTM.
#include <torch/utils.h>

#include <optional>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "synth/learned/styles/style_encodings.h"
#include "synth/learned/styles/style_jobs.h"
#include "synth/learned/styles/zs_mstm_presets.h"
#include "synth/learned/training/job_fields.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr std::size_t kValidatedAtATime = 32;

ZsMstmVersion version_of(const std::string& model) {
    return model == "zs-mstm-1" ? ZsMstmVersion::one : ZsMstmVersion::two;
}

// Preset and choices of a job, for training or for description.
struct ZsMstmOrder {
    ZsMstmVersion version;
    std::string preset;
    Json choices;

    ZsMstmSize size() const { return zs_mstm_size(version, preset, choices); }
    ZsMstmTraining training() const { return zs_mstm_training(version, preset, choices); }
};

ZsMstmOrder order_of(const JsonValue& job) {
    const ZsMstmVersion version = version_of(job.at("model").text());
    const std::string preset = job.at("preset").choice(zs_mstm_presets(version));
    Json choices = zs_mstm_choices(preset, job_options(job));
    if (job.find("ast")) choices["ast"] = "pretrained";
    if (preset == "small" && choices["ast"] == "pretrained") {
        throw Error(
            "--ast: the preset \"small\" has a transformer of its own that is too narrow for those weights; "
            "train --preset paper");
    }
    return {.version = version, .preset = preset, .choices = std::move(choices)};
}

// Of a checkpoint, which may be older than a choice. Throws Error with `file` for a preset or a choice that is unknown.
ZsMstmOrder order_of(const Checkpoint& checkpoint, const fs::path& file) {
    const ZsMstmVersion version = version_of(checkpoint.model);
    const Json preset = checkpoint.preset;
    JsonValue(preset, file.string()).called("preset").choice(zs_mstm_presets(version));
    return {.version = version,
            .preset = checkpoint.preset,
            .choices = zs_mstm_choices(checkpoint.preset,
                                       JsonValue(checkpoint.options, file.string()).called("options"))};
}

// The weights of the authors in both encoders, where the job brings them.
void load_weights(const JsonValue& job, const ZsMstmOrder& order, ZsMstm& model) {
    if (order.choices.at("ast") != "pretrained") return;
    const auto folder = job.find("ast");
    if (!folder)
        throw Error("--option ast=pretrained: no weights are given; give their folder with --ast DIR");
    const fs::path file = fs::path(folder->text()) / "model.safetensors";
    load_ast(model->content_ast, order.size().ast, file);
    if (!order.size().shares_ast) load_ast(model->style_ast, order.size().ast, file);
}

Tensor joined(const StyledMotion& motion) {
    return motion.face.defined() ? torch::cat({motion.pose, motion.face}, 2) : motion.pose;
}

StyleModel as_style_model(ZsMstm model, Checkpoint described) {
    const MelResampling resampling = zs_mstm_resampling(described.options);
    StyleForm form{.resampling = resampling, .scales = scales_of(described)};
    std::function<Tensor(const StyleSegments&)> guess;
    if (described.options.value("ablation", "none") != "fader") {
        guess = [model](const StyleSegments& source) mutable {
            return model->discriminator->forward(model->content_of(source));
        };
    }
    return {.described = std::move(described),
            .form = std::move(form),
            .frames = model->size().ast.frames,
            .module = model.get(),
            .style_of = [model](const StyleSegments& target) mutable { return model->style_of(target); },
            .content_of =
                [model](const StyleSegments& source) mutable { return model->content_of(source).mean(1); },
            .modalities_of =
                [model](const StyleSegments& target) mutable { return model->modalities_of(target); },
            .guess_of = std::move(guess),
            .generate =
                [model](const StyleSegments& content, const Tensor& style) mutable {
                    const Tensor encoded = model->content_of(content);
                    return joined(model->generate(encoded, style.expand({encoded.size(0), -1})));
                }};
}

StyleModel read_zs_mstm(const JsonValue& job) {
    const fs::path file = job.at("checkpoint").text();
    auto [checkpoint, weights, unused] = read_checkpoint(file, CheckpointParts::weights);
    const ZsMstmOrder order{
        .version = version_of(checkpoint.model), .preset = checkpoint.preset, .choices = checkpoint.options};
    const ZsMstmSize size = order.size();
    const std::size_t outputs = kStylePose + (size.has_face ? kStyleFace : 0);
    if (checkpoint.inputs.size() != 1 + kStyleText || checkpoint.outputs.size() != outputs) {
        throw Error(format("{}: has {} inputs and {} outputs, {} has {} and {}; train it anew", file.string(),
                           checkpoint.inputs.size(), checkpoint.outputs.size(), checkpoint.model,
                           1 + kStyleText, outputs));
    }
    ZsMstm model(size);
    set_weights(*model, weights, file);
    return as_style_model(std::move(model), std::move(checkpoint));
}

// What a training learns from, and the segments of both sides of a batch.
class StyleLessons {
  public:
    StyleLessons(const CorpusIndex& index, const StyleForm& form, const ZsMstmOrder& order)
        : training_(order.training()),
          frames_(order.size().ast.frames),
          train_(index, index.of(Split::train), form),
          validation_(index, validation_entries(index), form),
          windows_(whole_windows(train_, frames_, training_.hop, index.folder.string() + ", train")),
          validated_(whole_windows(validation_, frames_, frames_, index.folder.string() + ", validation")) {}

    std::size_t examples() const { return windows_.size(); }
    std::vector<Batch> draw(Random& random) {
        epoch_ = draw_epoch(train_, windows_, {.batch = training_.batch, .same_share = training_.same_share},
                            random);
        return epoch_.batches;
    }
    StyleSegments sources(const Batch& batch) {
        std::vector<StyleWindow> chosen;
        for (const std::size_t i : batch) chosen.push_back(windows_[i]);
        return gather(train_, chosen, frames_);
    }
    StyleSegments styles(const Batch& batch) {
        std::vector<StyleWindow> chosen;
        for (const std::size_t i : batch) chosen.push_back(windows_[epoch_.style_of[i]]);
        return gather(train_, chosen, frames_);
    }

    // The mean reconstruction loss of validation, each segment in the style of the speaker's next one.
    double validation_loss(ZsMstm& model) {
        double sum = 0;
        for (std::size_t first = 0; first < validated_.size(); first += kValidatedAtATime) {
            std::vector<StyleWindow> sources, styles;
            for (std::size_t i = first; i < std::min(first + kValidatedAtATime, validated_.size()); ++i) {
                sources.push_back(validated_[i]);
                styles.push_back(next_of_speaker(i));
            }
            const StyleSegments truth = gather(validation_, sources, frames_);
            const Tensor style = model->style_of(gather(validation_, styles, frames_));
            const StyledMotion motion = model->generate(model->content_of(truth), style);
            sum += static_cast<double>(sources.size()) * reconstruction_loss(motion, truth).item<double>();
        }
        return sum / static_cast<double>(validated_.size());
    }

  private:
    StyleWindow next_of_speaker(std::size_t window) const {
        const auto speaker = [&](std::size_t i) {
            return validation_.entries()[validated_[i].entry].speaker;
        };
        for (std::size_t step = 1; step < validated_.size(); ++step) {
            const std::size_t other = (window + step) % validated_.size();
            if (speaker(other) == speaker(window)) return validated_[other];
        }
        return validated_[window];
    }

    ZsMstmTraining training_;
    std::int64_t frames_;
    StyleRecords train_, validation_;
    std::vector<StyleWindow> windows_, validated_;
    StyleEpoch epoch_;
};

// Both losses of a batch need its content and its style, which do not change in between: section 6.4.4.
class FaderTraining {
  public:
    FaderTraining(ZsMstm model, StyleLessons& lessons, const ZsMstmTraining& training)
        : model_(std::move(model)), lessons_(lessons), training_(training) {}

    void begin(std::size_t step) {
        lambda_ = std::min(training_.lambda_most, training_.lambda_step * static_cast<double>(step));
    }

    Tensor adversary_loss(const Batch& batch) {
        encode(batch);
        return guess_loss(model_->discriminator, content_, style_);
    }

    Tensor loss(const Batch& batch) {
        if (!has_adversary()) encode(batch);
        const Tensor rebuilt = reconstruction_loss(model_->generate(content_, style_), source_);
        if (!has_adversary()) return rebuilt;
        const Tensor hidden = training_.adversary_moves_style ? style_ : style_.detach();
        return rebuilt + lambda_ * fader_loss(model_->discriminator, content_, hidden);
    }

    bool has_adversary() const { return training_.lambda_most > 0; }

  private:
    void encode(const Batch& batch) {
        source_ = lessons_.sources(batch);
        content_ = model_->content_of(source_);
        style_ = model_->style_of(lessons_.styles(batch));
    }

    ZsMstm model_;
    StyleLessons& lessons_;
    const ZsMstmTraining& training_;
    double lambda_ = 0;
    StyleSegments source_;
    Tensor content_, style_;
};

TrainingTask task_of(ZsMstm& model, StyleLessons& lessons, FaderTraining& fader) {
    TrainingTask task{.model = model.get(),
                      .unit = "segments",
                      .examples = lessons.examples(),
                      .batches = [&](Random& random) { return lessons.draw(random); },
                      .loss = [&](const Batch& batch) { return fader.loss(batch); },
                      .begin_step = [&](std::size_t step) { fader.begin(step); },
                      .validation_loss = [&] { return lessons.validation_loss(model); }};
    if (fader.has_adversary())
        task.adversary_loss = [&](const Batch& batch) { return fader.adversary_loss(batch); };
    return task;
}

Json train_zs_mstm(const JsonValue& job) {
    const ZsMstmOrder order = order_of(job);
    const JobRun run = begin_job(job);
    const CorpusIndex index = job_corpus(job, CorpusKind::intervals);
    const ZsMstmTraining training = order.training();
    Checkpoint described{.model = job.at("model").text(),
                         .preset = order.preset,
                         .options = order.choices,
                         .text_encoder = index.text_encoder};
    const StyleForm form{.resampling = zs_mstm_resampling(order.choices),
                         .scales = style_scales(index, StyleMel::bands_128, order.size().has_face)};
    describe_scales(form.scales, described);
    torch::manual_seed(run.seed);
    ZsMstm model(order.size());
    load_weights(job, order, model);
    StyleLessons lessons(index, form, order);
    FaderTraining fader(model, lessons, training);
    // Section 6.4.5.
    TrainingPlan plan{.optimiser = {.beta1 = 0.95, .beta2 = 0.999},
                      .rate = training.rate,
                      .epochs = training.epochs,
                      .steps = training.steps,
                      .clip = training.clip};
    apply_job(job, run, plan);
    const fs::path out = job.at("out").text();
    return training_answer(out, train(task_of(model, lessons, fader), plan, described, out));
}

Json describe_zs_mstm(const JsonValue& job) {
    const auto file = job.find("checkpoint");
    std::optional<Checkpoint> checkpoint;
    if (file) checkpoint = read_checkpoint(file->text(), CheckpointParts::description).description;
    const ZsMstmOrder order = checkpoint ? order_of(*checkpoint, file->text()) : order_of(job);
    ZsMstm model(order.size());
    Json answer =
        checkpoint
            ? checkpoint_answer(*checkpoint)
            : Json{{"model", job.at("model").text()}, {"preset", order.preset}, {"options", order.choices}};
    const ParameterCounts counts = count_parameters(*model, job);
    const std::int64_t adversary = sum_of(counts, "discriminator."), generator = sum_of(counts) - adversary;
    answer["parameters"] = generator;
    answer["parameters_without_ast"] =
        generator - sum_of(counts, "content_ast.") - sum_of(counts, "style_ast.");
    answer["discriminator_parameters"] = adversary;
    return answer;
}

}  // namespace

LearnedModel zs_mstm_model(const std::string& name) {
    return {.name = name,
            .train = train_zs_mstm,
            .predict = [](const JsonValue& job) { return predict_styles(read_zs_mstm(job), job); },
            .animate = [](const JsonValue& job) { return animate_style(read_zs_mstm(job), job); },
            .describe = describe_zs_mstm,
            .encode_styles = [](const JsonValue& job) { return encode_styles(read_zs_mstm(job), job); }};
}

}  // namespace chironomia
