// The jobs of the classifier of styles.
#include <torch/utils.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/statistics.h"
#include "synth/learned/styles/style_classifier.h"
#include "synth/learned/styles/style_records.h"
#include "synth/learned/styles/style_windows.h"
#include "synth/learned/training/job_fields.h"
#include "synth/predictions.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr std::int64_t kJudgedFrames = 64;  // of a segment
constexpr std::size_t kJudgedAtATime = 64;  // segments
constexpr double kEnoughError = 0.04;       // section 7.5.1: C is right about 96 %
constexpr std::size_t kUsualSpeakers = 16;  // table 6.2: those of the condition SEEN

struct JudgeTraining {
    std::int64_t memory = 800;
    std::size_t batch = 256;
    std::size_t epochs = 15'000;
    std::int64_t hop = 64;  // frames between the segments that it learns from
};

// Table 7.4, or ours.
JudgeTraining judge_training(const std::string& preset) {
    if (preset == "small") return {.memory = 64, .batch = 32, .epochs = 60, .hop = 8};
    return {};
}

const std::vector<std::string>& judge_presets() {
    static const std::vector<std::string> presets{"paper", "small"};
    return presets;
}

// Preset and choices of a job or a checkpoint.
struct JudgeOrder {
    std::string preset;
    Json choices;                       // with "speakers", where they are known
    std::vector<std::string> speakers;  // in the order of the classes; of two: source, target

    bool has_face() const { return choices.at("face") == "with"; }
    StyleClassifierSize size() const {
        const auto count = static_cast<std::int64_t>(speakers.size());
        return {.inputs = kStylePose + (has_face() ? kStyleFace : 0),
                .memory = judge_training(preset).memory,
                .outputs = count == 2 ? 1 : count};
    }
};

std::string choice_or(const JsonValue& options, const char* key, const std::vector<std::string>& values) {
    const auto asked = options.find(key);
    return asked ? asked->choice(values) : values.front();
}

JudgeOrder judge_order(const JsonValue& job) {
    const JsonValue options = job_options(job);
    options.allow_only({"face", "source", "target", "speakers"});
    JudgeOrder order{.preset = job.at("preset").choice(judge_presets()),
                     .choices = {{"face", choice_or(options, "face", {"without", "with"})},
                                 {"of", choice_or(options, "speakers", {"train", "unseen"})}},
                     .speakers = {}};
    const auto source = options.find("source"), target = options.find("target");
    if (source.has_value() != target.has_value())
        options.refuse(format("have a {0} without a {1}; give both, or neither for all speakers",
                              source ? "source" : "target", source ? "target" : "source"));
    if (!source) return order;
    if (options.find("speakers")) options.refuse("name source and target as well as speakers; give either");
    order.choices["of"] = "pair";
    order.speakers = {source->text(), target->text()};
    if (order.speakers[0] == order.speakers[1])
        target->refuse(format("is \"{}\" like the source; give two speakers", order.speakers[0]));
    return order;
}

JudgeOrder judge_order(const Checkpoint& checkpoint, const std::string& file) {
    const JsonValue options(checkpoint.options, file);
    options.at("face").choice({"without", "with"});
    options.at("of").choice({"train", "unseen", "pair"});
    return {.preset = checkpoint.preset,
            .choices = checkpoint.options,
            .speakers = options.at("speakers").texts(2)};
}

std::vector<std::string> judged_speakers(const std::vector<CorpusEntry>& entries) {
    std::set<std::string> names;
    for (const CorpusEntry& entry : entries) names.insert(entry.speaker);
    return {names.begin(), names.end()};
}

std::size_t place_of(const std::vector<std::string>& speakers, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(speakers, name) - speakers.begin());
}

