#include "synth/speech/ssml_alias.h"

#include <algorithm>
#include <optional>

#include "synth/speech/utf8.h"

namespace chironomia {
namespace {

struct Alias {
    std::string_view words;
    std::size_t inside = 0;  // first character between the tags
    std::size_t end = 0;     // one behind the element's last character
};

// The end of a tag that begins the text, behind its ">", which may also stand in quotation marks.
std::size_t end_of_tag(std::string_view text) {
    char quote = '\0';
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (quote != '\0') {
            if (text[i] == quote) quote = '\0';
        } else if (text[i] == '"' || text[i] == '\'') {
            quote = text[i];
        } else if (text[i] == '>') {
            return i + 1;
        }
    }
    return text.size();
}

// The value of an attribute "alias" in a tag.
std::optional<std::string_view> alias_in(std::string_view tag) {
    const std::size_t name = tag.find("alias");
    const std::size_t quote = name == std::string_view::npos ? name : tag.find_first_of("\"'", name);
    if (quote == std::string_view::npos) return std::nullopt;
    const std::size_t end = tag.find(tag[quote], quote + 1);
    if (end == std::string_view::npos) return std::nullopt;
    return tag.substr(quote + 1, end - quote - 1);
}

// The element "sub" that begins the text, if it has an alias.
std::optional<Alias> read_alias(std::string_view text) {
    constexpr std::string_view kOpen = "<sub", kClose = "</sub>";
    if (!text.starts_with(kOpen) ||
        std::string_view(" \t\r\n").find(text[kOpen.size()]) == std::string_view::npos)
        return std::nullopt;
    const std::size_t inside = end_of_tag(text), close = text.find(kClose);
    const auto words = alias_in(text.substr(0, inside));
    if (!words || close == std::string_view::npos || close < inside) return std::nullopt;
    return Alias{.words = *words, .inside = inside, .end = close + kClose.size()};
}

}  // namespace

SpokenScript with_aliases(std::string_view ssml) {
    SpokenScript script;
    std::size_t character = 0;  // of the script, at `place`
    const auto count = [&](std::size_t first, std::size_t end) {
        return starts_of_characters(ssml.substr(first, end - first)).size() - 1;
    };
    for (std::size_t place = 0; place < ssml.size();) {
        if (const auto alias = read_alias(ssml.substr(place))) {
            const std::size_t letters = starts_of_characters(alias->words).size() - 1;
            script.text += alias->words;
            script.origins.insert(script.origins.end(), letters,
                                  character + count(place, place + alias->inside));
            character += count(place, place + alias->end);
            place += alias->end;
            continue;
        }
        const std::size_t end = std::min(ssml.find('<', place + 1), ssml.size());
        script.text += ssml.substr(place, end - place);
        for (std::size_t left = count(place, end); left > 0; --left) script.origins.push_back(character++);
        place = end;
    }
    script.origins.push_back(character);
    return script;
}

}  // namespace chironomia
