#include "core/hdf5/file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/hdf5/array.h"
#include "core/hdf5/bytes.h"
#include "core/text.h"

namespace chironomia {
namespace {

// Messages of an object's header.
constexpr unsigned kDataspace = 0x01, kLinkInfo = 0x02, kDatatype = 0x03, kLink = 0x06, kLayout = 0x08,
                   kFilters = 0x0b, kAttribute = 0x0c, kContinuation = 0x10, kSymbolTable = 0x11;
constexpr size_t kMostBlocks = 1000;  // of one header
constexpr size_t kMostNodes = 1000;   // of one group's tree
constexpr unsigned kLinkByName = 2;

struct Block {
    std::uint64_t at = 0, size = 0;
};

Block continued_at(std::span<const std::byte> message, const std::string& where) {
    Hdf5Cursor cursor(message, where);
    const std::uint64_t at = cursor.number(8);
    return {.at = at, .size = cursor.number(8)};
}

// The last four bytes of a block guard those before them.
std::span<const std::byte> guarded(std::span<const std::byte> block, const std::string& where) {
    if (block.size() < 4) refuse_damage(where, "a header has no room for its checksum");
    const auto body = block.first(block.size() - 4);
    if (Hdf5Cursor(block.last(4), where).number(4) != hdf5_checksum(body))
        refuse_damage(where, "the checksum of a header does not fit");
    return body;
}

// The messages of a header that describe its array.
template <typename Messages>
Hdf5ArrayHeader header_of(const Messages& messages, const Hdf5Place& place) {
    Hdf5ArrayHeader header;
    for (const auto& message : messages) {
        const bool of_array = message.type == kDataspace || message.type == kDatatype;
        if (of_array && message.shared) {
            throw Error(
                format("{}: /{} shares its type with another array, which is not read; write it with "
                       "a type of its own",
                       place.where, place.path));
        }
        if (message.type == kDataspace) header.space = message.data;
        if (message.type == kDatatype) header.type = message.data;
        if (message.type == kLayout) header.layout = message.data;
        if (message.type == kFilters) header.filters = message.data;
    }
    if (header.layout.empty()) throw Error(format("{}: /{} is no array", place.where, place.path));
    return header;
}

std::string shape_text(const std::vector<size_t>& shape) {
    return format("({})", fmt::join(shape, ", "));
}

}  // namespace

bool is_hdf5(std::span<const std::byte> bytes) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())
        .starts_with("\x89HDF\r\n\x1a\n");
}

Hdf5File::Hdf5File(std::span<const std::byte> bytes, std::string where)
    : bytes_(bytes), where_(std::move(where)), root_(find_root()) {}

void Hdf5File::refuse(const std::string& message) const {
    throw Error(format("{}: {}", where_, message));
}

std::uint64_t Hdf5File::find_root() const {
    Hdf5Cursor cursor(bytes_, where_);
    cursor.expect("\x89HDF\r\n\x1a\n");
    const auto version = cursor.number(1);
    if (version > 3)
        refuse_damage(where_, format("its superblock has the version {}; 0 to 3 are known", version));
    const bool old = version < 2;
    if (old) cursor.skip(4);
    const auto offsets = cursor.number(1), lengths = cursor.number(1);
    if (offsets != 8 || lengths != 8) {
        refuse_damage(where_,
                      format("addresses of {} and lengths of {} bytes, where 8 are usual", offsets, lengths));
    }
    cursor.skip(!old ? 1 : version == 0 ? 9 : 13);
    if (const auto base = cursor.number(8); base != 0)
        refuse(format("its content begins at byte {}, after a block of the user's; leave it out", base));
    cursor.skip(8);
    if (const auto end = cursor.number(8); end > bytes_.size())
        refuse_damage(where_, format("it has {} bytes of {}", bytes_.size(), end));
    if (old) cursor.skip(16);
    const auto root = cursor.number(8);
    if (!old) guarded(hdf5_at(bytes_, 0, where_).take(48), where_);
    return root;
}

Hdf5File::Messages Hdf5File::messages_at(std::uint64_t address) const {
    Hdf5Cursor cursor = hdf5_at(bytes_, address, where_);
    return cursor.left() >= 4 && cursor.text(4) == "OHDR" ? new_messages(address) : old_messages(address);
}

