// The JSON of a checkpoint, which describes a model and how it was trained; without libtorch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/files/json_value.h"

namespace chironomia {

// What one number of a model's input or output stands for.
struct Feature {
    std::string name;  // "AU1", "f0"
    // What the normalised 0 and 1 stand for: intensities, radians, Hz. Of the training records alone.
    double low = 0, high = 1;
};

struct CurvePoint {
    std::size_t step = 0;  // steps done
    double train = 0;      // mean loss of the batches since the point before
    double validation = 0;
};

struct Checkpoint {
    std::string model;   // "amii"
    std::string preset;  // "small"
    Json options;        // what a paper leaves open by its id (docs/learning.md), sizes: {"A25": "joint"}
    std::string text_encoder;              // "hashbert", "bert-base-uncased"; "" for a model without text
    std::vector<Feature> inputs, outputs;  // in the order of the columns
    std::uint64_t seed = 1;
    std::size_t step = 0;  // steps done
    Json training;         // the plan and where in it training stands (synth/learned/training/trainer.h)
    std::vector<CurvePoint> curve;  // ascending by step
    std::string version;            // of the program that wrote it
};

// With all but what names the files of tensors.
Json json_of(const Checkpoint& checkpoint);

// Throws Error with the key for what is missing, of another type or out of range.
Checkpoint checkpoint_of(const JsonValue& json);

}  // namespace chironomia
