#include "study/analysis/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.h"
#include "core/files/json_value.h"
#include "core/random.h"
#include "core/text.h"
#include "study/analysis/simulated_rater.h"
#include "study/record/answer_values.h"
#include "study/record/key.h"
#include "study/record/study_folder.h"

namespace chironomia::study::analysis {
namespace {

constexpr double kOfScale = 1.0 / 6;    // of a scale's width for a strength of 1, and noise of the same size
constexpr double kLeaning = 3;          // of a strength for a whole width of the scale
constexpr double kUsualSpread = 0.3;    // of raters [logits]
constexpr double kOfParticipant = 0.1;  // of a scale's width, for the usual spread
constexpr const char* kThen = "2000-01-01T00:00:00.000Z";  // nobody was there

// One participant while they answer.
struct SimulatedRater {
    const StudyKey& key;
    Random random;
    std::vector<double> strengths;  // planted, by condition
    std::vector<double> leanings;   // of this participant for each condition, of a scale's width
    bool fails = false;
};

double strength_at(const SimulatedRater& rater, const KeyPage& page, std::size_t place) {
    const std::size_t condition = page.places[place].condition;
    return rater.strengths[condition] + kLeaning * rater.leanings[condition];
}

// How far the first place is preferred to the last, with noise.
double feeling(SimulatedRater& rater, const KeyPage& page) {
    return strength_at(rater, page, 0) - strength_at(rater, page, page.places.size() - 1) +
           logistic_noise(rater.random);
}

// The answer so many steps from equal: 1 is the first place as clearly as can be.
int preference_of(double felt, std::size_t answers) {
    const int half = static_cast<int>(answers / 2), steps = steps_felt(felt, answers);
    if (answers % 2 == 1 || steps > 0) return half + 1 - steps;
    return half - steps;
}

int score_at(SimulatedRater& rater, const KeyPage& page, std::size_t place, const ScoreRange& range) {
    const std::size_t condition = page.places[place].condition;
    const double width = range.most - range.least;
    const double score = range.least + width / 2 +
                         width * kOfScale * (rater.strengths[condition] + rater.random.normal()) +
                         width * rater.leanings[condition];
    return std::clamp(static_cast<int>(std::lround(score)), range.least, range.most);
}

Json rating_of(SimulatedRater& rater, const Question& question, const KeyPage& page,
               const ScoreRange& range) {
    if (question.each) {
        Json scores = Json::array();
        for (std::size_t place = 0; place < page.places.size(); ++place)
            scores.push_back(score_at(rater, page, place, range));
        return scores;
    }
    // The least is the left one, or like A of a triplet; the most is the right one.
    if (names_a_side(question, rater.key.layout)) {
        const double middle = (range.least + range.most) / 2.0;
        const double step = question.kind == QuestionKind::rating ? 1 : kOfScale * (range.most - range.least);
        const auto rating = static_cast<int>(std::lround(middle - step * feeling(rater, page)));
        return std::clamp(rating, range.least, range.most);
    }
    return score_at(rater, page, 0, range);
}

std::vector<std::size_t> by_strength(SimulatedRater& rater, const KeyPage& page) {
    std::vector<double> felt;
    for (std::size_t place = 0; place < page.places.size(); ++place) {
        const double u = std::max(rater.random.uniform(), 1e-12);
        felt.push_back(strength_at(rater, page, place) - std::log(-std::log(u)));
    }
    std::vector<std::size_t> order(felt.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return felt[a] > felt[b]; });
    return order;
}

Json ranks_of(const std::vector<std::size_t>& best_first) {
    Json ranks = Json::array();
    for (std::size_t i = 0; i < best_first.size(); ++i) ranks.push_back(0);
    for (std::size_t rank = 0; rank < best_first.size(); ++rank) ranks[best_first[rank]] = rank + 1;
    return ranks;
}

std::vector<std::size_t> shuffled(SimulatedRater& rater, std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    rater.random.shuffle(order);
    return order;
}

// The value as if the videos stood in the order of the places.
Json value_of(SimulatedRater& rater, const Question& question, const KeyPage& page) {
    switch (question.kind) {
        case QuestionKind::preference:
            return preference_of(feeling(rater, page), question.answers.size());
        case QuestionKind::rating:
        case QuestionKind::slider:
            return rating_of(rater, question, page, range_of_scores(question));
        case QuestionKind::choice:
            if (question.options.empty()) return by_strength(rater, page).front();
            return question.options[rater.random.below(static_cast<std::uint32_t>(question.options.size()))]
                .id;
        case QuestionKind::rank:
            return ranks_of(question.options.empty() ? by_strength(rater, page)
                                                     : shuffled(rater, question.options.size()));
        case QuestionKind::text:
            return "simulated";
        case QuestionKind::number: {
            constexpr int kSpan = 60;
            const int least = question.least.value_or(std::min(18, question.most.value_or(18) - kSpan));
            const int most = question.most.value_or(least + kSpan);
            return least + static_cast<int>(rater.random.below(static_cast<std::uint32_t>(most - least + 1)));
        }
    }
    return {};
}

// A rater who likes a video rates a reversed item low.
Json reversed_answer(const Question& question, const Json& value) {
    if (value.is_number()) return std::lround(reversed_value(question, value.get<double>()));
    Json list = Json::array();
    for (const Json& each : value) list.push_back(reversed_answer(question, each));
    return list;
}

// The expected value, or a wrong one if the rater fails. Where any value is expected (null), the given one stays.
Json answer_check(const SimulatedRater& rater, const Question& question, const Json& expected,
                  const Json& given) {
    if (expected.is_array()) {
        Json answer = given;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (!expected[i].is_null()) answer[i] = answer_check(rater, question, expected[i], given[i]);
        }
        return answer;
    }
    if (!rater.fails) return expected;
    if (expected.is_string()) {
        return question.options[question.options.front().id == expected ? 1 : 0].id;
    }
    const int least = question.kind == QuestionKind::slider ? question.least.value_or(0) : 1;
    return expected == least ? least + 1 : least;
}