Hdf5File::Messages Hdf5File::old_messages(std::uint64_t address) const {
    Hdf5Cursor header = hdf5_at(bytes_, address, where_);
    if (header.number(1) != 1) refuse_damage(where_, format("byte {} is no header of an object", address));
    header.skip(1);
    auto count = header.number(2);
    header.skip(4);
    std::vector<Block> blocks = {{.at = address + 16, .size = header.number(4)}};
    Messages messages;
    for (size_t b = 0; b < blocks.size() && count > 0; ++b) {
        Hdf5Cursor block(hdf5_at(bytes_, blocks[b].at, where_).take(blocks[b].size), where_);
        for (; count > 0 && block.left() >= 8; --count) {
            const auto type = static_cast<unsigned>(block.number(2));
            const auto size = block.number(2);
            const bool shared = (block.number(1) & 2) != 0;
            block.skip(3);
            const auto data = block.take(size);
            if (type == kContinuation)
                blocks.push_back(continued_at(data, where_));
            else
                messages.push_back({.type = type, .shared = shared, .data = data});
        }
    }
    return messages;
}

Hdf5File::Messages Hdf5File::new_messages(std::uint64_t address) const {
    Hdf5Cursor header = hdf5_at(bytes_, address, where_);
    header.expect("OHDR");
    if (const auto version = header.number(1); version != 2)
        refuse_damage(where_, format("the header of an object has the version {}", version));
    const auto flags = header.number(1);
    const std::uint64_t before = 6 + (flags & 0x20 ? 16u : 0u) + (flags & 0x10 ? 4u : 0u);
    header.skip(before - 6);
    const std::uint64_t size_bytes = std::uint64_t{1} << (flags & 3);
    const auto first_size = header.number(size_bytes);
    if (first_size > bytes_.size()) refuse_damage(where_, "the header of an object goes beyond the end");
    std::vector<Block> blocks = {{.at = address, .size = before + size_bytes + first_size + 4}};
    std::uint64_t skipped = before + size_bytes;
    Messages messages;
    for (size_t b = 0; b < blocks.size(); ++b) {
        const auto body = guarded(hdf5_at(bytes_, blocks[b].at, where_).take(blocks[b].size), where_);
        Hdf5Cursor block(body, where_);
        if (b > 0) block.expect("OCHK");
        if (b == 0) block.skip(skipped);
        for (const size_t head = flags & 0x04 ? 6 : 4; block.left() >= head;) {
            const auto type = static_cast<unsigned>(block.number(1));
            const auto size = block.number(2);
            const bool shared = (block.number(1) & 2) != 0;
            block.skip(head - 4);
            const auto data = block.take(size);
            if (type == kContinuation)
                blocks.push_back(continued_at(data, where_));
            else
                messages.push_back({.type = type, .shared = shared, .data = data});
        }
        if (blocks.size() > kMostBlocks) refuse_damage(where_, "the header of an object has no end");
    }
    return messages;
}

// The entries of one leaf of a group's tree, whose names lie in `names`.
void Hdf5File::read_symbols(Hdf5Cursor node, std::string_view names, Links& links) const {
    node.skip(2);
    for (auto left = node.number(2); left > 0; --left) {
        const auto name = node.number(8), address = node.number(8), kind = node.number(4);
        node.skip(20);
        if (name >= names.size()) refuse_damage(where_, "a name lies behind the names");
        const std::string_view text = names.substr(static_cast<size_t>(name));
        // A link by name to somewhere else has no address.
        if (kind != kLinkByName) links.emplace(text.substr(0, text.find('\0')), address);
    }
}

void Hdf5File::read_symbol_table(std::uint64_t tree, std::uint64_t heap, Links& links) const {
    Hdf5Cursor names = hdf5_at(bytes_, heap, where_);
    names.expect("HEAP");
    names.skip(4);
    const auto size = names.number(8);
    names.skip(8);
    const auto texts = hdf5_at(bytes_, names.number(8), where_).text(size);
    std::vector<std::uint64_t> nodes = {tree};
    for (size_t n = 0; n < nodes.size(); ++n) {
        if (nodes.size() > kMostNodes) refuse_damage(where_, "a group has no end");
        Hdf5Cursor node = hdf5_at(bytes_, nodes[n], where_);
        const std::string_view signature = node.text(4);
        if (signature == "SNOD") {
            read_symbols(node, texts, links);
            continue;
        }
        if (signature != "TREE" || node.number(1) != 0)
            refuse_damage(where_, "the entries of a group are not where they should be");
        node.skip(1);
        const auto entries = node.number(2);
        node.skip(16);
        for (std::uint64_t i = 0; i < entries; ++i) {
            node.skip(8);
            nodes.push_back(node.number(8));
        }
    }
}

