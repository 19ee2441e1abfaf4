// What a face does over time: action units, the turn of the head, and the gaze.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.h"

namespace chironomia {

// One side of a face is the person's own left or right.
enum class FaceSide { both, left, right };

// An action unit of the Facial Action Coding System, whole or one side of it. The units that the program
// knows have a name; see name_of_unit. Ekman, Friesen, Hager, "Facial Action Coding System", 2002.
struct FaceChannel {
    int unit = 0;  // its number in FACS: 12 is the lip corner puller
    FaceSide side = FaceSide::both;

    bool operator==(const FaceChannel&) const = default;
};

// Turns of the eyeballs against the head [rad]: x about +y to the person's left, then y up.
struct Gaze {
    Vec2 left{0};
    Vec2 right{0};
};

// T frames of C channels. Frame t, channel c lies at t * C + c. Each of the other fields is empty if nothing
// is known of it.
struct FaceTrack {
    std::vector<FaceChannel> channels;  // (C) no two the same
    std::vector<float> intensities;     // (T, C) in [0, 5]
    std::vector<Quat> head;             // (T) unit; turns a head that faces +z, +y up, in the world
    std::vector<Gaze> gaze;             // (T)
    std::vector<float> confidence;      // (T) in [0, 1]; 0: the frame was bridged from its neighbours
};

// The units that the program can show: 1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 20, 23, 25, 26, 45 of
// OpenFace, and 8, 16, 18, 19, 22, 24, 28, 29, 30, 34 that speech and ARKit need, ascending.
const std::vector<int>& known_action_units();

// "lip corner puller" for 12; "" for a unit that is not known.
std::string_view name_of_unit(int unit);

// "AU12", "AU12_L", "AU12_R": as in files and as the morphs of our own avatars.
std::string to_text(const FaceChannel& channel);
std::optional<FaceChannel> face_channel_named(std::string_view text);

}  // namespace chironomia