Json reasons_of(SimulatedRater& rater, const Question& question, const Json& value) {
    if (!question.reasons || value == question.reasons->unless) return {};
    const auto count = static_cast<std::uint32_t>(question.reasons->options.size());
    std::set<std::uint32_t> chosen = {rater.random.below(count)};
    if (rater.random.below(3) == 0) chosen.insert(rater.random.below(count));
    Json ids = Json::array();
    for (const std::uint32_t reason : chosen) ids.push_back(question.reasons->options[reason].id);
    return {{"chosen", ids}, {"other", ""}};
}

Json events_of(const std::vector<std::size_t>& order, double seconds) {
    Json events = Json::array();
    for (std::size_t place = 0; place < order.size(); ++place) {
        events.push_back({0.5, format("play {}", place)});
        events.push_back({0.5 + seconds, format("ended {}", place)});
    }
    return events;
}

Json videos_of(const KeyPage& page, const std::vector<std::size_t>& order) {
    Json tokens = Json::array();
    std::set<std::string> different;
    for (const KeyPlace& place : page.places) different.insert(place.video);
    if (different.size() == 1) return Json::array({page.places.front().video});
    for (const std::size_t place : order) tokens.push_back(page.places[place].video);
    return tokens;
}

// From left to right. One video that shows all has its places as they are.
std::vector<std::size_t> places_shown(const Step& step, const KeyPage& page) {
    std::vector<std::size_t> places = step.order;
    for (std::size_t place = places.size(); place < page.places.size(); ++place) places.push_back(place);
    return places;
}

