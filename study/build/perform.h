// What the engines make for a study before anything is recorded: the clips of conditions that are performed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/files/scratch_folder.h"
#include "study/plan/plan.h"

namespace chironomia::study {

// What of the script of a clip is not shown.
struct ClipNote {
    std::size_t clip = 0;
    std::string text;
};

struct PerformedClips {
    Plan plan;  // with the motions that were performed, and a sound for each clip that has a text
    std::vector<ClipNote> notes;
    std::optional<ScratchFolder> folder;  // holds the files that were made
};

// All manners perform the same words in the same voice with the same choices; of one clip they differ in their
// speakers and manners alone. Models of style perform those words too, or what an interval of PATS says. The same plan
// gives the same bytes. Throws Error as `synthesize` does, and of speakers whom Mix-StAGE has not learned from before
// anything is made.
PerformedClips perform_clips(const Plan& plan);

}  // namespace chironomia::study
