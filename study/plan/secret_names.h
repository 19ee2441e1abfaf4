// Names that must not reach a participant, and where they can hide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace chironomia::study {

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

// Texts that are sought all at once, however many they are: in one pass over the bytes.
class SoughtTexts {
  public:
    // `text` has 4 bytes or more and stands for the name of that number.
    void add(std::string text, std::size_t name);

    // The least number of a name one of whose texts is in `bytes`.
    std::optional<std::size_t> find(std::string_view bytes) const;

  private:
    struct Text {
        std::string bytes;
        std::size_t name = 0;
    };
    std::unordered_multimap<std::uint32_t, Text> texts_;        // by their first four bytes
    std::vector<bool> may_begin_ = std::vector<bool>(1 << 16);  // by the first two
};

// Names that are sought in the bytes of clips, upper or lower case alike, in ASCII, UTF-16 of either byte
// order, Base64, hexadecimal digits or rot13. Names under 4 letters are left out, because any letters come up
// in so many bytes by chance. For the same reason names under 8 letters are sought only outside the
// compressed pictures and sounds.
class NamesInClips {
  public:
    explicit NamesInClips(std::vector<std::string> names);

    // The first of the names that is in a clip. Throws Error if the clip is no MP4 or WebM.
    std::optional<std::string> find(const std::filesystem::path& clip) const;

  private:
    std::vector<std::string> names_;
    SoughtTexts in_lower_structure_;
    SoughtTexts in_structure_;  // Base64 keeps upper and lower case apart
    SoughtTexts in_lower_bytes_;
};

}  // namespace chironomia::study
