#include "synth/presence/attend.h"

#include <algorithm>

#include "core/random.h"
#include "synth/presence/curve.h"

namespace chironomia {
namespace {

struct RiseHoldFall {
    double rise = 0, hold = 0, fall = 0;  // [s]
};

// Listening and turn-taking. All numbers are ours, by eye. Probabilities hold at an overall activation of 0.5.
struct AttendParameters {
    // Nods of a listener.
    double pause_nod = 0.7, accent_nod = 0.12;                             // probability at each
    DrawRange pause_nod_amount{0.55, 0.95}, accent_nod_amount{0.35, 0.6};  // 1: a usual nod
    double accent_seconds = 0.15;    // from an accent to the end of its syllable [s]
    DrawRange nod_delay{0.12, 0.4};  // [s]
    RiseHoldFall nod{0.26, 0.02, 0.34};
    double double_nod = 0.3;  // probability
    RiseHoldFall second_nod{0.22, 0.02, 0.32};
    double second_nod_delay = 0.5;                   // from start to start [s]
    double second_nod_amount = 0.65;                 // of the first
    double after_nod = 1.2, after_double_nod = 1.7;  // until the next may start, from start to start [s]

    // Raised brows of a listener in a pause.
    double brow_raise = 0.15;        // probability
    DrawRange brow_delay{0.1, 0.5};  // [s]
    RiseHoldFall brow{0.25, 0.4, 0.4};
    DrawRange brow_amount{0.4, 0.8};  // 1: a usual raise

    // Gaze at the ends of a turn.
    DrawRange look_away_before_turn{0, 0.25};  // [s]
    DrawRange look_away_seconds{0.7, 1.3};     // [s]
    double look_away_change = 0.1;             // rise and fall [s]
    double look_away_amount = 0.8;             // 1: a usual look away
    double look_at_before_end = 0.7;           // [s]
    RiseHoldFall look_at{0.1, 0.8, 0.2};
    double near_gaze = 1;  // the planner's own gaze signal within this replaces these looks [s]

    // The planner shapes its signals by the same two factors (plan_behaviours.h).
    double rise_by_power = 0.5, amount_by_extent = 0.5;
    double activation_offset = 0.5;  // probabilities are multiplied by this + overall activation
};
constexpr AttendParameters kAttend;

bool is_gaze(const Signal& signal) {
    return signal.kind == SignalKind::look_at || signal.kind == SignalKind::look_away;
}

// Adds signals of listening and turn-taking to those of the person's own acts.
class Attention {
  public:
    Attention(std::vector<Signal> signals, const Manner& manner, Random random)
        : signals_(std::move(signals)), manner_(manner), random_(random) {}

    // At the beginning of a pause or at the end of an accented syllable of the partner.
    void may_nod(double time, double chance, const DrawRange& amounts) {
        const bool nods = draw_whether(chance);
        const bool twice = random_.uniform() < kAttend.double_nod;
        const double later = time + draw_between(random_, kAttend.nod_delay);
        const double amount = draw_between(random_, amounts);
        if (!nods || later < free_from_) return;
        add(SignalKind::nod, later, kAttend.nod, amount);
        if (twice) {
            add(SignalKind::nod, later + kAttend.second_nod_delay, kAttend.second_nod,
                kAttend.second_nod_amount * amount);
        }
        free_from_ = later + (twice ? kAttend.after_double_nod : kAttend.after_nod);
    }

    void may_raise_brows(double time) {
        const bool raises = draw_whether(kAttend.brow_raise);
        const double later = time + draw_between(random_, kAttend.brow_delay);
        if (raises)
            add(SignalKind::brow_raise, later, kAttend.brow, draw_between(random_, kAttend.brow_amount));
    }

    void take_turn(double time) {
        const double start = time - draw_between(random_, kAttend.look_away_before_turn);
        const double seconds = draw_between(random_, kAttend.look_away_seconds);
        const RiseHoldFall times{kAttend.look_away_change, seconds, kAttend.look_away_change};
        if (!gaze_near(time)) add(SignalKind::look_away, start, times, kAttend.look_away_amount);
    }

    void yield_turn(double time) {
        if (!gaze_near(time)) add(SignalKind::look_at, time - kAttend.look_at_before_end, kAttend.look_at, 1);
    }

    std::vector<Signal> take() {
        std::stable_sort(signals_.begin(), signals_.end(),
                         [](const Signal& a, const Signal& b) { return a.start < b.start; });
        return std::move(signals_);
    }

  private:
    bool draw_whether(double chance) {
        return random_.uniform() <
               chance * (kAttend.activation_offset + manner_[Expressivity::overall_activation]);
    }

    bool gaze_near(double time) const {
        return std::any_of(signals_.begin(), signals_.end(), [&](const Signal& signal) {
            return is_gaze(signal) && signal.start - kAttend.near_gaze < time &&
                   time < signal.end + kAttend.near_gaze;
        });
    }

    void add(SignalKind kind, double start, const RiseHoldFall& times, double amount) {
        const double peak = start + times.rise * (1 - kAttend.rise_by_power * manner_[Expressivity::power]);
        const double size = amount * (1 + kAttend.amount_by_extent * manner_[Expressivity::spatial_extent]);
        signals_.push_back({kind, start, peak, peak + times.hold, peak + times.hold + times.fall, size});
    }

    std::vector<Signal> signals_;
    Manner manner_;
    Random random_;
    double free_from_ = 0;  // for the next nod [s]
};

// Occasions ascend in time, because a nod depends on the one before.
void listen(Attention& attention, const FloorTime& floor, const HeardPartner& partner) {
    struct Occasion {
        double time;
        bool pause;
    };
    std::vector<Occasion> occasions;
    const auto within = [&](double time) { return time >= floor.start && time <= floor.silent; };
    for (const Phrase& phrase : partner.phrases)
        if (within(phrase.start)) occasions.push_back({phrase.end, true});
    for (const double accent : partner.accents)
        if (within(accent)) occasions.push_back({accent + kAttend.accent_seconds, false});
    std::stable_sort(occasions.begin(), occasions.end(),
                     [](const Occasion& a, const Occasion& b) { return a.time < b.time; });
    for (const Occasion& occasion : occasions) {
        if (occasion.pause) {
            attention.may_nod(occasion.time, kAttend.pause_nod, kAttend.pause_nod_amount);
            attention.may_raise_brows(occasion.time);
        } else {
            attention.may_nod(occasion.time, kAttend.accent_nod, kAttend.accent_nod_amount);
        }
    }
}

}  // namespace

std::vector<Signal> attend(std::vector<Signal> signals, const AttendInputs& inputs) {
    Attention attention(std::move(signals), inputs.speaker.manner, Random(inputs.seed, 500));
    const std::vector<FloorTime>& floors = inputs.floors;
    for (std::size_t i = 0; i < floors.size(); ++i) {
        if (floors[i].person != inputs.person) {
            listen(attention, floors[i], inputs.partner);
            continue;
        }
        attention.take_turn(floors[i].start);
        if (i + 1 < floors.size()) attention.yield_turn(floors[i].silent);
    }
    return attention.take();
}

}  // namespace chironomia
