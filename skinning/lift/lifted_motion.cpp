#include "skinning/lift/lifted_motion.h"

#include <utility>

#include "core/text.h"
#include "skinning/lift/lift.h"

namespace chironomia {

Motion with_lifted_points(const Motion& motion) {
    Lift lifting = lift(motion);
    Motion result = motion;
    result.keypoints = std::move(lifting.motion.keypoints);
    result.notes.emplace_back("lifted from the picture into space");
    for (const auto& [landmark, bridged, rested] : lifting.gaps) {
        result.notes.push_back(
            format("{}: bridged in {} frames, at rest in {}", name_of(landmark), bridged, rested));
    }
    return result;
}

}  // namespace chironomia
