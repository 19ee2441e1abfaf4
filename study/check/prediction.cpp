#include "study/check/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/random.h"

namespace chironomia {
namespace {

using Table = std::vector<std::vector<double>>;  // (V, traits)

// Ranks of the traits within their clip, from -1 to 1, since sizes of clips differ whatever the condition. Equal values
// share the middle of their ranks.
Table ranks_within_clips(const std::vector<VideoTraits>& videos) {
    Table ranks(videos.size(), std::vector<double>(videos.front().traits.size(), 0));
    for (std::size_t i = 0; i < videos.size(); ++i) {
        for (std::size_t trait = 0; trait < ranks[i].size(); ++trait) {
            double below = 0, above = 0;
            for (const VideoTraits& other : videos) {
                if (other.clip != videos[i].clip) continue;
                below += other.traits[trait] < videos[i].traits[trait];
                above += other.traits[trait] > videos[i].traits[trait];
            }
            const double others = below + above;
            ranks[i][trait] = others > 0 ? (below - above) / others : 0;
        }
    }
    return ranks;
}

struct Labels {
    std::vector<std::size_t> clip;       // (V)
    std::vector<std::size_t> condition;  // (V)
    std::size_t clips = 0;
    std::size_t conditions = 0;
};

// Sums of a trait by clip and condition, and how many videos they are of.
struct Sums {
    std::vector<double> sum;    // (clips, conditions)
    std::vector<double> count;  // the same
};

Sums sums_of(const Table& ranks, const Labels& labels, std::size_t trait) {
    Sums sums{.sum = std::vector<double>(labels.clips * labels.conditions, 0), .count = {}};
    sums.count = sums.sum;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        const std::size_t at = labels.clip[i] * labels.conditions + labels.condition[i];
        sums.sum[at] += ranks[i][trait];
        sums.count[at] += 1;
    }
    return sums;
}

// Squared distances of each video from the mean of each condition on all other clips: (V, conditions).
Table distances(const Table& ranks, const Labels& labels, std::size_t trait) {
    const Sums sums = sums_of(ranks, labels, trait);
    Table far(ranks.size(), std::vector<double>(labels.conditions, 0));
    for (std::size_t condition = 0; condition < labels.conditions; ++condition) {
        double sum = 0, count = 0;
        for (std::size_t clip = 0; clip < labels.clips; ++clip) {
            sum += sums.sum[clip * labels.conditions + condition];
            count += sums.count[clip * labels.conditions + condition];
        }
        for (std::size_t i = 0; i < ranks.size(); ++i) {
            const std::size_t own = labels.clip[i] * labels.conditions + condition;
            const double others = count - sums.count[own];
            const double mean = others > 0 ? (sum - sums.sum[own]) / others : 0;
            far[i][condition] = (ranks[i][trait] - mean) * (ranks[i][trait] - mean);
        }
    }
    return far;
}

// Where several conditions are as near, each is as good a guess.
double hit_rate(const Table& far, const Labels& labels) {
    double hits = 0;
    for (std::size_t i = 0; i < far.size(); ++i) {
        const double nearest = *std::min_element(far[i].begin(), far[i].end());
        const auto as_near =
            std::count_if(far[i].begin(), far[i].end(), [&](double each) { return each <= nearest + 1e-12; });
        if (far[i][labels.condition[i]] <= nearest + 1e-12) hits += 1.0 / static_cast<double>(as_near);
    }
    return hits / static_cast<double>(far.size());
}

struct Best {
    std::size_t trait = 0;  // the number of traits: all of them together
    double rate = -1;
};

Best best_of(const Table& ranks, const Labels& labels) {
    Best best;
    const std::size_t traits = ranks.front().size();
    Table together(ranks.size(), std::vector<double>(labels.conditions, 0));
    for (std::size_t trait = 0; trait <= traits; ++trait) {
        Table far = trait < traits ? distances(ranks, labels, trait) : together;
        for (std::size_t i = 0; trait < traits && i < far.size(); ++i) {
            for (std::size_t condition = 0; condition < labels.conditions; ++condition)
                together[i][condition] += far[i][condition];
        }
        const double rate = hit_rate(far, labels);
        if (rate > best.rate + 1e-12) best = {.trait = trait, .rate = rate};
    }
    return best;
}

Labels labels_of(const std::vector<VideoTraits>& videos) {
    Labels labels;
    for (const VideoTraits& video : videos) {
        labels.clip.push_back(video.clip);
        labels.condition.push_back(video.condition);
        labels.clips = std::max(labels.clips, video.clip + 1);
        labels.conditions = std::max(labels.conditions, video.condition + 1);
    }
    return labels;
}

// The conditions of each clip's videos change places.
void shuffle_within_clips(Labels& labels, Random& random) {
    std::map<std::size_t, std::vector<std::size_t>> of_clip;
    for (std::size_t i = 0; i < labels.clip.size(); ++i)
        of_clip[labels.clip[i]].push_back(labels.condition[i]);
    for (auto& [clip, conditions] : of_clip) random.shuffle(conditions);
    for (std::size_t i = labels.clip.size(); i-- > 0;) {
        auto& conditions = of_clip[labels.clip[i]];
        labels.condition[i] = conditions.back();
        conditions.pop_back();
    }
}

}  // namespace

Prediction predict_conditions(const std::vector<VideoTraits>& videos, const std::vector<std::string>& names,
                              std::size_t shuffles, std::uint64_t seed) {
    const Table ranks = ranks_within_clips(videos);
    Labels labels = labels_of(videos);
    const Best found = best_of(ranks, labels);
    Prediction prediction{.trait = found.trait < names.size() ? names[found.trait] : "all together",
                          .hit_rate = found.rate,
                          .videos = videos.size(),
                          .shuffles = shuffles};
    Random random(seed);
    std::size_t as_good = 0;
    double sum = 0;
    for (std::size_t i = 0; i < shuffles; ++i) {
        shuffle_within_clips(labels, random);
        const double rate = best_of(ranks, labels).rate;
        sum += rate;
        as_good += rate >= found.rate - 1e-12;
    }
    prediction.chance = sum / static_cast<double>(shuffles);
    // The study as it is counts as one of the shuffles (Phipson and Smyth, 2010: no p of 0).
    prediction.p = static_cast<double>(as_good + 1) / static_cast<double>(shuffles + 1);
    return prediction;
}

}  // namespace chironomia
