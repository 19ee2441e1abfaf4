// Names that must not reach a participant, and where they can hide.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

struct Plan;

// Names that reveal what a video shows: conditions, clips, avatars, files of partners, and the parts of the inputs'
// paths. Parts that all motions or all faces of a clip share are left out: a folder "bvh" that holds everything reveals
// nothing. Names of bundled avatars are left out too: everybody sees that the avatar "female" is a woman, and a page
// may offer "neutral" as an answer.
std::vector<std::string> secret_names(const Plan& plan);

// The first of `names` that stands in `text` as a whole word, upper or lower case alike.
std::optional<std::string> find_word(std::string_view text, const std::vector<std::string>& names);

// The first of the names of `conditions` that participants read in `text`, line by line. A line that a bundled protocol
// prints (is_text_of_a_preset) may have any of them as a word: it is the same whatever the conditions are called, so it
// reveals nothing.
std::optional<std::string> find_condition(std::string_view text, const std::vector<std::string>& conditions);

// The first of `names` in the bytes of a clip, upper or lower case alike, in ASCII, UTF-16 of either byte
// order, Base64, hexadecimal digits or rot13. Names under 4 letters are left out, because any letters come up
// in so many bytes by chance. For the same reason names under 8 letters are sought only outside the
// compressed pictures and sounds. Throws Error if the clip is no MP4 or WebM.
std::optional<std::string> find_name_in_clip(const std::filesystem::path& clip,
                                             const std::vector<std::string>& names);

}  // namespace chironomia