// The intervals of a speaker that the classifier learns from, stops by and is judged on itself. Those of a speaker of
// the split "unseen", from whom no model learns, are dealt out for it.
std::vector<CorpusEntry> judge_entries(const CorpusIndex& index, const std::string& speaker, Split part) {
    constexpr std::size_t kPortions = 5, kForValidation = 3, kForTest = 4;
    std::vector<CorpusEntry> own;
    std::size_t seen = 0;
    for (const CorpusEntry& entry : index.entries) {
        if (entry.speaker != speaker) continue;
        Split split = entry.split;
        if (split == Split::unseen) {
            const std::size_t portion = seen++ % kPortions;
            split = portion == kForValidation ? Split::validation
                    : portion == kForTest     ? Split::test
                                              : Split::train;
        }
        if (split == part) own.push_back(entry);
    }
    return own;
}

std::vector<CorpusEntry> judge_entries(const CorpusIndex& index, const std::vector<std::string>& speakers,
                                       Split part) {
    std::vector<CorpusEntry> all;
    for (const std::string& speaker : speakers) {
        const std::vector<CorpusEntry> own = judge_entries(index, speaker, part);
        if (own.empty()) {
            throw Error(
                format("{}: no intervals of \"{}\" for {}, the corpus has {}; name another speaker, or make "
                       "the corpus larger",
                       index.folder.string(), speaker, name_of(part), join(judged_speakers(index.entries))));
        }
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

// (B, T, inputs)
Tensor seen_motion(const StyleSegments& segments) {
    return segments.face.defined() ? torch::cat({segments.pose, segments.face}, 2) : segments.pose;
}

// (speakers) the mean over the segments of a clip.
Tensor shares_of_clip(StyleClassifier& model, StyleRecords& records,
                      const std::vector<StyleWindow>& windows) {
    Tensor sum;
    for (std::size_t first = 0; first < windows.size(); first += kJudgedAtATime) {
        const std::size_t count = std::min(kJudgedAtATime, windows.size() - first);
        const StyleSegments segments =
            gather(records, std::span(windows).subspan(first, count), kJudgedFrames);
        const Tensor shares = speaker_shares(model->forward(seen_motion(segments))).sum(0);
        sum = sum.defined() ? sum + shares : shares;
    }
    return sum / static_cast<double>(windows.size());
}

// What a training learns from.
class JudgeLessons {
  public:
    JudgeLessons(const CorpusIndex& index, const StyleForm& form, const JudgeOrder& order)
        : training_(judge_training(order.preset)),
          speakers_(order.speakers),
          train_(index, judge_entries(index, speakers_, Split::train), form),
          validation_(index, judge_entries(index, speakers_, Split::validation), form),
          windows_(whole_windows(train_, kJudgedFrames, training_.hop, index.folder.string() + ", train")),
          validated_(whole_windows(validation_, kJudgedFrames, kJudgedFrames,
                                   index.folder.string() + ", validation")),
          batches_(std::max<std::size_t>(1, windows_.size() / training_.batch)) {}

    std::size_t examples() const { return batches_ * training_.batch; }
    std::vector<Batch> draw(Random& random) const {
        return draw_equally(train_, windows_, {.batch = training_.batch, .batches = batches_}, random);
    }

    Tensor loss(StyleClassifier& model, const Batch& batch) {
        std::vector<StyleWindow> chosen;
        std::vector<std::int64_t> speakers;
        for (const std::size_t i : batch) {
            chosen.push_back(windows_[i]);
            speakers.push_back(static_cast<std::int64_t>(speaker_of(train_, windows_[i])));
        }
        const Tensor motion = seen_motion(gather(train_, chosen, kJudgedFrames));
        return classifier_loss(model->forward(motion), torch::tensor(speakers));
    }

    // The share of segments that are taken for another speaker's, each speaker counting alike.
    double validation_error(StyleClassifier& model) {
        std::vector<double> wrong(speakers_.size()), all(speakers_.size());
        for (const StyleWindow& window : validated_) {
            const std::size_t speaker = speaker_of(validation_, window);
            const auto found = shares_of_clip(model, validation_, {window}).argmax().item<std::int64_t>();
            wrong[speaker] += static_cast<std::size_t>(found) != speaker ? 1 : 0;
            all[speaker] += 1;
        }
        double sum = 0;
        for (std::size_t i = 0; i < all.size(); ++i) sum += wrong[i] / all[i];
        return sum / static_cast<double>(all.size());
    }

  private:
    std::size_t speaker_of(const StyleRecords& records, const StyleWindow& window) const {
        return place_of(speakers_, records.entries()[window.entry].speaker);
    }

    JudgeTraining training_;
    std::vector<std::string> speakers_;
    StyleRecords train_, validation_;
    std::vector<StyleWindow> windows_, validated_;
    std::size_t batches_;
};

StyleForm judge_form(StyleScales scales) {
    return {.mel = StyleMel::none, .scales = std::move(scales)};
}

Json train_judge(const JsonValue& job) {
    JudgeOrder order = judge_order(job);
    const JobRun run = begin_job(job);
    const CorpusIndex index = job_corpus(job, CorpusKind::intervals);
    if (order.speakers.empty())
        order.speakers =
            judged_speakers(index.of(order.choices["of"] == "unseen" ? Split::unseen : Split::train));
    if (order.speakers.size() < 2) {
        throw Error(
            format("{}: {} speakers of the split \"{}\", a classifier separates two or more; name a source "
                   "and a target",
                   index.folder.string(), order.speakers.size(), order.choices["of"].get<std::string>()));
    }
    order.choices["speakers"] = order.speakers;
    StyleScales scales = style_scales(index, StyleMel::bands_64, order.has_face());
    scales.text.clear();
    const StyleForm form = judge_form(std::move(scales));
    Checkpoint described{.model = "style-classifier",
                         .preset = order.preset,
                         .options = order.choices,
                         .inputs = point_features(form.scales)};
    for (const std::string& speaker : order.speakers) described.outputs.push_back({.name = speaker});
    torch::manual_seed(run.seed);
    StyleClassifier model(order.size());
    JudgeLessons lessons(index, form, order);
    const TrainingTask task{.model = model.get(),
                            .unit = "segments",
                            .examples = lessons.examples(),
                            .batches = [&](Random& random) { return lessons.draw(random); },
                            .loss = [&](const Batch& batch) { return lessons.loss(model, batch); },
                            .validation_loss = [&] { return lessons.validation_error(model); }};
    TrainingPlan plan{.epochs = judge_training(order.preset).epochs, .enough = kEnoughError};
    apply_job(job, run, plan);
    const fs::path out = job.at("out").text();
    return training_answer(out, train(task, plan, described, out));
}

struct Judge {
    Checkpoint described;
    JudgeOrder order;
    StyleForm form;
    StyleClassifier model{nullptr};
};

Judge read_judge(const JsonValue& job) {
    const fs::path file = job.at("checkpoint").text();
    auto [checkpoint, weights, unused] = read_checkpoint(file, CheckpointParts::weights);
    Judge judge{.order = judge_order(checkpoint, file.string())};
    const StyleClassifierSize size = judge.order.size();
    if (static_cast<std::int64_t>(checkpoint.inputs.size()) != size.inputs) {
        throw Error(format("{}: has {} inputs, the classifier has {}; train it anew", file.string(),
                           checkpoint.inputs.size(), size.inputs));
    }
    judge.form = judge_form(point_scales(checkpoint.inputs));
    judge.model = StyleClassifier(size);
    set_weights(*judge.model, weights, file);
    judge.described = std::move(checkpoint);
    judge.model->eval();
    return judge;
}

// For whose clip it takes one.
std::size_t speaker_found(Judge& judge, StyleRecord record) {
    const torch::NoGradGuard no_gradients;
    StyleRecords records({std::move(record)});
    const auto windows = style_windows(records, kJudgedFrames, kJudgedFrames);
    return static_cast<std::size_t>(
        shares_of_clip(judge.model, records, windows).argmax().item<std::int64_t>());
}

// How often clips of one speaker, or in that style, were taken for another's.
class Confusion {
  public:
    explicit Confusion(std::vector<std::string> speakers)
        : speakers_(std::move(speakers)),
          counts_(speakers_.size(), std::vector<std::size_t>(speakers_.size())) {}

    void add(std::size_t of, std::size_t taken_for) {
        ++counts_[of][taken_for];
        ++clips_;
        right_ += of == taken_for ? 1 : 0;
    }
    std::size_t clips() const { return clips_; }
    std::size_t right() const { return right_; }
    double percent() const { return 100.0 * static_cast<double>(right_) / static_cast<double>(clips_); }
    Json json() const { return {{"clips", clips_}, {"speakers", speakers_}, {"confusion", counts_}}; }

  private:
    std::vector<std::string> speakers_;
    std::vector<std::vector<std::size_t>> counts_;
    std::size_t clips_ = 0, right_ = 0;
};

// People's clips of a split. Of speakers of "unseen", from whose other intervals the classifier has learned, those that
// it was left without.
std::vector<CorpusEntry> clips_of(const Judge& judge, const CorpusIndex& index, Split split) {
    std::vector<CorpusEntry> clips;
    for (const std::string& speaker : judge.order.speakers) {
        const Split part = split == Split::unseen ? Split::test : split;
        for (const CorpusEntry& entry : judge_entries(index, speaker, part))
            if (entry.split == split) clips.push_back(entry);
    }
    if (!clips.empty()) return clips;
    throw Error(
        format("{}: no intervals of the split \"{}\" of {}, whom the classifier knows; judge another split",
               index.folder.string(), name_of(split), join(judge.order.speakers)));
}

Json judge_corpus(Judge& judge, const JsonValue& job) {
    const CorpusIndex index = job_corpus(job, CorpusKind::intervals);
    const std::vector<CorpusEntry> clips = clips_of(judge, index, job_split(job));
    StyleRecords records(index, clips, judge.form);
    Confusion confusion(judge.order.speakers);
    for (std::size_t i = 0; i < clips.size(); ++i)
        confusion.add(place_of(judge.order.speakers, clips[i].speaker), speaker_found(judge, records.at(i)));
    Json answer = confusion.json();
    answer["right"] = confusion.right();
    answer["accuracy"] = confusion.percent();
    return answer;
}

// Where in a frame of the predictions each number is that the classifier sees.
std::vector<std::size_t> columns_of(const Judge& judge, const Predictions& predictions,
                                    const fs::path& file) {
    std::vector<std::size_t> columns;
    for (const Feature& input : judge.described.inputs) {
        const auto found = std::ranges::find(predictions.features, input.name);
        if (found == predictions.features.end()) {
            throw Error(
                format("{}: has no \"{}\", which the classifier sees; train one with face=without, or "
                       "predict with a model of pose and face",
                       file.string(), input.name));
        }
        columns.push_back(static_cast<std::size_t>(found - predictions.features.begin()));
    }
    return columns;
}

// What was predicted, on the scale of the classifier.
StyleRecord predicted_record(const Judge& judge, const Predictions& predictions, const PredictedItem& item,
                             const std::vector<std::size_t>& columns) {
    const std::size_t width = predictions.features.size();
    const std::size_t frames = item.prediction.size() / width;
    Tensor motion =
        torch::empty({static_cast<std::int64_t>(frames), static_cast<std::int64_t>(columns.size())});
    float* written = motion.data_ptr<float>();
    for (std::size_t t = 0; t < frames; ++t) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const auto [low, high] = predictions.scale[columns[i]];
            const double place = low + item.prediction[t * width + columns[i]] * (high - low);
            const Feature& input = judge.described.inputs[i];
            *written++ = static_cast<float>((place - input.low) / (input.high - input.low));
        }
    }
    StyleRecord record{.id = item.id, .speaker = item.style, .pose = motion.narrow(1, 0, kStylePose)};
    if (judge.order.has_face()) record.face = motion.narrow(1, kStylePose, kStyleFace);
    return record;
}

