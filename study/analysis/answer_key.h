// What a study was: private/key.json, the part of it that tells answers apart (docs/study_files.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "study/questions.h"

namespace chironomia {

struct KeyCondition {
    std::string name;
    std::optional<std::size_t> from;  // the condition that this one was made of
    std::string made;                 // how: "mismatched speech"; empty: it was not
};

struct KeyPlace {
    std::size_t condition = 0;
    std::string video;  // token
};

struct KeyPage {
    std::string token;
    std::string kind;  // "trial", "check", "practice"
    std::string clip;
    std::size_t block = 0;
    std::vector<KeyPlace> places;
    Json expected;  // of a check: {question id: value}, or one value for every question
};

struct ExclusionRules {
    std::size_t failed_checks = 1;  // so many failed checks exclude a participant
    std::size_t lenient_failed_checks = 2;
    std::optional<double> fastest_seconds;  // a pass that was answered faster counts as a failed check
};

struct AnswerKey {
    std::string study;
    std::uint64_t seed = 0;
    std::string layout;
    std::vector<KeyCondition> conditions;
    std::optional<std::size_t> reference;  // in the middle of a triplet
    std::vector<Question> questions;
    ExclusionRules exclusions;
    std::vector<KeyPage> pages;
};

// Throws Error, naming the file and the key, if it is no "chironomia key 2" or names a condition that it does
// not list.
AnswerKey read_answer_key(const std::filesystem::path& file);

}  // namespace chironomia
