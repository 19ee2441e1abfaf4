// What the pages of a study were, as private/key.json tells it (docs/study_files.md): the parts that the
// server and the exports need.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "study/server/study_pages.h"

namespace chironomia {

struct KeyedPlace {
    std::string condition;
    std::string video;  // token
};

struct KeyedCondition {
    std::string name;
    std::string from;  // the condition that it was made of; empty: it was given
    std::string made;  // how: "mismatched speech", ...
};

struct KeyedClip {
    std::string clip;
    std::string speech;  // the clip whose speech it has
};

struct KeyedStudyPage {
    std::string page;
    std::string kind;  // "trial", "check", "practice"
    std::string clip;
    std::vector<KeyedPlace> places;  // as if the videos stood in the order of pages.json
    Json expected;                   // of a check: {question: value}; null otherwise
};

struct StudyKey {
    std::string secret;  // by which names become tokens
    std::vector<KeyedCondition> conditions;
    std::map<std::string, KeyedClip> videos;  // by token
    std::vector<KeyedStudyPage> pages;        // those of pages.json in the same order
    int failed_checks = 1;                    // so many and more fail a participant
    std::optional<double> fastest_seconds;    // a page that was answered faster counts as failed check [s]
};

// Throws Error, naming the file and the key, if the file is missing, of another format, or not the key of
// `pages`.
StudyKey read_study_key(const std::filesystem::path& file, const StudyPages& pages);

}  // namespace chironomia
