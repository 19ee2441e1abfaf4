// What people did in the records of a corpus, under the names that predictions have (synth/predictions.h).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"
#include "synth/predictions.h"

namespace chironomia::study {

// One person of a record. Frame t, feature f lies at t * F + f.
struct RecordedRows {
    double fps = 25;
    std::vector<std::string> features;  // (F)
    std::vector<float> values;          // (T, F) intensities, radians, pixels; NaN where it was not seen

    std::size_t frames() const { return values.size() / features.size(); }  // T
};

// Of a dyad both people, in their order. Throws Error as reading the record does.
std::vector<RecordedRows> recorded_rows(const CorpusIndex& corpus, const CorpusEntry& entry);

// The id of an item's record: of a dyad's person "d03:0" it is "d03", of a style that was transferred "t05>anna" "t05".
std::string record_of(const PredictedItem& item);

// Checks that `truth` and `partner` of each item are frames of its record, in their order, within 0.001 on the scale of
// the predictions; models may leave out frames. The notes say which features no record has, so that they were not
// compared. Throws Error with `where`, record, frame and both values where that is not so, and for another rate.
std::vector<std::string> check_truth(const Predictions& predictions, const CorpusIndex& corpus,
                                     const std::string& where);

}  // namespace chironomia::study
