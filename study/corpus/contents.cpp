#include "study/corpus/contents.h"

#include <algorithm>
#include <fstream>

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

// The file itself, or the files right in a folder.
std::vector<fs::path> files_of(const fs::path& path) {
    if (!fs::is_directory(path)) return {path};
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(path))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::uintmax_t bytes_in(const fs::path& path) {
    std::uintmax_t bytes = 0;
    for (const fs::path& file : files_of(path)) bytes += fs::file_size(file);
    return bytes;
}

// Block by block, so that files that differ are read as far as their first difference.
bool have_same_bytes(const fs::path& a, const fs::path& b) {
    constexpr std::size_t kBlock = 1 << 20;
    if (fs::equivalent(a, b)) return true;
    if (fs::file_size(a) != fs::file_size(b)) return false;
    std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
    std::vector<char> left(kBlock), right(kBlock);
    while (first && second) {
        first.read(left.data(), kBlock);
        second.read(right.data(), kBlock);
        if (first.gcount() != second.gcount() ||
            !std::equal(left.begin(), left.begin() + first.gcount(), right.begin()))
            return false;
    }
    return first.eof() && second.eof();
}

}  // namespace

bool have_same_contents(const fs::path& a, const fs::path& b) {
    return std::ranges::equal(files_of(a), files_of(b), have_same_bytes);
}

fs::path RecordingContents::first_like(const fs::path& path) {
    std::vector<fs::path>& others = by_bytes_[bytes_in(path)];
    const auto found =
        std::ranges::find_if(others, [&](const fs::path& other) { return have_same_contents(other, path); });
    if (found != others.end()) return *found;
    others.push_back(path);
    return path;
}

}  // namespace chironomia::study
