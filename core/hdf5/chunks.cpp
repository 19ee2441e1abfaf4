#include "core/hdf5/chunks.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr size_t kMostChunk = size_t{64} << 20;  // [bytes]
constexpr size_t kLeastKey = 16;                 // of a chunk in its tree [bytes]
constexpr unsigned kDeflate = 1, kShuffle = 2, kFletcher32 = 3;
constexpr unsigned kSingleChunk = 1;  // of the ways in which layout 4 finds chunks

[[noreturn]] void refuse_damaged_chunk(const Hdf5Place& place) {
    refuse_damage(place.where, format("a chunk of /{} cannot be unpacked", place.path));
}

std::vector<std::byte> inflated(std::span<const std::byte> packed, size_t size, const Hdf5Place& place) {
    std::vector<std::byte> bytes(size);
    uLongf written = size;
    const int result = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (result != Z_OK || written != size) refuse_damaged_chunk(place);
    return bytes;
}

// Fletcher's sum of words of 16 bits, high byte first, as HDF5 folds it.
std::uint32_t fletcher32(std::span<const std::byte> bytes) {
    std::uint64_t low = 0, high = 0;
    const auto fold = [](std::uint64_t sum) { return (sum & 0xffff) + (sum >> 16); };
    for (size_t i = 0; i < bytes.size(); i += 2) {
        const auto second = i + 1 < bytes.size() ? static_cast<std::uint64_t>(bytes[i + 1]) : 0;
        low += static_cast<std::uint64_t>(bytes[i]) << 8 | second;
        high += low;
        if (i % 720 == 718) {  // where HDF5 folds its sums of 32 bits
            low = fold(low);
            high = fold(high);
        }
    }
    low = fold(fold(low));
    high = fold(fold(high));
    return static_cast<std::uint32_t>(high << 16 | low);
}

// The last four bytes guard those before them.
std::vector<std::byte> checked(std::vector<std::byte> bytes, const Hdf5Place& place) {
    if (bytes.size() < 4) refuse_damaged_chunk(place);
    const std::span<const std::byte> all(bytes);
    const auto stored = Hdf5Cursor(all.last(4), place.where).number(4);
    if (stored != fletcher32(all.first(all.size() - 4)))
        refuse_damage(place.where, format("the checksum of a chunk of /{} does not fit", place.path));
    bytes.resize(bytes.size() - 4);
    return bytes;
}

// All first bytes of the elements came first, then all second ones.
std::vector<std::byte> unshuffled(const std::vector<std::byte>& bytes, size_t element,
                                  const Hdf5Place& place) {
    if (element < 2) return bytes;
    if (element > bytes.size()) refuse_damaged_chunk(place);
    const size_t count = bytes.size() / element;
    std::vector<std::byte> result = bytes;
    for (size_t b = 0; b < element; ++b) {
        for (size_t i = 0; i < count; ++i) result[i * element + b] = bytes[b * count + i];
    }
    return result;
}

// Where a chunk lies in the array, and where in the file.
struct Chunk {
    std::vector<size_t> corner;
    std::uint64_t address = 0;
    std::uint64_t size = 0;      // packed [bytes]
    std::uint64_t left_out = 0;  // bit i: filter i was not applied
};

class ChunkReader {
  public:
    ChunkReader(const Hdf5Chunked& chunked, const Hdf5Place& place) : chunked_(chunked), place_(place) {
        shape_ = chunked.shape;
        if (shape_.empty()) refuse_damage(place.where, format("/{} is one element in chunks", place.path));
    }

    std::vector<std::byte> run() {
        const std::vector<Chunk> chunks = chunked_.version == 3 ? listed_by_tree() : single();
        if (chunks.size() != expected_) {
            refuse(place_, format("has {} of its {} chunks; write all of it", chunks.size(), expected_));
        }
        size_t size = chunked_.element;
        for (const size_t side : shape_) size *= side;
        result_.resize(size);
        for (const Chunk& chunk : chunks) place_chunk(chunk);
        return std::move(result_);
    }

