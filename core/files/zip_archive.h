// Zip archives: reading them from memory, and writing them with the same bytes every time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct zip;

namespace chironomia {

class ZipReader {
  public:
    // `bytes` must outlive the reader; `where` names the archive in messages. Throws Error if it is no whole archive.
    ZipReader(std::span<const std::byte> bytes, std::string where);

    std::size_t size() const;                   // entries
    std::string name(std::size_t entry) const;  // "" if it has none

    // Throws Error, which names `where`, if the entry is damaged or unpacks to more than `most_bytes`.
    std::vector<std::byte> read(std::size_t entry, std::size_t most_bytes, const std::string& where) const;

  private:
    struct Close {
        void operator()(zip* archive) const;
    };
    std::string where_;
    std::unique_ptr<zip, Close> archive_;
};

// An entry: the content of a file, or a text.
struct ZipEntry {
    std::string name;            // "public/pages.json"
    std::filesystem::path file;  // empty: the text
    std::string text;
};

// Writes the entries in their order, stored as they are, all with one date (the first of 1980, the least that zip has)
// and one permission: the same entries give the same bytes. The archive appears whole or not at all. Throws Error if a
// file cannot be read or the archive cannot be written.
//   is_private   a new archive can be read by the user of this program alone
void write_zip(const std::filesystem::path& out, const std::vector<ZipEntry>& entries,
               bool is_private = false);

}  // namespace chironomia
