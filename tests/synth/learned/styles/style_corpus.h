// A corpus of intervals that the program made, and jobs on it, for the tests of models of style.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/hdf5/writer.h"
#include "synth/corpus/make/make_corpus.h"
#include "synth/learned/styles/style_points.h"
#include "tests/support/support.h"

namespace chironomia::testing {

// Two speakers to learn from and one more.
inline const std::filesystem::path& style_corpus() {
    static const TemporaryFolder folder;
    static const CorpusIndex made = make_corpus({.kind = CorpusKind::intervals,
                                                 .size = CorpusSize::ci,
                                                 .folder = folder / "corpus",
                                                 .speakers = speaker_choice_of("2+1"),
                                                 .quiet = true});
    return made.folder;
}

inline Json style_training(const TemporaryFolder& folder, const std::string& model, int steps) {
    return {{"verb", "train"},
            {"model", model},
            {"preset", "small"},
            {"corpus", style_corpus().string()},
            {"out", (folder / "model").string()},
            {"seed", 3},
            {"threads", 1},
            {"quiet", true},
            {"steps", steps}};
}

// The weights and how they learned.
inline std::string bytes_of(const std::filesystem::path& stem) {
    return read_text(std::filesystem::path(stem) += ".safetensors");
}

struct Silence {
    std::string encoder = "hashbert";
    std::size_t bands = kStyleMel;
    std::size_t rows = 580;
    double rate = 86.13;  // rows a second
};

// Inputs of `animate`, 100 frames of words: nobody says anything.
inline void write_inputs(const std::filesystem::path& file, const Silence& silence = {}) {
    Hdf5Writer writer(file, file.string());
    writer.write_texts("text_encoder", {silence.encoder});
    writer.write_floats("text", {100, kStyleText}, std::vector<float>(100 * kStyleText));
    writer.write_floats("mel", {silence.rows, silence.bands},
                        std::vector<float>(silence.rows * silence.bands, -10));
    writer.write_number("mel_rate", silence.rate);
    writer.close();
}

}  // namespace chironomia::testing
