#include "synth/motor/schedule.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "core/text.h"
#include "synth/motor/performed_gesture.h"

namespace chironomia {
namespace {

constexpr double kThresholdPerFluidity = 0.8;
constexpr double kLongestWait = 0.4;  // of a hand that is early, before the stroke [s]
constexpr double kNoticed = 0.01;     // shorter waits, and differences from an author's times, are none [s]

// The key poses of the chosen gestures, which ascend, in time for one arm. They and their notes go into the schedule.
class ArmTrack {
  public:
    ArmTrack(const std::vector<PerformedGesture>& gestures, const ScheduleInputs& inputs, ArmSide side,
             Schedule& schedule)
        : gestures_(gestures), inputs_(inputs), side_(side), schedule_(schedule) {}

    void lay_out() {
        std::optional<std::size_t> before;
        for (std::size_t a = 0; a < gestures_.size(); ++a) {
            if (!gestures_[a].performable->moves(side_)) continue;
            const double begin = before ? connect(*before, a) : begin_from_rest(a, 0);
            add_lead(a, begin);
            add_strokes(a);
            before = a;
        }
        if (before) retract(*before);
    }

  private:
    const ArmState& resting() const { return inputs_.resting[index_of(side_)]; }

    // When the post-stroke hold ends, if nothing else is to be done.
    double held_until(const PerformedGesture& performed) const {
        return performed.held_until(inputs_.resting);
    }

    double rest_reached(const PerformedGesture& performed) const {
        const double release = held_until(performed);
        return release + performed.retraction_time(release, side_, resting());
    }

    double begin_from_rest(std::size_t a, double earliest) {
        const double latest = gestures_[a].stroke_start() - gestures_[a].lead_time(resting(), side_);
        const double begin = std::max(earliest, latest);
        add({.time = begin,
             .state = resting(),
             .phase = GesturePhase::rest,
             .path = {},
             .placed = gestures_.size()});
        return begin;
    }

    // What the arm does between two gestures; when the preparation of the second begins.
    double connect(std::size_t before, std::size_t a) {
        const PerformedGesture &old = gestures_[before], &performed = gestures_[a];
        const double held = held_until(old);
        const double latest = performed.stroke_start() - performed.lead_time(old.held(side_), side_);
        const double fluidity = old.planned->manner[Expressivity::fluidity];
        const double threshold =
            inputs_.variants.retraction_threshold * (1 + kThresholdPerFluidity * fluidity);
        if (latest - held >= threshold || old.has_times()) {
            const double rested = rest_reached(old);
            if (rested + kMostCompressed * performed.lead_time(resting(), side_) <=
                performed.stroke_start()) {
                retract(before);
                return begin_from_rest(a, rested);
            }
            schedule_.notes.push_back(format("{} does not retract: {} comes too soon",
                                             described(old, inputs_.lexicon),
                                             described(performed, inputs_.lexicon)));
        }
        // An arm that has time left stays where it was until the next rheme begins, and then waits where it
        // goes to.
        double begin = std::max(latest, old.free());
        if (latest > held) {
            const double early = std::clamp(performed.planned->rheme_start, latest - kLongestWait, latest);
            begin = std::max(held, early);
        }
        if (old.planned->relax && begin < held - kNoticed)
            schedule_.notes.push_back(format("{} is held until {:.2f} s instead of {:.2f} s: {} begins then",
                                             described(old, inputs_.lexicon), begin, held,
                                             described(performed, inputs_.lexicon)));
        release(before, begin);
        times(before).rest = begin;
        return begin;
    }

    void retract(std::size_t a) {
        release(a, held_until(gestures_[a]));
        times(a).rest = rest_reached(gestures_[a]);
        times(a).retracted = true;
        note_late_rest(a);
        add({.time = times(a).rest,
             .state = resting(),
             .phase = GesturePhase::retraction,
             .path = {},
             .placed = a});
    }

    void note_late_rest(std::size_t a) {
        const std::optional<double>& end = gestures_[a].planned->end;
        const double rest = times(a).rest;
        if (!end || rest <= *end + kNoticed) return;
        schedule_.notes.push_back(format(
            "{}: the {} hand is back at rest at {:.2f} s instead of {:.2f} s: it leaves at {:.2f} s, and the way "
            "takes {:.2f} s",
            described(gestures_[a], inputs_.lexicon), side_ == ArmSide::left ? "left" : "right", rest, *end,
            times(a).release, rest - times(a).release));
    }

    // Holds until `time`, by the key poses that the gesture has for it if there is time for them.
    void release(std::size_t a, double time) {
        const PerformedGesture& performed = gestures_[a];
        times(a).release = time;
        const auto& poses = performed.performable->poses;
        double now = performed.free();
        const bool whole = now + performed.tail_time() <= time + kInstant;
        for (std::size_t p = performed.performable->strokes_end; whole && p < poses.size(); ++p) {
            now += performed.durations.step(poses[p - 1].arms, poses[p]);
            add_pose(a, poses[p], now, true);
        }
        const ArmState& state = whole ? performed.held(side_) : performed.stroke_end(side_);
        add({.time = time, .state = state, .phase = GesturePhase::post_stroke_hold, .path = {}, .placed = a});
    }

