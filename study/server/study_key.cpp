#include "study/server/study_key.h"

#include "core/text.h"
#include "study/json_value.h"

namespace chironomia {
namespace {

std::string text_or_nothing(const JsonValue& object, std::string_view name) {
    const auto value = object.find(name);
    return value && value->json().is_string() ? value->json().get<std::string>() : "";
}

KeyedStudyPage read_keyed_page(const JsonValue& value) {
    KeyedStudyPage page{.page = value.at("page").text(),
                        .kind = value.at("kind").choice({"trial", "check", "practice"}),
                        .clip = value.at("clip").text(),
                        .places = {},
                        .expected = nullptr};
    for (const JsonValue& place : value.at("places").items(1)) {
        page.places.push_back({.condition = place.at("condition").text(), .video = place.at("video").text()});
    }
    if (const auto expected = value.find("expected")) page.expected = expected->json();
    const bool right = page.expected.is_null() || page.expected.is_object();
    if (!right) value.at("expected").refuse("is " + value.at("expected").shown() + ", an object is needed");
    return page;
}

void read_exclusions(const JsonValue& value, StudyKey& key) {
    if (const auto failed = value.find("failed_checks"); failed && !failed->json().is_null()) {
        key.failed_checks = static_cast<int>(failed->integer(1, 1000));
    }
    if (const auto fastest = value.find("fastest_seconds"); fastest && fastest->json().is_number()) {
        key.fastest_seconds = fastest->json().get<double>();
    }
}

void check_that_pages_agree(const JsonValue& list, const StudyKey& key, const StudyPages& pages) {
    if (key.pages.size() != pages.pages.size()) {
        list.refuse(format("there are {} pages, but {} in pages.json; the two files are of different builds",
                           key.pages.size(), pages.pages.size()));
    }
    for (std::size_t i = 0; i < key.pages.size(); ++i) {
        const StudyPage& shown = pages.pages[i];
        if (key.pages[i].page != shown.id) {
            list.refuse(format("page {} is {}, but {} in pages.json; the two files are of different builds",
                               i, key.pages[i].page, shown.id));
        }
        if (key.pages[i].places.size() != count_places(pages, shown)) {
            list.refuse(format("page {} has {} places, but {} in pages.json", i, key.pages[i].places.size(),
                               count_places(pages, shown)));
        }
    }
}

}  // namespace

StudyKey read_study_key(const std::filesystem::path& file, const StudyPages& pages) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.at("format").choice({"chironomia key 2"});
    const std::string study = whole.at("study").text();
    if (study != pages.study) {
        whole.at("study").refuse(format("is {}, but {} in pages.json; the two files are of different studies",
                                        study, pages.study));
    }
    StudyKey key;
    key.secret = whole.at("key").text();
    for (const JsonValue& condition : whole.at("conditions").items(1)) {
        key.conditions.push_back({.name = condition.at("name").text(),
                                  .from = text_or_nothing(condition, "from"),
                                  .made = text_or_nothing(condition, "made")});
    }
    for (const JsonValue& video : whole.at("videos").items(1)) {
        const std::string clip = video.at("clip").text();
        const std::string speech = text_or_nothing(video, "speech");
        key.videos[video.at("token").text()] = {.clip = clip, .speech = speech.empty() ? clip : speech};
    }
    for (const JsonValue& page : whole.at("pages").items(1)) key.pages.push_back(read_keyed_page(page));
    check_that_pages_agree(whole.at("pages"), key, pages);
    if (const auto exclusions = whole.find("exclusions"); exclusions && !exclusions->json().is_null()) {
        read_exclusions(*exclusions, key);
    }
    return key;
}

}  // namespace chironomia
