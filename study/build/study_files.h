// The files of a study's two folders.
#pragma once

#include <filesystem>
#include <vector>

#include "study/build/draft.h"
#include "study/build/videos.h"
#include "study/record/study_folder.h"

namespace chironomia::study {

// Fills an empty folder with all that participants may reach: equal in size within a clip, equal in time.
void write_public_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                        const std::filesystem::path& folder);

// key.json, plan.json, recordings.json, report.html, and at last manifest.json, for the public files of `study`.
void write_private_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                         const StudyFolder& study);

}  // namespace chironomia::study
