#include "core/hdf5/array.h"

#include <algorithm>

#include "core/error.h"
#include "core/files/raw_number.h"
#include "core/hdf5/bytes.h"
#include "core/hdf5/chunks.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr size_t kMostBytes = size_t{1} << 30;  // of one array
constexpr size_t kMostTexts = 1'000'000;
constexpr size_t kMostSides = 32;

std::vector<size_t> shape_in(std::span<const std::byte> message, const Hdf5Place& place) {
    Hdf5Cursor cursor(message, place.where);
    const auto version = cursor.number(1), sides = cursor.number(1), flags = cursor.number(1);
    const auto kind = cursor.number(1);
    if (version < 1 || version > 2 || sides > kMostSides)
        refuse_damage(place.where, format("the shape of /{} makes no sense", place.path));
    if (version == 1) cursor.skip(4);
    if (version == 2 && kind == 2) return {0};
    if (flags > 3) refuse_damage(place.where, format("the shape of /{} makes no sense", place.path));
    std::vector<size_t> shape;
    for (std::uint64_t i = 0; i < sides; ++i) shape.push_back(static_cast<size_t>(cursor.number(8)));
    return shape;
}

size_t count_of(const std::vector<size_t>& shape, size_t element, const Hdf5Place& place) {
    size_t count = 1;
    for (const size_t extent : shape) {
        if (extent != 0 && count > kMostBytes / extent) refuse(place, "is larger than 1 GiB");
        count *= extent;
    }
    if (count > kMostBytes / std::max<size_t>(element, sizeof(double))) refuse(place, "is larger than 1 GiB");
    return count;
}

struct ElementType {
    size_t size = 0;               // [bytes]
    ReadRawNumber read = nullptr;  // nothing: no number
    bool swapped = false;
    bool text = false;
    bool long_text = false;  // of variable length, kept elsewhere: texts, or any bytes
};

// Whether a float is an IEEE one, by the number of bits of its exponent.
bool is_usual_float(Hdf5Cursor& properties, size_t size) {
    properties.skip(5);
    const auto exponent = properties.number(1);
    return (size == 2 && exponent == 5) || (size == 4 && exponent == 8) || (size == 8 && exponent == 11);
}

// Whole numbers of one byte, of which a sequence of variable length may consist.
bool is_byte_type(Hdf5Cursor type) {
    const auto kind = type.number(1) & 15;
    type.skip(3);
    return kind == 0 && type.number(4) == 1;
}

ElementType type_in(std::span<const std::byte> message, const Hdf5Place& place) {
    Hdf5Cursor cursor(message, place.where);
    const auto kind = cursor.number(1) & 15, bits = cursor.number(3);
    ElementType type{.size = static_cast<size_t>(cursor.number(4)), .swapped = (bits & 1) != 0};
    if (type.size == 0 || type.size > kMostBytes)
        refuse_damage(place.where, format("an element of /{} has {} bytes", place.path, type.size));
    if (kind == 0) type.read = raw_number_reader(format("{}{}", bits & 8 ? "i" : "u", type.size));
    if (kind == 1 && is_usual_float(cursor, type.size))
        type.read = raw_number_reader(format("f{}", type.size));
    type.text = kind == 3;
    type.long_text = kind == 9 && ((bits & 15) == 1 || is_byte_type(cursor));
    return type;
}

// All elements one after the other, as they lie in the file.
class RawElements {
  public:
    RawElements(const Hdf5ArrayHeader& header, const std::vector<size_t>& shape, const ElementType& type,
                const Hdf5Place& place) {
        const size_t size = count_of(shape, type.size, place) * type.size;
        Hdf5Cursor layout(header.layout, place.where);
        const auto version = layout.number(1), kind = layout.number(1);
        if (version < 3 || version > 4 || kind > 2)
            refuse(place, format("is kept in layout {} of version {}, which is not read", kind, version));
        if (size == 0) return;
        if (kind == 0) {
            const auto held = layout.number(2);
            view_ = layout.take(held);
        } else if (kind == 1) {
            const auto address = layout.number(8);
            if (address == kNowhere) refuse(place, "was made, but nothing was ever written into it");
            view_ = hdf5_at(place.file, address, place.where).take(size);
        } else {
            unpacked_ = read_hdf5_chunks({.shape = shape,
                                          .element = type.size,
                                          .layout = layout,
                                          .version = static_cast<unsigned>(version),
                                          .filters = hdf5_filters(header.filters, place)},
                                         place);
            view_ = unpacked_;
        }
        if (view_.size() < size) {
            refuse_damage(place.where, format("/{} has {} bytes of {}", place.path, view_.size(), size));
        }
    }
    RawElements(const RawElements&) = delete;
    RawElements& operator=(const RawElements&) = delete;

