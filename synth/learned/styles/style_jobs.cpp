#include "synth/learned/styles/style_jobs.h"

#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/progress.h"
#include "core/text.h"
#include "synth/corpus/record_files.h"
#include "synth/learned/training/job_fields.h"
#include "synth/predictions.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr std::size_t kUsualSegments = 8;  // A49
constexpr std::size_t kUsualPairs = 20;    // sources for each target: ours, as MODELS 17.9 asks
constexpr long long kMostSegments = 10'000;

std::size_t count_option(const JsonValue& job, const char* key, std::size_t usual, long long least) {
    const auto asked = job_options(job).find(key);
    return asked ? static_cast<std::size_t>(asked->integer(least, kMostSegments)) : usual;
}

// (T, 1) how much a segment counts in each of its frames, so that those of two that overlap add up to 1.
Tensor fade(std::int64_t frames, bool fades_in, bool fades_out) {
    Tensor weight = torch::ones({frames, 1});
    const Tensor ramp = (torch::arange(kCrossFade, torch::kFloat32) + 1).unsqueeze(1) / (kCrossFade + 1.0);
    if (fades_in) weight.slice(0, 0, kCrossFade).mul_(ramp);
    if (fades_out) weight.slice(0, frames - kCrossFade).mul_(ramp.flip(0));
    return weight;
}

// A model that knows no words has no encoder.
void check_encoder(const StyleModel& model, const std::string& where, const std::string& encoder) {
    if (model.described.text_encoder.empty() || encoder == model.described.text_encoder) return;
    throw Error(
        format("{}: words as vectors of \"{}\", the model has learned those of \"{}\"; take one that "
               "has learned such words",
               where, encoder, model.described.text_encoder));
}

StyleRecord read_style_record(const fs::path& file, const StyleModel& model) {
    if (const auto encoder = text_encoder_of_interval(file)) check_encoder(model, file.string(), *encoder);
    IntervalRecord interval = read_interval_file(file, "interval", "speaker");
    interval.id = file.string();  // in messages
    return style_record(interval, model.form);
}

// The records of one speaker, or of one file.
StyleRecords read_target(const JsonValue& style, const StyleModel& model, CorpusIndex& index) {
    if (const auto file = style.find("file")) {
        std::vector<StyleRecord> records;
        records.push_back(read_style_record(file->text(), model));
        return StyleRecords(std::move(records));
    }
    index = job_corpus(style, CorpusKind::intervals);
    check_encoder(model, index.folder.string(), index.text_encoder);
    const std::string speaker = style.at("speaker").text();
    std::vector<CorpusEntry> entries;
    std::vector<std::string> speakers;
    for (const CorpusEntry& entry : index.entries) {
        if (entry.speaker == speaker) entries.push_back(entry);
        if (speakers.empty() || speakers.back() != entry.speaker) speakers.push_back(entry.speaker);
    }
    if (entries.empty()) {
        std::ranges::sort(speakers);
        speakers.erase(std::unique(speakers.begin(), speakers.end()), speakers.end());
        throw Error(format("{}: nobody is called \"{}\" there; give one of {}", index.folder.string(),
                           speaker, join(speakers)));
    }
    return StyleRecords(index, std::move(entries), model.form);
}

std::string names_of_styles(const StyleModel& model) {
    std::vector<std::string> names;
    for (const auto& [name, style] : model.styles) names.push_back(name);
    return join(names);
}

Tensor known_style(const StyleModel& model, const std::string& where, const std::string& speaker) {
    const auto found = model.styles.find(speaker);
    if (found != model.styles.end()) return found->second;
    throw Error(
        format("{}: {} has not learned from \"{}\" and knows the styles of {} alone; ask for one of "
               "them, or take zs-mstm-1, which shows any style",
               where, model.described.model, speaker, names_of_styles(model)));
}

// Before anything is made, that the model can make all of it.
void check_styles(const StyleModel& model, const CorpusIndex& index, Split split,
                  const std::vector<CorpusEntry>& entries) {
    if (model.styles.empty()) return;
    if (split == Split::unseen) {
        throw Error(
            format("{}: the speakers of the split \"unseen\" are new to every model, and {} knows the "
                   "styles of {} alone; predict the split \"test\"",
                   index.folder.string(), model.described.model, names_of_styles(model)));
    }
    for (const CorpusEntry& entry : entries) known_style(model, index.folder.string(), entry.speaker);
}

