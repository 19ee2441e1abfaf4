#include "study/measure/adaptation.h"

#include <algorithm>
#include <cmath>

namespace chironomia::study {
namespace {

constexpr double kWithin = 2;  // [s] from one onset to the next

std::size_t frames_in(double seconds, double fps) {
    return static_cast<std::size_t>(std::lround(seconds * fps));
}

// Seconds of each minute.
double per_minute(double frames, const PairedRuns& runs) {
    return frames * 60 / static_cast<double>(runs.frames);
}

// The first of `runs` that begins at `from` or later, and soon after `before` or while it lasts.
const ActiveRun* follower(const std::vector<ActiveRun>& runs, const ActiveRun& before, std::size_t from,
                          double fps) {
    const std::size_t until = std::max(before.onset + frames_in(kWithin, fps), before.offset - 1);
    const auto found =
        std::find_if(runs.begin(), runs.end(), [&](const ActiveRun& run) { return run.onset >= from; });
    return found != runs.end() && found->onset <= until ? &*found : nullptr;
}

// Loops that begin and end with a run of `own`.
double loops(const std::vector<ActiveRun>& own, const std::vector<ActiveRun>& other, double fps) {
    double frames = 0;
    for (const ActiveRun& first : own) {
        const ActiveRun* answer = follower(other, first, first.onset, fps);
        if (!answer) continue;
        // Not the run that began the loop itself, should both begin in the same frame.
        const ActiveRun* last = follower(own, *answer, std::max(answer->onset, first.onset + 1), fps);
        if (last) frames += static_cast<double>(std::max(last->offset, answer->offset) - first.onset);
    }
    return frames;
}

}  // namespace

std::vector<ActiveRun> active_runs(std::span<const float> intensities, double fps, double threshold) {
    constexpr double kBridged = 0.12, kShortest = 0.2;  // [s]
    std::vector<ActiveRun> runs;
    for (std::size_t t = 0; t < intensities.size(); ++t) {
        if (!(intensities[t] > threshold)) continue;
        if (!runs.empty() && t - runs.back().offset <= frames_in(kBridged, fps)) {
            runs.back().offset = t + 1;
        } else {
            runs.push_back({t, t + 1});
        }
    }
    const std::size_t least = std::max<std::size_t>(1, frames_in(kShortest, fps));
    std::erase_if(runs, [&](const ActiveRun& run) { return run.length() < least; });
    return runs;
}

double synchrony(const PairedRuns& runs) {
    const auto within = static_cast<std::ptrdiff_t>(frames_in(kWithin, runs.fps));
    double frames = 0;
    for (const ActiveRun& a : runs.a) {
        for (const ActiveRun& u : runs.u) {
            const auto apart = static_cast<std::ptrdiff_t>(a.onset) - static_cast<std::ptrdiff_t>(u.onset);
            if (std::abs(apart) <= within) frames += static_cast<double>(std::min(a.length(), u.length()));
        }
    }
    return per_minute(frames, runs);
}

double entrainment(const PairedRuns& runs) {
    return per_minute(loops(runs.a, runs.u, runs.fps) + loops(runs.u, runs.a, runs.fps), runs);
}

const std::vector<AdaptationMeasure>& adaptation_measures() {
    static const std::vector<AdaptationMeasure> measures = {
        {"sync", "Sync", "s/min", "proposed", synchrony},
        {"el", "EL", "s/min", "proposed", entrainment},
    };
    return measures;
}

}  // namespace chironomia::study
