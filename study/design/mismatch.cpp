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

// Whom each clip may borrow from. Equal lengths are never too far apart, whatever rounding did.
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

// Bipartite matching by augmenting paths: a clip whose lenders are all taken takes the lender of another clip if that
// clip can have a different one.
class Matching {
  public:
    explicit Matching(const Choices& choices)
        : choices_(choices), lender_(choices.size()), borrower_(choices.size()) {}

    // Whether a lender could be found for this clip too.
    bool serve(std::size_t clip) {
        asked_.assign(choices_.size(), false);
        asking_.clear();
        return find(clip);
    }

    // The clips that compete for too few lenders, after serve() has failed.
    std::vector<std::size_t> competitors() const {
        std::vector<std::size_t> sorted = asking_;
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    }

    std::vector<std::size_t> lenders() const {
        std::vector<std::size_t> all;
        for (const auto& lender : lender_) all.push_back(*lender);
        return all;
    }

  private:
    bool find(std::size_t clip) {
        asking_.push_back(clip);
        for (const std::size_t lender : choices_[clip]) {
            if (asked_[lender]) continue;
            asked_[lender] = true;
            if (borrower_[lender] && !find(*borrower_[lender])) continue;
            borrower_[lender] = clip;
            lender_[clip] = lender;
            return true;
        }
        return false;
    }

    const Choices& choices_;
    std::vector<std::optional<std::size_t>> lender_, borrower_;
    std::vector<bool> asked_;
    std::vector<std::size_t> asking_;
};

bool can_serve_all(const Choices& choices) {
    Matching matching(choices);
    for (std::size_t clip = 0; clip < choices.size(); ++clip)
        if (!matching.serve(clip)) return false;
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
        return !can_serve_all(choices_within(clips, tolerance));
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
        if (!matching.serve(clip)) refuse(clips, matching.competitors(), options.tolerance);
    return matching.lenders();
}

}  // namespace chironomia::study
