// Whether something beside pictures and sound reveals the conditions of a study.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia::study {

// What anybody can know of a video without playing it.
struct VideoTraits {
    std::size_t clip = 0;
    std::size_t condition = 0;
    std::vector<double> traits;  // as many for every video, of any unit
};

struct Prediction {
    std::string trait;    // what predicts best
    double hit_rate = 0;  // share of videos whose condition it predicts rightly
    double chance = 0;    // mean of that over shuffled conditions
    double p = 1;         // share of shuffled studies in which some trait predicts as well or better
    std::size_t videos = 0;
    std::size_t shuffles = 0;
};

// Leaves one clip out at a time, learns from the others how large each trait (its rank within its clip) is
// for each condition, and predicts the videos of the clip by the nearest of them: by each trait alone and by
// all together. The best of these is compared with the best for the same videos with conditions that are
// shuffled within clips (a permutation test of the maximum), which corrects for testing many traits.
// Every clip has a video of each condition, and there are at least 2 clips.
//   names   of the traits
Prediction predict_conditions(const std::vector<VideoTraits>& videos, const std::vector<std::string>& names,
                              std::size_t shuffles, std::uint64_t seed);

// By names of files, their sizes, the tables in their containers, and places in lists and orders.
Proof check_prediction(const StudyRecord& study);

}  // namespace chironomia::study
