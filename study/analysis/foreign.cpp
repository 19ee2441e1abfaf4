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
#include "study/record/link_parameters.h"

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

    std::size_t line() const { return row_.line; }

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
        const auto reasons = list.get<std::vector<std::string>>();
        std::set<std::string> named;
        for (const std::string& reason : reasons) {
            if (!named.insert(reason).second)
                refuse(format("juiceOptions names \"{}\" twice; name each reason once", reason));
        }
        return reasons;
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
    const std::string user = plain_name(battle.at("user"));
    if (user.empty())
        battle.refuse(
            "user is empty, and votes of several people would count as those of one; write who voted");
    data.simulated = data.simulated || user.starts_with(kSimulatedRaters);
    const std::size_t participant = rater_named(data, user, file);
    if (data.raters[participant].file != file) {
        battle.refuse(
            format("\"{}\" voted in {} too; give the votes of each participant once, and those on another "
                   "question by themselves",
                   user, data.raters[participant].file));
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
    std::map<std::vector<std::string_view>, std::size_t> lines;
    for (const CsvRow& row : table.rows) {
        const Battle battle(table, row);
        add(battle);
        const auto [before, is_new] = lines.emplace(row.cells, row.line);
        if (!is_new)
            battle.refuse(format(
                "is the same as line {}; remove one of them, or if they are two votes, add a column in "
                "which they differ, such as their times",
                before->second));
    }
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
        for (const std::size_t preference : preferences) {
            const Question& question = key.questions[preference];
            if (question.answers.size() > finest_.answers.size()) finest_ = question;
            has_middle_ = has_middle_ || question.answers.size() % 2 == 1;
        }
        judged_ = key.questions[preferences.front()];
        asked_ = preferences.size() == 1 ? judged_ : preference_question();
        // A line answers one question, whatever else a check asks.
        for (StudyPage& page : pages_.pages) {
            votes_on_page_.push_back(votes_of(page));
            for (PagePass& pass : page.passes) pass.questions = {preferences.front()};
        }
    }

    void add(const Battle& battle, const std::string& file) {
        const Side left = side_named(battle, "model_a"), right = side_named(battle, "model_b");
        const KeyPage* page = page_of(battle, left, right);
        const std::size_t participant = voter_of(data_, battle, file);
        voters_.resize(data_.raters.size());
        require_on_scale(battle);
        if (page && page->kind == PageKind::practice) return;
        note_page(battle, participant, page, left);
        if (page && page->kind == PageKind::check) {
            voters_[participant].checks.push_back(answer_to(battle, *page, left));
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
        const bool any_checks =
            std::ranges::any_of(voters_, [](const Voter& voter) { return !voter.checks.empty(); });
        std::size_t unknown = 0;
        for (std::size_t i = 0; i < voters_.size(); ++i) {
            data_.raters[i].answered += voters_[i].checks.size();
            data_.raters[i].failed = failed_checks(key_, pages_, voters_[i].checks);
            const std::optional<bool> finished = has_finished(voters_[i], any_checks);
            data_.raters[i].finished = finished.value_or(true);
            unknown += !finished;
        }
        for (const KeyCondition& condition : data_.conditions) data_.cells.push_back(condition.name);
        if (!any_checks)
            data_.notes.push_back(
                "These files have no attention checks of the study: nobody is excluded for failing one.");
        if (unknown > 0)
            data_.notes.push_back(format(
                "Whether {} finished is not known, because their lines do not name the videos of a sheet of the "
                "study: they count as if they had.",
                unknown == 1 ? "1 participant" : format("{} participants", unknown)));
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

    // What the lines of a rater show.
    struct Voter {
        std::vector<PageAnswer> checks;
        std::vector<Showing> shown;
        std::map<std::size_t, std::vector<std::size_t>> lines;  // by page
        bool names_videos = true;                               // in each line
    };

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

    // How many lines a participant may have on a page: one for each pass that asks which of two is preferred.
    std::size_t votes_of(const StudyPage& page) const {
        const auto asks = [&](const PagePass& pass) {
            return std::ranges::any_of(pass.questions, [&](std::size_t asked) {
                return key_.questions[asked].kind == QuestionKind::preference;
            });
        };
        return static_cast<std::size_t>(std::ranges::count_if(page.passes, asks));
    }

    void require_on_scale(const Battle& battle) const {
        const int steps = steps_of(battle), most = static_cast<int>(finest_.answers.size()) / 2;
        if (std::abs(steps) > most)
            battle.refuse(
                format("is_strong is \"True\", but \"{}\" has {} answers, none of them stronger than "
                       "another; \"False\" is needed, or nothing",
                       finest_.id, finest_.answers.size()));
        if (steps == 0 && !has_middle_)
            battle.refuse(
                format("winner is \"{}\", but \"{}\" has {} answers, none of them in the middle; "
                       "model_a or model_b is needed",
                       battle.at("winner"), finest_.id, finest_.answers.size()));
    }

    // Which places stood left and right.
    static std::vector<std::size_t> order_on(const KeyPage& page, const Side& left) {
        if (page.places.front().video == left.video) return {0, 1};
        return {1, 0};
    }

    void note_page(const Battle& battle, std::size_t participant, const KeyPage* page, const Side& left) {
        Voter& voter = voters_[participant];
        voter.names_videos = voter.names_videos && page;
        if (!page) return;
        const auto index = static_cast<std::size_t>(page - key_.pages.data());
        std::vector<std::size_t>& lines = voter.lines[index];
        if (lines.size() >= std::max<std::size_t>(votes_on_page_[index], 1))
            battle.refuse(format("\"{}\" voted on page \"{}\" in line {} already; remove one of the two",
                                 data_.raters[participant].name, page->token, lines.back()));
        lines.push_back(battle.line());
        voter.shown.push_back({.page = index, .order = order_on(*page, left)});
    }

    // Nothing where no sheet shows all that was voted on. Checks are needed where the files have any.
    std::optional<bool> has_finished(const Voter& voter, bool with_checks) const {
        if (!voter.names_videos) return std::nullopt;
        std::optional<bool> finished;
        for (const Sheet& sheet : pages_.sheets) {
            const bool shows_all = std::ranges::all_of(voter.shown, [&](const Showing& shown) {
                return std::ranges::find(sheet.pages, shown) != sheet.pages.end();
            });
            if (!shows_all) continue;
            const bool is_whole = std::ranges::all_of(sheet.pages, [&](const Showing& needed) {
                const PageKind kind = key_.pages[needed.page].kind;
                const bool counts = kind == PageKind::trial || (kind == PageKind::check && with_checks);
                return !counts || votes_on_page_[needed.page] == 0 || voter.lines.contains(needed.page);
            });
            finished = finished.value_or(false) || is_whole;
        }
        return finished;
    }

    // The answer with these steps from equal. Battles know two steps, so that further ones are taken as the expected
    // answer of that side.
    PageAnswer answer_to(const Battle& battle, const KeyPage& page, const Side& left) const {
        const std::vector<std::size_t> order = order_on(page, left);
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
    Question judged_;          // by attention checks
    Question asked_;           // of the votes; of several preferences none says which
    Question finest_;          // the preference with most answers
    bool has_middle_ = false;  // any preference has
    std::vector<std::size_t> votes_on_page_;
    std::vector<Voter> voters_;  // of each rater
};

// Of a page of HEMVIP: which conditions stood there, and what was said of each.
struct HemvipTrial {
    std::size_t participant = 0;
    std::string id;
    std::vector<std::string> stimuli;
    std::vector<Json> scores;
};

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
        if (marks_check(trial.stimuli.back(), type == "videopc")) return 1;
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
        const std::string user = user_of(value);
        for (const Rater& rater : data.raters) {
            if (rater.name == user)
                value.at("userId").refuse(format(
                    "\"{}\" is already in {}; give the answers of each participant once", user, rater.file));
        }
        const std::size_t participant = rater_named(data, user, file.string());
        std::map<std::string, std::string> answered;  // by the page where it is
        for (const JsonValue& trial : value.at("trials").items(0)) {
            const std::size_t before = data.raters[participant].answered;
            left_out += add_hemvip_trial(data, trial, participant);
            if (data.raters[participant].answered == before) continue;
            const auto [first, is_new] = answered.emplace(trial.at("id").text(), trial.key());
            if (!is_new)
                trial.refuse(
                    format("page \"{}\" is answered a second time, first in {}; remove one answer, or give "
                           "two pages names of their own",
                           first->first, first->second));
        }
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
    data.notes.push_back(
        "These files do not say which checks were failed, nor who did not finish: nobody is excluded.");
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
