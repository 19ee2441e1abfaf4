// The jobs of Mix-StAGE.
#include <torch/utils.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "synth/learned/styles/mix_stage_presets.h"
#include "synth/learned/styles/style_jobs.h"
#include "synth/learned/training/job_fields.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr std::int64_t kPaperSpeakers = 16;
constexpr std::int64_t kStageValidated = 32;   // segments at a time
constexpr std::size_t kSortedSegments = 1000;  // for finding clusters: ours, 64,000 frames
// Poses of this room have a deviation of 0.5 (A22), those of the authors one of 1.
constexpr double kStagePoses = 2;

// Preset and choices of a job; names, where there are some already.
struct MixStageOrder {
    std::string preset;
    Json choices;
    std::vector<std::string> speakers;

    MixStageSize size() const {
        return mix_stage_size(preset,
                              speakers.empty() ? kPaperSpeakers : static_cast<std::int64_t>(speakers.size()));
    }
};

MixStageOrder mix_stage_order(const JsonValue& job) {
    const std::string preset = job.at("preset").choice(mix_stage_presets());
    return {.preset = preset, .choices = mix_stage_choices(preset, job_options(job)), .speakers = {}};
}

MixStageOrder mix_stage_order(const Checkpoint& checkpoint, const std::string& file) {
    const std::vector<std::string> speakers = JsonValue(checkpoint.options, file).at("speakers").texts(1);
    Json choices = checkpoint.options;
    choices.erase("speakers");
    return {.preset = checkpoint.preset,
            .choices = mix_stage_choices(checkpoint.preset, JsonValue(choices, file)),
            .speakers = speakers};
}

std::vector<std::string> speakers_of(const std::vector<CorpusEntry>& entries) {
    std::set<std::string> names;
    for (const CorpusEntry& entry : entries) names.insert(entry.speaker);
    return {names.begin(), names.end()};
}

// What a training learns from.
class StageLessons {
  public:
    StageLessons(const CorpusIndex& index, const StyleForm& form, const MixStageTraining& training,
                 std::vector<std::string> speakers)
        : training_(training),
          speakers_(std::move(speakers)),
          train_(index, index.of(Split::train), form),
          validation_(index, validation_entries(index), form),
          windows_(
              whole_windows(train_, MixStageSize::kFrames, training.hop, index.folder.string() + ", train")),
          validated_(whole_windows(validation_, MixStageSize::kFrames, MixStageSize::kFrames,
                                   index.folder.string() + ", validation")) {}

    std::size_t examples() const { return training_.epoch.batch * training_.epoch.batches; }
    std::vector<Batch> draw(Random& random) const {
        return draw_equally(train_, windows_, training_.epoch, random);
    }

    // By segments from all over the training records.
    void find_clusters(MixStage& model, std::uint64_t seed) {
        const std::size_t count = std::min(kSortedSegments, windows_.size());
        std::vector<Tensor> poses;
        for (std::size_t k = 0; k < count; ++k) {
            const StyleWindow window = windows_[k * windows_.size() / count];
            poses.push_back(gather(train_, {&window, 1}, MixStageSize::kFrames).pose);
        }
        model->clusters->find(kStagePoses * torch::cat(poses), seed);
    }

    StageBatch batch(MixStage& model, const Batch& examples) {
        std::vector<StyleWindow> chosen;
        for (const std::size_t i : examples) chosen.push_back(windows_[i]);
        StageBatch batch = segments(train_, chosen);
        batch.clusters = model->clusters->labels(batch.pose);
        return batch;
    }

    // The mean error of poses made of the sound, each in the style of its own speaker.
    double validation_loss(MixStage& model) {
        double sum = 0;
        for (std::size_t first = 0; first < validated_.size(); first += kStageValidated) {
            const std::size_t count = std::min<std::size_t>(kStageValidated, validated_.size() - first);
            const StageBatch truth = segments(validation_, std::span(validated_).subspan(first, count));
            const Tensor style = model->style_of(truth.speakers);
            const Tensor pose = model->generate(model->content_of_audio(truth.mel), style).pose;
            sum += static_cast<double>(count) * torch::l1_loss(pose, truth.pose).item<double>();
        }
        return sum / static_cast<double>(validated_.size());
    }

  private:
    StageBatch segments(StyleRecords& records, std::span<const StyleWindow> windows) const {
        const StyleSegments found = gather(records, windows, MixStageSize::kFrames);
        std::vector<std::int64_t> speakers;
        for (const StyleWindow& window : windows) {
            const auto at = std::ranges::find(speakers_, records.entries()[window.entry].speaker);
            speakers.push_back(at - speakers_.begin());
        }
        return {.mel = found.mel, .pose = kStagePoses * found.pose, .speakers = torch::tensor(speakers)};
    }

    MixStageTraining training_;
    std::vector<std::string> speakers_;
    StyleRecords train_, validation_;
    std::vector<StyleWindow> windows_, validated_;
};

// In each step either the discriminator learns or the generator.
class StageTraining {
  public:
    StageTraining(MixStage model, StageLessons& lessons, const MixStageTraining& training)
        : model_(std::move(model)), lessons_(lessons), training_(training) {}

    void begin(std::size_t step) { step_ = step; }

