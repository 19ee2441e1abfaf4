#include "synth/planner/plan_gestures.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "synth/markup/functions.h"

namespace chironomia {
namespace {

constexpr std::size_t kMostAccents = 64;  // of one gesture

// Of several acts on one word the one with the highest priority is shown.
int priority_of(const Mark& mark) {
    switch (mark.kind) {
        case MarkKind::gesture:
            return 6;
        case MarkKind::world:
        case MarkKind::deictic:
            return 5;
        case MarkKind::performative:
            return mark.value == "inform" ? 2 : 4;
        case MarkKind::emotion:
        case MarkKind::certainty:
        case MarkKind::belief_relation:
            return 3;
        case MarkKind::turn:
        case MarkKind::backchannel:
            return 2;
        case MarkKind::emphasis:
            return 1;
        default:
            return 0;
    }
}

bool is_shown_by_beats(MarkKind kind) {
    return kind == MarkKind::emphasis || kind == MarkKind::pitch_accent || kind == MarkKind::rheme ||
           kind == MarkKind::theme;
}

std::string unknown_gesture(const std::string& name, const Lexicon& lexicon) {
    std::vector<std::string> names;
    for (const Gesture& gesture : lexicon.gestures) names.push_back(gesture.id);
    const std::optional<std::string> nearest = nearest_name(name, names);
    return format(
        "gesture \"{}\": none of the {} gestures of the lexicon has this name; {}, or say what it shows "
        "(reference=\"performative=ask\")",
        name, names.size(),
        nearest ? format("did you mean {}? Write one that is there", *nearest) : "write one of its names");
}

// The gestures of a lexicon by what they show.
class Repertoire {
  public:
    explicit Repertoire(const Lexicon& lexicon) : lexicon_(lexicon) {
        for (std::size_t g = 0; g < lexicon.gestures.size(); ++g) {
            by_name_[lexicon.gestures[g].id] = g;
            for (const std::string& function : lexicon.gestures[g].functions)
                by_function_[function].push_back(g);
            if (lexicon.gestures[g].category == GestureCategory::beat) beats_.push_back(g);
        }
    }

    std::vector<std::size_t> candidates(const Mark& mark) const {
        if (mark.kind == MarkKind::gesture) return candidates_of_name(mark);
        std::vector<std::size_t> found = candidates_of(function_of(mark));
        return found.empty() && is_shown_by_beats(mark.kind) ? beats_ : found;
    }

    const std::vector<std::size_t>& beats() const { return beats_; }

    // Of what an author asked for by its meaning, and no gesture has; nothing of other marks.
    std::optional<std::string> note_of_missing(const Mark& mark) const {
        if (mark.kind == MarkKind::gesture) {
            if (by_name_.contains(mark.value) || is_function_of_beats(mark.reference)) return std::nullopt;
            if (!candidates_of(mark.reference).empty()) return std::nullopt;
            return format("gesture \"{}\": no gesture of the lexicon shows {}; a beat is shown", mark.value,
                          mark.reference);
        }
        const std::string function = function_of(mark);
        if (!mark.value.starts_with("x-") || by_function_.contains(function)) return std::nullopt;
        std::vector<std::string> names;
        for (const auto& [name, gestures] : by_function_) names.push_back(name);
        std::ranges::sort(names);
        const std::optional<std::string> nearest = nearest_name(function, names);
        return format("no gesture of the lexicon names {}{}; give one this function", function,
                      nearest ? format(", but one names {}", *nearest) : "");
    }

  private:
    static bool is_function_of_beats(std::string_view function) {
        const std::string_view kind = function.substr(0, function.find('='));
        return std::ranges::any_of(
            std::array{MarkKind::emphasis, MarkKind::pitch_accent, MarkKind::rheme, MarkKind::theme},
            [&](MarkKind beat) { return kind == name_of(beat); });
    }

    std::vector<std::size_t> candidates_of_name(const Mark& mark) const {
        if (const auto named = by_name_.find(mark.value); named != by_name_.end()) return {named->second};
        if (mark.reference.empty()) throw Error(unknown_gesture(mark.value, lexicon_));
        std::vector<std::size_t> found = candidates_of(mark.reference);
        return found.empty() ? beats_ : found;
    }

