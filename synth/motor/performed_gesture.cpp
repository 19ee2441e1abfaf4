#include "synth/motor/performed_gesture.h"

#include <algorithm>

#include "core/text.h"
#include "synth/body/agent_body.h"

namespace chironomia {
namespace {

constexpr double kLeastMovement = 0.05;  // between two key poses [s]
constexpr double kLeastHold = 0.2;       // where the gesture language asks for one [s]
constexpr double kHoldOfStroke = 0.5;    // the post-stroke hold, of the stroke
constexpr float kSamePlace = 0.005f;     // [m]

bool is_hold(GesturePhase phase) {
    return phase == GesturePhase::pre_stroke_hold || phase == GesturePhase::post_stroke_hold;
}

// From the end of the stroke so much of the way back as the power asks for.
PerformablePose back_pose(const PerformableGesture& performable, double power) {
    const double share = 0.6 + 0.3 * power;
    PerformablePose back{.phase = GesturePhase::preparation, .speed = Speed::normal, .path = {}, .arms = {}};
    for (std::size_t arm = 0; arm < 2; ++arm) {
        const auto &start = performable.stroke_start().arms[arm], &end = performable.stroke_end().arms[arm];
        if (start && end) back.arms[arm] = mixed(*end, *start, share);
    }
    return back;
}

PlacedStroke stroke_of(const PerformedGesture& performed, const PerformablePose& from, double end,
                       bool repeated) {
    const PerformableGesture& performable = *performed.performable;
    double last = performed.durations.step(from.arms, performable.poses[performable.strokes_begin]);
    double whole = last;
    for (std::size_t p = performable.strokes_begin + 1; p < performable.strokes_end; ++p)
        whole += last = performed.durations.step(performable.poses[p - 1].arms, performable.poses[p]);
    return {.start = end - whole, .last_way = end - last, .end = end, .accent = end, .repeated = repeated};
}

class Chooser {
  public:
    explicit Chooser(const ScheduleInputs& inputs) : inputs_(inputs) {}

    PerformedGestures choose() {
        for (std::size_t w = 0; w < inputs_.planned_gestures.size(); ++w) {
            PerformedGesture performed =
                performed_of(inputs_.planned_gestures[w], inputs_.performable_gestures[w], w);
            delay_at_beginning(performed);
            if (performed.free() > inputs_.duration)
                note(performed, format("dropped: the motion ends at {:.2f} s", inputs_.duration));
            else if (make_room(performed))
                chosen_.gestures.push_back(performed);
        }
        for (std::size_t a = 0; a < chosen_.gestures.size(); ++a) repeat(a);
        return std::move(chosen_);
    }

  private:
    void note(const PerformedGesture& performed, const std::string& what) {
        chosen_.notes.push_back(described(performed, inputs_.lexicon) + " " + what);
    }

    PerformedGesture performed_of(const PlannedGesture& planned, const PerformableGesture& performable,
                                  std::size_t number) const {
        PerformedGesture performed{.planned = &planned,
                                   .performable = &performable,
                                   .number = number,
                                   .durations = MovementDurations(planned, inputs_.variants),
                                   .strokes = {},
                                   .back = back_pose(performable, planned.manner[Expressivity::power])};
        performed.strokes = {stroke_of(performed, performable.stroke_start(), planned.stroke_end, false)};
        return performed;
    }

    // A gesture that shows something comes a little late at the beginning of a speech, by what its preparation needs
    // uncompressed if that is allowed; a beat has no sense but on its accent.
    void delay_at_beginning(PerformedGesture& performed) {
        if (inputs_.lexicon.gestures[performed.planned->gesture].category == GestureCategory::beat) return;
        double least = 0, wanted = 0;
        for (const ArmSide side : kArmSides) {
            if (!performed.performable->moves(side) || last_on(side)) continue;
            const double lead = performed.lead_time(inputs_.resting[index_of(side)], side);
            least = std::max(least, kMostCompressed * lead - performed.stroke_start());
            wanted = std::max(wanted, lead - performed.stroke_start());
        }
        const double latest = inputs_.variants.latest_at_beginning;
        if (least <= kInstant || least > latest) return;
        const double late = std::min(wanted, latest);
        note(performed, format("comes {:.2f} s late: its preparation would begin before 0 s", late));
        for (PlacedStroke& stroke : performed.strokes) {
            stroke.start += late;
            stroke.last_way += late;
            stroke.end += late;
        }
    }

