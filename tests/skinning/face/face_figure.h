// A plain humanoid with a face of a few vertices, and face tracks made by hand.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "core/body/avatar.h"
#include "core/body/face.h"

namespace chironomia::testing {

// make_figure's person without eye joints and jaw. Its face is one surface of two vertices that hangs on the
// head, and each named morph moves vertex 0 by 1 m along +x.
Avatar faced_avatar(const std::vector<std::string>& morphs);

struct ChannelValue {
    const char* channel;  // "AU12", "AU45_L"
    float intensity = 5;
};

// One frame.
FaceTrack face_of(std::initializer_list<ChannelValue> values);

// The weight of the first morph of that name in the only pose that `track` gives.
float weight_of(const Avatar& avatar, const FaceTrack& track, const std::string& morph);

// Where the vertices of an avatar are with the face of one frame, in the order of its surfaces.
PosedMesh posed_with(const Avatar& avatar, const FaceTrack& track);

}  // namespace chironomia::testing
