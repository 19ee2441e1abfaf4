// What a model of style makes of segments, for maps and probes: the job "encode_styles".
//
// {checkpoint, corpus, split, out, options: {segments}} -> {segments}; `out` is an HDF5 file of N segments, evenly
// spread over those of the split, `segments` of each speaker at most:
//   /speakers  (N) text
//   /intervals (N) text, the interval that a segment is of
//   /style     (N, S) h_style
//   /content   (N, C) h_content, the mean over its frames
//   /speech, /text, /pose, /face  (N, of its own width) what each modality that the style is taken from says by itself
//   /guess     (N, S) what the adversary guesses of h_style from h_content; not of a model that learned without one
#pragma once

#include "synth/learned/styles/style_jobs.h"

namespace chironomia {

// Throws Error as reading the corpus does.
Json encode_styles(const StyleModel& model, const JsonValue& job);

}  // namespace chironomia
