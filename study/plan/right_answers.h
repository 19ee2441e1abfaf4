// Which answers are right by the design of a study. Participants never see them; the analysis counts them.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "study/plan/plan.h"

namespace chironomia::study {

// {question id: option id, or of videos the name of a condition} of a page; questions without a right answer there are
// left out.
std::map<std::string, std::string> right_answers_on(const Plan& plan, std::size_t clip,
                                                    const std::vector<std::size_t>& conditions);

}  // namespace chironomia::study
