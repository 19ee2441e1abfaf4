// Which axis of a file points up, by the body that moves in it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skinning/body/body_frame.h"
#include "skinning/motion/motion_file.h"

namespace chironomia {

Vec3 direction_of(UpAxis axis);
std::string_view name_of_axis(UpAxis axis);
UpAxis nearest_axis(const Vec3& direction);

// The axis that `up` lies along within 45 degrees, if it does.
std::optional<UpAxis> clear_axis(const std::optional<Vec3>& up);

struct UpEvidence {
    std::vector<LandmarkFrame>
        frames;                     // of the file's axes: some of the first second, then some of the whole
    size_t beginning = 0;           // how many of them are of the first second
    std::optional<Vec3> rest_up{};  // from hips to head in the rest pose; not set: there is none
    bool is_model = false;          // the rest pose is that of a body model, whatever axes the motion has
    std::optional<UpAxis> format_up{};  // as the format of the file has it; not set: it leaves it open
    bool stays_in_place = false;  // the body begins at the origin or at its rest, so heights say nothing
};

struct ChosenUp {
    UpAxis axis = UpAxis::y;
    std::string note;     // how it was found
    std::string doubt{};  // what a person should look at; empty: nothing
};

// The trunk shows it, unless the body may bow, crawl or lie: the usual axis, that of the rest pose or y, is kept where
// legs stand along it, where the body stands up along it at times, or where no floor at 0 is under the body along the
// axis of the trunk while it may lie along the usual one. Without hips the first of y, z, -y, ... along which the head
// lies above the shoulders, unless the arms hang along another. Where a doubt is left, the axis of the format is taken.
ChosenUp choose_up_axis(const UpEvidence& evidence);

}  // namespace chironomia
