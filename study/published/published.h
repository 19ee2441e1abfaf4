// The results that papers print (study/published), to stand beside ours.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace chironomia::study {

inline const std::vector<std::string> kPublishedStatistics{"mean", "median",     "sd",   "least",
                                                           "most", "difference", "share"};

struct PublishedRow {
    std::string name;                  // as the paper calls it
    std::string model;                 // as checkpoints are called: "amii-noE_m"; "": none that we have
    std::string feature;               // "AU1"; "": all together
    std::vector<std::string> answers;  // of a question: the options that mean this row; none: any
    std::string preset;  // of a study that is a preset of ours, whose questions the columns are; empty: none
    std::string statistic;                 // of that study: one of kPublishedStatistics
    std::map<std::string, double> values;  // by the key of a column
};

struct PublishedTable {
    std::string id;        // the file's name: "amii"
    std::string source;    // the paper
    std::string place;     // "Table 1, section 5"
    std::string corpus;    // on whom it was measured
    std::string preset;    // of a study that is a preset of ours; empty: none
    std::string question;  // of that preset, whose answers the rows name
    std::string note;
    std::vector<std::pair<std::string, std::string>> columns;  // key, title
    std::vector<PublishedRow> rows;
};

// All bundled tables, by id.
const std::vector<PublishedTable>& published_tables();

// The results of a question of a preset; none: nothing is printed of it.
const PublishedTable* published_answers(std::string_view preset, std::string_view question);

// What is printed for a metric of a model, all features together where `feature` is "".
std::optional<double> published_value(std::string_view model, std::string_view feature,
                                      const std::string& metric);

}  // namespace chironomia::study
