#include "skinning/motion/motion_file.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/byte_order_mark.h"
#include "core/files/files.h"
#include "core/files/json_text.h"
#include "core/text.h"
#include "skinning/gltf/fbx_file.h"
#include "skinning/gltf/gltf_motion.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/face/arkit_json.h"
#include "skinning/motion/face/face_csv.h"
#include "skinning/motion/motion_hdf5.h"
#include "skinning/motion/other_formats.h"
#include "skinning/motion/picture/mediapipe_json.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/motion/picture/pats.h"
#include "skinning/motion/picture/people_json.h"
#include "skinning/motion/points/bodies_json.h"
#include "skinning/motion/points/keypoint_arrays.h"
#include "skinning/motion/points/keypoint_csv.h"
#include "skinning/motion/points/keypoint_json.h"
#include "skinning/motion/points/smpl.h"
#include "skinning/motion/points/talkshow.h"
#include "skinning/motion/upright.h"
#include "skinning/quality/motion_checks.h"
#include "skinning/signal/frame_rate.h"
#include "skinning/signal/smooth.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

bool begins_with_word(std::string_view text, std::string_view word) {
    return to_lower(trim(text.substr(0, 200))).starts_with(word);
}

// Text whose first line that is no comment has several columns.
bool looks_like_table(std::string_view text) {
    if (text.find('\0') != std::string_view::npos) return false;
    for (const std::string_view line : split(text, '\n')) {
        if (trim(line).empty() || line.starts_with('#')) continue;
        return line.find_first_of(",;\t") != std::string_view::npos;
    }
    return false;
}

KeypointData read_json_keypoints(const fs::path& file, const Json& json) {
    if (describes_array(json)) return read_described_keypoints(file, json);
    return keypoints_of_json(json, file.string());
}

struct Written {
    Motion motion;  // in the file's own axes and unit
    FileAxes axes{};
    bool takes_names = false;  // from a map
};

// The format is found by the first bytes.
Written read_as_written(const fs::path& file, const std::vector<std::byte>& bytes, const MotionHints& hints) {
    const std::string_view text =
        without_byte_order_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const auto named = [&](KeypointData data) {
        return Written{.motion = name_keypoints(std::move(data), hints.fps, hints.name_map),
                       .takes_names = true};
    };
    const auto gltf = [&] {
        return Written{read_gltf_motion(file, hints.fps, hints.animation), {.up = UpAxis::y}};
    };
    refuse_fbx(file, text);
    refuse_other_formats(file, text);
    if (begins_with_word(text, "hierarchy")) return {parse_bvh(text, file.string(), hints.fps)};
    if (is_npy(bytes)) {
        NumpyArray array = parse_npy(bytes, file.string());
        if (is_talkshow(array)) return {motion_of_talkshow({array}, file.string(), hints.fps)};
        if (are_turns(array)) {
            array.name = "poses";
            return {motion_of_smpl({array}, file.string(), hints.fps), {.is_body_model = true}};
        }
        return named(read_npy_keypoints(file, array));
    }
    if (is_zip(bytes)) {
        const std::vector<NumpyArray> arrays = parse_npz(bytes, file.string());
        if (std::ranges::any_of(arrays, is_talkshow))
            return {motion_of_talkshow(arrays, file.string(), hints.fps)};
        if (holds_smpl(arrays))
            return {motion_of_smpl(arrays, file.string(), hints.fps), {.is_body_model = true}};
        return named(keypoints_of_arrays(arrays, file.string()));
    }
    if (text.starts_with("glTF")) return gltf();
    if (begins_with_word(text, "{") || begins_with_word(text, "[")) {
        const Json json = is_json_lines(text) ? parse_json_lines(text, file) : read_json(file);
        if (json.is_object() && json.contains("asset")) return gltf();
        if (holds_mediapipe(json)) return {motion_of_mediapipe(json, file.string(), hints.fps)};
        if (holds_people(json)) return named(people_of_json(json, file.string()));
        if (holds_arkit(json)) return {face_of_arkit_json(json, file.string(), hints.fps)};
        if (holds_bodies(json)) return named(bodies_of_json(json, file.string()));
        return named(read_json_keypoints(file, json));
    }
    if (trim(text).empty()) throw Error(format("{}: the file is empty; a motion is expected", file.string()));
    if (to_lower(file.extension().string()) == ".bvh") {
        throw Error(format("{}: it does not begin with HIERARCHY, as a BVH in UTF-8 does; export it again",
                           file.string()));
    }
    if (looks_like_table(text)) {
        if (is_face_table(text, file.string())) return {read_face_table(text, file.string(), hints.fps)};
        return named(keypoints_of_csv(text, file.string()));
    }
    throw Error(format(
        "{}: this is no motion that can be read; BVH, keypoints as .npz, .npy, .csv or .json, faces of "
        "OpenFace or ARKit as .csv, of ARKit as .json, animated glTF, or .h5, our own or of PATS, are",
        file.string()));
}

