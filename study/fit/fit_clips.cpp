#include "study/fit/fit_clips.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/error.h"
#include "core/progress.h"
#include "core/render/camera.h"
#include "core/text.h"
#include "raster/images/image_file.h"
#include "raster/tiles/tile_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/face/face_fit.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/motion/points/bodies_json.h"
#include "skinning/signal/resample.h"
#include "skinning/sketch/sketch_motion.h"
#include "skinning/sketch/stick_points.h"
#include "skinning/skin.h"
#include "study/clip/clip.h"
#include "study/clip/parts_outside.h"
#include "study/fit/overlay.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr RenderSize kStripSize{480, 270};
constexpr std::size_t kStripPictures = 6;

struct MotionFile {
    fs::path file;
    std::string name;
};

// In the order of their names. A folder of OpenPose or Panoptic is a motion, another one holds motions.
void add_motions(std::vector<MotionFile>& motions, const fs::path& path, const std::string& name,
                 bool named) {
    if (!fs::is_directory(path) || is_openpose_folder(path) || is_panoptic_folder(path)) {
        if (named || fs::is_directory(path) || may_be_motion(path)) motions.push_back({path, name});
        return;
    }
    std::set<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(path)) entries.insert(entry.path());
    for (const fs::path& entry : entries) {
        const std::string below = entry.filename().string();
        add_motions(motions, entry, named ? below : name + "/" + below, false);
    }
}

std::vector<MotionFile> motions_of(const FitJob& job) {
    std::vector<MotionFile> motions;
    for (const fs::path& path : job.motions) {
        const std::size_t before = motions.size();
        fs::path plain = path.lexically_normal();
        if (!plain.has_filename()) plain = plain.parent_path();
        add_motions(motions, plain, plain.filename().string(), true);
        if (motions.size() == before)
            throw Error(format("{}: holds no motion; give a folder with BVH, keypoints or OpenPose in it",
                               path.string()));
    }
    // Folders of several systems hold files of the same names.
    std::map<std::string, std::size_t> counts;
    for (const MotionFile& motion : motions) ++counts[motion.name];
    for (MotionFile& motion : motions)
        if (counts[motion.name] > 1) motion.name = motion.file.generic_string();
    return motions;
}

// The studio in which all clips are seen.
struct FitStudio {
    Avatar avatar;
    Scene scene;
    std::unique_ptr<Renderer> renderer;  // none without pictures
    double shoulder_pixels = 0;
};

FitStudio make_studio(const FitJob& job) {
    FitStudio studio{.avatar = read_avatar(find_avatar(job.avatar)), .scene = {}, .renderer = nullptr};
    constexpr RenderSize kReference{1280, 720};
    studio.scene = make_scene("upper", studio.avatar, kReference);
    const auto world = world_from_joints(studio.avatar.skeleton, rest_transforms(studio.avatar.skeleton));
    const auto pixel = [&](HumanJoint part) {
        const auto joint = static_cast<std::size_t>(studio.avatar.humanoid[part]);
        return pixel_of(studio.scene.camera, kReference, origin(world[joint]));
    };
    studio.shoulder_pixels =
        static_cast<double>(distance(pixel(HumanJoint::left_upper_arm), pixel(HumanJoint::right_upper_arm)));
    if (job.pictures) studio.renderer = make_tile_renderer(studio.avatar, studio.scene, kStripSize);
    return studio;
}

// Walkers leave a fixed picture; here they are held in its middle.
Pose in_the_middle(Pose pose, const Avatar& avatar) {
    const auto hips = static_cast<std::size_t>(avatar.humanoid[HumanJoint::hips]);
    const auto rest = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    const auto world = world_from_joints(avatar.skeleton, pose.joints);
    const Vec3 place(origin(rest[hips]).x, origin(world[hips]).y, origin(rest[hips]).z);
    const int parent = avatar.skeleton.joints[hips].parent;
    const Mat4 parent_from_world = parent < 0 ? Mat4(1) : inverse(world[static_cast<std::size_t>(parent)]);
    pose.joints[hips].translation = Vec3(parent_from_world * Vec4(place, 1));
    return pose;
}

