#include "study/server/served_study.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/files/json_value.h"
#include "core/text.h"
#include "study/record/answer_values.h"

namespace chironomia::study::server {
namespace {

namespace fs = std::filesystem;

std::string text_of(const JsonValue& object, std::string_view name) {
    const auto value = object.filled(name);
    return !value || value->json() == "" ? "" : value->text();
}

void read_plan_for_server(const fs::path& file, ServedStudy& study) {
    const Json json = read_json(file);
    const JsonValue plan(json, file.string());
    if (const auto wanted = plan.filled("participants"))
        study.wanted = static_cast<std::size_t>(wanted->integer(1, 1'000'000));
    const auto completion = plan.filled("completion");
    if (!completion) return;
    study.completion = {.url = text_of(*completion, "url"),
                        .code = text_of(*completion, "code"),
                        .failed_url = text_of(*completion, "failed_url"),
                        .failed_code = text_of(*completion, "failed_code"),
                        .declined_url = text_of(*completion, "declined_url")};
}

// Null stands for any value of its video, such as the least.
std::string fault_of_expected(const Question& asked, Json value, std::size_t places) {
    if (asked.each && value.is_array()) {
        for (Json& of_video : value) {
            if (of_video.is_null()) of_video = asked.least.value_or(1);
        }
    }
    const std::string needed = fault_of_answer(asked, value, places);
    return needed.empty() ? "" : format("{}: {} is no answer; {}", asked.id, value.dump(), needed);
}

// The server judges attention checks while people take part, so it refuses at once a key that does not allow that.
void check_expected_values(const fs::path& file, const ServedStudy& study) {
    for (const KeyPage& page : study.key.pages) {
        if (page.expected.is_null()) continue;
        for (const auto& [id, value] : page.expected.items()) {
            const auto asked = std::find_if(study.pages.questions.begin(), study.pages.questions.end(),
                                            [&, &name = id](const Question& q) { return q.id == name; });
            const std::string fault = asked == study.pages.questions.end()
                                          ? format("there is no question \"{}\"", id)
                                          : fault_of_expected(*asked, value, page.places.size());
            if (!fault.empty()) {
                throw Error(format("{}: expected of page {}: {}; build the study again", file.string(),
                                   page.token, fault));
            }
        }
    }
}

// A participant would meet an empty page in the middle of a session.
void require_videos(const ServedStudy& study) {
    std::set<std::string> videos;
    for (const auto& page : study.pages.pages) videos.insert(page.videos.begin(), page.videos.end());
    std::vector<std::string> missing;
    for (const std::string& video : videos) {
        if (!fs::is_regular_file(study.folder / "public" / video)) missing.push_back(video);
    }
    if (missing.empty()) return;
    throw Error(
        format("{}: {} of {} videos are missing, the first is {}; build the study again, or copy all of it",
               (study.folder / "public").string(), missing.size(), videos.size(), missing.front()));
}

}  // namespace

ServedStudy read_served_study(const fs::path& folder) {
    if (!fs::is_regular_file(folder / "public" / "index.html")) {
        throw Error(
            format("{}: holds no study: public/index.html is missing; build it with `chironomia study build`",
                   folder.string()));
    }
    ServedStudy study{.folder = folder};
    study.data = read_json(folder / "public" / "pages.json");
    study.pages = read_study_pages(folder / "public" / "pages.json");
    study.key = read_study_key(folder / "private" / "key.json");
    require_same_study(folder / "private" / "key.json", study.key, study.pages);
    check_expected_values(folder / "private" / "key.json", study);
    require_videos(study);
    for (std::size_t sheet = 0; sheet < study.pages.sheets.size(); ++sheet) {
        study.sheets.push_back(steps_of_sheet(study.pages, sheet));
    }
    const fs::path plan = folder / "private" / "plan.json";
    if (fs::exists(plan)) read_plan_for_server(plan, study);
    return study;
}

}  // namespace chironomia::study::server