bool has_body(const Motion& motion) {
    return motion.joints || motion.keypoints;
}

// Stands upright already, so nothing is detected; only what is set by hand is done.
Motion read_ours(const Hdf5File& file, const MotionHints& hints) {
    Motion motion = motion_of_hdf5(file);
    if (hints.fps) {
        motion.notes.push_back(
            format("rate: {} frames/s, set by hand (in the file: {})", *hints.fps, motion.fps));
        motion.fps = *hints.fps;
    }
    if (!has_body(motion) || (hints.up == UpAxis::detect && !hints.unit && !hints.turn_deg)) return motion;
    MotionHints rest = hints;
    if (rest.up == UpAxis::detect) rest.up = UpAxis::y;
    if (!rest.unit) rest.unit = 1;
    if (!rest.turn_deg) rest.turn_deg = 0;
    return stand_upright(std::move(motion), rest);
}

struct Recorded {
    Motion motion;
    bool is_picture_upright = true;  // by its format
    bool takes_names = false;
};

void refuse_animation_of_others(const fs::path& file) {
    if (!fs::is_directory(file)) {
        const std::vector<std::byte> bytes = read_bytes(file);
        const std::string_view text =
            without_byte_order_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        if (text.starts_with("glTF")) return;
        if (begins_with_word(text, "{") && !is_json_lines(text)) {
            const Json json = read_json(file);
            if (json.is_object() && json.contains("asset")) return;
        }
    }
    throw Error(
        format("{}: an animation was chosen, which glTF files alone have; leave it out", file.string()));
}

Recorded read_as_recorded(const fs::path& file, const MotionHints& hints) {
    if (!hints.animation.empty()) refuse_animation_of_others(file);
    if (is_openpose_folder(file)) return {read_openpose(file, hints.fps)};
    if (is_panoptic_folder(file)) {
        Motion motion = name_keypoints(read_panoptic(file), hints.fps, hints.name_map);
        return {.motion = stand_upright(std::move(motion), hints), .takes_names = true};
    }
    refuse_other_folders(file);
    const std::vector<std::byte> bytes = read_bytes(file);
    if (is_hdf5(bytes)) {
        const Hdf5File tree(bytes, file.string());
        return {holds_pats(tree) ? read_pats(tree, hints.fps) : read_ours(tree, hints)};
    }
    auto [motion, axes, takes_names] = read_as_written(file, bytes, hints);
    // A face alone has no body that shows axes and unit; its readers know them.
    if (has_body(motion)) motion = stand_upright(std::move(motion), hints, axes);
    return {.motion = std::move(motion), .is_picture_upright = false, .takes_names = takes_names};
}

void refuse_absurd_hint(const fs::path& file, double fps) {
    if (is_rate_of_motion(fps)) return;
    throw Error(
        format("{}: a rate of {} frames/s was set; a motion has {} to {}{}", file.string(), fps,
               kSlowestMotion, kFastestMotion,
               is_rate_of_motion(1 / fps) ? format("; if this is a frame time, set {:.4g}", 1 / fps) : ""));
}

void refuse_absurd_rate(const Motion& motion) {
    if (is_rate_of_motion(motion.fps)) return;
    throw Error(format("{}: it has {:.6g} frames/s; a motion has {} to {}; set the rate with --motion-fps",
                       motion.source, motion.fps, kSlowestMotion, kFastestMotion));
}