// What is said, without a pose. Words say how long it is, or else the sound.
StyleRecord read_content(const Hdf5File& file, const std::string& where, const StyleModel& model) {
    const std::size_t bands =
        model.form.mel == StyleMel::bands_128 ? IntervalRecord::kMel512 : IntervalRecord::kMel400;
    const std::vector<double> rows = file.read_numbers("mel", {Hdf5File::kAny, bands});
    const double rate = file.read_numbers("mel_rate", {})[0];
    const bool has_words = file.has("text") || !model.form.scales.text.empty();
    std::vector<double> text;
    if (has_words) text = file.read_numbers("text", {Hdf5File::kAny, kWordVector});
    if (rows.empty() || rate <= 0 || (has_words && text.empty())) {
        throw Error(
            format("{}: {} rows of /mel at {} a second and {} of /text; give the spectrum of a sound, and "
                   "words frame by frame",
                   where, rows.size() / bands, rate, text.size() / kWordVector));
    }
    const double seconds = static_cast<double>(rows.size() / bands) / rate;
    const std::size_t frames = has_words
                                   ? text.size() / kWordVector
                                   : static_cast<std::size_t>(std::ceil(seconds * IntervalRecord::kFps));
    const FeatureTrack mel = mel_at_15_fps(
        {.rate = rate, .columns = std::vector<std::string>(bands), .values = {rows.begin(), rows.end()}},
        frames, model.form.resampling);
    const auto count = static_cast<std::int64_t>(frames);
    return {.mel = normalised_rows(mel.values, {&model.form.scales.mel, 1}).view({count, -1}),
            .text = model.form.scales.text.empty()
                        ? Tensor()
                        : normalised_rows({text.begin(), text.end()}, model.form.scales.text),
            .pose = torch::zeros({count, kStylePose})};
}

// What is said in an interval, or in the job's inputs.
StyleRecord asked_content(const StyleModel& model, const JsonValue& job) {
    if (const auto content = job.find("content")) return read_style_record(content->at("file").text(), model);
    const std::string inputs = job.at("inputs").text();
    const auto bytes = read_bytes(inputs);
    const Hdf5File file(bytes, inputs);
    if (!model.described.text_encoder.empty())
        check_encoder(model, inputs, file.read_texts("text_encoder").at(0));
    return read_content(file, inputs, model);
}

void write_styled(const fs::path& out, const Tensor& motion, const StyleScales& scales) {
    const auto frames = static_cast<std::size_t>(motion.size(0));
    Hdf5Writer file(out, out.string());
    file.write_attribute("fps", IntervalRecord::kFps);
    file.make_group("pose");
    file.write_floats("pose/normalize", {frames, scales.pose.size()},
                      restored_rows(motion.narrow(1, 0, kStylePose), scales.pose));
    if (!scales.face.empty()) {
        file.make_group("face");
        file.write_floats("face/normalize", {frames, scales.face.size()},
                          restored_rows(motion.narrow(1, kStylePose, kStyleFace), scales.face));
    }
    file.close();
}

std::vector<float> rows_of(const Tensor& tensor) {
    const Tensor whole = tensor.to(torch::kFloat32).contiguous();
    return {whole.data_ptr<float>(), whole.data_ptr<float>() + whole.numel()};
}

Tensor motion_of(const StyleRecord& record) {
    return record.face.defined() ? torch::cat({record.pose, record.face}, 1) : record.pose;
}

Predictions no_styles_yet(const StyleModel& model, const CorpusIndex& index, Split split) {
    Predictions predictions = empty_predictions(shown_name(model.described), index, split);
    predictions.fps = IntervalRecord::kFps;
    for (const Feature& feature : model.described.outputs) {
        predictions.features.push_back(feature.name);
        predictions.scale.push_back({feature.low, feature.high});
    }
    return predictions;
}

// An interval in a speaker's style.
struct Transfer {
    std::size_t source = 0;  // entry
    std::string target;
};

// Each interval in the style of its own speaker, and `pairs` of other speakers in that of each.
std::vector<Transfer> transfers_of(const std::vector<CorpusEntry>& entries, std::size_t pairs) {
    std::vector<Transfer> transfers;
    std::map<std::string, std::vector<std::size_t>> others;  // than the speaker
    for (const CorpusEntry& entry : entries) others.try_emplace(entry.speaker);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        transfers.push_back({i, entries[i].speaker});
        for (auto& [speaker, sources] : others)
            if (speaker != entries[i].speaker) sources.push_back(i);
    }
    for (const auto& [speaker, sources] : others) {
        const std::size_t count = std::min(pairs, sources.size());
        for (std::size_t k = 0; k < count; ++k)
            transfers.push_back({sources[k * sources.size() / count], speaker});
    }
    return transfers;
}

// The segments of a speaker, without those of one interval where there are others.
std::vector<StyleWindow> windows_of(const StyleRecords& records, const std::vector<StyleWindow>& all,
                                    const std::string& speaker, std::size_t but) {
    std::vector<StyleWindow> own, without;
    for (const StyleWindow& window : all) {
        if (records.entries()[window.entry].speaker != speaker) continue;
        own.push_back(window);
        if (window.entry != but) without.push_back(window);
    }
    return without.empty() ? own : without;
}

}  // namespace

