#include "skinning/lift/limb_lift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/quantile.h"
#include "skinning/lift/frequent_postures.h"
#include "skinning/lift/limb_cost.h"
#include "skinning/lift/viterbi.h"
#include "skinning/signal/zero_phase.h"

namespace chironomia {
namespace {

// Weights are in units of a negative log likelihood. Ours, tuned by eye and with the lift_table bench;
// docs/lifting.md names the motions and the held-out figures.
struct LiftTuning {
    // Speed and change of speed of a bone's direction, against the trunk.
    static constexpr double kUsualSpeed = 1.9;         // [rad/s]
    static constexpr double kUsualChange = 12;         // of the speed [rad/s^2]
    static constexpr double kChangeWeight = 1.03;      // of the change, where the speed weighs 1
    static constexpr double kDirectionNoise = 0.0064;  // of a bone's direction from frame to frame [rad]

    // The length of a bone as it is seen.
    static constexpr double kLengthError = 0.017;  // standard deviation, as a share of the length
    static constexpr double kPointError = 0.0025;  // standard deviation, of the picture's points [m]
    static constexpr double kLengthWeight = 8;     // of log(1 + error^2 / kLengthOutlier)
    static constexpr double kLengthOutlier = 16;   // squared error from which a point counts as wrong

    static constexpr double kMirrorWeight = 0.38;  // of the squared distance of a bone to its mirror image
    static constexpr double kRarityWeight = 6;     // of the negative log share of the posture

    // Learned directions.
    static constexpr double kTowardsWeight = 2.5;  // of the difference of the sines to the camera
    static constexpr double kSideWeight = 4.5;     // of the negative log likelihood of a way
    static constexpr double kClearlyOut = 0.34;    // sine of 20 degrees, clearly out of the picture's plane

    // Of the squared second difference of an angle, at 30 frames/s [1/rad^2].
    static constexpr double kBendWeight = 600;

    // A limb that is not seen.
    static constexpr double kEase = 0.4;      // time to its rest and back [s]
    static constexpr double kRestOut = 0.13;  // outward component of a hanging arm, for 1 downward

    // measured_shape and standing_shape.
    static constexpr double kLongestQuantile = 0.98;
    static constexpr double kShortestShare = 0.8;  // of the length before; shorter ones are not believed
    static constexpr double kLongestShare = 1.15;  // of the length before
};

struct LimbAngles {
    double upper = 0;  // towards the camera [rad]
    double lower = 0;
};

// The seen points of all frames and the cost of one frame.
class LimbFrames {
  public:
    LimbFrames(const LimbSight& sight, const LimbShape& shape, const EarlierPlaces& earlier)
        : seen_(sight.limb),
          trunks_(sight.trunks),
          shape_(shape),
          camera_(sight.camera),
          seconds_(30 / sight.fps),
          frequent_(sight.fps) {
        fill_rests();
        if (earlier.own.empty()) return;
        find_mirror(earlier.other);
        find_frequent_postures(earlier);
    }

    size_t size() const { return seen_.size(); }

    LimbPlace place(size_t t, const LimbAngles& angles) const {
        const SeenLimb& limb = filled_[t];
        LimbPlace place;
        place.mid = camera_.place(limb.mid, limb.root.z + shape_.upper * std::sin(angles.upper));
        place.tip = camera_.place(limb.tip, place.mid.z + shape_.lower * std::sin(angles.lower));
        return place;
    }

    // The angles at which both bones have their lengths.
    LimbAngles way(size_t t, int way) const {
        const SeenLimb& limb = filled_[t];
        LimbAngles angles;
        angles.upper = towards(limb.root, limb.mid, shape_.upper, (way & kUpperToCamera) != 0);
        const glm::dvec3 mid = camera_.place(limb.mid, limb.root.z + shape_.upper * std::sin(angles.upper));
        angles.lower = towards(mid, limb.tip, shape_.lower, (way & kLowerToCamera) != 0);
        return angles;
    }

