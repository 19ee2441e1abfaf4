// chironomia convert
#include <cstdio>

#include "core/error.h"
#include "core/text.h"
#include "skinning/fit/avatar_motion.h"
#include "skinning/fit/fit.h"
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
    Fit fit;
};

Performance perform(const Motion& motion, const ConvertCommand& command) {
    const fs::path file = find_avatar(command.avatar.value_or(kDefaultAvatar));
    Avatar avatar = read_avatar(file);
    Fit fit = fit_motion(motion, avatar, {.fps = command.fps.value_or(motion.fps)});
    return {.avatar_file = file, .avatar = std::move(avatar), .fit = std::move(fit)};
}

// Keypoints become joint turns on the way to a skeleton; joint turns stay as they are unless an avatar is
// named.
bool needs_avatar(const Motion& motion, const ConvertCommand& command) {
    const fs::path ending = command.out.extension();
    return command.avatar || ending == ".glb" || (ending == ".bvh" && !motion.joints);
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
    const Motion motion = read_motion(command.motion, command.hints);
    if (needs_avatar(motion, command)) {
        const Performance performed = perform(motion, command);
        if (command.out.extension() == ".glb") {
            write_animated_glb(command.out, performed.avatar_file, performed.avatar, performed.fit.poses,
                               performed.fit.fps);
        } else {
            write_motion(motion_of_avatar(performed.avatar, performed.fit.poses, performed.fit.fps),
                         command.out);
        }
        if (command.report) write_json(*command.report, to_json(performed.fit.report));
    } else {
        write_motion(command.fps ? resample(motion, *command.fps) : motion, command.out);
    }
    std::fputs((command.out.string() + "\n").c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
