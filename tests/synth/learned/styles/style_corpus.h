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

// The same with intervals of one split, and of one speaker or of all, in the split "test".
struct MovedSplit {
    Split from = Split::train;
    std::string speaker{};  // empty: all
};
inline void write_moved_corpus(const std::filesystem::path& folder, const MovedSplit& moved) {
    std::filesystem::copy(style_corpus(), folder, std::filesystem::copy_options::recursive);
    CorpusIndex index = read_corpus_index(folder);
    for (CorpusEntry& entry : index.entries) {
        const bool is_asked = moved.speaker.empty() || entry.speaker == moved.speaker;
        if (is_asked && entry.split == moved.from) entry.split = Split::test;
    }
    write_corpus_index(index);
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
    bool words = true;
};

// Inputs of `animate`, with words 100 frames of them: nobody says anything.
inline void write_inputs(const std::filesystem::path& file, const Silence& silence = {}) {
    Hdf5Writer writer(file, file.string());
    if (silence.words) {
        writer.write_texts("text_encoder", {silence.encoder});
        writer.write_floats("text", {100, kStyleText}, std::vector<float>(100 * kStyleText));
    }
    writer.write_floats("mel", {silence.rows, silence.bands},
                        std::vector<float>(silence.rows * silence.bands, -10));
    writer.write_number("mel_rate", silence.rate);
    writer.close();
}

}  // namespace chironomia::testing
