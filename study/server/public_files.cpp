#include "study/server/public_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/hash.h"
#include "core/text.h"

namespace chironomia::study::server {
namespace {

constexpr std::size_t kMostSteps = 4;
constexpr std::size_t kMostTags = 10'000;

struct Type {
    std::string_view ending;
    std::string_view type;
};
constexpr std::array kTypes = {
    Type{".html", "text/html; charset=utf-8"},
    Type{".js", "text/javascript; charset=utf-8"},
    Type{".css", "text/css; charset=utf-8"},
    Type{".json", "application/json"},
    Type{".mp4", "video/mp4"},
    Type{".webm", "video/webm"},
    Type{".m4a", "audio/mp4"},
    Type{".wav", "audio/wav"},
    Type{".png", "image/png"},
    Type{".jpg", "image/jpeg"},
    Type{".svg", "image/svg+xml"},
    Type{".woff2", "font/woff2"},
};

// No dot at its beginning, nothing but letters, digits, '.', '-' and '_'.
bool is_servable_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && name.size() <= 100 &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '.' || c == '-' || c == '_';
           });
}

std::string type_of(std::string_view name) {
    for (const Type& type : kTypes) {
        if (name.ends_with(type.ending)) return std::string(type.type);
    }
    return "";
}

// Each name is opened in the folder before it, and a link is not followed: no path leads out of `folder`.
OpenFile open_below(const std::filesystem::path& folder, const std::vector<std::string_view>& names) {
    constexpr int kFolder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
    // A pipe that somebody left there must not stop us.
    constexpr int kFile = O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
    OpenFile at(::open(folder.c_str(), kFolder));
    for (std::size_t i = 0; i < names.size() && at.descriptor() >= 0; ++i) {
        const bool last = i + 1 == names.size();
        at = OpenFile(openat(at.descriptor(), std::string(names[i]).c_str(), last ? kFile : kFolder));
    }
    return at;
}

std::string hash_of(int descriptor) {
    std::string content;
    std::array<char, 65536> piece{};
    for (;;) {
        const ssize_t count =
            pread(descriptor, piece.data(), piece.size(), static_cast<off_t>(content.size()));
        if (count <= 0) return sha256(content);
        content.append(piece.data(), static_cast<std::size_t>(count));
    }
}

}  // namespace

OpenFile::~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = other.release();
    return *this;
}

int OpenFile::release() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return descriptor;
}

ByteRange parse_range(const std::string& header, std::uint64_t size) {
    constexpr std::string_view kUnit = "bytes=";
    const std::string_view text = header;
    if (!text.starts_with(kUnit)) return {};
    const std::vector<std::string_view> ends = split(text.substr(kUnit.size()), '-');
    if (ends.size() != 2) return {};
    const auto first = parse_integer(ends[0]);
    const auto last = parse_integer(ends[1]);
    const bool open_first = ends[0].empty(), open_last = ends[1].empty();
    if ((!open_first && (!first || *first < 0)) || (!open_last && (!last || *last < 0))) return {};
    if (open_first && open_last) return {};
    if (open_first) {
        const std::uint64_t length = std::min(static_cast<std::uint64_t>(*last), size);
        if (length == 0) return {.kind = ByteRange::Kind::unsatisfiable};
        return {.kind = ByteRange::Kind::part, .first = size - length, .length = length};
    }
    const auto begin = static_cast<std::uint64_t>(*first);
    if (!open_last && *last < *first) return {};
    if (begin >= size) return {.kind = ByteRange::Kind::unsatisfiable};
    const std::uint64_t end = open_last ? size - 1 : std::min(static_cast<std::uint64_t>(*last), size - 1);
    return {.kind = ByteRange::Kind::part, .first = begin, .length = end - begin + 1};
}

std::optional<PublicFile> PublicFiles::open(const std::string& path) {
    if (!path.starts_with('/')) return std::nullopt;
    const std::string relative = path == "/" ? "index.html" : path.substr(1);
    const std::vector<std::string_view> names = split(relative, '/');
    const std::string type = type_of(names.back());
    if (names.size() > kMostSteps || type.empty()) return std::nullopt;
    if (!std::all_of(names.begin(), names.end(), is_servable_name)) return std::nullopt;

    OpenFile file = open_below(folder_, names);
    struct stat status {};
    if (file.descriptor() < 0 || fstat(file.descriptor(), &status) != 0 || !S_ISREG(status.st_mode)) {
        return std::nullopt;
    }
    std::string tag = tag_of(file.descriptor(), relative);
    return PublicFile{.file = std::move(file),
                      .size = static_cast<std::uint64_t>(status.st_size),
                      .type = type,
                      .tag = std::move(tag)};
}

// The hash of the content: all files of a study have the same time, and many the same size.
std::string PublicFiles::tag_of(int descriptor, const std::string& path) {
    struct stat status {};
    fstat(descriptor, &status);
    const std::string version = format("{} {} {} {} {}", path, status.st_ino, status.st_size,
                                       status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
    {
        const std::lock_guard lock(mutex_);
        const auto known = tags_.find(version);
        if (known != tags_.end()) return known->second;
    }
    const std::string tag = "\"" + hash_of(descriptor).substr(0, 32) + "\"";
    const std::lock_guard lock(mutex_);
    if (tags_.size() >= kMostTags) tags_.clear();
    tags_[version] = tag;
    return tag;
}

}  // namespace chironomia::study::server