    // The last gesture so far that moves this arm.
    std::optional<std::size_t> last_on(ArmSide side) const {
        for (std::size_t a = chosen_.gestures.size(); a-- > 0;)
            if (chosen_.gestures[a].performable->moves(side)) return a;
        return std::nullopt;
    }

    bool fits(const PerformedGesture& performed, ArmSide side) const {
        const auto before = last_on(side);
        const ArmState& from =
            before ? chosen_.gestures[*before].stroke_end(side) : inputs_.resting[index_of(side)];
        const double free = before ? chosen_.gestures[*before].free() : 0;
        return free + kMostCompressed * performed.lead_time(from, side) <=
               performed.stroke_start() + kInstant;
    }

    // Those that leave no room for this one, the latest first; nothing if there is none after the beginning
    // either.
    std::optional<std::vector<std::size_t>> in_the_way(const PerformedGesture& performed) const {
        std::vector<std::size_t> blocking;
        for (const ArmSide side : kArmSides) {
            if (!performed.performable->moves(side) || fits(performed, side)) continue;
            const auto before = last_on(side);
            if (!before) return std::nullopt;
            if (blocking.empty() || blocking.front() != *before) blocking.push_back(*before);
        }
        std::sort(blocking.rbegin(), blocking.rend());
        return blocking;
    }

    // Drops lighter gestures before this one until it fits; false if a heavier one, or the beginning, is in its
    // way.
    bool make_room(const PerformedGesture& performed) {
        auto& gestures = chosen_.gestures;
        for (;;) {
            const auto blocking = in_the_way(performed);
            if (!blocking) {
                note(performed, "dropped: its preparation would begin before 0 s");
                return false;
            }
            if (blocking->empty()) return true;
            for (const std::size_t b : *blocking) {
                if (gestures[b].planned->weight < performed.planned->weight) continue;
                note(performed, "dropped: no time after " + described(gestures[b], inputs_.lexicon));
                return false;
            }
            for (const std::size_t b : *blocking) {
                note(gestures[b], "dropped: no time before " + described(performed, inputs_.lexicon));
                gestures.erase(gestures.begin() + static_cast<std::ptrdiff_t>(b));
            }
        }
    }

    double horizon(const PlannedGesture& planned) const {
        const double rep = planned.manner[Expressivity::repetition];
        const double rheme = std::max(0.0, planned.rheme_end - planned.rheme_start);
        if (rep <= -1) return planned.rheme_start;
        if (rep < 0) return planned.rheme_start + rheme / (1 - rep);
        if (rep == 0) return planned.rheme_start + rheme;
        return planned.rheme_start + inputs_.variants.repetition_lookahead * (1 + rep) * rheme;
    }

    // When the next gesture of one of a gesture's arms begins, if it comes straight from this one.
    double next_begin(std::size_t a) const {
        const auto& gestures = chosen_.gestures;
        double earliest = inputs_.duration;
        for (const ArmSide side : kArmSides) {
            std::size_t next = a + 1;
            while (next < gestures.size() && !gestures[next].performable->moves(side)) ++next;
            if (!gestures[a].performable->moves(side) || next == gestures.size()) continue;
            const double lead = gestures[next].lead_time(gestures[a].stroke_end(side), side);
            earliest = std::min(earliest, gestures[next].stroke_start() - lead);
        }
        return earliest;
    }

    void repeat(std::size_t a) {
        PerformedGesture& performed = chosen_.gestures[a];
        if (!inputs_.lexicon.gestures[performed.planned->gesture].repeats ||
            performed.planned->manner[Expressivity::repetition] <= -1 || performed.planned->relax)
            return;
        double last = std::min(horizon(*performed.planned), next_begin(a));
        if (performed.planned->end)
            last = std::min(last, *performed.planned->end - performed.longest_retraction(inputs_.resting));
        for (const double accent : performed.planned->accents) {
            const PlacedStroke stroke = stroke_of(performed, performed.back, accent, true);
            if (accent <= last + kInstant &&
                performed.free() + performed.back_time() <= stroke.start + kInstant)
                performed.strokes.push_back(stroke);
        }
    }

