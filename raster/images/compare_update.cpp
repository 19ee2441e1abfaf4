#include <fcntl.h>
#include <stdio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/files/files.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_reader.h"
#include "raster/images/compare_folders.h"
#include "raster/images/compare_sets.h"
#include "raster/images/image_file.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// A reference that cannot be read would fail for ever.
void expect_readable(const fs::path& file) {
    if (has_image_name(file) || is_image(file)) {
        read_image(file);
        return;
    }
    ClipReader reader(file);
    while (reader.next()) {
    }
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    return fs::exists(a) && fs::file_size(a) == fs::file_size(b) && read_bytes(a) == read_bytes(b);
}

SetUpdate count_update(const fs::path& expected, const fs::path& actual,
                       const std::map<std::string, FileMatch>& matches) {
    SetUpdate update;
    for (const auto& [name, there] : matches) {
        if (!there.actual) {
            ++update.removed;
        } else if (!there.expected) {
            ++update.added;
        } else {
            ++(is_same_file(expected / name, actual / name) ? update.kept : update.changed);
        }
    }
    return update;
}

void expect_apart(const fs::path& expected, const fs::path& actual) {
    if (lies_within(expected, actual) || lies_within(actual, expected)) {
        throw Error(format("{}: lies within {} or holds it; keep references and results apart",
                           expected.string(), actual.string()));
    }
}

// Whether one of the names, ascending, lies in the folder.
bool holds_one(const std::string& folder, const std::vector<std::string>& names) {
    const auto next = std::lower_bound(names.begin(), names.end(), folder + "/");
    return next != names.end() && next->starts_with(folder + "/");
}

// Everything in the folder that is not compared, and the permissions of folders. In the place of a link to a folder of
// references stands the folder.
void copy_companions(const fs::path& from, const fs::path& to) {
    const std::vector<std::string> compared = compared_files(from);
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
        const std::string name = entry.path().lexically_relative(from).generic_string();
        const fs::path place = to / name;
        if (std::binary_search(compared.begin(), compared.end(), name)) continue;
        if (entry.is_directory() && holds_one(name, compared) && !fs::exists(place)) continue;  // all removed
        if (entry.is_symlink() && fs::exists(place)) continue;
        if (entry.is_directory() && !entry.is_symlink()) {
            fs::create_directories(place);
        } else {
            fs::create_directories(place.parent_path());
            fs::copy(entry.path(), place, fs::copy_options::copy_symlinks);
        }
    }
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
        const fs::path place = to / entry.path().lexically_relative(from);
        if (entry.is_directory() && !entry.is_symlink() && fs::exists(place))
            fs::permissions(place, entry.status().permissions());
    }
    fs::permissions(to, fs::status(from).permissions());
}

// Puts a finished folder in the place of another by one move; the other is then at `made`.
void exchange(const fs::path& made, const fs::path& place) {
    if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0) return;
    if (errno == EBUSY) {
        throw Error(
            format("{}: is mounted there, so it cannot be replaced; keep the references in a folder in it",
                   place.string()));
    }
    throw Error(format("{}: cannot be replaced in one move ({}); remove it and accept the results again",
                       place.string(), std::strerror(errno)));
}

SetUpdate update_folder(const fs::path& expected, const fs::path& actual) {
    const bool is_new = !fs::exists(expected);
    if (!is_new && fs::exists(expected / ".git"))
        throw Error(format("{}: holds a repository; name a folder of references alone", expected.string()));
    const std::vector<std::string> results = compared_files(actual);
    if (results.empty()) {
        throw Error(
            format("{}: holds no .png, .exr, .mp4 or .webm to accept; render it again", actual.string()));
    }
    for (const std::string& name : results) expect_readable(actual / name);
    const SetUpdate update = is_new ? SetUpdate{.added = results.size()}
                                    : count_update(expected, actual, match_files(expected, actual));

    // The references grow in a hidden folder beside their own.
    const fs::path place = fs::weakly_canonical(fs::absolute(expected));
    const fs::path made = place.parent_path() / format(".{}.accepted", place.filename().string());
    PendingOutput output(made, PendingOutput::Kind::folder);
    for (const std::string& name : results) {
        fs::create_directories((output.path() / name).parent_path());
        fs::copy_file(actual / name, output.path() / name);
    }
    if (is_new) {
        fs::rename(output.path(), place);
    } else {
        copy_companions(expected, output.path());
        exchange(output.path(), place);
        fs::remove_all(output.path());  // the references of before
    }
    return update;
}

SetUpdate update_file(const fs::path& expected, const fs::path& actual) {
    const auto ending = [](const fs::path& file) { return to_lower(file.extension().string()); };
    if (ending(expected) != ending(actual)) {
        throw Error(format("{}: cannot become {}, a file of another kind; give the reference its ending",
                           expected.string(), actual.string()));
    }
    expect_readable(actual);
    const bool is_new = !fs::exists(expected);
    if (!is_new && is_same_file(expected, actual)) return {.kept = 1};
    if (fs::is_symlink(expected)) {
        // As in a folder of references: the file takes the place of the link, and what it leads to is as it was.
        const fs::path made = expected.parent_path() / format(".{}.accepted", expected.filename().string());
        write_bytes(made, read_bytes(actual));
        fs::rename(made, expected);
    } else {
        write_bytes(expected, read_bytes(actual));
    }
    return is_new ? SetUpdate{.added = 1} : SetUpdate{.changed = 1};
}

}  // namespace

SetUpdate update_references(const fs::path& expected_path, const fs::path& actual) {
    // "references/" is the folder "references".
    const fs::path expected = expected_path.has_filename() ? expected_path : expected_path.parent_path();
    if (!fs::exists(actual))
        throw Error(format("{}: there is no such file; check the path", actual.string()));
    const bool is_folder = fs::is_directory(actual);
    if (fs::exists(expected) && fs::is_directory(expected) != is_folder) {
        throw Error(format("{}: is a {}, {} is a {}; both must be of one kind", expected.string(),
                           is_folder ? "file" : "folder", actual.string(), is_folder ? "folder" : "file"));
    }
    expect_apart(expected, actual);
    try {
        return is_folder ? update_folder(expected, actual) : update_file(expected, actual);
    } catch (const fs::filesystem_error& fault) {
        throw Error(format("{}: cannot be written ({}); check free space and permissions", expected.string(),
                           fault.code().message()));
    }
}

}  // namespace chironomia
