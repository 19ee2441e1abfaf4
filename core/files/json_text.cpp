#include "core/files/json_text.h"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "core/error.h"
#include "core/files/json_depth.h"
#include "core/text.h"

namespace chironomia {
namespace {

// While a file is parsed: the keys of the objects around the place, each with all keys that its object had so far.
class KeysOnce {
  public:
    explicit KeysOnce(const std::filesystem::path& file) : file_(file) {}

    bool operator()(int /*depth*/, Json::parse_event_t event, const Json& parsed) {
        if (event == Json::parse_event_t::object_start) objects_.emplace_back();
        if (event == Json::parse_event_t::object_end) objects_.pop_back();
        if (event == Json::parse_event_t::key) enter(parsed.get<std::string>());
        return true;
    }

  private:
    struct Object {
        std::string key;  // the last one
        std::unordered_set<std::string> keys;
    };

    void enter(const std::string& key) {
        objects_.back().key = key;
        if (objects_.back().keys.insert(key).second) return;
        std::vector<std::string> path;
        for (const Object& object : objects_) path.push_back(object.key);
        throw Error(format("{}: {} stands there twice; one of them would be lost, delete it or rename it",
                           file_.string(), join(path, ".")));
    }

    const std::filesystem::path& file_;
    std::vector<Object> objects_;
};

// Python writes NaN where JSON has null. Empty: there is none outside of texts.
std::string with_null_for_nan(std::string_view text) {
    constexpr std::string_view kNan = "NaN";
    std::string with_null;
    bool in_text = false, found = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool is_nan = !in_text && text.substr(i).starts_with(kNan);
        if (text[i] == '"') in_text = !in_text;
        with_null += is_nan ? "null" : text.substr(i, in_text && text[i] == '\\' ? 2 : 1);
        if (is_nan)
            i += kNan.size() - 1;
        else if (in_text && text[i] == '\\')
            ++i;
        found = found || is_nan;
    }
    return found ? with_null : "";
}

}  // namespace

Json parse_json(const std::string& text, const std::filesystem::path& file) {
    if (const int depth = json_depth(text); depth > kDeepestJson) {
        throw Error(format("{}: its brackets nest {} deep, at most {} are read; write it again",
                           file.string(), depth, kDeepestJson));
    }
    try {
        return Json::parse(text, KeysOnce(file));
    } catch (const Json::parse_error& problem) {
        if (const std::string mended = with_null_for_nan(text); !mended.empty())
            return parse_json(mended, file);
        if (trim(text).empty()) throw Error(format("{}: the file is empty; JSON is expected", file.string()));
        if (text.starts_with("\x1f\x8b"))
            throw Error(format("{}: it is packed with gzip; unpack it with gunzip", file.string()));
        if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") || text.find('\0') < 4)
            throw Error(format("{}: it is UTF-16; save it as UTF-8", file.string()));
        // The library counts bytes from 1; people count lines and columns.
        const size_t at = std::min(text.size(), problem.byte > 0 ? problem.byte - 1 : 0);
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        const size_t line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
        const bool is_utf8 = std::string_view(problem.what()).find("UTF-8") == std::string_view::npos;
        throw Error(
            format("{}:{}:{}: {}", file.string(), line, at - line_begin + 1,
                   is_utf8 ? "this is no valid JSON; check the quotes, commas and brackets around this place"
                           : "this byte is no UTF-8; save the file as UTF-8"));
    } catch (const Json::out_of_range&) {
        throw Error(format("{}: a number in it is too large for any computer; numbers must be below 1e308",
                           file.string()));
    }
}

bool is_json_lines(std::string_view text) {
    std::vector<std::string_view> first;
    for (size_t begin = 0; begin < text.size() && first.size() < 2;) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trim(text.substr(begin, end - begin));
        if (!line.empty()) first.push_back(line);
        begin = end + 1;
    }
    return first.size() == 2 && first[0].starts_with('{') && first[0].ends_with('}') &&
           first[1].starts_with('{');
}

// Commas at the ends of lines leave the numbers of lines as they are, for messages.
Json parse_json_lines(std::string_view text, const std::filesystem::path& file) {
    std::string array = "[";
    for (const std::string_view line : split(trim(text), '\n')) {
        if (array.size() > 1) array += trim(line).empty() ? "\n" : ",\n";
        array += line;
    }
    return parse_json(array + "]", file);
}

}  // namespace chironomia
