#include "core/files/json.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/error.h"
#include "core/files/files.h"
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

}  // namespace

Json read_json(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    if (const int depth = json_depth(text); depth > kDeepestJson) {
        throw Error(format("{}: its brackets nest {} deep, at most {} are read; write it again",
                           file.string(), depth, kDeepestJson));
    }
    try {
        return Json::parse(text, KeysOnce(file));
    } catch (const Json::parse_error& problem) {
        if (trim(text).empty()) throw Error(format("{}: the file is empty; JSON is expected", file.string()));
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

void write_json(const std::filesystem::path& file, const Json& value) {
    write_text(file, value.dump(2) + "\n");
}

}  // namespace chironomia
