#include "study/check_files.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <sys/stat.h>

#include "core/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/blinding.h"
#include "study/leaks.h"
#include "study/pages.h"
#include "study/study_files.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

Proof yes(std::string_view property, std::string detail) {
    return {.property = std::string(property), .holds = true, .detail = std::move(detail)};
}

Proof no(std::string_view property, std::string detail) {
    return {.property = std::string(property), .holds = false, .detail = std::move(detail)};
}

fs::path public_folder(const StudyRecord& study) {
    return StudyFolder{study.folder}.open();
}

const KeyedVideo* find_video(const StudyRecord& study, const std::string& token) {
    const auto found = std::find_if(study.videos.begin(), study.videos.end(),
                                    [&](const KeyedVideo& video) { return video.token == token; });
    return found == study.videos.end() ? nullptr : &*found;
}

bool is_known(const std::string& name, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::size_t index_of(const std::string& name, const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// What a page's videos should show, from left to right.
std::vector<std::vector<std::string>> conditions_of_videos(const KeyedPage& page) {
    if (page.videos.size() == 1) return {{page.left, page.right}};
    return {{page.left}, {page.right}};
}

// What is wrong with a page of the key, or "".
std::string fault_of_page(const StudyRecord& study, const KeyedPage& page) {
    if (!is_known(page.clip, study.clips)) return format("clip \"{}\" is not in the plan", page.clip);
    for (const std::string& condition : {page.left, page.right}) {
        if (!is_known(condition, study.conditions)) {
            return format("condition \"{}\" is not in the plan", condition);
        }
    }
    const auto expected = conditions_of_videos(page);
    if (page.videos.size() != expected.size()) return format("it has {} videos", page.videos.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const KeyedVideo* video = find_video(study, page.videos[i]);
        if (!video) return format("the key lacks video {}", page.videos[i]);
        if (video->clip != page.clip || video->conditions != expected[i]) {
            return format("video {} is clip \"{}\", {}; clip \"{}\", {} is needed", video->token, video->clip,
                          join(video->conditions, " and "), page.clip, join(expected[i], " and "));
        }
    }
    return "";
}

// The pages of the key as a design of numbers.
Design design_of(const StudyRecord& study) {
    Design design;
    for (const KeyedPage& page : study.pages) {
        design.pages.push_back({.clip = index_of(page.clip, study.clips),
                                .left = index_of(page.left, study.conditions),
                                .right = index_of(page.right, study.conditions)});
    }
    design.orders = study.orders;
    return design;
}

std::size_t distance_of(std::size_t a, std::size_t b) {
    return a > b ? a - b : b - a;
}

// Whether every order shows every page once.
bool are_permutations(const StudyRecord& study) {
    return std::all_of(study.orders.begin(), study.orders.end(), [&](const PageOrder& order) {
        std::vector<std::size_t> sorted = order.pages;
        std::sort(sorted.begin(), sorted.end());
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            if (sorted[i] != i) return false;
        }
        return sorted.size() == study.pages.size();
    });
}

std::size_t count_swapped(const StudyRecord& study) {
    return static_cast<std::size_t>(std::count_if(study.orders.begin(), study.orders.end(),
                                                  [](const PageOrder& order) { return order.swapped; }));
}

bool is_single_video(const StudyRecord& study) {
    return study.pages.front().videos.size() == 1;
}

}  // namespace

Proof check_files_unchanged(const StudyRecord& study) {
    constexpr std::string_view kProperty = "every file is as it was built";
    for (const ListedFile& file : study.outputs) {
        const fs::path path = study.folder / file.path;
        if (!fs::is_regular_file(path)) return no(kProperty, format("{} is missing", file.path));
        if (sha256_of_file(path) != file.sha256) return no(kProperty, format("{} has changed", file.path));
    }
    return yes(kProperty, format("{} files", study.outputs.size()));
}

