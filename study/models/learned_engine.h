// The learned models as synthesis systems: speech to a face, a head and, of AMII, a gaze; or to the gestures of
// somebody else, in a picture. They work in the helper program of synth/learning.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/body/motion.h"
#include "core/files/json.h"
#include "core/speech.h"

namespace chironomia::study {

struct LearnedEngine {
    std::string model;                                // "model1", "model2", "amii", "zs-mstm", "mix-stage"
    std::optional<std::filesystem::path> checkpoint;  // none: the bundled one
    // Of AMII: what the partner does and says; a motion with a face of any kind that is read, and a sound.
    std::optional<std::filesystem::path> user_face, user_speech;
    // Of models that hear words: BERT's folder (synth/text/bert_encoder.h), for checkpoints that learned its
    // vectors of words; none: the built-in encoder.
    std::optional<std::filesystem::path> bert{};
    int threads = 1;
    bool quiet = false;  // no progress on stderr
    // Of models of style: whose style it is (style_job of study/models/style_engine.h), as the mean of how many
    // segments of theirs.
    std::optional<std::string> style_of{};
    int style_segments = 8;
    // Of models of style: an interval of PATS whose words and sound are shown, in place of speech.
    std::optional<std::filesystem::path> content_of{};
};

// "amii", "model1", "model2", "zs-mstm", "mix-stage"
const std::vector<std::string>& learned_engines();

// The weights of a model, beside which its description lies. Throws Error if it has none.
std::filesystem::path bundled_checkpoint(const std::string& model);

// Whose styles a checkpoint of Mix-StAGE knows by their names. Throws Error if it is of another model.
std::vector<std::string> learned_speakers(const std::filesystem::path& checkpoint);

// All but AMII need words. AMII needs its partner, and ends with whichever of the three is shortest, which the
// motion's notes say. Models of style need a target speaker.
class LearnedSynthesizer {
  public:
    // Throws Error if there is no checkpoint, AMII has no partner or another model has one, or if a model of style
    // has no target speaker, or another model has one.
    explicit LearnedSynthesizer(LearnedEngine engine);

    // At the model's rate: a motion with a face alone, or of models of style the points of a picture. Throws Error
    // as the helper does, as the readers of the partner's files do, if there are no words, if the partner's file has
    // no face, or if the checkpoint is of another model or has learned another encoder's vectors of words.
    Motion synthesize(const Speech& speech) const;

  private:
    // Of the checkpoint. Throws Error if it is of another model.
    Json description() const;
    // What the helper needs beside the checkpoint, which is looked at after what the user gave.
    void write_inputs(const std::filesystem::path& file, const Speech& speech,
                      std::vector<std::string>& notes) const;

    LearnedEngine engine_;
    std::filesystem::path checkpoint_;
};

// `face` completed by `whole` (joints, labels, mouth, lids, eyes), at the rate and length of `face`. Where both have a
// value, that of `face` stays. An action unit of `face` replaces those of both sides in `whole`.
Motion filled(const Motion& face, const Motion& whole);

}  // namespace chironomia::study
