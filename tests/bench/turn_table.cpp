// turn_table MOTION ...: how the parts of the avatar turn from frame to frame when a motion is lifted from a picture.
// A BVH is filmed from in front and from 25 degrees to either side, and compared with the same motion in space; what is
// known from a picture alone is lifted as it is, and keypoints in space are taken as they are. The first frame of a BVH, which
// is a T-pose in many recordings, is left out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/quantile.h"
#include "core/random.h"
#include "core/text.h"
#include "skinning/body/posture.h"
#include "skinning/fit/fit.h"
#include "skinning/fit/posture_checks.h"
#include "skinning/gltf/gltf.h"
#include "skinning/motion/motion_file.h"
#include "tests/skinning/lift/lift_trial.h"

using namespace chironomia;
using namespace chironomia::testing;

namespace {

// The turns of a part against the part that carries it, (T); those of the hips against the world.
using PartTurns = std::map<std::string, std::vector<Quat>>;

struct PartRow {
    double largest = 0;  // turn between two frames [degrees]
    std::string where;
    double true_largest = 0;  // the same of the motion in space [degrees]
    size_t jumps = 0;         // turns that stand out, by the limits of skinning/fit/posture_checks.h
    double off = 0;           // sum over `frames` of the turn against the true one [degrees]
    size_t frames = 0;
};

// Both sides are one row, and so are the bones of the fingers.
std::string row_of(const std::string& part) {
    const std::string name = part.substr(part.starts_with("left_") ? 5 : part.starts_with("right_") ? 6 : 0);
    if (name.starts_with("thumb")) return "thumb";
    const bool finger = name.starts_with("index") || name.starts_with("middle") || name.starts_with("ring") ||
                        name.starts_with("little");
    return finger ? "finger" : name;
}

PartTurns turns_of(const Fit& fit, const PostureRig& rig) {
    std::vector<std::pair<std::string, std::pair<int, int>>> parts;
    std::vector<bool> plays(rig.skeleton.joints.size(), false);
    for (int i = 0; i < kHumanJoints; ++i) {
        if (rig.parts.has(static_cast<HumanJoint>(i)))
            plays[static_cast<size_t>(rig.parts[static_cast<HumanJoint>(i)])] = true;
    }
    for (int i = 0; i < kHumanJoints; ++i) {
        const auto part = static_cast<HumanJoint>(i);
        if (!rig.parts.has(part)) continue;
        const int joint = rig.parts[part];
        int base = rig.skeleton.joints[static_cast<size_t>(joint)].parent;
        while (base >= 0 && !plays[static_cast<size_t>(base)])
            base = rig.skeleton.joints[static_cast<size_t>(base)].parent;
        parts.emplace_back(name_of(part), std::pair(joint, base));
    }
    for (const HumanJoint foot : {HumanJoint::left_foot, HumanJoint::right_foot}) {
        if (rig.parts.has(foot))
            parts.emplace_back(std::string(name_of(foot)) + " against the hips",
                               std::pair(rig.parts[foot], rig.parts[HumanJoint::hips]));
    }
    PartTurns turns;
    for (const Pose& pose : fit.poses) {
        const auto world = world_from_joints(rig.skeleton, pose.joints);
        for (const auto& [name, joints] : parts) {
            const Quat own = rotation_of(world[static_cast<size_t>(joints.first)]);
            const Quat base =
                joints.second < 0 ? kNoTurn : rotation_of(world[static_cast<size_t>(joints.second)]);
            turns[name].push_back(conjugate(base) * own);
        }
    }
    return turns;
}

Motion without_first_frame(Motion motion) {
    if (motion.frames < 2) return motion;
    const auto joints = static_cast<std::ptrdiff_t>(motion.joints->skeleton.joints.size());
    JointTrack& track = *motion.joints;
    track.turns.erase(track.turns.begin(), track.turns.begin() + joints);
    track.translations.erase(track.translations.begin(), track.translations.begin() + joints);
    --motion.frames;
    return motion;
}

class Table {
  public:
    Table(const std::filesystem::path& avatar, double noise, std::optional<double> space_noise,
          bool lists_jumps)
        : avatar_(read_avatar(avatar)),
          rig_(posture_rig(avatar_.skeleton, avatar_.humanoid)),
          noise_(noise),
          space_noise_(space_noise),
          lists_jumps_(lists_jumps) {}

    void add(const std::filesystem::path& file) {
        const Motion motion = read_motion(file, {.fps = 30});
        const std::string name = file.stem().string();
        if (!motion.joints) return add(name, motion, nullptr);
        const Motion moving = without_first_frame(motion);
        const PartTurns truth = turns(moving, true_slides_);
        if (space_noise_) return add(name, noisy(film(moving, {}).space), &truth);
        for (const double yaw : {0.0, 25.0, -25.0})
            add(format("{} {:.0f}", name, yaw), film(moving, {.yaw_deg = yaw, .noise = noise_}).picture,
                &truth);
    }

