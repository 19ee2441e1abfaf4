#include "skinning/lift/lifted_motion.h"

#include <string>
#include <utility>

#include "core/text.h"
#include "skinning/lift/side_swaps.h"

namespace chironomia {

namespace {

std::string filter_of(const LiftOptions& options) {
    if (!options.cutoff) return "each point filtered as its noise asks for";
    return *options.cutoff > 0 ? format("filtered at {} Hz", *options.cutoff) : "not filtered";
}

}  // namespace

Motion with_lifted_points(const Motion& motion, const LiftOptions& options) {
    Lift lifting = lift(motion, options);
    Motion result = motion;
    result.keypoints = std::move(lifting.motion.keypoints);
    result.notes.emplace_back(format("lifted from the picture into space, {}", filter_of(options)));
    if (lifting.nearest < lifting.farthest) {
        result.notes.push_back(
            format("the person walks, {:.1f} to {:.1f} m before the camera, as estimated from its size",
                   lifting.nearest, lifting.farthest));
    }
    std::vector<std::string> swaps;
    for (const SideSwap& swap : lifting.swaps) swaps.push_back(to_text(swap));
    if (!swaps.empty())
        result.notes.push_back("left and right were exchanged for a moment and are put back: " + join(swaps));
    for (const auto& [landmark, bridged, rested] : lifting.gaps) {
        result.notes.push_back(
            format("{}: bridged in {} frames, at rest in {}", name_of(landmark), bridged, rested));
    }
    return result;
}

}  // namespace chironomia
