#include "study/study_files.h"

#include <algorithm>
#include <map>

#include "core/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/blinding.h"
#include "study/leaks.h"
#include "study/report.h"

namespace chironomia {
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
        by_clip[draft.videos[i].clip].push_back(file);
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

Json key_of_videos(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                   const fs::path& folder) {
    Json list = Json::array();
    for (std::size_t i = 0; i < draft.videos.size(); ++i) {
        const Video& video = draft.videos[i];
        Json conditions = Json::array();
        for (const std::size_t condition : video.conditions) {
            conditions.push_back(draft.plan.conditions[condition]);
        }
        list.push_back({{"token", video.token},
                        {"file", public_path(draft, i)},
                        {"clip", draft.plan.clips[video.clip].id},
                        {"conditions", std::move(conditions)},
                        {"frames", recorded[i].result.frames},
                        {"seconds", recorded[i].result.seconds},
                        {"sha256", sha256_of_file(folder / public_path(draft, i))}});
    }
    return list;
}

Json key_of_study(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                  const fs::path& folder) {
    Json pages = Json::array();
    for (std::size_t i = 0; i < draft.design.pages.size(); ++i) {
        const Comparison& page = draft.design.pages[i];
        pages.push_back({{"page", draft.names.pages[i]},
                         {"clip", draft.plan.clips[page.clip].id},
                         {"left", draft.plan.conditions[page.left]},
                         {"right", draft.plan.conditions[page.right]},
                         {"videos", draft.names.videos[i]}});
    }
    return {{"format", kKeyFormat},
            {"study", draft.names.study},
            {"seed", draft.seed},
            {"key", draft.key},
            {"conditions", draft.plan.conditions},
            {"modes", modes_by_condition(draft.plan)},
            {"secret_names", secret_names(draft.plan)},
            {"videos", key_of_videos(draft, recorded, folder)},
            {"pages", std::move(pages)}};
}

// What it takes to use a video again in a later build: its recipe, and how much of the public file is its
// own.
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

Json manifest_of_study(const StudyDraft& draft, const StudyFolder& study, const fs::path& folder) {
    Json inputs = Json::array();
    for (const InputFile& input : draft.inputs) {
        inputs.push_back({{"path", input.path}, {"sha256", input.sha256}, {"bytes", input.bytes}});
    }
    Json outputs = hashes_of_files(folder, "public/");
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

std::vector<std::string> list_files(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_directory()) names.push_back(entry.path().lexically_relative(folder).string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

void write_public_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                        const fs::path& folder) {
    write_videos(draft, recorded, folder);
    const Json pages =
        make_pages_json(draft.plan, draft.design, draft.names, seconds_of_pages(draft, recorded));
    write_json(folder / "pages.json", pages);
    write_text(folder / "index.html", make_index_page(pages));
    for (const PlayerFile& file : player_files()) write_text(folder / file.name, file.content);
    make_traces_equal(folder);
}

void write_private_files(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded,
                         const StudyFolder& study, const fs::path& folder) {
    write_json(study.key(), key_of_study(draft, recorded, folder));
    write_json(study.plan(), plan_as_used(draft.plan));
    write_json(study.recordings(), recordings_of_study(draft, recorded));
    write_text(study.report(), make_report(draft, recorded));
    write_json(study.manifest(), manifest_of_study(draft, study, folder));
}

}  // namespace chironomia
