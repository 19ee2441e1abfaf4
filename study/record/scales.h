// Scales of a questionnaire: several questions whose mean measures one thing, such as the five items of Godspeed's
// likeability. Participants see the questions alone; the analysis gives each scale a score.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "core/files/json_value.h"
#include "study/record/questions.h"

namespace chironomia::study {

struct Scale {
    std::string id;
    std::vector<std::size_t> items;  // questions, all rated alike
    std::vector<bool> reversed;      // of each item: its least value is the most of the scale
};

// Throws Error, naming the key, if a scale is not as docs/study_files.md says: with fewer than two items, with one that
// is no rating or slider of `questions` or is rated otherwise than the others, or with an id that is taken.
std::vector<Scale> read_scales(const JsonValue& list, const std::vector<Question>& questions);

Json to_json(const std::vector<Scale>& scales, const std::vector<Question>& questions);

// "Mean of friendly, kind and awful (reversed)."
std::string describe(const Scale& scale, const std::vector<Question>& questions);

// Whether a question is reversed in any scale.
bool is_reversed(const std::vector<Scale>& scales, std::size_t question);

// A value of a rating or a slider, turned round within its range.
double reversed_value(const Question& question, double value);

}  // namespace chironomia::study
