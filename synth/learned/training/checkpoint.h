// The files that training writes: FILE.json describes the model and how it was trained, FILE.safetensors holds
// its weights, and FILE.resume.safetensors holds the state from which training resumes. Without this last file
// the model can be used, but its training cannot be resumed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "synth/learned/training/safetensors.h"

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

    Tensors weights;  // of the best validation loss
    Tensors resume;   // the last weights and the optimiser's state; or none
};

// FILE for FILE, FILE.json and FILE.safetensors.
std::filesystem::path checkpoint_stem(const std::filesystem::path& file);

// The files change together: killed at any moment, the whole old or the whole new checkpoint can be read.
// Throws Error if a file cannot be written.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

enum class CheckpointParts {
    description,  // without tensors, though their file must be the right one
    weights,
    all,  // Throws Error if there is nothing to go on from
};

// Throws Error with the file and what is wrong: missing, damaged, truncated, of another pair.
Checkpoint read_checkpoint(const std::filesystem::path& file, CheckpointParts parts);

// What a caller needs a checkpoint to be; an empty field asks for nothing.
struct CheckpointNeed {
    std::string model;
    std::string preset;
    std::vector<std::string> inputs, outputs;  // names in their order
};

// Throws Error with `file`, what the checkpoint is and what was needed.
void check_fits(const std::filesystem::path& file, const Checkpoint& checkpoint, const CheckpointNeed& need);

}  // namespace chironomia
