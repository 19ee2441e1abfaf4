#include "synth/learned/dyads/dyad_frames.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "synth/features/speech_features.h"

namespace chironomia {
namespace {

double clamped_share(double value, const Feature& feature) {
    return std::clamp((value - feature.low) / (feature.high - feature.low), 0.0, 1.0);
}

DyadFrames::Person person_of(const DyadPerson& person, const DyadFeatures& features) {
    return {.participant = person.participant,
            .face = normalised(person.face, features.face),
            .speech = normalised(person.speech, features.speech)};
}

std::vector<Feature> scaled_features(const std::vector<std::string>& names,
                                     const std::vector<FeatureScale>& scales) {
    std::vector<Feature> features;
    for (std::size_t i = 0; i < names.size(); ++i)
        features.push_back({.name = names[i], .low = scales[i].zero, .high = scales[i].one});
    return features;
}

}  // namespace

std::vector<std::string> face_column_names() {
    return {"gaze_angle_x", "gaze_angle_y", "Rx", "Ry", "Rz", "AU1", "AU2", "AU4", "AU6", "AU12"};
}

DyadFeatures dyad_features(const CorpusStatistics& statistics) {
    return {.face = scaled_features(face_column_names(), statistics.of("face")),
            .speech = scaled_features(speech_columns(), statistics.of("speech"))};
}

torch::Tensor normalised(const std::vector<float>& rows, const std::vector<Feature>& features) {
    const auto columns = static_cast<int64_t>(features.size());
    torch::Tensor tensor = torch::empty({static_cast<int64_t>(rows.size()) / columns, columns});
    float* out = tensor.data_ptr<float>();
    for (std::size_t i = 0; i < rows.size(); ++i)
        out[i] = static_cast<float>(clamped_share(rows[i], features[i % features.size()]));
    return tensor;
}

std::vector<float> denormalised(const torch::Tensor& rows, const std::vector<Feature>& features) {
    const torch::Tensor dense = rows.contiguous();
    const float* in = dense.data_ptr<float>();
    std::vector<float> numbers(static_cast<std::size_t>(dense.numel()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const Feature& feature = features[i % features.size()];
        numbers[i] = static_cast<float>(feature.low + in[i] * (feature.high - feature.low));
    }
    return numbers;
}

std::vector<DyadFrames> read_dyads(const CorpusIndex& corpus, Split split, const DyadFeatures& features,
                                   std::size_t least) {
    std::vector<DyadFrames> dyads;
    for (const CorpusEntry& entry : corpus.of(split)) {
        const DyadRecord record = read_dyad(corpus, entry);
        if (record.frames() < least) {
            throw Error(format("{}: the dyad {} has {} frames, at least {} are needed; leave it out",
                               corpus.folder.string(), entry.id, record.frames(), least));
        }
        dyads.push_back(
            {.id = record.id,
             .people = {person_of(record.people[0], features), person_of(record.people[1], features)}});
    }
    if (dyads.empty()) {
        throw Error(
            format("{}: no dyad is in the split \"{}\"; make a corpus with more dyads, or split it "
                   "otherwise",
                   corpus.folder.string(), name_of(split)));
    }
    return dyads;
}

std::vector<DyadWindow> windows_over(const std::vector<DyadFrames>& dyads, std::size_t stride) {
    std::vector<DyadWindow> windows;
    for (std::size_t dyad = 0; dyad < dyads.size(); ++dyad)
        for (std::size_t begin = 0; begin + kWindowFrames < dyads[dyad].frames(); begin += stride)
            windows.push_back({.dyad = dyad, .begin = begin});
    return windows;
}

WindowBatch batch_of(const std::vector<DyadFrames>& dyads, std::span<const DyadWindow> windows) {
    std::vector<torch::Tensor> faces, speeches, next;
    for (const std::size_t person : {0, 1}) {
        for (const DyadWindow& window : windows) {
            const auto begin = static_cast<int64_t>(window.begin);
            const DyadFrames& dyad = dyads[window.dyad];
            const DyadFrames::Person &a = dyad.people[person], &u = dyad.people[1 - person];
            faces.push_back(a.face.narrow(0, begin, kWindowFrames));
            speeches.push_back(a.speech.narrow(0, begin, kWindowFrames));
            next.push_back(torch::cat({a.face[begin + kWindowFrames], u.face[begin + kWindowFrames]}));
        }
    }
    return {.people = {.face = torch::stack(faces), .speech = torch::stack(speeches)},
            .next = torch::stack(next)};
}

}  // namespace chironomia
