#include "study/record/key.h"

#include <algorithm>
#include <cassert>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/hash.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

constexpr long long kMost = 1'000'000'000;

std::size_t read_count(const JsonValue& value, long long least = 0) {
    return static_cast<std::size_t>(value.integer(least, kMost));
}

void read_conditions(const JsonValue& list, StudyKey& key) {
    const std::vector<JsonValue> items = list.items(1);
    for (const JsonValue& item : items) key.conditions.push_back({.name = item.at("name").text()});
    const std::vector<std::string> names = condition_names(key);
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (const auto from = items[i].filled("from")) key.conditions[i].from = index_of_choice(*from, names);
        if (const auto made = items[i].filled("made")) key.conditions[i].made = made->text();
    }
}

ExclusionRules read_exclusions(const JsonValue& value) {
    ExclusionRules rules{.failed_checks = read_count(value.at("failed_checks"), 1),
                         .lenient_failed_checks = read_count(value.at("lenient_failed_checks"), 1)};
    if (const auto fastest = value.filled("fastest_seconds")) {
        if (!fastest->json().is_number())
            fastest->refuse(format("is {}, a number of seconds is needed", fastest->shown()));
        rules.fastest_seconds = fastest->json().get<double>();
    }
    return rules;
}

std::vector<std::size_t> read_names(const JsonValue& list, const std::vector<std::string>& names) {
    std::vector<std::size_t> found;
    for (const JsonValue& item : list.items(1)) found.push_back(index_of_choice(item, names));
    return found;
}

SideRule read_side_rule(const JsonValue& value) {
    std::vector<std::string> names;
    const std::vector<SideRule> all = {SideRule::fixed, SideRule::per_page, SideRule::mirror,
                                       SideRule::rotate};
    for (const SideRule sides : all) names.push_back(to_text(sides));
    return all[index_of_choice(value, names)];
}

// What the design was drawn from.
void read_design(const JsonValue& value, StudyKey& key) {
    key.clips = value.at("clips").texts(1);
    DesignShape& shape = key.shape;
    shape.clips = key.clips.size();
    for (const JsonValue& group : value.at("groups").items(1))
        shape.groups.push_back(read_names(group, condition_names(key)));
    shape.sides = read_side_rule(value.at("moving"));
    for (const JsonValue& block : value.at("block_of_clip").items(0))
        shape.block_of_clip.push_back(read_count(block));
    shape.each_clip_once = value.at("each_clip_once").flag();
    if (const auto pages = value.filled("pages_per_sheet")) shape.pages_per_sheet = read_count(*pages, 1);
    shape.sheets = read_count(value.at("sheets"), 1);
}

KeyVideo read_video(const JsonValue& value, const std::vector<std::string>& conditions) {
    const auto instruction = value.filled("instruction"), motion = value.find("motion");
    return {.token = value.at("token").text(),
            .file = value.at("file").text(),
            .clip = value.at("clip").text(),
            .motion = (motion ? *motion : value.at("clip")).text(),
            .speech = value.at("speech").text(),
            .conditions = read_names(value.at("conditions"), conditions),
            .instruction = instruction ? instruction->at("text").text() : "",
            .is_spoken = instruction && instruction->at("spoken").flag(),
            .frames = read_count(value.at("frames")),
            .seconds = value.at("seconds").number(0, kMost),
            .sha256 = value.at("sha256").text()};
}

KeyPage read_key_page(const JsonValue& value, const std::vector<std::string>& conditions) {
    KeyPage page{.token = value.at("page").text(),
                 .kind = page_kind_named(value.at("kind")),
                 .clip = value.at("clip").text(),
                 .block = read_count(value.at("block")),
                 .places = {},
                 .expected = {}};
    for (const JsonValue& place : value.at("places").items(1)) {
        page.places.push_back({.condition = index_of_choice(place.at("condition"), conditions),
                               .video = place.at("video").text()});
    }
    if (const auto right = value.filled("right")) {
        for (const auto& [question, answer] : right->json().items())
            page.right[question] = right->at(question).text();
    }
    const auto expected = value.filled("expected");
    if (expected && !expected->json().is_object())
        expected->refuse("is " + expected->shown() + ", an object is needed");
    if (expected) page.expected = expected->json();
    if (page.kind == PageKind::check && !expected)
        value.at("expected").refuse("is null, but the page is a check; say which answer it expects");
    return page;
}

