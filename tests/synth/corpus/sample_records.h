// Small records of made-up numbers, and corpora of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"

namespace chironomia::testing {

// `count` numbers that wander between `least` and `most`, others for each `phase`.
inline std::vector<float> wave(std::size_t count, double least, double most, double phase) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
        const double swing = 0.5 + 0.5 * std::sin(0.37 * static_cast<double>(i) + phase);
        values.push_back(static_cast<float>(least + (most - least) * swing));
    }
    return values;
}

// Two seconds: "well", a silence, "done".
inline IpuRecord sample_ipu(const std::string& id, const std::string& speaker, double phase = 0) {
    constexpr std::size_t kFrames = 48, kSamples = 200;
    IpuRecord record{.id = id, .speaker = speaker, .source = "talk of " + speaker, .start = 12.5};
    record.words = {{"well", 0, 0.5}, {",", 0.5, 0.75}, {"done", 0.75, 2}};
    record.vectors = wave(3 * kWordVector, -1, 1, phase);
    for (float& value : record.vectors) value = std::round(value * 256) / 256;  // fits 16 bits
    record.f0 = wave(kSamples, 80, 250, phase);
    record.f0_strength = wave(kSamples, 0, 1, phase);
    record.voice = wave(kSamples * IpuRecord::kVoice, 0, 20, phase);
    record.units = wave(kFrames * IpuRecord::kUnits, 0, 5, phase);
    record.head = wave(kFrames * IpuRecord::kAngles, -0.5, 0.5, phase);
    record.success.assign(kFrames, 1);
    record.success[3] = 0;
    record.confidence = wave(kFrames, 0.5, 1, phase);
    return record;
}

// Four seconds.
inline DyadRecord sample_dyad(const std::string& id, const std::string& first, const std::string& second,
                              double phase = 0) {
    constexpr std::size_t kFrames = 100;
    DyadRecord record{.id = id};
    record.people[0].participant = first;
    record.people[0].role = "expert";
    record.people[1].participant = second;
    record.people[1].role = "novice";
    for (DyadPerson& person : record.people) {
        person.face = wave(kFrames * DyadPerson::kFace, 0, 1.5, phase);
        person.speech = wave(kFrames * DyadPerson::kSpeech, -3, 30, phase);
        phase += 0.5;
    }
    return record;
}

// Two seconds.
inline IntervalRecord sample_interval(const std::string& id, const std::string& speaker, double phase = 0) {
    constexpr std::size_t kFrames = 30;
    const auto rounded = [&](std::size_t count, double least, double most) {
        std::vector<float> values = wave(count, least, most, phase);
        for (float& value : values) value = std::round(value * 16) / 16;  // fits 16 bits
        return values;
    };
    IntervalRecord record{.id = id, .speaker = speaker};
    record.words = {{"well", 0.1, 0.5}, {"done", 0.75, 2}};
    record.pose = wave(kFrames * 2 * IntervalRecord::kJoints, -200, 300, phase);
    record.pose_normalized = wave(kFrames * 2 * IntervalRecord::kJoints, -100, 150, phase);
    record.pose_confidence = wave(kFrames * 2 * IntervalRecord::kJoints, 0, 1, phase);
    record.mel_400 = rounded(198 * IntervalRecord::kMel400, -10, 5);
    record.mel_512 = rounded(173 * IntervalRecord::kMel512, -20, 5);
    record.silence.assign(kFrames, 0);
    record.silence[0] = 1;
    record.vectors = rounded(kFrames * kWordVector, -2, 2);
    record.tokens.assign(kFrames, 2092);
    std::fill(record.tokens.begin() + 11, record.tokens.end(), 2589);
    record.face = wave(kFrames * 2 * IntervalRecord::kFacePoints, -50, 50, phase);
    record.face_normalized = wave(kFrames * 2 * IntervalRecord::kFacePoints, -25, 25, phase);
    record.face_confidence = wave(kFrames * 2 * IntervalRecord::kFacePoints, 0, 1, phase);
    record.dialog_acts.assign(kFrames * IntervalRecord::kDialogActs, 0);
    record.dialog_acts[12] = 1;
    record.style.emplace().fill(0.25f);
    record.phase.assign(kFrames, 2);
    return record;
}

// An index of records of one kind that are not written yet.
inline CorpusIndex sample_index(const std::filesystem::path& folder, CorpusKind kind,
                                std::vector<CorpusEntry> entries) {
    return {.folder = folder,
            .kind = kind,
            .entries = std::move(entries),
            .origin = {{"command", "a test"}, {"seed", 7}}};
}

// Written: a talk in each split, of which "c" is unseen.
inline CorpusIndex sample_talks(const std::filesystem::path& folder) {
    CorpusIndex index = sample_index(folder, CorpusKind::talks,
                                     {{.id = "a_1", .speaker = "a", .split = Split::train, .seconds = 2},
                                      {.id = "a_2", .speaker = "a", .split = Split::test, .seconds = 2},
                                      {.id = "b_1", .speaker = "b", .split = Split::train, .seconds = 2},
                                      {.id = "b_2", .speaker = "b", .split = Split::validation, .seconds = 2},
                                      {.id = "c_1", .speaker = "c", .split = Split::unseen, .seconds = 2}});
    double phase = 0;
    for (const CorpusEntry& entry : index.entries)
        write_ipu(folder, sample_ipu(entry.id, entry.speaker, phase += 0.7));
    write_corpus_index(index);
    return index;
}

}  // namespace chironomia::testing