Json answer_step(SimulatedRater& rater, const Step& step, const StudyPage& shown) {
    const KeyPage& page = rater.key.pages[step.page];
    const std::vector<std::size_t> order = places_shown(step, page);
    Json values = Json::object(), reasons = Json::object();
    for (const std::size_t number : shown.passes[step.pass].questions) {
        const Question& question = rater.key.questions[number];
        Json value = value_of(rater, question, page);
        if (is_reversed(rater.key.scales, number)) value = reversed_answer(question, value);
        if (page.kind == PageKind::check && page.expected.contains(question.id))
            value = answer_check(rater, question, page.expected[question.id], value);
        values[question.id] = to_shown(value, question, order, rater.key.layout);
        const Json reason = reasons_of(rater, question, values[question.id]);
        if (!reason.is_null()) reasons[question.id] = reason;
    }
    const double seconds = shown.seconds;
    const double spent = std::round(10 * (seconds + 2 + 6 * rater.random.uniform())) / 10;
    return {{"page", page.token},
            {"pass", step.pass},
            {"videos", videos_of(page, order)},
            {"values", values},
            {"reasons", reasons},
            {"skipped", false},
            {"seconds", spent},
            {"events", events_of(order, seconds)}};
}

std::vector<double> planted_strengths(const RehearsalJob& job, const StudyKey& key) {
    std::vector<std::string> names;
    for (const KeyCondition& condition : key.conditions) names.push_back(condition.name);
    std::vector<double> strengths(names.size(), 0);
    for (const auto& [name, strength] : job.strengths) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) {
            const auto near = nearest_name(name, names);
            throw Error(
                format("--prefer {}: there is no such condition; {}", name,
                       near ? format("did you mean \"{}\"?", *near) : "the study has " + join(names)));
        }
        strengths[static_cast<std::size_t>(found - names.begin())] = strength;
    }
    return strengths;
}

// At the end no condition is in question.
Json answers_at_end(const SimulatedRater& rater, const StudyPages& pages) {
    SimulatedRater anybody{.key = rater.key,
                           .random = rater.random,
                           .strengths = std::vector<double>(rater.strengths.size(), 0),
                           .leanings = std::vector<double>(rater.leanings.size(), 0)};
    const KeyPage nothing_shown{.places = {KeyPlace{}}};
    Json answers = Json::object();
    for (const Question& question : pages.questionnaire)
        answers[question.id] = value_of(anybody, question, nothing_shown);
    return answers;
}

Json answer_study(SimulatedRater& rater, const StudyPages& pages, std::size_t number) {
    const std::size_t sheet = number % pages.sheets.size();
    Json answers = Json::array();
    for (const Step& step : steps_of_sheet(pages, sheet))
        answers.push_back(answer_step(rater, step, pages.pages[step.page]));
    return {{"format", "chironomia answers 2"},
            {"study", rater.key.study},
            {"participant", format("simulated-{}", number + 1)},
            {"sheet", sheet},
            {"simulated", true},
            {"started", kThen},
            {"finished", kThen},
            {"browser", "none: a simulated rater"},
            {"arrived_with", Json::object()},
            {"questionnaire", answers_at_end(rater, pages)},
            {"answers", answers}};
}

}  // namespace

Json rehearse_study(const RehearsalJob& job) {
    const StudyFolder folder{job.study};
    const StudyKey key = read_study_key(folder.key());
    const StudyPages pages = read_study_pages(folder.open() / "pages.json");
    require_same_study(folder.key(), key, pages);
    const std::vector<double> strengths = planted_strengths(job, key);
    Random random(job.seed);
    std::vector<std::size_t> numbers(job.participants);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    random.shuffle(numbers);
    const auto failing =
        static_cast<std::size_t>(std::lround(job.failing * static_cast<double>(job.participants)));
    const std::set<std::size_t> fails(numbers.begin(),
                                      numbers.begin() + static_cast<std::ptrdiff_t>(failing));
    Json all = Json::array();
    for (std::size_t number = 0; number < job.participants; ++number) {
        const std::uint64_t own = (static_cast<std::uint64_t>(random.next()) << 32) | random.next();
        SimulatedRater rater{
            .key = key, .random = Random(own), .strengths = strengths, .fails = fails.contains(number)};
        for (std::size_t i = 0; i < strengths.size(); ++i)
            rater.leanings.push_back(kOfParticipant * (job.spread / kUsualSpread) * rater.random.normal());
        all.push_back(answer_study(rater, pages, number));
    }
    return all;
}

}  // namespace chironomia::study::analysis