std::uint64_t read_seed(const JsonValue& value) {
    if (!value.json().is_number_unsigned())
        value.refuse(format("is {}, a whole number is needed", value.shown()));
    return value.json().get<std::uint64_t>();
}

void read_videos_and_pages(const JsonValue& whole, StudyKey& key) {
    const std::vector<std::string> conditions = condition_names(key);
    std::vector<std::string> tokens;
    for (const JsonValue& video : whole.at("videos").items(1)) {
        key.videos.push_back(read_video(video, conditions));
        tokens.push_back(key.videos.back().token);
    }
    for (const JsonValue& value : whole.at("pages").items(1)) {
        key.pages.push_back(read_key_page(value, conditions));
        for (const JsonValue& place : value.at("places").items(1)) place.at("video").choice(tokens);
        if (key.pages.back().kind != PageKind::practice) value.at("clip").choice(key.clips);
    }
}

template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json names_in(const StudyKey& key, const std::vector<std::size_t>& conditions) {
    Json names = Json::array();
    for (const std::size_t condition : conditions) names.push_back(key.conditions[condition].name);
    return names;
}

Json to_json(const StudyKey& key, const KeyCondition& condition) {
    Json json = {{"name", condition.name}};
    if (condition.from) json["from"] = key.conditions[*condition.from].name;
    if (!condition.made.empty()) json["made"] = condition.made;
    return json;
}

Json to_json(const ExclusionRules& rules) {
    return {{"failed_checks", rules.failed_checks},
            {"lenient_failed_checks", rules.lenient_failed_checks},
            {"fastest_seconds", or_null(rules.fastest_seconds)}};
}

Json design_of(const StudyKey& key) {
    const DesignShape& shape = key.shape;
    Json groups = Json::array();
    for (const auto& group : shape.groups) groups.push_back(names_in(key, group));
    return {{"clips", key.clips},
            {"groups", std::move(groups)},
            {"moving", to_text(shape.sides)},
            {"block_of_clip", shape.block_of_clip},
            {"each_clip_once", shape.each_clip_once},
            {"pages_per_sheet", or_null(shape.pages_per_sheet)},
            {"sheets", or_null(shape.sheets)}};
}

Json to_json(const StudyKey& key, const KeyVideo& video) {
    Json json = {
        {"token", video.token},   {"file", video.file},       {"clip", video.clip},
        {"motion", video.motion}, {"speech", video.speech},   {"conditions", names_in(key, video.conditions)},
        {"frames", video.frames}, {"seconds", video.seconds}, {"sha256", video.sha256}};
    if (!video.instruction.empty())
        json["instruction"] = {{"text", video.instruction}, {"spoken", video.is_spoken}};
    return json;
}

Json to_json(const StudyKey& key, const KeyPage& page) {
    Json places = Json::array();
    for (const KeyPlace& place : page.places)
        places.push_back({{"condition", condition_at(key, place)}, {"video", place.video}});
    Json json = {{"page", page.token},  {"kind", to_text(page.kind)},  {"clip", page.clip},
                 {"block", page.block}, {"places", std::move(places)}, {"expected", page.expected}};
    for (const auto& [question, answer] : page.right) json["right"][question] = answer;
    return json;
}

}  // namespace

void write_study_key(const std::filesystem::path& file, const StudyKey& key) {
    Json conditions = Json::array(), videos = Json::array(), pages = Json::array();
    for (const KeyCondition& condition : key.conditions) conditions.push_back(to_json(key, condition));
    for (const KeyVideo& video : key.videos) videos.push_back(to_json(key, video));
    for (const KeyPage& page : key.pages) pages.push_back(to_json(key, page));
    Json json = {{"format", kKeyFormat},
                 {"study", key.study},
                 {"seed", key.seed},
                 {"key", key.secret},
                 {"layout", to_text(key.layout)},
                 {"conditions", std::move(conditions)},
                 {"reference", key.reference ? Json(key.conditions[*key.reference].name) : Json()},
                 {"modes", key.modes},
                 {"secret_names", key.secret_names},
                 {"questions", to_json(key.questions)},
                 {"exclusions", to_json(key.exclusions)}};
    if (!key.scales.empty()) json["scales"] = to_json(key.scales, key.questions);
    if (!key.preset.empty()) json["preset"] = key.preset;
    json["design"] = design_of(key);
    if (key.participants) json["participants"] = *key.participants;
    json["videos"] = std::move(videos);
    json["pages"] = std::move(pages);
    write_json(file, json);
}

