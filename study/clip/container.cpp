#include "study/clip/container.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <fstream>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kEbmlHeader = 0x1a45dfa3;
constexpr std::uint64_t kSegment = 0x18538067;

// A file that is read a few bytes at a time and knows its size.
class ClipFile {
  public:
    explicit ClipFile(const fs::path& file) : file_(file), stream_(file, std::ios::binary) {
        if (!stream_ || !fs::is_regular_file(file)) {
            throw Error(format("{}: cannot be read; check the path", file.string()));
        }
        size_ = fs::file_size(file);
    }

    std::uint64_t size() const { return size_; }

    // `count` bytes as a big-endian number, or nothing at the end of the file.
    std::optional<std::uint64_t> number(std::uint64_t at, int count) {
        std::array<char, 8> bytes{};
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(at));
        if (!stream_.read(bytes.data(), count)) return std::nullopt;
        std::uint64_t value = 0;
        for (int i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
        return value;
    }

    [[noreturn]] void refuse_box(std::uint64_t at) const {
        throw Error(
            format("{}: the box at byte {} does not fit into the {} bytes of the file; write it again",
                   file_.string(), at, size_));
    }

  private:
    fs::path file_;
    std::ifstream stream_;
    std::uint64_t size_ = 0;
};

// ISO/IEC 14496-12, 4.2: 32-bit size, four letters, and a 64-bit size when the first is 1; 0: to the file's
// end.
ContainerBox read_mp4_box(ClipFile& file, std::uint64_t begin) {
    const auto size32 = file.number(begin, 4);
    const auto type = file.number(begin + 4, 4);
    if (!size32 || !type) file.refuse_box(begin);
    ContainerBox box{.type = {}, .begin = begin, .body = begin + 8};
    for (int shift = 24; shift >= 0; shift -= 8) box.type += static_cast<char>(*type >> shift & 0xff);
    std::uint64_t size = *size32 == 0 ? file.size() - begin : *size32;
    if (size == 1) {
        size = file.number(begin + 8, 8).value_or(0);
        box.body += 8;
    }
    if (size < box.body - begin || size > file.size() - begin) file.refuse_box(begin);
    box.end = begin + size;
    return box;
}

// RFC 8794, 4 to 6: the number of leading zero bits of the first byte is the number of bytes that follow it;
// the id keeps its marker bit, the size does not, and a size of ones alone means: to the end of the file.
ContainerBox read_webm_element(ClipFile& file, std::uint64_t begin) {
    const auto id_length = 1 + std::countl_zero(static_cast<std::uint8_t>(file.number(begin, 1).value_or(0)));
    const auto id = id_length > 4 ? std::nullopt : file.number(begin, id_length);
    if (!id) file.refuse_box(begin);
    const std::uint64_t size_at = begin + static_cast<std::uint64_t>(id_length);
    const auto size_length =
        1 + std::countl_zero(static_cast<std::uint8_t>(file.number(size_at, 1).value_or(0)));
    const auto marked = size_length > 8 ? std::nullopt : file.number(size_at, size_length);
    if (!marked) file.refuse_box(begin);

    const std::uint64_t marker = std::uint64_t{1} << (7 * size_length);
    const std::uint64_t body = size_at + static_cast<std::uint64_t>(size_length);
    const std::uint64_t unknown = marker - 1;
    std::uint64_t size = *marked - marker;
    if (size == unknown) size = file.size() - body;
    if (body > file.size() || size > file.size() - body) file.refuse_box(begin);
    const std::uint64_t end = *id == kSegment ? body : body + size;
    return {.type = format("{:x}", *id), .begin = begin, .body = body, .end = end};
}

bool is_webm(ClipFile& file) {
    return file.number(0, 4) == kEbmlHeader;
}

void append(const fs::path& clip, std::string_view header, std::uint64_t zeros) {
    std::ofstream stream(clip, std::ios::binary | std::ios::app);
    stream.write(header.data(), static_cast<std::streamsize>(header.size()));
    const std::string block(1 << 16, '\0');
    while (zeros > 0) {
        const std::uint64_t part = std::min<std::uint64_t>(zeros, block.size());
        stream.write(block.data(), static_cast<std::streamsize>(part));
        zeros -= part;
    }
    stream.close();
    if (!stream) throw Error(format("{}: cannot be made longer; check the free space", clip.string()));
}

// `count` bytes, highest first.
std::string big_endian(std::uint64_t value, int count) {
    std::string bytes;
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) {
        bytes += static_cast<char>(value >> shift & 0xff);
    }
    return bytes;
}

}  // namespace

std::vector<ContainerBox> read_boxes(const fs::path& clip) {
    ClipFile file(clip);
    const bool webm = is_webm(file);
    if (!webm && file.number(4, 4) != 0x66747970u) {  // "ftyp"
        throw Error(
            format("{}: is neither MP4 nor WebM, its first bytes say; write it again", clip.string()));
    }
    std::vector<ContainerBox> boxes;
    for (std::uint64_t at = 0; at < file.size(); at = boxes.back().end) {
        boxes.push_back(webm ? read_webm_element(file, at) : read_mp4_box(file, at));
    }
    return boxes;
}

void pad_clip(const fs::path& clip, std::uint64_t size) {
    const std::vector<ContainerBox> boxes = read_boxes(clip);
    const std::uint64_t now = boxes.back().end;
    assert(size >= now + kLeastPadding);
    const std::uint64_t added = size - now;
    const bool webm = boxes.front().type == "1a45dfa3";
    // Void: id ec, then a size of eight bytes, marked by the lowest bit of the first.
    const std::string header = webm               ? "\xec" + big_endian(added - 9 + (1ull << 56), 8)
                               : added >> 32 == 0 ? big_endian(added, 4) + "free"
                                                  : big_endian(1, 4) + "free" + big_endian(added, 8);
    append(clip, header, added - header.size());
}

}  // namespace chironomia::study
