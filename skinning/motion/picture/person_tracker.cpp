#include "skinning/motion/picture/person_tracker.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace chironomia {
namespace {

// Ours, by two made people who cross at a quarter of a metre a second: the velocity is a mean over some frames, because points jitter, and
// is forgotten when nobody was seen for half a second of 30 frames/s.
constexpr float kNewVelocity = 0.3f;        // weight of the last step
constexpr std::size_t kLongestUnseen = 15;  // [frames]

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

double confidence_of(const Points& person) {
    return std::accumulate(person.begin(), person.end(), 0.0, [](double sum, const PersonPoint& point) {
        return sum + static_cast<double>(point.confidence);
    });
}

}  // namespace

// The mean over the points that both show; very far if there is none.
double PersonTracker::distance_from_last(const Points& person) const {
    const Vec2 moved = velocity_ * static_cast<float>(std::min(unseen_ + 1, kLongestUnseen));
    double sum = 0, shared = 0;
    for (std::size_t k = 0; k < std::min(last_.size(), person.size()); ++k) {
        if (last_[k].confidence == 0 || person[k].confidence == 0) continue;
        sum += static_cast<double>(glm::distance(last_[k].place + moved, person[k].place));
        ++shared;
    }
    return shared > 0 ? sum / shared : std::numeric_limits<double>::max();
}

void PersonTracker::go_on(const Points& person) {
    if (size_of(person) == 0) {
        ++unseen_;
        return;
    }
    const auto [shared, way] = way_between(last_, person);
    if (unseen_ >= kLongestUnseen)
        velocity_ = Vec2(0);
    else if (shared > 0)
        velocity_ = glm::mix(velocity_, way / shared / static_cast<float>(unseen_ + 1), kNewVelocity);
    last_ = person;
    unseen_ = 0;
}

std::optional<std::size_t> PersonTracker::choose(const std::vector<std::vector<PersonPoint>>& people,
                                                 std::size_t body_points) {
    if (people.empty()) {
        ++unseen_;
        return std::nullopt;
    }
    std::vector<Points> bodies;
    std::vector<std::pair<double, std::size_t>> ranks;  // the less the better
    for (std::size_t i = 0; i < people.size(); ++i) {
        bodies.emplace_back(people[i].begin(), people[i].begin() + static_cast<std::ptrdiff_t>(body_points));
        ranks.emplace_back(last_.empty() ? -confidence_of(bodies[i]) : distance_from_last(bodies[i]), i);
    }
    std::sort(ranks.begin(), ranks.end());
    if (people.size() > 1) ++crowded_;
    // The other person is hardly further off than the one who is taken.
    if (!last_.empty() && people.size() > 1 &&
        ranks[1].first - ranks[0].first < 0.2 * static_cast<double>(size_of(last_)))
        ++doubtful_;
    go_on(bodies[ranks[0].second]);
    return ranks[0].second;
}

}  // namespace chironomia