    void print() const {
        std::puts(
            "| part | largest [deg] | in | in space [deg] | jumps | off by [deg] |\n"
            "| --- | --- | --- | --- | --- | --- |");
        for (const auto& [part, row] : rows_) {
            std::printf("| %s | %.0f | %s | %.0f | %zu | %.1f |\n", part.c_str(), row.largest,
                        row.where.c_str(), row.true_largest, row.jumps,
                        row.off / static_cast<double>(std::max<size_t>(1, row.frames)));
        }
        std::printf("\nFeet that stand slide at %.0f mm/s by the median (in space %.0f)", median_of(slides_),
                    median_of(true_slides_));
        for (const auto& [joint, errors] : errors_)
            std::printf("; %s are %.3f shoulder widths from where the picture has them", joint.c_str(),
                        median_of(errors));
        std::puts("");
    }

  private:
    PartTurns turns(const Motion& motion, std::vector<double>& slides) const {
        const Fit fit = fit_motion(motion, avatar_, {.fps = motion.fps});
        slides.push_back(fit.report.foot_slide.mm_per_second);
        return turns_of(fit, rig_);
    }

    Motion noisy(Motion space) const {
        Random random(1);
        for (Vec3& point : space.keypoints->points)
            for (int axis = 0; axis < 3; ++axis)
                point[axis] += static_cast<float>(*space_noise_ / 1000 * random.normal());
        return space;
    }

    static double median_of(const std::vector<double>& values) {
        return values.empty() ? 0 : quantile(values, 0.5);
    }

    void add(const std::string& view, const Motion& picture, const PartTurns* truth) {
        const Fit fit = fit_motion(picture, avatar_, {.fps = picture.fps});
        slides_.push_back(fit.report.foot_slide.mm_per_second);
        for (const JointError& error : fit.report.errors)
            if (error.part.ends_with("knee") || error.part.ends_with("ankle"))
                errors_[error.part.ends_with("knee") ? "knees" : "ankles"].push_back(
                    error.reprojected.median);
        for (const auto& [part, lifted] : turns_of(fit, rig_)) {
            PartRow& row = rows_[row_of(part)];
            for (const FrameSpan& span : check_jumps(lifted, part).spans) {
                row.jumps += span.last - span.first + 1;
                if (lists_jumps_) std::printf("%s: %s, frame %zu\n", view.c_str(), part.c_str(), span.first);
            }
            for (size_t t = 1; t < lifted.size(); ++t) {
                const double turned = angle(lifted[t - 1], lifted[t]);
                if (turned <= row.largest) continue;
                row.largest = turned;
                row.where = format("{}: {}", view, t);
            }
            if (!truth) continue;
            const std::vector<Quat>& wanted = truth->at(part);
            for (size_t t = 0; t < std::min(lifted.size(), wanted.size()); ++t) {
                if (t > 0) row.true_largest = std::max(row.true_largest, angle(wanted[t - 1], wanted[t]));
                row.off += part == "hips" ? 0 : angle(lifted[t], wanted[t]);
                ++row.frames;
            }
        }
    }

    static double angle(const Quat& a, const Quat& b) {
        return static_cast<double>(angle_between(a, b)) / kDegree;
    }

    Avatar avatar_;
    PostureRig rig_;
    double noise_;                       // of the points of the picture [px]
    std::optional<double> space_noise_;  // of the keypoints that take its place [mm]
    bool lists_jumps_;
    std::map<std::string, PartRow> rows_;
    std::vector<double> slides_, true_slides_;           // of each view, of each motion [mm/s]
    std::map<std::string, std::vector<double>> errors_;  // medians of each leg of each view
};

}  // namespace

int main(int count, char** arguments) {
    CLI::App app("How the parts of an avatar turn from frame to frame in lifted motions");
    std::vector<std::filesystem::path> files;
    std::filesystem::path avatar = "assets/avatars/neutral.glb";
    app.add_option("files", files, "BVH files, keypoints, and motions known from a picture")->required();
    app.add_option("--avatar", avatar, "The avatar [neutral]");
    double noise = 0;
    app.add_option("--noise", noise, "Standard deviation of the points that the camera sees [0 px]");
    std::optional<double> space_noise;
    app.add_option("--space-noise", space_noise,
                   "In place of a picture, the keypoints in space with this noise [mm]");
    bool lists_jumps = false;
    app.add_flag("--jumps", lists_jumps, "Print where each jump is");
    CLI11_PARSE(app, count, arguments);
    try {
        Table table(avatar, noise, space_noise, lists_jumps);
        for (const std::filesystem::path& file : files) table.add(file);
        table.print();
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
