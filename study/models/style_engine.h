// What a model of style is asked, and what it answers: synth/learned/styles/style_jobs.h.
#pragma once

#include <filesystem>
#include <string>

#include "core/body/motion.h"
#include "core/files/json.h"
#include "core/speech.h"
#include "synth/text/word_vectors.h"

namespace chironomia::study {

// Whose style it is, as the job says it: "FILE.h5", an interval of PATS; "DIR:SPEAKER" of a corpus; or "SPEAKER" alone,
// of a model that has learned the styles of some.
Json style_job(const std::string& text);

// Who is seen in an interval of PATS: its folder's name (data/processed/SPEAKER/ID.h5).
std::string speaker_of_interval(const std::filesystem::path& file);

// `encoder` makes the vectors of words; none of a model that hears the sound alone. Throws Error if words are needed
// and there are none.
void write_style_inputs(const std::filesystem::path& file, const Speech& speech, const std::string& model,
                        const TextEncoder* encoder);

// Eleven points of a picture, with 15 of the face where the model moves it, as PATS's are read.
Motion read_styled_motion(const std::filesystem::path& file, const std::string& model);

}  // namespace chironomia::study
