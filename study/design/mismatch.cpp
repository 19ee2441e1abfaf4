#include "study/design/mismatch.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

double apart(const SpokenClip& a, const SpokenClip& b) {
    return std::abs(a.seconds - b.seconds) / std::max(a.seconds, b.seconds);
}

// By clip: the other clips that it may be paired with. Equal lengths are never too far apart, whatever rounding did.
using Choices = std::vector<std::vector<std::size_t>>;

Choices choices_within(const std::vector<SpokenClip>& clips, double tolerance) {
    Choices choices(clips.size());
    for (std::size_t a = 0; a < clips.size(); ++a) {
        for (std::size_t b = 0; b < clips.size(); ++b) {
            if (a == b || clips[a].speaker != clips[b].speaker) continue;
            if (apart(clips[a], clips[b]) <= tolerance + 1e-9) choices[a].push_back(b);
        }
    }
    return choices;
}

// Bipartite matching by augmenting paths: clips on one side, their partners on the other. A clip whose possible
// partners are all matched takes the partner of another clip if that clip can be matched with a different one.
class Matching {
  public:
    explicit Matching(const Choices& choices)
        : choices_(choices), partner_of_(choices.size()), clip_of_(choices.size()) {}

    // Whether this clip could be matched too.
    bool match(std::size_t clip) {
        visited_.assign(choices_.size(), false);
        tried_.clear();
        return augment(clip);
    }

    // The clips that compete for too few partners, after match() has failed.
    std::vector<std::size_t> competitors() const {
        std::vector<std::size_t> sorted = tried_;
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    }

    // By clip; all must be matched.
    std::vector<std::size_t> partners() const {
        std::vector<std::size_t> all;
        for (const auto& partner : partner_of_) all.push_back(*partner);
        return all;
    }

  private:
    bool augment(std::size_t clip) {
        tried_.push_back(clip);
        for (const std::size_t partner : choices_[clip]) {
            if (visited_[partner]) continue;
            visited_[partner] = true;
            if (clip_of_[partner] && !augment(*clip_of_[partner])) continue;
            clip_of_[partner] = clip;
            partner_of_[clip] = partner;
            return true;
        }
        return false;
    }

    const Choices& choices_;
    std::vector<std::optional<std::size_t>> partner_of_, clip_of_;
    std::vector<bool> visited_;       // partners on the paths of this search
    std::vector<std::size_t> tried_;  // clips on them
};

bool can_match_all(const Choices& choices) {
    Matching matching(choices);
    for (std::size_t clip = 0; clip < choices.size(); ++clip)
        if (!matching.match(clip)) return false;
    return true;
}

// The smallest tolerance that would do for all; nothing if none does.
std::optional<double> least_tolerance(const std::vector<SpokenClip>& clips) {
    std::vector<double> steps;
    for (std::size_t a = 0; a < clips.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (clips[a].speaker == clips[b].speaker) steps.push_back(apart(clips[a], clips[b]));
    std::sort(steps.begin(), steps.end());
    const auto found = std::partition_point(steps.begin(), steps.end(), [&](double tolerance) {
        return !can_match_all(choices_within(clips, tolerance));
    });
    return found == steps.end() ? std::nullopt : std::optional(*found);
}

[[noreturn]] void refuse(const std::vector<SpokenClip>& clips, const std::vector<std::size_t>& competitors,
                         double tolerance) {
    std::vector<std::string> names;
    for (const std::size_t clip : competitors)
        names.push_back(format("\"{}\" ({:.2f} s)", clips[clip].id, clips[clip].seconds));
    const std::string& speaker = clips[competitors.front()].speaker;
    const auto enough = least_tolerance(clips);
    throw Error(
        format("mismatch: speaker \"{}\" has too few other clips whose lengths are within {:.4g} % of {}; {}",
               speaker, 100 * tolerance, join(names),
               enough ? format("allow a tolerance of {:.4g} %, or add clips of about this length",
                               std::ceil(*enough * 1000) / 10)
                      : "add clips of this speaker, since no tolerance helps"));
}

}  // namespace

std::vector<std::size_t> draw_mismatch(const std::vector<SpokenClip>& clips, const MismatchOptions& options) {
    Choices choices = choices_within(clips, options.tolerance);
    Random random(options.seed);
    for (std::vector<std::size_t>& each : choices) random.shuffle(each);
    std::vector<std::size_t> order(clips.size());
    std::iota(order.begin(), order.end(), 0);
    random.shuffle(order);
    Matching matching(choices);
    for (const std::size_t clip : order)
        if (!matching.match(clip)) refuse(clips, matching.competitors(), options.tolerance);
    return matching.partners();
}

}  // namespace chironomia::study
