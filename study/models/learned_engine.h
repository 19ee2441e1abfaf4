// The learned models as synthesis systems: speech to a face, a head and, of AMII, a gaze. They work in the
// helper program of synth/learning.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/speech.h"

namespace chironomia {

struct LearnedEngine {
    std::string model;                                // "model1", "model2", "amii"
    std::optional<std::filesystem::path> checkpoint;  // none: the bundled one
    // Of AMII: what the partner does and says; a motion with a face of any kind that is read, and a sound.
    std::optional<std::filesystem::path> user_face, user_speech;
    // Of Models 1 and 2: BERT's folder (synth/text/bert_encoder.h), for checkpoints that learned its vectors
    // of words; none: the built-in encoder.
    std::optional<std::filesystem::path> bert{};
    int threads = 1;
};

// "amii", "model1", "model2"
const std::vector<std::string>& learned_engines();

// Model 1 and Model 2 need words; AMII needs its partner, and ends with whichever of the three is shortest,
// which the motion's notes say.
class LearnedSynthesizer {
  public:
    // Throws Error if there is no checkpoint, or AMII has no partner, or another model has one.
    explicit LearnedSynthesizer(LearnedEngine engine);

    // A motion with a face alone, at the model's rate. Throws Error as the helper does, as the readers of the
    // partner's files do, if there are no words, if the partner's file has no face, or if the checkpoint is
    // of another model or has learned another encoder's vectors of words.
    Motion synthesize(const Speech& speech) const;

  private:
    LearnedEngine engine_;
    std::filesystem::path checkpoint_;
};

// `face` completed by `whole` (joints, labels, mouth, lids, eyes), at the rate and length of `face`. Where both have a
// value, that of `face` stays. An action unit of `face` replaces those of both sides in `whole`.
Motion filled(const Motion& face, const Motion& whole);

}  // namespace chironomia