    Tensor loss(const Batch& examples) {
        const Tensor chance = torch::rand({2}, torch::kFloat64);
        const StageBatch batch = lessons_.batch(model_, examples);
        const StageContent content =
            chance[1].item<double>() < training_.pose_share(step_) ? StageContent::pose : StageContent::audio;
        const double weight = training_.adversary_weight(step_);
        return chance[0].item<double>() < 0.5 ? discriminator_loss(model_, batch, content, weight)
                                              : generator_losses(model_, batch, content).total(weight);
    }

  private:
    MixStage model_;
    StageLessons& lessons_;
    const MixStageTraining& training_;
    std::size_t step_ = 0;
};

void check_speakers(const CorpusIndex& index, const std::vector<std::string>& speakers) {
    for (const std::string& speaker : speakers_of(index.of(Split::validation))) {
        if (std::ranges::find(speakers, speaker) == speakers.end()) {
            throw Error(
                format("{}: \"{}\" is in the split \"validation\" but not in \"train\"; a style is learned "
                       "from its speaker's own intervals",
                       index.folder.string(), speaker));
        }
    }
}

Json train_mix_stage(const JsonValue& job) {
    MixStageOrder order = mix_stage_order(job);
    const JobRun run = begin_job(job);
    const CorpusIndex index = job_corpus(job, CorpusKind::intervals);
    order.speakers = speakers_of(index.of(Split::train));
    check_speakers(index, order.speakers);
    const MixStageTraining training = mix_stage_training(order.preset, order.choices);
    StyleForm form{.mel = StyleMel::bands_64,
                   .resampling = mix_stage_resampling(order.choices),
                   .scales = style_scales(index, StyleMel::bands_64, false)};
    form.scales.text.clear();
    Checkpoint described{.model = "mix-stage", .preset = order.preset, .options = order.choices};
    described.options["speakers"] = order.speakers;
    describe_scales(form.scales, described);
    torch::manual_seed(run.seed);
    MixStage model(order.size());
    StageLessons lessons(index, form, training, order.speakers);
    lessons.find_clusters(model, run.seed);
    StageTraining stage(model, lessons, training);
    const TrainingTask task{.model = model.get(),
                            .unit = "segments",
                            .examples = lessons.examples(),
                            .batches = [&](Random& random) { return lessons.draw(random); },
                            .loss = [&](const Batch& batch) { return stage.loss(batch); },
                            .begin_step = [&](std::size_t step) { stage.begin(step); },
                            .validation_loss = [&] { return lessons.validation_loss(model); }};
    TrainingPlan plan{.rate = training.rate, .epochs = training.epochs};
    apply_job(job, run, plan);
    const fs::path out = job.at("out").text();
    return training_answer(out, train(task, plan, described, out));
}

StyleModel read_mix_stage(const JsonValue& job) {
    const fs::path file = job.at("checkpoint").text();
    auto [checkpoint, weights, unused] = read_checkpoint(file, CheckpointParts::weights);
    const MixStageOrder order = mix_stage_order(checkpoint, file.string());
    if (checkpoint.inputs.size() != 1 || checkpoint.outputs.size() != kStylePose) {
        throw Error(format("{}: has {} inputs and {} outputs, mix-stage has 1 and {}; train it anew",
                           file.string(), checkpoint.inputs.size(), checkpoint.outputs.size(), kStylePose));
    }
    MixStage model(order.size());
    set_weights(*model, weights, file);
    weights.clear();
    const torch::NoGradGuard no_gradients;
    const Tensor all = model->style_of(torch::arange(model->size().speakers));
    std::map<std::string, Tensor> styles;
    for (std::size_t i = 0; i < order.speakers.size(); ++i)
        styles[order.speakers[i]] = all[static_cast<std::int64_t>(i)];
    StyleForm form{.mel = StyleMel::bands_64,
                   .resampling = mix_stage_resampling(order.choices),
                   .scales = scales_of(checkpoint)};
    return {.described = std::move(checkpoint),
            .form = std::move(form),
            .frames = MixStageSize::kFrames,
            .module = model.get(),
            .style_of = {},
            .styles = std::move(styles),
            .generate = [model](const StyleSegments& content, const Tensor& style) mutable {
                const Tensor encoded = model->content_of_audio(content.mel);
                return model->generate(encoded, style.expand({encoded.size(0), -1})).pose / kStagePoses;
            }};
}

Json describe_mix_stage(const JsonValue& job) {
    std::optional<Checkpoint> checkpoint;
    const auto file = job.find("checkpoint");
    if (file) checkpoint = read_checkpoint(file->text(), CheckpointParts::description).description;
    const MixStageOrder order =
        checkpoint ? mix_stage_order(*checkpoint, file->text()) : mix_stage_order(job);
    const MixStage model(order.size());
    Json answer = checkpoint
                      ? checkpoint_answer(*checkpoint)
                      : Json{{"model", "mix-stage"}, {"preset", order.preset}, {"options", order.choices}};
    const ParameterCounts counts = count_parameters(*model, job);
    const std::int64_t discriminator = sum_of(counts, "discriminator.");
    answer["parameters"] = sum_of(counts) - discriminator;
    answer["discriminator_parameters"] = discriminator;
    answer["styles"] = model->size().speakers;
    return answer;
}

}  // namespace

LearnedModel mix_stage_model() {
    return {.name = "mix-stage",
            .train = train_mix_stage,
            .predict = [](const JsonValue& job) { return predict_styles(read_mix_stage(job), job); },
            .animate = [](const JsonValue& job) { return animate_style(read_mix_stage(job), job); },
            .describe = describe_mix_stage};
}

}  // namespace chironomia
