// What a model predicted for the records of a corpus, beside what people did: the form in which models hand
// their results to the metrics. As a file, in HDF5:
//
//   /model, /corpus, /split  (1) text
//   /fps                     float64
//   /features                (F) text
//   /scale                   (F, 2) float64
//   /ids, /speakers          (N) text, of the items
//   /styles                  (N) text, of models of style
//   /frames                  (N) int32, T of each item
//   /truth, /prediction      (sum of all T, F) float32, items one after the other
//   /partner                 alike, of dyads
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace chironomia {

// One utterance, or one person of a dyad. Frame t, feature f lies at t * F + f.
struct PredictedItem {
    std::string id;  // of the record; of one person of a dyad "d03:0" or "d03:1"
    std::string speaker;
    std::string style{};       // of models of style: the speaker whose style it is; or empty of all items
    std::vector<float> truth;  // (T, F) normalised
    std::vector<float> prediction;  // (T, F) normalised
    std::vector<float> partner;     // (T, F) of a dyad: what the other person did; or empty of all items
};

struct Predictions {
    std::string model;   // "model2", "amii-noE_dual", "hold"
    std::string corpus;  // its folder's name
    std::string split;   // "test"
    double fps = 25;
    std::vector<std::string> features;  // (F) "AU1", "Rx", "gaze_angle_x"
    // (F) what the normalised 0 and 1 stand for: intensities, radians
    std::vector<std::array<double, 2>> scale;
    std::vector<PredictedItem> items;  // ascending by id, no two the same; at least one
};

// The same predictions give the same bytes. Throws Error if the file cannot be written.
void write_predictions(const std::filesystem::path& file, const Predictions& predictions);
// Throws Error with file and array if something is missing, of another shape or not finite, a scale is empty,
// an item has no frames or items are not ascending.
Predictions read_predictions(const std::filesystem::path& file);

}  // namespace chironomia
