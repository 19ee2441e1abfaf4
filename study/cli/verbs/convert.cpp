// chironomia convert
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/error.h"
#include "core/text.h"
#include "skinning/face/face_fit.h"
#include "skinning/fit/avatar_motion.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_write.h"
#include "skinning/lift/lifted_motion.h"
#include "skinning/motion/bvh/bvh.h"
#include "skinning/motion/bvh/bvh_names.h"
#include "skinning/motion/motion_csv.h"
#include "skinning/motion/motion_hdf5.h"
#include "skinning/motion/picture/openpose_write.h"
#include "skinning/motion/picture/picture_camera.h"
#include "skinning/signal/resample.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/option_values.h"
#include "study/cli/options/people_options.h"
#include "study/cli/verbs/verbs.h"
#include "study/clip/avatars.h"

namespace chironomia::study {
namespace {

// A motion, a face, or both.
void need_motion_or_face(const std::filesystem::path& motion,
                         const std::optional<std::filesystem::path>& face) {
    if (motion.empty() && !face) throw CLI::RequiredError("--motion or --face");
}

// Where the camera of a projection stands.
void add_picture_camera(CLI::App& verb, std::optional<PictureCamera>& camera) {
    const auto add_number = [&verb, &camera](const std::string& name, double PictureCamera::*value,
                                             const std::string& help) {
        const auto set = [&camera, value](double given) {
            if (!camera) camera.emplace();
            (*camera).*value = given;
        };
        return verb.add_option_function<double>(name, set, help);
    };
    add_read_option(
        verb, "--camera",
        [&camera](const std::string& text) {
            if (!camera) camera.emplace();
            camera->perspective = meaning_of<bool>(text, {{"pinhole", true}, {"weak", false}});
        },
        "For OpenPose: pinhole, or weak perspective, which shows all at one size [pinhole]")
        ->type_name("pinhole|weak");
    add_read_option(
        verb, "--size",
        [&camera](const std::string& text) {
            if (!camera) camera.emplace();
            const RenderSize size = parse_size(text);
            camera->size = Vec2(size.width, size.height);
        },
        "For OpenPose: pixels of the picture [1280x720]")
        ->type_name("WxH");
    add_number("--focal", &PictureCamera::focal, "For OpenPose: focal length [1280]")
        ->type_name("PX")
        ->check(CLI::Range(1.0, 1e6));
    add_number("--distance", &PictureCamera::distance, "For OpenPose: from camera to person [4]")
        ->type_name("M")
        ->check(CLI::Range(0.1, 1000.0));
    add_number("--yaw", &PictureCamera::yaw_deg,
               "For OpenPose: degrees from the front to the person's left [0]")
        ->type_name("DEG")
        ->check(CLI::Range(-180.0, 180.0));
}

namespace fs = std::filesystem;

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
    FaceFit fit = fit_motion_and_face({.body = motions.body, .face = motions.face}, avatar,
                                      {.fps = fps_of(motions, command),
                                       .no_interpenetration = command.no_interpenetration,
                                       .lift_cutoff = command.hints.lift_cutoff},
                                      command.face_options);
    return {.avatar_file = file, .avatar = std::move(avatar), .fit = std::move(fit)};
}

// Body and face as one motion, as long as the body. A face that was given alone leaves the body of its file behind.
Motion joined(PerformerMotions motions, const ConvertCommand& command) {
    const double fps = fps_of(motions, command);
    if (!motions.body) {
        Motion& face = *motions.face;
        face.joints.reset();
        face.keypoints.reset();
        face.picture.reset();
        return command.fps ? resample(face, fps) : std::move(face);
    }
    Motion motion = command.fps ? resample(*motions.body, fps) : std::move(*motions.body);
    if (motions.face) motion.face = resample(*motions.face, fps, motion.frames).face;
    return motion;
}

Json report_of(const Performance& performed) {
    Json report = to_json(performed.fit.fit.report);
    if (performed.fit.face) report["face"] = to_json(*performed.fit.face);
    return report;
}

enum class Form { bvh, glb, h5, csv, openpose };

Form form_of(const fs::path& out) {
    // "folder/" names the folder.
    const fs::path named = out.has_filename() ? out : out.parent_path();
    const std::string ending = to_lower(named.extension().string());
    if (ending.empty()) return Form::openpose;
    if (ending == ".bvh") return Form::bvh;
    if (ending == ".glb") return Form::glb;
    if (ending == ".h5") return Form::h5;
    if (ending == ".csv") return Form::csv;
    throw Error(
        format("{}: \"{}\" is no form of motion; choose .bvh, .glb, .h5, .csv, or a name without ending "
               "for a folder of OpenPose",
               out.string(), ending));
}

bool is_bare_skeleton(const ConvertCommand& command) {
    return command.avatar == fs::path("none");
}

// Keypoints become joint turns on the way to a skeleton; joint turns stay as they are unless an avatar is
// named.
bool needs_avatar(const PerformerMotions& motions, const ConvertCommand& command, Form form) {
    if (is_bare_skeleton(command)) return false;
    return command.avatar || form == Form::glb ||
           (form == Form::bvh && !(motions.body && motions.body->joints));
}

// Options that the result could not show.
void refuse_pointless_options(const PerformerMotions& motions, const ConvertCommand& command, Form form) {
    const std::string out = command.out.string();
    if (command.camera && form != Form::openpose)
        throw Error(format("{}: a camera is of use for a folder of OpenPose alone; leave it out", out));
    if (command.mocapnet_names && form != Form::bvh)
        throw Error(format("{}: --bvh-names is of use for a .bvh alone; leave it out", out));
    if (is_bare_skeleton(command) && form != Form::glb)
        throw Error(format("{}: --avatar none is of use for a .glb alone; leave it out", out));
    if (is_bare_skeleton(command) && motions.face)
        throw Error(format("{}: a bare skeleton shows no face; name an avatar, or leave --face out", out));
    if (command.no_interpenetration && !needs_avatar(motions, command, form)) {
        throw Error(format(
            "{}: --no-interpenetration needs the volume of an avatar; name one with --avatar, or leave it out",
            out));
    }
    const bool has_face = motions.face || (motions.body && motions.body->face);
    if (!has_face) refuse_options_of_faces(command.face_options, command.motion);
    if (command.lift && form == Form::openpose)
        throw Error(format("{}: OpenPose holds points of a picture as they are; leave --lift out", out));
    if (command.lift && !(motions.body && motions.body->picture)) {
        throw Error(format("{}: has no points of a picture that could be lifted; leave --lift out",
                           motions.body ? motions.body->source : motions.face->source));
    }
}

// A motion as a detector of 2D points would see it.
Motion picture_of(const Motion& motion, const ConvertCommand& command) {
    if (motion.joints || motion.keypoints) return project(motion, command.camera.value_or(PictureCamera{}));
    if (!motion.picture) {
        throw Error(
            format("{}: holds a face alone, and OpenPose holds no action units; convert it to .h5 or .csv",
                   motion.source));
    }
    if (command.camera) {
        throw Error(
            format("{}: its points are in a picture already, so no camera can be chosen; leave it out",
                   motion.source));
    }
    return set_into_picture(motion);
}

void write_motion(const Motion& motion, const ConvertCommand& command, Form form) {
    switch (form) {
        case Form::bvh:
            return write_bvh(command.out, command.mocapnet_names ? with_mocapnet_names(motion) : motion);
        case Form::glb:
            return write_skeleton_glb(command.out, motion);
        case Form::h5:
            return write_motion_hdf5(command.out, motion);
        case Form::csv:
            return write_motion_csv(command.out, motion);
        case Form::openpose: {
            const Motion picture = picture_of(motion, command);
            write_openpose(command.out, picture);
            // What projection and setting did, after what reading found.
            for (size_t i = motion.notes.size(); i < picture.notes.size(); ++i)
                std::fputs((picture.notes[i] + "\n").c_str(), stderr);
        }
    }
}

void write_performance(const Performance& performed, const ConvertCommand& command, Form form) {
    const Fit& fit = performed.fit.fit;
    const std::vector<Pose> poses(fit.poses.begin(), fit.poses.end());
    if (form == Form::glb)
        write_animated_glb(command.out, performed.avatar_file,
                           {.avatar = performed.avatar, .poses = poses, .fps = fit.fps});
    else
        write_motion(motion_of_avatar(performed.avatar, poses, fit.fps), command, form);
    std::vector<std::string> warnings = performed.avatar.warnings;
    for (std::string& warning : warnings_of(fit.report)) warnings.push_back(std::move(warning));
    if (performed.fit.face) {
        for (std::string& warning : warnings_of(*performed.fit.face)) warnings.push_back(std::move(warning));
    }
    warn(warnings);
    if (command.report) write_json(*command.report, report_of(performed));
}

}  // namespace