    double cost(size_t t, const LimbAngles& angles) const {
        const SeenLimb& limb = filled_[t];
        const LimbPlace at = place(t, angles);
        const glm::dvec3 upper = at.mid - limb.root, lower = at.tip - at.mid;
        double cost =
            length_cost(upper, shape_.upper, angles.upper) + length_cost(lower, shape_.lower, angles.lower);
        const glm::dvec3 upper_way = unit_along(upper, angles.upper),
                         lower_way = unit_along(lower, angles.lower);
        cost += posture_cost(t, at, upper_way, lower_way) + mirror_cost(t, upper_way, lower_way);
        cost += learned_cost(limb, angles);
        return cost * seconds_;
    }

    LimbDirections directions(size_t t, const LimbAngles& angles) const {
        const LimbPlace at = place(t, angles);
        return {in_trunk(t, unit_along(at.mid - filled_[t].root, angles.upper)),
                in_trunk(t, unit_along(at.tip - at.mid, angles.lower))};
    }

    // Costs directions that are rare in the seconds around the frame.
    double rarity_cost(size_t t, const LimbDirections& directions) const {
        return LiftTuning::kRarityWeight * frequent_.cost(t, directions) * seconds_;
    }

  private:
    // The angle out of the picture's plane of a bone from `root` to a point of the picture. Three rounds, because
    // nearer bones look larger.
    double towards(const glm::dvec3& root, const Vec2& point, double length, bool to_camera) const {
        double angle = 0;
        for (int round = 0; round < 3; ++round) {
            const glm::dvec3 bone = camera_.place(point, root.z + length * std::sin(angle)) - root;
            angle = std::acos(std::min(1.0, std::hypot(bone.x, bone.y) / length)) * (to_camera ? 1 : -1);
        }
        return angle;
    }

    static double length_cost(const glm::dvec3& bone, double length, double angle) {
        // A bone that looks longer than it is lies in the picture's plane.
        const double flat = std::min(std::hypot(bone.x, bone.y), length);
        const double off =
            (flat - length * std::cos(angle)) / (LiftTuning::kLengthError * length + LiftTuning::kPointError);
        // A point far off is a wrong point, not an impossible length.
        return LiftTuning::kLengthWeight * std::log1p(square(off) / LiftTuning::kLengthOutlier);
    }

    static glm::dvec3 unit(const glm::dvec3& bone) {
        const double length = glm::length(bone);
        return length < 1e-9 ? glm::dvec3(0, 0, 1) : bone / length;
    }

    static glm::dvec3 unit_along(const glm::dvec3& bone, double angle) {
        const double flat = std::hypot(bone.x, bone.y);
        if (flat < 1e-6) return {0, 0, angle < 0 ? -1 : 1};
        return {bone.x / flat * std::cos(angle), bone.y / flat * std::cos(angle), std::sin(angle)};
    }

    double posture_cost(size_t t, const LimbPlace& at, const glm::dvec3& upper,
                        const glm::dvec3& lower) const {
        const Trunk& trunk = trunks_[t];
        const bool arm = shape_.kind == LimbKind::arm;
        const glm::dvec3 origin = arm ? trunk.thorax : trunk.pelvis;
        const LimbPosture posture = {
            .upper = in_trunk(t, upper), .lower = in_trunk(t, lower), .tip = in_trunk(t, at.tip - origin)};
        return limb_cost(shape_.kind, posture, glm::distance(trunk.left_shoulder, trunk.right_shoulder));
    }