  private:
    // The sides of a chunk; the last number of the message is the size of an element.
    void take_extent(Hdf5Cursor& layout, std::uint64_t sides, size_t width) {
        if (sides != shape_.size() + 1)
            refuse_damage(place_.where, format("the chunks of /{} have another shape", place_.path));
        chunk_bytes_ = chunked_.element;
        for (size_t d = 0; d < shape_.size(); ++d) {
            extent_.push_back(static_cast<size_t>(layout.number(width)));
            if (extent_[d] == 0 || extent_[d] > kMostChunk / chunk_bytes_)
                refuse(place_, "has empty chunks, or chunks larger than 64 MiB; choose smaller ones");
            chunk_bytes_ *= extent_[d];
            expected_ *= (shape_[d] + extent_[d] - 1) / extent_[d];
        }
        layout.skip(width);
        if (expected_ > place_.file.size() / kLeastKey)
            refuse_damage(place_.where,
                          format("/{} has more chunks than the file has room for", place_.path));
    }

    std::vector<Chunk> listed_by_tree() {
        Hdf5Cursor layout = chunked_.layout;
        const auto sides = layout.number(1);
        const auto root = layout.number(8);
        take_extent(layout, sides, 4);
        std::vector<Chunk> chunks;
        if (root == kNowhere) return chunks;
        std::vector<std::uint64_t> nodes = {root};
        for (size_t n = 0; n < nodes.size(); ++n) {
            Hdf5Cursor node = hdf5_at(place_.file, nodes[n], place_.where);
            node.expect("TREE");
            if (node.number(1) != 1)
                refuse_damage(place_.where, "the tree of a group is where an array's should be");
            const auto level = node.number(1), entries = node.number(2);
            node.skip(16);
            for (std::uint64_t i = 0; i < entries; ++i) {
                Chunk chunk = next_chunk(node);
                // No array has more chunks, or more nodes above them, than it has places for chunks.
                if (chunks.size() + nodes.size() > 2 * expected_ + 1)
                    refuse_damage(place_.where, format("the chunks of /{} have no end", place_.path));
                if (level == 0)
                    chunks.push_back(std::move(chunk));
                else
                    nodes.push_back(chunk.address);
            }
        }
        return chunks;
    }

    Chunk next_chunk(Hdf5Cursor& node) const {
        Chunk chunk;
        chunk.size = node.number(4);
        chunk.left_out = node.number(4);
        for (size_t d = 0; d < shape_.size(); ++d)
            chunk.corner.push_back(static_cast<size_t>(node.number(8)));
        node.skip(8);
        chunk.address = node.number(8);
        return chunk;
    }

    // The layout of HDF5 1.10 for an array that is one chunk.
    std::vector<Chunk> single() {
        Hdf5Cursor layout = chunked_.layout;
        const auto flags = layout.number(1), sides = layout.number(1), width = layout.number(1);
        if (width < 1 || width > 8) refuse_damage(place_.where, "a chunk's side is no number");
        take_extent(layout, sides, static_cast<size_t>(width));
        if (layout.number(1) != kSingleChunk) {
            refuse(place_,
                   "is kept in chunks in the layout of HDF5 1.10, which is not read; write it with "
                   "h5py.File(..., libver=\"v108\") or without libver");
        }
        Chunk chunk{.corner = std::vector<size_t>(shape_.size(), 0), .size = chunk_bytes_};
        if (flags & 2) {
            chunk.size = layout.number(8);
            chunk.left_out = layout.number(4);
        }
        chunk.address = layout.number(8);
        return {chunk};
    }

