#include "raster/images/frame_stack.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "raster/images/image_file.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kDigits = "0123456789";

[[noreturn]] void refuse_pattern(const fs::path& pattern, std::string_view problem) {
    throw Error(format("{}: {}; write it like frames/%05d.png", pattern.string(), problem));
}

// The number between "%" and "d": "", "5" or "05".
int parse_digits(const fs::path& pattern, std::string_view text) {
    int digits = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), digits);
    const bool whole = text.empty() || (problem == std::errc() && end == text.data() + text.size());
    if (!whole || digits > 18) refuse_pattern(pattern, format("\"%{}d\" is no number of digits", text));
    return digits;
}

// The number at the end of "frame_00012".
std::optional<size_t> number_of(const fs::path& file) {
    const std::string stem = file.stem().string();
    const size_t last_other = stem.find_last_not_of(kDigits);
    const std::string digits = last_other == std::string::npos ? stem : stem.substr(last_other + 1);
    size_t number = 0;
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (digits.empty() || problem != std::errc()) return std::nullopt;
    return number;
}

}  // namespace

fs::path FrameStack::file(size_t index) const {
    return folder / format("{}{:0{}}{}", before, index, std::max(1, digits), after);
}

bool is_stack_pattern(const fs::path& pattern) {
    return pattern.filename().string().find('%') != std::string::npos;
}

FrameStack parse_stack_pattern(const fs::path& pattern) {
    FrameStack stack{.folder = pattern.parent_path(), .before = {}, .digits = 0, .after = {}};
    const std::string name = pattern.filename().string();
    bool numbered = false;
    for (size_t i = 0; i < name.size(); ++i) {
        std::string& text = numbered ? stack.after : stack.before;
        if (name[i] != '%') {
            text.push_back(name[i]);
        } else if (i + 1 < name.size() && name[i + 1] == '%') {
            text.push_back(name[i++]);
        } else {
            const size_t end = name.find_first_not_of(kDigits, i + 1);
            if (end == std::string::npos || name[end] != 'd')
                refuse_pattern(pattern, "\"%\" is not followed by a number and \"d\"");
            if (numbered) refuse_pattern(pattern, "it has two numbers, one is needed");
            stack.digits = parse_digits(pattern, std::string_view(name).substr(i + 1, end - i - 1));
            numbered = true;
            i = end;
        }
    }
    if (!numbered) refuse_pattern(pattern, "it has no number for the frames");
    if (!has_image_name(stack.after.empty() ? fs::path("x") : fs::path("x" + stack.after)))
        refuse_pattern(pattern, "frames are .png or .exr");
    return stack;
}

std::vector<fs::path> list_stack(const fs::path& folder) {
    std::map<size_t, fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (!has_image_name(entry.path())) continue;
        const std::optional<size_t> number = number_of(entry.path());
        if (!number) continue;
        const auto [place, added] = files.emplace(*number, entry.path());
        if (!added) {
            std::vector<std::string> names = {place->second.filename().string(),
                                              entry.path().filename().string()};
            std::sort(names.begin(), names.end());
            throw Error(format("{}: frame {} is there twice, as {} and {}; keep one stack in a folder",
                               folder.string(), *number, names[0], names[1]));
        }
    }
    if (files.empty())
        throw Error(format("{}: holds no numbered .png or .exr; name a folder of frames", folder.string()));
    std::vector<fs::path> ordered;
    for (const auto& [number, file] : files) {
        const size_t expected = files.begin()->first + ordered.size();
        if (number != expected) {
            throw Error(format("{}: frame {} is missing between {} and {}; render it again", folder.string(),
                               expected, files.begin()->first, files.rbegin()->first));
        }
        ordered.push_back(file);
    }
    return ordered;
}

}  // namespace chironomia
