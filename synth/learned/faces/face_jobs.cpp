#include "synth/learned/faces/face_jobs.h"

#include <torch/utils.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/learned/faces/face_animation.h"
#include "synth/learned/faces/face_motion.h"
#include "synth/predictions.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr std::size_t kPredictedWords = 256;  // at a time

std::vector<FaceUnit> units_of(const CorpusIndex& index, Split split, const UnitCut& cut) {
    std::vector<FaceUnit> units;
    for (const CorpusEntry& entry : index.of(split)) {
        for (FaceUnit& unit : face_units(read_ipu(index, entry), cut)) units.push_back(std::move(unit));
    }
    return units;
}

std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
}

std::vector<Batch> batches_in_order(const std::vector<FaceUnit>& units, const UnitCut& cut) {
    return batches_of_words(units, in_order(units.size()), cut.elements_in(kPredictedWords));
}

FaceBatch gather(const std::vector<FaceUnit>& units, const Batch& batch, const FaceLevels& levels) {
    std::vector<const FaceUnit*> chosen;
    for (const std::size_t i : batch) chosen.push_back(&units[i]);
    return make_face_batch(chosen, levels);
}

// The mean over all frames.
double mean_loss(FaceModel& model, const std::vector<FaceUnit>& units) {
    double sum = 0, frames = 0;
    for (const Batch& batch : batches_in_order(units, model.cut)) {
        const FaceBatch gathered = gather(units, batch, model.levels);
        const auto count = static_cast<double>(gathered.contours.size(1));
        if (count == 0) continue;
        sum += count * face_loss(model.learn(gathered), gathered.contours).item<double>();
        frames += count;
    }
    return sum / std::max(frames, 1.0);
}

FaceDecoding decoding_of(const JsonValue& job, FaceDecoding usual) {
    const auto asked = job_options(job).find("A39");
    if (!asked) return usual;
    return asked->choice({"argmax", "expectation"}) == "argmax" ? FaceDecoding::argmax
                                                                : FaceDecoding::expectation;
}

// Takes away the pitch's mean and deviation of the units.
void leave_voices_unplaced(FaceBatch& batch) {
    batch.f0_relative.narrow(1, 1, kRelativePitch - 1).zero_();
}

struct Saying {
    FaceDecoding decoding;
    bool knows_voices;  // those of the training's speakers
};

// What the model says of each unit's frames.
std::vector<SaidFace> say(FaceModel& model, const std::vector<FaceUnit>& units, const Saying& saying,
                          Progress& progress) {
    const torch::NoGradGuard no_gradients;
    model.module->eval();
    std::vector<SaidFace> said;
    for (const Batch& batch : batches_in_order(units, model.cut)) {
        FaceBatch gathered = gather(units, batch, model.levels);
        if (model.takes_unknown_voices && !saying.knows_voices) leave_voices_unplaced(gathered);
        const Tensor face = decoded_face(model.predict(gathered), saying.decoding).contiguous();
        const float* read = face.data_ptr<float>();
        for (const std::size_t i : batch) {
            std::size_t frames = 0;
            for (const FaceWord& word : units[i].words) frames += word.length;
            said.push_back({&units[i], {read, read + frames * kFaceChannels}});
            read += frames * kFaceChannels;
        }
        progress.step(static_cast<std::size_t>(gathered.words()));
    }
    return said;
}

std::size_t words_in(const std::vector<FaceUnit>& units) {
    std::size_t words = 0;
    for (const FaceUnit& unit : units) words += unit.words.size();
    return words;
}

// The frames that lie in words.
PredictedItem item_of(const IpuRecord& record, std::span<const SaidFace> said) {
    const FaceMotion motion = lay_out(said, record.frames());
    const std::vector<float> truth = normalised_face(record);
    PredictedItem item{.id = record.id, .speaker = record.speaker};
    for (std::size_t t = 0; t < record.frames(); ++t) {
        if (motion.said[t] == 0) continue;
        const auto first = static_cast<std::ptrdiff_t>(t * kFaceChannels);
        const auto past = first + static_cast<std::ptrdiff_t>(kFaceChannels);
        item.truth.insert(item.truth.end(), truth.begin() + first, truth.begin() + past);
        item.prediction.insert(item.prediction.end(), motion.values.begin() + first,
                               motion.values.begin() + past);
    }
    return item;
}

Predictions no_faces_yet(const FaceModel& model, const CorpusIndex& index, Split split) {
    Predictions predictions = empty_predictions(shown_name(model.described), index, split);
    predictions.fps = IpuRecord().fps;
    predictions.features = {kFaceChannelNames.begin(), kFaceChannelNames.end()};
    const auto scale = face_scale();
    predictions.scale.assign(scale.begin(), scale.end());
    return predictions;
}

void check_encoder(const FaceModel& model, const std::string& where, const std::string& encoder) {
    if (encoder == model.described.text_encoder) return;
    throw Error(format("{}: words as vectors of \"{}\", the model has learned those of \"{}\"; use the same",
                       where, encoder, model.described.text_encoder));
}

}  // namespace