Proof check_nothing_else_public(const StudyRecord& study) {
    constexpr std::string_view kProperty = "public/ holds nothing else";
    std::set<std::string> listed = {"clips"};
    for (const ListedFile& file : study.outputs) {
        if (file.path.starts_with("public/")) listed.insert(file.path.substr(7));
    }
    const fs::path folder = public_folder(study);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        if (entry.is_symlink()) return no(kProperty, format("{} is a link", name));
        if (listed.count(name) == 0) return no(kProperty, format("{} is in no list", name));
    }
    return yes(kProperty, format("{} files", listed.size() - 1));
}

Proof check_key_complete(const StudyRecord& study) {
    constexpr std::string_view kProperty = "the key holds every comparison of the plan once";
    std::set<std::tuple<std::string, std::string, std::string>> seen;
    for (const KeyedPage& page : study.pages) {
        const std::string fault = fault_of_page(study, page);
        if (!fault.empty()) return no(kProperty, format("page {}: {}", page.page, fault));
        if (!seen.emplace(page.clip, std::min(page.left, page.right), std::max(page.left, page.right))
                 .second) {
            return no(kProperty,
                      format("clip \"{}\" compares {} and {} twice", page.clip, page.left, page.right));
        }
    }
    const std::size_t expected =
        count_pages({.clips = study.clips.size(), .conditions = study.conditions.size()});
    if (seen.size() != expected) return no(kProperty, format("{} of {} comparisons", seen.size(), expected));
    return yes(kProperty, format("{} clips, {} conditions, {} comparisons", study.clips.size(),
                                 study.conditions.size(), expected));
}

Proof check_videos_match_key(const StudyRecord& study) {
    constexpr std::string_view kProperty = "every video is what the key says";
    std::set<std::string> keyed;
    for (const KeyedVideo& video : study.videos) {
        const fs::path file = public_folder(study) / video.file;
        if (!fs::is_regular_file(file)) return no(kProperty, format("{} is missing", video.file));
        if (sha256_of_file(file) != video.sha256) {
            return no(kProperty, format("{} is not clip \"{}\", {}", video.file, video.clip,
                                        join(video.conditions, " and ")));
        }
        keyed.insert(video.file);
    }
    for (const auto& paths : study.public_videos) {
        for (const std::string& path : paths) {
            if (keyed.count(path) == 0) return no(kProperty, format("{} is not in the key", path));
        }
    }
    return yes(kProperty, format("{} videos", keyed.size()));
}

Proof check_page_data(const StudyRecord& study) {
    constexpr std::string_view kProperty = "the page shows what the key says";
    const fs::path index = public_folder(study) / "index.html";
    if (!fs::is_regular_file(index)) return no(kProperty, "index.html is missing");
    if (read_text(index) != make_index_page(study.public_pages)) {
        return no(kProperty, "index.html is not this program's page with the data of pages.json");
    }
    if (study.public_page_ids.size() != study.pages.size()) {
        return no(kProperty, format("pages.json has {} pages, the key {}", study.public_page_ids.size(),
                                    study.pages.size()));
    }
    for (std::size_t i = 0; i < study.pages.size(); ++i) {
        std::vector<std::string> files;
        for (const std::string& token : study.pages[i].videos) {
            const KeyedVideo* video = find_video(study, token);
            files.push_back(video ? video->file : "");
        }
        if (study.public_page_ids[i] != study.pages[i].page || study.public_videos[i] != files) {
            return no(kProperty, format("page {} of pages.json differs from the key", i + 1));
        }
    }
    return yes(kProperty, format("{} pages", study.pages.size()));
}

Proof check_tokens(const StudyRecord& study) {
    constexpr std::string_view kProperty = "names are keyed hashes";
    std::vector<std::string> found = {study.study_token};
    for (const KeyedVideo& video : study.videos) found.push_back(video.token);
    for (const KeyedPage& page : study.pages) found.push_back(page.page);
    const std::vector<std::string> expected =
        make_tokens(study.key, texts_to_name(study.videos.size(), study.pages.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] != expected[i]) return no(kProperty, format("{} should be {}", found[i], expected[i]));
    }
    for (const KeyedVideo& video : study.videos) {
        const std::string ending = fs::path(video.file).extension().string();
        if (video.file != "clips/" + video.token + ending) {
            return no(kProperty, format("{} is not named by its token", video.file));
        }
    }
    if (study.public_pages.at("study") != study.study_token) {
        return no(kProperty, "pages.json names another study");
    }
    return yes(kProperty, format("{} names of {} digits", found.size(), kTokenDigits));
}

