#include "tests/skinning/face/face_figure.h"

#include <algorithm>

#include "skinning/face/face_drive.h"
#include "skinning/skin.h"
#include "tests/skinning/fit/figure.h"

namespace chironomia::testing {

Avatar faced_avatar(const std::vector<std::string>& morphs) {
    Avatar avatar = avatar_of(make_figure({}));
    avatar.source = "person.glb";
    Surface face{.name = "face", .joint = avatar.humanoid[HumanJoint::head]};
    face.positions = {{0, 0, 0}, {0, 0, 1}};
    face.normals = {{0, 0, 1}, {0, 0, 1}};
    for (const std::string& name : morphs) {
        face.morphs.push_back({.name = name, .vertices = {0}, .moves = {{1, 0, 0}}, .normal_moves = {}});
        avatar.morph_names.push_back(name);
        avatar.rest_morph_weights.push_back(0);
    }
    avatar.surfaces.push_back(face);
    return avatar;
}

FaceTrack face_of(std::initializer_list<ChannelValue> values) {
    FaceTrack track;
    for (const ChannelValue& value : values) {
        track.channels.push_back(face_channel_named(value.channel).value());
        track.intensities.push_back(value.intensity);
    }
    return track;
}

float weight_of(const Avatar& avatar, const FaceTrack& track, const std::string& morph) {
    const FacedPoses faced = drive_face(track, avatar, {rest_pose(avatar)});
    const auto found = std::find(avatar.morph_names.begin(), avatar.morph_names.end(), morph);
    return faced.poses[0].morph_weights.at(static_cast<size_t>(found - avatar.morph_names.begin()));
}

PosedMesh posed_with(const Avatar& avatar, const FaceTrack& track) {
    return skin(avatar, drive_face(track, avatar, {rest_pose(avatar)}).poses[0]);
}

}  // namespace chironomia::testing
