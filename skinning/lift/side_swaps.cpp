#include "skinning/lift/side_swaps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/quantile.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr double kLongestSwap = 0.25;  // [s]
constexpr float kShorter = 1 / 3.0f;   // of the ways, if the points are exchanged
constexpr double kUsualShare = 0.5;    // of how far the pair is mostly apart
constexpr double kShareOfBody = 0.03;  // of the diagonal of a body, least distance of a pair

// The diagonal of the box around all points of a frame.
float size_in(const PictureBody& body, size_t frame) {
    std::optional<std::pair<Vec2, Vec2>> box;
    for (size_t l = 0; l < kLandmarks; ++l) {
        if (!body.there[frame][l]) continue;
        const Vec2& place = body.places[frame][l];
        box = box ? std::pair(glm::min(box->first, place), glm::max(box->second, place))
                  : std::pair(place, place);
    }
    return box ? glm::distance(box->first, box->second) : 0;
}

double usual_size(const PictureBody& body) {
    std::vector<double> sizes;
    for (size_t t = 0; t < body.frames(); ++t)
        if (body.there[t].any()) sizes.push_back(size_in(body, t));
    return sizes.empty() ? 0 : median(sizes);
}

// Two points in the frames that show both.
class Pair {
  public:
    Pair(PictureBody& body, Landmark left) : body_(body), left_(left), right_(mirrored(left)) {
        for (size_t t = 0; t < body.frames(); ++t)
            if (body.sees(t, left_) && body.sees(t, right_)) shown_.push_back(t);
    }

    // Returns in how many frames the two were exchanged.
    size_t put_back(double least_distance, size_t longest) {
        if (shown_.size() < 3) return 0;
        least_ = std::max(least_distance, kUsualShare * usual_distance());
        size_t exchanged = 0;
        for (size_t i = 1; i < shown_.size(); ++i) {
            if (!change_places(i)) continue;
            size_t back = i + 1;
            while (back < shown_.size() && shown_[back] - shown_[i] <= longest && !change_places(back))
                ++back;
            if (back == shown_.size() || shown_[back] - shown_[i] > longest) continue;
            for (size_t t = shown_[i]; t < shown_[back]; ++t) exchange(t);
            exchanged += back - i;
            i = back;
        }
        return exchanged;
    }

  private:
    double distance_at(size_t i) const {
        return glm::distance(body_.at(shown_[i], left_), body_.at(shown_[i], right_));
    }

    double usual_distance() const {
        std::vector<double> distances;
        for (size_t i = 0; i < shown_.size(); ++i) distances.push_back(distance_at(i));
        return median(distances);
    }

    // Whether both points go to each other's places from one frame to the next.
    bool change_places(size_t i) const {
        if (distance_at(i - 1) < least_ || distance_at(i) < least_) return false;
        const auto way = [&](Landmark from, Landmark to) {
            return glm::distance(body_.at(shown_[i - 1], from), body_.at(shown_[i], to));
        };
        return way(left_, right_) + way(right_, left_) < kShorter * (way(left_, left_) + way(right_, right_));
    }

    void exchange(size_t t) {
        const auto l = static_cast<size_t>(left_), r = static_cast<size_t>(right_);
        std::swap(body_.places[t][l], body_.places[t][r]);
        const bool left_is_there = body_.there[t][l];
        body_.there[t][l] = body_.there[t][r];
        body_.there[t][r] = left_is_there;
    }

    PictureBody& body_;
    Landmark left_, right_;
    std::vector<size_t> shown_;
    double least_ = 0;
};

}  // namespace

std::vector<SideSwap> undo_side_swaps(PictureBody& body, double fps) {
    const auto longest = static_cast<size_t>(kLongestSwap * fps);
    const double least = kShareOfBody * usual_size(body);
    std::vector<SideSwap> swaps;
    for (int l = 0; l < kLandmarks; ++l) {
        const auto left = static_cast<Landmark>(l);
        if (static_cast<int>(mirrored(left)) <= l || !body.has(left) || !body.has(mirrored(left))) continue;
        const size_t frames = Pair(body, left).put_back(least, longest);
        if (frames > 0) swaps.push_back({.left = left, .frames = frames});
    }
    return swaps;
}

std::string to_text(const SideSwap& swap) {
    constexpr std::string_view kLeft = "left_";
    return format("{}: {} frames", name_of(swap.left).substr(kLeft.size()), swap.frames);
}

}  // namespace chironomia
