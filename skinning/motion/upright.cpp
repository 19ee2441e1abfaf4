#include "skinning/motion/upright.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "skinning/body/body_frame.h"
#include "skinning/body/joint_landmarks.h"
#include "skinning/body/moving_skeleton.h"
#include "skinning/body/up_doubt.h"
#include "skinning/motion/up_axis.h"

namespace chironomia {
namespace {

constexpr float kAtOrigin = 0.03f;   // ours: so near to it hips begin, against the height of the body
constexpr double kMostFrames = 0.8;  // ours: of the frames of a picture that show which way a body lies

// The frames to look at: some of the first second, then some of the whole.
struct Samples {
    std::vector<size_t> frames;
    size_t beginning = 0;
};

Samples sample_frames(const Motion& motion) {
    Samples samples;
    const auto second = static_cast<size_t>(std::ceil(std::min(motion.fps, 1e6)));
    const size_t beginning = std::clamp<size_t>(second, 1, motion.frames);
    samples.beginning = std::min<size_t>(beginning, 30);
    for (size_t i = 0; i < samples.beginning; ++i)
        samples.frames.push_back(i * beginning / samples.beginning);
    const size_t whole = std::min<size_t>(motion.frames, 64);
    for (size_t i = 0; i < whole; ++i) samples.frames.push_back(i * motion.frames / whole);
    return samples;
}

std::vector<LandmarkFrame> landmarks_of_picture(const Motion& motion) {
    const PictureTrack& picture = *motion.picture;
    KeypointTrack track{.names = picture.names, .points = {}, .confidence = picture.confidence};
    for (const Vec2& point : picture.points) track.points.emplace_back(point, 0);
    return landmarks_of(track, sample_frames(motion).frames);
}

// The share of frames in which hips and head lie along an axis.
double share_of_picture(const std::vector<LandmarkFrame>& frames, UpAxis axis) {
    const auto along = std::count_if(frames.begin(), frames.end(), [&](const LandmarkFrame& frame) {
        return clear_axis(find_body_frame({frame}, 1).up) == axis;
    });
    return static_cast<double>(along) / static_cast<double>(frames.size());
}

// The direction of a picture in which a body lies in most of the frames that show it.
std::optional<UpAxis> usual_up(const std::vector<LandmarkFrame>& frames) {
    constexpr std::array kAxes = {UpAxis::minus_y, UpAxis::y, UpAxis::x, UpAxis::minus_x};
    std::array<double, kAxes.size()> shares;
    for (size_t i = 0; i < kAxes.size(); ++i) shares[i] = share_of_picture(frames, kAxes[i]);
    const auto most = std::ranges::max_element(shares);
    const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
    if (all == 0 || *most < kMostFrames * all) return std::nullopt;
    return kAxes[static_cast<size_t>(most - shares.begin())];
}

// Brings `up` to -y, the top of a picture: y is negated, or the picture is turned by a right angle.
void turn_picture(PictureTrack& picture, UpAxis up) {
    // Without a size the points stay where they are, as a whole.
    Vec2 low(0), high = picture.size;
    if (high.x == 0) {
        low = Vec2(std::numeric_limits<float>::max());
        high = -low;
        for (size_t i = 0; i < picture.points.size(); ++i) {
            if (picture.confidence[i] == 0) continue;
            low = glm::min(low, picture.points[i]);
            high = glm::max(high, picture.points[i]);
        }
    }
    const Vec2 ends = low + high;
    for (Vec2& point : picture.points) {
        if (up == UpAxis::y) point.y = ends.y - point.y;
        if (up == UpAxis::x) point = {point.y, ends.x - point.x};
        if (up == UpAxis::minus_x) point = {ends.y - point.y, point.x};
    }
    if (up != UpAxis::y) std::swap(picture.size.x, picture.size.y);
}

// A turn that stands a body up, and what was found on the way.
struct Standing {
    UpAxis up = UpAxis::y;
    Quat turn = kNoTurn;          // from the file's axes to +y up, +z forward
    std::optional<Vec3> forward;  // in the file's axes
    float yaw = 0;                // the part of `turn` about +y                [rad]
};

// The turn about +y that brings `forward`, once `to_up` has stood it up, to +z.
float yaw_to_front(const Quat& to_up, const Vec3& forward) {
    const Vec3 level = to_up * forward;
    return -std::atan2(level.x, level.z);
}

Quat yaw_turn(float yaw) {
    return glm::angleAxis(yaw, Vec3(0, 1, 0));
}

Standing stand(UpAxis up, const std::vector<LandmarkFrame>& frames, size_t beginning) {
    Standing standing{.up = up, .turn = turn_between(direction_of(up), Vec3(0, 1, 0)), .forward = {}};
    standing.forward = find_body_frame(frames, beginning, direction_of(up)).forward;
    if (standing.forward) standing.yaw = yaw_to_front(standing.turn, *standing.forward);
    return standing;
}

struct UnitName {
    double metres;
    std::string_view name;
};

// Neighbours differ by more than the tallest grown-up from the smallest, so at most one fits.
constexpr std::array<UnitName, 7> kUnits = {{{1, "m"},
                                             {0.01, "cm"},
                                             {0.001, "mm"},
                                             {0.1, "dm"},
                                             {0.0254, "inch"},
                                             {0.3048, "foot"},
                                             {0.0254 / 0.45, "1/0.45 inch, as in the CMU recordings"}}};
constexpr double kLeastHeight = 1.3, kMostHeight = 2.1, kUsualHeight = 1.7;  // [m]
constexpr double kSmallest = 0.3, kTallest = 4;  // that a unit set by hand may make a person [m]

class Upright {
  public:
    Upright(Motion motion, const MotionHints& hints, const FileAxes& axes)
        : motion_(std::move(motion)), hints_(hints), axes_(axes) {
        if (hints_.unit && !(*hints_.unit > 0 && std::isfinite(*hints_.unit))) {
            throw Error(
                format("{}: a unit of {} m was set; it must be above 0", motion_.source, *hints_.unit));
        }
    }