    static double learned_cost(const SeenLimb& limb, const LimbAngles& angles) {
        if (!limb.learned || !limb.has_mid) return 0;
        const LearnedArm& arm = *limb.learned;
        const double upper = std::sin(angles.upper), lower = std::sin(angles.lower);
        double cost = LiftTuning::kTowardsWeight * std::abs(upper - arm.upper);
        if (limb.has_tip) cost += LiftTuning::kTowardsWeight * std::abs(lower - arm.lower);
        const auto likeliest = static_cast<size_t>(
            std::min_element(arm.unlikely.begin(), arm.unlikely.end()) - arm.unlikely.begin());
        // Both sides of a forearm that is not seen cost the same.
        return cost +
               LiftTuning::kSideWeight *
                   unlikely(arm, share_to_camera(upper, (likeliest & kUpperToCamera) != 0),
                            limb.has_tip ? share_to_camera(lower, (likeliest & kLowerToCamera) != 0) : 0.5);
    }

    // 1 for a bone that points to the camera, 0 for one that points away. A bone that lies in the picture's plane
    // counts as pointing to its likelier side, so that no cost draws it out of the plane.
    static double share_to_camera(double towards, bool likely) {
        return std::clamp(towards / LiftTuning::kClearlyOut + (likely ? 1 : 0), 0.0, 1.0);
    }

    static double unlikely(const LearnedArm& arm, double upper_to_camera, double lower_to_camera) {
        const auto of_upper = [&](size_t way) {
            return std::lerp(arm.unlikely[way], arm.unlikely[way + kLowerToCamera], lower_to_camera);
        };
        return std::lerp(of_upper(0), of_upper(kUpperToCamera), upper_to_camera);
    }

    double mirror_cost(size_t t, const glm::dvec3& upper, const glm::dvec3& lower) const {
        if (mirror_.empty()) return 0;
        return LiftTuning::kMirrorWeight * (square(glm::distance(in_trunk(t, upper), mirror_[t].upper)) +
                                            square(glm::distance(in_trunk(t, lower), mirror_[t].lower)));
    }

    glm::dvec3 in_trunk(size_t t, const glm::dvec3& v) const {
        const double yaw = shape_.kind == LimbKind::arm ? trunks_[t].yaw : trunks_[t].hips_yaw;
        const glm::dvec3 turned(v.x * std::cos(yaw) - v.z * std::sin(yaw), v.y,
                                v.x * std::sin(yaw) + v.z * std::cos(yaw));
        return {shape_.left ? turned.x : -turned.x, turned.y, turned.z};
    }

    // Places the points that are not seen where a hanging limb has them.
    SeenLimb resting(size_t t, SeenLimb limb) const {
        const double out =
            shape_.kind == LimbKind::arm ? (shape_.left ? LiftTuning::kRestOut : -LiftTuning::kRestOut) : 0;
        const glm::dvec3 along = glm::normalize(glm::dvec3(out, -1, 0));
        const glm::dvec3 mid =
            limb.has_mid ? camera_.place(limb.mid, limb.root.z) : limb.root + along * shape_.upper;
        if (!limb.has_mid) limb.mid = camera_.point(mid);
        if (!limb.has_tip || !seen_[t].has_mid) limb.tip = camera_.point(mid + along * shape_.lower);
        return limb;
    }

    void find_mirror(std::span<const LimbPlace> other);
    void find_frequent_postures(const EarlierPlaces& earlier);
    void fill_rests();
    void ease(Vec2 SeenLimb::*point, bool SeenLimb::*has);

