#include "synth/motor/act.h"

#include <algorithm>

#include "core/text.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

constexpr double kLeastWay = 0.05;    // between two key poses [s]
constexpr double kLeastHold = 0.2;    // where the gesture language asks for one [s]
constexpr float kSamePlace = 0.005f;  // [m]

bool is_hold(GesturePhase phase) {
    return phase == GesturePhase::pre_stroke_hold || phase == GesturePhase::post_stroke_hold;
}

// From the end of the stroke so much of the way back as the power asks for.
InstancePose back_pose(const Instance& instance, double power) {
    const double share = 0.6 + 0.3 * power;
    InstancePose back{.phase = GesturePhase::preparation, .speed = Speed::normal, .path = {}, .arms = {}};
    for (std::size_t arm = 0; arm < 2; ++arm) {
        const auto &start = instance.stroke_start().arms[arm], &end = instance.stroke_end().arms[arm];
        if (start && end) back.arms[arm] = mixed(*end, *start, share);
    }
    return back;
}

PlacedStroke stroke_of(const Act& act, const InstancePose& from, double end, bool repeated) {
    const Instance& instance = *act.instance;
    double last = act.ways.step(from.arms, instance.poses[instance.strokes_begin]);
    double whole = last;
    for (std::size_t p = instance.strokes_begin + 1; p < instance.strokes_end; ++p)
        whole += last = act.ways.step(instance.poses[p - 1].arms, instance.poses[p]);
    return {.start = end - whole, .last_way = end - last, .end = end, .accent = end, .repeated = repeated};
}

class Chooser {
  public:
    explicit Chooser(const ScheduleInputs& inputs) : inputs_(inputs) {}

    Acts choose() {
        for (std::size_t w = 0; w < inputs_.wishes.size(); ++w) {
            const Act act = act_of(inputs_.wishes[w], inputs_.instances[w], w);
            if (act.free() > inputs_.duration)
                note(act, format("dropped: the motion ends at {:.2f} s", inputs_.duration));
            else if (make_room(act))
                chosen_.acts.push_back(act);
        }
        for (std::size_t a = 0; a < chosen_.acts.size(); ++a) repeat(a);
        return std::move(chosen_);
    }

  private:
    void note(const Act& act, const std::string& what) {
        chosen_.notes.push_back(described(act, inputs_.lexicon) + " " + what);
    }

    Act act_of(const GestureWish& wish, const Instance& instance, std::size_t number) const {
        Act act{.wish = &wish,
                .instance = &instance,
                .number = number,
                .ways = WayTimes(wish, inputs_.variants),
                .strokes = {},
                .back = back_pose(instance, wish.manner[Expressivity::power])};
        act.strokes = {stroke_of(act, instance.stroke_start(), wish.stroke_end, false)};
        return act;
    }

    // The last act so far that moves this arm.
    std::optional<std::size_t> last_on(ArmSide side) const {
        for (std::size_t a = chosen_.acts.size(); a-- > 0;)
            if (chosen_.acts[a].instance->moves(side)) return a;
        return std::nullopt;
    }

    bool fits(const Act& act, ArmSide side) const {
        const auto before = last_on(side);
        const ArmState& from =
            before ? chosen_.acts[*before].stroke_end(side) : inputs_.resting[index_of(side)];
        const double free = before ? chosen_.acts[*before].free() : 0;
        return free + kMostCompressed * act.lead_time(from, side) <= act.stroke_start() + kInstant;
    }

    // Those that leave no room for `act`, the latest first; nothing if there is none after the beginning
    // either.
    std::optional<std::vector<std::size_t>> in_the_way(const Act& act) const {
        std::vector<std::size_t> blocking;
        for (const ArmSide side : kArmSides) {
            if (!act.instance->moves(side) || fits(act, side)) continue;
            const auto before = last_on(side);
            if (!before) return std::nullopt;
            if (blocking.empty() || blocking.front() != *before) blocking.push_back(*before);
        }
        std::sort(blocking.rbegin(), blocking.rend());
        return blocking;
    }

    // Drops lighter acts before this one until it fits; false if a heavier one, or the beginning, is in its
    // way.
    bool make_room(const Act& act) {
        auto& acts = chosen_.acts;
        for (;;) {
            const auto blocking = in_the_way(act);
            if (!blocking) {
                note(act, "dropped: its preparation would begin before 0 s");
                return false;
            }
            if (blocking->empty()) return true;
            for (const std::size_t b : *blocking) {
                if (acts[b].wish->weight < act.wish->weight) continue;
                note(act, "dropped: no time after " + described(acts[b], inputs_.lexicon));
                return false;
            }
            for (const std::size_t b : *blocking) {
                note(acts[b], "dropped: no time before " + described(act, inputs_.lexicon));
                acts.erase(acts.begin() + static_cast<std::ptrdiff_t>(b));
            }
        }
    }

