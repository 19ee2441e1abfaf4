// Segments of intervals, as models of style learn from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "synth/learned/styles/style_records.h"
#include "synth/learned/styles/zs_mstm.h"
#include "synth/learned/training/trainer.h"

namespace chironomia {

struct StyleWindow {
    std::size_t entry = 0;   // of the records
    std::int64_t first = 0;  // frame
};

// The segments of `frames` frames of each record, `hop` apart; PATS's rule: those that begin before `frames` frames
// from the end (A20). A record that is no longer than a segment has one.
std::vector<StyleWindow> style_windows(const StyleRecords& records, std::int64_t frames, std::int64_t hop);

// Those that models learn from and are chosen by: whole ones, of the records that are longer than a segment, as PATS's
// loader has them. Throws Error if there is none; `of_what` names the records.
std::vector<StyleWindow> whole_windows(const StyleRecords& records, std::int64_t frames, std::int64_t hop,
                                       const std::string& of_what);

// The segments side by side; one that ends after its record goes on with the record's last frame.
StyleSegments gather(StyleRecords& records, std::span<const StyleWindow> windows, std::int64_t frames);

// In which order an epoch goes through the segments, and of which other segment each takes its style.
struct StyleEpoch {
    std::vector<Batch> batches;
    std::vector<std::size_t> style_of;  // of each segment: a segment of the same speaker
};

struct EpochPlan {
    std::size_t batch = 24;
    double same_share = 0.5;  // of the segments that take their style from themselves (A55)
    std::size_t group_bytes = StyleRecords::kUsualKeptBytes / 2;
};

// Every segment once. Records are drawn in groups that fit in memory; segments are in a random order within their
// group, and take their styles from it.
StyleEpoch draw_epoch(const StyleRecords& records, const std::vector<StyleWindow>& windows,
                      const EpochPlan& plan, Random& random);

// Batches of an epoch with as many segments of every speaker (within one), by turns; which ones is drawn anew for each.
struct EqualPlan {
    std::size_t batch = 16;
    std::size_t batches = 3000;
};
std::vector<Batch> draw_equally(const StyleRecords& records, const std::vector<StyleWindow>& windows,
                                const EqualPlan& plan, Random& random);

}  // namespace chironomia
