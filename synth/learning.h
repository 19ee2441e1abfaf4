// The helper program chironomia_learn, which holds libtorch: training, predicting and animating with the
// learned models of synth/learned. It is asked with a job and answers with what it found, both as JSON; large
// numbers go through files of core/hdf5/file.h. A program of its own, because libtorch takes a second to
// start, which rendering must not.
//
// Jobs, by their "verb"; paths are absolute:
//   train     {model, preset, corpus, out, seed, threads, quiet, options: {...}, steps?, epochs?, save_every?}
//             -> {checkpoint, steps, train_loss, validation_loss, curve: [[step, train, validation], ...]}
//   predict   {checkpoint, corpus, split, out, threads, quiet, options} -> {predictions, items}
//   animate   {checkpoint, inputs, out, threads} -> {frames, fps}
//   encode    {weights, vocabulary, utterances: [["a", "word"], ...], out, threads} -> {words}; `out` has
//             /vectors (N, 768) of all words in order; `weights` and `vocabulary` are BERT-base-uncased's
//   encode_styles  what models of style make of segments: synth/learned/styles/style_encodings.h
//   describe  {checkpoint} | {model, preset, options} -> {model, preset, parameters, ...}
// Models of style: "zs-mstm-1", "zs-mstm-2", "mix-stage", which `animate` with a "style"
// (synth/learned/styles/style_jobs.h), and "style-classifier", whose `predict` answers with counts
// (synth/learned/styles/style_classifier.h).
// Models of dyads: "amii", "il-lstm", "sym-il-lstm", and "hold", which predicts without a checkpoint by its
// "model"; their inputs, outputs and options: synth/learned/dyads/dyad_jobs.h.
#pragma once

#include <filesystem>

#include "core/files/json.h"
#include "core/files/scratch_folder.h"

namespace chironomia {

// Looked for where $CHIRONOMIA_LEARN says, or else beside the program, in lib/chironomia beside its folder,
// and where it was built. Throws Error with what the helper refuses, and if it is not there or breaks down.
Json ask_to_learn(const Json& job);

// Where a job's files lie while it runs: a folder among the temporary ones, removed with this. Throws Error if none can
// be made.
class JobFolder {
  public:
    std::filesystem::path inputs() const { return folder_.path() / "inputs.h5"; }
    std::filesystem::path result() const { return folder_.path() / "result.h5"; }

  private:
    ScratchFolder folder_{"learned"};
};

}  // namespace chironomia
