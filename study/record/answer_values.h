// The values of answers: whether they are on the scale of their question, and which values they have in the order of
// the page's places.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/record/page_kinds.h"
#include "study/record/questions.h"

namespace chironomia::study {

// The least and the most answer to a question for a number where it names none: what is further off is a slip, and its
// square would be too large to compute with. As in study/web/questions.js.
inline constexpr int kFarthestNumber = 1'000'000'000;

// What is needed, if `value` does not answer the question on a page of so many places: "a whole number from 1 to 5 is
// needed". "" if it does; null answers an optional question.
std::string fault_of_answer(const Question& question, const Json& value, std::size_t places);

// What is wrong with `given` as the reasons for `value`, an answer to a question that asks for reasons: "smooth is none
// of its reasons, or is there twice". `given`: {"chosen": [...], "other": "..."}, or null where none were given; `value`
// may be null, too, which needs none. "" if nothing is.
std::string fault_of_reasons(const Question& question, const Json& value, const Json& given);

// How far an answer to a preference is from equal: above 0 towards the left video. Without an answer in the
// middle the nearest are 1 and -1.
int steps_towards_left(int value, std::size_t answers);

// Whether the first and the last place changed sides.
bool is_mirrored(const std::vector<std::size_t>& order);

// Whether an answer goes from the left video to the right one, so that it changes when they change places: a
// preference, and a rating or a slider that is `sided`. One that does not say so is if it is a rating of a triplet.
bool names_a_side(const Question& question, Layout layout);

// The value as if the videos had stood in the order of the places. `order`: the places from left to right as
// shown. A value that names a side is mirrored or moved, an array permuted; others stay.
Json to_places(const Json& value, const Question& question, const std::vector<std::size_t>& order,
               Layout layout);

// The other way round: the value as a participant gives it who sees the places in that order.
Json to_shown(const Json& value, const Question& question, const std::vector<std::size_t>& order,
              Layout layout);

// How far from the expected value the answer to an attention check may be: on a slider from 0 to 100 by 3, as HEMVIP
// allows (lib/webmushra/pages/VideoPage.js), on others by 3 % of their width; else by nothing.
int check_tolerance(const Question& question);

// Whether the value, as to_places() gives it, is the expected one. Null in an expected array means any value.
bool is_as_expected(const Json& value, const Json& expected, const Question& question);

}  // namespace chironomia::study