    std::span<const SeenLimb> seen_;
    std::span<const Trunk> trunks_;
    LimbShape shape_;
    PinholeCamera camera_;
    double seconds_;  // duration of a frame over that of a frame at 30 a second
    std::vector<SeenLimb> filled_;
    std::vector<LimbDirections> mirror_;  // (T) of the other side's limb, as if it were this one; or nothing
    FrequentPostures frequent_;
};

void LimbFrames::find_mirror(std::span<const LimbPlace> other) {
    for (size_t t = 0; t < other.size(); ++t) {
        const glm::dvec3 root = shape_.left ? trunks_[t].right_shoulder : trunks_[t].left_shoulder;
        const auto mirrored = [&](const glm::dvec3& bone) {
            return in_trunk(t, unit(bone)) * glm::dvec3(-1, 1, 1);
        };
        mirror_.push_back({mirrored(other[t].mid - root), mirrored(other[t].tip - other[t].mid)});
    }
}

void LimbFrames::find_frequent_postures(const EarlierPlaces& earlier) {
    for (size_t t = 0; t < seen_.size(); t += frequent_.stride()) {
        const LimbPlace& own = earlier.own[t];
        frequent_.add(t, {in_trunk(t, unit(own.mid - seen_[t].root)), in_trunk(t, unit(own.tip - own.mid))});
        frequent_.add(t, mirror_[t]);
    }
}

void LimbFrames::fill_rests() {
    for (size_t t = 0; t < seen_.size(); ++t) {
        const SeenLimb& limb = seen_[t];
        filled_.push_back(limb.has_mid && limb.has_tip ? limb : resting(t, limb));
    }
    ease(&SeenLimb::mid, &SeenLimb::has_mid);
    ease(&SeenLimb::tip, &SeenLimb::has_tip);
}

// A limb that goes out of sight moves to its rest within kEase, and comes back in the same time.
void LimbFrames::ease(Vec2 SeenLimb::*point, bool SeenLimb::*has) {
    const double frames = LiftTuning::kEase * 30 / seconds_;
    const auto lean_on = [&](size_t t, size_t seen) {
        const double away = t > seen ? static_cast<double>(t - seen) : static_cast<double>(seen - t);
        if (away >= frames) return;
        const Vec2 carried =
            seen_[seen].*point - camera_.point(seen_[seen].root) + camera_.point(seen_[t].root);
        const auto share = static_cast<float>(0.5 + 0.5 * std::cos(away / frames * 3.14159265358979));
        filled_[t].*point = glm::mix(filled_[t].*point, carried, share);
    };
    std::optional<size_t> last;
    for (size_t t = 0; t < seen_.size(); ++t) {
        if (seen_[t].*has) last = t;
        if (last && *last != t) lean_on(t, *last);
    }
    std::optional<size_t> next;
    for (size_t t = seen_.size(); t-- > 0;) {
        if (seen_[t].*has) next = t;
        if (next && *next != t) lean_on(t, *next);
    }
}

// The way of a state of the Viterbi path. State 0, which wins at equal costs, has both bones to the camera.
constexpr int way_of_state(int state) {
    return kLimbWays - 1 - state;
}

// All the ways in which both bones can point, over the whole clip, by state.
struct Ways {
    std::vector<std::array<LimbDirections, kLimbWays>> directions;  // (T)
    std::vector<std::array<double, kLimbWays>> costs;               // (T)
};

Ways all_ways(const LimbFrames& frames) {
    Ways ways;
    ways.directions.resize(frames.size());
    ways.costs.resize(frames.size());
    for (size_t t = 0; t < frames.size(); ++t) {
        for (size_t state = 0; state < kLimbWays; ++state) {
            const LimbAngles angles = frames.way(t, way_of_state(static_cast<int>(state)));
            ways.directions[t][state] = frames.directions(t, angles);
            ways.costs[t][state] = frames.cost(t, angles) + frames.rarity_cost(t, ways.directions[t][state]);
        }
    }
    return ways;
}

double effort(const glm::dvec3& upper, const glm::dvec3& lower, double usual) {
    return std::log1p(glm::dot(upper, upper) / square(usual)) +
           std::log1p(glm::dot(lower, lower) / square(usual));
}

// The cheapest ways over the whole clip. A state is the way of a frame and of the frame before, so that speed and
// its change cost: a bone that swings through the picture's plane goes on to the other side. Both are measured
// against the trunk, because arms that rest turn with it.
std::vector<LimbAngles> choose_ways(const LimbFrames& frames, double fps) {
    const double usual_step = std::hypot(LiftTuning::kUsualSpeed / fps, 2 * LiftTuning::kDirectionNoise),
                 usual_change =
                     std::hypot(LiftTuning::kUsualChange / (fps * fps), LiftTuning::kDirectionNoise);
    const Ways ways = all_ways(frames);
    const auto at = [&](size_t t, int state) { return ways.directions[t][static_cast<size_t>(state)]; };
    const auto step_price = [&](size_t t, int from, int to) {
        const LimbDirections before = at(t - 1, to / kLimbWays), now = at(t, to % kLimbWays);
        const glm::dvec3 upper = now.upper - before.upper, lower = now.lower - before.lower;
        const double price = effort(upper, lower, usual_step);
        if (t < 2) return price;
        const LimbDirections first = at(t - 2, from / kLimbWays);
        return price + LiftTuning::kChangeWeight * effort(upper - (before.upper - first.upper),
                                                          lower - (before.lower - first.lower), usual_change);
    };
    std::vector<std::vector<int>> before;
    for (int pair = 0; pair < kLimbWays * kLimbWays; ++pair) {
        std::vector<int>& pairs = before.emplace_back();
        for (int first = 0; first < kLimbWays; ++first) pairs.push_back(first * kLimbWays + pair / kLimbWays);
    }
    const std::vector<int> path = viterbi_path(
        {.frames = frames.size(),
         .predecessors = std::move(before),
         .state_cost = [&](size_t t,
                           int pair) { return ways.costs[t][static_cast<size_t>(pair % kLimbWays)]; },
         .transition_cost = step_price});
    std::vector<LimbAngles> angles;
    for (size_t t = 0; t < frames.size(); ++t)
        angles.push_back(frames.way(t, way_of_state(path[t] % kLimbWays)));
    return angles;
}

// Moves the angles to a local minimum of their costs plus their bends. It adds triangular hills to them: first hills
// over many frames, then ever narrower ones, so that a long stretch can move as a whole.
class Refinement {
  public:
    Refinement(const LimbFrames& frames, std::vector<LimbAngles> angles, double fps)
        : frames_(frames),
          angles_(std::move(angles)),
          smooth_(LiftTuning::kBendWeight * std::pow(fps / 30, 3)) {}

