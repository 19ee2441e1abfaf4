#include "skinning/body/body_frame.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/quantile.h"

namespace chironomia {
namespace {

using enum Landmark;

std::optional<Vec3> at(const LandmarkFrame& frame, Landmark landmark) {
    return frame[static_cast<size_t>(landmark)];
}

std::optional<Vec3> middle(const LandmarkFrame& frame, Landmark left) {
    const auto a = at(frame, left), b = at(frame, mirrored(left));
    if (!a || !b) return std::nullopt;
    return (*a + *b) * 0.5f;
}

std::optional<Vec3> first_of(std::initializer_list<std::optional<Vec3>> places) {
    for (const auto& place : places) {
        if (place) return place;
    }
    return std::nullopt;
}

std::optional<Vec3> hips_of(const LandmarkFrame& frame) {
    return first_of({middle(frame, left_hip), at(frame, pelvis)});
}

std::optional<Vec3> shoulders_of(const LandmarkFrame& frame) {
    return first_of({middle(frame, left_shoulder), at(frame, thorax)});
}

std::optional<Vec3> head_of(const LandmarkFrame& frame) {
    return first_of(
        {at(frame, head), middle(frame, left_ear), at(frame, nose), at(frame, head_top), at(frame, neck)});
}

// From the hips to the head, or as much of it as there is; not unit.
std::optional<Vec3> trunk_of(const LandmarkFrame& frame) {
    const auto low = first_of({hips_of(frame), shoulders_of(frame)});
    const auto high = first_of({head_of(frame), shoulders_of(frame)});
    if (!low || !high || *low == *high) return std::nullopt;
    return *high - *low;
}

std::optional<Vec3> unit(const Vec3& direction) {
    const float size = length(direction);
    if (!(size > 1e-12f)) return std::nullopt;
    return direction / size;
}

std::optional<Vec3> mean_up(const std::vector<LandmarkFrame>& frames) {
    Vec3 sum(0);
    for (const LandmarkFrame& frame : frames) {
        if (const auto trunk = trunk_of(frame)) sum += normalize(*trunk);
    }
    return unit(sum);
}

// To the left, from hips and shoulders, at right angles to `up`.
std::optional<Vec3> left_of(const LandmarkFrame& frame, const Vec3& up) {
    Vec3 sum(0);
    for (const Landmark left : {left_hip, left_shoulder}) {
        const auto a = at(frame, left), b = at(frame, mirrored(left));
        if (a && b) sum += *a - *b;
    }
    // Without hips and shoulders the face has sides, too.
    if (sum == Vec3(0)) {
        const auto a = at(frame, left_ear), b = at(frame, right_ear);
        if (a && b) sum = *a - *b;
    }
    return unit(sum - up * dot(sum, up));
}

std::optional<Vec3> mean_forward(const std::vector<LandmarkFrame>& frames, size_t beginning, const Vec3& up) {
    Vec3 sum(0);
    for (size_t t = 0; t < std::min(beginning, frames.size()); ++t) {
        if (const auto left = left_of(frames[t], up)) sum += cross(*left, up);
    }
    return unit(sum);
}

// Adds up how far directions that lead to the front agree with `forward`; each counts with its certainty.
class FrontVotes {
  public:
    explicit FrontVotes(const Vec3& forward) : forward_(forward) {}

    // `least`: shorter than this, the direction says nothing.
    void add(const std::optional<Vec3>& from, const std::optional<Vec3>& to, float weight, float least) {
        if (!from || !to) return;
        const Vec3 direction = *to - *from;
        if (length(direction) <= least) return;
        agree_ += weight * dot(normalize(direction), forward_);
        weights_ += weight;
    }

    float result() const { return weights_ > 0 ? agree_ / weights_ : 0; }

