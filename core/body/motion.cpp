#include "core/body/motion.h"

namespace chironomia {

std::vector<Mat4> world_from_joints(const JointTrack& track, std::size_t frame) {
    std::vector<Transform> local = rest_transforms(track.skeleton);
    const std::size_t first = frame * local.size();
    for (std::size_t j = 0; j < local.size(); ++j) {
        local[j].rotation = track.turns[first + j];
        local[j].translation = track.translations[first + j];
    }
    return world_from_joints(track.skeleton, local);
}

}  // namespace chironomia