    // "world=shape-round", "world=shape", "world"
    std::vector<std::size_t> candidates_of(std::string function) const {
        for (;;) {
            const auto found = by_function_.find(function);
            if (found != by_function_.end()) return found->second;
            const std::size_t sign = function.find('=');
            if (sign == std::string::npos) return {};
            const std::size_t dash = function.rfind('-');
            function.resize(dash != std::string::npos && dash > sign ? dash : sign);
        }
    }

    const Lexicon& lexicon_;
    std::unordered_map<std::string, std::size_t> by_name_;
    std::unordered_map<std::string, std::vector<std::size_t>> by_function_;
    std::vector<std::size_t> beats_;
};

// When the stroke of a gesture with times of its own ends: with the stroke, or else with an accent between
// its beginning and its end.
double stroke_end_of(const Mark& mark, const GesturePlan& plan, double otherwise) {
    constexpr double kStroke = 0.3;   // from where the hand is ready to the end of the stroke [s]
    constexpr double kHold = 0.2;     // from there to the relaxation [s]
    constexpr double kSoonest = 0.1;  // after the beginning, for an accent to be met [s]
    const auto at = [&](const std::optional<SyncPoint>& point) { return time_of(*point, plan.speech); };
    if (mark.times.stroke_end) return at(mark.times.stroke_end);
    if (mark.times.stroke) return at(mark.times.stroke);
    const auto first_of = [](auto... points) {
        std::optional<SyncPoint> found;
        ((found = found ? found : points), ...);
        return found;
    };
    const auto begins = first_of(mark.times.stroke_start, mark.times.ready, mark.times.start);
    const auto ends = first_of(mark.times.relax, mark.times.end);
    if (!begins && !ends) return otherwise;
    const double lowest = begins ? at(begins) + kSoonest : -std::numeric_limits<double>::infinity();
    const double highest = ends ? at(ends) : std::numeric_limits<double>::infinity();
    for (const Accent& accent : plan.accents.all()) {
        const bool is_mine = accent.word >= mark.first_word && accent.word < mark.end_word;
        if (is_mine && accent.time >= lowest && accent.time <= highest) return accent.time;
    }
    return begins ? std::min(at(begins) + kStroke, std::max(highest, at(begins))) : highest - kHold;
}

// A gesture that an act may become.
struct Choice {
    const PlannedAct* act = nullptr;
    std::vector<std::size_t> order;  // of its candidates, as this act prefers them
    double stroke_end = 0;
    std::size_t word = 0;
    bool left_hand = false;
};

class GesturePlanner {
  public:
    explicit GesturePlanner(const GesturePlan& plan) : plan_(plan), repertoire_(plan.style.lexicon) {}

    PlannedGestures plan() {
        PlannedGestures planned;
        std::map<std::size_t, Choice> best;  // by word
        for (const PlannedAct& act : plan_.acts) {
            const auto missing = repertoire_.note_of_missing(mark_of(act));
            if (missing && std::ranges::find(planned.notes, *missing) == planned.notes.end())
                planned.notes.push_back(*missing);
            std::optional<Choice> choice = choose(act);
            if (!choice) continue;
            const auto [other, is_first] = best.try_emplace(choice->word, *choice);
            if (is_first) continue;
            if (is_better(*choice, other->second)) std::swap(*choice, other->second);
            if (mark_of(*choice->act).kind == MarkKind::gesture)
                planned.notes.push_back(describe_drop(*choice, other->second));
        }
        std::vector<Choice> choices;
        for (auto& [word, choice] : best) choices.push_back(std::move(choice));
        std::stable_sort(choices.begin(), choices.end(),
                         [](const Choice& a, const Choice& b) { return a.stroke_end < b.stroke_end; });
        std::vector<PlannedGesture>& gestures = planned.gestures;
        for (const Choice& choice : choices)
            gestures.push_back(gesture_for(
                choice, gestures.empty() ? std::nullopt : std::optional(gestures.back().gesture)));
        return planned;
    }

  private:
    const Mark& mark_of(const PlannedAct& act) const { return plan_.speech.marks[act.mark]; }

