#include "synth/learned/styles/style_records.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "synth/features/contour.h"

namespace chironomia {

using torch::Tensor;

namespace {

constexpr std::array<const char*, kStyleJoints.size()> kJointNames{
    "RShoulder", "RElbow", "RWrist", "LShoulder", "LElbow",   "LWrist",
    "Nose",      "REye",   "LEye",   "LHandRoot", "RHandRoot"};
constexpr std::size_t kMelInputs = 1;

// Scales of the x of some of `points` points, then of their y.
template <std::size_t N>
std::vector<FeatureScale> scales_of_points(const std::vector<FeatureScale>& all,
                                           const std::array<std::size_t, N>& chosen) {
    std::vector<FeatureScale> scales;
    for (const std::size_t half : {std::size_t{0}, all.size() / 2})
        for (const std::size_t point : chosen) scales.push_back(all[half + point]);
    return scales;
}

Feature feature_of(std::string name, const FeatureScale& scale) {
    return {.name = std::move(name), .low = scale.zero, .high = scale.one};
}

FeatureScale scale_of(const Feature& feature) {
    return {.zero = feature.low, .one = feature.high};
}

// Points of an interval, (T, 2 count): the x of all, then their y.
struct SeenPoints {
    const std::vector<float>& places;
    const std::vector<float>& confidence;  // 0: lost
    std::size_t count = 0;
};

// (T, 2 N) of the chosen points, those that were lost on the line between the frames that have them. A point that no
// frame has stays where its mean is.
template <std::size_t N>
std::vector<float> chosen_points(const SeenPoints& points, const std::array<std::size_t, N>& chosen,
                                 const std::vector<FeatureScale>& scales) {
    const std::size_t width = 2 * points.count, frames = points.places.size() / width;
    std::vector<float> rows(frames * 2 * N);
    for (std::size_t column = 0; column < 2 * N; ++column) {
        const std::size_t from = (column / N) * points.count + chosen[column % N];
        std::vector<float> values(frames);
        std::vector<std::uint8_t> seen(frames);
        for (std::size_t t = 0; t < frames; ++t) {
            values[t] = points.places[t * width + from];
            seen[t] = points.confidence[t * width + from] > 0;
        }
        const auto bridged = bridge_gaps({.values = values, .width = 1, .success = seen});
        for (std::size_t t = 0; t < frames; ++t)
            rows[t * 2 * N + column] = bridged ? (*bridged)[t] : static_cast<float>(scales[column].zero);
    }
    return rows;
}

std::vector<float> mel_rows(const IntervalRecord& record, const StyleForm& form) {
    const bool is_wide = form.mel == StyleMel::bands_128;
    FeatureTrack mel{
        .rate = is_wide ? IntervalRecord::kMel512Rate : IntervalRecord::kMel400Rate,
        .columns = std::vector<std::string>(is_wide ? IntervalRecord::kMel512 : IntervalRecord::kMel400),
        .values = is_wide ? record.mel_512 : record.mel_400};
    return mel_at_15_fps(mel, record.frames(), form.resampling).values;
}

}  // namespace

StyleScales style_scales(const CorpusIndex& corpus, StyleMel mel, bool wants_face) {
    const CorpusStatistics statistics = read_statistics(corpus);
    StyleScales scales{
        .mel = statistics.of(mel == StyleMel::bands_128 ? "audio/log_mel_512" : "audio/log_mel_400")[0],
        .text = statistics.of("text/bert"),
        .pose = scales_of_points(statistics.of("pose/normalize"), kStyleJoints)};
    if (!wants_face) return scales;
    if (!statistics.scales.contains("face/normalize")) {
        throw Error(format(
            "{}: its intervals have no points of the face, which this model learns; make a corpus with "
            "faces, or train zs-mstm-1",
            corpus.folder.string()));
    }
    scales.face = scales_of_points(statistics.of("face/normalize"), kStyleFacePoints);
    return scales;
}

void describe_scales(const StyleScales& scales, Checkpoint& checkpoint) {
    checkpoint.inputs = {feature_of("log mel", scales.mel)};
    for (std::size_t i = 0; i < scales.text.size(); ++i)
        checkpoint.inputs.push_back(feature_of(format("text {}", i), scales.text[i]));
    checkpoint.outputs = point_features(scales);
}

StyleScales scales_of(const Checkpoint& checkpoint) {
    StyleScales scales = point_scales(checkpoint.outputs);
    scales.mel = scale_of(checkpoint.inputs.at(0));
    for (std::size_t i = kMelInputs; i < checkpoint.inputs.size(); ++i)
        scales.text.push_back(scale_of(checkpoint.inputs[i]));
    return scales;
}

std::vector<Feature> point_features(const StyleScales& scales) {
    std::vector<Feature> features;
    for (std::size_t i = 0; i < scales.pose.size(); ++i) {
        const char axis = i < kStyleJoints.size() ? 'x' : 'y';
        features.push_back(
            feature_of(format("{} {}", kJointNames[i % kStyleJoints.size()], axis), scales.pose[i]));
    }
    for (std::size_t i = 0; i < scales.face.size(); ++i) {
        const char axis = i < kStyleFacePoints.size() ? 'x' : 'y';
        features.push_back(feature_of(
            format("Face{} {}", kStyleFacePoints[i % kStyleFacePoints.size()], axis), scales.face[i]));
    }
    return features;
}

StyleScales point_scales(std::span<const Feature> features) {
    StyleScales scales;
    for (const Feature& feature : features) {
        std::vector<FeatureScale>& kind = feature.name.starts_with("Face") ? scales.face : scales.pose;
        kind.push_back(scale_of(feature));
    }
    return scales;
}

std::size_t StyleRecord::bytes() const {
    std::size_t sum = 0;
    for (const Tensor* tensor : {&mel, &text, &pose, &face, &acts})
        if (tensor->defined()) sum += tensor->nbytes();
    return sum;
}

Tensor normalised_rows(const std::vector<float>& values, std::span<const FeatureScale> scales) {
    std::vector<float> zeros, spreads;
    for (const FeatureScale& scale : scales) {
        zeros.push_back(static_cast<float>(scale.zero));
        spreads.push_back(static_cast<float>(scale.one - scale.zero));
    }
    const auto width = static_cast<std::int64_t>(scales.size());
    const Tensor rows = torch::tensor(values).view({-1, width});
    return (rows - torch::tensor(zeros)) / torch::tensor(spreads);
}

std::vector<float> restored_rows(const Tensor& normalised, std::span<const FeatureScale> scales) {
    const Tensor rows = normalised.to(torch::kFloat64).contiguous();
    const double* read = rows.data_ptr<double>();
    std::vector<float> restored;
    for (std::int64_t i = 0; i < rows.numel(); ++i)
        restored.push_back(
            static_cast<float>(scales[static_cast<std::size_t>(i) % scales.size()].restored(read[i])));
    return restored;
}

StyleRecord style_record(const IntervalRecord& record, const StyleForm& form) {
    const auto frames = static_cast<std::int64_t>(record.frames());
    const StyleScales& scales = form.scales;
    StyleRecord taken{.id = record.id, .speaker = record.speaker};
    if (form.mel != StyleMel::none) {
        taken.mel =
            normalised_rows(mel_rows(record, form), {&scales.mel, 1}).view({frames, -1}).to(torch::kHalf);
    }
    if (!scales.text.empty()) taken.text = normalised_rows(record.vectors, scales.text).to(torch::kHalf);
    const SeenPoints pose{record.pose_normalized, record.pose_confidence, IntervalRecord::kJoints};
    taken.pose = normalised_rows(chosen_points(pose, kStyleJoints, scales.pose), scales.pose);
    if (!scales.face.empty()) {
        if (record.face.empty() || record.dialog_acts.empty()) {
            throw Error(
                format("{}: the interval has no {}, which this model needs; leave it out, or train zs-mstm-1",
                       record.id, record.face.empty() ? "points of the face" : "dialog acts"));
        }
        const SeenPoints face{record.face_normalized, record.face_confidence, IntervalRecord::kFacePoints};
        taken.face = normalised_rows(chosen_points(face, kStyleFacePoints, scales.face), scales.face);
        taken.acts = torch::tensor(std::vector<std::uint8_t>(record.dialog_acts)).view({frames, kStyleActs});
    }
    return taken;
}

StyleRecords::StyleRecords(const CorpusIndex& corpus, std::vector<CorpusEntry> entries, StyleForm form,
                           std::size_t kept_bytes)
    : corpus_(&corpus), entries_(std::move(entries)), form_(std::move(form)), kept_bytes_(kept_bytes) {}

StyleRecords::StyleRecords(std::vector<StyleRecord> records)
    : kept_bytes_(std::numeric_limits<std::size_t>::max()) {
    for (StyleRecord& record : records) {
        const std::size_t entry = entries_.size();
        entries_.push_back({.id = record.id,
                            .speaker = record.speaker,
                            .seconds = static_cast<double>(record.frames()) / IntervalRecord::kFps});
        kept_.emplace_front(entry, std::move(record));
        places_[entry] = kept_.begin();
    }
}

std::int64_t StyleRecords::frames_of(std::size_t entry) const {
    return std::llround(entries_[entry].seconds * IntervalRecord::kFps);
}

const StyleRecord& StyleRecords::at(std::size_t entry) {
    if (const auto place = places_.find(entry); place != places_.end()) {
        kept_.splice(kept_.begin(), kept_, place->second);
        return kept_.front().second;
    }
    kept_.emplace_front(entry, style_record(read_interval(*corpus_, entries_[entry]), form_));
    places_[entry] = kept_.begin();
    bytes_ += kept_.front().second.bytes();
    while (bytes_ > kept_bytes_ && kept_.size() > 1) {
        bytes_ -= kept_.back().second.bytes();
        places_.erase(kept_.back().first);
        kept_.pop_back();
    }
    return kept_.front().second;
}

}  // namespace chironomia
