// Intervals as models of style take them: 15 frames a second, normalised, points that were lost bridged. Records are
// read when they are asked for, and only the last used are kept, so that a corpus of any size can be learned from.
#pragma once

#include <torch/types.h>

#include <cstddef>
#include <list>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "synth/corpus/corpus.h"
#include "synth/corpus/statistics.h"
#include "synth/features/spectrum.h"
#include "synth/learned/styles/style_points.h"
#include "synth/learned/training/checkpoint.h"

namespace chironomia {

// Which mel spectrum a model hears.
enum class StyleMel {
    bands_128,  // PATS's log_mel_512
    bands_64,   // PATS's log_mel_400
    none,
};

// What 0 and 1 of each number stand for, which become 0 and 0.5 in the mean and at two standard deviations (A22).
struct StyleScales {
    FeatureScale mel;
    std::vector<FeatureScale> text;  // (768); empty: not wanted
    std::vector<FeatureScale> pose;  // (22) [px], shoulders of one width (A23)
    std::vector<FeatureScale> face;  // (30) alike; empty: not wanted
};

// Of the training records alone. Throws Error if a face is wanted and the corpus has none.
StyleScales style_scales(const CorpusIndex& corpus, StyleMel mel, bool wants_face);

// As the inputs and outputs of a checkpoint, and back.
void describe_scales(const StyleScales& scales, Checkpoint& checkpoint);
StyleScales scales_of(const Checkpoint& checkpoint);

// Pose and face alone, as features and back.
std::vector<Feature> point_features(const StyleScales& scales);
StyleScales point_scales(std::span<const Feature> features);

struct StyleForm {
    StyleMel mel = StyleMel::bands_128;
    MelResampling resampling = MelResampling::average;
    StyleScales scales;
};

// One interval of T frames.
struct StyleRecord {
    std::string id;
    std::string speaker;
    torch::Tensor mel;   // (T, 128 or 64) float16, normalised like all that follows, or undefined
    torch::Tensor text;  // (T, 768) float16, or undefined
    torch::Tensor pose;  // (T, 22)
    torch::Tensor face;  // (T, 30), or undefined
    torch::Tensor acts;  // (T, 38) 0 or 1, or undefined

    std::int64_t frames() const { return pose.size(0); }
    std::size_t bytes() const;
};

// Throws Error with the record if a face is wanted and it has none.
StyleRecord style_record(const IntervalRecord& record, const StyleForm& form);

// (T, C) normalised, float16. `values` (T, C), of one scale or of one for each column.
torch::Tensor normalised_rows(const std::vector<float>& values, std::span<const FeatureScale> scales);

// (T, F) in the units of the scales.
std::vector<float> restored_rows(const torch::Tensor& normalised, std::span<const FeatureScale> scales);

// The records of some entries of a corpus.
class StyleRecords {
  public:
    // Up to `kept_bytes` of records stay in memory.
    StyleRecords(const CorpusIndex& corpus, std::vector<CorpusEntry> entries, StyleForm form,
                 std::size_t kept_bytes = kUsualKeptBytes);

    // Of records that are all there already.
    explicit StyleRecords(std::vector<StyleRecord> records);

    const std::vector<CorpusEntry>& entries() const { return entries_; }
    // Frames by the index, which may differ by one from the file's.
    std::int64_t frames_of(std::size_t entry) const;
    // Throws Error as reading it does. The reference holds until the next call.
    const StyleRecord& at(std::size_t entry);

    static constexpr std::size_t kUsualKeptBytes = std::size_t{1} << 30;  // ours: half a GB an hour of speech

  private:
    const CorpusIndex* corpus_ = nullptr;  // none: nothing is left to read
    std::vector<CorpusEntry> entries_;
    StyleForm form_;
    std::size_t kept_bytes_;
    std::size_t bytes_ = 0;
    std::list<std::pair<std::size_t, StyleRecord>> kept_;  // the last used first
    std::unordered_map<std::size_t, decltype(kept_)::iterator> places_;
};

}  // namespace chironomia
