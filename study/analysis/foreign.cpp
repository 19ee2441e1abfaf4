#include "study/analysis/foreign.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "study/analysis/simulated_rater.h"
#include "synth/speech/utf8.h"

namespace chironomia::study::analysis {
namespace {

namespace fs = std::filesystem;

std::size_t condition_named(Dataset& data, const std::string& name) {
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        if (data.conditions[i].name == name) return i;
    }
    data.conditions.push_back({.name = name});
    return data.conditions.size() - 1;
}

std::size_t unit_named(Dataset& data, const std::string& name) {
    const auto found = std::find(data.units.begin(), data.units.end(), name);
    if (found == data.units.end()) data.units.push_back(name);
    return static_cast<std::size_t>(std::find(data.units.begin(), data.units.end(), name) -
                                    data.units.begin());
}

std::size_t question_with(Dataset& data, Question question) {
    for (std::size_t i = 0; i < data.questions.size(); ++i) {
        if (data.questions[i].id == question.id) return i;
    }
    data.questions.push_back(std::move(question));
    return data.questions.size() - 1;
}

std::size_t rater_named(Dataset& data, const std::string& name, const std::string& file) {
    for (std::size_t i = 0; i < data.raters.size(); ++i) {
        if (data.raters[i].name == name) return i;
    }
    data.raters.push_back({.name = name, .file = file});
    return data.raters.size() - 1;
}

Question preference_question() {
    return {.id = "preference",
            .kind = QuestionKind::preference,
            .text = "Which one is preferred?",
            .answers = {"left clearly", "left slightly", "equal", "right slightly", "right clearly"}};
}

void require_utf8(const fs::path& file, std::string_view text) {
    const auto fault = fault_in_utf8(text);
    if (!fault) return;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(*fault), '\n');
    throw Error(format("{}:{}: the byte {:#04x} is no UTF-8; save the file as UTF-8", file.string(), line,
                       static_cast<unsigned char>(text[*fault])));
}

// One line of battles.csv by the names of its columns.
class Battle {
  public:
    Battle(const CsvTable& table, const CsvRow& row) : table_(table), row_(row) {}

    [[noreturn]] void refuse(const std::string& what) const { throw Error(table_.at(row_) + what); }

    std::string at(const std::string& column) const {
        const auto found = std::find(table_.columns.begin(), table_.columns.end(), column);
        if (found == table_.columns.end()) refuse(format("there is no column \"{}\"; add it", column));
        return std::string(row_.cells[static_cast<std::size_t>(found - table_.columns.begin())]);
    }

    std::string choice(const std::string& column, const std::vector<std::string>& allowed) const {
        const std::string value = at(column);
        if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
            refuse(format("{} is \"{}\", one of {} is needed", column, value, join(allowed)));
        return value;
    }

    std::vector<std::string> reasons() const {
        const std::string text = at("juiceOptions");
        if (text.empty() || text == "{}") return {};  // the latter: a database's empty list
        const Json list = Json::parse(text, nullptr, false);
        const bool is_texts = list.is_array() && std::all_of(list.begin(), list.end(), [](const Json& each) {
                                  return each.is_string();
                              });
        if (!is_texts) refuse(format("juiceOptions is \"{}\", a JSON list of texts is needed", text));
        return list.get<std::vector<std::string>>();
    }

  private:
    const CsvTable& table_;
    const CsvRow& row_;
};

void add_reasons(Question& question, const std::vector<std::string>& reasons) {
    if (reasons.empty()) return;
    if (!question.reasons) question.reasons = Reasons{.text = "Why?"};
    auto& options = question.reasons->options;
    for (const std::string& reason : reasons) {
        const bool known = std::any_of(options.begin(), options.end(),
                                       [&](const QuestionOption& option) { return option.id == reason; });
        if (!known) options.push_back({.id = reason, .text = reason});
    }
}

void add_battle(Dataset& data, const Battle& battle, const std::string& file) {
    data.simulated = data.simulated || battle.at("user").starts_with(kSimulatedRaters);
    const std::size_t left = condition_named(data, battle.at("model_a")),
                      right = condition_named(data, battle.at("model_b"));
    if (left == right) battle.refuse(format("model_a and model_b are both \"{}\"", battle.at("model_a")));
    const std::string winner = battle.choice("winner", {"model_a", "model_b", "tie", "tie (bothbad)"});
    const bool strong = battle.choice("is_strong", {"True", "False", ""}) == "True";
    const int towards_left =
        winner.starts_with("tie") ? 0 : (strong ? 2 : 1) * (winner == "model_a" ? 1 : -1);
    const std::size_t participant = rater_named(data, battle.at("user"), file);
    if (data.raters[participant].file != file) {
        battle.refuse(
            format("\"{}\" voted in {} too; give the votes of each participant once, and those on another "
                   "question by themselves",
                   battle.at("user"), data.raters[participant].file));
    }
    const std::string clip = battle.at("input_code");
    const std::string pair = format("{}: {} and {}", clip, std::min(left, right), std::max(left, right));
    Preference preference{.participant = participant,
                          .question = question_with(data, preference_question()),
                          .unit = unit_named(data, pair),
                          .first = std::min(left, right),
                          .second = std::max(left, right),
                          .left = left,
                          .clip = clip,
                          .reasons = battle.reasons(),
                          .other_reason = battle.at("juiceOtherReason")};
    preference.strength = left < right ? towards_left : -towards_left;
    add_reasons(data.questions[preference.question], preference.reasons);
    ++data.raters[preference.participant].answered;
    data.preferences.push_back(std::move(preference));
}