    std::vector<std::byte> unpack(const Chunk& chunk) const {
        const auto packed = hdf5_at(place_.file, chunk.address, place_.where).take(chunk.size);
        std::vector<std::byte> bytes(packed.begin(), packed.end());
        for (size_t f = chunked_.filters.size(); f-- > 0;) {
            if (chunk.left_out >> f & 1) continue;
            const Hdf5Filter& filter = chunked_.filters[f];
            if (filter.id == kDeflate) bytes = inflated(bytes, chunk_bytes_, place_);
            if (filter.id == kShuffle)
                bytes = unshuffled(bytes, filter.values.empty() ? 1 : filter.values[0], place_);
            if (filter.id == kFletcher32) bytes = checked(std::move(bytes), place_);
        }
        if (bytes.size() != chunk_bytes_) refuse_damaged_chunk(place_);
        return bytes;
    }

    // Row by row into the array; what stands over its edges is left out.
    void place_chunk(const Chunk& chunk) {
        for (size_t d = 0; d < shape_.size(); ++d) {
            if (chunk.corner[d] >= shape_[d] || chunk.corner[d] % extent_[d] != 0)
                refuse_damage(place_.where, format("a chunk of /{} lies outside of it", place_.path));
        }
        const std::vector<std::byte> bytes = unpack(chunk);
        const size_t last = shape_.size() - 1;
        const size_t row = extent_[last] * chunked_.element;
        const size_t kept = std::min(extent_[last], shape_[last] - chunk.corner[last]) * chunked_.element;
        for (size_t from = 0; from < bytes.size(); from += row) {
            size_t index = from / row, to = 0, step = 1;
            bool inside = true;
            to = chunk.corner[last];
            step = shape_[last];
            for (size_t d = last; d-- > 0;) {
                const size_t at = chunk.corner[d] + index % extent_[d];
                index /= extent_[d];
                inside = inside && at < shape_[d];
                to += at * step;
                step *= shape_[d];
            }
            if (inside) std::memcpy(result_.data() + to * chunked_.element, bytes.data() + from, kept);
        }
    }

    const Hdf5Chunked& chunked_;
    const Hdf5Place& place_;
    std::vector<size_t> shape_;   // of the array
    std::vector<size_t> extent_;  // of a chunk
    size_t chunk_bytes_ = 0;      // unpacked
    size_t expected_ = 1;         // chunks
    std::vector<std::byte> result_;
};

}  // namespace

std::vector<Hdf5Filter> hdf5_filters(std::span<const std::byte> message, const Hdf5Place& place) {
    std::vector<Hdf5Filter> filters;
    if (message.empty()) return filters;
    Hdf5Cursor cursor(message, place.where);
    const auto version = cursor.number(1), count = cursor.number(1);
    if (version < 1 || version > 2) refuse_damage(place.where, "filters of an unknown version");
    if (version == 1) cursor.skip(6);
    for (std::uint64_t f = 0; f < count; ++f) {
        Hdf5Filter filter{.id = static_cast<unsigned>(cursor.number(2)), .values = {}};
        const auto name_size = version == 1 || filter.id >= 256 ? cursor.number(2) : 0;
        cursor.skip(2);
        const auto values = cursor.number(2);
        const std::string name(cursor.text(version == 1 ? (name_size + 7) / 8 * 8 : name_size));
        for (std::uint64_t i = 0; i < values; ++i)
            filter.values.push_back(static_cast<size_t>(cursor.number(4)));
        if (version == 1 && values % 2 == 1) cursor.skip(4);
        if (filter.id < kDeflate || filter.id > kFletcher32) {
            refuse(place, format("is packed by the filter {} \"{}\", which is not read; gzip is", filter.id,
                                 name.substr(0, name.find('\0')).substr(0, 40)));
        }
        filters.push_back(std::move(filter));
    }
    return filters;
}

std::vector<std::byte> read_hdf5_chunks(const Hdf5Chunked& chunked, const Hdf5Place& place) {
    return ChunkReader(chunked, place).run();
}

}  // namespace chironomia
