// All decisions about a study, made before anything is recorded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/build/composition.h"
#include "study/build/inputs.h"
#include "study/build/perform.h"
#include "study/build/videos.h"
#include "study/plan/plan.h"

namespace chironomia::study {

struct StudyDraft {
    Plan plan;
    std::uint64_t seed = 0;
    std::vector<InputFile> inputs;
    std::string key;  // the secret behind the names
    Composition all;
    std::vector<Video> videos;
    // indices into `videos`: one per place, or one for both
    std::vector<std::vector<std::size_t>> videos_of_page;
    std::string name;  // opaque, as all that follow
    std::vector<std::string> names_of_pages;
    std::vector<std::string> names_of_sounds;  // of the sound check
    PerformedClips performed;                  // what `videos` are recorded from
    std::string recipe;                        // SHA-256 of all that decides the study's bytes
};

// Performs what is to be performed, reads every motion and hashes every input. Throws Error if one is broken.
StudyDraft draft_study(const Plan& plan, std::uint64_t seed, const ClipMaker& maker);

}  // namespace chironomia::study