    double horizon(const GestureWish& wish) const {
        const double rep = wish.manner[Expressivity::repetition];
        const double rheme = std::max(0.0, wish.rheme_end - wish.rheme_start);
        if (rep <= -1) return wish.rheme_start;
        if (rep < 0) return wish.rheme_start + rheme / (1 - rep);
        if (rep == 0) return wish.rheme_start + rheme;
        return wish.rheme_start + inputs_.variants.repetition_horizon * (1 + rep) * rheme;
    }

    // When the next gesture of one of the act's arms begins, if it comes straight from this one.
    double next_begin(std::size_t a) const {
        const auto& acts = chosen_.acts;
        double earliest = inputs_.duration;
        for (const ArmSide side : kArmSides) {
            std::size_t next = a + 1;
            while (next < acts.size() && !acts[next].instance->moves(side)) ++next;
            if (!acts[a].instance->moves(side) || next == acts.size()) continue;
            const double lead = acts[next].lead_time(acts[a].stroke_end(side), side);
            earliest = std::min(earliest, acts[next].stroke_start() - lead);
        }
        return earliest;
    }

    void repeat(std::size_t a) {
        Act& act = chosen_.acts[a];
        if (!inputs_.lexicon.gestures[act.wish->gesture].repeats ||
            act.wish->manner[Expressivity::repetition] <= -1)
            return;
        const double last = std::min(horizon(*act.wish), next_begin(a));
        for (const double accent : act.wish->accents) {
            const PlacedStroke stroke = stroke_of(act, act.back, accent, true);
            if (accent <= last + kInstant && act.free() + act.back_time() <= stroke.start + kInstant)
                act.strokes.push_back(stroke);
        }
    }

    const ScheduleInputs& inputs_;
    Acts chosen_;
};

}  // namespace

double WayTimes::between(const ArmState& from, const ArmState& to, const InstancePose& by,
                         WayKind kind) const {
    const bool circles = by.path.shape == WristShape::circle;
    const Way way{.metres = distance(from.wrist, to.wrist),
                  .circle = circles ? 2.0 * agent_arm_length() * by.path.radius : 0,
                  .half_turns = circles ? 2.0 * by.path.turns : 0,
                  .speed = by.speed,
                  .kind = kind};
    return std::max(kLeastWay, reach_time(way, wish_->manner[Expressivity::temporal_extent], *variants_));
}

double WayTimes::step(const ArmPair& from, const InstancePose& to) const {
    const WayKind kind = to.phase == GesturePhase::stroke ? WayKind::stroke : WayKind::connection;
    double longest = is_hold(to.phase) ? kLeastHold : kLeastWay;
    for (std::size_t arm = 0; arm < 2; ++arm) {
        if (!from[arm] || !to.arms[arm]) continue;
        const bool stays = distance(from[arm]->wrist, to.arms[arm]->wrist) < kSamePlace;
        if (is_hold(to.phase) && stays) continue;
        longest = std::max(longest, between(*from[arm], *to.arms[arm], to, kind));
    }
    return longest;
}

double WayTimes::steps(const std::vector<InstancePose>& poses, std::size_t from, std::size_t to) const {
    double time = 0;
    for (std::size_t p = from; p < to; ++p) time += step(poses[p].arms, poses[p + 1]);
    return time;
}

double Act::approach_time(const ArmState& from, ArmSide side) const {
    const InstancePose& first = instance->poses.front();
    return ways.between(from, *first.arms[index_of(side)], first, WayKind::connection);
}

double Act::lead_time(const ArmState& from, ArmSide side) const {
    return approach_time(from, side) + ways.steps(instance->poses, 0, instance->strokes_begin - 1);
}

double Act::tail_time() const {
    return ways.steps(instance->poses, instance->strokes_end - 1, instance->poses.size() - 1);
}

double Act::back_time() const {
    return ways.step(instance->stroke_end().arms, back);
}

Acts choose_acts(const ScheduleInputs& inputs) {
    return Chooser(inputs).choose();
}

std::string described(const Act& act, const Lexicon& lexicon) {
    return format("gesture \"{}\" at {:.2f} s", lexicon.gestures[act.wish->gesture].id, act.wish->stroke_end);
}

}  // namespace chironomia
