#include "skinning/motion/picture/person_tracker.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/text.h"

namespace chironomia {
namespace {

// Ours, chosen by two synthetic people who cross at a quarter of a metre a second: the velocity is a mean over some
// frames, because points jitter, and is forgotten when nobody was seen for half a second of 30 frames/s.
constexpr float kNewVelocity = 0.3f;        // weight of the last step
constexpr std::size_t kLongestUnseen = 15;  // [frames]
// Detectors at times find one person twice. Another person is further away than a fifth of a person's size in so many
// frames.
constexpr double kNear = 0.2;  // of the diagonal of a person
constexpr std::size_t kFramesApart = 5;
constexpr double kSame = 0.07;  // ours, of the diagonal: 13 cm of a grown-up; who crosses moves on from there
constexpr double kLeap = 0.5;   // ours, of the diagonal, from one frame to the next: nobody is that fast
constexpr std::size_t kMostTracks = 32;                      // a crowd behind them is not followed
constexpr double kFar = std::numeric_limits<double>::max();  // points have nothing in common

using Points = std::vector<PersonPoint>;

// From the points of one frame to those of another that both show: their number and the sum of their ways.
std::pair<float, Vec2> way_between(const Points& from, const Points& to) {
    float shared = 0;
    Vec2 way(0);
    for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k) {
        if (from[k].confidence == 0 || to[k].confidence == 0) continue;
        way += to[k].place - from[k].place;
        ++shared;
    }
    return {shared, way};
}

// The diagonal of the box around the points that are seen; 0 if there are none.
float size_of(const Points& person) {
    Vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const PersonPoint& point : person) {
        if (point.confidence == 0) continue;
        low = glm::min(low, point.place);
        high = glm::max(high, point.place);
    }
    return low.x <= high.x ? glm::distance(low, high) : 0;
}

// The mean way between the points that both show, where one of them moves by `moved` before.
double mean_distance(const Points& a, const Vec2& moved, const Points& b) {
    double sum = 0, shared = 0;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
        if (a[k].confidence == 0 || b[k].confidence == 0) continue;
        sum += static_cast<double>(glm::distance(a[k].place + moved, b[k].place));
        ++shared;
    }
    return shared > 0 ? sum / shared : kFar;
}

double confidence_of(const Points& person) {
    return std::accumulate(person.begin(), person.end(), 0.0, [](double sum, const PersonPoint& point) {
        return sum + static_cast<double>(point.confidence);
    });
}

}  // namespace

double PersonTracker::Track::distance_to(const Points& person) const {
    return mean_distance(last, velocity * static_cast<float>(std::min(unseen + 1, kLongestUnseen)), person);
}

void PersonTracker::Track::go_on(const Points* person) {
    if (!person || size_of(*person) == 0) {
        ++unseen;
        return;
    }
    const auto [shared, way] = way_between(last, *person);
    if (unseen >= kLongestUnseen)
        velocity = Vec2(0);
    else if (shared > 0)
        velocity = glm::mix(velocity, way / shared / static_cast<float>(unseen + 1), kNewVelocity);
    last = *person;
    unseen = 0;
}

// The body of each track. A track that may be the followed person, found twice, chooses after all others.
std::vector<std::optional<std::size_t>> PersonTracker::assign(const std::vector<Points>& bodies) {
    std::vector<std::tuple<bool, double, std::size_t, std::size_t>> pairs;
    std::vector<double> ours;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const double distance = tracks_[i].distance_to(bodies[b]);
            if (i == 0) ours.push_back(distance);
            if (i > 0 && distance == kFar) continue;
            pairs.emplace_back(i > 0 && tracks_[i].apart < kFramesApart, distance, i, b);
        }
    }
    std::sort(ours.begin(), ours.end());
    if (ours.size() > 1 && ours[1] - ours[0] < kNear * static_cast<double>(size_of(tracks_[0].last)))
        ++doubtful_;
    std::sort(pairs.begin(), pairs.end());
    std::vector<std::optional<std::size_t>> body_of(tracks_.size());
    std::vector<bool> taken(bodies.size());
    for (const auto& [late, distance, track, body] : pairs) {
        if (body_of[track] || taken[body]) continue;
        body_of[track] = body;
        taken[body] = true;
    }
    return body_of;
}

