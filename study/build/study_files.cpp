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

Json names_of(const Plan& plan, const std::vector<std::size_t>& conditions) {
    Json names = Json::array();
    for (const std::size_t condition : conditions) names.push_back(plan.conditions[condition].name);
    return names;
}

Json key_of_videos(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                   const fs::path& folder) {
    Json list = Json::array();
    for (std::size_t i = 0; i < draft.videos.size(); ++i) {
        const Video& video = draft.videos[i];
        Json json = {{"token", video.token},
                     {"file", public_path(draft, i)},
                     {"clip", draft.plan.clips[video.shows.clip].id},
                     {"speech", draft.plan.clips[video.speech].id},
                     {"conditions", names_of(draft.plan, video.shows.conditions)},
                     {"frames", recorded[i].result.frames},
                     {"seconds", recorded[i].result.seconds},
                     {"sha256", sha256_of_file(folder / public_path(draft, i))}};
        if (video.shows.notice)
            json["instruction"] = {{"text", video.shows.notice->text},
                                   {"spoken", video.shows.notice->spoken}};
        list.push_back(std::move(json));
    }
    return list;
}

Json key_of_pages(const StudyDraft& draft) {
    Json pages = Json::array();
    for (std::size_t i = 0; i < draft.all.pages.size(); ++i) {
        const PlannedPage& page = draft.all.pages[i];
        const auto& videos = draft.videos_of_page[i];
        Json places = Json::array();
        for (std::size_t place = 0; place < page.places.size(); ++place) {
            // One video may show them all.
            const Video& video = draft.videos[videos[videos.size() == 1 ? 0 : place]];
            places.push_back(
                {{"condition", draft.plan.conditions[page.places[place]].name}, {"video", video.token}});
        }
        Json json = {{"page", draft.names_of_pages[i]},
                     {"kind", to_text(page.kind)},
                     {"clip", draft.plan.clips[page.clip].id},
                     {"block", page.block},
                     {"places", std::move(places)},
                     {"expected", page.expected}};
        Json right = right_answers_on(draft.plan, page.clip, page.places);
        if (page.kind == PageKind::trial && !right.empty()) json["right"] = std::move(right);
        pages.push_back(std::move(json));
    }
    return pages;
}

Json key_of_conditions(const Plan& plan) {
    Json list = Json::array();
    for (const PlanCondition& condition : plan.conditions) {
        Json json = {{"name", condition.name}};
        // A manner is no worse version of another, against which it would be held.
        if (!has_motions(condition)) json["from"] = plan.conditions[condition.from].name;
        if (condition.making != Making::given) json["made"] = name_of_making(condition);
        list.push_back(std::move(json));
    }
    return list;
}

Json key_of_exclusions(const ExclusionRules& rules) {
    return {{"failed_checks", rules.failed_checks},
            {"lenient_failed_checks", rules.lenient_failed_checks},
            {"fastest_seconds", rules.fastest_seconds ? Json(*rules.fastest_seconds) : Json()}};
}

// All that the design was drawn from, so that anybody can draw it again.
Json key_of_design(const StudyDraft& draft) {
    const DesignShape shape = shape_of(draft.plan, draft.seed);
    Json clips = Json::array(), groups = Json::array();
    for (const std::size_t clip : draft.all.judged) clips.push_back(draft.plan.clips[clip].id);
    for (const auto& group : shape.groups) groups.push_back(names_of(draft.plan, group));
    return {{"clips", std::move(clips)},
            {"groups", std::move(groups)},
            {"moving", to_text(shape.sides)},
            {"block_of_clip", shape.block_of_clip},
            {"each_clip_once", shape.each_clip_once},
            {"pages_per_sheet", shape.pages_per_sheet ? Json(*shape.pages_per_sheet) : Json()},
            {"sheets", draft.all.sheets.size()}};
}

Json key_of_study(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                  const fs::path& folder) {
    const Plan& plan = draft.plan;
    Json questions = Json::array();
    for (const Question& question : plan.questions) questions.push_back(to_json(question));
    Json json = {{"format", kKeyFormat},
                 {"study", draft.name},
                 {"seed", draft.seed},
                 {"key", draft.key},
                 {"layout", to_text(plan.layout)},
                 {"conditions", key_of_conditions(plan)},
                 {"reference", plan.reference ? Json(plan.conditions[*plan.reference].name) : Json()},
                 {"modes", modes_by_condition(plan)},
                 {"secret_names", secret_names(plan)},
                 {"questions", std::move(questions)},
                 {"exclusions", key_of_exclusions(plan.exclusions)}};
    if (!plan.preset.empty()) json["preset"] = plan.preset;
    json["design"] = key_of_design(draft);
    if (plan.participants.wanted) json["participants"] = *plan.participants.wanted;
    json["videos"] = key_of_videos(draft, recorded, folder);
    json["pages"] = key_of_pages(draft);
    return json;
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
    const Json pages = make_pages_json(draft, seconds_of_pages(draft, recorded));
    write_json(folder / "pages.json", pages);
    write_text(folder / "index.html", make_index_page(pages));
    for (const PlayerFile& file : player_files()) write_text(folder / file.name, file.content);
    reset_times_and_permissions(folder);
}

void write_private_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                         const StudyFolder& study) {
    write_json(study.key(), key_of_study(draft, recorded, study.open()));
    write_json(study.plan(), plan_as_used(draft.plan));
    write_json(study.recordings(), recordings_of_study(draft, recorded));
    write_text(study.report(), make_report(draft, recorded));
    write_json(study.manifest(), manifest_of_study(draft, study));
}

}  // namespace chironomia::study
