#include "skinning/motion/points/npy.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/files/raw_number.h"
#include "core/files/zip_archive.h"
#include "core/text.h"
#include "core/utf8.h"

namespace chironomia {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr size_t kMostBytes = size_t{1} << 29;  // of an element
constexpr size_t kMostTexts = 1'000'000;        // of one array
constexpr size_t kHeader = size_t{1} << 20;     // of an array, at most [bytes]

// How many numbers a file may hold. Each becomes a double whatever its type is, and one byte of an archive
// can stand for a thousand of them. The most are three hours of 165 numbers at 30 frames/s.
size_t most_numbers(size_t file_bytes) {
    constexpr size_t kMost = size_t{1} << 26, kFree = size_t{1} << 23, kPerByte = 64;
    return std::min(kMost, kFree + kPerByte * file_bytes);
}

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The header is the text of a Python dictionary: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }
struct Header {
    std::string type;
    bool fortran_order = false;
    std::vector<size_t> shape;
};

// What follows 'key': in the dictionary.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
    const size_t at = dictionary.find(format("'{}'", key));
    if (at == std::string_view::npos) return {};
    const size_t colon = dictionary.find(':', at);
    if (colon == std::string_view::npos) return {};
    return trim(dictionary.substr(colon + 1));
}

std::optional<std::vector<size_t>> parse_shape(std::string_view text) {
    const size_t close = text.find(')');
    if (!text.starts_with('(') || close == std::string_view::npos) return std::nullopt;
    std::vector<size_t> shape;
    for (const std::string_view part : split(text.substr(1, close - 1), ',')) {
        if (trim(part).empty()) continue;
        const auto size = parse_integer(part);
        if (!size || *size < 0) return std::nullopt;
        shape.push_back(static_cast<size_t>(*size));
    }
    return shape;
}

std::optional<Header> parse_header(std::string_view dictionary) {
    Header header;
    const std::string_view type = value_of(dictionary, "descr");
    const std::string_view order = value_of(dictionary, "fortran_order");
    const auto shape = parse_shape(value_of(dictionary, "shape"));
    if (!shape || !(order.starts_with("True") || order.starts_with("False"))) return std::nullopt;
    header.fortran_order = order.starts_with("True");
    header.shape = *shape;
    // A record's type is a list; its arrays are of no use here.
    if (type.starts_with('\'')) header.type = type.substr(1, type.find('\'', 1) - 1);
    return header;
}

// One string of NumPy: of 4-byte characters (U) or bytes (S), filled up with zeros.
std::string text_at(const std::byte* bytes, size_t characters, bool wide, bool swapped) {
    static const ReadRawNumber read_character = raw_number_reader("u4");
    std::u32string text;
    for (size_t i = 0; i < characters; ++i) {
        const uint32_t code = wide ? static_cast<uint32_t>(read_character(bytes + 4 * i, swapped))
                                   : static_cast<uint32_t>(bytes[i]);
        if (code == 0) break;
        text += static_cast<char32_t>(code);
    }
    return to_utf8(text);
}

// Where element `i` of C order lies in Fortran order.
size_t fortran_index(size_t i, const std::vector<size_t>& shape) {
    size_t index = 0, step = 1;
    std::vector<size_t> places(shape.size());
    for (size_t d = shape.size(); d-- > 0;) {
        places[d] = i % shape[d];
        i /= shape[d];
    }
    for (size_t d = 0; d < shape.size(); ++d) {
        index += places[d] * step;
        step *= shape[d];
    }
    return index;
}

// The elements of an array: what they are, and that the data holds them all.
class Elements {
  public:
    Elements(const Header& header, std::span<const std::byte> data, size_t most_numbers,
             const std::string& where)
        : header_(header), data_(data) {
        const std::string_view type = header.type;
        if (type.size() < 3) return;
        swapped_ = type[0] == '>';
        kind_ = type.substr(1);
        const auto digits = parse_integer(type.substr(2));
        if (!digits || *digits < 0 || static_cast<size_t>(*digits) > kMostBytes) return;
        size_ = static_cast<size_t>(*digits) * (kind_.starts_with('U') ? 4 : 1);
        count(where);
        const size_t most = is_text() ? kMostTexts : most_numbers;
        if (count_ <= most) return;
        throw Error(format("{}: the array of shape ({}) has more than the {} {} that are read of such a file",
                           where, fmt::join(header_.shape, ", "), most, is_text() ? "texts" : "numbers"));
    }

