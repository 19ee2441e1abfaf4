#include "synth/planner/plan_signals.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

#include "core/random.h"
#include "synth/markup/script_words.h"
#include "synth/markup/vocabulary.h"

namespace chironomia {
namespace {

// The course of a signal of the usual manner [s]; numbers ours.
struct Course {
    double attack = 0.2;
    double hold = 0.1;
    double decay = 0.3;
};

Course course_of(SignalKind kind) {
    switch (kind) {
        case SignalKind::nod:
            return {0.18, 0.02, 0.3};
        case SignalKind::shake:
            return {0.2, 0.5, 0.3};
        case SignalKind::tilt:
            return {0.4, 0.6, 0.5};
        case SignalKind::brow_raise:
            return {0.2, 0.25, 0.35};
        case SignalKind::frown:
            return {0.3, 0.5, 0.5};
        case SignalKind::smile:
            return {0.5, 1.0, 0.9};
        case SignalKind::sad_mouth:
            return {0.5, 0.9, 0.8};
        case SignalKind::angry_face:
            return {0.35, 0.8, 0.7};
        case SignalKind::surprised:
            return {0.2, 0.5, 0.5};
        case SignalKind::afraid:
            return {0.25, 0.6, 0.6};
        case SignalKind::disgusted:
            return {0.3, 0.6, 0.6};
        case SignalKind::look_away:
            return {0.25, 0.6, 0.3};
        case SignalKind::look_at:
            return {0.25, 0.8, 0.3};
        case SignalKind::shift:
            return {0.9, 0, 0.3};
    }
    return {};
}

// What an act shows besides a gesture: a table that docs/markup.md prints; amounts ours.
struct Shown {
    MarkKind kind;
    std::string_view value;  // "" for every one
    SignalKind signal;
    double amount = 1;  // of the usual size
};
constexpr Shown kShown[] = {
    {MarkKind::performative, "greet", SignalKind::smile, 1},
    {MarkKind::performative, "greet", SignalKind::nod, 1.2},
    {MarkKind::performative, "greet", SignalKind::look_at, 1},
    {MarkKind::performative, "goodbye", SignalKind::smile, 1},
    {MarkKind::performative, "goodbye", SignalKind::nod, 1.2},
    {MarkKind::performative, "goodbye", SignalKind::look_at, 1},
    {MarkKind::performative, "thank", SignalKind::smile, 0.8},
    {MarkKind::performative, "thank", SignalKind::nod, 1.3},
    {MarkKind::performative, "apologise", SignalKind::sad_mouth, 0.5},
    {MarkKind::performative, "apologise", SignalKind::nod, 0.8},
    {MarkKind::performative, "ask", SignalKind::brow_raise, 1.1},
    {MarkKind::performative, "ask", SignalKind::tilt, 0.9},
    {MarkKind::performative, "ask", SignalKind::look_at, 1},
    {MarkKind::performative, "suggest", SignalKind::tilt, 0.6},
    {MarkKind::performative, "suggest", SignalKind::brow_raise, 0.8},
    {MarkKind::performative, "order", SignalKind::nod, 1.1},
    {MarkKind::performative, "agree", SignalKind::nod, 1.2},
    {MarkKind::performative, "refuse", SignalKind::shake, 1},
    {MarkKind::performative, "refuse", SignalKind::frown, 0.6},
    {MarkKind::certainty, "certain", SignalKind::nod, 1},
    {MarkKind::certainty, "uncertain", SignalKind::frown, 0.6},
    {MarkKind::certainty, "uncertain", SignalKind::tilt, 0.8},
    {MarkKind::certainty, "uncertain", SignalKind::look_away, 0.8},
    {MarkKind::belief_relation, "contrast", SignalKind::frown, 0.7},
    {MarkKind::belief_relation, "enumerate", SignalKind::nod, 0.7},
    {MarkKind::emphasis, "low", SignalKind::brow_raise, 0.7},
    {MarkKind::emphasis, "medium", SignalKind::brow_raise, 1},
    {MarkKind::emphasis, "high", SignalKind::brow_raise, 1.2},
    {MarkKind::emphasis, "high", SignalKind::nod, 1.2},
    {MarkKind::deictic, "partner", SignalKind::look_at, 1},
    {MarkKind::deictic, "place-there", SignalKind::look_away, 0.7},
    {MarkKind::emotion, "joy", SignalKind::smile, 1},
    {MarkKind::emotion, "sadness", SignalKind::sad_mouth, 1},
    {MarkKind::emotion, "anger", SignalKind::angry_face, 1},
    {MarkKind::emotion, "fear", SignalKind::afraid, 1},
    {MarkKind::emotion, "surprise", SignalKind::surprised, 1},
    {MarkKind::emotion, "disgust", SignalKind::disgusted, 1},
    {MarkKind::turn, "give", SignalKind::look_at, 1},
    {MarkKind::turn, "keep", SignalKind::look_away, 0.8},
    {MarkKind::backchannel, "agreement", SignalKind::nod, 1},
    {MarkKind::backchannel, "disagreement", SignalKind::shake, 0.8},
    {MarkKind::backchannel, "understanding", SignalKind::nod, 0.8},
    {MarkKind::backchannel, "misunderstanding", SignalKind::frown, 0.8},
    {MarkKind::backchannel, "interest", SignalKind::brow_raise, 0.8},
    {MarkKind::backchannel, "boredom", SignalKind::look_away, 1},
};

// How likely a signal comes with an accent or a boundary at the overall activation 0.5; ours.
constexpr double kNodNuclear = 0.4, kNodOther = 0.12, kBrowNuclear = 0.3, kBrowOther = 0.07;
constexpr double kAwayAtTurn = 0.7, kAwayInTheme = 0.3, kAwayInHesitation = 0.6;
constexpr double kLookAtEnd = 0.5, kShiftAtThought = 0.7;
constexpr double kLongPause = 0.8;    // after which a thought has ended [s]
constexpr double kHesitation = 0.45;  // a pause within a clause [s]

// A signal, and the overall activation above which it is shown.
struct Candidate {
    Signal signal;
    double threshold = 0;
};

// Signals of one channel exclude one another.
int channel_of_signal(SignalKind kind) {
    return static_cast<int>(kind == SignalKind::look_at ? SignalKind::look_away : kind);
}

class SignalPlanner {
  public:
    explicit SignalPlanner(const SignalPlan& plan) : plan_(plan) {}