// A picture has no third axis, and lifting finds how large the person is and which way they look.
void refuse_hints_of_space(const Motion& motion, const MotionHints& hints) {
    if (!motion.picture || has_body(motion)) return;
    const char* hint = hints.up == UpAxis::z || hints.up == UpAxis::minus_z ? "an up axis of z"
                       : hints.unit                                         ? "a unit"
                       : hints.turn_deg                                     ? "a facing"
                                                                            : nullptr;
    if (!hint) return;
    throw Error(
        format("{}: {} was set, but this is a picture and not a motion in space; leave it out, or set it for "
               "the .bvh that `convert` makes of the picture",
               motion.source, hint));
}

void refuse_hints_of_no_use(const Recorded& recorded, const MotionHints& hints) {
    if (hints.of_several) return;
    const Motion& motion = recorded.motion;
    if (!hints.name_map.empty() && !recorded.takes_names) {
        throw Error(
            format("{}: names of keypoints were set, but the motion has no keypoints that a map could "
                   "name; leave them out",
                   motion.source));
    }
    if (hints.lift_cutoff && (!motion.picture || has_body(motion))) {
        throw Error(
            format("{}: a filter of lifting was set, but the motion is not lifted out of a picture; "
                   "leave it out",
                   motion.source));
    }
}

Motion read_as_hinted(const fs::path& file, const MotionHints& hints) {
    if (hints.fps) refuse_absurd_hint(file, *hints.fps);
    Recorded recorded = read_as_recorded(file, hints);
    refuse_hints_of_no_use(recorded, hints);
    Motion motion = with_picture_hints(std::move(recorded.motion), hints.picture);
    refuse_absurd_rate(motion);
    refuse_hints_of_space(motion, hints);
    refuse_broken_numbers(motion);
    const bool is_set = hints.up != UpAxis::detect && !has_body(motion);
    if (is_set || !recorded.is_picture_upright)
        motion = stand_picture_upright(std::move(motion), is_set ? hints.up : UpAxis::detect);
    return hints.smoothing ? smoothed(std::move(motion), *hints.smoothing) : motion;
}

}  // namespace

UpAxis up_axis_named(std::string_view name) {
    const std::string lower = to_lower(trim(name));
    if (lower == "auto") return UpAxis::detect;
    if (lower == "x" || lower == "+x") return UpAxis::x;
    if (lower == "y" || lower == "+y") return UpAxis::y;
    if (lower == "z" || lower == "+z") return UpAxis::z;
    if (lower == "-x") return UpAxis::minus_x;
    if (lower == "-y") return UpAxis::minus_y;
    if (lower == "-z") return UpAxis::minus_z;
    throw Error(format("up axis: \"{}\" is not known; use auto, x, y, z, -x, -y or -z", name));
}

double unit_named(std::string_view name) {
    const std::string lower = to_lower(trim(name));
    if (lower == "m") return 1;
    if (lower == "dm") return 0.1;
    if (lower == "cm") return 0.01;
    if (lower == "mm") return 0.001;
    if (lower == "inch") return 0.0254;
    if (lower == "foot") return 0.3048;
    const auto metres = parse_number(lower);
    if (metres && std::isfinite(*metres) && *metres > 0) return *metres;
    throw Error(format(
        "unit: \"{}\" is not known; use m, dm, cm, mm, inch, foot or the metres per unit, above 0", name));
}

double turn_named(std::string_view name) {
    const std::string lower = to_lower(trim(name));
    if (lower == "none") return 0;
    if (lower == "ccw") return 90;
    if (lower == "cw") return -90;
    if (lower == "flip") return 180;
    const auto degrees = parse_number(lower);
    if (degrees && std::isfinite(*degrees)) return *degrees;
    throw Error(format("facing: \"{}\" is not known; use cw, ccw, flip, none or degrees", name));
}

Motion read_motion(const std::filesystem::path& file, const MotionHints& hints) {
    if (hints.fps && hints.fps_where_missing) {
        MotionHints own = hints;
        own.fps.reset();
        try {
            return read_motion(file, own);
        } catch (const Error&) {
            return read_as_hinted(file, hints);
        }
    }
    return read_as_hinted(file, hints);
}

bool may_be_motion(const std::filesystem::path& file) {
    const std::string ending = to_lower(file.extension().string());
    return !file.filename().string().starts_with('.') &&
           std::ranges::find(kMotionEndings, ending) != kMotionEndings.end();
}

}  // namespace chironomia