// Whether it is one that the classifier judges: in the style of somebody else, of a classifier of two from its source
// to its target.
bool is_transfer(const Judge& judge, const PredictedItem& item) {
    if (judge.order.choices.at("of") != "pair") return item.style != item.speaker;
    return item.speaker == judge.order.speakers[0] && item.style == judge.order.speakers[1];
}

Predictions read_styled(const fs::path& file) {
    Predictions predictions = read_predictions(file);
    if (predictions.items.front().style.empty())
        throw Error(format("{}: its items have no styles; predict with a model of style", file.string()));
    if (predictions.fps != IntervalRecord::kFps) {
        throw Error(
            format("{}: has {} frames a second, the classifier has learned from {}; predict on intervals",
                   file.string(), predictions.fps, IntervalRecord::kFps));
    }
    return predictions;
}

Json judge_transfers(Judge& judge, const JsonValue& job) {
    const fs::path file = job.at("predictions").text();
    const Predictions predictions = read_styled(file);
    const std::vector<std::size_t> columns = columns_of(judge, predictions, file);
    const std::vector<std::string>& speakers = judge.order.speakers;
    Confusion confusion(speakers);
    std::size_t as_source = 0;
    for (const PredictedItem& item : predictions.items) {
        if (!is_transfer(judge, item)) continue;
        const std::size_t style = place_of(speakers, item.style);
        if (style == speakers.size()) {
            throw Error(
                format("{}: \"{}\" is in the style of \"{}\", the classifier knows {}; train one that knows "
                       "the speakers of this split",
                       file.string(), item.id, item.style, join(speakers)));
        }
        const std::size_t found = speaker_found(judge, predicted_record(judge, predictions, item, columns));
        confusion.add(style, found);
        as_source += speakers[found] == item.speaker ? 1 : 0;
    }
    if (confusion.clips() == 0) {
        const bool is_pair = judge.order.choices.at("of") == "pair";
        throw Error(format("{}: no clips of {} in the style of {}; predict with more pairs", file.string(),
                           is_pair ? speakers[0] : "one speaker", is_pair ? speakers[1] : "another"));
    }
    Json answer = confusion.json();
    answer["as_style"] = confusion.right();
    answer["as_source"] = as_source;
    answer["tsa"] = confusion.percent();
    return answer;
}

