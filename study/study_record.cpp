#include "study/study_record.h"

#include "core/error.h"
#include "core/text.h"
#include "study/study_files.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// Takes what it needs out of a JSON file; whatever is missing or of another kind is damage to that file.
template <typename Take>
void take_from(const fs::path& file, std::string_view format_name, Take take) {
    const Json json = read_json(file);
    try {
        if (!format_name.empty() && json.at("format") != format_name) {
            throw Error(format("{}: its format is {}, \"{}\" is needed; build the study again", file.string(),
                               json.at("format").dump(), format_name));
        }
        take(json);
    } catch (const Json::exception& problem) {
        throw Error(format("{}: is damaged ({}); build the study again", file.string(), problem.what()));
    }
}

void take_key(const Json& json, StudyRecord& study) {
    study.seed = json.at("seed");
    study.key = json.at("key");
    study.study_token = json.at("study");
    study.conditions = json.at("conditions").get<std::vector<std::string>>();
    study.secret_names = json.at("secret_names").get<std::vector<std::string>>();
    for (const Json& video : json.at("videos")) {
        study.videos.push_back({.token = video.at("token"),
                                .file = video.at("file"),
                                .clip = video.at("clip"),
                                .conditions = video.at("conditions").get<std::vector<std::string>>(),
                                .frames = video.at("frames"),
                                .sha256 = video.at("sha256")});
    }
    for (const Json& page : json.at("pages")) {
        study.pages.push_back({.page = page.at("page"),
                               .clip = page.at("clip"),
                               .left = page.at("left"),
                               .right = page.at("right"),
                               .videos = page.at("videos").get<std::vector<std::string>>()});
    }
}

void take_plan(const Json& json, StudyRecord& study) {
    for (const Json& clip : json.at("clips")) study.clips.push_back(clip.at("id"));
}

void take_manifest(const Json& json, StudyRecord& study) {
    study.program = json.at("program");
    for (const Json& output : json.at("outputs")) {
        study.outputs.push_back({.path = output.at("path"), .sha256 = output.at("sha256")});
    }
}

void take_pages(const Json& json, StudyRecord& study) {
    study.public_pages = json;
    for (const char* text : {"title", "instructions", "question"})
        study.public_texts.push_back(json.at(text));
    for (const Json& answer : json.at("answers")) study.public_texts.push_back(answer);
    for (const Json& page : json.at("pages")) {
        study.public_page_ids.push_back(page.at("id"));
        study.public_videos.push_back(page.at("videos").get<std::vector<std::string>>());
    }
    for (const Json& order : json.at("orders")) {
        study.orders.push_back({.pages = order.at("pages").get<std::vector<std::size_t>>(),
                                .swapped = order.at("swapped").get<bool>()});
    }
}

}  // namespace

StudyRecord read_study(const fs::path& folder) {
    const StudyFolder files{folder};
    if (!fs::is_directory(folder)) {
        throw Error(format("{}: there is no such folder; name the folder of a study", folder.string()));
    }
    if (!fs::exists(files.manifest()) || !fs::is_directory(files.open())) {
        const bool begun = fs::exists(files.work());
        throw Error(format("{}: {}", folder.string(),
                           begun ? "this study is not finished; run the same build again"
                                 : "holds no study (private/manifest.json and public/ are needed); name the "
                                   "folder that a study was built into"));
    }
    StudyRecord study;
    study.folder = folder;
    take_from(files.key(), kKeyFormat, [&](const Json& json) { take_key(json, study); });
    if (study.videos.empty() || study.pages.empty()) {
        throw Error(format("{}: has {} videos and {} pages; build the study again", files.key().string(),
                           study.videos.size(), study.pages.size()));
    }
    take_from(files.plan(), "", [&](const Json& json) { take_plan(json, study); });
    take_from(files.manifest(), kManifestFormat, [&](const Json& json) { take_manifest(json, study); });
    take_from(files.open() / "pages.json", kPagesFormat, [&](const Json& json) { take_pages(json, study); });
    return study;
}

}  // namespace chironomia
