// chironomia convert
#include <cstdio>

#include "core/error.h"
#include "core/text.h"
#include "skinning/face/face_fit.h"
#include "skinning/fit/avatar_motion.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/motion/bvh.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_hdf5.h"
#include "skinning/motion/resample.h"
#include "study/cli/commands.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

const char* const kDefaultAvatar = "mannequin";

// The motion as an avatar performs it.
struct Performance {
    fs::path avatar_file;
    Avatar avatar;
    FaceFit fit;
};

// The rate of the body where there is one.
double fps_of(const PerformerMotions& motions, const ConvertCommand& command) {
    return command.fps.value_or(motions.body ? motions.body->fps : motions.face->fps);
}

Performance perform(const PerformerMotions& motions, const ConvertCommand& command) {
    const fs::path file = find_avatar(command.avatar.value_or(kDefaultAvatar));
    Avatar avatar = read_avatar(file);
    FaceFit fit = fit_motion_and_face(motions.body, motions.face, avatar, {.fps = fps_of(motions, command)},
                                      command.face_options);
    return {.avatar_file = file, .avatar = std::move(avatar), .fit = std::move(fit)};
}

// Body and face as one motion, as long as the body.
Motion joined(PerformerMotions motions, const ConvertCommand& command) {
    const double fps = fps_of(motions, command);
    if (!motions.body) return command.fps ? resample(*motions.face, fps) : std::move(*motions.face);
    Motion motion = command.fps ? resample(*motions.body, fps) : std::move(*motions.body);
    if (motions.face) motion.face = resample(*motions.face, fps, motion.frames).face;
    return motion;
}

Json report_of(const Performance& performed) {
    Json report = to_json(performed.fit.fit.report);
    if (performed.fit.face) report["face"] = to_json(*performed.fit.face);
    return report;
}

// Keypoints become joint turns on the way to a skeleton; joint turns stay as they are unless an avatar is
// named.
bool needs_avatar(const PerformerMotions& motions, const ConvertCommand& command) {
    const fs::path ending = command.out.extension();
    return command.avatar || ending == ".glb" ||
           (ending == ".bvh" && !(motions.body && motions.body->joints));
}

void write_motion(const Motion& motion, const fs::path& out) {
    const fs::path ending = out.extension();
    if (ending == ".bvh") return write_bvh(out, motion);
    if (ending == ".h5") return write_motion_hdf5(out, motion);
    if (ending == ".csv") return write_motion_csv(out, motion);
    throw Error(format("{}: \"{}\" is no form of motion; choose .bvh, .glb, .h5 or .csv", out.string(),
                       ending.string()));
}

}  // namespace

int run(const ConvertCommand& command) {
    PerformerMotions motions = read_motions({.motion = command.motion,
                                             .hints = command.hints,
                                             .face = command.face,
                                             .face_options = command.face_options});
    if (needs_avatar(motions, command)) {
        const Performance performed = perform(motions, command);
        const Fit& fit = performed.fit.fit;
        if (command.out.extension() == ".glb") {
            write_animated_glb(command.out, performed.avatar_file, performed.avatar, fit.poses, fit.fps);
        } else {
            write_motion(motion_of_avatar(performed.avatar, fit.poses, fit.fps), command.out);
        }
        if (performed.fit.face) {
            for (const std::string& warning : warnings_of(*performed.fit.face))
                std::fputs((warning + "\n").c_str(), stderr);
        }
        if (command.report) write_json(*command.report, report_of(performed));
    } else {
        write_motion(joined(std::move(motions), command), command.out);
    }
    std::fputs((command.out.string() + "\n").c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
