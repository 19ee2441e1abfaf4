// Attention checks: pages with a real clip that tells participants which answer to give.
#pragma once

#include <optional>
#include <string>

#include "core/files/json.h"
#include "study/plan/plan.h"

namespace chironomia {

// The answer that a check can ask for, never the first or the one in the middle, which who does not look
// gives most.
struct ToldAnswer {
    Json value;        // as in the answers; for a question of each video that of the one video
    std::string text;  // as a participant reads it
    bool of_video = false;
};

// Nothing if no answer can be told in words: a text, a ranking, a choice among videos.
// `variant` 0, 1, ... asks for different answers.
std::optional<ToldAnswer> told_answer(const Question& question, std::size_t variant = 0);

// What a check says and expects.
struct AttentionCheck {
    std::string instruction;
    Json expected;  // {question id: value} of all questions that have the same answers as the first that can
                    // be told; of a question of each video an array with null for the other videos
};

// `place` is the place of the video that holds the instruction, one of `places`.
AttentionCheck make_check(const Plan& plan, std::size_t variant, std::size_t place, std::size_t places);

}  // namespace chironomia
