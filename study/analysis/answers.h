// The answers of participants as their files hold them. Each is checked when it is read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files/json.h"
#include "study/record/failed_checks.h"
#include "study/record/key.h"

namespace chironomia::study::analysis {

struct Respondent {
    std::string name;
    std::string file;  // from which these answers were read
    std::size_t sheet = 0;
    bool simulated = false;
    bool finished = false;
    Json questionnaire = Json::object();  // {question id: value}
    std::vector<PageAnswer> answers;
};

// What a file's name ends with, in small letters: ".json".
std::string extension_of(const std::filesystem::path& file);

struct AnswerFiles {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> notes;  // what else lies in the folders, which is not read
};

// The files that `paths` name: themselves, or all .json and .csv files in a folder, by name.
// Throws Error if one is missing, a folder has none, or a file is named twice.
AnswerFiles files_of_answers(const std::vector<std::filesystem::path>& paths);

// Throws Error if a folder for results holds answers: tables beside them would be read as answers later.
void refuse_folder_of_answers(const std::filesystem::path& results);

// All participants of all files; a file holds one of "chironomia answers 2" or a list of them. Of several files that a
// visit left while it went on, each the beginning of the next, the last one counts.
// Names are in one form (plain_name(), link_parameters.h).
// Throws Error, naming the file and the key, if an answer is not of this study, has an unknown page, video,
// question or reason, or a value off the scale of its question; if a participant, or a pass of a page, comes
// twice; or if only some participants are simulated.
std::vector<Respondent> read_answers(const std::vector<std::filesystem::path>& files, const StudyKey& key);

// Throws Error if the file is there and holds no answers, or answers of people that simulated ones would replace.
void require_replaceable(const std::filesystem::path& file, bool by_simulated);

}  // namespace chironomia::study::analysis