    Motion run() {
        samples_ = sample_frames(motion_);
        if (motion_.keypoints) stand_keypoints();
        if (motion_.joints) stand_joints();
        if (motion_.face && yaw_ != 0) {
            for (Quat& head : motion_.face->head) head = yaw_turn(yaw_) * head;
        }
        return std::move(motion_);
    }

  private:
    void note(std::string text) { motion_.notes.push_back(std::move(text)); }

    void stand_keypoints() {
        KeypointTrack& track = *motion_.keypoints;
        std::vector<LandmarkFrame> frames = landmarks_of(track, samples_.frames);
        const UpAxis up = choose_up({.frames = frames, .stays_in_place = begins_at_origin(frames)});
        if (mirror_if_left_handed(track, frames, up)) frames = landmarks_of(track, samples_.frames);
        Standing standing = stand(up, frames, samples_.beginning);
        face_front(standing);
        const auto scale = static_cast<float>(choose_unit(find_body_frame(frames, 1).height));
        for (size_t i = 0; i < track.points.size(); ++i) {
            if (track.confidence[i] > 0) track.points[i] = standing.turn * track.points[i] * scale;
        }
    }

    bool mirror_if_left_handed(KeypointTrack& track, const std::vector<LandmarkFrame>& frames, UpAxis up) {
        const float front = find_body_frame(frames, samples_.beginning, direction_of(up)).front;
        if (front == 0) {
            note(
                "handedness: neither nose nor knees nor toes are seen to show it, so right-handed axes are taken; "
                "hands of a left-handed space (Unity, Unreal) lie behind the back: negate x or z in the file");
        }
        if (front >= kMirrored) return false;
        const int axis = direction_of(up).z != 0 ? 1 : 2;
        for (Vec3& point : track.points) point[axis] = -point[axis];
        note(format(
            "axes: left-handed (with left and right as named, nose, toes and knees lie behind: {:.2f}); {} was "
            "negated",
            front, "xyz"[axis]));
        return true;
    }

    void stand_joints() {
        JointTrack& track = *motion_.joints;
        const std::vector<LandmarkFrame> rest = {rest_landmarks(track.skeleton)};
        const std::vector<LandmarkFrame> frames = landmarks_of(track, samples_.frames);
        const BodyFrame rest_body = find_body_frame(rest, 1);
        const UpAxis up = choose_up({.frames = frames,
                                     .rest_up = rest_body.up,
                                     .is_model = axes_.is_body_model,
                                     .stays_in_place = begins_at_rest(track)});
        Standing standing = stand(up, frames, samples_.beginning);
        face_front(standing);
        warn_if_left_handed(frames, up);
        const Quat rest_turn = stand_rest(rest, clear_axis(rest_body.up).value_or(up), standing);
        const double unit = choose_unit(
            rest_body.height ? rest_body.height : find_body_frame(frames, samples_.beginning).height);
        apply(track, rest_turn, standing.turn, static_cast<float>(unit));
    }

