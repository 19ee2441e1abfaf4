#include "skinning/motion_file.h"

#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "skinning/bvh.h"
#include "skinning/upright.h"

namespace chironomia {

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
    if (hints.fps && !(*hints.fps > 0 && std::isfinite(*hints.fps))) {
        throw Error(
            format("{}: a rate of {} frames/s was set; it must be above 0", file.string(), *hints.fps));
    }
    const std::string text = read_text(file);
    return stand_upright(parse_bvh(text, file.string(), hints.fps), hints);
}

}  // namespace chironomia
