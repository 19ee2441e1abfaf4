#include "synth/speakers/languages.h"

#include <algorithm>
#include <array>
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

// "en" of "en-gb".
std::string_view main_part(std::string_view language) {
    return language.substr(0, language.find('-'));
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

// As the voices of espeak-ng 1.51 were seen to do.
bool is_spelt_by(std::string_view language, char32_t letter) {
    constexpr auto kReadLatinAlone =
        std::to_array<std::string_view>({"af", "de", "en", "es", "it", "lt", "sl", "vi"});
    const std::string_view main = main_part(language);
    const bool is_greek = (letter >= 0x370 && letter <= 0x3ff) || (letter >= 0x1f00 && letter <= 0x1fff);
    if (is_greek) return main != "el" && main != "grc";
    return std::ranges::find(kReadLatinAlone, main) != kReadLatinAlone.end();
}

}  // namespace chironomia