void read_battles(Dataset& data, const fs::path& file) {
    const std::string text = read_text(file);
    require_utf8(file, text);
    const CsvTable table = parse_csv_table(text, file.string(), {.has_comments = false});
    for (const CsvRow& row : table.rows) add_battle(data, Battle(table, row), file.string());
}

// Of a page of HEMVIP: which conditions stood there, and what was said of each.
struct HemvipTrial {
    std::size_t participant = 0;
    std::string id;
    std::vector<std::string> stimuli;
    std::vector<Json> scores;
};

bool is_check(const std::string& stimulus) {
    return stimulus == "at" || stimulus.find("attn") != std::string::npos;
}

void add_hemvip_pair(Dataset& data, const HemvipTrial& trial, const JsonValue& value) {
    if (trial.stimuli.size() != 2)
        value.refuse(format("has {} responses, a page of type \"videopc\" has 2", trial.stimuli.size()));
    for (const Json& score : trial.scores) {
        if (!score.is_boolean()) value.refuse("has a score that is neither true nor false");
    }
    const bool left_won = trial.scores[0].get<bool>(), right_won = trial.scores[1].get<bool>();
    if (left_won && right_won) value.refuse("has two scores that are true; one of two is preferred, or none");
    const std::size_t left = condition_named(data, trial.stimuli[0]),
                      right = condition_named(data, trial.stimuli[1]);
    if (left == right) value.refuse(format("compares \"{}\" with itself", trial.stimuli[0]));
    const int towards_left = static_cast<int>(left_won) - static_cast<int>(right_won);
    Preference preference{.participant = trial.participant,
                          .question = question_with(data, preference_question()),
                          .unit = unit_named(data, trial.id),
                          .first = std::min(left, right),
                          .second = std::max(left, right),
                          .left = left,
                          .clip = trial.id};
    preference.strength = left < right ? towards_left : -towards_left;
    data.preferences.push_back(std::move(preference));
}

void add_hemvip_scores(Dataset& data, const HemvipTrial& trial, const JsonValue& value) {
    const std::size_t question = question_with(data, {.id = "score",
                                                      .kind = QuestionKind::slider,
                                                      .text = "Score",
                                                      .each = true,
                                                      .least = 0,
                                                      .most = 100});
    for (std::size_t i = 0; i < trial.stimuli.size(); ++i) {
        const Json& score = trial.scores[i];
        if (!score.is_number() || score.get<double>() < 0 || score.get<double>() > 100)
            value.refuse(format("has the score {}, a number from 0 to 100 is needed", score.dump()));
        data.scores.push_back({.participant = trial.participant,
                               .question = question,
                               .cell = condition_named(data, trial.stimuli[i]),
                               .unit = unit_named(data, trial.id + "/" + trial.stimuli[i]),
                               .place = i,
                               .value = score.get<double>()});
    }
}

// How many pages were left out because they are checks or were reported as broken.
std::size_t add_hemvip_trial(Dataset& data, const JsonValue& value, std::size_t participant) {
    constexpr int kBroken = 99;
    const std::string type = value.at("type").text();
    if (type != "video" && type != "videopc") return 0;
    HemvipTrial trial{.participant = participant, .id = value.at("id").text()};
    for (const JsonValue& response : value.at("responses").items(1)) {
        trial.stimuli.push_back(response.at("stimulus").text());
        trial.scores.push_back(response.at("score").json());
        if (is_check(trial.stimuli.back())) return 1;
        if (type == "videopc" && trial.scores.back() == kBroken) return 1;
    }
    ++data.raters[participant].answered;
    if (type == "videopc") {
        add_hemvip_pair(data, trial, value);
    } else {
        add_hemvip_scores(data, trial, value);
    }
    return 0;
}

void read_hemvip(Dataset& data, const fs::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    std::size_t left_out = 0;
    for (const JsonValue& value : json.is_array() ? whole.items(1) : std::vector<JsonValue>{whole}) {
        if (value.find("format"))
            value.at("format").refuse(format("is {}: give the folder of the study whose answers these are",
                                             value.at("format").shown()));
        const std::string user = value.at("userId").text();
        for (const Rater& rater : data.raters) {
            if (rater.name == user)
                value.at("userId").refuse(format(
                    "\"{}\" is already in {}; give the answers of each participant once", user, rater.file));
        }
        const std::size_t participant = rater_named(data, user, file.string());
        for (const JsonValue& trial : value.at("trials").items(0))
            left_out += add_hemvip_trial(data, trial, participant);
    }
    if (left_out > 0)
        data.notes.push_back(format("{}: {} pages are checks or were reported as broken, and are left out.",
                                    file.filename().string(), left_out));
}

}  // namespace

Dataset read_foreign_answers(const std::vector<fs::path>& files) {
    Dataset data{.study = "answers of another front end"};
    std::set<std::string> kinds;
    for (const fs::path& file : files) {
        kinds.insert(file.extension().string());
        if (kinds.size() > 1)
            throw Error(
                format("{}: is of another kind than the files before it; analyse them apart", file.string()));
        if (file.extension() == ".csv") {
            read_battles(data, file);
        } else {
            read_hemvip(data, file);
        }
    }
    for (const KeyCondition& condition : data.conditions) data.cells.push_back(condition.name);
    data.notes.push_back("These files do not say which checks were failed: nobody is excluded.");
    return data;
}

}  // namespace chironomia::study::analysis