FaceCorpus read_face_corpus(const JsonValue& job, const UnitCut& cut) {
    FaceCorpus corpus{.index = job_corpus(job, CorpusKind::talks)};
    corpus.train = units_of(corpus.index, Split::train, cut);
    corpus.validation = units_of(corpus.index, Split::validation, cut);
    if (corpus.validation.empty()) {
        throw Error(
            format("{}: no talks of the split \"validation\", by which training knows when to stop; make "
                   "the corpus larger, or give a recording that split",
                   corpus.index.folder.string()));
    }
    return corpus;
}

FaceModel read_face_model(const JsonValue& job, const std::function<FaceModel(Checkpoint)>& build) {
    const fs::path file = job.at("checkpoint").text();
    auto [checkpoint, weights, unused] = read_checkpoint(file, CheckpointParts::weights);
    check_fits(file, checkpoint, {.outputs = {kFaceChannelNames.begin(), kFaceChannelNames.end()}});
    FaceModel model = build(std::move(checkpoint));
    set_weights(*model.module, weights, file);
    return model;
}

Checkpoint new_checkpoint(const JsonValue& job, const FaceCorpus& corpus, const Json& choices) {
    Checkpoint described{.model = job.at("model").text(),
                         .preset = job.at("preset").text(),
                         .options = choices,
                         .text_encoder = corpus.index.text_encoder,
                         .inputs = {{.name = "f0", .low = 50, .high = 550}}};
    const auto scale = face_scale();
    for (std::size_t c = 0; c < kFaceChannels; ++c) {
        described.outputs.push_back(
            {.name = std::string(kFaceChannelNames[c]), .low = scale[c][0], .high = scale[c][1]});
    }
    return described;
}

TrainingTask face_task(FaceModel& model, const FaceCorpus& corpus, std::size_t batch) {
    const bool by_units = model.described.options.at("A38") == "units";
    return {.model = model.module,
            .unit = "units",
            .examples = corpus.train.size(),
            .batches =
                [&corpus, batch, by_units, cut = model.cut](Random& random) {
                    if (by_units) return shuffled_batches(corpus.train.size(), batch, random);
                    std::vector<std::size_t> order = in_order(corpus.train.size());
                    random.shuffle(order);
                    return batches_of_words(corpus.train, order, cut.elements_in(batch));
                },
            .loss =
                [&](const Batch& chosen) {
                    const FaceBatch gathered = gather(corpus.train, chosen, model.levels);
                    return face_loss(model.learn(gathered), gathered.contours);
                },
            .validation_loss = [&] { return mean_loss(model, corpus.validation); }};
}

Json predict_faces(FaceModel model, const JsonValue& job) {
    const JobRun run = begin_job(job);
    job_options(job).allow_only({"A39"});
    const CorpusIndex index = job_corpus(job, CorpusKind::talks);
    check_encoder(model, index.folder.string(), index.text_encoder);
    const Split split = job_split(job);
    const std::vector<FaceUnit> units = units_of(index, split, model.cut);
    if (units.empty()) {
        throw Error(format("{}: no talks of the split \"{}\"", index.folder.string(), name_of(split)));
    }
    Progress progress("predicting", "words", words_in(units), run.quiet);
    const std::vector<SaidFace> said =
        say(model, units, {decoding_of(job, FaceDecoding::argmax), split != Split::unseen}, progress);
    Predictions predictions = no_faces_yet(model, index, split);
    std::size_t begin = 0;
    for (const CorpusEntry& entry : index.of(split)) {
        std::size_t end = begin;
        while (end < said.size() && said[end].unit->id == entry.id) ++end;
        predictions.items.push_back(
            item_of(read_ipu(index, entry), std::span(said).subspan(begin, end - begin)));
        begin = end;
    }
    write_predictions(job.at("out").text(), predictions);
    return {{"predictions", job.at("out").text()}, {"items", predictions.items.size()}};
}

Json animate_faces(FaceModel model, const JsonValue& job) {
    const JobRun run = begin_job(job);
    job_options(job).allow_only({"A39", "smooth"});
    const SpokenFile file = read_spoken(job.at("inputs").text());
    check_encoder(model, job.at("inputs").text(), file.text_encoder);
    const std::vector<FaceUnit> units = units_of_speech(file.speech, model.cut);
    Progress progress("animating", "words", words_in(units), run.quiet);
    const std::vector<SaidFace> said =
        say(model, units, {decoding_of(job, FaceDecoding::expectation), false}, progress);
    const auto smooth = job_options(job).find("smooth");
    const FaceMotion motion = lay_out(said, file.speech.frames);
    write_animation(job.at("out").text(), {.motion = motion,
                                           .fps = file.speech.fps,
                                           .smooth = smooth ? smooth->number(0, 1) : kUsualSmoothing});
    return {{"frames", motion.frames()}, {"fps", file.speech.fps}};
}

Json describe_faces(const JsonValue& job, const FaceModel& model) {
    Json answer{{"model", model.described.model},
                {"preset", model.described.preset},
                {"options", model.described.options}};
    if (job.find("checkpoint")) answer = checkpoint_answer(model.described);
    answer["parameters"] = sum_of(count_parameters(*model.module, job));
    return answer;
}

}  // namespace chironomia