    void warn_if_left_handed(const std::vector<LandmarkFrame>& frames, UpAxis up) {
        if (find_humanoid(*motion_.joints).swapped) {
            note(
                "left and right look exchanged: feet and face point to the back of the sides as they are named, so "
                "each side was taken for the other; if the axes are left-handed (Unity, Unreal), it is shown mirrored: "
                "export it with right-handed axes");
            return;
        }
        const float front = find_body_frame(frames, samples_.beginning, direction_of(up)).front;
        if (front >= kMirrored) return;
        note(format(
            "left and right look exchanged: toes and knees lie behind ({:.2f}); nothing was changed; if the "
            "axes are left-handed (Unity, Unreal), it is shown wrong: export it with right-handed axes",
            front));
    }

    // The rest pose may stand and face another way than the motion. Its facing is a right angle when it is
    // near one: what is left are uneven limbs, not a turn.
    Quat stand_rest(const std::vector<LandmarkFrame>& rest, UpAxis up, const Standing& standing) {
        const Standing found = stand(up, rest, 1);
        if (up != standing.up) note(format("rest pose: its up axis is {}", name_of_axis(up)));
        if (!found.forward) return standing.turn;
        const float quarter = kPi / 2;
        const float right_angle = std::round(found.yaw / quarter) * quarter;
        const float yaw = std::abs(found.yaw - right_angle) < radians(5.0f) ? right_angle : found.yaw;
        note(format("rest pose: turned to face +z by {:.0f} degrees", glm::degrees(yaw) + 0.0f));
        return yaw_turn(yaw) * found.turn;
    }

    UpAxis choose_up(UpEvidence evidence) {
        if (hints_.up != UpAxis::detect) {
            note(format("up axis: {}, set by hand", name_of_axis(hints_.up)));
            return hints_.up;
        }
        evidence.beginning = samples_.beginning;
        evidence.format_up = axes_.up;
        const ChosenUp chosen = choose_up_axis(evidence);
        note(chosen.note);
        if (!chosen.doubt.empty()) note(note_of_doubtful_up(chosen.doubt));
        return chosen.axis;
    }

    // Points that were moved so that the hips begin at the origin have no floor at 0.
    bool begins_at_origin(const std::vector<LandmarkFrame>& frames) const {
        const auto hip = [&](Landmark side) { return frames[0][static_cast<size_t>(side)]; };
        const auto left = hip(Landmark::left_hip), right = hip(Landmark::right_hip);
        const auto height = find_body_frame(frames, 1).height;
        return left && right && height && length(*left + *right) / 2 <= kAtOrigin * *height;
    }

    static bool begins_at_rest(const JointTrack& track) {
        const Vec3 place = track.translations[0], rest = track.skeleton.joints[0].rest.translation;
        return place == rest || place == Vec3(0);
    }

    // Adds the turn about +y to `standing.turn`.
    void face_front(Standing& standing) {
        if (hints_.turn_deg) {
            standing.yaw = radians(static_cast<float>(*hints_.turn_deg));
            note(format("facing: turned by {} degrees, set by hand", *hints_.turn_deg));
        } else if (!standing.forward) {
            note(
                "facing: left as it is, left and right hips or shoulders do not show it; set it with --facing");
        } else {
            // Below a twentieth of a degree it is rounding, and a second reading must change nothing.
            if (std::abs(standing.yaw) < radians(0.05f)) standing.yaw = 0;
            note(format("facing: {} at the beginning, turned to +z by {:.1f} degrees",
                        name_of_axis(nearest_axis(*standing.forward)), glm::degrees(standing.yaw) + 0.0f));
        }
        standing.turn = yaw_turn(standing.yaw) * standing.turn;
        yaw_ = standing.yaw;
    }

