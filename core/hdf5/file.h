// HDF5 files as trees of arrays, read without trusting a byte of them. The HDF5 library follows the addresses
// of a file of the layout before 1.8, which has no checksums, wherever damage points them, and breaks down;
// so files are read by this small reader of our own, and the library only writes.
//
// What is read: superblocks 0 to 3; groups as symbol tables or as links in their header (up to 8, as the
// newest layouts keep them); arrays in one piece, in their header or in chunks with a B-tree of version 1 or
// alone, plain or with the filters deflate, shuffle and Fletcher32; integers, IEEE floats, texts of fixed and
// of variable length, sequences of bytes; attributes of one number or text. That is all that h5py writes by
// default, with libver="v108" and, but for chunks, with libver="latest". After "HDF5 File Format
// Specification", version 3.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hdf5/array.h"
#include "core/hdf5/bytes.h"

namespace chironomia {

bool is_hdf5(std::span<const std::byte> bytes);

class Hdf5File {
  public:
    // `bytes` must outlive it.
    //   where   the file's name, for messages
    // Throws Error if it is no HDF5 file, or a truncated one.
    Hdf5File(std::span<const std::byte> bytes, std::string where);

    // "pose/data"; "" is the root. Throw Error if something on the way is broken.
    bool has(std::string_view path) const;
    // The names in the group at `path`, sorted; none if there is no group.
    std::vector<std::string> names_in(std::string_view path) const;
    std::vector<size_t> shape_of(std::string_view path) const;
    // Throws Error if there is no array at `path`, it is broken, is kept in a form that is not read, or is
    // larger than 1 GiB.
    Hdf5Array read(std::string_view path) const;
    // The numbers of an array whose shape must be `shape`; kAny fits any extent. Throws Error as read() does,
    // if the shape is another or if a number is not finite or not below a thousand million.
    static constexpr size_t kAny = ~size_t{0};
    std::vector<double> read_numbers(const std::string& path, const std::vector<size_t>& shape) const;
    // The texts of an array of one dimension. Throws Error as read() does and if it holds no texts.
    std::vector<std::string> read_texts(const std::string& path) const;
    // The attribute of one number, or of one text, that the object at `path` has, if it has it.
    std::optional<double> attribute(std::string_view path, std::string_view name) const;
    std::optional<std::string> text_attribute(std::string_view path, std::string_view name) const;

    const std::string& where() const { return where_; }
    [[noreturn]] void refuse(const std::string& message) const;

  private:
    struct Message {
        unsigned type = 0;
        bool shared = false;  // the data is only a reference to another place
        std::span<const std::byte> data;
    };
    using Messages = std::vector<Message>;
    using Links = std::map<std::string, std::uint64_t, std::less<>>;  // name: address of the object

    std::uint64_t find_root() const;
    Messages messages_at(std::uint64_t address) const;
    Messages old_messages(std::uint64_t address) const;
    Messages new_messages(std::uint64_t address) const;
    Links links_of(const Messages& messages) const;
    void read_symbols(Hdf5Cursor node, std::string_view names, Links& links) const;
    void read_symbol_table(std::uint64_t tree, std::uint64_t heap, Links& links) const;
    std::optional<Messages> find(std::string_view path) const;
    Messages need(std::string_view path) const;
    std::optional<Hdf5Array> find_attribute(std::string_view path, std::string_view name) const;
    Hdf5Place place_of(std::string_view path) const;
    void check_shape(const std::string& path, const std::vector<size_t>& shape) const;

    std::span<const std::byte> bytes_;
    std::string where_;
    std::uint64_t root_ = 0;
};

}  // namespace chironomia