    void add_lead(std::size_t a, double begin) {
        const PerformedGesture& performed = gestures_[a];
        const auto& poses = performed.performable->poses;
        const ArmState from = keys().back().state;
        const double pace =
            std::min(1.0, (performed.stroke_start() - begin) / performed.lead_time(from, side_));
        if (pace < 1 - 1e-6) {
            schedule_.notes.push_back(format("{}: preparation of the {} hand compressed to {:.0f} %",
                                             described(performed, inputs_.lexicon),
                                             side_ == ArmSide::left ? "left" : "right", 100 * pace));
        }
        times(a).begin = begin;
        double now = begin;
        for (std::size_t p = 0; p < performed.performable->strokes_begin; ++p) {
            now += pace * (p == 0 ? performed.approach_time(from, side_)
                                  : performed.durations.step(poses[p - 1].arms, poses[p]));
            const bool holds = poses[p].phase == GesturePhase::pre_stroke_hold ||
                               poses[p + 1].phase == GesturePhase::pre_stroke_hold;
            if (poses[p].phase == GesturePhase::preparation) times(a).ready = now;
            add_pose(a, poses[p], now, holds);
        }
        if (performed.stroke_start() - now < kNoticed) return;
        keys().back().stops = true;
        PerformablePose waiting = performed.performable->stroke_start();
        waiting.phase = GesturePhase::pre_stroke_hold;
        waiting.path = {};
        add_pose(a, waiting, performed.stroke_start(), true);
    }

    void add_strokes(std::size_t a) {
        const PerformedGesture& performed = gestures_[a];
        for (const PlacedStroke& stroke : performed.strokes) {
            if (stroke.repeated) {
                PerformablePose waiting = performed.performable->stroke_end();
                waiting.phase = GesturePhase::post_stroke_hold;
                waiting.path = {};
                add_pose(a, waiting, stroke.start - performed.back_time(), true);
                add_pose(a, performed.back, stroke.start, false);
            }
            add_stroke(a, stroke);
        }
    }

    void add_stroke(std::size_t a, const PlacedStroke& stroke) {
        const PerformedGesture& performed = gestures_[a];
        const auto& poses = performed.performable->poses;
        const std::size_t first = performed.performable->strokes_begin,
                          end = performed.performable->strokes_end;
        double now = stroke.start;
        for (std::size_t p = first; p + 1 < end; ++p) {
            const bool begins = p == first;
            now += performed.durations.step(
                begins && stroke.repeated ? performed.back.arms : poses[p - 1].arms, poses[p]);
            add_pose(a, poses[p], now, false);
        }
        add_pose(a, poses[end - 1], stroke.end, true);
    }

    void add_pose(std::size_t a, const PerformablePose& pose, double time, bool stops) {
        add({.time = time,
             .state = *pose.arms[index_of(side_)],
             .phase = pose.phase,
             .path = pose.path,
             .stops = stops,
             .placed = a});
    }

    // A key that would lie on the one before it, the end of an empty hold, is left out.
    void add(ArmKey key) {
        if (!keys().empty() && key.time <= keys().back().time + kInstant) return;
        keys().push_back(std::move(key));
    }

    std::vector<ArmKey>& keys() { return schedule_.keys[index_of(side_)]; }
    ArmTimes& times(std::size_t a) { return schedule_.placed[a].arms[index_of(side_)]; }

    const std::vector<PerformedGesture>& gestures_;
    const ScheduleInputs& inputs_;
    ArmSide side_;
    Schedule& schedule_;
};

// The times of their authors that the strokes, or the end of the motion, leave no room for.
std::vector<std::string> unmet_times(const std::vector<PerformedGesture>& gestures,
                                     const ScheduleInputs& inputs) {
    std::vector<std::string> notes;
    for (const PerformedGesture& performed : gestures) {
        const std::optional<double>&relax = performed.planned->relax, &end = performed.planned->end;
        if (relax && *relax < performed.free() - kNoticed)
            notes.push_back(format("{} relaxes at {:.2f} s instead of {:.2f} s: its stroke ends then",
                                   described(performed, inputs.lexicon), performed.free(), *relax));
        const double last = std::max(relax.value_or(0), end.value_or(0));
        if (last > inputs.duration + kNoticed)
            notes.push_back(format("{}: the motion ends at {:.2f} s, before the {} at {:.2f} s",
                                   described(performed, inputs.lexicon), inputs.duration,
                                   end ? "end" : "relaxation", last));
    }
    return notes;
}

}  // namespace

Schedule schedule(const ScheduleInputs& inputs) {
    assert(inputs.planned_gestures.size() == inputs.performable_gestures.size());
    PerformedGestures chosen = choose_gestures(inputs);
    Schedule schedule{.notes = std::move(chosen.notes)};
    for (const PerformedGesture& performed : chosen.gestures) {
        PlacedGesture& placed =
            schedule.placed.emplace_back(PlacedGesture{.planned = performed.number,
                                                       .gesture = performed.planned->gesture,
                                                       .function = performed.planned->function,
                                                       .strokes = performed.strokes,
                                                       .arms = {}});
        for (const ArmSide side : kArmSides)
            placed.arms[index_of(side)].moves = performed.performable->moves(side);
    }
    for (std::string& note : unmet_times(chosen.gestures, inputs)) schedule.notes.push_back(std::move(note));
    for (const ArmSide side : kArmSides) ArmTrack(chosen.gestures, inputs, side, schedule).lay_out();
    return schedule;
}

}  // namespace chironomia
