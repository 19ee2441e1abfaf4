#include "study/analysis/foreign.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "core/utf8.h"
#include "study/analysis/answers.h"
#include "study/analysis/hemvip_answers.h"
#include "study/analysis/simulated_rater.h"
#include "study/record/answer_values.h"
#include "study/record/failed_checks.h"

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

bool is_token(const std::string& name) {
    constexpr std::size_t kDigits = 16;
    return name.size() == kDigits && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// By a token of a video each video would be a condition of its own.
std::string token_refusal(const std::string& token) {
    return format(
        "\"{}\", the token of a video of a study, which hides the condition; give the folder of the study too: "
        "chironomia study analyse DIR --answers ...",
        token);
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

// Above 0 model_a was preferred, 2 strongly.
int steps_of(const Battle& battle) {
    const std::string winner = battle.choice("winner", {"model_a", "model_b", "tie", "tie (bothbad)"});
    const bool strong = battle.choice("is_strong", {"True", "False", ""}) == "True";
    return winner.starts_with("tie") ? 0 : (strong ? 2 : 1) * (winner == "model_a" ? 1 : -1);
}

std::size_t voter_of(Dataset& data, const Battle& battle, const std::string& file) {
    data.simulated = data.simulated || battle.at("user").starts_with(kSimulatedRaters);
    const std::size_t participant = rater_named(data, battle.at("user"), file);
    if (data.raters[participant].file != file) {
        battle.refuse(
            format("\"{}\" voted in {} too; give the votes of each participant once, and those on another "
                   "question by themselves",
                   battle.at("user"), data.raters[participant].file));
    }
    return participant;
}

// Who voted on what.
struct PairOfLine {
    std::size_t participant = 0;
    std::size_t left = 0;  // condition
    std::size_t right = 0;
    std::string clip;
    std::string unit;
};

void add_vote(Dataset& data, const Battle& battle, const PairOfLine& pair, Question asked) {
    const auto& [participant, left, right, clip, unit] = pair;
    const int towards_left = steps_of(battle);
    Preference preference{.participant = participant,
                          .question = question_with(data, std::move(asked)),
                          .unit = unit_named(data, unit),
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

std::string pair_named(const std::string& clip, std::size_t left, std::size_t right) {
    return format("{}: {} and {}", clip, std::min(left, right), std::max(left, right));
}

void add_battle(Dataset& data, const Battle& battle, const std::string& file) {
    for (const char* column : {"model_a", "model_b"}) {
        if (is_token(battle.at(column)))
            battle.refuse(format("{} is {}", column, token_refusal(battle.at(column))));
    }
    const std::size_t left = condition_named(data, battle.at("model_a")),
                      right = condition_named(data, battle.at("model_b"));
    if (left == right) battle.refuse(format("model_a and model_b are both \"{}\"", battle.at("model_a")));
    const std::size_t participant = voter_of(data, battle, file);
    const std::string clip = battle.at("input_code");
    add_vote(data, battle,
             {.participant = participant,
              .left = left,
              .right = right,
              .clip = clip,
              .unit = pair_named(clip, left, right)},
             preference_question());
}

template <typename Add>
void read_lines(const fs::path& file, const Add& add) {
    const std::string text = read_text(file);
    require_utf8(file, text);
    const CsvTable table = parse_csv_table(text, file.string(), {.has_comments = false});
    for (const CsvRow& row : table.rows) add(Battle(table, row));
}

// Lines of battles.csv about a study: its names of conditions, or tokens.
class BattlesOfStudy {
  public:
    BattlesOfStudy(const StudyKey& key, const StudyPages& pages, const std::string& file)
        : key_(key),
          pages_(pages),
          data_{.study = key.study,
                .preset = key.preset,
                .seed = key.seed,
                .conditions = key.conditions,
                .rules = key.exclusions} {
        std::vector<std::size_t> preferences;
        for (std::size_t i = 0; i < key.questions.size(); ++i) {
            if (key.questions[i].kind == QuestionKind::preference) preferences.push_back(i);
        }
        if (preferences.empty())
            throw Error(format("{}: the study asks for no preference; give the answers of this study", file));
        judged_ = key.questions[preferences.front()];
        asked_ = preferences.size() == 1 ? judged_ : preference_question();
        // A line answers one question, whatever else a check asks.
        for (StudyPage& page : pages_.pages) {
            for (PagePass& pass : page.passes) pass.questions = {preferences.front()};
        }
    }

    void add(const Battle& battle, const std::string& file) {
        const Side left = side_named(battle, "model_a"), right = side_named(battle, "model_b");
        const KeyPage* page = page_of(battle, left, right);
        const std::size_t participant = voter_of(data_, battle, file);
        answers_.resize(data_.raters.size());
        if (page && page->kind == PageKind::practice) return;
        if (page && page->kind == PageKind::check) {
            answers_[participant].push_back(answer_to(battle, *page, left));
            return;
        }
        if (left.condition == right.condition)
            battle.refuse(
                format("model_a and model_b are both \"{}\"", key_.conditions[left.condition].name));
        const std::string clip = page ? page->clip : clip_named(battle.at("input_code"));
        add_vote(data_, battle,
                 {.participant = participant,
                  .left = left.condition,
                  .right = right.condition,
                  .clip = clip,
                  .unit = page ? page->token : pair_named(clip, left.condition, right.condition)},
                 asked_);
    }

    Dataset finish() {
        bool any_checks = false;
        for (std::size_t i = 0; i < answers_.size(); ++i) {
            any_checks = any_checks || !answers_[i].empty();
            data_.raters[i].answered += answers_[i].size();
            data_.raters[i].failed = failed_checks(key_, pages_, answers_[i]);
        }
        for (const KeyCondition& condition : data_.conditions) data_.cells.push_back(condition.name);
        if (!any_checks)
            data_.notes.push_back("These files have no attention checks of the study: nobody is excluded.");
        return std::move(data_);
    }

  private:
    struct Side {
        std::size_t condition = 0;
        std::string video;  // token; empty: the condition was named
    };

    Side side_named(const Battle& battle, const std::string& column) const {
        const std::string name = battle.at(column);
        for (std::size_t i = 0; i < key_.conditions.size(); ++i) {
            const std::string& condition = key_.conditions[i].name;
            if (name == condition || name == condition_token(key_, condition)) return {.condition = i};
        }
        for (const KeyPage& page : key_.pages) {
            const auto place = std::ranges::find(page.places, name, &KeyPlace::video);
            if (place != page.places.end()) return {.condition = place->condition, .video = name};
        }
        battle.refuse(format(
            "{} is \"{}\", which is no condition of the study and no token of one; give the folder of the study "
            "that was answered",
            column, name));
    }

    // None where conditions are named.
    const KeyPage* page_of(const Battle& battle, const Side& left, const Side& right) const {
        if (left.video.empty() || right.video.empty()) return nullptr;
        const auto shows = [](const KeyPage& page, const std::string& video) {
            return std::ranges::find(page.places, video, &KeyPlace::video) != page.places.end();
        };
        for (const KeyPage& page : key_.pages) {
            if (left.video != right.video && shows(page, left.video) && shows(page, right.video))
                return &page;
        }
        battle.refuse(
            format("no page of the study shows \"{}\" and \"{}\" together", left.video, right.video));
    }

    std::string clip_named(const std::string& code) const {
        const auto found = std::ranges::find_if(
            key_.clips, [&](const std::string& clip) { return code == clip_token(key_, clip); });
        return found == key_.clips.end() ? code : *found;
    }

    // The answer with these steps from equal. Battles know two steps, so that further ones are taken as the expected
    // answer of that side.
    PageAnswer answer_to(const Battle& battle, const KeyPage& page, const Side& left) const {
        std::vector<std::size_t> order = {0, 1};
        if (page.places.front().video != left.video) std::swap(order.front(), order.back());
        const int steps = steps_of(battle);
        const int count = static_cast<int>(judged_.answers.size()), half = count / 2;
        int answer = count % 2 == 1 ? half + 1 - steps : steps > 0 ? 1 : steps < 0 ? 2 : 0;
        if (half == 1) answer = steps == 0 ? answer : steps > 0 ? 1 : count;
        const Json expected = page.expected.value(judged_.id, Json());
        if (half > 2 && steps != 0 && expected.is_number_integer()) {
            const Json shown = to_shown(expected, judged_, order, key_.layout);
            const bool same_side = steps_towards_left(shown.get<int>(), judged_.answers.size()) * steps > 0;
            if (same_side) answer = shown.get<int>();
        }
        return {.page = static_cast<std::size_t>(&page - key_.pages.data()),
                .order = order,
                .values = {{judged_.id, answer}},
                .reasons = Json::object()};
    }

    const StudyKey& key_;
    StudyPages pages_;
    Dataset data_;
    Question judged_;                               // by attention checks
    Question asked_;                                // of the votes; of several preferences none says which
    std::vector<std::vector<PageAnswer>> answers_;  // to attention checks, of each rater
};

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
        if (is_token(trial.stimuli.back()))
            response.at("stimulus").refuse("is " + token_refusal(trial.stimuli.back()));
        trial.scores.push_back(as_number(response.at("score").json()));
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
        kinds.insert(extension_of(file));
        if (kinds.size() > 1)
            throw Error(
                format("{}: is of another kind than the files before it; analyse them apart", file.string()));
        if (extension_of(file) == ".csv") {
            read_lines(file, [&](const Battle& battle) { add_battle(data, battle, file.string()); });
        } else {
            read_hemvip(data, file);
        }
    }
    for (const KeyCondition& condition : data.conditions) data.cells.push_back(condition.name);
    data.notes.push_back("These files do not say which checks were failed: nobody is excluded.");
    return data;
}

Dataset read_battles(const std::vector<fs::path>& files, const StudyKey& key, const StudyPages& pages) {
    BattlesOfStudy battles(key, pages, files.front().string());
    for (const fs::path& file : files) {
        if (extension_of(file) != ".csv")
            throw Error(
                format("{}: is of another kind than the files before it; analyse them apart", file.string()));
        read_lines(file, [&](const Battle& battle) { battles.add(battle, file.string()); });
    }
    return battles.finish();
}

}  // namespace chironomia::study::analysis
