// How the numbers of a corpus are scaled for models. Whatever is measured for it is measured on the training
// records alone, so that nothing of the others gets into a model.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"

namespace chironomia {

// What the normalised 0 and 1 of a feature stand for, in the unit of the records.
struct FeatureScale {
    double zero = 0;
    double one = 1;           // another number than zero
    bool is_clamped = false;  // what lies outside is held at 0 or 1

    double normalised(double value) const;
    double restored(double normalised) const;
};

// The arrays of the records by the names that they have in the files, each with a scale for each column:
//   talks      fixed, clamped: "au" (6) 0..5, "head" (3) -1..1 rad, "f0" (1) 50..550 Hz
//   dyads      clamped, the 1st and the 99th percentile (A06): "face" (10), "speech" (16) of both people
//   intervals  mean and mean + 2 standard deviations (A22), so that they become 0 and 0.5: over all columns
//              "audio/log_mel_400" (1), "audio/log_mel_512" (1); for each "pose/data" (104), "pose/normalize"
//              (104), "text/bert" (768), and if they are known "face/data" (140), "face/normalize" (140);
//              points only of the frames in which they are seen, and of the normalised ones a deviation of at
//              least 2 % of the shoulders' width, so that the tracker's noise at points that stand still is not
//              taken for motion
// A feature that does not vary becomes 0.
struct CorpusStatistics {
    CorpusKind kind = CorpusKind::talks;
    std::size_t records = 0;  // that were measured
    double seconds = 0;       // of them
    std::map<std::string, std::vector<FeatureScale>> scales;

    const std::vector<FeatureScale>& of(const std::string& array) const { return scales.at(array); }
};

// Throws Error as reading the records does.
CorpusStatistics measure_statistics(const CorpusIndex& corpus);

// DIR/statistics.json.
void write_statistics(const std::filesystem::path& folder, const CorpusStatistics& statistics);
// Throws Error if it is there and broken, of another kind than the corpus, or an array is missing in it.
// Where it is not there, it is measured.
CorpusStatistics read_statistics(const CorpusIndex& corpus);

}  // namespace chironomia
