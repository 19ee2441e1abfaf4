// A page for the researcher: what a study shows, which condition stands where, and every video with its condition.
#pragma once

#include <string>
#include <vector>

#include "study/build/draft.h"
#include "study/build/videos.h"

namespace chironomia::study {

// private/report.html: one page without scripts; its videos are those of ../public.
std::string make_report(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded);

}  // namespace chironomia::study