    std::span<const std::byte> bytes() const { return view_; }

  private:
    std::vector<std::byte> unpacked_;
    std::span<const std::byte> view_;
};

// A text of variable length: its size, and which object of which collection of the file it is.
std::string long_text(std::span<const std::byte> reference, const Hdf5Place& place) {
    Hdf5Cursor cursor(reference, place.where);
    const auto length = cursor.number(4), address = cursor.number(8), wanted = cursor.number(4);
    if (length == 0) return {};
    Hdf5Cursor heap = hdf5_at(place.file, address, place.where);
    heap.expect("GCOL");
    heap.skip(4);
    const auto heap_size = heap.number(8);
    if (heap_size < 16) refuse_damage(place.where, "a collection of texts is too small");
    Hdf5Cursor objects(heap.take(heap_size - 16), place.where);
    while (objects.left() >= 16) {
        const auto index = objects.number(2);
        objects.skip(6);
        const auto size = objects.number(8);
        if (index == 0) break;
        if (index == wanted) return std::string(objects.text(std::min(size, length)));
        objects.skip(size);
        objects.skip(std::min<std::uint64_t>((8 - size % 8) % 8, objects.left()));
    }
    refuse_damage(place.where, format("a text of /{} is not where it should be", place.path));
}

std::string text_of(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return std::string(text.substr(0, text.find('\0')));
}

void append_element(Hdf5Array& array, std::span<const std::byte> element, const ElementType& type,
                    const Hdf5Place& place) {
    if (type.long_text)
        array.texts.push_back(long_text(element, place));
    else if (type.text)
        array.texts.push_back(text_of(element));
    else
        array.numbers.push_back(type.read(element.data(), type.swapped));
}

}  // namespace

void refuse(const Hdf5Place& place, std::string_view message) {
    throw Error(format("{}: /{} {}", place.where, place.path, message));
}

std::vector<size_t> hdf5_shape(const Hdf5ArrayHeader& header, const Hdf5Place& place) {
    return shape_in(header.space, place);
}

Hdf5Array read_hdf5_array(const Hdf5ArrayHeader& header, const Hdf5Place& place) {
    Hdf5Array array;
    array.shape = shape_in(header.space, place);
    const ElementType type = type_in(header.type, place);
    array.is_text = type.text || type.long_text;
    if (!array.is_text && !type.read) return array;
    const size_t count = count_of(array.shape, type.size, place);
    if (array.is_text && count > kMostTexts) refuse(place, "holds more than a million texts");
    const RawElements elements(header, array.shape, type, place);
    if (!array.is_text) array.numbers.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        const auto element = elements.bytes().subspan(i * type.size, type.size);
        append_element(array, element, type, place);
    }
    return array;
}

std::optional<Hdf5Array> hdf5_attribute(std::span<const std::byte> message, std::string_view name,
                                        const Hdf5Place& place) {
    Hdf5Cursor cursor(message, place.where);
    const auto version = cursor.number(1);
    if (version < 1 || version > 3) return std::nullopt;
    cursor.skip(1);
    const auto name_size = cursor.number(2), type_size = cursor.number(2), space_size = cursor.number(2);
    if (version == 3) cursor.skip(1);
    // The first version fills each part up to eight bytes.
    const auto part = [&](std::uint64_t size) {
        const auto bytes = cursor.take(size);
        if (version == 1) cursor.skip((8 - size % 8) % 8);
        return bytes;
    };
    if (text_of(part(name_size)) != name) return std::nullopt;
    const ElementType type = type_in(part(type_size), place);
    const std::vector<size_t> shape = shape_in(part(space_size), place);
    Hdf5Array value;
    value.is_text = type.text || type.long_text;
    if (!(type.read || value.is_text) || count_of(shape, type.size, place) != 1) return std::nullopt;
    append_element(value, cursor.take(type.size), type, place);
    return value;
}

}  // namespace chironomia