    std::vector<LimbAngles> run() {
        for (const double step : {6.0, 3.0, 1.5, 0.75}) {
            for (size_t width = 64; width > 0; width /= 4) {
                for (size_t t = 0; t < angles_.size(); t += std::max<size_t>(1, width / 2)) {
                    improve(
                        {.middle = t, .width = width, .part = &LimbAngles::upper, .height = step * kDegree});
                    improve(
                        {.middle = t, .width = width, .part = &LimbAngles::lower, .height = step * kDegree});
                }
            }
        }
        return std::move(angles_);
    }

  private:
    struct Hill {
        size_t middle = 0;
        size_t width = 1;  // to where it is 0, to either side
        double LimbAngles::*part = nullptr;
        double height = 0;  // [rad]
    };

    size_t first(const Hill& hill) const { return hill.middle - std::min(hill.middle, hill.width - 1); }
    size_t last(const Hill& hill) const { return std::min(angles_.size() - 1, hill.middle + hill.width - 1); }

    void add(const Hill& hill, double sign) {
        for (size_t t = first(hill); t <= last(hill); ++t) {
            const double away = std::abs(static_cast<double>(t) - static_cast<double>(hill.middle));
            angles_[t].*hill.part += sign * hill.height * (1 - away / static_cast<double>(hill.width));
        }
    }

    double bend(size_t middle, double LimbAngles::*part) const {
        if (middle == 0 || middle + 1 >= angles_.size()) return 0;
        return square(angles_[middle - 1].*part - 2 * (angles_[middle].*part) + angles_[middle + 1].*part);
    }