    std::vector<Signal> plan() {
        for (const PlannedAct& act : plan_.acts) add_act(act);
        add_accents();
        add_pauses();
        return chosen();
    }

  private:
    // Each random choice has its own stream, so that none depends on what else is shown.
    enum Stream : std::uint64_t { of_acts = 1, of_accents, of_pauses };

    Random random_of(Stream stream, std::size_t index) const {
        return Random(plan_.seed, (static_cast<std::uint64_t>(index) << 2) | stream);
    }

    // `signal` has its kind, its peak and its amount; the rest follows from them and from the manner.
    void add(Signal signal, const Manner& manner, double threshold) {
        const Course course = course_of(signal.kind);
        signal.peak = std::max(0.0, signal.peak);
        signal.start = std::max(0.0, signal.peak - course.attack * (1 - 0.5 * manner[Expressivity::power]));
        signal.hold = signal.peak + course.hold;
        signal.end = signal.hold + course.decay;
        signal.amount =
            std::clamp(signal.amount * (1 + 0.5 * manner[Expressivity::spatial_extent]), 0.05, 2.0);
        candidates_.push_back({signal, threshold});
    }

    // Shown where `drawn` is less than the chance, which is `likely` at an activation of 0.5 and grows with
    // it.
    static double threshold_of_chance(double drawn, double likely) { return drawn / (2 * likely); }

    // At the times that its author gave; what they leave open follows from the usual course.
    void add_asked(const PlannedAct& act, const Mark& mark) {
        constexpr double kShortest = 0.1;  // [s]
        const SignalKind kind = *signal_named(mark.value);
        const MarkTimes& times = mark.times;
        const Course course = course_of(kind);
        const auto at = [&](const std::optional<SyncPoint>& point) -> std::optional<double> {
            return point ? std::optional(std::max(0.0, time_of(*point, plan_.speech))) : std::nullopt;
        };
        const auto start = at(times.start), relax = at(times.relax), end = at(times.end);
        std::optional<double> peak;
        for (const auto& point : {times.stroke, times.ready, times.stroke_start, times.stroke_end})
            if (!peak) peak = at(point);
        const bool is_movement = kind == SignalKind::nod || kind == SignalKind::shake;
        if (!peak && start && end && is_movement) peak = (*start + *end) / 2;
        if (!peak && start) peak = *start + course.attack;
        if (!peak && relax) peak = *relax - course.hold;
        if (!peak && end) peak = *end - course.decay - course.hold;
        Signal signal{.kind = kind, .peak = std::max(0.0, peak.value_or(act.moment))};
        signal.start = start.value_or(std::max(0.0, signal.peak - course.attack));
        const double usual = signal.peak + course.hold;
        signal.hold = relax.value_or(end && !is_movement ? *end - course.decay : usual);
        signal.end = std::max(end.value_or(signal.hold + course.decay), signal.start + kShortest);
        signal.peak = std::clamp(signal.peak, signal.start, signal.start + (signal.end - signal.start) / 2);
        signal.hold = std::clamp(signal.hold, signal.peak, signal.end);
        signal.amount = std::clamp(1 + 0.5 * act.manner[Expressivity::spatial_extent], 0.05, 2.0);
        candidates_.push_back({signal, threshold_of(act, mark.weight)});
    }

    void add_act(const PlannedAct& act) {
        const Mark& mark = plan_.speech.marks[act.mark];
        if (mark.kind == MarkKind::signal) return add_asked(act, mark);
        const double threshold = threshold_of(act, mark.weight);
        for (const Shown& shown : kShown)
            if (shown.kind == mark.kind && shown.value == mark.value)
                add({.kind = shown.signal, .peak = act.moment, .amount = shown.amount}, act.manner,
                    threshold);
        add_gaze(act, mark);
    }

