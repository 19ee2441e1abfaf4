#include "study/record/study_record.h"

#include <utility>

#include "core/error.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "study/record/study_folder.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// Every text below a value, but for tokens and paths, which have properties of their own.
void add_texts(const Json& json, std::vector<std::string>& texts) {
    if (json.is_string()) texts.push_back(json);
    if (!json.is_structured()) return;
    for (const Json& value : json) add_texts(value, texts);
}

std::vector<std::string> texts_of_pages(const Json& json) {
    std::vector<std::string> texts;
    for (const char* key : {"title", "texts", "instructions", "consent", "training", "questions",
                            "questionnaire", "completion"}) {
        add_texts(json.value(key, Json()), texts);
    }
    for (const Json& page : json.at("pages")) add_texts(page.value("caption", Json()), texts);
    return texts;
}

}  // namespace

Manifest read_manifest(const fs::path& file) {
    const Json json = read_json(file);
    const JsonValue value(json, file.string());
    const auto text = [&](const char* key) {
        const auto found = value.find(key);
        return found ? found->text() : "";
    };
    Manifest manifest{.format = text("format"), .program = text("program"), .recipe = text("recipe")};
    for (const JsonValue& output : value.at("outputs").items(1))
        manifest.outputs.push_back({.path = output.at("path").text(), .sha256 = output.at("sha256").text()});
    return manifest;
}

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
    study.key = read_study_key(files.key());
    study.pages = read_study_pages(files.open() / "pages.json");
    Manifest manifest = read_manifest(files.manifest());
    if (manifest.format != kManifestFormat) {
        throw Error(format("{}: format: is \"{}\", \"{}\" is needed; build the study again",
                           files.manifest().string(), manifest.format, kManifestFormat));
    }
    study.program = std::move(manifest.program);
    study.outputs = std::move(manifest.outputs);
    study.plan = read_json(files.plan());
    study.public_pages = read_json(files.open() / "pages.json");
    study.public_texts = texts_of_pages(study.public_pages);
    return study;
}

}  // namespace chironomia::study