Hdf5File::Links Hdf5File::links_of(const Messages& messages) const {
    Links links;
    for (const Message& one : messages) {
        const unsigned type = one.type;
        Hdf5Cursor message(one.data, where_);
        if (type == kSymbolTable) {
            const auto tree = message.number(8);
            read_symbol_table(tree, message.number(8), links);
        } else if (type == kLinkInfo) {
            message.skip(1);
            message.skip(message.number(1) & 1 ? 8 : 0);
            if (message.number(8) == kNowhere) continue;
            refuse(
                "a group of more than 8 entries is kept in a form of the newer layouts that is not read; "
                "write it with h5py.File(...) without libver");
        } else if (type == kLink) {
            message.skip(1);
            const auto flags = message.number(1);
            const auto kind = flags & 0x08 ? message.number(1) : 0;
            message.skip((flags & 0x04 ? 8u : 0u) + (flags & 0x10 ? 1u : 0u));
            const auto length = message.number(size_t{1} << (flags & 3));
            const std::string name(message.text(length));
            if (kind == 0) links.emplace(name, message.number(8));
        }
    }
    return links;
}

std::optional<Hdf5File::Messages> Hdf5File::find(std::string_view path) const {
    Messages messages = messages_at(root_);
    if (path.empty()) return messages;
    for (const std::string_view name : split(path, '/')) {
        const Links links = links_of(messages);
        const auto link = links.find(name);
        if (link == links.end()) return std::nullopt;
        messages = messages_at(link->second);
    }
    return messages;
}

bool Hdf5File::has(std::string_view path) const {
    return find(path).has_value();
}

std::vector<std::string> Hdf5File::names_in(std::string_view path) const {
    std::vector<std::string> names;
    const auto messages = find(path);
    if (!messages) return names;
    for (const auto& [name, address] : links_of(*messages)) names.push_back(name);
    return names;
}

Hdf5Place Hdf5File::place_of(std::string_view path) const {
    return {.file = bytes_, .where = where_, .path = std::string(path)};
}

Hdf5File::Messages Hdf5File::need(std::string_view path) const {
    auto messages = find(path);
    if (!messages) refuse(format("/{} is missing", path));
    return std::move(*messages);
}

std::vector<size_t> Hdf5File::shape_of(std::string_view path) const {
    const Hdf5Place place = place_of(path);
    return hdf5_shape(header_of(need(path), place), place);
}

Hdf5Array Hdf5File::read(std::string_view path) const {
    const Hdf5Place place = place_of(path);
    return read_hdf5_array(header_of(need(path), place), place);
}

std::optional<Hdf5Array> Hdf5File::find_attribute(std::string_view path, std::string_view name) const {
    for (const Message& message : need(path)) {
        if (message.type != kAttribute || message.shared) continue;
        auto value = hdf5_attribute(message.data, name, place_of(path));
        if (value) return value;
    }
    return std::nullopt;
}

std::optional<double> Hdf5File::attribute(std::string_view path, std::string_view name) const {
    const auto value = find_attribute(path, name);
    if (!value || value->is_text) return std::nullopt;
    return value->numbers.at(0);
}

std::optional<std::string> Hdf5File::text_attribute(std::string_view path, std::string_view name) const {
    const auto value = find_attribute(path, name);
    if (!value || !value->is_text) return std::nullopt;
    return value->texts.at(0);
}

void Hdf5File::check_shape(const std::string& path, const std::vector<size_t>& shape) const {
    const std::vector<size_t> found = shape_of(path);
    const auto fits = [](size_t expected, size_t extent) { return expected == kAny || expected == extent; };
    if (std::equal(shape.begin(), shape.end(), found.begin(), found.end(), fits)) return;
    std::string expected = shape_text(shape);
    const std::string any = format("{}", kAny);
    for (size_t at; (at = expected.find(any)) != std::string::npos;) expected.replace(at, any.size(), "any");
    refuse(format("/{} has the shape {}; {} is expected", path, shape_text(found), expected));
}

std::vector<double> Hdf5File::read_numbers(const std::string& path, const std::vector<size_t>& shape) const {
    constexpr double kMostNumber = 1e9;  // no place, turn, rate or count is larger
    check_shape(path, shape);
    Hdf5Array array = read(path);
    const bool is_empty = std::find(array.shape.begin(), array.shape.end(), 0u) != array.shape.end();
    if (array.numbers.empty() && !is_empty) refuse(format("/{} holds no numbers", path));
    for (size_t i = 0; i < array.numbers.size(); ++i) {
        if (!(std::abs(array.numbers[i]) < kMostNumber)) {
            refuse(format("/{}: element {} is {}; all must be finite and below {}", path, i, array.numbers[i],
                          kMostNumber));
        }
    }
    return std::move(array.numbers);
}

std::vector<std::string> Hdf5File::read_texts(const std::string& path) const {
    check_shape(path, {kAny});
    Hdf5Array array = read(path);
    if (!array.is_text) refuse(format("/{} holds no texts", path));
    return std::move(array.texts);
}

}  // namespace chironomia
