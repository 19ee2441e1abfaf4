#include "study/build/study_files.h"

#include <algorithm>
#include <map>

#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/build/blinding.h"
#include "study/build/pages.h"
#include "study/build/report.h"
#include "study/clip/tones.h"
#include "study/plan/right_answers.h"
#include "study/plan/secret_names.h"
#include "study/record/key.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

std::string public_path(const StudyDraft& draft, std::size_t video) {
    return video_path(draft.videos[video].token, draft.plan.render.format);
}

void write_videos(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                  const fs::path& folder) {
    fs::create_directory(folder / "clips");
    std::map<std::size_t, std::vector<fs::path>> by_clip;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        const fs::path file = folder / public_path(draft, i);
        write_bytes(file, read_bytes(recorded[i].file));
        by_clip[draft.videos[i].shows.clip].push_back(file);
    }
    for (const auto& [clip, files] : by_clip) make_sizes_equal(files);
}

std::vector<double> seconds_of_pages(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded) {
    std::vector<double> seconds;
    for (const auto& videos : draft.videos_of_page)
        seconds.push_back(recorded[videos.front()].result.seconds);
    return seconds;
}

Json hashes_of_files(const fs::path& folder, const std::string& prefix) {
    Json list = Json::array();
    for (const std::string& name : list_files(folder)) {
        list.push_back({{"path", prefix + name},
                        {"sha256", sha256_of_file(folder / name)},
                        {"bytes", fs::file_size(folder / name)}});
    }
    return list;
}

std::vector<KeyVideo> key_of_videos(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                                    const fs::path& folder) {
    std::vector<KeyVideo> videos;
    for (std::size_t i = 0; i < draft.videos.size(); ++i) {
        const Video& video = draft.videos[i];
        const auto& notice = video.shows.notice;
        videos.push_back({.token = video.token,
                          .file = public_path(draft, i),
                          .clip = draft.plan.clips[video.shows.clip].id,
                          .motion = draft.plan.clips[video.motion].id,
                          .speech = draft.plan.clips[video.speech].id,
                          .conditions = video.shows.conditions,
                          .instruction = notice ? notice->text : "",
                          .is_spoken = notice && notice->spoken,
                          .frames = recorded[i].result.frames,
                          .seconds = recorded[i].result.seconds,
                          .sha256 = sha256_of_file(folder / public_path(draft, i))});
    }
    return videos;
}

std::vector<KeyPage> key_of_pages(const StudyDraft& draft) {
    std::vector<KeyPage> pages;
    for (std::size_t i = 0; i < draft.all.pages.size(); ++i) {
        const PlannedPage& planned = draft.all.pages[i];
        const auto& videos = draft.videos_of_page[i];
        KeyPage page{.token = draft.names_of_pages[i],
                     .kind = planned.kind,
                     .clip = draft.plan.clips[planned.clip].id,
                     .block = planned.block,
                     .places = {},
                     .expected = planned.expected};
        for (std::size_t place = 0; place < planned.places.size(); ++place) {
            // One video may show them all.
            const Video& video = draft.videos[videos[videos.size() == 1 ? 0 : place]];
            page.places.push_back({.condition = planned.places[place], .video = video.token});
        }
        if (page.kind == PageKind::trial)
            page.right = right_answers_on(draft.plan, planned.clip, planned.places);
        pages.push_back(std::move(page));
    }
    return pages;
}

StudyKey key_of_study(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                      const fs::path& folder) {
    const Plan& plan = draft.plan;
    StudyKey key{.study = draft.name,
                 .secret = draft.key,
                 .seed = draft.seed,
                 .preset = plan.preset,
                 .layout = plan.layout,
                 .conditions = {},
                 .reference = plan.reference,
                 .modes = modes_by_condition(plan),
                 .clips = {},
                 .shape = shape_of(plan, draft.seed),
                 .secret_names = secret_names(plan),
                 .questions = plan.questions,
                 .scales = plan.scales,
                 .exclusions = plan.exclusions,
                 .participants = plan.participants.wanted,
                 .videos = key_of_videos(draft, recorded, folder),
                 .pages = key_of_pages(draft)};
    for (const PlanCondition& condition : plan.conditions) {
        KeyCondition made{.name = condition.name, .from = {}, .made = {}};
        // A manner is no worse version of another, against which it would be held.
        if (!has_motions(condition)) made.from = condition.from;
        if (condition.making != Making::given) made.made = name_of_making(condition);
        key.conditions.push_back(std::move(made));
    }
    for (const std::size_t clip : draft.all.judged) key.clips.push_back(plan.clips[clip].id);
    key.shape.sheets = draft.all.sheets.size();
    return key;
}

// What a later build needs to use a video again: its recipe, and how many bytes of the public file are not padding.
Json recordings_of_study(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded) {
    Json list = Json::array();
    for (std::size_t i = 0; i < draft.videos.size(); ++i) {
        const ClipResult& result = recorded[i].result;
        list.push_back({{"file", public_path(draft, i)},
                        {"recipe", draft.videos[i].recipe},
                        {"sha256", recorded[i].sha256},
                        {"bytes", fs::file_size(recorded[i].file)},
                        {"frames", result.frames},
                        {"seconds", result.seconds},
                        {"warnings", result.warnings},
                        {"report", result.report}});
    }
    return list;
}

Json manifest_of_study(const StudyDraft& draft, const StudyFolder& study) {
    Json inputs = Json::array();
    for (const InputFile& input : draft.inputs) {
        inputs.push_back({{"path", input.path}, {"sha256", input.sha256}, {"bytes", input.bytes}});
    }
    Json outputs = hashes_of_files(study.open(), "public/");
    for (const fs::path& file : {study.key(), study.plan(), study.recordings(), study.report()}) {
        outputs.push_back({{"path", "private/" + file.filename().string()},
                           {"sha256", sha256_of_file(file)},
                           {"bytes", fs::file_size(file)}});
    }
    return {{"format", kManifestFormat},   {"program", format("chironomia {}", program_version())},
            {"seed", draft.seed},          {"recipe", draft.recipe},
            {"inputs", std::move(inputs)}, {"outputs", std::move(outputs)}};
}

}  // namespace

void write_public_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                        const fs::path& folder) {
    write_videos(draft, recorded, folder);
    for (std::size_t i = 0; i < draft.names_of_sounds.size(); ++i)
        write_wav(folder / sound_path(draft.names_of_sounds[i]), make_tones(i + 1));
    const Json pages = to_json(pages_of_study(draft, seconds_of_pages(draft, recorded)));
    write_json(folder / "pages.json", pages);
    write_text(folder / "index.html", make_index_page(pages));
    for (const PlayerFile& file : player_files()) write_text(folder / file.name, file.content);
    reset_times_and_permissions(folder);
}

void write_private_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                         const StudyFolder& study) {
    write_study_key(study.key(), key_of_study(draft, recorded, study.open()));
    write_json(study.plan(), plan_as_used(draft.plan));
    write_json(study.recordings(), recordings_of_study(draft, recorded));
    write_text(study.report(), make_report(draft, recorded));
    write_json(study.manifest(), manifest_of_study(draft, study));
}

}  // namespace chironomia::study
