// Motion files in: BVH, folders of OpenPose, 3D keypoints (npz, npy, csv, json), faces (csv) and our own .h5,
// brought to metres, +y up, facing +z.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/body/motion.h"
#include "skinning/motion/picture/picture_hints.h"

namespace chironomia {

// The direction in the file that points up.
enum class UpAxis { detect, x, y, z, minus_x, minus_y, minus_z };

// What the user sets by hand; everything else is detected.
struct MotionHints {
    std::optional<double> fps;       // replaces the rate in the file; needed where the file has none  [1/s]
    bool fps_where_missing = false;  // it is of several files: one that has a rate keeps it
    bool of_several = false;         // files, of which one may have no use for names or a filter of lifting
    UpAxis up = UpAxis::detect;
    std::optional<double> unit{};         // metres per unit of the file
    std::optional<double> turn_deg{};     // turned by this about +y instead of until it faces +z,
                                          // counterclockwise seen from above
    std::filesystem::path name_map{};     // JSON {"their name": "our name"}: names of
                                          // skinning/body/keypoint_layout.h for keypoints; empty: none
    std::optional<double> lift_cutoff{};  // of the filter of points that are lifted out of a picture [Hz]; 0:
                                          // none, not set: what their noise asks for (skinning/lift/lift.h)
    PictureHints picture{};               // of the points of a picture
    std::string animation{};  // of a glTF file, by name or by number from 0; empty: the first that moves
    std::optional<double> smoothing{};  // cutoff of the low-pass of a motion that comes in as 3D [Hz]; not
                                        // set: nothing smooths it (skinning/signal/smooth.h)
};

// "auto", "x", "y", "z", "-x", "-y", "-z". Throws Error for anything else.
UpAxis up_axis_named(std::string_view name);
// "m", "dm", "cm", "mm", "inch", "foot" or the number of metres. Throws Error for anything else.
double unit_named(std::string_view name);
// "cw", "ccw" (a quarter turn seen from above), "flip" (half a turn), "none" or degrees. Throws Error
// otherwise.
double turn_named(std::string_view name);

// Recognised by content, not by ending. Up axis, unit and facing are found from the body itself: the head is
// above the hips, the left side is left, and a grown-up is 1.3 to 2.1 m tall; `notes` of the result say what
// was found. The rest pose and the beginning of the motion (1 s) are each turned to face +z; joints below the
// root keep their turns. The table of a face gives a motion with a face alone, for which only the rate can be
// set by hand. Throws Error if the file is missing, broken, ambiguous or no motion, if its rate, or the one that was
// set, is none of a motion (skinning/signal/frame_rate.h), or if an animation is chosen of what is no glTF.
Motion read_motion(const std::filesystem::path& file, const MotionHints& hints = {});

// The endings of files that are taken for motions in folders; animated glTF, which may be avatars as well, is named one
// by one.
inline constexpr std::array<const char*, 7> kMotionEndings = {".bvh",  ".npz", ".npy", ".csv",
                                                              ".json", ".h5",  ".hdf5"};

// Whether a file of a folder has such an ending; not what macOS hides beside its files ("._a.bvh").
bool may_be_motion(const std::filesystem::path& file);

}  // namespace chironomia