    void fill(NumpyArray& array) const {
        if (size_ == 0) return;
        const bool text = is_text();
        const ReadRawNumber read = raw_number_reader(kind_);
        if (!text && read == nullptr) return;
        if (!text) array.numbers.reserve(count_);
        for (size_t i = 0; i < count_; ++i) {
            const size_t index = header_.fortran_order ? fortran_index(i, header_.shape) : i;
            const std::byte* bytes = data_.data() + index * size_;
            if (text)
                array.texts.push_back(
                    text_at(bytes, size_ / (kind_[0] == 'U' ? 4 : 1), kind_[0] == 'U', swapped_));
            else
                array.numbers.push_back(read(bytes, swapped_));
        }
    }

  private:
    bool is_text() const { return kind_.starts_with('U') || kind_.starts_with('S'); }

    void count(const std::string& where) {
        if (size_ == 0) return;
        const size_t held = data_.size() / size_;
        count_ = 1;
        for (const size_t extent : header_.shape) {
            if (extent != 0 && count_ > (size_t{1} << 40) / extent)
                count_ = SIZE_MAX;
            else
                count_ *= extent;
            if (count_ == SIZE_MAX) break;
        }
        if (count_ <= held) return;
        throw Error(format(
            "{}: the array of shape ({}) needs more elements of type {} than the {} in the file; it is "
            "truncated",
            where, fmt::join(header_.shape, ", "), header_.type, held));
    }

    const Header& header_;
    std::span<const std::byte> data_;
    std::string_view kind_;  // "f4"
    size_t size_ = 0;        // bytes of an element
    size_t count_ = 0;
    bool swapped_ = false;
};

NumpyArray parse_array(std::span<const std::byte> bytes, size_t most_numbers, const std::string& where) {
    const std::string_view text = as_text(bytes);
    const auto byte_at = [&](size_t i) { return static_cast<size_t>(bytes[i]); };
    if (!is_npy(bytes) || bytes.size() < 12) throw Error(format("{}: this is no whole .npy array", where));
    // Version 1 has two bytes for the header's length, later ones four.
    const size_t version = byte_at(6);
    const size_t begin = version == 1 ? 10 : 12;
    size_t size = byte_at(8) | byte_at(9) << 8;
    if (version != 1) size |= byte_at(10) << 16 | byte_at(11) << 24;
    if (version < 1 || version > 3 || size > bytes.size() - begin) {
        throw Error(format(
            "{}: the .npy header (version {}, {} bytes) does not fit into {} bytes; the file is truncated",
            where, version, size, bytes.size()));
    }
    const auto header = parse_header(text.substr(begin, size));
    if (!header) throw Error(format("{}: the .npy header is broken; write the array again", where));
    NumpyArray array{.name = "", .type = header->type, .shape = header->shape, .numbers = {}, .texts = {}};
    Elements(*header, bytes.subspan(begin + size), most_numbers, where).fill(array);
    return array;
}

}  // namespace

bool is_npy(std::span<const std::byte> bytes) {
    return as_text(bytes).starts_with(kNpyMagic);
}

bool is_zip(std::span<const std::byte> bytes) {
    return as_text(bytes).starts_with("PK\x03\x04") || as_text(bytes).starts_with("PK\x05\x06");
}

NumpyArray parse_npy(std::span<const std::byte> bytes, const std::string& where) {
    return parse_array(bytes, most_numbers(bytes.size()), where);
}

std::vector<NumpyArray> parse_npz(std::span<const std::byte> bytes, const std::string& where) {
    const ZipReader archive(bytes, where);
    std::vector<NumpyArray> arrays;
    size_t left = most_numbers(bytes.size());
    for (size_t i = 0; i < archive.size(); ++i) {
        const std::string name = archive.name(i);
        if (!name.ends_with(".npy")) continue;
        const std::string inside = format("{}: {}", where, name);
        const auto unpacked = archive.read(i, kHeader + left * sizeof(double), inside);
        arrays.push_back(parse_array(unpacked, left, inside));
        left -= arrays.back().numbers.size();
        arrays.back().name = name.substr(0, name.size() - 4);
    }
    return arrays;
}

std::string describe(const NumpyArray& array) {
    return format("{} ({})", array.name.empty() ? "array" : array.name, fmt::join(array.shape, ", "));
}

}  // namespace chironomia
