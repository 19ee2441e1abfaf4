// Attention checks: pages with a real clip that asks participants to give a certain answer.
#pragma once

#include <optional>
#include <string>

#include "core/files/json.h"
#include "study/plan/plan.h"

namespace chironomia::study {

// The answer that a check asks for. It is never the first or the middle one, which careless participants give most.
struct InstructedAnswer {
    Json value;        // as in the answers; for a question of each video that of the one video
    std::string text;  // as a participant reads it
    bool of_video = false;
};

// Nothing for questions whose answers have no short words: a text, a ranking, a choice among videos.
// `variant` 0, 1, ... asks for different answers.
std::optional<InstructedAnswer> instructed_answer(const Question& question, std::size_t variant = 0);

// What a check says and expects.
struct AttentionCheck {
    std::string instruction;
    // {question id: value} of the first question with an instructed answer and of all that have the same answers. Of a
    // question of each video the value is an array with null for the other videos.
    Json expected;
};

// `place` is the place of the video that holds the instruction, one of `places`.
AttentionCheck make_check(const Plan& plan, std::size_t variant, std::size_t place, std::size_t places);

}  // namespace chironomia::study
