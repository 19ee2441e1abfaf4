// What a folder of motions has in common: means over its files, and all their poses together.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/body/motion.h"
#include "core/files/json.h"
#include "study/measure/movement.h"
#include "study/models/evaluation_motion.h"

namespace chironomia::study {

// The mean over the files of a folder, which `of` names, of each number, of features that all files have. The notes say
// what was left out, and how many files have no PCC or the like.
MotionMeasures mean_of(const std::string& of, std::span<const MotionMeasures> all);

// The upper bodies of many pairs of a motion and its reference, in widths of the shoulders and relative to their
// middle: all poses of the ones against all of the others, by the squared Frechet distance (frechet.h), and so the
// changes from frame to frame, at the rates of the references. No learned encoder is in between, so these are not the
// FGD of papers.
class PoseClouds {
  public:
    PoseClouds();

    void add(const Motion& motion, const Motion& reference);
    // As a row of `near`: null where there are too few frames. None without a pair that has both shoulders. A point
    // counts if all files have it, depth if all have it.
    std::optional<Json> row() const;

  private:
    struct Cloud {
        PointPaths poses, changes;
    };

    std::vector<bool> shared_;  // by point of the upper body
    bool flat_ = false;
    Cloud people_, model_;
};

}  // namespace chironomia::study
