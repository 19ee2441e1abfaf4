// What of a face an avatar showed, by unit and name.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/body/face.h"
#include "core/files/json.h"

namespace chironomia {

struct ShownChannel {
    FaceChannel channel;
    std::vector<std::string> by{};  // shapes, or "joint jaw"; empty: the avatar cannot show it
};

struct FaceReport {
    std::string avatar;  // file
    size_t frames = 0;
    size_t bridged = 0;                    // frames in which the face was lost and bridged by its reader
    std::vector<ShownChannel> channels{};  // those that are above 0 in some frame
    std::map<int, size_t> full{};          // frames in which a gain took a unit past 5, by unit
    std::string head;      // what turns it: "replaced", "added", "kept", "no joint"; "": not in the track
    std::string gaze;      // "joints", "morphs", "none"; "": not in the track
    size_t gaze_held = 0;  // frames in which an eye was asked to turn further than it can
    size_t morphs = 0;     // the avatar's
};

Json to_json(const FaceReport& report);

// One sentence for each thing that the avatar cannot show, with the avatar's file and the reason.
std::vector<std::string> warnings_of(const FaceReport& report);

}  // namespace chironomia
