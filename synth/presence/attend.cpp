#include "synth/presence/attend.h"

#include <algorithm>

#include "core/random.h"
#include "synth/presence/curve.h"

namespace chironomia {
namespace {

bool is_gaze(const Signal& signal) {
    return signal.kind == SignalKind::look_at || signal.kind == SignalKind::look_away;
}

// Signals that are added to somebody's own.
class Attention {
  public:
    Attention(std::vector<Signal> signals, const Manner& manner, Random random)
        : signals_(std::move(signals)), manner_(manner), random_(random) {}

    // The partner pauses, or ends an accented syllable.
    void may_nod(double time, double chance, double least, double most) {
        const bool nods = draw_whether(chance);
        const bool twice = random_.uniform() < 0.3;
        const double later = time + draw_between(random_, 0.12, 0.4);
        const double amount = draw_between(random_, least, most);
        if (!nods || later < free_from_) return;
        add(SignalKind::nod, later, 0.26, 0.02, 0.34, amount);
        if (twice) add(SignalKind::nod, later + 0.5, 0.22, 0.02, 0.32, 0.65 * amount);
        free_from_ = later + (twice ? 1.7 : 1.2);
    }

    void may_raise_brows(double time) {
        const bool raises = draw_whether(0.15);
        const double later = time + draw_between(random_, 0.1, 0.5);
        if (raises) add(SignalKind::brow_raise, later, 0.25, 0.4, 0.4, draw_between(random_, 0.4, 0.8));
    }

    void take_turn(double time) {
        const double start = time - draw_between(random_, 0, 0.25), seconds = draw_between(random_, 0.7, 1.3);
        if (!gaze_near(time)) add(SignalKind::look_away, start, 0.1, seconds, 0.1, 0.8);
    }

    void yield_turn(double time) {
        if (!gaze_near(time)) add(SignalKind::look_at, time - 0.7, 0.1, 0.8, 0.2, 1);
    }

    std::vector<Signal> take() {
        std::stable_sort(signals_.begin(), signals_.end(),
                         [](const Signal& a, const Signal& b) { return a.start < b.start; });
        return std::move(signals_);
    }

  private:
    bool draw_whether(double chance) {
        return random_.uniform() < chance * (0.5 + manner_[Expressivity::overall_activation]);
    }

    bool gaze_near(double time) const {
        constexpr double kNear = 1;
        return std::any_of(signals_.begin(), signals_.end(), [&](const Signal& signal) {
            return is_gaze(signal) && signal.start - kNear < time && time < signal.end + kNear;
        });
    }

    void add(SignalKind kind, double start, double rise, double hold, double fall, double amount) {
        // In the person's manner, as the planner shapes those of their own acts.
        const double peak = start + rise * (1 - 0.5 * manner_[Expressivity::power]);
        const double size = amount * (1 + 0.5 * manner_[Expressivity::spatial_extent]);
        signals_.push_back({kind, start, peak, peak + hold, peak + hold + fall, size});
    }

    std::vector<Signal> signals_;
    Manner manner_;
    Random random_;
    double free_from_ = 0;  // for the next nod [s]
};

// In the order of time, so that nods keep their distance.
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
        if (within(accent)) occasions.push_back({accent + 0.15, false});
    std::stable_sort(occasions.begin(), occasions.end(),
                     [](const Occasion& a, const Occasion& b) { return a.time < b.time; });
    for (const Occasion& occasion : occasions) {
        if (occasion.pause) {
            attention.may_nod(occasion.time, 0.7, 0.55, 0.95);
            attention.may_raise_brows(occasion.time);
        } else {
            attention.may_nod(occasion.time, 0.12, 0.35, 0.6);
        }
    }
}

}  // namespace

std::vector<Signal> attend(std::vector<Signal> signals, std::size_t person,
                           const std::vector<FloorTime>& floors, const HeardPartner& partner,
                           const Speaker& speaker, std::uint64_t seed) {
    Attention attention(std::move(signals), speaker.manner, Random(seed, 500));
    for (std::size_t i = 0; i < floors.size(); ++i) {
        if (floors[i].person != person) {
            listen(attention, floors[i], partner);
            continue;
        }
        attention.take_turn(floors[i].start);
        if (i + 1 < floors.size()) attention.yield_turn(floors[i].silent);
    }
    return attention.take();
}

}  // namespace chironomia