Json predict_judge(const JsonValue& job) {
    begin_job(job);
    job_options(job).allow_only({});
    Judge judge = read_judge(job);
    const Json answer = job.find("predictions") ? judge_transfers(judge, job) : judge_corpus(judge, job);
    if (const auto out = job.find("out")) write_json(out->text(), answer);
    return answer;
}

Json describe_judge(const JsonValue& job) {
    std::optional<Checkpoint> checkpoint;
    const auto file = job.find("checkpoint");
    if (file) checkpoint = read_checkpoint(file->text(), CheckpointParts::description).description;
    JudgeOrder order = checkpoint ? judge_order(*checkpoint, file->text()) : judge_order(job);
    if (order.speakers.empty()) order.speakers.resize(kUsualSpeakers);
    Json answer =
        checkpoint
            ? checkpoint_answer(*checkpoint)
            : Json{{"model", "style-classifier"}, {"preset", order.preset}, {"options", order.choices}};
    answer["parameters"] = sum_of(count_parameters(*StyleClassifier(order.size()), job));
    answer["speakers"] = order.speakers.size();
    return answer;
}

}  // namespace

LearnedModel style_classifier_model() {
    const auto refuse = [](const JsonValue&) -> Json {
        throw Error(
            "style-classifier: this model judges motion and makes none; animate with zs-mstm-1, zs-mstm-2 or "
            "mix-stage");
    };
    return {.name = "style-classifier",
            .train = train_judge,
            .predict = predict_judge,
            .animate = refuse,
            .describe = describe_judge};
}

}  // namespace chironomia
