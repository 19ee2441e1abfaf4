// Answers joined with what was shown: conditions instead of sides. All that is analysed comes from here,
// whichever files it was read from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/analysis/answers.h"
#include "study/record/key.h"
#include "study/record/scales.h"

namespace chironomia::study::analysis {

// Of two conditions, which one a participant preferred.
struct Preference {
    std::size_t participant = 0;
    std::size_t question = 0;
    std::size_t unit = 0;   // the page
    std::size_t first = 0;  // condition; the lower of the two
    std::size_t second = 0;
    std::size_t left = 0;  // which of them stood left
    std::string clip;
    // Steps of the question from equal towards the first: of five answers 2: the first clearly, 1: slightly, 0: equal,
    // -1, -2; of seven 3 to -3.
    int strength = 0;
    std::vector<std::string> reasons;
    std::string other_reason;
};

// A number given to a cell: a condition, or of a triplet a pair of them.
struct Score {
    std::size_t participant = 0;
    std::size_t question = 0;
    std::size_t cell = 0;
    std::size_t unit = 0;   // the page, and which of its videos
    std::size_t place = 0;  // from left as shown
    double value = 0;
};

// An answer that has all items of a scale. Its mean is the score.
struct ScaleAnswer {
    std::size_t participant = 0;
    std::size_t question = 0;  // the scale
    std::size_t cell = 0;
    std::string clip;
    std::vector<double> items;  // reversed items turned round
};

struct Choice {
    std::size_t participant = 0;
    std::size_t question = 0;
    std::size_t unit = 0;
    std::vector<std::size_t> conditions;  // that were shown
    std::string option;                   // id; of videos the name of the condition
};

// An answer on a page that has a right one by its design.
struct JudgedAnswer {
    std::size_t participant = 0;
    std::size_t question = 0;
    std::string given;         // the option; of videos the condition chosen or put first, "" if several were
    std::string right;         // the same
    std::size_t possible = 0;  // how many answers there were
};

// An answer as in answers.csv, with what no analysis counts: texts, and the conditions by side.
struct AnswerRow {
    std::size_t participant = 0;
    std::size_t question = 0;
    std::size_t block = 0;
    std::size_t trial = 0;  // index among the answers of the participant
    PageKind kind = PageKind::trial;
    std::string clip;
    std::string conditions;         // from left to right as shown, with | between
    std::string value;              // as given
    std::string value_of_places;    // with the videos in the order of the key
    std::optional<double> seconds;  // on the page; none: unknown
};

struct Rater {
    std::string name;
    std::string file;
    bool finished = true;
    std::size_t answered = 0;  // passes
    std::size_t skipped = 0;
    std::optional<double> median_seconds;  // on a page; none: unknown
    std::vector<FailedCheck> failed;
    Json questionnaire = Json::object();  // {question id: value}; an answer that was left open may be null
};

struct Dataset {
    std::string study;
    std::string preset;  // the protocol of the study; empty: none
    bool simulated = false;
    std::uint64_t seed = 42;
    std::vector<KeyCondition> conditions;
    // Those of the key, those that other passes ask again, and scales as if they were asked.
    std::vector<Question> questions;
    // Of a question that several passes ask its index for each: by its index in the key and the pass.
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> of_passes;
    // Those of the key; of a scale that several passes ask one for each of them.
    std::vector<Scale> scales;
    std::vector<std::optional<std::size_t>> passes_of_scales;  // of each; none: of whichever pass asks it
    std::vector<Question> questionnaire;                       // asked at the end
    std::vector<std::string> cells;  // labels of scores; the first are the conditions
    // Cells of two conditions whose scores go from the second to the first, so that the middle of the scale says that
    // they are equal.
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> sided_cells;
    // Of cells about a ranked option its text: only scores of the same option are compared.
    std::map<std::size_t, std::string> option_of_cell;
    std::vector<std::string> units;  // ids of pages and videos
    std::vector<Rater> raters;
    ExclusionRules rules;
    std::vector<Preference> preferences;
    std::vector<Score> scores;  // of scales, too
    std::vector<ScaleAnswer> scale_answers;
    std::vector<Choice> choices;
    std::vector<JudgedAnswer> judged;
    std::vector<AnswerRow> rows;
    std::vector<std::string> notes;  // what was left out and why

    std::size_t first_scale() const { return questions.size() - scales.size(); }
    bool is_scale(std::size_t question) const { return question >= first_scale(); }
    std::size_t index_of(std::size_t question, std::size_t pass) const;  // of a question of the key
    std::size_t asked_as(std::size_t question) const;  // the other way: its index in the key
    bool is_item(std::size_t question) const;          // of any scale
};

// The names of conditions that are shown together, in the order of the plan: "base + ours".
std::string label_of(const Dataset& data, std::vector<std::size_t> conditions);

// Replaces sides by conditions. A score that names a side (answer_values.h), such as the similarity to A or B of a
// triplet, is for that one of the two that comes first in the key: where that stands first on the page the score is
// reversed, so that the highest score always means "the first", or "like the first".
// `pages`, of the same build, say which questions a pass asks: a note counts those that were left out. They say what
// a sheet shows: people who lack answers of it have not finished, and a note says so.
// A question that several passes ask is one for each of them, "natural-pass-2", and so is a scale of such questions.
// A note names questions of which neither the key nor the layout says whether they name a side.
// Throws Error if an answer is to a pass, or a participant had a sheet, that does not exist, if the sheet does not show
// a page that is answered, or shows its videos in another order, if a pass does not ask what is answered, or an answer
// at the end fits no question.
Dataset join_answers(const StudyKey& key, const StudyPages& pages,
                     const std::vector<Respondent>& participants);

}  // namespace chironomia::study::analysis
