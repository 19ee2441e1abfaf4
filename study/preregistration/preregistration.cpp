#include "study/preregistration/preregistration.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/design/balance.h"
#include "study/plan/presets.h"
#include "study/record/answer_values.h"

namespace chironomia::study {
namespace {

constexpr std::uint64_t kSeed = 1;  // of simulations and of a design of which only numbers are shown
constexpr double kUsualElo = 100;
constexpr double kUsualDifference = 0.3;  // of the standard deviation of an answer

using Sentences = std::vector<std::string>;

struct Source {
    const Plan& plan;
    const Composition& all;
    const analysis::PowerDesign& design;
    const std::optional<analysis::PowerResult>& power;
};

bool asks(const Plan& plan, const std::function<bool(const Question&)>& is_it) {
    return std::any_of(plan.questions.begin(), plan.questions.end(), is_it);
}

bool asks(const Plan& plan, QuestionKind kind) {
    return asks(plan, [kind](const Question& question) { return question.kind == kind; });
}

bool asks_scores(const Plan& plan) {
    return asks(plan, [](const Question& question) {
        return question.kind == QuestionKind::rating || question.kind == QuestionKind::slider ||
               question.kind == QuestionKind::number || question.kind == QuestionKind::rank;
    });
}

// A score of every video by itself.
bool is_of_each_video(const Question& question) {
    return question.each || (question.kind == QuestionKind::rank && is_of_videos(question));
}

// What the scores of a study are compared with.
enum class Compared {
    conditions,  // those of other conditions
    middle,      // the middle of the scale: they go from one condition to another
    groups,      // those of pages that show other conditions
    nothing,
};

Compared compared_with(const Plan& plan) {
    const bool alone = plan.groups.front().size() == 1;
    if (!asks_scores(plan) || (alone && plan.groups.size() == 1)) return Compared::nothing;
    if (alone || asks(plan, is_of_each_video)) return Compared::conditions;
    const auto is_sided = [&](const Question& question) { return names_a_side(question, plan.layout); };
    if (asks(plan, is_sided)) return Compared::middle;
    return plan.groups.size() > 1 ? Compared::groups : Compared::nothing;
}

std::string quoted(const std::vector<std::string>& names) {
    Sentences each;
    for (const std::string& name : names) each.push_back("\"" + name + "\"");
    return join(each);
}

std::string pages_each(const Composition& all) {
    const auto shorter = [](const Sheet& a, const Sheet& b) { return a.pages.size() < b.pages.size(); };
    const auto [least, most] = std::minmax_element(all.sheets.begin(), all.sheets.end(), shorter);
    if (least->pages.size() == most->pages.size()) return format("{}", least->pages.size());
    return format("{} to {}", least->pages.size(), most->pages.size());
}

// Whether most participants see one condition alone, as the analysis then takes them for groups of different people.
bool is_between_participants(const Source& from) {
    const Design& design = from.all.design;
    const auto seen_alone = std::ranges::count_if(design.sheets, [&](const Sheet& sheet) {
        std::set<std::size_t> seen;
        for (const Showing& shown : sheet.pages)
            seen.insert(design.pages[shown.page].places.begin(), design.pages[shown.page].places.end());
        return seen.size() == 1;
    });
    return 2 * static_cast<std::size_t>(seen_alone) > design.sheets.size();
}

// ---- What plan and program say, item by item

Sentences study_type(const Source&) {
    return {
        "Experiment: which videos a participant sees, on which side and in which order is assigned at random."};
}

Sentences blinding(const Source& from) {
    Sentences says = {
        "Participants do not know which condition a video shows: files, pages and addresses have opaque names, and no "
        "text that they read names a condition.",
        "Which video is of which condition stands in a key apart from the answers; the analysis joins the two."};
    if (from.plan.checks.count > 0)
        says.push_back("No name or form of a page reveals that it is an attention check.");
    return says;
}

Sentences study_design(const Source& from) {
    const Plan& plan = from.plan;
    const Json used = plan_as_used(plan);
    std::string layout = used.at("layout");
    if (used.contains("presentation")) layout += ", " + used.at("presentation").get<std::string>();
    Sentences says = {format("Layout of a page: {}.", layout),
                      format("{} conditions: {}.", plan.conditions.size(), quoted(condition_names(plan)))};
    if (plan.reference)
        says.push_back(format("The reference is \"{}\".", plan.conditions[*plan.reference].name));
    Sentences groups;
    for (const std::vector<std::size_t>& group : plan.groups) {
        Sentences names;
        for (const std::size_t condition : group) names.push_back(plan.conditions[condition].name);
        groups.push_back(join(names, " beside "));
    }
    says.push_back(format("Shown together: {}.", join(groups, "; ")));
    says.push_back(format("{} clips, {} pages of trials; a participant sees {} pages{}.",
                          from.all.judged.size(), from.all.design.pages.size(), pages_each(from.all),
                          plan.checks.count > 0 ? ", attention checks among them" : ""));
    if (plan.participants.blocks > 1)
        says.push_back(
            format("The clips are in {} blocks; a participant sees one.", plan.participants.blocks));
    if (plan.participants.each_clip_once) says.push_back("A participant sees each clip in one comparison.");
    if (plan.passes.size() > 1) says.push_back(format("Each page is shown {} times.", plan.passes.size()));
    if (!plan.preset.empty()) says.push_back(format("The protocol is the preset {}.", plan.preset));
    return says;
}

Sentences randomization(const Source& from) {
    const DesignShape shape = shape_of(from.plan, kSeed);
    Sentences says;
    switch (shape.groups.front().size() == 1 ? SideRule::fixed : shape.sides) {
        case SideRule::fixed:
            if (shape.groups.front().size() > 1) says.push_back("Sides are fixed as the plan lists them.");
            break;
        case SideRule::per_page:
            says.push_back("Sides are drawn for each page, balanced, and are the same for all participants.");
            break;
        case SideRule::mirror:
            says.push_back("Sides are drawn for each page, balanced, and swapped on every other sheet.");
            break;
        case SideRule::rotate:
            says.push_back(
                "Places follow Williams' design: each condition stands at each place equally often.");
            break;
    }
    const bool sampled = shape.each_clip_once || shape.pages_per_sheet;
    says.push_back(format(
        "Pages come in {} orders, {}.", from.all.sheets.size(),
        sampled ? "each of a sample of them in a row of Williams' design" : "rows of Williams' design"));
    says.push_back(
        "A participant is given the sheet that fewest others have finished or are working on; of several the first.");
    says.push_back("All of it is drawn from a seed that is kept with the key.");
    return says;
}

Sentences data_collection(const Source& from) {
    const Plan& plan = from.plan;
    Sentences parts;
    if (!plan.texts.consent.empty()) parts.push_back("consent");
    parts.push_back("instructions");
    if (plan.sound_check) parts.push_back("a sound check");
    if (!from.all.practice.empty()) parts.push_back(format("{} practice pages", from.all.practice.size()));
    parts.push_back(format("{} pages", pages_each(from.all)));
    if (!plan.questionnaire.empty())
        parts.push_back(format("{} questions at the end", plan.questionnaire.size()));
    Sentences says = {format("Online, in a browser. In this order: {}.", join(parts))};
    says.push_back("Every video must be watched to its end before an answer is possible.");
    if (plan.skip_after) says.push_back(format("After {:g} s a page may be skipped.", *plan.skip_after));
    return says;
}

Sentences sample_size(const Source& from) {
    if (!from.plan.participants.wanted) return {};
    return {format("{} participants, each of whom answers {} pages.", *from.plan.participants.wanted,
                   pages_each(from.all))};
}

Sentences sample_size_rationale(const Source& from) {
    if (!from.power) return {};
    const bool prefers = from.design.kind == analysis::AnswerKind::preferences;
    const bool sided = from.design.kind == analysis::AnswerKind::sided_scores;
    const std::string effect =
        prefers ? format("{:g} Elo between two conditions", from.design.effect)
                : format("{:g} standard deviations of an answer {}", from.design.effect,
                         sided ? "from the middle of the scale" : "between two conditions");
    Sentences says = {format("The smallest effect that matters is {}.", effect)};
    const std::string how = format(
        "by {} simulated studies of each size (participants and clips each with a standard deviation of {:g}, "
        "two-sided at {:g} %, not adjusted for several pairs)",
        from.design.runs, from.design.participant_sd, 100 * from.design.significance);
    if (!from.power->needed) {
        says.push_back(format("More than 2000 participants are needed to find it with {:g} % power, {}.",
                              100 * from.design.wanted, how));
    } else {
        says.push_back(format("{} participants find it with {:g} % power, {}.", *from.power->needed,
                              100 * from.design.wanted, how));
        if (from.plan.participants.wanted && *from.plan.participants.wanted < *from.power->needed)
            says.push_back(format("The plan wants {}, which is fewer.", *from.plan.participants.wanted));
    }
    says.push_back("Participants who will be excluded come on top.");
    return says;
}

Sentences stopping_rule(const Source& from) {
    if (!from.plan.participants.wanted) return {};
    return {format(
        "`chironomia study serve` takes no newcomers once {} participants who did not fail the attention "
        "checks have finished or are at work.",
        *from.plan.participants.wanted)};
}

Sentences manipulated_variables(const Source& from) {
    Sentences says;
    for (const PlanCondition& condition : from.plan.conditions) {
        std::string how = "motions that the plan names";
        if (condition.making != Making::given) how = name_of_making(condition);
        if (!has_motions(condition)) how += format(" of \"{}\"", from.plan.conditions[condition.from].name);
        says.push_back(format("\"{}\": {}.", condition.name, how));
    }
    says.push_back("Avatar, camera and light are the same in all conditions of a clip.");
    if (!from.plan.modes_as_written.is_null())
        says.push_back(
            format("How face and hands are shown: {}.", modes_by_condition(from.plan).dump(-1, ' ', true)));
    return says;
}

std::string of_what(const Question& question) {
    if (question.each) return ", of every video";
    return question.sided.value_or(false) ? ", from A to B" : "";
}

std::string scale_of(const Question& question) {
    switch (question.kind) {
        case QuestionKind::preference:
            return format("preference, {} answers: {}", question.answers.size(), quoted(question.answers));
        case QuestionKind::rating:
            return format("rating from 1 to {}{}", question.points, of_what(question));
        case QuestionKind::slider:
            return format("slider from {} to {}{}", question.least.value_or(0), question.most.value_or(100),
                          of_what(question));
        case QuestionKind::choice:
            return "one choice";
        case QuestionKind::rank:
            return "a ranking";
        case QuestionKind::text:
            return "a text";
        case QuestionKind::number:
            return "a number";
    }
    return "";
}

Sentences measured_variables(const Source& from) {
    Sentences says;
    for (const Question& question : from.plan.questions) {
        says.push_back(format("{}: \"{}\" ({}){}", question.id, question.text, scale_of(question),
                              question.reasons ? ", with reasons" : ""));
    }
    for (const Question& question : from.plan.questionnaire)
        says.push_back(format("At the end, {}: \"{}\" ({})", question.id, question.text, scale_of(question)));
    says.push_back("Of each page the seconds, and when videos were played, paused and ended.");
    return says;
}

Sentences indices(const Source& from) {
    if (!asks_scores(from.plan)) return {};
    Sentences says = {"The score of a participant for a condition is the mean over what they rated of it."};
    for (const Scale& scale : from.plan.scales)
        says.push_back(format(
            "Scale {}, of each answer that has all items and analysed like a rating, with Cronbach's alpha: {}",
            scale.id, describe(scale, from.plan.questions)));
    return says;
}

constexpr const char* kAgainstTheMiddle =
    "Scores from A to B: for each two conditions the one-sample t test and Wilcoxon's test of the participants' scores "
    "against the middle of the scale, where the two are equal.";

Sentences models(const Source& from) {
    const Plan& plan = from.plan;
    Sentences says;
    if (asks(plan, QuestionKind::preference)) {
        says.push_back(
            "Preferences: for each two conditions Fisher's exact randomization test of the participants' wins less "
            "losses; beside it the share of decided votes with Clopper and Pearson's interval, and strengths by "
            "Bradley-Terry as Elo with intervals from resampled participants.");
    }
    if (asks_scores(plan) && is_between_participants(from)) {
        says.push_back(
            "Scores: a participant sees one condition. For each two conditions Welch's t test of the participants' "
            "scores; over all a one-way analysis of variance with eta squared, and Fisher's least significant "
            "differences.");
    } else if (compared_with(plan) == Compared::middle && plan.groups.size() == 1) {
        says.push_back(kAgainstTheMiddle);
    } else if (asks_scores(plan)) {
        if (compared_with(plan) == Compared::middle) says.push_back(kAgainstTheMiddle);
        says.push_back(
            "Scores: for each two conditions the paired t test and Wilcoxon's test of the participants' scores.");
        if (plan.conditions.size() > 2)
            says.push_back(
                "Over all conditions, of the participants who rated each of them: Friedman's test with Kendall's W, "
                "and the analysis of variance of repeated measures with Greenhouse and Geisser's correction and "
                "partial and generalized eta squared.");
    }
    if (asks(plan, QuestionKind::choice)) says.push_back("Choices: counts of each option.");
    if (!plan.right_answers.empty()) {
        says.push_back(
            "Right answers: the share that is right, with Clopper and Pearson's interval, beside chance.");
    }
    says.push_back("Agreement: Krippendorff's alpha. All as `chironomia study analyse` computes it.");
    return says;
}

Sentences transformations(const Source& from) {
    Sentences says;
    if (asks(from.plan, QuestionKind::preference))
        says.push_back(
            "A tie counts as half a win; clear answers count double in the strengths and weighted shares.");
    for (const Question& question : from.plan.questions) {
        if (!question.sided) continue;
        says.push_back(question.id +
                       (*question.sided
                            ? ": answers are turned so that the most is for the condition that comes first."
                            : ": answers are about the page as a whole, and stay as they are where the "
                              "videos change sides."));
    }
    const auto is_unsaid = [](const Question& question) { return !question.sided; };
    if (from.plan.layout == Layout::triplet && std::ranges::any_of(from.plan.questions, is_unsaid))
        says.push_back(
            "Answers to triplets are turned so that the most is \"very similar to the condition that comes first\".");
    return says;
}

Sentences inference(const Source&) {
    return {"Two-sided p values, adjusted by Holm among all pairs of a question; intervals of 95 %."};
}

Sentences exclusion(const Source& from) {
    const ExclusionRules& rules = from.plan.exclusions;
    Sentences says;
    if (from.plan.checks.count > 0) {
        says.push_back(format("A participant sees {} attention checks ({}).", from.plan.checks.count,
                              join(from.plan.checks.kinds, " and ")));
        says.push_back(
            format("Strict rule: {} or more failed checks exclude a participant, and so does not finishing.",
                   rules.failed_checks));
        says.push_back(format("Lenient rule: {} or more failed checks do. Results are given by both.",
                              rules.lenient_failed_checks));
        const auto is_slider = [](const Question& one) { return check_tolerance(one) > 0; };
        if (std::any_of(from.plan.questions.begin(), from.plan.questions.end(), is_slider))
            says.push_back("A slider may be up to 3 % of its width beside the value that a check asks for.");
    } else {
        says.push_back(
            "There are no attention checks. By the strict rule those who did not finish are excluded.");
    }
    if (rules.fastest_seconds)
        says.push_back(format("A page that was answered in less than {:g} s is a failed check.",
                              *rules.fastest_seconds));
    return says;
}

Sentences missing_data(const Source&) {
    return {
        "Participants who did not finish count by the lenient rule alone, with the pages that they answered; skipped "
        "pages have no answer and none is filled in."};
}

Sentences nothing(const Source&) {
    return {};
}

struct Item {
    const char* section;
    const char* title;
    const char* key;
    Sentences (*fixed)(const Source&);
    bool needs_people;  // what the plan fixes does not say all of it
};

constexpr Item kItems[] = {
    {"Study information", "Description", "description", nothing, true},
    {"Study information", "Hypotheses", "hypotheses", nothing, true},
    {"Design plan", "Study type", "", study_type, false},
    {"Design plan", "Blinding", "", blinding, false},
    {"Design plan", "Additional blinding", "additional_blinding", nothing, true},
    {"Design plan", "Study design", "", study_design, false},
    {"Design plan", "Randomization", "", randomization, false},
    {"Sampling plan", "Existing data", "existing_data", nothing, true},
    {"Sampling plan", "Explanation of existing data", "existing_data_explanation", nothing, true},
    {"Sampling plan", "Data collection procedures", "data_collection", data_collection, true},
    {"Sampling plan", "Sample size", "", sample_size, false},
    {"Sampling plan", "Sample size rationale", "sample_size_rationale", sample_size_rationale, false},
    {"Sampling plan", "Stopping rule", "stopping_rule", stopping_rule, false},
    {"Variables", "Manipulated variables", "", manipulated_variables, false},
    {"Variables", "Measured variables", "", measured_variables, false},
    {"Variables", "Indices", "indices", indices, false},
    {"Analysis plan", "Statistical models", "models", models, true},
    {"Analysis plan", "Transformations", "transformations", transformations, false},
    {"Analysis plan", "Inference criteria", "inference", inference, false},
    {"Analysis plan", "Data exclusion", "", exclusion, false},
    {"Analysis plan", "Missing data", "missing_data", missing_data, false},
    {"Analysis plan", "Exploratory analysis", "exploratory", nothing, true},
    {"Other", "Other", "other", nothing, true},
};

Sentences said_in(const Plan& plan, const std::string& key) {
    if (key.empty() || !plan.preregistration.is_object() || !plan.preregistration.contains(key)) return {};
    const Json& text = plan.preregistration[key];
    return text.is_array() ? text.get<Sentences>() : Sentences{text.get<std::string>()};
}

std::string missing_in(const Item& item, const PreregistrationItem& made) {
    const bool is_said = !made.said.empty() || (!made.fixed.empty() && !item.needs_people);
    if (is_said) return "";
    if (made.key.empty()) return "The plan does not say it: \"participants\" is missing.";
    std::string where = format("\"preregistration\": {{\"{}\": ...}}", made.key);
    if (made.key == "sample_size_rationale") where += " and \"smallest_effect\" beside it";
    if (made.key == "stopping_rule") where += ", or \"participants\"";
    return format("The plan does not say it: {} is missing.", where);
}

Json to_json(const PreregistrationItem& item) {
    return {{"section", item.section},
            {"title", item.title},
            {"key", item.key.empty() ? Json(nullptr) : Json(item.key)},
            {"fixed", item.fixed},
            {"said", item.said},
            {"missing", item.missing.empty() ? Json(nullptr) : Json(item.missing)}};
}

// Of the preferences that the plan asks for: those with the fewest answers need the most participants.
std::size_t fewest_choices(const Plan& plan) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const Question& question : plan.questions) {
        if (question.kind == QuestionKind::preference) fewest = std::min(fewest, question.answers.size());
    }
    return fewest;
}

