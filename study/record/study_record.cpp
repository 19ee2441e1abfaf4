#include "study/record/study_record.h"

#include <algorithm>

#include "core/error.h"
#include "core/files/json_fault.h"
#include "core/text.h"
#include "study/record/key.h"
#include "study/record/pages.h"
#include "study/record/study_folder.h"

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
        throw Error(format("{}: is damaged ({}); build the study again", file.string(), fault_of(problem)));
    }
}

Moving moving_named(const std::string& name) {
    for (const Moving moving : {Moving::fixed, Moving::none, Moving::mirror, Moving::rotate}) {
        if (name == to_text(moving)) return moving;
    }
    throw Error(format(
        "the key's design moves conditions by \"{}\", which there is not; build the study again", name));
}

std::size_t index_of(const std::string& name, const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void take_design(const Json& json, StudyRecord& study) {
    study.clips = json.at("clips").get<std::vector<std::string>>();
    DesignShape& shape = study.shape;
    shape.clips = study.clips.size();
    for (const Json& group : json.at("groups")) {
        auto& numbers = shape.groups.emplace_back();
        for (const Json& name : group) numbers.push_back(index_of(name, study.conditions));
    }
    shape.moving = moving_named(json.at("moving"));
    shape.block_of_clip = json.at("block_of_clip").get<std::vector<std::size_t>>();
    shape.each_clip_once = json.at("each_clip_once");
    if (!json.at("pages_per_sheet").is_null())
        shape.pages_per_sheet = json.at("pages_per_sheet").get<std::size_t>();
    shape.sheets = json.at("sheets").get<std::size_t>();
}

void take_key(const Json& json, StudyRecord& study) {
    study.seed = json.at("seed");
    study.key = json.at("key");
    study.study_token = json.at("study");
    study.layout = json.at("layout");
    for (const Json& condition : json.at("conditions")) study.conditions.push_back(condition.at("name"));
    take_design(json.at("design"), study);
    study.secret_names = json.at("secret_names").get<std::vector<std::string>>();
    for (const Json& video : json.at("videos")) {
        study.videos.push_back({.token = video.at("token"),
                                .file = video.at("file"),
                                .clip = video.at("clip"),
                                .speech = video.at("speech"),
                                .conditions = video.at("conditions").get<std::vector<std::string>>(),
                                .tells = video.contains("instruction"),
                                .frames = video.at("frames"),
                                .sha256 = video.at("sha256")});
        if (study.videos.back().tells) study.videos.back().instruction = video.at("instruction").at("text");
    }
    for (const Json& page : json.at("pages")) {
        KeyedPage keyed{.page = page.at("page"),
                        .kind = page.at("kind"),
                        .clip = page.at("clip"),
                        .block = page.at("block"),
                        .places = {},
                        .expected = page.at("expected")};
        for (const Json& place : page.at("places"))
            keyed.places.push_back({.condition = place.at("condition"), .video = place.at("video")});
        study.pages.push_back(std::move(keyed));
    }
}

void take_manifest(const Json& json, StudyRecord& study) {
    study.program = json.at("program");
    for (const Json& output : json.at("outputs")) {
        study.outputs.push_back({.path = output.at("path"), .sha256 = output.at("sha256")});
    }
}

// Every text below a value, but for tokens and paths, which have properties of their own.
void add_texts(const Json& json, std::vector<std::string>& texts) {
    if (json.is_string()) texts.push_back(json);
    if (!json.is_structured()) return;
    for (const Json& value : json) add_texts(value, texts);
}

void take_sheets(const Json& json, StudyRecord& study) {
    for (const Json& sheet : json.at("sheets")) {
        Sheet& taken = study.sheets.emplace_back();
        for (const Json& shown : sheet.at("pages")) {
            taken.pages.push_back({.page = shown.at(0).get<std::size_t>(),
                                   .order = shown.at(1).get<std::vector<std::size_t>>()});
        }
    }
}

void take_pages(const Json& json, StudyRecord& study) {
    study.public_pages = json;
    for (const char* key : {"title", "texts", "instructions", "consent", "training", "questions",
                            "questionnaire", "completion"}) {
        add_texts(json.at(key), study.public_texts);
    }
    for (const Json& page : json.at("pages")) {
        study.public_page_ids.push_back(page.at("id"));
        study.public_videos.push_back(page.at("videos").get<std::vector<std::string>>());
        study.public_texts.push_back(page.at("caption"));
    }
    if (!json.at("sound_check").is_null())
        study.public_sounds = json.at("sound_check").at("files").get<std::vector<std::string>>();
    take_sheets(json, study);
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
    take_from(files.manifest(), kManifestFormat, [&](const Json& json) { take_manifest(json, study); });
    take_from(files.plan(), "", [&](const Json& json) { study.plan = json; });
    take_from(files.open() / "pages.json", kPagesFormat, [&](const Json& json) { take_pages(json, study); });
    return study;
}

}  // namespace chironomia