Tensor animate_segments(const StyleModel& model, const StyleRecord& content, const Tensor& style) {
    const torch::NoGradGuard no_gradients;
    const std::int64_t length = model.frames, hop = length - kCrossFade;
    const std::int64_t frames = content.frames();
    const std::int64_t count = frames <= length ? 1 : (frames - kCrossFade + hop - 1) / hop;
    StyleRecord source = content;
    StyleRecords records({std::move(source)});
    Tensor sum = torch::zeros({count * hop + kCrossFade, 0});
    for (std::int64_t i = 0; i < count; ++i) {
        const StyleWindow window{0, i * hop};
        const Tensor segment = model.generate(gather(records, {&window, 1}, length), style)[0];
        if (sum.size(1) == 0) sum = torch::zeros({sum.size(0), segment.size(1)});
        sum.slice(0, i * hop, i * hop + length).add_(segment * fade(length, i > 0, i + 1 < count));
    }
    return sum.slice(0, 0, frames);
}

Tensor mean_style(const StyleModel& model, StyleRecords& records, const std::vector<StyleWindow>& windows,
                  std::size_t count) {
    const torch::NoGradGuard no_gradients;
    std::vector<StyleWindow> chosen;
    for (std::size_t k = 0; k < std::min(count, windows.size()); ++k)
        chosen.push_back(windows[k * windows.size() / std::min(count, windows.size())]);
    return model.style_of(gather(records, chosen, model.frames)).mean(0);
}

std::vector<CorpusEntry> validation_entries(const CorpusIndex& corpus) {
    std::vector<CorpusEntry> entries = corpus.of(Split::validation);
    if (!entries.empty()) return entries;
    throw Error(
        format("{}: no intervals of the split \"validation\", by which training knows what to keep; make the "
               "corpus larger, or give a recording that split",
               corpus.folder.string()));
}

namespace {

// (style) that the job's "style" asks for.
Tensor asked_style(const StyleModel& model, const JsonValue& job) {
    const JsonValue asked = job.at("style");
    const std::size_t segments = count_option(job, "segments", kUsualSegments, 1);
    if (!model.styles.empty()) {
        if (asked.find("file") || asked.find("corpus")) {
            asked.refuse(
                format("is that of an interval or a corpus, {} knows styles by the names of its speakers "
                       "alone; give {{\"speaker\": NAME}}, one of {}",
                       model.described.model, names_of_styles(model)));
        }
        return known_style(model, "style", asked.at("speaker").text());
    }
    CorpusIndex index;
    StyleRecords target = read_target(asked, model, index);
    return mean_style(model, target, style_windows(target, model.frames, model.frames), segments);
}

}  // namespace

Json predict_styles(const StyleModel& model, const JsonValue& job) {
    const JobRun run = begin_job(job);
    job_options(job).allow_only({"pairs", "segments"});
    const std::size_t segments = count_option(job, "segments", kUsualSegments, 1);
    const CorpusIndex index = job_corpus(job, CorpusKind::intervals);
    check_encoder(model, index.folder.string(), index.text_encoder);
    const Split split = job_split(job);
    StyleRecords records(index, index.of(split), model.form);
    if (records.entries().empty())
        throw Error(format("{}: no intervals of the split \"{}\"", index.folder.string(), name_of(split)));
    check_styles(model, index, split, records.entries());
    const std::vector<StyleWindow> windows = style_windows(records, model.frames, model.frames);
    const std::vector<Transfer> transfers =
        transfers_of(records.entries(), count_option(job, "pairs", kUsualPairs, 0));
    Predictions predictions = no_styles_yet(model, index, split);
    model.module->eval();
    Progress progress("predicting", "intervals", transfers.size(), run.quiet);
    for (const Transfer& transfer : transfers) {
        const Tensor style =
            model.styles.empty()
                ? mean_style(model, records, windows_of(records, windows, transfer.target, transfer.source),
                             segments)
                : model.styles.at(transfer.target);
        const StyleRecord source = records.at(transfer.source);
        predictions.items.push_back({.id = format("{}>{}", source.id, transfer.target),
                                     .speaker = source.speaker,
                                     .style = transfer.target,
                                     .truth = rows_of(motion_of(source)),
                                     .prediction = rows_of(animate_segments(model, source, style))});
        progress.step(1);
    }
    std::ranges::sort(predictions.items, {}, &PredictedItem::id);
    write_predictions(job.at("out").text(), predictions);
    return {{"predictions", job.at("out").text()}, {"items", predictions.items.size()}};
}

Json animate_style(const StyleModel& model, const JsonValue& job) {
    begin_job(job);
    job_options(job).allow_only({"segments"});
    const StyleRecord content = asked_content(model, job);
    model.module->eval();
    const Tensor motion = animate_segments(model, content, asked_style(model, job));
    write_styled(job.at("out").text(), motion, model.form.scales);
    return {{"frames", motion.size(0)}, {"fps", IntervalRecord::kFps}};
}

}  // namespace chironomia
