#include "study/analysis/answer_key.h"

#include <algorithm>

#include "core/text.h"
#include "study/json_value.h"

namespace chironomia {
namespace {

constexpr std::string_view kFormat = "chironomia key 2";
constexpr long long kMost = 1000000;

// A text, or "" where the key has null or nothing.
std::optional<JsonValue> filled(const JsonValue& value, std::string_view name) {
    auto found = value.find(name);
    if (found && found->json().is_null()) return std::nullopt;
    return found;
}

std::size_t read_count(const JsonValue& value, long long least = 0) {
    return static_cast<std::size_t>(value.integer(least, kMost));
}

std::size_t read_condition(const JsonValue& value, const std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), value.choice(names));
    return static_cast<std::size_t>(found - names.begin());
}

std::vector<std::string> names_of_conditions(const JsonValue& list) {
    std::vector<std::string> names;
    for (const JsonValue& item : list.items(1)) names.push_back(item.at("name").text());
    return names;
}

KeyCondition read_key_condition(const JsonValue& value, const std::vector<std::string>& names) {
    KeyCondition condition{.name = value.at("name").text()};
    if (const auto from = filled(value, "from")) condition.from = read_condition(*from, names);
    if (const auto made = filled(value, "made")) condition.made = made->text();
    return condition;
}

ExclusionRules read_exclusions(const JsonValue& value) {
    ExclusionRules rules{.failed_checks = read_count(value.at("failed_checks"), 1),
                         .lenient_failed_checks = read_count(value.at("lenient_failed_checks"), 1)};
    if (const auto fastest = filled(value, "fastest_seconds")) {
        if (!fastest->json().is_number())
            fastest->refuse(format("is {}, a number of seconds is needed", fastest->shown()));
        rules.fastest_seconds = fastest->json().get<double>();
    }
    return rules;
}

KeyPage read_key_page(const JsonValue& value, const std::vector<std::string>& names) {
    KeyPage page{.token = value.at("page").text(),
                 .kind = value.at("kind").choice({"trial", "check", "practice"}),
                 .clip = value.at("clip").text(),
                 .block = read_count(value.at("block"))};
    for (const JsonValue& place : value.at("places").items(1)) {
        page.places.push_back(
            {.condition = read_condition(place.at("condition"), names), .video = place.at("video").text()});
    }
    if (const auto expected = filled(value, "expected")) page.expected = expected->json();
    if (page.kind == "check" && page.expected.is_null())
        value.at("expected").refuse("is null, but the page is a check; say which answer it expects");
    return page;
}

}  // namespace

AnswerKey read_answer_key(const std::filesystem::path& file) {
    const Json json = read_json(file);
    const JsonValue value(json, file.string());
    const JsonValue written = value.at("format");
    if (written.text() != kFormat) {
        written.refuse(format("is {}, \"{}\" is needed; build the study again with this version",
                              written.shown(), kFormat));
    }
    AnswerKey key{.study = value.at("study").text(), .layout = value.at("layout").text()};
    const JsonValue seed = value.at("seed");
    if (!seed.json().is_number_integer())
        seed.refuse(format("is {}, a whole number is needed", seed.shown()));
    key.seed = seed.json().get<std::uint64_t>();
    const std::vector<std::string> names = names_of_conditions(value.at("conditions"));
    for (const JsonValue& item : value.at("conditions").items(1))
        key.conditions.push_back(read_key_condition(item, names));
    if (const auto reference = filled(value, "reference")) key.reference = read_condition(*reference, names);
    for (const JsonValue& item : value.at("questions").items(1)) key.questions.push_back(read_question(item));
    key.exclusions = read_exclusions(value.at("exclusions"));
    for (const JsonValue& item : value.at("pages").items(1)) key.pages.push_back(read_key_page(item, names));
    return key;
}

}  // namespace chironomia