Proof check_no_names_in_page(const StudyRecord& study) {
    constexpr std::string_view kProperty = "no name of a condition in what participants read";
    for (const std::string& text : study.public_texts) {
        if (const auto name = find_word(text, study.conditions)) {
            return no(kProperty, format("\"{}\" stands in \"{}\"", *name, text));
        }
    }
    // The player is the same for every study, and so tells nothing of this one; a changed one might.
    for (const PlayerFile& file : player_files()) {
        const fs::path path = public_folder(study) / file.name;
        if (!fs::is_regular_file(path)) return no(kProperty, format("{} is missing", file.name));
        if (read_text(path) != file.content) {
            return no(kProperty, format("{} is not this program's own", file.name));
        }
    }
    return yes(kProperty,
               format("{} texts, {} conditions", study.public_texts.size(), study.conditions.size()));
}

Proof check_traces(const StudyRecord& study) {
    constexpr std::string_view kProperty = "times and permissions tell nothing";
    std::vector<fs::path> paths = {public_folder(study)};
    for (const auto& entry : fs::recursive_directory_iterator(public_folder(study))) {
        paths.push_back(entry.path());
    }
    for (const fs::path& path : paths) {
        struct stat status {};
        const std::string name = path.lexically_relative(study.folder).string();
        if (::stat(path.c_str(), &status) != 0) return no(kProperty, format("{} cannot be seen", name));
        if (status.st_mtim.tv_sec != kNeutralTime || status.st_mtim.tv_nsec != 0) {
            return no(kProperty,
                      format("{} has a time of its own; copy with times kept, or build again", name));
        }
        if ((status.st_mode & 0777) != (fs::is_directory(path) ? 0755u : 0644u)) {
            return no(kProperty, format("{} has permissions of its own", name));
        }
    }
    return yes(kProperty, format("{} files and folders, 1980-01-01", paths.size()));
}

Proof check_sides(const StudyRecord& study) {
    constexpr std::string_view kProperty = "sides are balanced";
    for (const SideBalance& pair : count_sides(design_of(study), study.conditions.size())) {
        const std::string names = study.conditions[pair.first] + " : " + study.conditions[pair.second];
        if (distance_of(pair.first_left, pair.second_left) > 1) {
            return no(kProperty,
                      format("{} are left {} : {} times", names, pair.first_left, pair.second_left));
        }
    }
    const std::size_t swapped = count_swapped(study);
    if (!is_single_video(study) && distance_of(swapped, study.orders.size() - swapped) > 1) {
        return no(kProperty,
                  format("{} of {} orders swap the sides, half should", swapped, study.orders.size()));
    }
    const std::size_t pairs = study.conditions.size() * (study.conditions.size() - 1) / 2;
    return yes(kProperty, format("{} pairs of conditions, each left as often as right to within 1", pairs));
}

Proof check_orders(const StudyRecord& study) {
    constexpr std::string_view kProperty = "orders are balanced";
    if (study.orders.empty() || !are_permutations(study)) {
        return no(kProperty, "an order does not show every page once");
    }
    const Design drawn = draw_design({.clips = study.clips.size(),
                                      .conditions = study.conditions.size(),
                                      .may_swap = !is_single_video(study),
                                      .orders = study.orders.size()},
                                     study.seed);
    if (drawn.orders != study.orders) return no(kProperty, "they are not those that the seed draws");
    const PositionBalance positions = count_positions(drawn);
    return yes(kProperty,
               format("{} orders, {} with swapped sides; each page {} to {} times at each position",
                      study.orders.size(), count_swapped(study), positions.least, positions.most));
}

}  // namespace chironomia