void add_convert(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<ConvertCommand>();
    CLI::App* verb = add_verb(app, "convert", "Convert a motion, or bake it into an avatar",
                              "  $ chironomia convert --motion a.npz --out a.bvh\n"
                              "  $ chironomia convert --motion a.bvh --avatar female --out a.glb\n"
                              "  $ chironomia convert --motion a.bvh --yaw 30 --out a_openpose");
    verb->add_option("motion,--motion", command->motion,
                     "A motion of any form that render reads, or animated glTF")
        ->type_name("M");
    add_motion_hints(*verb, command->hints);
    add_face(*verb, command->face, command->face_options);
    verb->add_option("--fps", command->fps, "Frames per second of the result [the motion's own]")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    verb->add_option("--avatar", command->avatar,
                     "The avatar that a GLB animates, or whose skeleton a BVH moves; none: the motion's own "
                     "skeleton as GLB")
        ->type_name("A");
    verb->add_flag("--lift", command->lift,
                   "Bring the points of a picture into space, for .h5 and .csv; .bvh and .glb do so anyway");
    verb->add_flag(
        "--no-interpenetration", command->no_interpenetration,
        "Move hands and forearms of the avatar out of its body where the motion puts them into it, smoothly");
    add_choice<bool>(*verb, "--bvh-names", command->mocapnet_names, {{"own", false}, {"mocapnet", true}})
        ->description("Joint names in a BVH: as they are, or hip, lShldr, ... as MocapNET has them [own]");
    add_picture_camera(*verb, command->camera);
    verb->add_option("--report", command->report, "Write how well the avatar follows the motion")
        ->type_name("F.json");
    verb->add_option("--out", command->out,
                     "X.bvh, X.glb, X.h5, X.csv, or a folder of OpenPose: a name without "
                     "ending")
        ->type_name("FILE")
        ->required();
    verb->callback([&result, command] {
        need_motion_or_face(command->motion, command->face);
        result = *command;
    });
}

int run(const ConvertCommand& command) {
    const Form form = form_of(command.out);
    PerformerMotions motions = read_motions({.motion = command.motion,
                                             .hints = command.hints,
                                             .face = command.face,
                                             .face_options = command.face_options});
    refuse_pointless_options(motions, command, form);
    if (needs_avatar(motions, command, form)) {
        write_performance(perform(motions, command), command, form);
    } else {
        if (command.lift)
            motions.body = with_lifted_points(*motions.body, {.cutoff = command.hints.lift_cutoff});
        write_motion(joined(std::move(motions), command), command, form);
    }
    print(command.out.string() + "\n");
    return kExitYes;
}

}  // namespace chironomia::study