    // Speakers look away when they take the turn and at themes, and look at the partner when they end.
    void add_gaze(const PlannedAct& act, const Mark& mark) {
        Random random = random_of(of_acts, act.mark);
        const double drawn = random.uniform();
        const double begin = time_of({mark.first_word, 0}, plan_.speech);
        if (mark.kind == MarkKind::turn && mark.value == "take") {
            add({.kind = SignalKind::look_away, .peak = begin + 0.2}, act.manner,
                threshold_of_chance(drawn, kAwayAtTurn));
        } else if (mark.kind == MarkKind::theme) {
            add({.kind = SignalKind::look_away, .peak = begin + 0.1, .amount = 0.8}, act.manner,
                threshold_of_chance(drawn, kAwayInTheme));
        } else if (mark.kind == MarkKind::boundary && (mark.value == "LL" || mark.value == "HH")) {
            const double end = end_before(mark.first_word);
            add({.kind = SignalKind::look_at, .peak = end - 0.1}, act.manner,
                threshold_of_chance(drawn, kLookAtEnd));
            const bool ends_paragraph = mark.weight >= 0.9;
            if (ends_paragraph)
                add({.kind = SignalKind::shift, .peak = end + 0.5}, act.manner,
                    threshold_of_chance(random.uniform(), kShiftAtThought));
        }
    }

    double end_before(std::size_t word) const { return word == 0 ? 0 : plan_.speech.words[word - 1].end; }

    // A "no" whose accent nods would be none. Whether the head shakes at this activation does not matter: a higher one
    // only adds.
    bool is_shaken_at(double time) const {
        return std::ranges::any_of(candidates_, [&](const Candidate& candidate) {
            return candidate.signal.kind == SignalKind::shake && candidate.signal.start < time &&
                   time < candidate.signal.end;
        });
    }

    void add_accents() {
        for (const Accent& accent : plan_.accents.all()) {
            Random random = random_of(of_accents, accent.word);
            const double nod =
                threshold_of_chance(random.uniform(), accent.is_nuclear ? kNodNuclear : kNodOther);
            const double brow =
                threshold_of_chance(random.uniform(), accent.is_nuclear ? kBrowNuclear : kBrowOther);
            const double amount = 0.6 + 0.4 * random.uniform();
            if (!is_shaken_at(accent.time))
                add({.kind = SignalKind::nod, .peak = accent.time, .amount = amount}, plan_.speaker, nod);
            add({.kind = SignalKind::brow_raise, .peak = accent.time, .amount = 0.6 + 0.4 * random.uniform()},
                plan_.speaker, brow);
        }
    }

    void add_pauses() {
        const std::vector<SpokenWord>& words = plan_.speech.words;
        const Vocabulary& vocabulary = Vocabulary::of(plan_.speech.language);
        for (std::size_t word = 0; word + 1 < words.size(); ++word) {
            Random random = random_of(of_pauses, word);
            const double drawn = random.uniform();
            const double pause = words[word + 1].start - words[word].end;
            const Clause clause = plan_.accents.clause_of(word);
            const bool is_inside = word >= clause.first && word + 1 < clause.end;
            const bool hesitates = vocabulary.is_hesitation(plain_letters(words[word].text)) ||
                                   (is_inside && pause >= kHesitation);
            if (hesitates)
                add({.kind = SignalKind::look_away, .peak = words[word].end, .amount = 0.9}, plan_.speaker,
                    threshold_of_chance(drawn, kAwayInHesitation));
            else if (pause >= kLongPause)
                add({.kind = SignalKind::shift, .peak = words[word].end + 0.5 * pause}, plan_.speaker,
                    threshold_of_chance(drawn, kShiftAtThought));
        }
    }

    // From the likeliest on, each where its channel is still free: what is shown at one activation is shown
    // at every higher one, too.
    std::vector<Signal> chosen() {
        const double activation = plan_.speaker[Expressivity::overall_activation];
        std::stable_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
            return std::tuple(a.threshold, a.signal.peak) < std::tuple(b.threshold, b.signal.peak);
        });
        std::map<int, std::map<double, double>> busy;  // by channel: start -> end
        std::vector<Signal> signals;
        for (const Candidate& candidate : candidates_) {
            if (!(activation > candidate.threshold)) break;
            const Signal& signal = candidate.signal;
            std::map<double, double>& times = busy[channel_of_signal(signal.kind)];
            const auto next = times.lower_bound(signal.start);
            const bool meets_next = next != times.end() && next->first < signal.end;
            const bool meets_last = next != times.begin() && std::prev(next)->second > signal.start;
            if (meets_next || meets_last) continue;
            times.emplace(signal.start, signal.end);
            signals.push_back(signal);
        }
        std::stable_sort(signals.begin(), signals.end(), [](const Signal& a, const Signal& b) {
            return std::tuple(a.start, a.kind) < std::tuple(b.start, b.kind);
        });
        return signals;
    }

    const SignalPlan& plan_;
    std::vector<Candidate> candidates_;
};

}  // namespace

std::vector<Signal> plan_signals(const SignalPlan& plan) {
    return SignalPlanner(plan).plan();
}

}  // namespace chironomia
