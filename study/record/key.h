// The key of a study, private/key.json (docs/study_files.md): which condition stands where, and what the
// design was drawn from. Here it is written, and all that serves, exports, checks or analyses a study reads it here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json.h"
#include "study/design/design.h"
#include "study/record/page_kinds.h"
#include "study/record/pages.h"
#include "study/record/questions.h"
#include "study/record/scales.h"

namespace chironomia::study {

inline constexpr std::string_view kKeyFormat = "chironomia key 2";

struct KeyCondition {
    std::string name;
    std::optional<std::size_t> from;  // the condition that this one was made of
    std::string made;                 // how: "mismatched speech"; empty: it was given
};

struct KeyVideo {
    std::string token;
    std::string file;  // below public/
    std::string clip;
    std::string motion;                   // the clip whose motion it shows
    std::string speech;                   // the clip whose sound it has
    std::vector<std::size_t> conditions;  // 1, or 2: left and right
    std::string instruction;              // of an attention check, given in the video; empty: none
    bool is_spoken = false;               // the instruction
    std::size_t frames = 0;
    double seconds = 0;
    std::string sha256;
};

struct KeyPlace {
    std::size_t condition = 0;
    std::string video;  // token
};

struct KeyPage {
    std::string token;
    PageKind kind = PageKind::trial;
    std::string clip;
    std::size_t block = 0;
    std::vector<KeyPlace> places;  // from left to right, as if the videos stood as in pages.json
    Json expected;                 // of a check: {question id: value}; null otherwise
    std::map<std::string, std::string> right{};  // by question the option, or the condition, that is right
};

struct ExclusionRules {
    std::size_t failed_checks = 1;          // so many failed checks and more exclude a participant
    std::size_t lenient_failed_checks = 2;  // the same by the milder rule
    std::optional<double> fastest_seconds;  // a pass that was answered faster counts as a failed check [s]
};

struct StudyKey {
    std::string study;   // its token
    std::string secret;  // by which names become tokens
    std::uint64_t seed = 0;
    std::string preset;  // the protocol that the plan was filled from; empty: none
    Layout layout = Layout::single;
    std::vector<KeyCondition> conditions;
    std::optional<std::size_t> reference;   // in the middle of a triplet
    Json modes = Json::object();            // by condition, what of the figures is shown
    std::vector<std::string> clips;         // ids of those that are judged
    DesignShape shape;                      // numbers of `clips` and `conditions`
    std::vector<std::string> secret_names;  // that no participant may read
    std::vector<Question> questions;
    std::vector<Scale> scales;  // of `questions`
    ExclusionRules exclusions;
    std::optional<std::size_t> participants;  // that are wanted
    std::vector<KeyVideo> videos;
    std::vector<KeyPage> pages;  // those of pages.json in the same order
};

// Throws Error, naming the file and the key, if it is missing, of another format, or names a condition, a clip or a
// video that it does not list.
StudyKey read_study_key(const std::filesystem::path& file);

void write_study_key(const std::filesystem::path& file, const StudyKey& key);

// Throws Error if `key`, which was read from `file`, is not the key of `pages`.
void require_same_study(const std::filesystem::path& file, const StudyKey& key, const StudyPages& pages);

std::vector<std::string> condition_names(const StudyKey& key);

// "ours and baseline": some of the conditions, by their indices.
std::string names_of(const std::vector<KeyCondition>& all, const std::vector<std::size_t>& conditions,
                     std::string_view between = " and ");

// The name of the condition that stands at a place.
const std::string& condition_at(const StudyKey& key, const KeyPlace& place);

// Opaque names for other front ends, in place of those that participants may not read: always the same.
std::string condition_token(const StudyKey& key, const std::string& condition);  // "S0a1b2c3d"
std::string clip_token(const StudyKey& key, const std::string& clip);

// The video of a token that the key lists.
const KeyVideo& video_named(const StudyKey& key, std::string_view token);

}  // namespace chironomia::study
