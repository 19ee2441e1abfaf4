#include "synth/markup/script_builder.h"

#include "synth/markup/script_words.h"

namespace chironomia {

bool ScriptBuilder::needs_space(std::string_view next) const {
    constexpr std::string_view kClosing = ".,;:!?'-*";
    if (script_.empty()) return false;
    if (has_space_) return true;
    if (kClosing.find(next.front()) != std::string_view::npos || starts_with_break(next)) return false;
    return script_.ends_with("..") || (is_parted_ && !ends_with_break(script_));
}

void ScriptBuilder::add(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n\f\v";
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (kSpace.find(text[at]) != std::string_view::npos) {
            has_space_ = true;
            continue;
        }
        if (needs_space(text.substr(at))) script_ += ' ';
        script_ += text[at];
        has_space_ = is_parted_ = false;
    }
}

}  // namespace chironomia
