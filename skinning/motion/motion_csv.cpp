#include "skinning/motion/motion_csv.h"

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/motion/face/face_csv.h"

namespace chironomia {
namespace {

// A separator in a name would shift every column behind it.
std::string column_name(std::string name) {
    for (char& c : name) {
        if (c == ',' || c == ';' || c == '"' || static_cast<unsigned char>(c) < ' ') c = '_';
    }
    return name;
}

std::string columns_of(const Vec3&) {
    return ",{0}_x,{0}_y,{0}_z,{0}_confidence";
}
std::string columns_of(const Vec2&) {
    return ",{0}_x,{0}_y,{0}_confidence";
}
std::string cells_of(const Vec3& point) {
    return format(",{},{},{}", point.x, point.y, point.z);
}
std::string cells_of(const Vec2& point) {
    return format(",{},{}", point.x, point.y);
}

// Points in space or in a picture.
template <typename Track>
std::string keypoint_rows(const Motion& motion, const Track& track) {
    const typename decltype(track.points)::value_type none(0);
    const std::string missing(static_cast<size_t>(none.length()), ',');
    std::string text = "time";
    for (const std::string& name : track.names)
        text += format(fmt::runtime(columns_of(none)), column_name(name));
    text += '\n';
    for (size_t t = 0; t < motion.frames; ++t) {
        text += format("{:.9g}", static_cast<double>(t) / motion.fps);
        for (size_t k = 0; k < track.names.size(); ++k) {
            const size_t i = t * track.names.size() + k;
            if (track.confidence[i] > 0)
                text += format("{},{}", cells_of(track.points[i]), track.confidence[i]);
            else
                text += missing + ",0";
        }
        text += '\n';
    }
    return text;
}

std::string joint_rows(const Motion& motion, const JointTrack& track) {
    std::string text = "time";
    for (const std::string& name : names_of_joints(track.skeleton))
        text += format(",{0}_x,{0}_y,{0}_z", column_name(name));
    text += '\n';
    for (size_t t = 0; t < motion.frames; ++t) {
        text += format("{:.9g}", static_cast<double>(t) / motion.fps);
        for (const Mat4& joint : world_from_joints(track, t)) {
            const Vec3 place = origin(joint);
            text += format(",{},{},{}", place.x, place.y, place.z);
        }
        text += '\n';
    }
    return text;
}

}  // namespace

void write_motion_csv(const std::filesystem::path& file, const Motion& motion) {
    const bool body = motion.keypoints || motion.joints || motion.picture;
    if (motion.face && body) {
        throw Error(
            format("{}: a table holds a body or a face, and {} has both; write .h5, which keeps both, or "
                   "give it by --face instead of --motion for its face alone",
                   file.string(), motion.source));
    }
    if (motion.face) return write_text(file, face_table(motion));
    if (motion.keypoints) return write_text(file, keypoint_rows(motion, *motion.keypoints));
    if (motion.joints) return write_text(file, joint_rows(motion, *motion.joints));
    if (motion.picture) return write_text(file, keypoint_rows(motion, *motion.picture));
    write_text(file, "time\n");
}

}  // namespace chironomia
