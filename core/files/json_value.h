// A value in a JSON file that knows its file and key, so that every refusal names them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/files/json.h"

namespace chironomia {

class JsonValue {
  public:
    // The whole of a file. `json` must outlive this value and all that come from it.
    JsonValue(const Json& json, std::string file) : json_(&json), file_(std::move(file)) {}

    // The same value under another key in messages: `gesture "nod"` says more than `gestures[12]`.
    JsonValue called(std::string key) const { return JsonValue(*json_, file_, std::move(key)); }

    const std::string& key() const { return key_; }  // "clips[1].motion.baseline"; "" for the whole
    const Json& json() const { return *json_; }

    // Throws Error `file: key: what`.
    [[noreturn]] void refuse(std::string_view what) const;

    // Throw Error if this is no object; `at` also if it has no such key.
    JsonValue at(std::string_view name) const;
    std::optional<JsonValue> find(std::string_view name) const;
    // The same, and nothing where null stands.
    std::optional<JsonValue> filled(std::string_view name) const;
    // Throws Error if this is no object or has a key that is not among `names`, with the nearest of them.
    void allow_only(const std::vector<std::string>& names) const;

    // Throws Error if this is no list or has fewer than `at_least` entries.
    std::vector<JsonValue> items(std::size_t at_least) const;

    // Throw Error if this is of another kind, outside the range [least, most], or not among `names`.
    bool flag() const;
    std::string text() const;  // not empty, no control characters
    std::vector<std::string> texts(std::size_t at_least) const;
    double number(double least, double most) const;
    long long integer(long long least, long long most) const;
    std::string choice(const std::vector<std::string>& names) const;

    // The value as it stands in the file, cut when it is long.
    std::string shown() const;

  private:
    JsonValue(const Json& json, std::string file, std::string key)
        : json_(&json), file_(std::move(file)), key_(std::move(key)) {}

    const Json* json_;
    std::string file_;
    std::string key_;
};

}  // namespace chironomia