[[noreturn]] void refuse_nothing_compared(const Plan& plan) {
    const bool of_pages = asks_scores(plan) && plan.groups.front().size() > 1;
    throw Error(
        format("{}: no effect can be found, because {}; leave --power and \"smallest_effect\" out, or {}",
               plan.file.string(),
               of_pages ? "its questions are about the page as a whole and all pages show the same conditions"
               : asks_scores(plan) ? "there is one condition alone"
                                   : "it asks for neither preferences nor scores",
               of_pages ? "ask with \"each\": true of every video, or with \"sided\": true from A to B"
               : asks_scores(plan) ? "name another condition"
                                   : "ask for a preference, a rating, a slider, a number or a ranking"));
}

// How many trials the sheets have, in turn; as short as it can be.
std::vector<std::size_t> trials_in_turn(const Design& design) {
    std::vector<std::size_t> trials;
    for (const Sheet& sheet : design.sheets) trials.push_back(sheet.pages.size());
    const auto repeats_after = [&](std::size_t count) {
        return trials.size() % count == 0 &&
               std::equal(trials.begin() + static_cast<std::ptrdiff_t>(count), trials.end(), trials.begin());
    };
    std::size_t count = 1;
    while (!repeats_after(count)) ++count;
    trials.resize(count);
    return trials;
}

}  // namespace