    const ScheduleInputs& inputs_;
    PerformedGestures chosen_;
};

}  // namespace

double MovementDurations::between(const ArmState& from, const ArmState& to, const PerformablePose& by,
                                  HandMovementKind kind) const {
    const bool circles = by.path.shape == WristShape::circle;
    const HandMovement movement{.metres = distance(from.wrist, to.wrist),
                                .circle = circles ? 2.0 * agent_arm_length() * by.path.radius : 0,
                                .half_turns = circles ? 2.0 * by.path.turns : 0,
                                .speed = by.speed,
                                .kind = kind};
    return std::max(kLeastMovement,
                    reach_time(movement, planned_->manner[Expressivity::temporal_extent], *variants_));
}

double MovementDurations::step(const ArmPair& from, const PerformablePose& to) const {
    const HandMovementKind kind =
        to.phase == GesturePhase::stroke ? HandMovementKind::stroke : HandMovementKind::connection;
    double longest = is_hold(to.phase) ? kLeastHold : kLeastMovement;
    for (std::size_t arm = 0; arm < 2; ++arm) {
        if (!from[arm] || !to.arms[arm]) continue;
        const bool stays = distance(from[arm]->wrist, to.arms[arm]->wrist) < kSamePlace;
        if (is_hold(to.phase) && stays) continue;
        longest = std::max(longest, between(*from[arm], *to.arms[arm], to, kind));
    }
    return longest;
}

double MovementDurations::steps(const std::vector<PerformablePose>& poses, std::size_t from,
                                std::size_t to) const {
    double time = 0;
    for (std::size_t p = from; p < to; ++p) time += step(poses[p].arms, poses[p + 1]);
    return time;
}

double PerformedGesture::approach_time(const ArmState& from, ArmSide side) const {
    const PerformablePose& first = performable->poses.front();
    return durations.between(from, *first.arms[index_of(side)], first, HandMovementKind::connection);
}

double PerformedGesture::lead_time(const ArmState& from, ArmSide side) const {
    return approach_time(from, side) + durations.steps(performable->poses, 0, performable->strokes_begin - 1);
}

double PerformedGesture::tail_time() const {
    return durations.steps(performable->poses, performable->strokes_end - 1, performable->poses.size() - 1);
}

double PerformedGesture::back_time() const {
    return durations.step(performable->stroke_end().arms, back);
}

double PerformedGesture::held_until(const std::array<ArmState, 2>& resting) const {
    const PlacedStroke& last = strokes.back();
    if (planned->relax) return std::max(last.end, *planned->relax);
    if (!planned->end) return last.end + std::max(kHoldOfStroke * (last.end - last.start), tail_time());
    return std::max(last.end, *planned->end - longest_retraction(resting));
}

double PerformedGesture::longest_retraction(const std::array<ArmState, 2>& resting) const {
    double longest = 0;
    for (const ArmSide side : kArmSides) {
        if (!performable->moves(side)) continue;
        longest = std::max(longest, durations.between(held(side), resting[index_of(side)], {},
                                                      HandMovementKind::connection));
    }
    return longest;
}

double PerformedGesture::retraction_time(double release, ArmSide side, const ArmState& resting) const {
    const double usual =
        durations.between(state_at(release, side), resting, {}, HandMovementKind::connection);
    return planned->end ? std::clamp(*planned->end - release, kMostCompressed * usual, usual) : usual;
}

const ArmState& PerformedGesture::state_at(double release, ArmSide side) const {
    return free() + tail_time() <= release + kInstant ? held(side) : stroke_end(side);
}

PerformedGestures choose_gestures(const ScheduleInputs& inputs) {
    return Chooser(inputs).choose();
}

std::string described(const PerformedGesture& performed, const Lexicon& lexicon) {
    return format("gesture \"{}\" at {:.2f} s", lexicon.gestures[performed.planned->gesture].id,
                  performed.planned->stroke_end);
}

}  // namespace chironomia
