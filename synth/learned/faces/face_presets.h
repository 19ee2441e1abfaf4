// How Models 1 and 2 are built and trained, by the name of a preset and by options: every reading of the
// thesis by its id in docs/learned_faces.md. No torch here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json_value.h"
#include "synth/learned/faces/model1_options.h"
#include "synth/learned/faces/model2_options.h"

namespace chironomia {

// "paper": what the thesis states; "small": for two cores.
const std::vector<std::string>& model1_presets();
// Also "m2_2051133": as many numbers as the thesis counts (A44).
const std::vector<std::string>& model2_presets();

// Every option of the model with the value that `asked` gives it, or its default, which comes first:
//   model1   A34 direction|total, A35 one|nine, A38 words|units
//   model2   A38 words|units, A40 tokens|values|relative|rise, A41 layer|equation,
//            A42 attended|speech, A45 words|frames, ablation none|speech|text|A|D1, and what the preset
//            "small" has otherwise than the thesis: attention everywhere|near, inputs plain|level, feedback
//            argmax|expected, forgotten 0|0.25|0.5|1, unplaced 0|0.5, unread 0|0.25|0.5
// Throws Error for another key or value.
Json model1_choices(const JsonValue& asked);
Json model2_choices(std::string_view preset, const JsonValue& asked);

// `choices` as those functions give them.
Model1Options model1_options(std::string_view preset, const Json& choices);
Model2Options model2_options(std::string_view preset, const Json& choices);

// Takes away "speech", "text", "A" or "D1" (section 5.6.3); "none" takes nothing.
void ablate(Model2Options& options, std::string_view part);

// How long and in which batches each part learns.
struct LearningSize {
    std::size_t epochs = 300;
    std::size_t batch = 128;
};
struct Model1Training {
    LearningSize speech, face;  // the auto-encoders, in contours; table 5.2
    LearningSize model;         // in words, A38; table 5.4
};
Model1Training model1_training(std::string_view preset);

}  // namespace chironomia
