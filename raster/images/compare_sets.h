// Comparing results with stored references, file by file: what differs, what is missing, what is extra.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/shard.h"
#include "raster/images/compare_files.h"

namespace chironomia {

enum class CaseOutcome {
    same,
    different,   // beyond the limits, or not of one form
    missing,     // a reference without a result
    extra,       // a result without a reference
    unreadable,  // one of the two is damaged
};

const char* to_text(CaseOutcome outcome);

// The bytes of PNG files; empty where there is no such picture.
struct CasePictures {
    std::vector<std::byte> expected;
    std::vector<std::byte> actual;
    std::vector<std::byte> difference;
};

// One frame, sound or file that was expected.
struct CompareCase {
    std::string name;  // "walk/00012.png", "walk.mp4: frame 12", "walk.mp4: sound"
    CaseOutcome outcome = CaseOutcome::same;
    std::string message;                   // why it is not the same
    std::optional<FrameComparison> frame;  // of two frames
    std::filesystem::path expected;        // the file; empty if there is none
    std::filesystem::path actual;
    std::filesystem::path difference;      // the picture that was written; empty: none
    std::optional<CasePictures> pictures;  // kept for a report
};

struct SetOptions {
    CompareOptions compare = {};
    std::filesystem::path difference_folder = {};  // empty: no difference pictures
    size_t most_pictures = 0;                      // cases that keep their pictures, of those not the same
    Shard shard = {};                              // which part of the files of two folders is compared
    bool quiet = true;                             // no progress
};

struct CompareSet {
    std::vector<CompareCase> cases;  // by file name, then frame; a sound after its frames
    size_t files = 0;                // that exist on both sides

    size_t count(CaseOutcome outcome) const;
    bool all_same() const { return count(CaseOutcome::same) == cases.size(); }
};

// Two folders are matched by the relative names of their .png, .exr, .mp4 and .webm files, at any depth; names that
// begin with a dot are passed over. Anything else is one pair as compare_files knows it. What cannot be read is a case
// of its own in folders. A difference picture lies in the folder under the name of its file, "walk/00012.png" or
// "walk.mp4/00012.png"; those of earlier runs stay. Throws Error if one of the two is not there, if the folder for them
// lies in one that is compared, if both folders hold nothing to compare, if a part is asked for of anything but two
// folders, or if a picture cannot be written; for one pair, what reading it throws. Throws Interrupted if the user
// stops it.
CompareSet compare_sets(const std::filesystem::path& expected, const std::filesystem::path& actual,
                        const SetOptions& options = {});

// What became of references that were replaced.
struct SetUpdate {
    size_t changed = 0;
    size_t added = 0;
    size_t removed = 0;
    size_t kept = 0;  // the same bytes
};

// Makes the results the new references: `expected` becomes `actual`, whole or not at all, and one move puts it in
// place. A folder keeps what is not compared, such as a README or a link to one, and its permissions; where it has a
// link to a folder of references, that becomes a folder. `expected` may be missing. Throws Error if a result cannot be
// read, if there is none, if one is a file and the other a folder or a file with another ending, if one lies within the
// other, if `expected` holds a repository of its own or is a mount point, or if it cannot be written; then nothing has
// changed.
SetUpdate update_references(const std::filesystem::path& expected, const std::filesystem::path& actual);

}  // namespace chironomia
