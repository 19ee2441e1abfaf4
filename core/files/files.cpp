#include "core/files/files.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "core/files/byte_order_mark.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

fs::path partial_name(const fs::path& final_path) {
    constexpr std::size_t kLongest = 255;  // bytes of a name that the system takes
    const std::string name = final_path.filename().string();
    std::string hidden = format(".{}.partial", name);
    if (hidden.size() > kLongest) hidden = format(".{}.partial", sha256(name));
    return final_path.parent_path() / hidden;
}

// What this process makes under hidden names, so that it knows its own from those of another run. Each is kept open, as
// the system would give its number to the next file otherwise.
class OwnPartials {
  public:
    static void add(const PendingOutput& output) {
        const std::scoped_lock lock(mutex_);
        open_[&output] = ::open(output.path().c_str(), O_PATH | O_CLOEXEC);
    }

    // Whether what lies there now is what was added, as far as the system said what that was.
    static bool take(const PendingOutput& output) {
        const std::scoped_lock lock(mutex_);
        const auto node = open_.extract(&output);
        if (node.empty()) return false;
        if (node.mapped() < 0) return true;
        const Status own = status_of(::fstat, node.mapped());
        const Status there = status_of(::stat, output.path().c_str());
        ::close(node.mapped());
        return own.st_dev == there.st_dev && own.st_ino == there.st_ino;
    }

  private:
    using Status = struct stat;

    // 0 throughout where there is nothing.
    template <typename Where>
    static Status status_of(int (*read)(Where, Status*), Where where) {
        Status status = {};
        if (read(where, &status) != 0) status = {};
        return status;
    }

    static inline std::mutex mutex_;
    static inline std::map<const PendingOutput*, int> open_;
};

// "clips/" is the folder "clips", and not what lies in it.
fs::path without_last_slash(fs::path path) {
    return path.has_filename() || !path.has_relative_path() ? path : path.parent_path();
}

// Where links lead, so that they stay and what they name is made or replaced. At most as many as the system follows.
fs::path followed(fs::path path) {
    constexpr int kMostLinks = 40;
    std::error_code none;
    for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, none)); ++i)
        path = without_last_slash(path.parent_path() / fs::read_symlink(path, none));
    return path;
}

void refuse_what_is_there(const fs::path& place, const fs::file_status& there, PendingOutput::Kind kind) {
    const std::string name = place.string();
    const bool is_folder = kind == PendingOutput::Kind::folder;
    const std::string what = is_folder ? "a new folder" : "a file to write";
    if (!fs::exists(there)) return;
    if (!fs::is_directory(there) && !fs::is_regular_file(there))
        throw Error(format("{}: this is a pipe or a device; name {}", name, what));
    if (!is_folder && fs::is_directory(there))
        throw Error(format("{}: this is a folder; name {}", name, what));
    if (is_folder && !(fs::is_directory(there) && fs::is_empty(place)))
        throw Error(format("{}: already holds something; name a new folder or remove this one", name));
    if (::access(place.c_str(), W_OK) != 0) {
        throw Error(format("{}: may not be replaced ({}); change its permissions, or name {}", name,
                           std::strerror(errno), what));
    }
}

std::ifstream open_to_read(const fs::path& file) {
    expect_file(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(
            format("{}: cannot be opened ({}); check its permissions", file.string(), std::strerror(errno)));
    }
    return stream;
}

template <typename Container>
Container read_all(const fs::path& file) {
    std::ifstream stream = open_to_read(file);
    Container content(fs::file_size(file), typename Container::value_type{});
    stream.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(content.size()));
    if (static_cast<size_t>(stream.gcount()) != content.size()) {
        throw Error(format("{}: only {} of {} bytes could be read; check the disk", file.string(),
                           stream.gcount(), content.size()));
    }
    return content;
}

void write_all(const fs::path& file, const char* data, size_t size) {
    PendingOutput output(file, PendingOutput::Kind::file);
    std::ofstream stream(output.path(), std::ios::binary | std::ios::trunc);
    stream.write(data, static_cast<std::streamsize>(size));
    stream.close();
    if (!stream) {
        throw Error(format("{}: cannot write {} bytes ({}); check free space and permissions", file.string(),
                           size, std::strerror(errno)));
    }
    output.commit();
}

}  // namespace

std::string read_text(const fs::path& file) {
    std::string text = read_all<std::string>(file);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    return text;
}

std::vector<std::byte> read_bytes(const fs::path& file) {
    return read_all<std::vector<std::byte>>(file);
}

void write_text(const fs::path& file, std::string_view text) {
    write_all(file, text.data(), text.size());
}

void write_bytes(const fs::path& file, std::span<const std::byte> bytes) {
    write_all(file, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

PendingOutput::PendingOutput(fs::path final_path, Kind kind)
    : final_(kind == Kind::folder ? without_last_slash(std::move(final_path)) : std::move(final_path)) {
    std::error_code problem;
    const fs::file_status there = fs::status(final_, problem);
    if (there.type() == fs::file_type::none) {
        throw Error(
            format("{}: cannot be written ({}); choose another name", final_.string(), problem.message()));
    }
    refuse_what_is_there(final_, there, kind);
    if (kind == Kind::file && !final_.has_filename())
        throw Error(format("{}: ends like a folder; name a file to write", final_.string()));
    final_ = followed(final_);
    partial_ = partial_name(final_);
    if (final_.has_parent_path()) fs::create_directories(final_.parent_path(), problem);
    fs::remove_all(partial_, problem);
    const bool made = kind == Kind::folder ? fs::create_directory(partial_, problem)
                                           : std::ofstream(partial_, std::ios::binary).good();
    if (!made) {
        throw Error(format("{}: cannot be written ({}); check that the folder exists and is writable",
                           final_.string(), problem ? problem.message() : std::strerror(errno)));
    }
    OwnPartials::add(*this);
    if (fs::exists(there)) fs::permissions(partial_, there.permissions(), problem);
}

PendingOutput::~PendingOutput() {
    std::error_code ignored;
    if (!committed_ && OwnPartials::take(*this)) fs::remove_all(partial_, ignored);
}

void PendingOutput::commit() {
    if (!OwnPartials::take(*this)) {
        throw Error(
            format("{}: another run began to write it meanwhile; let each run write a name of its own",
                   final_.string()));
    }
    std::error_code problem;
    fs::rename(partial_, final_, problem);
    if (problem) {
        OwnPartials::add(*this);
        throw Error(format("{}: cannot be put in place ({})", final_.string(), problem.message()));
    }
    committed_ = true;
}

fs::path find_asset(const fs::path& relative) {
    std::vector<fs::path> homes;
    if (const char* home = std::getenv("CHIRONOMIA_HOME")) homes.emplace_back(home);
    std::error_code ignored;
    const fs::path executable = fs::read_symlink("/proc/self/exe", ignored);
    homes.push_back(executable.parent_path().parent_path() / "share/chironomia");
    homes.emplace_back(CHIRONOMIA_SOURCE_DIR);
    std::vector<std::string> tried;
    for (const fs::path& home : homes) {
        if (fs::exists(home / relative)) return home / relative;
        tried.push_back(home.string());
    }
    throw Error(
        format("{}: this bundled file is in none of {}; set CHIRONOMIA_HOME to the folder that holds it",
               relative.string(), join(tried)));
}

}  // namespace chironomia