StudyKey read_study_key(const std::filesystem::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    const JsonValue written = whole.at("format");
    if (written.text() != kKeyFormat) {
        written.refuse(format("is {}, \"{}\" is needed; build the study again with this version",
                              written.shown(), kKeyFormat));
    }
    StudyKey key{.study = whole.at("study").text(),
                 .secret = whole.at("key").text(),
                 .seed = read_seed(whole.at("seed")),
                 .layout = layout_named(whole.at("layout"))};
    if (const auto preset = whole.filled("preset")) key.preset = preset->text();
    read_conditions(whole.at("conditions"), key);
    if (const auto reference = whole.filled("reference"))
        key.reference = index_of_choice(*reference, condition_names(key));
    key.modes = whole.at("modes").json();
    if (const auto wanted = whole.find("participants")) key.participants = read_count(*wanted, 1);
    read_design(whole.at("design"), key);
    key.secret_names = whole.at("secret_names").texts(0);
    key.questions = read_questions(whole.at("questions"), 1);
    if (const auto scales = whole.find("scales")) key.scales = read_scales(*scales, key.questions);
    key.exclusions = read_exclusions(whole.at("exclusions"));
    read_videos_and_pages(whole, key);
    return key;
}

void require_same_study(const std::filesystem::path& file, const StudyKey& key, const StudyPages& pages) {
    const auto refuse = [&](const std::string& what) {
        throw Error(format("{}: {}; the two files are of different builds", file.string(), what));
    };
    if (key.study != pages.study)
        refuse(format("the study is \"{}\", but \"{}\" in pages.json", key.study, pages.study));
    const bool asks_the_same =
        std::equal(key.questions.begin(), key.questions.end(), pages.questions.begin(), pages.questions.end(),
                   [](const Question& a, const Question& b) { return a.id == b.id; });
    if (!asks_the_same) refuse("its questions are not those of pages.json");
    if (key.pages.size() != pages.pages.size())
        refuse(format("there are {} pages, but {} in pages.json", key.pages.size(), pages.pages.size()));
    for (std::size_t i = 0; i < key.pages.size(); ++i) {
        const StudyPage& shown = pages.pages[i];
        if (key.pages[i].token != shown.id)
            refuse(format("page {} is {}, but {} in pages.json", i, key.pages[i].token, shown.id));
        if (key.pages[i].places.size() != count_places(pages, shown)) {
            refuse(format("page {} has {} places, but {} in pages.json", i, key.pages[i].places.size(),
                          count_places(pages, shown)));
        }
    }
}

std::vector<std::string> condition_names(const StudyKey& key) {
    std::vector<std::string> names;
    for (const KeyCondition& condition : key.conditions) names.push_back(condition.name);
    return names;
}

std::string names_of(const std::vector<KeyCondition>& all, const std::vector<std::size_t>& conditions,
                     std::string_view between) {
    std::vector<std::string> names;
    for (const std::size_t condition : conditions) names.push_back(all[condition].name);
    return join(names, between);
}

const std::string& condition_at(const StudyKey& key, const KeyPlace& place) {
    return key.conditions[place.condition].name;
}

std::string condition_token(const StudyKey& key, const std::string& condition) {
    return "S" + keyed_sha256(key.secret, "condition " + condition).substr(0, 8);
}

std::string clip_token(const StudyKey& key, const std::string& clip) {
    return "c" + keyed_sha256(key.secret, "clip " + clip).substr(0, 12);
}

const KeyVideo& video_named(const StudyKey& key, std::string_view token) {
    const auto found = std::find_if(key.videos.begin(), key.videos.end(),
                                    [&](const KeyVideo& video) { return video.token == token; });
    assert(found != key.videos.end());
    return *found;
}

}  // namespace chironomia::study
