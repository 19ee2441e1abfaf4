// `study forget`: the operator deletes a participant from the database, from copies of it, and from files of answers.
// Who withdraws on the page is deleted by Site::withdraw().
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace chironomia::study::server {

struct ForgetJob {
    std::filesystem::path study;              // its folder
    std::filesystem::path database;           // empty: private/answers.sqlite
    std::string name;                         // as the answers have it; or the PROLIFIC_PID
    std::vector<std::filesystem::path> also;  // more files of answers and copies of the database
};

struct ForgetSummary {
    std::string name;                            // as the answers have it
    bool was_in_database = false;                // if not: withdrawn, or deleted before
    std::size_t answers = 0;                     // that the database held
    std::vector<std::filesystem::path> changed;  // files that held the participant
    std::vector<std::filesystem::path>
        elsewhere{};                             // those of them that had other names, which still hold it
    std::vector<std::filesystem::path> removed;  // folders of results that were made with those answers
    std::vector<std::filesystem::path> naming;   // files of private/ in which the name still stands
};

// Deletes the participant of that name from the database, while a server runs or not, from every copy of the database
// and every file of answers in private/ and in `also`, and removes private/analysis if it names the participant. Throws
// Error, and deletes nothing, if there is no database, nobody of that name in it or in `also`, or several, or a file of
// `also` cannot be read or holds no answers to this study.
ForgetSummary forget_participant(const ForgetJob& job);

// The same in the copies and the files of answers in private/ alone; `database` is left as it is. Returns what was
// changed.
std::vector<std::filesystem::path> forget_in_copies(const std::filesystem::path& study,
                                                    const std::filesystem::path& database,
                                                    const std::string& name);

}  // namespace chironomia::study::server
