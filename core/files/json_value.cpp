#include "core/files/json_value.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

bool is_plain(std::string_view name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

std::string key_below(const std::string& parent, std::string_view name) {
    if (!is_plain(name)) return format("{}[\"{}\"]", parent, name);
    return parent.empty() ? std::string(name) : format("{}.{}", parent, name);
}

std::string quoted(const std::vector<std::string>& names) {
    std::vector<std::string> each;
    for (const std::string& name : names) each.push_back(format("\"{}\"", name));
    return join(each);
}

// `; did you mean "x"?` or what is allowed, when nothing is near.
std::string advice(const std::string& typo, const std::vector<std::string>& names) {
    if (const auto near = nearest_name(typo, names)) return format("did you mean \"{}\"?", *near);
    return "write one of " + quoted(names);
}

}  // namespace

void JsonValue::refuse(std::string_view what) const {
    if (key_.empty()) throw Error(format("{}: {}", file_, what));
    throw Error(format("{}: {}: {}", file_, key_, what));
}

std::optional<JsonValue> JsonValue::find(std::string_view name) const {
    if (!json_->is_object()) refuse(format("is {}, an object in curly brackets is needed", shown()));
    const auto found = json_->find(name);
    if (found == json_->end()) return std::nullopt;
    return JsonValue(*found, file_, key_below(key_, name));
}

std::optional<JsonValue> JsonValue::filled(std::string_view name) const {
    auto found = find(name);
    if (found && found->json().is_null()) return std::nullopt;
    return found;
}

JsonValue JsonValue::at(std::string_view name) const {
    if (auto found = find(name)) return *found;
    JsonValue(*json_, file_, key_below(key_, name)).refuse("is missing; add it");
}

void JsonValue::allow_only(const std::vector<std::string>& names) const {
    if (!json_->is_object()) refuse(format("is {}, an object in curly brackets is needed", shown()));
    for (const auto& [name, value] : json_->items()) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        JsonValue(value, file_, key_below(key_, name)).refuse("there is no such key; " + advice(name, names));
    }
}

std::vector<JsonValue> JsonValue::items(std::size_t at_least) const {
    if (!json_->is_array()) refuse(format("is {}, a list in square brackets is needed", shown()));
    if (json_->size() < at_least) {
        refuse(format("has {} entries, at least {} are needed", json_->size(), at_least));
    }
    std::vector<JsonValue> all;
    for (std::size_t i = 0; i < json_->size(); ++i) {
        all.push_back(JsonValue((*json_)[i], file_, format("{}[{}]", key_, i)));
    }
    return all;
}

bool JsonValue::flag() const {
    if (!json_->is_boolean()) refuse(format("is {}, true or false is needed", shown()));
    return json_->get<bool>();
}

std::string JsonValue::text() const {
    if (!json_->is_string()) refuse(format("is {}, a text in quotes is needed", shown()));
    const auto& text = json_->get_ref<const std::string&>();
    if (trim(text).empty()) refuse("is an empty text; fill it in or leave the key out");
    if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; })) {
        refuse(format("is {}, which has control characters; remove them", shown()));
    }
    return text;
}

std::vector<std::string> JsonValue::texts(std::size_t at_least) const {
    std::vector<std::string> texts;
    for (const JsonValue& item : items(at_least)) texts.push_back(item.text());
    return texts;
}

double JsonValue::number(double least, double most) const {
    const double number = json_->is_number() ? json_->get<double>() : 0;
    if (!json_->is_number() || !(number >= least && number <= most))
        refuse(format("is {}, a number from {} to {} is needed", shown(), least, most));
    return number;
}

long long JsonValue::integer(long long least, long long most) const {
    constexpr auto kLargest = static_cast<unsigned long long>(std::numeric_limits<long long>::max());
    const bool fits = json_->is_number_integer() &&
                      !(json_->is_number_unsigned() && json_->get<unsigned long long>() > kLargest);
    if (!fits || json_->get<long long>() < least || json_->get<long long>() > most) {
        refuse(format("is {}, a whole number from {} to {} is needed", shown(), least, most));
    }
    return json_->get<long long>();
}

std::string JsonValue::choice(const std::vector<std::string>& names) const {
    const std::string chosen = text();
    if (std::find(names.begin(), names.end(), chosen) != names.end()) return chosen;
    std::string allowed = format("is {}, which is none of {}", shown(), quoted(names));
    if (const auto near = nearest_name(chosen, names)) allowed += format("; did you mean \"{}\"?", *near);
    refuse(allowed);
}

std::string JsonValue::shown() const {
    constexpr std::size_t kLongest = 60;
    const std::string whole = json_->dump(-1, ' ', false, Json::error_handler_t::replace);
    return whole.size() <= kLongest ? whole : format("{}...", std::string_view(whole).substr(0, kLongest));
}

}  // namespace chironomia
