#include "study/build/draft.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/build/blinding.h"
#include "study/build/pages.h"
#include "study/clip/tones.h"

namespace chironomia::study {
namespace {

std::string make_key(const Plan& plan, std::uint64_t seed, const std::vector<InputFile>& inputs) {
    std::vector<std::string> hashes = {sha256(plan_as_used(plan).dump())};
    for (const InputFile& input : inputs) hashes.push_back(input.sha256);
    return make_study_key(seed, hashes);
}

// What each page needs, from left to right.
std::vector<VideoWish> wishes_of(const Plan& plan, const PlannedPage& page) {
    std::vector<VideoWish> wishes;
    if (plan.presentation == Presentation::one_video) {
        wishes.push_back({.clip = page.clip, .conditions = page.places, .notice = page.notice});
        return wishes;
    }
    for (std::size_t i = 0; i < page.places.size(); ++i) {
        const bool has_notice = page.notice && page.notice->place == i;
        wishes.push_back({.clip = page.clip,
                          .conditions = {page.places[i]},
                          .notice = has_notice ? page.notice : std::nullopt});
    }
    return wishes;
}

// Every video once, clip by clip.
std::vector<VideoWish> list_wishes(const StudyDraft& draft) {
    std::vector<VideoWish> all;
    std::set<VideoWish> known;
    for (const PlannedPage& page : draft.all.pages) {
        for (const VideoWish& wish : wishes_of(draft.plan, page)) {
            if (known.insert(wish).second) all.push_back(wish);
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const VideoWish& a, const VideoWish& b) {
        return std::pair(a.clip, a.conditions) < std::pair(b.clip, b.conditions);
    });
    return all;
}

void find_videos_of_pages(const std::vector<VideoWish>& wishes, StudyDraft& draft) {
    std::map<VideoWish, std::size_t> number_of;
    for (const VideoWish& wish : wishes) number_of.emplace(wish, number_of.size());
    for (const PlannedPage& page : draft.all.pages) {
        auto& videos = draft.videos_of_page.emplace_back();
        for (const VideoWish& wish : wishes_of(draft.plan, page)) videos.push_back(number_of.at(wish));
    }
}

// One draw of names for all parts of the study, so that no two are alike.
void name_all(StudyDraft& draft) {
    const std::size_t sounds = draft.plan.sound_check ? kTonesOfSoundCheck : 0;
    const std::vector<std::string> tokens = make_tokens(
        draft.key,
        texts_to_name({.videos = draft.videos.size(), .pages = draft.all.pages.size(), .sounds = sounds}));
    auto next = tokens.begin();
    draft.name = *next++;
    for (Video& video : draft.videos) video.token = *next++;
    for (std::size_t i = 0; i < draft.all.pages.size(); ++i) draft.names_of_pages.push_back(*next++);
    for (std::size_t i = 0; i < sounds; ++i) draft.names_of_sounds.push_back(*next++);
}

std::string recipe_of_study(const StudyDraft& draft) {
    Json recipe = {{"key", draft.key}, {"program", program_hash()}};
    for (const Video& video : draft.videos) recipe["videos"].push_back(video.recipe);
    for (const PlayerFile& file : player_files()) recipe["player"].push_back(sha256(file.content));
    return sha256(recipe.dump());
}

}  // namespace

StudyDraft draft_study(const Plan& plan, std::uint64_t seed, const ClipMaker& maker) {
    StudyDraft draft;
    draft.plan = plan;
    draft.seed = seed;
    draft.inputs = list_inputs(plan);
    draft.key = make_key(plan, seed, draft.inputs);
    draft.all = compose(plan, seed);
    const std::vector<VideoWish> wishes = list_wishes(draft);
    draft.performed = perform_clips(plan);
    draft.videos = list_videos(draft.performed.plan, wishes, seed, maker);
    find_videos_of_pages(wishes, draft);
    name_all(draft);
    draft.recipe = recipe_of_study(draft);
    return draft;
}

}  // namespace chironomia::study