analysis::PowerDesign power_design(const Plan& plan, const Composition& all, std::optional<double> effect,
                                   std::uint64_t seed) {
    const std::optional<double> wanted = effect ? effect : plan.smallest_effect;
    analysis::PowerDesign design{
        .clips = all.judged.size(), .answers_each = trials_in_turn(all.design), .seed = seed};
    if (asks(plan, QuestionKind::preference)) {
        design.shares = plan.groups.size();
        design.effect = wanted.value_or(kUsualElo);
        design.choices = fewest_choices(plan);
    } else {
        const Compared compared = compared_with(plan);
        if (compared == Compared::nothing) refuse_nothing_compared(plan);
        const bool of_conditions = compared == Compared::conditions;
        design.kind =
            compared == Compared::middle ? analysis::AnswerKind::sided_scores : analysis::AnswerKind::scores;
        design.shares =
            of_conditions ? plan.conditions.size() - (plan.reference ? 1 : 0) : plan.groups.size();
        design.effect = wanted.value_or(kUsualDifference);
        if (asks(plan, is_of_each_video)) {
            for (std::size_t& answers : design.answers_each) answers *= plan.groups.front().size();
        }
    }
    return design;
}

Preregistration make_preregistration(const Plan& plan, std::optional<double> effect) {
    const Composition all = compose(plan, kSeed);
    analysis::PowerDesign design;
    std::optional<analysis::PowerResult> power;
    if (effect || plan.smallest_effect) {
        design = power_design(plan, all, effect, kSeed);
        power = plan_power(design);
    }
    const Source from = {.plan = plan, .all = all, .design = design, .power = power};
    Preregistration made{.title = plan.texts.title, .items = {}, .data = {}};
    Json items = Json::array();
    for (const Item& item : kItems) {
        made.items.push_back({.section = item.section,
                              .title = item.title,
                              .key = item.key,
                              .fixed = item.fixed(from),
                              .said = said_in(plan, item.key),
                              .missing = {}});
        made.items.back().missing = missing_in(item, made.items.back());
        items.push_back(to_json(made.items.back()));
    }
    const Json used = plan_as_used(plan);
    made.data = {{"format", "chironomia preregistration 1"},
                 {"program", program_version()},
                 {"title", made.title},
                 {"plan_sha256", sha256(used.dump())},
                 {"items", std::move(items)},
                 {"power", power ? to_json(design, *power) : Json(nullptr)},
                 {"plan", used}};
    return made;
}

}  // namespace chironomia::study
