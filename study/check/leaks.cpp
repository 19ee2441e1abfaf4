#include "study/check/leaks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "study/build/study_files.h"
#include "study/check/prediction.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

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

}  // namespace chironomia