    double cost(const Hill& hill) const {
        double sum = 0;
        const size_t begin = first(hill), end = last(hill);
        for (size_t t = begin; t <= end; ++t) sum += frames_.cost(t, angles_[t]);
        for (size_t t = begin - (begin > 0); t <= end + 1; ++t) sum += smooth_ * bend(t, hill.part);
        return sum;
    }

    // Adds or subtracts the hill if that is cheaper.
    void improve(const Hill& hill) {
        const double before = cost(hill);
        add(hill, 1);
        if (cost(hill) < before) return;
        add(hill, -2);
        if (cost(hill) < before) return;
        add(hill, 1);
    }

    const LimbFrames& frames_;
    std::vector<LimbAngles> angles_;
    double smooth_;
};

std::vector<LimbAngles> smoothed(std::vector<LimbAngles> angles, double cutoff, double fps) {
    if (cutoff <= 0) return angles;
    for (const auto part : {&LimbAngles::upper, &LimbAngles::lower}) {
        std::vector<double> values;
        for (const LimbAngles& each : angles) values.push_back(each.*part);
        values = zero_phase_low_pass(values, cutoff, fps);
        for (size_t t = 0; t < angles.size(); ++t) angles[t].*part = values[t];
    }
    return angles;
}

}  // namespace

LimbShape measured_shape(std::span<const SeenLimb> seen, std::span<const LimbPlace> places,
                         const LimbShape& shape) {
    std::vector<double> uppers, lowers;
    for (size_t t = 0; t < seen.size(); ++t) {
        const glm::dvec3 upper = places[t].mid - seen[t].root, lower = places[t].tip - places[t].mid;
        if (seen[t].has_mid) uppers.push_back(std::hypot(upper.x, upper.y));
        if (seen[t].has_mid && seen[t].has_tip) lowers.push_back(std::hypot(lower.x, lower.y));
    }
    const auto length = [](std::vector<double> flats, double before) {
        if (flats.size() < 2) return before;
        const double longest = quantile(std::move(flats), LiftTuning::kLongestQuantile);
        return longest < LiftTuning::kShortestShare * before
                   ? before
                   : std::min(longest, LiftTuning::kLongestShare * before);
    };
    LimbShape measured = shape;
    measured.upper = length(std::move(uppers), shape.upper);
    measured.lower = length(std::move(lowers), shape.lower);
    return measured;
}

LimbShape standing_shape(std::span<const SeenLimb> seen, const LimbShape& shape,
                         const PinholeCamera& camera) {
    std::vector<double> uppers, lowers;
    for (const SeenLimb& leg : seen) {
        if (!leg.has_mid) continue;
        const glm::dvec3 mid = camera.place(leg.mid, leg.root.z);
        uppers.push_back(glm::distance(mid, leg.root));
        if (leg.has_tip) lowers.push_back(glm::distance(camera.place(leg.tip, leg.root.z), mid));
    }
    const auto length = [](std::vector<double> flats, double before) {
        const size_t all = flats.size();
        std::erase_if(flats, [&](double flat) { return flat < LiftTuning::kShortestShare * before; });
        return flats.empty() || flats.size() * 10 < all
                   ? before
                   : std::min(median(std::move(flats)), LiftTuning::kLongestShare * before);
    };
    LimbShape standing = shape;
    standing.upper = length(std::move(uppers), shape.upper);
    standing.lower = length(std::move(lowers), shape.lower);
    return standing;
}

std::vector<LimbPlace> lift_limb(const LimbSight& sight, const LimbShape& shape,
                                 const EarlierPlaces& earlier) {
    const LimbFrames frames(sight, shape, earlier);
    const double fps = sight.fps;
    const std::vector<LimbAngles> angles =
        smoothed(Refinement(frames, choose_ways(frames, fps), fps).run(), shape.swing, fps);
    std::vector<LimbPlace> places;
    for (size_t t = 0; t < frames.size(); ++t) places.push_back(frames.place(t, angles[t]));
    return places;
}

}  // namespace chironomia
