#include "study/build/blinding.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/clip/container.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

void make_trace_neutral(const fs::path& path, bool folder) {
    const timespec neutral{.tv_sec = kNeutralTime, .tv_nsec = 0};
    const timespec times[2] = {neutral, neutral};
    if (::chmod(path.c_str(), folder ? 0755 : 0644) != 0 ||
        ::utimensat(AT_FDCWD, path.c_str(), times, 0) != 0) {
        throw Error(format("{}: its time and permissions cannot be set ({}); build on another file system",
                           path.string(), std::strerror(errno)));
    }
}

}  // namespace

std::string make_study_key(std::uint64_t seed, const std::vector<std::string>& input_hashes) {
    return keyed_sha256(format("study {}", seed), join(input_hashes, "\n"));
}

std::vector<std::string> make_tokens(std::string_view key, const std::vector<std::string>& texts,
                                     std::size_t digits) {
    std::set<std::string> taken;
    std::vector<std::string> tokens;
    for (const std::string& text : texts) {
        std::string token;
        // Two texts may share their first digits: hash again with a number until the name is free.
        for (int attempt = 0; token.empty() || taken.count(token) > 0; ++attempt) {
            token = keyed_sha256(key, format("{} {}", attempt, text)).substr(0, digits);
        }
        taken.insert(token);
        tokens.push_back(token);
    }
    return tokens;
}

std::vector<std::string> texts_to_name(const NamedParts& parts) {
    std::vector<std::string> texts = {"study"};
    for (std::size_t i = 0; i < parts.videos; ++i) texts.push_back(format("video {}", i));
    for (std::size_t i = 0; i < parts.pages; ++i) texts.push_back(format("page {}", i));
    for (std::size_t i = 0; i < parts.sounds; ++i) texts.push_back(format("sound {}", i));
    return texts;
}

void make_sizes_equal(const std::vector<fs::path>& clips) {
    std::uint64_t largest = 0;
    for (const fs::path& clip : clips) largest = std::max(largest, read_boxes(clip).back().end);
    for (const fs::path& clip : clips) pad_clip(clip, largest + kLeastPadding);
}

void reset_times_and_permissions(const fs::path& folder) {
    // A folder's time changes when something in it does, so the folders come last.
    std::vector<fs::path> folders = {folder};
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_directory()) {
            folders.push_back(entry.path());
        } else {
            make_trace_neutral(entry.path(), false);
        }
    }
    for (const fs::path& each : folders) make_trace_neutral(each, true);
}

}  // namespace chironomia::study
