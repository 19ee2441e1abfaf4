#include "study/draft.h"

#include <algorithm>
#include <cassert>

#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/blinding.h"

namespace chironomia {
namespace {

DesignShape shape_of(const Plan& plan) {
    return {.clips = plan.clips.size(),
            .conditions = plan.conditions.size(),
            .may_swap = plan.presentation == Presentation::two_videos,
            .orders = plan.orders};
}

std::string make_key(const Plan& plan, std::uint64_t seed, const std::vector<InputFile>& inputs) {
    std::vector<std::string> hashes = {sha256(plan_as_used(plan).dump())};
    for (const InputFile& input : inputs) hashes.push_back(input.sha256);
    return make_study_key(seed, hashes);
}

std::size_t find_video(const std::vector<Video>& videos, std::size_t clip,
                       const std::vector<std::size_t>& conditions) {
    const auto found = std::find_if(videos.begin(), videos.end(), [&](const Video& video) {
        return video.clip == clip && video.conditions == conditions;
    });
    assert(found != videos.end());
    return static_cast<std::size_t>(found - videos.begin());
}

std::vector<std::vector<std::size_t>> find_videos_of_pages(const StudyDraft& draft) {
    std::vector<std::vector<std::size_t>> all;
    for (const Comparison& page : draft.design.pages) {
        if (draft.plan.presentation == Presentation::one_video) {
            all.push_back({find_video(draft.videos, page.clip, {page.left, page.right})});
        } else {
            all.push_back({find_video(draft.videos, page.clip, {page.left}),
                           find_video(draft.videos, page.clip, {page.right})});
        }
    }
    return all;
}

// One draw of names for the study, its videos and its pages, so that no two are alike.
void name_all(StudyDraft& draft) {
    const std::vector<std::string> tokens =
        make_tokens(draft.key, texts_to_name(draft.videos.size(), draft.design.pages.size()));
    draft.names.study = tokens[0];
    for (std::size_t i = 0; i < draft.videos.size(); ++i) draft.videos[i].token = tokens[1 + i];
    draft.names.pages.assign(tokens.begin() + static_cast<std::ptrdiff_t>(1 + draft.videos.size()),
                             tokens.end());
    for (const auto& videos : draft.videos_of_page) {
        auto& names = draft.names.videos.emplace_back();
        for (const std::size_t video : videos) names.push_back(draft.videos[video].token);
    }
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
    draft.design = draw_design(shape_of(plan), seed);
    draft.videos = list_videos(plan, draft.design, maker);
    draft.videos_of_page = find_videos_of_pages(draft);
    name_all(draft);
    draft.recipe = recipe_of_study(draft);
    return draft;
}

}  // namespace chironomia
