#include "skinning/motion/picture/person_tracker.h"

#include <algorithm>
#include <utility>

namespace chironomia {

PersonTracker::Summary PersonTracker::summary_of(const std::vector<PersonPoint>& person,
                                                 std::size_t body_points) {
    Summary summary;
    Vec2 low(1e9f), high(-1e9f);
    float seen = 0;
    for (std::size_t k = 0; k < body_points; ++k) {
        summary.confidence += static_cast<double>(person[k].confidence);
        if (person[k].confidence == 0) continue;
        summary.place += person[k].place;
        low = glm::min(low, person[k].place);
        high = glm::max(high, person[k].place);
        ++seen;
    }
    if (seen > 0) {
        summary.place /= seen;
        summary.size = glm::distance(low, high);
    }
    return summary;
}

std::optional<std::size_t> PersonTracker::choose(const std::vector<std::vector<PersonPoint>>& people,
                                                 std::size_t body_points) {
    if (people.empty()) return std::nullopt;
    std::vector<std::pair<double, std::size_t>> ranks;  // the less the better
    for (std::size_t i = 0; i < people.size(); ++i) {
        const Summary summary = summary_of(people[i], body_points);
        const double rank =
            last_ ? static_cast<double>(glm::distance(summary.place, last_->place)) : -summary.confidence;
        ranks.emplace_back(rank, i);
    }
    std::sort(ranks.begin(), ranks.end());
    if (people.size() > 1) ++crowded_;
    // The other person is hardly further off than the one who is taken.
    if (last_ && people.size() > 1 &&
        ranks[1].first - ranks[0].first < 0.2 * static_cast<double>(last_->size))
        ++doubtful_;
    const std::size_t chosen = ranks[0].second;
    const Summary summary = summary_of(people[chosen], body_points);
    if (summary.size > 0) last_ = summary;
    return chosen;
}

}  // namespace chironomia
