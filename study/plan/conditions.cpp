#include <algorithm>
#include <set>

#include "core/text.h"
#include "study/design/design.h"
#include "study/plan/parts.h"
#include "synth/speakers/speakers.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kMostParallel = 8;
constexpr double kLongestDelay = 10000;  // [ms]
constexpr double kWidestJitter = 45;     // [degrees]

// Anchors in the order of DegradationKind.
const std::vector<std::string> kMakings = {
    "mismatched speech", "mismatched motion", "frozen", "mirrored", "delayed", "damped", "jittered"};

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// The key of the amount of a degradation names its unit.
double amount_of(const JsonValue& value, std::string_view key, double least, double most) {
    return value.at(key).number(least, most);
}

Degradation read_anchor(const JsonValue& value, const std::string& kind) {
    if (kind == "frozen") return {.kind = DegradationKind::frozen};
    if (kind == "mirrored") return {.kind = DegradationKind::mirrored};
    if (kind == "delayed")
        return {.kind = DegradationKind::delayed, .amount = amount_of(value, "ms", 1, kLongestDelay)};
    if (kind == "damped")
        return {.kind = DegradationKind::damped, .amount = amount_of(value, "factor", 0, 0.999)};
    return {.kind = DegradationKind::jittered, .amount = amount_of(value, "degrees", 0.1, kWidestJitter)};
}

void read_values(const JsonValue& value, LocalManner& manner) {
    std::vector<std::string> symbols;
    for (std::size_t i = 0; i < kExpressivities; ++i)
        symbols.emplace_back(symbol_of(static_cast<Expressivity>(i)));
    value.allow_only(symbols);
    for (std::size_t i = 0; i < kExpressivities; ++i) {
        const auto dimension = static_cast<Expressivity>(i);
        if (const auto given = value.find(symbols[i]))
            manner[dimension] = given->number(least_of(dimension), 1);
    }
}

// What a manner can be from: conditions that have one, and bundled speakers.
std::vector<std::string> names_of_bases(const Plan& plan) {
    std::vector<std::string> names;
    for (const PlanCondition& condition : plan.conditions)
        if (condition.making == Making::manner) names.push_back(condition.name);
    const std::vector<std::string> speakers = speaker_names();
    names.insert(names.end(), speakers.begin(), speakers.end());
    return names;
}

// Whose manner a condition begins with: that of a condition before it, or a speaker's.
void read_base(const JsonValue& from, const Plan& plan, PlanCondition& condition) {
    condition.from = index_of(condition_names(plan), from.text());
    if (condition.from == plan.conditions.size()) {
        condition.speaker = read_speaker_name(from, plan, names_of_bases(plan));
        return;
    }
    const PlanCondition& base = plan.conditions[condition.from];
    if (base.making != Making::manner) {
        from.refuse(
            format("\"{}\" has movements of its own, which no manner changes; name a condition with a "
                   "\"manner\", or a speaker",
                   base.name));
    }
    condition.speaker = base.speaker;
    condition.manner = base.manner;
}

// A condition that the expressive engine performs, in a manner.
PlanCondition read_manner(const JsonValue& value, const Plan& plan) {
    value.allow_only({"name", "from", "manner"});
    PlanCondition condition{.name = value.at("name").text(), .making = Making::manner};
    read_base(value.at("from"), plan, condition);
    read_values(value.at("manner"), condition.manner);
    condition.as_written = value.json();
    return condition;
}

// Names of conditions, in their order.
struct ConditionNames {
    std::vector<std::string> all;
    std::vector<std::string> given;         // those with motions that the plan names
    std::vector<std::string> with_motions;  // and those that are performed
};

// Whose style it is: a condition's, of each clip another person's, or the same one's of all clips.
void read_style_of(const JsonValue& value, const Plan& plan, const ConditionNames& names, PlanStyle& style) {
    const std::string text = value.text();
    if (std::find(names.given.begin(), names.given.end(), text) != names.given.end()) {
        style.of = index_of(names.all, text);
    } else if (style.engine == "mix-stage") {
        style.speaker = text;
    } else if (text.ends_with(".h5")) {
        style.speaker = read_path(value, plan.file.parent_path()).string();
    } else {
        value.refuse(format(
            "is {}, but a condition with motions ({}) or the file of an interval of PATS (.h5) is needed",
            value.shown(), names.given.empty() ? "of which there is none" : join(names.given)));
    }
}

// A condition that a model of style performs.
PlanCondition read_style(const JsonValue& value, const Plan& plan, const ConditionNames& names) {
    value.allow_only({"name", "from", "style_of", "engine", "checkpoint"});
    PlanCondition condition{
        .name = value.at("name").text(), .making = Making::style, .from = plan.conditions.size()};
    PlanStyle& style = condition.style;
    if (const auto engine = value.find("engine")) style.engine = engine->choice({"zs-mstm", "mix-stage"});
    if (const auto from = value.find("from")) style.content = index_of(names.all, from->choice(names.given));
    read_style_of(value.at("style_of"), plan, names, style);
    const bool is_bundled = style.engine == "zs-mstm";
    if (!is_bundled || value.find("checkpoint"))
        style.checkpoint = read_path(value.at("checkpoint"), plan.file.parent_path());
    condition.as_written = value.json();
    return condition;
}

