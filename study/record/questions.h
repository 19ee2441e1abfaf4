// What participants are asked on a page: the kinds of questions. Their form in plans, in pages.json and in key.json is
// docs/study_files.md; which values answer them is answer_values.h.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/files/json.h"
#include "core/files/json_value.h"

namespace chironomia::study {

enum class QuestionKind { preference, rating, slider, choice, rank, text, number };

const std::string& to_text(QuestionKind kind);  // as plans write it

struct QuestionOption {
    std::string id;
    std::string text;
};

// Why a preference was given.
struct Reasons {
    std::string text;
    std::vector<QuestionOption> options;
    std::string other;  // of a free answer; empty: there is none
    int unless = 0;     // the answer that needs no reason; 0: every one does
};

struct Question {
    std::string id;
    QuestionKind kind = QuestionKind::preference;
    std::string text;
    bool optional = false;
    bool each = false;                 // rating, slider: of every video by itself
    std::optional<bool> sided;         // rating, slider: from the left video to the right one; none: not said
    std::vector<std::string> answers;  // preference: from the left one clearly to the right one clearly
    std::optional<Reasons> reasons;    // preference
    int points = 0;                    // rating: 1 to this
    std::map<int, std::string> labels;  // rating: of some points
    std::vector<std::string> marks;     // slider: from the most down to the least
    std::optional<int> least;           // slider, number
    std::optional<int> most;
    std::vector<QuestionOption> options;  // choice, rank; empty: of the videos
};

struct ScoreRange {
    int least = 0;
    int most = 0;
};

// Of a rating or a slider.
ScoreRange range_of_scores(const Question& question);

// An id goes into tables and names of files. Throws Error if it has other signs than letters, digits, - and _.
std::string read_id(const JsonValue& value);

// Throws Error, naming the key, if a question is not as docs/study_files.md says.
Question read_question(const JsonValue& value);

// Throws Error also if two have the same id, or there are fewer than `at_least`.
std::vector<Question> read_questions(const JsonValue& list, std::size_t at_least);

// Throws Error if a preference cannot have so many answers: 2, or an odd number up to 9.
void require_sides(const JsonValue& answers, std::size_t count);

Json to_json(const Question& question);
Json to_json(const std::vector<Question>& questions);

// Whether the options of a choice or a ranking are the videos as shown.
bool is_of_videos(const Question& question);

// Every text of the question that a participant reads.
std::vector<std::string> texts_of(const Question& question);

// The keys that the reader knows, of every kind.
const std::vector<std::string>& question_keys();

}  // namespace chironomia::study
