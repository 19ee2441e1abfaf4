// What Models 1 and 2 share of the jobs of synth/learning.h.
//
// The inputs of `animate`, an HDF5 file:
//   /text_encoder  (1) text, what made the vectors
//   /words         (N) text; a silence of at most 0.2 s within a unit is the word ","
//   /times         (N, 2) [s], start and end of each word, ascending
//   /vectors       (N, 768)
//   /f0            (S) [Hz] at 100 Hz from 0 s on; 0 where it is not voiced
//   /seconds       how long the motion is to be
// and what it makes:
//   /fps           frames per second
//   /units         (T, 6) intensities of the action units 1, 2, 4, 5, 6, 7
//   /head          (T, 3) pose_Rx, pose_Ry, pose_Rz of OpenFace [rad]
// Where nothing is said, the face goes on a line from the last word to the next. The motion is smoothed by a
// Gaussian of `smooth` seconds, 0.05 unless the job's options set it; 0 leaves the model's output as it is.
#pragma once

#include <torch/nn/module.h>

#include <functional>
#include <string>
#include <vector>

#include "core/files/json_value.h"
#include "synth/corpus/corpus.h"
#include "synth/learned/faces/face_batch.h"
#include "synth/learned/training/checkpoint.h"
#include "synth/learned/training/job_fields.h"
#include "synth/learned/training/learned_model.h"

namespace chironomia {

// In the table of the models.
LearnedModel model1_jobs();
LearnedModel model2_jobs();

// A model with its weights, whichever it is.
struct FaceModel {
    Checkpoint described;  // of a new model what the trainer does not know
    FaceLevels levels;
    UnitCut cut;
    bool takes_unknown_voices = false;    // it has learned to do without a voice's mean and deviation
    torch::nn::Module* module = nullptr;  // lives in both functions
    std::function<FaceLogits(const FaceBatch&)> learn;    // with the true contours of the words before
    std::function<FaceLogits(const FaceBatch&)> predict;  // without
};

// The talks of a job's corpus that training needs.
struct FaceCorpus {
    CorpusIndex index;
    std::vector<FaceUnit> train, validation;
};
// Throws Error if it is no corpus of talks, or none of them are of validation.
FaceCorpus read_face_corpus(const JsonValue& job, const UnitCut& cut);

// That of a job's checkpoint, made by `build`, with its weights.
FaceModel read_face_model(const JsonValue& job, const std::function<FaceModel(Checkpoint)>& build);

// Of a job "train", what the trainer does not know: preset, options, features and encoder.
Checkpoint new_checkpoint(const JsonValue& job, const FaceCorpus& corpus, const Json& choices);
// What `model` is to learn, in batches of `batch` words or units (A38). Both must outlive the task.
TrainingTask face_task(FaceModel& model, const FaceCorpus& corpus, std::size_t batch);
// The answers to the other jobs.
Json predict_faces(FaceModel model, const JsonValue& job);
Json animate_faces(FaceModel model, const JsonValue& job);
Json describe_faces(const JsonValue& job, const FaceModel& model);

}  // namespace chironomia
