#include "study/check/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "study/build/study_files.h"

namespace chironomia::study {
namespace fs = std::filesystem;
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

constexpr std::size_t kShuffles = 1999;
constexpr double kSignificanceLevel = 0.001;  // one study in a thousand is below it by chance

// Where and how often participants meet a video.
struct Meetings {
    double times = 0;
    double places = 0;     // sum of the places from the left
    double positions = 0;  // sum of the positions on the sheets
};

std::map<std::string, Meetings> meetings_of(const StudyRecord& study) {
    std::map<std::string, Meetings> all;
    for (const Sheet& sheet : study.pages.sheets) {
        for (std::size_t at = 0; at < sheet.pages.size(); ++at) {
            const Showing& shown = sheet.pages[at];
            const auto& videos = study.pages.pages[shown.page].videos;
            for (std::size_t place = 0; place < shown.order.size(); ++place) {
                Meetings& met = all[videos.at(shown.order[place])];
                met.times += 1;
                met.places += static_cast<double>(place);
                met.positions += static_cast<double>(at);
            }
        }
    }
    return all;
}

// Where pages.json has each video first: the page and the place.
using ListedPlaces = std::map<std::string, std::pair<double, double>>;

ListedPlaces listed_places_of(const StudyRecord& study) {
    ListedPlaces places;
    for (std::size_t page = 0; page < study.pages.pages.size(); ++page) {
        const auto& videos = study.pages.pages[page].videos;
        for (std::size_t place = 0; place < videos.size(); ++place)
            places.emplace(videos[place], std::pair(static_cast<double>(page), static_cast<double>(place)));
    }
    return places;
}

const std::vector<std::string> kTraits = {
    "name",       "last digit of the name", "bytes", "page of the list", "place of the list", "times shown",
    "mean place", "mean position"};

std::vector<double> traits_of(const StudyRecord& study, const KeyVideo& video, const ListedPlaces& listed,
                              const Meetings& met) {
    const fs::path file = StudyFolder{study.folder}.open() / video.file;
    if (!fs::is_regular_file(file)) throw Error(format("{} is missing", video.file));
    const auto found = listed.find(video.file);
    const auto [page, place] = found == listed.end() ? std::pair(0.0, 0.0) : found->second;
    const double times = std::max(met.times, 1.0);
    return {static_cast<double>(std::stoull(video.token.substr(0, 12), nullptr, 16)),
            static_cast<double>(std::stoull(video.token.substr(video.token.size() - 1), nullptr, 16)),
            static_cast<double>(fs::file_size(file)),
            page,
            place,
            met.times,
            met.places / times,
            met.positions / times};
}

bool is_token(const std::string& token) {
    return token.size() >= 12 && token.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// The videos of trials that show one condition each.
std::vector<VideoTraits> traits_of_videos(const StudyRecord& study) {
    std::map<std::string, Meetings> met = meetings_of(study);
    const ListedPlaces listed = listed_places_of(study);
    std::map<std::string_view, std::size_t> clips;
    for (const std::string& clip : study.key.clips) clips.emplace(clip, clips.size());
    std::vector<VideoTraits> all;
    for (const KeyVideo& video : study.key.videos) {
        const auto clip = clips.find(video.clip);
        const bool counts =
            video.conditions.size() == 1 && video.instruction.empty() && is_token(video.token);
        if (!counts || clip == clips.end()) continue;
        all.push_back({.clip = clip->second,
                       .condition = video.conditions.front(),
                       .traits = traits_of(study, video, listed, met[video.file])});
    }
    return all;
}

// In how many ways the conditions can stand within the clips.
double ways_to_shuffle(std::size_t clips, std::size_t conditions) {
    return std::pow(std::tgamma(static_cast<double>(conditions) + 1), static_cast<double>(clips));
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

Proof check_prediction(const StudyRecord& study) {
    Proof proof{
        .property = "nothing but pictures and sounds predicts a condition", .holds = true, .detail = ""};
    std::vector<VideoTraits> videos;
    try {
        videos = traits_of_videos(study);
    } catch (const std::exception& problem) {
        // A video that is missing or no video.
        return {.property = proof.property, .holds = false, .detail = problem.what()};
    }
    std::set<std::size_t> clips, conditions;
    for (const VideoTraits& video : videos) {
        clips.insert(video.clip);
        conditions.insert(video.condition);
    }
    if (ways_to_shuffle(clips.size(), conditions.size()) * kSignificanceLevel < 1) {
        proof.holds = false;
        proof.open = true;
        proof.detail = format("{} clips of {} conditions are too few to distinguish a leak from chance",
                              clips.size(), conditions.size());
        return proof;
    }
    const Prediction best = predict_conditions(videos, kTraits, kShuffles, study.key.seed);
    proof.holds = best.p > kSignificanceLevel;
    proof.detail = format(
        "best by {}: {:.0f} % of {} videos, {:.0f} % by chance (p {:.3f}, {} shuffles of conditions within "
        "clips)",
        best.trait, 100 * best.hit_rate, best.videos, 100 * best.chance, best.p, best.shuffles);
    return proof;
}

}  // namespace chironomia::study
