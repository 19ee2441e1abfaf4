// A plan from what a challenge has: a folder of motions for each system, a folder of sounds, and a table of segments,
// as GENEA's leaderboard has them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.h"

namespace chironomia::study {

// The motions of one condition.
struct ConditionFolder {
    std::string name;
    std::filesystem::path folder;
};

struct FoldersJob {
    std::vector<ConditionFolder> conditions;
    std::filesystem::path audio;            // empty: the clips have no sound
    std::filesystem::path partner{};        // motions of the partners; empty: nobody else is there
    std::filesystem::path partner_audio{};  // empty: the sounds of `audio` are of both
    std::filesystem::path segments;         // CSV
    std::string preset;                     // the protocol
    std::optional<double> fps{};            // of motions without a rate; the plan's "hints" have it then
    std::filesystem::path plan_folder;      // what paths in the plan are relative to
};

struct FoldersPlan {
    Json plan;
    std::size_t segments = 0;             // of the table
    std::size_t clips = 0;                // of the plan
    std::vector<std::string> notes;       // what was chosen
    std::vector<std::string> mismatches;  // what fits nothing, each one sentence; such segments are no clips
};

// The table has the columns file_name, start_seconds and end_seconds; duration_seconds, speaker and partner_file_name
// may be there. The files of a segment are those of its name, whatever their endings and their form of Unicode; those of
// the partner have the name in partner_file_name, or else the same name, or the same with "interloctr" for "main-agent",
// as in the data of GENEA 2023. Where a system gives
// several motions for a name ("NAME_sample_0.npz", ...) its first segment takes the first of them, its second the
// second, and after the last comes the first again. A speaker that the table does not name is read from names such as
// "2_scott_0_1_1". The id of a clip is the name with the first and the last frame at 30 frames a second, as in GENEA's
// votes. A participant sees at most as many pages as there are clips, whatever the protocol says. Each motion is read,
// to see whether it lasts to the end of its segments; a condition whose motions have no rate gets a hint with `fps`. A
// sound may end before: it has one note with the worst of its segments. Throws Error, with file and line, if a folder or
// the table cannot be read, a row of the table is wrong or makes the same clip as another, or no clip is left.
FoldersPlan plan_from_folders(const FoldersJob& job);

}  // namespace chironomia::study
