#include "study/analysis/dataset.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "study/analysis/dataset_notes.h"
#include "study/measure/descriptive.h"
#include "study/record/answer_values.h"

namespace chironomia::study::analysis {
namespace {

namespace fs = std::filesystem;

// The index of a name; a new name is added at the end.
std::size_t number_of(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto number = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name);
    return number;
}

// The conditions of a page that are compared: all but the reference in the middle of a triplet.
std::vector<std::size_t> compared_on(const KeyPage& page, const StudyKey& key) {
    std::vector<std::size_t> conditions;
    for (const KeyPlace& place : page.places) {
        if (key.layout != Layout::triplet || place.condition != key.reference)
            conditions.push_back(place.condition);
    }
    return conditions;
}

// All that joining one answer needs to know.
struct Joining {
    const StudyKey& key;
    const KeyPage& page;
    const PagePass& pass;
    const PageAnswer& answer;
    std::size_t participant = 0;
    std::size_t trial = 0;  // of the participant's answers
};

// A question as the key has it, and its place among those of the data.
struct Asked {
    const Question& question;
    std::size_t index = 0;
};

std::vector<std::string> chosen_reasons(const Json& reasons, const std::string& question) {
    if (!reasons.is_object() || !reasons.contains(question) || reasons[question].is_null()) return {};
    return reasons[question].at("chosen").get<std::vector<std::string>>();
}

std::string other_reason(const Json& reasons, const std::string& question) {
    if (!reasons.is_object() || !reasons.contains(question) || reasons[question].is_null()) return "";
    const Json other = reasons[question].value("other", Json());
    return other.is_string() ? other.get<std::string>() : "";
}

// Whether this answer, as it was given, is one that needs reasons; those that a front end took anyway do not count.
bool asks_for_reasons(const Question& question, const Json& value) {
    return question.reasons && value != question.reasons->unless;
}

// The cell of scores that go from the second condition to the first.
std::size_t sided_cell(Dataset& data, std::size_t first, std::size_t second) {
    const std::string label = data.conditions[first].name + " over " + data.conditions[second].name;
    const std::size_t cell = number_of(data.cells, label);
    data.sided_cells[cell] = {first, second};
    return cell;
}

void add_preference(Dataset& data, const Joining& join, const Asked& asked, const Json& value) {
    const std::vector<std::size_t> compared = compared_on(join.page, join.key);
    if (compared.size() != 2 || compared[0] == compared[1]) return;
    const bool turned = compared[0] > compared[1];
    const int towards_left = steps_towards_left(value.get<int>(), asked.question.answers.size());
    const int towards_first = turned ? -towards_left : towards_left;
    const bool mirrored = is_mirrored(join.answer.order);
    const Json none;
    const Json& reasons = asks_for_reasons(asked.question, join.answer.values.at(asked.question.id))
                              ? join.answer.reasons
                              : none;
    Preference preference{.participant = join.participant,
                          .question = asked.index,
                          .unit = number_of(data.units, join.page.token),
                          .first = std::min(compared[0], compared[1]),
                          .second = std::max(compared[0], compared[1]),
                          .left = mirrored ? compared[1] : compared[0],
                          .clip = join.page.clip,
                          .strength = towards_first,
                          .reasons = chosen_reasons(reasons, asked.question.id),
                          .other_reason = other_reason(reasons, asked.question.id)};
    if (join.key.layout == Layout::triplet) {
        const std::size_t cell = sided_cell(data, preference.first, preference.second);
        data.scores.push_back(
            {.participant = join.participant,
             .question = asked.index,
             .cell = cell,
             .unit = preference.unit,
             .value = turned ? value.get<double>()
                             : static_cast<double>(asked.question.answers.size() + 1) - value.get<double>()});
    }
    data.preferences.push_back(std::move(preference));
}

// Of a rating or slider without `each`: one that names a side is for one of two, any other of what the page shows.
void add_page_score(Dataset& data, const Joining& join, const Asked& asked, const Json& value) {
    const std::vector<std::size_t> compared = compared_on(join.page, join.key);
    Score score{.participant = join.participant,
                .question = asked.index,
                .unit = number_of(data.units, join.page.token),
                .value = value.get<double>()};
    if (compared.size() == 1) {
        score.cell = compared.front();
    } else if (compared.size() == 2 && names_a_side(asked.question, join.key.layout)) {
        const auto [first, second] = std::minmax(compared[0], compared[1]);
        score.cell = sided_cell(data, first, second);
        // The least means the left one (of a triplet: like A), so the score is reversed if that is the first.
        if (compared[0] == first) score.value = reversed_value(asked.question, score.value);
    } else {
        score.cell = number_of(data.cells, label_of(data, compared));
    }
    data.scores.push_back(score);
}

// Of each video by itself, by its place in the key.
void add_each_score(Dataset& data, const Joining& join, const Asked& asked, const Json& values) {
    for (std::size_t shown = 0; shown < join.answer.order.size(); ++shown) {
        const std::size_t place = join.answer.order[shown];
        data.scores.push_back({.participant = join.participant,
                               .question = asked.index,
                               .cell = join.page.places[place].condition,
                               .unit = number_of(data.units, format("{}/{}", join.page.token, place)),
                               .place = shown,
                               .value = values[place].get<double>()});
    }
}

std::size_t cell_of_option(Dataset& data, const std::vector<std::size_t>& shown, const Question& asked,
                           std::size_t option) {
    const std::size_t cell =
        number_of(data.cells, format("{}: {}", label_of(data, shown), asked.options[option].text));
    data.option_of_cell[cell] = asked.options[option].text;
    return cell;
}

// In the order of the plan, whichever page was answered first.
void add_cells_of_options(Dataset& data, const StudyKey& key) {
    std::set<std::vector<std::size_t>> all_shown;
    for (const KeyPage& page : key.pages) {
        std::vector<std::size_t> shown = compared_on(page, key);
        std::sort(shown.begin(), shown.end());
        if (page.kind == PageKind::trial) all_shown.insert(std::move(shown));
    }
    for (const Question& asked : key.questions) {
        if (asked.kind != QuestionKind::rank) continue;
        for (const std::vector<std::size_t>& shown : all_shown) {
            for (std::size_t i = 0; i < asked.options.size(); ++i) cell_of_option(data, shown, asked, i);
        }
    }
}

void add_option_ranks(Dataset& data, const Joining& join, const Asked& asked, const Json& values) {
    const std::vector<std::size_t> shown = compared_on(join.page, join.key);
    for (std::size_t i = 0; i < asked.question.options.size(); ++i) {
        data.scores.push_back({.participant = join.participant,
                               .question = asked.index,
                               .cell = cell_of_option(data, shown, asked.question, i),
                               .unit = number_of(data.units, format("{}/{}", join.page.token, i)),
                               .place = i,
                               .value = values[i].get<double>()});
    }
}

void add_choice(Dataset& data, const Joining& join, const Asked& asked, const Json& value) {
    const bool of_videos = asked.question.options.empty();
    Choice choice{.participant = join.participant,
                  .question = asked.index,
                  .unit = number_of(data.units, join.page.token),
                  .option = of_videos
                                ? data.conditions[join.page.places[value.get<std::size_t>()].condition].name
                                : value.get<std::string>()};
    for (const KeyPlace& place : join.page.places) choice.conditions.push_back(place.condition);
    data.choices.push_back(std::move(choice));
}

// What is chosen or put first; nothing where several are first.
std::string chosen_answer(const Joining& join, const Question& asked, const Json& value) {
    const auto condition = [&](std::size_t place) {
        return join.key.conditions[join.page.places[place].condition].name;
    };
    if (asked.kind == QuestionKind::choice)
        return is_of_videos(asked) ? condition(value.get<std::size_t>()) : value.get<std::string>();
    const auto ranks = value.get<std::vector<int>>();
    const auto first = std::find(ranks.begin(), ranks.end(), 1);
    if (first == ranks.end() || std::count(ranks.begin(), ranks.end(), 1) > 1) return "";
    return condition(static_cast<std::size_t>(first - ranks.begin()));
}

void add_judged(Dataset& data, const Joining& join, const Asked& asked, const Json& value) {
    const auto right = join.page.right.find(asked.question.id);
    if (right == join.page.right.end()) return;
    data.judged.push_back(
        {.participant = join.participant,
         .question = asked.index,
         .given = chosen_answer(join, asked.question, value),
         .right = right->second,
         .possible = is_of_videos(asked.question) ? join.page.places.size() : asked.question.options.size()});
}

void add_value(Dataset& data, const Joining& join, const Asked& asked, const Json& value) {
    switch (asked.question.kind) {
        case QuestionKind::preference:
            add_preference(data, join, asked, value);
            break;
        case QuestionKind::rating:
        case QuestionKind::slider:
            if (asked.question.each) {
                add_each_score(data, join, asked, value);
            } else {
                add_page_score(data, join, asked, value);
            }
            break;
        case QuestionKind::number:
            add_page_score(data, join, asked, value);
            break;
        case QuestionKind::rank:
            if (asked.question.options.empty()) {
                add_each_score(data, join, asked, value);
            } else {
                add_option_ranks(data, join, asked, value);
            }
            break;
        case QuestionKind::choice:
            add_choice(data, join, asked, value);
            break;
        case QuestionKind::text:
            break;
    }
}

std::string shown_text(const Json& value) {
    return value.is_string() ? value.get<std::string>()
                             : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void add_row(Dataset& data, const Joining& join, const Asked& asked, const Json& in_places) {
    std::vector<std::size_t> shown;
    for (const std::size_t place : join.answer.order) shown.push_back(join.page.places[place].condition);
    data.rows.push_back({.participant = join.participant,
                         .question = asked.index,
                         .block = join.page.block,
                         .trial = join.trial,
                         .kind = join.page.kind,
                         .clip = join.page.clip,
                         .conditions = names_of(data.conditions, shown, "|"),
                         .value = shown_text(join.answer.values.at(asked.question.id)),
                         .value_of_places = shown_text(in_places),
                         .seconds = join.answer.seconds});
}

// Questions that had to be answered and were not, though the pass was not skipped.
std::size_t count_left_out(const Joining& join) {
    if (join.answer.skipped) return 0;
    return static_cast<std::size_t>(
        std::count_if(join.pass.questions.begin(), join.pass.questions.end(), [&](std::size_t asked) {
            const Question& question = join.key.questions[asked];
            return !question.optional && !join.answer.values.contains(question.id);
        }));
}

// Answers may have been lost on their way, or removed: what a participant says does not make a sheet complete, nor does
// it make one incomplete that was left before the questions at the end.
bool has_finished(Dataset& data, const StudyPages& pages, const Respondent& participant) {
    if (participant.sheet >= pages.sheets.size())
        throw Error(format(
            "{}: participant {}: sheet is {}, the study has {}; give the answers to this build "
            "of the study",
            participant.file, participant.name, participant.sheet,
            pages.sheets.size() == 1 ? "sheet 0 alone" : format("sheets 0 to {}", pages.sheets.size() - 1)));
    const std::vector<Step> steps = steps_of_sheet(pages, participant.sheet);
    const std::size_t answered = count_answered(steps, participant.answers);
    if (answered == steps.size()) return true;
    if (!participant.finished) return false;
    data.notes.push_back(format(
        "{}: participant {} says \"finished\", but has {} of the {} answers of sheet {}, and counts as "
        "one who did not finish.",
        fs::path(participant.file).filename().string(), participant.name, answered, steps.size(),
        participant.sheet));
    return false;
}

// Adds the scores of the scale of this index, of the video or videos that `given` rates. How many of them lack some
// items.
std::size_t add_scale(Dataset& data, const Joining& join, std::size_t index,
                      const std::vector<Score>& given) {
    const Scale& scale = data.scales[index];
    const std::size_t question = data.first_scale() + index;
    std::size_t incomplete = 0;
    std::map<std::size_t, std::map<std::size_t, Score>> by_unit;  // and by item
    for (const Score& score : given) by_unit[score.unit][data.asked_as(score.question)] = score;
    for (const auto& [unit, scores] : by_unit) {
        ScaleAnswer answer{.participant = join.participant, .question = question, .clip = join.page.clip};
        Score mean;
        for (std::size_t i = 0; i < scale.items.size(); ++i) {
            const auto score = scores.find(scale.items[i]);
            if (score == scores.end()) continue;
            mean = score->second;
            answer.items.push_back(
                scale.reversed[i] ? reversed_value(data.questions[scale.items[i]], mean.value) : mean.value);
        }
        if (answer.items.size() < scale.items.size()) {
            incomplete += !answer.items.empty();
            continue;
        }
        answer.cell = mean.cell;
        mean.question = question;
        mean.value = mean_of(answer.items);
        data.scores.push_back(mean);
        data.scale_answers.push_back(std::move(answer));
    }
    return incomplete;
}

// How many answers lack some items of a scale.
std::size_t add_scales(Dataset& data, const Joining& join, std::size_t scores_before) {
    std::size_t incomplete = 0;
    const std::vector<Score> given(data.scores.begin() + static_cast<std::ptrdiff_t>(scores_before),
                                   data.scores.end());
    for (std::size_t i = 0; i < data.scales.size(); ++i) {
        if (data.passes_of_scales[i].value_or(join.answer.pass) == join.answer.pass)
            incomplete += add_scale(data, join, i, given);
    }
    return incomplete;
}

// Whether an attention check asks a question that may be left open, and it was.
bool is_open_check(const Joining& join) {
    if (join.page.kind != PageKind::check || join.answer.skipped) return false;
    return std::ranges::any_of(join.pass.questions, [&](std::size_t asked) {
        const Question& question = join.key.questions[asked];
        return question.optional && join.page.expected.contains(question.id) &&
               join.answer.values.value(question.id, Json()).is_null();
    });
}

void join_one(Dataset& data, const Joining& join, Uncounted& uncounted) {
    uncounted.left_out += count_left_out(join);
    uncounted.open_checks += is_open_check(join);
    const std::size_t scores_before = data.scores.size();
    Rater& rater = data.raters[join.participant];
    ++rater.answered;
    rater.skipped += join.answer.skipped;
    for (std::size_t q = 0; q < join.key.questions.size(); ++q) {
        const Question& question = join.key.questions[q];
        if (!join.answer.values.contains(question.id)) continue;
        const Json value =
            to_places(join.answer.values[question.id], question, join.answer.order, join.key.layout);
        const Asked asked{.question = question, .index = data.index_of(q, join.answer.pass)};
        add_row(data, join, asked, value);
        if (join.page.kind != PageKind::trial || value.is_null()) continue;
        add_value(data, join, asked, value);
        add_judged(data, join, asked, value);
    }
    uncounted.incomplete += add_scales(data, join, scores_before);
}

struct ParticipantSource {
    const StudyKey& key;
    const StudyPages& pages;
    const Respondent& participant;
};

const PagePass& pass_of(const ParticipantSource& of, const PageAnswer& answer) {
    const std::vector<PagePass>& passes = of.pages.pages[answer.page].passes;
    if (answer.pass < passes.size()) return passes[answer.pass];
    throw Error(
        format("{}: participant {}: pass {} of page \"{}\" is answered, but the page has {}; "
               "give the answers to this build of the study",
               of.participant.file, of.participant.name, answer.pass, of.key.pages[answer.page].token,
               passes.size() == 1 ? "1 pass" : format("{} passes", passes.size())));
}

// Other videos, or others on the left, would be answers to something else.
void require_on_sheet(const ParticipantSource& of, const std::vector<Step>& steps, const PageAnswer& answer) {
    const KeyPage& page = of.key.pages[answer.page];
    const auto video_at = [&](const std::vector<std::size_t>& order, std::size_t place) {
        return place < order.size() && order[place] < page.places.size() ? page.places[order[place]].video
                                                                         : "";
    };
    const auto tokens = [&](const std::vector<std::size_t>& order, std::size_t count) {
        std::vector<std::string> shown;
        for (std::size_t place = 0; place < count; ++place) shown.push_back(video_at(order, place));
        return shown;
    };
    std::string fault = format("is answered, but sheet {} does not show it", of.participant.sheet);
    for (const Step& step : steps) {
        if (step.page != answer.page || step.pass != answer.pass) continue;
        // One video that shows all places stands once on the sheet.
        const auto on_sheet = tokens(step.order, step.order.size()),
                   given = tokens(answer.order, step.order.size());
        if (given == on_sheet) return;
        fault = format("has the videos {} from left to right, but sheet {} shows {}", join(given),
                       of.participant.sheet, join(on_sheet));
    }
    throw Error(format("{}: participant {}: page \"{}\" {}; give the answers to this build of the study",
                       of.participant.file, of.participant.name, page.token, fault));
}

void require_asked(const ParticipantSource& of, const PagePass& pass, const PageAnswer& answer) {
    for (const auto& [id, value] : answer.values.items()) {
        const bool is_asked = std::ranges::any_of(pass.questions, [&, &name = id](std::size_t asked) {
            return of.key.questions[asked].id == name;
        });
        if (is_asked) continue;
        throw Error(format(
            "{}: participant {}: pass {} of page \"{}\" has the value {} for \"{}\", which it does not "
            "ask; remove it, or give the answers to this build of the study",
            of.participant.file, of.participant.name, answer.pass, of.key.pages[answer.page].token,
            value.dump(), id));
    }
}

// The answers of the last rater.
void join_participant(Dataset& data, const ParticipantSource& of, Uncounted& uncounted) {
    std::vector<double> seconds;
    const std::vector<Step> steps = steps_of_sheet(of.pages, of.participant.sheet);
    for (std::size_t trial = 0; trial < of.participant.answers.size(); ++trial) {
        const PageAnswer& answer = of.participant.answers[trial];
        const KeyPage& page = of.key.pages[answer.page];
        if (page.kind == PageKind::practice) {
            ++uncounted.practised;
            continue;
        }
        const Joining join{.key = of.key,
                           .page = page,
                           .pass = pass_of(of, answer),
                           .answer = answer,
                           .participant = data.raters.size() - 1,
                           .trial = trial};
        require_on_sheet(of, steps, answer);
        require_asked(of, join.pass, answer);
        join_one(data, join, uncounted);
        if (answer.seconds) seconds.push_back(*answer.seconds);
    }
    Rater& rater = data.raters.back();
    rater.failed = failed_checks(of.key, of.pages, of.participant.answers);
    std::sort(seconds.begin(), seconds.end());
    if (!seconds.empty()) rater.median_seconds = percentile_of_sorted(seconds, 0.5);
}

// As if the mean had been given on a slider.
Question as_question(const Scale& scale, const std::vector<Question>& questions) {
    const ScoreRange range = range_of_scores(questions[scale.items.front()]);
    return {.id = scale.id,
            .kind = QuestionKind::slider,
            .text = describe(scale, questions),
            .least = range.least,
            .most = range.most};
}

// Of each question the passes that ask it.
std::vector<std::set<std::size_t>> passes_of_questions(const StudyKey& key, const StudyPages& pages) {
    std::vector<std::set<std::size_t>> passes(key.questions.size());
    for (const StudyPage& page : pages.pages) {
        for (std::size_t pass = 0; pass < page.passes.size(); ++pass)
            for (const std::size_t question : page.passes[pass].questions) passes[question].insert(pass);
    }
    return passes;
}

std::string id_in_pass(const std::string& id, std::size_t pass) {
    return format("{}-pass-{}", id, pass + 1);
}

// What is asked in several passes, as without sound and with it, is as many questions.
void add_questions_of_passes(Dataset& data, const StudyKey& key,
                             const std::vector<std::set<std::size_t>>& passes) {
    for (std::size_t q = 0; q < key.questions.size(); ++q) {
        if (passes[q].size() < 2) continue;
        for (const std::size_t pass : passes[q]) {
            const bool is_first = pass == *passes[q].begin();
            if (!is_first) data.questions.push_back(key.questions[q]);
            const std::size_t index = is_first ? q : data.questions.size() - 1;
            data.questions[index].id = id_in_pass(key.questions[q].id, pass);
            data.of_passes[{q, pass}] = index;
        }
    }
}

// And so is a scale whose items are.
void add_scales_of_passes(Dataset& data, const StudyKey& key,
                          const std::vector<std::set<std::size_t>>& passes) {
    for (const Scale& scale : key.scales) {
        const std::set<std::size_t>& asked = passes[scale.items.front()];
        if (asked.size() < 2) {
            data.scales.push_back(scale);
            data.passes_of_scales.push_back(std::nullopt);
        }
        for (const std::size_t pass : asked.size() < 2 ? std::set<std::size_t>{} : asked) {
            data.scales.push_back(scale);
            data.scales.back().id = id_in_pass(scale.id, pass);
            data.passes_of_scales.push_back(pass);
        }
    }
    for (const Scale& scale : data.scales) data.questions.push_back(as_question(scale, key.questions));
}

void check_questionnaire(const StudyPages& pages, const Respondent& participant) {
    for (const auto& [id, value] : participant.questionnaire.items()) {
        const auto asked = std::find_if(pages.questionnaire.begin(), pages.questionnaire.end(),
                                        [&, &name = id](const Question& one) { return one.id == name; });
        const std::string fault =
            asked == pages.questionnaire.end()
                ? "the study asks no such question at its end; give the answers of this study"
                : fault_of_answer(*asked, value, 1);
        if (!fault.empty())
            throw Error(format("{}: questionnaire of participant {}: {} is {}: {}", participant.file,
                               participant.name, id, value.dump(), fault));
    }
}

}  // namespace

bool Dataset::is_item(std::size_t question) const {
    return std::ranges::any_of(scales, [asked = asked_as(question)](const Scale& scale) {
        return std::ranges::find(scale.items, asked) != scale.items.end();
    });
}

std::size_t Dataset::index_of(std::size_t question, std::size_t pass) const {
    const auto found = of_passes.find({question, pass});
    return found == of_passes.end() ? question : found->second;
}

std::size_t Dataset::asked_as(std::size_t question) const {
    const auto found = std::ranges::find_if(of_passes, [&](const auto& of) { return of.second == question; });
    return found == of_passes.end() ? question : found->first.first;
}

std::string label_of(const Dataset& data, std::vector<std::size_t> conditions) {
    std::sort(conditions.begin(), conditions.end());
    return names_of(data.conditions, conditions, " + ");
}

Dataset join_answers(const StudyKey& key, const StudyPages& pages,
                     const std::vector<Respondent>& participants) {
    Dataset data{.study = key.study,
                 .preset = key.preset,
                 .seed = key.seed,
                 .conditions = key.conditions,
                 .questions = key.questions,
                 .questionnaire = pages.questionnaire,
                 .rules = key.exclusions};
    const std::vector<std::set<std::size_t>> passes = passes_of_questions(key, pages);
    add_questions_of_passes(data, key, passes);
    add_scales_of_passes(data, key, passes);
    for (const KeyCondition& condition : key.conditions) data.cells.push_back(condition.name);
    add_cells_of_options(data, key);
    Uncounted uncounted;
    for (const Respondent& participant : participants) {
        check_questionnaire(pages, participant);
        data.simulated = data.simulated || participant.simulated;
        data.raters.push_back({.name = participant.name,
                               .file = participant.file,
                               .finished = has_finished(data, pages, participant),
                               .questionnaire = participant.questionnaire});
        join_participant(data, {key, pages, participant}, uncounted);
    }
    add_notes(data, key, uncounted);
    return data;
}

}  // namespace chironomia::study::analysis
