// Dyads of a corpus as models of two people see them: normalised frames, and windows over them.
#pragma once

#include <torch/types.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "synth/corpus/statistics.h"
#include "synth/learned/dyads/amii.h"
#include "synth/learned/training/checkpoint.h"

namespace chironomia {

// Both people of a record; each tensor (T, C), normalised to [0, 1].
struct DyadFrames {
    struct Person {
        std::string participant;
        torch::Tensor face;    // (T, 10)
        torch::Tensor speech;  // (T, 16)
    };

    std::string id;
    std::array<Person, 2> people;

    std::size_t frames() const { return static_cast<std::size_t>(people[0].face.size(0)); }
};

// The columns of DyadPerson, by the names that predictions have.
std::vector<std::string> face_column_names();

// The columns of both people: face and speech as the inputs of a model, and the face as its outputs.
struct DyadFeatures {
    std::vector<Feature> face;    // (10)
    std::vector<Feature> speech;  // (16)
};
DyadFeatures dyad_features(const CorpusStatistics& statistics);

// (T, features) in [0, 1] of numbers as records have them, and back.
torch::Tensor normalised(const std::vector<float>& rows, const std::vector<Feature>& features);
std::vector<float> denormalised(const torch::Tensor& rows, const std::vector<Feature>& features);

// Throws Error as reading the records does, if there are none in `split`, or if one is shorter than `least`
// frames.
std::vector<DyadFrames> read_dyads(const CorpusIndex& corpus, Split split, const DyadFeatures& features,
                                   std::size_t least);

// Where a window of `kWindow` frames begins; the frame after it is what is to be predicted.
struct DyadWindow {
    std::size_t dyad = 0;
    std::size_t begin = 0;
};

std::vector<DyadWindow> windows_over(const std::vector<DyadFrames>& dyads, std::size_t stride);

// Windows in both orders: first with person 0 as A, then with person 1 as A.
struct WindowBatch {
    PersonFrames people;  // (2 B, 100, ...)
    torch::Tensor next;   // (2 B, 20) faces of A and U one frame later
};

WindowBatch batch_of(const std::vector<DyadFrames>& dyads, std::span<const DyadWindow> windows);

}  // namespace chironomia