// A condition that the program makes of another.
PlanCondition read_made(const JsonValue& value, const ConditionNames& names) {
    value.allow_only({"name", "from", "by", "ms", "factor", "degrees"});
    PlanCondition condition{.name = value.at("name").text()};
    condition.from = index_of(names.all, value.at("from").choice(names.with_motions));
    const std::string by = value.at("by").choice(kMakings);
    if (by == "mismatched speech") {
        condition.making = Making::mismatched_speech;
    } else if (by == "mismatched motion") {
        condition.making = Making::mismatched_motion;
    } else {
        condition.making = Making::anchor;
        condition.anchor = read_anchor(value, by);
    }
    return condition;
}

// Adds a mismatched condition for every condition.
void add_mismatched(const JsonValue& value, Plan& plan) {
    const bool speech = value.choice({"speech", "motion"}) == "speech";
    const std::size_t given = plan.conditions.size();
    for (std::size_t i = 0; i < given; ++i) {
        if (!has_motions(plan.conditions[i])) continue;
        plan.conditions.push_back({.name = plan.conditions[i].name + " (mismatched)",
                                   .making = speech ? Making::mismatched_speech : Making::mismatched_motion,
                                   .from = i});
    }
}

ConditionNames names_in(const JsonValue& list) {
    ConditionNames names;
    for (const JsonValue& item : list.items(1)) {
        const bool is_given = item.json().is_string();
        const bool is_performed = !is_given && (item.find("manner") || item.find("style_of"));
        const std::string name = is_given ? item.text() : item.at("name").text();
        names.all.push_back(name);
        if (is_given) names.given.push_back(name);
        if (is_given || is_performed) names.with_motions.push_back(name);
    }
    return names;
}

PlanCondition read_condition(const JsonValue& item, const ConditionNames& names, const Plan& plan) {
    if (item.json().is_string()) return {.name = item.text(), .from = plan.conditions.size()};
    if (item.find("manner")) return read_manner(item, plan);
    return item.find("style_of") ? read_style(item, plan, names) : read_made(item, names);
}

void read_condition_list(const JsonValue& list, Plan& plan) {
    const ConditionNames names = names_in(list);
    for (const JsonValue& item : list.items(1)) {
        PlanCondition condition = read_condition(item, names, plan);
        for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
            if (to_lower(names.all[i]) != to_lower(condition.name)) continue;
            item.refuse(
                format("\"{}\" is already {}[{}]; give each its own name", condition.name, list.key(), i));
        }
        plan.conditions.push_back(std::move(condition));
    }
}

using Groups = std::vector<std::vector<std::size_t>>;

// Each condition that is made, beside the one that it is made of.
Groups made_pairs(const Plan& plan) {
    Groups groups;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        if (plan.conditions[i].from != i) groups.push_back({plan.conditions[i].from, i});
    }
    return groups;
}

Groups listed_groups(const JsonValue& value, const Plan& plan, std::size_t size) {
    const std::vector<std::string> names = condition_names(plan);
    Groups groups;
    for (const JsonValue& item : value.items(1)) {
        std::vector<std::size_t> group;
        for (const JsonValue& name : item.items(size)) {
            const std::size_t condition = index_of_choice(name, names);
            if (std::find(group.begin(), group.end(), condition) != group.end())
                name.refuse(format("\"{}\" stands twice on one page", names[condition]));
            group.push_back(condition);
        }
        if (group.size() != size) item.refuse(format("has {} conditions, {} are needed", group.size(), size));
        groups.push_back(std::move(group));
    }
    return groups;
}

// All conditions but the reference, as numbers of conditions.
std::vector<std::size_t> compared(const Plan& plan) {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        if (plan.reference != i) list.push_back(i);
    }
    return list;
}

bool compare_is_list(const JsonValue& whole) {
    const auto compare = whole.find("compare");
    return compare && compare->json().is_array();
}

Groups pairs_of(const Plan& plan, const JsonValue& whole) {
    const auto compare = whole.find("compare");
    if (compare_is_list(whole)) return listed_groups(*compare, plan, 2);
    const bool made =
        compare ? compare->choice({"all", "made"}) == "made" : whole.find("mismatched").has_value();
    if (made) {
        if (made_pairs(plan).empty())
            compare->refuse("is \"made\", but no condition is made of another; add one, or compare \"all\"");
        return made_pairs(plan);
    }
    const std::vector<std::size_t> conditions = compared(plan);
    Groups groups = all_pairs(conditions.size());
    for (auto& group : groups) {
        for (std::size_t& place : group) place = conditions[place];
    }
    return groups;
}

void require_conditions(const JsonValue& whole, const Plan& plan, std::size_t least, std::size_t most) {
    const std::size_t count = plan.conditions.size();
    if (count >= least && count <= most) return;
    whole.at("conditions")
        .refuse(format("has {} entries, {} {} are needed for this layout", count,
                       count < least ? "at least" : "at most", count < least ? least : most));
}