std::vector<OverlayPicture> make_strip(const Motion& motion, const Fit& fit, const FitStudio& studio) {
    const Motion resampled = resample(motion, fit.fps, fit.poses.size());
    StickSketch sketch = sketch_motion(resampled);
    prefer_outline(sketch);
    const bool flat = !motion.joints && !motion.keypoints;
    const float person = arm_length(motion), own = arm_length(studio.avatar);
    const Overlay overlay{.sketch = sketch, .flat = flat, .size = person > 0 && own > 0 ? own / person : 1};
    std::vector<OverlayPicture> strip;
    const std::size_t count = std::min(kStripPictures, fit.poses.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t index = (2 * i + 1) * fit.poses.size() / (2 * count);
        const Pose pose = in_the_middle(fit.poses[index], studio.avatar);
        Frame frame = studio.renderer->render(skin(studio.avatar, pose));
        draw_overlay(frame, overlay, index,
                     {.avatar = studio.avatar, .pose = pose, .camera = studio.scene.camera});
        strip.push_back({.frame = index, .png = encode_png(frame)});
    }
    return strip;
}

// In frames of the motion as it came.
Finding out_of_view(const char* part, const std::vector<bool>& outside, const FitReport& report) {
    Finding finding{Check::out_of_view, part, {}};
    for (std::size_t t = 0; t < outside.size(); ++t) {
        if (!outside[t]) continue;
        const auto frame =
            std::min(static_cast<std::size_t>(static_cast<double>(t) * report.source_fps / report.fps + 0.5),
                     report.source_frames - 1);
        if (!finding.spans.empty() && finding.spans.back().last + 1 >= frame) {
            finding.spans.back().last = frame;
        } else {
            finding.spans.push_back({frame, frame});
        }
    }
    return finding;
}

// A camera that stays loses people who walk away from it. A part is named where it is outside in more frames than those
// before it.
std::vector<Finding> out_of_view(const Fit& fit, const FitStudio& studio) {
    constexpr RenderSize kReference{1280, 720};
    const Camera camera = make_scene("full", studio.avatar, kReference).camera;
    const PartsOutside parts = find_parts_outside({.avatar = studio.avatar,
                                                   .pose_at = [&](std::size_t t) { return fit.poses[t]; },
                                                   .frames = fit.poses.size(),
                                                   .fps = fit.fps},
                                                  clip_from_world(camera, kReference));
    std::vector<Finding> findings;
    std::ptrdiff_t most = 0;
    for (const auto& [part, outside] :
         {std::pair("head", &parts.head), std::pair("foot", &parts.feet), std::pair("hand", &parts.hands)}) {
        const auto frames = std::count(outside->begin(), outside->end(), true);
        if (frames <= most) continue;
        most = frames;
        findings.push_back(out_of_view(part, *outside, fit.report));
    }
    return findings;
}

FittedClip judged(const Motion& motion, const FitJob& job, const FitStudio& studio, bool pictures) {
    Fit fit = fit_motion(motion, studio.avatar,
                         {.fps = job.fps.value_or(motion.fps),
                          .upper_body = job.upper_body,
                          .lift_cutoff = job.hints.lift_cutoff});
    for (Finding& finding : out_of_view(fit, studio)) fit.report.findings.push_back(std::move(finding));
    FittedClip clip{.report = fit.report, .judgement = judge(fit.report)};
    if (pictures) clip.strip = make_strip(motion, fit, studio);
    return clip;
}

FittedClip refused(const std::string& message) {
    return {.error = message,
            .judgement = {.verdict = Verdict::do_not_show, .reasons = {{Verdict::do_not_show, message}}}};
}

Motion read_with_hints(const fs::path& file, const FitJob& job, bool alone) {
    MotionHints hints = job.hints;
    hints.fps_where_missing = !alone;
    return read_motion(file, hints);
}

// A motion, or why it cannot be read.
struct ReadClip {
    std::optional<Motion> motion;
    std::string error;
};

ReadClip read_clip(const fs::path& file, const FitJob& job, bool alone) {
    try {
        return {.motion = read_with_hints(file, job, alone), .error = {}};
    } catch (const Error& error) {
        return {.motion = {}, .error = error.what()};
    }
}

