#include "core/files/zip_archive.h"

#include <zip.h>

#include "core/error.h"
#include "core/files/private_output.h"
#include "core/files/scratch_folder.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr zip_uint16_t kFirstOfJanuary1980 = 1 << 5 | 1;  // as MS-DOS writes dates
constexpr zip_uint32_t kPlainFile = 0100644u << 16;       // read by all, written by the owner

struct CloseFile {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

[[noreturn]] void complain(const std::filesystem::path& out, zip_t* archive) {
    throw Error(format("{}: cannot be written: {}; check that the disk has space", out.string(),
                       zip_strerror(archive)));
}

void add_entry(zip_t* archive, const ZipEntry& entry, const std::filesystem::path& out) {
    zip_source_t* source = entry.file.empty()
                               ? zip_source_buffer(archive, entry.text.data(), entry.text.size(), 0)
                               : zip_source_file(archive, entry.file.c_str(), 0, -1);
    const zip_int64_t index =
        source ? zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
        if (source) zip_source_free(source);
        complain(out, archive);
    }
    const auto place = static_cast<zip_uint64_t>(index);
    const bool plain = zip_set_file_compression(archive, place, ZIP_CM_STORE, 0) == 0 &&
                       zip_file_set_dostime(archive, place, 0, kFirstOfJanuary1980, 0) == 0 &&
                       zip_file_set_external_attributes(archive, place, 0, ZIP_OPSYS_UNIX, kPlainFile) == 0;
    if (!plain) complain(out, archive);
}

}  // namespace

void ZipReader::Close::operator()(zip* archive) const {
    zip_discard(archive);
}

ZipReader::ZipReader(std::span<const std::byte> bytes, std::string where) : where_(std::move(where)) {
    zip_error_t problem;
    zip_error_init(&problem);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &problem);
    archive_.reset(source ? zip_open_from_source(source, ZIP_RDONLY, &problem) : nullptr);
    const std::string reason = archive_ ? "" : zip_error_strerror(&problem);
    if (!archive_ && source) zip_source_free(source);
    zip_error_fini(&problem);
    if (!archive_)
        throw Error(format("{}: this is no whole zip archive: {}; write it again", where_, reason));
}

std::size_t ZipReader::size() const {
    return static_cast<std::size_t>(zip_get_num_entries(archive_.get(), 0));
}

std::string ZipReader::name(std::size_t entry) const {
    const char* name = zip_get_name(archive_.get(), entry, 0);
    return name ? name : "";
}

std::vector<std::byte> ZipReader::read(std::size_t entry, std::size_t most_bytes,
                                       const std::string& where) const {
    const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen_index(archive_.get(), entry, 0));
    if (!file) throw Error(format("{}: cannot be unpacked: {}", where, zip_strerror(archive_.get())));
    std::vector<std::byte> bytes;
    for (std::vector<std::byte> part(std::size_t{1} << 16);;) {
        const zip_int64_t got = zip_fread(file.get(), part.data(), part.size());
        if (got < 0) throw Error(format("{}: cannot be unpacked: {}", where, zip_file_strerror(file.get())));
        if (got == 0) return bytes;
        bytes.insert(bytes.end(), part.begin(), part.begin() + got);
        if (bytes.size() > most_bytes)
            throw Error(format("{}: unpacks to more than the {} bytes that are read of such a file", where,
                               most_bytes));
    }
}

void write_zip(const std::filesystem::path& out, const std::vector<ZipEntry>& entries, bool is_private) {
    const PendingOutput checked(out, PendingOutput::Kind::file);
    if (is_private) keep_private(checked);
    // libzip puts a file of its own in the place of the one that it is given.
    const ScratchFolder scratch = ScratchFolder::within(checked.path().parent_path());
    const std::filesystem::path made = scratch.path() / "archive";
    int code = 0;
    zip_t* archive = zip_open(made.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (!archive) {
        throw Error(
            format("{}: cannot be written ({}); check the path and its permissions", out.string(), code));
    }
    try {
        for (const ZipEntry& entry : entries) add_entry(archive, entry, out);
        if (zip_close(archive) != 0) complain(out, archive);
    } catch (...) {
        zip_discard(archive);
        throw;
    }
    std::filesystem::permissions(made, std::filesystem::status(checked.path()).permissions());
    scratch.move_out(made.filename(), checked.final_path());
}

}  // namespace chironomia
