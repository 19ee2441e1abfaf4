#include "skinning/body/up_doubt.h"

#include <string_view>

namespace chironomia {

constexpr std::string_view kDoubtfulUp = "up axis in doubt: ";

std::string note_of_doubtful_up(const std::string& what) {
    return std::string(kDoubtfulUp) + what;
}

std::optional<std::string> doubt_of_up_axis(const Motion& motion) {
    for (const std::string& note : motion.notes)
        if (note.starts_with(kDoubtfulUp)) return note.substr(kDoubtfulUp.size());
    return std::nullopt;
}

}  // namespace chironomia
