// The files that training writes: FILE.json describes the model and how it was trained, FILE.safetensors holds
// its weights, and FILE.resume.safetensors holds the state from which training resumes. Without this last file
// the model can be used, but its training cannot be resumed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "synth/learned/training/checkpoint_json.h"
#include "synth/learned/training/safetensors.h"
#include "synth/learned/training/safetensors_layout.h"

namespace chironomia {

struct StoredCheckpoint {
    Checkpoint description;
    Tensors weights;  // of the best validation loss
    Tensors resume;   // the last weights and the optimiser's state; or none
};

// FILE for FILE, FILE.json and FILE.safetensors.
std::filesystem::path checkpoint_stem(const std::filesystem::path& file);

// The files change together: killed at any moment, the whole old or the whole new checkpoint can be read.
// Throws Error if a file cannot be written.
void write_checkpoint(const std::filesystem::path& file, const StoredCheckpoint& checkpoint);

enum class CheckpointParts {
    description,  // without tensors, though their file must be the right one
    weights,
    all,  // Throws Error if there is nothing to go on from
};

// Throws Error with the file and what is wrong: missing, damaged, truncated, or tensors that are not those of the JSON
// by their SHA-256.
StoredCheckpoint read_checkpoint(const std::filesystem::path& file, CheckpointParts parts);

// The shapes of its weights. Throws Error as read_checkpoint.
TensorShapes read_weight_shapes(const std::filesystem::path& file);

// What a caller needs a checkpoint to be; an empty field asks for nothing.
struct CheckpointNeed {
    std::string model;
    std::string preset;
    std::vector<std::string> inputs, outputs;  // names in their order
};

// Throws Error with `file`, what the checkpoint is and what was needed.
void check_fits(const std::filesystem::path& file, const Checkpoint& checkpoint, const CheckpointNeed& need);

}  // namespace chironomia
