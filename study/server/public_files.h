// The files that participants may reach: those in public/, and nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace chironomia::study::server {

// An open file; closed with it.
class OpenFile {
  public:
    explicit OpenFile(int descriptor = -1) : descriptor_(descriptor) {}
    ~OpenFile();
    OpenFile(OpenFile&& other) noexcept : descriptor_(other.release()) {}
    OpenFile& operator=(OpenFile&& other) noexcept;

    int descriptor() const { return descriptor_; }
    int release();  // the caller closes it

  private:
    int descriptor_;
};

struct PublicFile {
    OpenFile file;
    std::uint64_t size = 0;  // bytes
    std::string type;        // "video/mp4"
    std::string tag;         // changes with the content
};

// What part of a file a request asks for.
struct ByteRange {
    enum class Kind { whole, part, unsatisfiable } kind = Kind::whole;
    std::uint64_t first = 0;
    std::uint64_t length = 0;
};

// The range of an HTTP `Range` header for a file of `size` bytes. Several ranges at once, and what is no
// range, ask for the whole (RFC 9110, 14.2: a server may ignore them).
ByteRange parse_range(const std::string& header, std::uint64_t size);

// Any thread may ask.
class PublicFiles {
  public:
    explicit PublicFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // The file at a decoded path of a URL, "/" being the index page; nothing if there is none. Every step of
    // the way is opened without following links; hidden names, folders and kinds of files that no study has
    // are not there.
    std::optional<PublicFile> open(const std::string& path);

  private:
    std::string tag_of(int descriptor, const std::string& path);

    std::filesystem::path folder_;
    std::mutex mutex_;
    std::unordered_map<std::string, std::string> tags_;  // by path, and by what changes with a file
};

}  // namespace chironomia::study::server