Groups groups_of(const JsonValue& whole, const Plan& plan) {
    Groups groups;
    switch (plan.layout) {
        case Layout::single:
            for (const std::size_t condition : compared(plan)) groups.push_back({condition});
            break;
        case Layout::pair:
            require_conditions(whole, plan, 2, plan.conditions.size());
            groups = pairs_of(plan, whole);
            break;
        case Layout::triplet:
            require_conditions(whole, plan, 3, plan.conditions.size());
            groups = pairs_of(plan, whole);
            for (auto& group : groups) group.insert(group.begin() + 1, *plan.reference);
            break;
        case Layout::parallel:
            require_conditions(whole, plan, 2, kMostParallel);
            groups = {compared(plan)};
            break;
    }
    return groups;
}

void read_layout(const JsonValue& whole, Plan& plan) {
    plan.layout = layout_named(whole.at("layout"));
    const auto value = whole.find("presentation");
    if (!value) return;
    plan.presentation = static_cast<Presentation>(index_of_choice(*value, presentation_names()));
    if (plan.layout != Layout::pair && plan.presentation != Presentation::two_videos)
        value->refuse(format("is {}, which only a \"pair\" can have", value->shown()));
}

// What only another layout has a use for would be passed over.
void refuse_what_does_not_fit(const JsonValue& whole, const Plan& plan) {
    const bool compares = plan.layout == Layout::pair || plan.layout == Layout::triplet;
    const auto compare = whole.find("compare");
    if (compare && !compares) compare->refuse("is of use for the layouts \"pair\" and \"triplet\" alone");
    const auto reference = whole.find("reference");
    if (reference && plan.layout != Layout::triplet)
        reference->refuse("is of use for the layout \"triplet\" alone");
    const auto mismatched = whole.find("mismatched");
    if (mismatched && plan.layout != Layout::pair)
        mismatched->refuse(
            "is of use for the layout \"pair\" alone; make a condition with \"by\" for others");
    // Both figures of one video share its sound.
    if (plan.presentation == Presentation::one_video && has_mismatch(plan)) {
        whole.at("presentation")
            .refuse(
                "is \"one video\", where both conditions share a sound, but one of them is mismatched; show "
                "\"two videos\"");
    }
}

}  // namespace

const std::vector<std::string>& presentation_names() {
    static const std::vector<std::string> names = {"two videos", "one video", "one after the other"};
    return names;
}

std::string kind_of_making(const PlanCondition& condition) {
    switch (condition.making) {
        case Making::mismatched_speech:
            return kMakings[0];
        case Making::mismatched_motion:
            return kMakings[1];
        case Making::anchor:
            return kMakings[2 + static_cast<std::size_t>(condition.anchor.kind)];
        default:
            return "given";
    }
}

std::string name_of_making(const PlanCondition& condition) {
    if (condition.making == Making::anchor) return to_text(condition.anchor);
    if (condition.making == Making::style) {
        return format("{}: {} in the style of {}", condition.style.engine,
                      condition.as_written.value("from", "the speech"),
                      condition.as_written.at("style_of").get<std::string>());
    }
    if (condition.making != Making::manner) return kind_of_making(condition);
    std::string name = "manner: " + std::filesystem::path(condition.speaker).filename().string();
    for (std::size_t i = 0; i < kExpressivities; ++i) {
        const auto dimension = static_cast<Expressivity>(i);
        if (const auto& value = condition.manner[dimension])
            name += format(", {} {:g}", symbol_of(dimension), *value);
    }
    return name;
}

bool is_performed(const PlanCondition& condition) {
    return condition.making == Making::manner || condition.making == Making::style;
}

bool has_motions(const PlanCondition& condition) {
    return condition.making == Making::given || is_performed(condition);
}

bool performs_speech(const Plan& plan) {
    return std::any_of(plan.conditions.begin(), plan.conditions.end(), [](const PlanCondition& condition) {
        return is_performed(condition) && !condition.style.content;
    });
}

void read_conditions(const JsonValue& whole, Plan& plan) {
    read_layout(whole, plan);
    read_condition_list(whole.at("conditions"), plan);
    if (const auto mismatched = whole.find("mismatched")) add_mismatched(*mismatched, plan);
    refuse_what_does_not_fit(whole, plan);
    if (plan.layout == Layout::triplet) {
        const std::vector<std::string> names = condition_names(plan);
        plan.reference = index_of_choice(whole.at("reference"), names);
    }
    plan.groups = groups_of(whole, plan);
    if (const auto compare = whole.find("compare")) {
        plan.compare_as_written = compare->json();
    } else if (whole.find("mismatched")) {
        plan.compare_as_written = "made";
    }
    if (const auto sides = whole.find("sides")) {
        plan.fixed_sides = sides->choice({"balanced", "fixed"}) == "fixed";
        if (plan.fixed_sides && !(compare_is_list(whole) && plan.layout == Layout::pair))
            sides->refuse(
                "is \"fixed\", which needs the layout \"pair\" and \"compare\" with a list of pairs");
    }
    if (const auto tolerance = whole.find("length_tolerance"))
        plan.length_tolerance = tolerance->number(0, 1);
}

}  // namespace chironomia::study
