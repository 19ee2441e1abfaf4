#include "synth/learned/faces/face_units.h"

#include <algorithm>
#include <cmath>

#include "synth/features/contour.h"

namespace chironomia {

namespace {

Stretch stretch_of(const CorpusWord& word, double rate, std::size_t total) {
    const SampleRange range = samples_in(word.start, word.end, rate);
    const std::size_t first = std::min(range.first, total);
    return {first, std::min(range.last, total) - first};
}

std::vector<float> thinned(std::span<const float> rows, std::size_t width, std::size_t most) {
    if (rows.size() / width <= most) return {rows.begin(), rows.end()};
    return resampled_rows(rows, width, most);
}

FaceWord spoken_word(const SpokenWords& speech, const CorpusWord& word) {
    FaceWord made{.samples = stretch_of(word, IpuRecord::kSpeechRate, speech.f0.size()),
                  .frames = stretch_of(word, speech.fps, speech.frames)};
    made.f0 = thinned(std::span(speech.f0).subspan(made.samples.first, made.samples.count), 1, kMostSamples);
    made.length = std::min(made.frames.count, speech.cut.most_frames);
    return made;
}

// What a unit is made of, and which word each is or lies in.
struct Elements {
    std::vector<CorpusWord> stretches;
    std::vector<std::size_t> words;
};

Elements elements_of(const SpokenWords& speech, std::size_t begin, std::size_t end) {
    Elements elements;
    const auto add = [&](const CorpusWord& stretch, std::size_t word) {
        elements.stretches.push_back(stretch);
        elements.words.push_back(word);
    };
    for (std::size_t i = begin; i < end; ++i) {
        const CorpusWord& word = speech.words[i];
        if (!speech.cut.by_frames) {
            add(word, i);
            continue;
        }
        const Stretch frames = stretch_of(word, speech.fps, speech.frames);
        for (std::size_t t = frames.first; t < frames.first + frames.count; ++t) {
            const auto first = static_cast<double>(t);
            add({.text = word.text, .start = first / speech.fps, .end = (first + 1) / speech.fps}, i);
        }
    }
    return elements;
}

float within_unit(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

}  // namespace

FaceLevels face_levels(std::int64_t of_action_units, std::int64_t of_angles) {
    FaceLevels levels;
    levels.fill(of_angles);
    std::fill_n(levels.begin(), IpuRecord::kUnits, of_action_units);
    return levels;
}

std::vector<float> resampled_rows(std::span<const float> rows, std::size_t width, std::size_t count) {
    const std::size_t last = rows.size() / width - 1;
    std::vector<float> made(count * width);
    for (std::size_t i = 0; i < count; ++i) {
        const double place = count > 1 ? static_cast<double>(i * last) / static_cast<double>(count - 1) : 0;
        const auto before = static_cast<std::size_t>(place);
        const auto share = static_cast<float>(place - static_cast<double>(before));
        const std::size_t after = std::min(before + 1, last);
        for (std::size_t c = 0; c < width; ++c) {
            made[i * width + c] = std::lerp(rows[before * width + c], rows[after * width + c], share);
        }
    }
    return made;
}

std::vector<FaceUnit> spoken_units(const SpokenWords& speech, std::size_t begin, std::size_t end) {
    const Elements elements = elements_of(speech, begin, end);
    std::vector<FaceUnit> units;
    for (std::size_t i = 0; i < elements.words.size(); ++i) {
        if (i % speech.cut.most_elements() == 0) units.emplace_back();
        FaceUnit& unit = units.back();
        unit.words.push_back(spoken_word(speech, elements.stretches[i]));
        const auto vector =
            speech.vectors.begin() + static_cast<std::ptrdiff_t>(elements.words[i] * kWordVector);
        unit.vectors.insert(unit.vectors.end(), vector, vector + kWordVector);
    }
    return units;
}

std::array<std::array<double, 2>, kFaceChannels> face_scale() {
    std::array<std::array<double, 2>, kFaceChannels> scale;
    scale.fill({-1, 1});
    std::fill_n(scale.begin(), IpuRecord::kUnits, std::array<double, 2>{0, 5});
    return scale;
}

std::vector<float> normalised_face(const IpuRecord& record) {
    const auto scale = face_scale();
    std::vector<float> face(record.frames() * kFaceChannels);
    for (std::size_t t = 0; t < record.frames(); ++t) {
        for (std::size_t c = 0; c < kFaceChannels; ++c) {
            const double value = c < IpuRecord::kUnits
                                     ? record.units[t * IpuRecord::kUnits + c]
                                     : record.head[t * IpuRecord::kAngles + c - IpuRecord::kUnits];
            face[t * kFaceChannels + c] = within_unit((value - scale[c][0]) / (scale[c][1] - scale[c][0]));
        }
    }
    return face;
}

std::vector<FaceUnit> face_units(const IpuRecord& record, const UnitCut& cut) {
    const std::vector<float> face = normalised_face(record);
    std::vector<FaceUnit> units = spoken_units({.words = record.words,
                                                .vectors = record.vectors,
                                                .f0 = record.f0,
                                                .fps = record.fps,
                                                .frames = record.frames(),
                                                .cut = cut},
                                               0, record.words.size());
    for (FaceUnit& unit : units) {
        unit.id = record.id;
        unit.speaker = record.speaker;
        for (FaceWord& word : unit.words) {
            word.contours = thinned(
                std::span(face).subspan(word.frames.first * kFaceChannels, word.frames.count * kFaceChannels),
                kFaceChannels, cut.most_frames);
        }
    }
    return units;
}

}  // namespace chironomia