FittedClip judged_or_refused(const Motion& motion, const FitJob& job, const FitStudio& studio,
                             bool pictures) {
    try {
        return judged(motion, job, studio, pictures);
    } catch (const Error& error) {
        return refused(error.what());
    }
}

// What is beside another motion, or is the same as one, is no clip of its own.
class SeenFiles {
  public:
    bool is_new(const Motion& motion, const fs::path& file) {
        const bool known =
            seen_.contains(fs::weakly_canonical(file)) || seen_.contains(fs::weakly_canonical(motion.source));
        seen_.insert(fs::weakly_canonical(file));
        seen_.insert(fs::weakly_canonical(motion.source));
        for (const fs::path& companion : motion.companions) seen_.insert(fs::weakly_canonical(companion));
        return !known;
    }

  private:
    std::set<fs::path> seen_;
};

}  // namespace

std::size_t FittedClips::count(Verdict verdict) const {
    return static_cast<std::size_t>(std::count_if(clips.begin(), clips.end(), [&](const FittedClip& clip) {
        return clip.judgement.verdict == verdict;
    }));
}

std::size_t FittedClips::broken() const {
    return static_cast<std::size_t>(std::count_if(
        clips.begin(), clips.end(), [](const FittedClip& clip) { return !clip.error.empty(); }));
}

FittedClips fit_clips(const FitJob& job) {
    const std::vector<MotionFile> files = motions_of(job);
    const FitStudio studio = make_studio(job);
    FittedClips fitted;
    fitted.shoulder_pixels = studio.shoulder_pixels;
    SeenFiles seen;
    Progress progress("fit", "motions", files.size(), job.quiet);
    std::size_t piece = 0;
    for (const MotionFile& file : files) {
        progress.step();
        // Every part reads all motions, since one may have been read with another that lies beside it.
        const ReadClip read = read_clip(file.file, job, files.size() == 1);
        if (read.motion && !moves_body(*read.motion)) {
            if (job.shard.number == 1) fitted.left_out.push_back(file.name);
            continue;
        }
        if (read.motion && !seen.is_new(*read.motion, file.file)) continue;
        if (!job.shard.has(piece++)) continue;
        const bool pictures = job.pictures && fitted.clips.size() < kMostStrips;
        FittedClip clip =
            read.motion ? judged_or_refused(*read.motion, job, studio, pictures) : refused(read.error);
        clip.name = file.name;
        fitted.clips.push_back(std::move(clip));
    }
    if (piece == 0)
        throw Error(format("{}: holds faces alone; give the motion of a body", job.motions.front().string()));
    return fitted;
}

Json to_json(const FittedClip& clip, double shoulder_pixels) {
    Json json = {{"name", clip.name}};
    if (!clip.error.empty()) {
        json["verdict"] = to_json(clip.judgement);
        json["error"] = clip.error;
        return json;
    }
    json.update(to_json(clip.report));
    Json pixels = Json::object();
    for (const JointError& error : clip.report.errors) {
        pixels[error.part] = {{"n", error.reprojected.n},
                              {"median", shoulder_pixels * error.reprojected.median},
                              {"p95", shoulder_pixels * error.reprojected.p95},
                              {"max", shoulder_pixels * error.reprojected.max}};
    }
    json["reprojected_pixels_of_1280x720"] = std::move(pixels);
    return json;
}

Json to_json(const FittedClips& fitted) {
    Json clips = Json::array();
    for (const FittedClip& clip : fitted.clips) clips.push_back(to_json(clip, fitted.shoulder_pixels));
    return {{"fit_to_show", fitted.count(Verdict::fit_to_show)},
            {"look_first", fitted.count(Verdict::look_first)},
            {"do_not_show", fitted.count(Verdict::do_not_show)},
            {"not_readable", fitted.broken()},
            {"faces_left_out", fitted.left_out},
            {"shoulder_width_pixels_of_1280x720", fitted.shoulder_pixels},
            {"clips", std::move(clips)}};
}

}  // namespace chironomia::study
