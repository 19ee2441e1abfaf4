// Proves that a study is what it should be: complete, unchanged, blind and balanced.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"
#include "study/build/videos.h"
#include "study/plan/plan.h"

namespace chironomia::study {

// One property of a study.
struct Proof {
    std::string property;  // "the videos of a page are equally long"
    bool holds = false;
    std::string detail;  // what was counted, or the first thing that is wrong
    bool open = false;   // neither proved nor disproved, for the reason in `detail`; then `holds` is false
};

Proof yes(std::string_view property, std::string detail);
Proof no(std::string_view property, std::string detail);

struct CheckReport {
    std::filesystem::path folder;
    std::vector<Proof> proofs;

    bool passed() const;  // nothing is disproved
};

// What a study is built from again, to compare.
struct StudySource {
    Plan plan;
    ClipMaker maker;
    int jobs = 1;
    bool quiet = true;
};

// Reads the files. Of what the build recorded, only the key and the plan are trusted. That the
// pictures and sounds are those of the plan stays open without `again`; with it the study is built again, in
// a folder that is removed, and compared byte for byte. Throws Error if the folder holds no finished study,
// or its key or lists are damaged. Videos that are damaged are an answer, not an error.
CheckReport check_study(const std::filesystem::path& folder,
                        const std::optional<StudySource>& again = std::nullopt);

// A line per property: "yes", "NO" or "open", the property, the detail.
std::string to_text(const CheckReport& report);

// {"folder", "holds", "proofs": [{"property", "holds", "detail"}]}; "holds" of an open property is null.
Json to_json(const CheckReport& report);

}  // namespace chironomia::study