    // The unit that makes a grown-up of a body, if a common one does.
    static const UnitName* fitting_unit(double height) {
        const auto fits = [&](const UnitName& unit) {
            return height * unit.metres >= kLeastHeight && height * unit.metres <= kMostHeight;
        };
        const auto unit = std::find_if(kUnits.begin(), kUnits.end(), fits);
        return unit == kUnits.end() ? nullptr : unit;
    }

    void refuse_giants_and_dwarfs(double height, double metres) const {
        const double tall = height * metres;
        if (tall >= kSmallest && tall <= kTallest) return;
        const UnitName* unit = fitting_unit(height);
        throw Error(
            format("{}: a unit of {:.6g} m was set, which makes the body {:.4g} m tall; people are {} to {} "
                   "m tall, {}",
                   motion_.source, metres, tall, kSmallest, kTallest,
                   unit ? format("set {} ({:.2f} m tall), or leave it out",
                                 unit->metres == kUnits.back().metres ? format("{:.6g}", unit->metres)
                                                                      : std::string(unit->name),
                                 height * unit->metres)
                        : "leave it out to have it found"));
    }

    // Metres per unit of the file.
    double choose_unit(const std::optional<float>& height) {
        if (hints_.unit && height) refuse_giants_and_dwarfs(double(*height), *hints_.unit);
        const std::string tall =
            height ? format("body height {:.2f} m", *height * hints_.unit.value_or(1)) : "";
        if (hints_.unit) {
            note(format("unit: 1 = {} m, set by hand{}", *hints_.unit, height ? " (" + tall + ")" : ""));
            return *hints_.unit;
        }
        if (!height) {
            note("unit: metres are taken, arms, legs and trunk do not show it; set it with --unit");
            return 1;
        }
        if (const UnitName* unit = fitting_unit(double(*height))) {
            note(format("unit: {} (body height {:.2f} m)", unit->name, *height * unit->metres));
            return unit->metres;
        }
        const double unit = kUsualHeight / *height;
        note(format(
            "unit: 1 = {:.4g} m, chosen so that the body is {} m tall (it is {:.4g} units); no common unit "
            "makes it {} to {} m",
            unit, kUsualHeight, *height, kLeastHeight, kMostHeight));
        return unit;
    }

    static void apply(JointTrack& track, const Quat& rest_turn, const Quat& turn, float scale) {
        for (Joint& joint : track.skeleton.joints) {
            joint.rest.translation *= scale;
            if (joint.parent >= 0) continue;
            joint.rest.translation = rest_turn * joint.rest.translation;
            joint.rest.rotation = normalize(rest_turn * joint.rest.rotation);
        }
        const size_t count = track.skeleton.joints.size();
        for (size_t i = 0; i < track.turns.size(); ++i) {
            track.translations[i] *= scale;
            if (track.skeleton.joints[i % count].parent >= 0) continue;
            track.translations[i] = turn * track.translations[i];
            track.turns[i] = normalize(turn * track.turns[i]);
        }
    }

    Motion motion_;
    const MotionHints& hints_;
    const FileAxes& axes_;
    Samples samples_;
    float yaw_ = 0;  // by which the body was turned about +y [rad]
};

}  // namespace

Motion stand_upright(Motion motion, const MotionHints& hints, const FileAxes& axes) {
    return Upright(std::move(motion), hints, axes).run();
}

Motion stand_picture_upright(Motion motion, UpAxis up) {
    if (!motion.picture) return motion;
    if (up == UpAxis::detect) {
        const std::optional<UpAxis> found = usual_up(landmarks_of_picture(motion));
        if (!found || *found == UpAxis::minus_y) return motion;
        if (*found != UpAxis::y) {
            motion.notes.push_back(format(
                "picture: the body lies along {0}; if the camera lay on its side, set --up {0}; if the file "
                "has y before x, as MoveNet's arrays, exchange them, as --up would mirror the person",
                name_of_axis(*found)));
            return motion;
        }
        motion.notes.emplace_back(
            "picture: y points up, by hips and head, and was turned over; if the person stands on the head, "
            "set --up -y");
        up = UpAxis::y;
    } else {
        motion.notes.push_back(format("picture: {} points up, set by hand", name_of_axis(up)));
    }
    if (up != UpAxis::minus_y) turn_picture(*motion.picture, up);
    return motion;
}

}  // namespace chironomia
