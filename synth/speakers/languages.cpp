#include "synth/speakers/languages.h"

#include <algorithm>
#include <map>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"

namespace chironomia {
namespace {

const std::map<std::string, std::string>& known_languages() {
    static const auto names = read_json(find_asset("synth/speakers/words/languages.json"))
                                  .get<std::map<std::string, std::string>>();
    return names;
}

}  // namespace

std::string language_named(std::string_view name) {
    std::string language = to_lower(trim(name));
    std::ranges::replace(language, '_', '-');
    for (std::string part = language;; part.resize(part.rfind('-'))) {
        if (const auto known = known_languages().find(part); known != known_languages().end())
            return known->second;
        if (part.find('-') == std::string::npos) return language;
    }
}

}  // namespace chironomia
