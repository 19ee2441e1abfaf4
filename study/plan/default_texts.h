// What a study says where its plan says nothing, in the languages of the page.
#pragma once

#include <string>
#include <vector>

#include "study/plan/plan.h"

namespace chironomia::study {

// "en", "fr"; a plan in any other language says everything itself.
const std::vector<std::string>& bundled_languages();
bool is_bundled(const std::string& language);

// The question of a layout in the words of pairwise and rating studies: with sound about the fit of movement
// and speech, without about realism alone. Relies on all of the plan but its questions and texts.
Question default_question(const Plan& plan);

std::string default_instructions(const Plan& plan);
// Of attention checks; {answer} stands for the answer to give.
std::string default_instruction(const std::string& language);
std::string default_instruction_of_video(const std::string& language);
// Of the button under a consent, as the page itself says it.
std::string default_agreement(const std::string& language);

// A text of the page itself (study/web/texts.js), which "texts" of a plan replaces. One that counts stands there as
// "pages.one" and "pages.other".
struct PageText {
    std::string name;
    std::string english;
};
const std::vector<PageText>& page_texts();

}  // namespace chironomia::study