  private:
    Vec3 forward_;
    float agree_ = 0;
    float weights_ = 0;
};

// Whether feet or knees show the front.
bool shows_legs(const std::vector<LandmarkFrame>& frames) {
    return std::any_of(frames.begin(), frames.end(), [](const LandmarkFrame& frame) {
        for (const bool other : {false, true}) {
            const auto has = [&](Landmark l) { return at(frame, other ? mirrored(l) : l).has_value(); };
            if ((has(left_heel) || has(left_ankle)) && has(left_toe)) return true;
            if (has(left_hip) && has(left_knee) && has(left_ankle)) return true;
        }
        return false;
    });
}

// Feet point to the front, knees bend to the front and elbows to the back.
void add_limbs(FrontVotes& votes, const LandmarkFrame& frame, float height) {
    for (const bool other : {false, true}) {
        const auto place = [&](Landmark l) { return at(frame, other ? mirrored(l) : l); };
        const auto halfway = [&](Landmark a, Landmark b) -> std::optional<Vec3> {
            if (!place(a) || !place(b)) return std::nullopt;
            return (*place(a) + *place(b)) * 0.5f;
        };
        votes.add(first_of({place(left_heel), place(left_ankle)}), place(left_toe), 2, 0.02f * height);
        votes.add(halfway(left_hip, left_ankle), place(left_knee), 1, 0.02f * height);
        votes.add(place(left_elbow), halfway(left_shoulder, left_wrist), 0.5f, 0.02f * height);
    }
}

// Nose and toes lie in front of the body, knees bend to the front. Elbows bend to the back only in company: those of an
// upper body that reaches out may bend either way throughout a clip.
float front_of(const std::vector<LandmarkFrame>& frames, const Vec3& up, float height) {
    const bool legs = shows_legs(frames);
    float sum = 0;
    size_t counted = 0;
    for (const LandmarkFrame& frame : frames) {
        const auto left = left_of(frame, up);
        if (!left) continue;
        FrontVotes votes(cross(*left, up));
        votes.add(first_of({middle(frame, left_ear), at(frame, head)}), at(frame, nose), 2, 0.01f * height);
        votes.add(legs ? at(frame, thorax) : first_of({at(frame, thorax), middle(frame, left_shoulder)}),
                  at(frame, nose), 1, 0.01f * height);
        if (legs) add_limbs(votes, frame, height);
        sum += votes.result();
        ++counted;
    }
    return counted > 0 ? sum / static_cast<float>(counted) : 0;
}

// A part of the body and its share of a grown-up's height, rounded; the shares of the joints of MakeHuman's
// neutral figure lie within 10 %.
struct Segment {
    Landmark from, to;
    float share;
};

constexpr std::array<Segment, 4> kSegments = {{
    {left_hip, left_knee, 0.245f},
    {left_knee, left_ankle, 0.245f},
    {left_shoulder, left_elbow, 0.170f},
    {left_elbow, left_wrist, 0.147f},
}};
constexpr float kTrunkShare = 0.285f;  // from the middle of the hips to the middle of the shoulders

// Median over the frames of one distance, divided by its share of the height.
template <typename Ends>
void add_estimate(std::vector<float>& estimates, const std::vector<LandmarkFrame>& frames, float share,
                  Ends ends) {
    std::vector<float> lengths;
    for (const LandmarkFrame& frame : frames) {
        const std::pair<std::optional<Vec3>, std::optional<Vec3>> pair = ends(frame);
        if (pair.first && pair.second) lengths.push_back(distance(*pair.first, *pair.second));
    }
    if (!lengths.empty()) estimates.push_back(median(std::move(lengths)) / share);
}

std::optional<float> find_height(const std::vector<LandmarkFrame>& frames) {
    std::vector<float> estimates;
    for (const Segment& part : kSegments) {
        for (const bool other : {false, true}) {
            const Landmark from = other ? mirrored(part.from) : part.from;
            const Landmark to = other ? mirrored(part.to) : part.to;
            add_estimate(estimates, frames, part.share, [&](const LandmarkFrame& frame) {
                return std::pair(at(frame, from), at(frame, to));
            });
        }
    }
    add_estimate(estimates, frames, kTrunkShare,
                 [](const LandmarkFrame& frame) { return std::pair(hips_of(frame), shoulders_of(frame)); });
    std::erase_if(estimates, [](float estimate) { return !(estimate > 0); });
    if (estimates.empty()) return std::nullopt;
    return median(std::move(estimates));
}

}  // namespace

std::optional<UpperBodyFrame> find_upper_body_frame(const std::vector<LandmarkFrame>& frames) {
    if (std::any_of(frames.begin(), frames.end(),
                    [](const LandmarkFrame& frame) { return hips_of(frame).has_value(); }))
        return std::nullopt;
    const auto head = mean_up(frames);
    if (!head) return std::nullopt;
    Vec3 sum(0);
    float arms = 0;
    for (const LandmarkFrame& frame : frames) {
        for (const LimbLandmarks& arm : kArmLandmarks) {
            const auto shoulder = at(frame, arm.root), elbow = at(frame, arm.mid);
            if (!shoulder || !elbow || *shoulder == *elbow) continue;
            sum += normalize(*elbow - *shoulder);
            ++arms;
        }
    }
    UpperBodyFrame body{.head = *head, .arms = {}};
    if (arms > 0) body.arms = sum / arms;
    return body;
}

BodyFrame find_body_frame(const std::vector<LandmarkFrame>& frames, size_t beginning) {
    const auto up = mean_up(frames);
    if (up) return find_body_frame(frames, beginning, *up);
    return {.up = {}, .forward = {}, .height = find_height(frames)};
}

BodyFrame find_body_frame(const std::vector<LandmarkFrame>& frames, size_t beginning, const Vec3& up) {
    assert(beginning >= 1);
    BodyFrame body{.up = up, .forward = mean_forward(frames, beginning, up), .height = find_height(frames)};
    if (body.forward) body.front = front_of(frames, up, body.height.value_or(0));
    return body;
}

}  // namespace chironomia