    std::optional<Choice> choose(const PlannedAct& act) const {
        const Mark& mark = mark_of(act);
        if (mark.first_word == mark.end_word) return std::nullopt;
        // Names are looked up whether they are shown or not: a wrong one is wrong at any activation.
        Choice choice{.act = &act, .order = repertoire_.candidates(mark)};
        if (choice.order.empty()) return std::nullopt;
        if (!(mark.weight > 1 - act.manner[Expressivity::overall_activation])) return std::nullopt;
        Random random(plan_.seed, act.mark);
        choice.left_hand = random.uniform() < (1 - plan_.style.speaker.handedness) / 2;
        random.shuffle(choice.order);
        // If one beat alone matches, other beats may be shown too.
        if (is_shown_by_beats(mark.kind) && choice.order.size() == 1) {
            std::vector<std::size_t> others = repertoire_.beats();
            random.shuffle(others);
            choice.order.insert(choice.order.end(), others.begin(), others.end());
        }
        choice.word = act.word;
        choice.stroke_end = act.moment;  // the stressed vowel of that word
        if (mark.kind == MarkKind::gesture) {
            choice.stroke_end = std::max(0.0, stroke_end_of(mark, plan_, act.moment));
            choice.word = word_at(choice.stroke_end);
        }
        return choice;
    }

    std::size_t word_at(double time) const {
        const std::vector<SpokenWord>& words = plan_.speech.words;
        const auto behind = std::partition_point(words.begin(), words.end(),
                                                 [&](const SpokenWord& word) { return word.start <= time; });
        return behind == words.begin() ? 0 : static_cast<std::size_t>(behind - words.begin()) - 1;
    }

    std::string describe_drop(const Choice& dropped, const Choice& shown) const {
        return format(
            "gesture \"{}\" at {:.2f} s dropped: gesture \"{}\" at {:.2f} s is on the same word, \"{}\"",
            mark_of(*dropped.act).value, dropped.stroke_end, mark_of(*shown.act).value, shown.stroke_end,
            plan_.speech.words[dropped.word].text);
    }

    bool is_better(const Choice& choice, const Choice& other) const {
        const Mark &mine = mark_of(*choice.act), &its = mark_of(*other.act);
        if (priority_of(mine) != priority_of(its)) return priority_of(mine) > priority_of(its);
        if (mine.weight != its.weight) return mine.weight > its.weight;
        return mine.end_word - mine.first_word < its.end_word - its.first_word;
    }

    PlannedGesture gesture_for(const Choice& choice, std::optional<std::size_t> last) const {
        const Mark& mark = mark_of(*choice.act);
        const auto other = std::find_if(choice.order.begin(), choice.order.end(),
                                        [&](std::size_t gesture) { return gesture != last; });
        const Clause clause = plan_.accents.clause_of(choice.word);
        PlannedGesture planned{.gesture = other == choice.order.end() ? choice.order.front() : *other,
                               .function = mark.reference.empty() ? function_of(mark) : mark.reference,
                               .stroke_end = choice.stroke_end,
                               .rheme_start = plan_.speech.words[clause.first].start,
                               .rheme_end = plan_.speech.words[clause.end - 1].end,
                               .left_hand = choice.left_hand,
                               .weight = mark.weight,
                               .manner = choice.act->manner};
        if (mark.kind == MarkKind::gesture) {
            if (mark.times.relax) planned.relax = time_of(*mark.times.relax, plan_.speech);
            if (mark.times.end) planned.end = time_of(*mark.times.end, plan_.speech);
        }
        add_accents(planned);
        return planned;
    }

    // On which a stroke may be repeated: those up to the lookahead of the greatest repetition, 1.
    void add_accents(PlannedGesture& planned) const {
        const double horizon = planned.rheme_start + 2 * plan_.style.variants.repetition_lookahead *
                                                         (planned.rheme_end - planned.rheme_start);
        const std::vector<Accent>& all = plan_.accents.all();
        auto accent = std::partition_point(all.begin(), all.end(),
                                           [&](const Accent& a) { return a.time <= planned.stroke_end; });
        for (; accent != all.end() && accent->time <= horizon && planned.accents.size() < kMostAccents;
             ++accent)
            planned.accents.push_back(accent->time);
    }

    const GesturePlan& plan_;
    Repertoire repertoire_;
};

}  // namespace

void check_gesture_names(const MarkedText& text, const Lexicon& lexicon) {
    for (const AskedGesture& asked : text.asked_gestures)
        if (!find_gesture(lexicon, asked.name))
            throw Error(format("{}: {}", asked.place, unknown_gesture(asked.name, lexicon)));
}

PlannedGestures plan_gestures(const GesturePlan& plan) {
    return GesturePlanner(plan).plan();
}

}  // namespace chironomia
