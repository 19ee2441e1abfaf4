#include "synth/learned/training/safetensors_layout.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <tuple>

#include "core/error.h"
#include "core/files/json.h"
#include "core/files/json_depth.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostHeader = 100'000'000;  // [bytes], as the format has it
constexpr std::size_t kMostDimensions = 8;

struct Kind {
    const char* name;
    TensorType type;
    std::size_t bytes;
};

constexpr Kind kKinds[] = {{"F32", TensorType::f32, 4},
                           {"F16", TensorType::f16, 2},
                           {"BF16", TensorType::bf16, 2},
                           {"I64", TensorType::i64, 8}};

struct Place {
    std::string name;
    const Kind* kind = nullptr;
    std::vector<std::int64_t> shape;
    std::size_t begin = 0, end = 0;  // [bytes] in the payload
};

[[noreturn]] void refuse_file(const fs::path& file, std::string_view what) {
    throw Error(format("{}: {}; get the file again", file.string(), what));
}

const Json& member(const Json& entry, const char* key, const std::string& name, const fs::path& file) {
    if (!entry.is_object() || !entry.contains(key))
        refuse_file(file, format("tensor \"{}\" has no \"{}\"", name, key));
    return entry[key];
}

const Kind* kind_of(const Json& dtype, const std::string& name, const fs::path& file) {
    const std::string text = dtype.is_string() ? dtype.get<std::string>() : dtype.dump();
    const auto* found =
        std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return text == k.name; });
    if (found == std::end(kKinds)) {
        throw Error(format("{}: tensor \"{}\" is of type {}, read are F32, F16, BF16 and I64; convert it",
                           file.string(), name, text));
    }
    return found;
}

// A count that fits into 63 bits.
std::size_t count_of(const Json& value, const std::string& what, const std::string& name,
                     const fs::path& file) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
        refuse_file(file, format("tensor \"{}\" has the {} {}, a count is needed", name, what, value.dump()));
    return value.get<std::uint64_t>();
}

Place place_of(const std::string& name, const Json& entry, const fs::path& file) {
    Place place{.name = name, .kind = kind_of(member(entry, "dtype", name, file), name, file)};
    const Json& shape = member(entry, "shape", name, file);
    const Json& offsets = member(entry, "data_offsets", name, file);
    if (!shape.is_array() || shape.size() > kMostDimensions)
        refuse_file(file, format("tensor \"{}\" has no shape of at most {} counts", name, kMostDimensions));
    if (!offsets.is_array() || offsets.size() != 2)
        refuse_file(file, format("tensor \"{}\" has no two data_offsets", name));
    place.begin = count_of(offsets[0], "offset", name, file);
    place.end = count_of(offsets[1], "offset", name, file);
    std::size_t bytes = place.kind->bytes;
    bool fits = true;
    for (const Json& extent : shape) {
        place.shape.push_back(static_cast<std::int64_t>(count_of(extent, "extent", name, file)));
        fits = fits && !__builtin_mul_overflow(bytes, static_cast<std::size_t>(place.shape.back()), &bytes);
    }
    if (!fits || place.end < place.begin || place.end - place.begin != bytes) {
        refuse_file(file,
                    format("tensor \"{}\" of type {} and shape {} lies in the bytes {} to {}, which is not "
                           "its size",
                           name, place.kind->name, shape.dump(), place.begin, place.end));
    }
    return place;
}

// In the order of their places, which fill the payload without a gap.
std::vector<Place> places_in(const Json& header, std::size_t payload, const fs::path& file) {
    std::vector<Place> places;
    for (const auto& [name, entry] : header.items())
        if (name != "__metadata__") places.push_back(place_of(name, entry, file));
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.begin, a.end, a.name) < std::tie(b.begin, b.end, b.name);
    });
    std::size_t end = 0;
    for (const Place& place : places) {
        if (place.begin != end) {
            refuse_file(file, format("tensor \"{}\" begins at byte {}, where the one before it ends at {}",
                                     place.name, place.begin, end));
        }
        end = place.end;
    }
    if (end != payload)
        refuse_file(file,
                    format("its tensors need {} bytes, {} follow its header; it is damaged or truncated", end,
                           payload));
    return places;
}

//   begin  of a file of `bytes` bytes
std::uint64_t header_length(std::string_view begin, std::size_t bytes, const fs::path& file) {
    std::uint64_t length = 0;
    if (begin.size() < sizeof length)
        refuse_file(file, format("has {} bytes, no safetensors file is as short", bytes));
    std::memcpy(&length, begin.data(), sizeof length);
    if (length > kMostHeader || length > bytes - sizeof length) {
        refuse_file(file,
                    format("its header should have {} bytes, the file has {}; it is no safetensors file or "
                           "is truncated",
                           length, bytes));
    }
    return length;
}

Json parse_header(std::string_view text, const fs::path& file) {
    Json header = Json::parse(text, nullptr, false);
    if (!header.is_object() || json_depth(text) > kDeepestJson)
        refuse_file(file, "its header is no JSON object of a usual depth");
    return header;
}

}  // namespace

std::vector<TensorPlace> tensor_places(std::span<const std::byte> bytes, const fs::path& file) {
    const std::string_view whole(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::uint64_t length = header_length(whole, bytes.size(), file);
    const std::size_t payload_begin = sizeof length + length;
    const Json header = parse_header(whole.substr(sizeof length, length), file);
    std::vector<TensorPlace> tensors;
    for (Place& place : places_in(header, bytes.size() - payload_begin, file)) {
        tensors.push_back({.name = std::move(place.name),
                           .type = place.kind->type,
                           .shape = std::move(place.shape),
                           .bytes = bytes.subspan(payload_begin + place.begin, place.end - place.begin)});
    }
    return tensors;
}

TensorShapes read_tensor_shapes(const fs::path& file) {
    std::error_code problem;
    const std::size_t bytes = fs::file_size(file, problem);
    std::ifstream stream(file, std::ios::binary);
    if (problem || !stream)
        throw Error(format("{}: cannot be read; check its path and rights", file.string()));
    const auto read = [&](std::size_t count) {
        std::string text(count, '\0');
        stream.read(text.data(), static_cast<std::streamsize>(count));
        text.resize(static_cast<std::size_t>(stream.gcount()));
        return text;
    };
    const std::uint64_t length = header_length(read(sizeof length), bytes, file);
    TensorShapes shapes;
    for (Place& place : places_in(parse_header(read(length), file), bytes - sizeof length - length, file))
        shapes[place.name] = std::move(place.shape);
    return shapes;
}

void check_shape(const TensorShapes& shapes, const std::string& name, std::span<const std::int64_t> shape,
                 const fs::path& file) {
    const auto found = shapes.find(name);
    if (found == shapes.end()) {
        throw Error(
            format("{}: tensor \"{}\" is missing; give a file of the same model", file.string(), name));
    }
    if (!std::ranges::equal(found->second, shape)) {
        throw Error(
            format("{}: tensor \"{}\" has the shape [{}], the model needs [{}]; give a file of the "
                   "same model and options",
                   file.string(), name, fmt::join(found->second, ", "), fmt::join(shape, ", ")));
    }
}

}  // namespace chironomia
