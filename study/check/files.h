// Hashes, listed files, key, instructions, page data, texts, tokens, names, traces, sides and orders of a study. For
// check.cpp alone.
#pragma once

#include "study/check/check.h"
#include "study/record/study_record.h"

namespace chironomia::study {

Proof check_files_unchanged(const StudyRecord& study);
Proof check_nothing_else_public(const StudyRecord& study);
Proof check_key_complete(const StudyRecord& study);
Proof check_instructions(const StudyRecord& study);
Proof check_videos_match_key(const StudyRecord& study);
Proof check_page_data(const StudyRecord& study);
Proof check_page_texts(const StudyRecord& study);
Proof check_tokens(const StudyRecord& study);
Proof check_no_names_in_page(const StudyRecord& study);
Proof check_traces(const StudyRecord& study);
Proof check_sides(const StudyRecord& study);
Proof check_orders(const StudyRecord& study);

}  // namespace chironomia::study
