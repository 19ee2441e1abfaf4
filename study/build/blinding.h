// What hides the conditions from participants and from anybody who looks at the files of a study.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia::study {

// The secret key of the opaque names. It depends on the hashes of the inputs, so that nobody can compute the names from
// the seed alone.
std::string make_study_key(std::uint64_t seed, const std::vector<std::string>& input_hashes);

inline constexpr std::size_t kTokenDigits = 16;

// One opaque name per text, all different: the first `digits` hexadecimal digits of a keyed hash.
std::vector<std::string> make_tokens(std::string_view key, const std::vector<std::string>& texts,
                                     std::size_t digits = kTokenDigits);

// How many parts of a study have opaque names.
struct NamedParts {
    std::size_t videos = 0;
    std::size_t pages = 0;
    std::size_t sounds = 0;  // of the sound check
};

// What the names of a study's parts are hashed from: the study, then its videos, its pages and its sounds.
std::vector<std::string> texts_to_name(const NamedParts& parts);

// Makes all clips the same number of bytes: that of the largest and kLeastPadding. The largest is padded too, since a
// clip without padding would stand out. Throws Error if one is no MP4 or WebM.
void make_sizes_equal(const std::vector<std::filesystem::path>& clips);

// 1980-01-01 00:00 UTC, the earliest time that archives can store.
inline constexpr std::int64_t kNeutralTime = 315532800;  // [s since 1970]

// Gives a folder and everything in it the time kNeutralTime and the permissions 755 (folders) and 644
// (files). Throws Error if the file system refuses.
void reset_times_and_permissions(const std::filesystem::path& folder);

}  // namespace chironomia::study
