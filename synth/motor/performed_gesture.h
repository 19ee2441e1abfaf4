// Which of the planned gestures are performed, and on which accents.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "synth/gestures/gesture.h"
#include "synth/motor/performable_gesture.h"
#include "synth/motor/reach_time.h"
#include "synth/motor/schedule.h"
#include "synth/planner/behaviour.h"
#include "synth/planner/variants.h"

namespace chironomia {

using ArmPair = std::array<std::optional<ArmState>, 2>;  // left, right

// Durations of the movements of one gesture [s].
class MovementDurations {
  public:
    MovementDurations(const PlannedGesture& planned, const Variants& variants)
        : planned_(&planned), variants_(&variants) {}

    double between(const ArmState& from, const ArmState& to, const PerformablePose& by,
                   HandMovementKind kind) const;

    // From one pose of a gesture to the next: as long as the slower arm takes. A hold takes 0.2 s.
    double step(const ArmPair& from, const PerformablePose& to) const;

    // From the n-th of these poses to the m-th.
    double steps(const std::vector<PerformablePose>& poses, std::size_t from, std::size_t to) const;

  private:
    const PlannedGesture* planned_;
    const Variants* variants_;
};

// A planned gesture that is performed.
struct PerformedGesture {
    const PlannedGesture* planned = nullptr;
    const PerformableGesture* performable = nullptr;
    std::size_t number = 0;  // of the planned gesture
    MovementDurations durations;
    std::vector<PlacedStroke> strokes;
    PerformablePose back;  // where repeats of the stroke begin

    double stroke_start() const { return strokes.front().start; }
    double free() const { return strokes.back().end; }  // the last stroke ends [s]
    const ArmState& stroke_end(ArmSide side) const { return *performable->stroke_end().arms[index_of(side)]; }
    const ArmState& held(ArmSide side) const { return *performable->poses.back().arms[index_of(side)]; }

    // From where an arm is to the beginning of the stroke [s].
    double lead_time(const ArmState& from, ArmSide side) const;
    // From there to the first pose alone [s].
    double approach_time(const ArmState& from, ArmSide side) const;
    // Of the post-stroke hold's own key poses [s].
    double tail_time() const;
    // From the end of the stroke to where it is repeated [s].
    double back_time() const;

    // When the hold after the last stroke ends [s]: by its author's times, or else after half of the stroke. A gesture
    // with an end alone is held until it is time to go back to rest.
    //   resting  both arms at rest
    double held_until(const std::array<ArmState, 2>& resting) const;
    // From the hold back to rest, of the slower arm [s].
    double longest_retraction(const std::array<ArmState, 2>& resting) const;
    // Of the way back to rest of an arm whose hold ended at `release`: compressed, to half at least, where its author's
    // end is sooner [s].
    double retraction_time(double release, ArmSide side, const ArmState& resting) const;
    // Where an arm is when its hold ends at `release`: the key poses of the hold may not fit into it.
    const ArmState& state_at(double release, ArmSide side) const;
    bool has_times() const { return planned->relax || planned->end; }
};

struct PerformedGestures {
    std::vector<PerformedGesture> gestures;  // ascending; points into both lists of the inputs
    std::vector<std::string> notes;
};

// schedule.h says how.
PerformedGestures choose_gestures(const ScheduleInputs& inputs);

// Of a preparation, and of a retraction to meet its author's end.
inline constexpr double kMostCompressed = 0.5;
inline constexpr double kInstant = 1e-9;  // [s]

// "gesture "beat" at 1.50 s"
std::string described(const PerformedGesture& performed, const Lexicon& lexicon);

}  // namespace chironomia
