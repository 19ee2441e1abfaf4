// What a model of style keeps apart: maps of its encodings, and how well speakers are found in them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/analysis/table.h"
#include "study/measure/vectors/probes.h"
#include "study/measure/vectors/vectors.h"

namespace chironomia::study {

// What encode_styles answers (synth/learned/styles/style_encodings.h).
struct StyleEncodings {
    std::string model;
    std::vector<std::string> speakers;            // (N)
    std::vector<std::string> intervals;           // (N) the interval that a segment is of, by its name
    Vectors style, content;                       // (N, S), (N, C)
    std::map<std::string, Vectors> modalities{};  // (N, of its own width): "speech", "text", "pose", "face"
    // (N, S) what the adversary guesses of `style` from `content`; none: there was no adversary.
    std::optional<Vectors> guess{};
};
// Throws Error as the file's arrays are missing or of another shape.
StyleEncodings read_encodings(const std::filesystem::path& file, const std::string& model);

// Of h_style, of the modalities that it is made of, and of h_content, which should not give the speaker away: the
// silhouette of the speakers, the share of segments that most of their five nearest of other intervals give the right
// speaker, and a linear probe that learns from two of three intervals of each speaker. Of h_content the variance of
// h_style that the adversary explains, too. Without any of these of a single speaker, and without a probe where the
// segments that it learns from are of one, or where no speaker has three intervals.
analysis::Table encodings_table(const std::vector<StyleEncodings>& all);

// What a classifier of styles says of a model's clips (synth/learned/styles/style_classifier.h).
struct StyleJudgement {
    std::string model;
    std::size_t clips = 0;      // in the style of another speaker
    std::size_t as_style = 0;   // taken for that speaker's
    std::size_t as_source = 0;  // taken for their source's
};

// Transfer strength accuracy (Fares 2023, section 7.5.1), with the classifier's accuracy on people's own clips, in
// percent.
analysis::Table strength_table(const std::vector<StyleJudgement>& all, double own_accuracy);

// FOLDER/<model>-style.svg and .csv, FOLDER/<model>-content.svg and .csv and those of the modalities: exact t-SNE. Of a
// modality, segments of equal vectors are left out, such as those without words, and there is no map of fewer than 7
// others. Throws Error as tsne() does or if a file cannot be written.
void write_style_maps(const std::filesystem::path& folder, const StyleEncodings& encodings);

}  // namespace chironomia::study
