#include "study/clip/travel.h"

#include <algorithm>

namespace chironomia::study {

const std::map<std::string, Travel>& travels() {
    static const std::map<std::string, Travel> words = {
        {"free", Travel::free}, {"follow", Travel::follow}, {"in-place", Travel::in_place}};
    return words;
}

std::string to_text(Travel travel) {
    return std::find_if(travels().begin(), travels().end(),
                        [&](const auto& word) { return word.second == travel; })
        ->first;
}

}  // namespace chironomia::study