// The followed person's body, unless a surer one at the same place is of nobody else.
void PersonTracker::take_surest_of_same(const std::vector<Points>& bodies,
                                        std::vector<std::optional<std::size_t>>& body_of) const {
    if (!body_of.front()) return;
    const std::size_t ours = *body_of.front();
    std::size_t surest = ours;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const auto track = std::ranges::find(body_of, std::optional(b)) - body_of.begin();
        const bool is_other = track > 0 && static_cast<std::size_t>(track) < tracks_.size() &&
                              tracks_[static_cast<std::size_t>(track)].apart >= kFramesApart;
        const double near = kSame * static_cast<double>(std::max(size_of(bodies[ours]), size_of(bodies[b])));
        if (!is_other && mean_distance(bodies[ours], Vec2(0), bodies[b]) < near &&
            confidence_of(bodies[b]) > confidence_of(bodies[surest]))
            surest = b;
    }
    std::ranges::replace(body_of, std::optional(surest), std::optional(ours));
    body_of.front() = surest;
}

bool PersonTracker::leaps_to(const Points* body) const {
    const Track& ours = tracks_.front();
    const double distance = body ? ours.distance_to(*body) : kFar;
    const auto since = static_cast<double>(ours.unseen + 1);
    return distance != kFar && distance > since * kLeap * static_cast<double>(size_of(ours.last));
}

std::vector<std::string> PersonTracker::notes() const {
    std::vector<std::string> notes;
    if (crowded_ > 0) {
        notes.push_back(format("several people in {} frames; followed one by place, {} choices were close",
                               crowded_, doubtful_));
    }
    if (!leaps_.empty()) {
        constexpr std::size_t kShown = 5;
        std::vector<std::string> shown;
        for (std::size_t i = 0; i < std::min(leaps_.size(), kShown); ++i)
            shown.push_back(format("{}", leaps_[i]));
        notes.push_back(format(
            "the person is suddenly elsewhere in {} frames ({}{}), as where a film is cut or somebody else is seen",
            leaps_.size(), join(shown), leaps_.size() > kShown ? ", ..." : ""));
    }
    return notes;
}

void PersonTracker::follow_others(const std::vector<Points>& bodies, const std::vector<bool>& taken) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (!taken[b] && size_of(bodies[b]) > 0 && tracks_.size() < kMostTracks)
            tracks_.push_back({.last = bodies[b]});
    const Track& followed = tracks_.front();
    const double near = kNear * static_cast<double>(size_of(followed.last));
    for (std::size_t i = 1; i < tracks_.size(); ++i) {
        const double distance = followed.distance_to(tracks_[i].last);
        tracks_[i].apart += tracks_[i].unseen == 0 && distance != kFar && distance > near;
    }
    tracks_.erase(std::remove_if(tracks_.begin() + 1, tracks_.end(),
                                 [](const Track& track) { return track.unseen > kLongestUnseen; }),
                  tracks_.end());
}

std::optional<std::size_t> PersonTracker::choose(const std::vector<std::vector<PersonPoint>>& people,
                                                 std::size_t body_points) {
    std::vector<Points> bodies;
    for (const Points& person : people)
        bodies.emplace_back(person.begin(), person.begin() + static_cast<std::ptrdiff_t>(body_points));
    if (people.size() > 1) ++crowded_;
    std::vector<bool> taken(bodies.size());
    std::optional<std::size_t> chosen;
    if (!tracks_.empty()) {
        auto body_of = assign(bodies);
        take_surest_of_same(bodies, body_of);
        const bool leaps = leaps_to(body_of.front() ? &bodies[*body_of.front()] : nullptr);
        for (std::size_t i = 0; i < tracks_.size(); ++i) {
            tracks_[i].go_on(body_of[i] ? &bodies[*body_of[i]] : nullptr);
            if (body_of[i]) taken[*body_of[i]] = true;
        }
        chosen = body_of.front();
        if (leaps) {
            leaps_.push_back(frames_);
            tracks_.front().velocity = Vec2(0);  // that of nobody
        }
    } else if (!bodies.empty()) {
        const auto surest = std::max_element(
            bodies.begin(), bodies.end(),
            [](const Points& a, const Points& b) { return confidence_of(a) < confidence_of(b); });
        chosen = static_cast<std::size_t>(surest - bodies.begin());
        if (size_of(*surest) > 0) tracks_.push_back({.last = *surest});
        taken[*chosen] = true;
    }
    if (!tracks_.empty()) follow_others(bodies, taken);
    ++frames_;
    return chosen;
}

}  // namespace chironomia
