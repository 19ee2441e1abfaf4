// What the models of style share of the jobs of synth/learning.h.
//
// The inputs of `animate`, an HDF5 file of T frames at 15 a second:
//   /text_encoder  (1) text, what made the vectors
//   /text          (T, 768) the vector of the word at each frame; a model without words can do without both
//   /mel           (R, 128 or 64) rows of log_mel_512 or log_mel_400 (synth/features/spectrum.h)
//   /mel_rate      rows a second
// Instead of inputs a job may have "content": {"file": an interval of PATS}, whose words and sound are shown.
// The job's "style" says whose style it is: {"file": an interval of PATS} or {"corpus": DIR, "speaker": NAME}, and its
// option "segments" of how many of their segments the style is the mean. Mix-StAGE knows the speakers of its training
// alone, by their names: {"speaker": NAME}. What is made is a file of the form of PATS:
//   /pose/normalize  (T, 22)
//   /face/normalize  (T, 30), of models of the face
//
// `predict` shows each interval of the split in the style of its own speaker, and as many as its option "pairs" says in
// that of each other speaker of the split. Items are called "interval>speaker". Mix-StAGE refuses speakers whom it has
// not learned from.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/files/json_value.h"
#include "synth/learned/styles/style_records.h"
#include "synth/learned/styles/style_windows.h"
#include "synth/learned/training/checkpoint.h"
#include "synth/learned/training/learned_model.h"

namespace chironomia {

// In the table of the models: "zs-mstm-1", "zs-mstm-2".
LearnedModel zs_mstm_model(const std::string& name);
LearnedModel mix_stage_model();

// A model with its weights, whichever it is, and how it is used.
struct StyleModel {
    Checkpoint described;
    StyleForm form;
    std::int64_t frames = 64;             // of a segment
    torch::nn::Module* module = nullptr;  // lives in the functions
    // (B, style) of B segments. None of a model that knows its styles by their names.
    std::function<torch::Tensor(const StyleSegments&)> style_of;
    // (B, content) the mean over the frames of B segments.
    std::function<torch::Tensor(const StyleSegments&)> content_of;
    // Of the modalities of B segments that the style is taken from.
    std::function<std::vector<StyleModality>(const StyleSegments&)> modalities_of{};
    // (B, style) what the adversary guesses of the style from the content of B segments; none without an adversary.
    std::function<torch::Tensor(const StyleSegments&)> guess_of{};
    // (style) of each speaker of the training, by name; empty: styles are those of segments.
    std::map<std::string, torch::Tensor> styles{};
    // (B, T, numbers of pose and face) of B segments of content, in one style (style).
    std::function<torch::Tensor(const StyleSegments&, const torch::Tensor& style)> generate;
};

// Frames in which one segment fades into the next: ours.
inline constexpr std::int64_t kCrossFade = 8;

// (T, F) of a whole record, normalised.
torch::Tensor animate_segments(const StyleModel& model, const StyleRecord& content,
                               const torch::Tensor& style);

// (style) the mean of `count` segments, evenly spread over all of `windows`, which must not be empty.
torch::Tensor mean_style(const StyleModel& model, StyleRecords& records,
                         const std::vector<StyleWindow>& windows, std::size_t count);

// The intervals by which a training knows which weights to keep. Throws Error if there are none.
std::vector<CorpusEntry> validation_entries(const CorpusIndex& corpus);

// The answers to the jobs. Throw Error as reading the corpus does.
Json predict_styles(const StyleModel& model, const JsonValue& job);
Json animate_style(const StyleModel& model, const JsonValue& job);

}  // namespace chironomia
