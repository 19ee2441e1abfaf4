#include "raster/images/compare_sets.h"

#include <algorithm>
#include <cassert>

#include "core/progress.h"
#include "core/text.h"
#include "raster/images/compare_folders.h"
#include "raster/images/image_file.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// One pair of files: what it is called, and what it is called with each of its frames.
struct NamedPair {
    std::string name;
    fs::path expected;
    fs::path actual;

    std::string frame_name(const FramePair& pair) const {
        return pair.count == 1 ? name : format("{}: frame {}", name, pair.index);
    }
    // "walk/00012.png" stays, "walk.exr" is painted in "walk.exr.png", a frame of "walk.mp4" in
    // "walk.mp4/00012.png".
    fs::path difference_name(const FramePair& pair) const {
        if (pair.count > 1) return fs::path(name) / format("{:05}.png", pair.index);
        return name.ends_with(".png") ? name : name + ".png";
    }
};

class SetComparer {
  public:
    explicit SetComparer(const SetOptions& options) : options_(options) {}

    // `on_frame` is called after each frame. Throws as compare_files, with the frames before it recorded.
    void compare_pair(const NamedPair& pair, const std::function<void(size_t count)>& on_frame) {
        CompareOptions options = options_.compare;
        options.on_frame = [&](const FramePair& frames) {
            record_frame(pair, frames);
            on_frame(frames.count);
        };
        try {
            record_sound(pair, compare_files(pair.expected, pair.actual, options));
        } catch (const DifferentForm& fault) {
            add(pair, pair.name, CaseOutcome::different, fault.what());
        }
        ++set_.files;
    }

    void add_unreadable(const NamedPair& pair, const std::string& fault) {
        add(pair, pair.name, CaseOutcome::unreadable, fault);
    }

    // A file that only one side has.
    void add_single(const NamedPair& pair) {
        const bool missing = pair.actual.empty();
        const std::string fault =
            missing
                ? format("{}: was expected, and no result has that name; render it, or accept its absence",
                         pair.expected.string())
                : format("{}: no reference has that name; accept it, or remove it", pair.actual.string());
        CompareCase& added = add(pair, pair.name, missing ? CaseOutcome::missing : CaseOutcome::extra, fault);
        const fs::path& file = missing ? pair.expected : pair.actual;
        if (!wants_pictures() || !is_image(file)) return;
        (missing ? added.pictures.emplace().expected : added.pictures.emplace().actual) =
            encode_png(read_image(file));
    }

    // Whether the last thing that was thrown is no fault of the files that are compared.
    bool cannot_write() const { return cannot_write_; }

    CompareSet take() { return std::move(set_); }

  private:
    CompareCase& add(const NamedPair& pair, const std::string& name, CaseOutcome outcome,
                     const std::string& message) {
        return set_.cases.emplace_back(CompareCase{.name = name,
                                                   .outcome = outcome,
                                                   .message = message,
                                                   .frame = {},
                                                   .expected = pair.expected,
                                                   .actual = pair.actual,
                                                   .difference = {},
                                                   .pictures = {}});
    }

    void record_frame(const NamedPair& pair, const FramePair& frames) {
        const FrameComparison& numbers = frames.comparison;
        const bool same = numbers.within_limits;
        CompareCase& added =
            add(pair, pair.frame_name(frames), same ? CaseOutcome::same : CaseOutcome::different,
                same ? "" : describe(numbers, options_.compare.limits));
        added.frame = numbers;
        if (same) return;
        const bool writes = !options_.difference_folder.empty(), keeps = wants_pictures();
        if (!writes && !keeps) return;
        const Frame difference = difference_image(frames.a, frames.b);
        if (writes) {
            added.difference = options_.difference_folder / pair.difference_name(frames);
            write_picture(added.difference, difference);
        }
        if (keeps) added.pictures = {encode_png(frames.a), encode_png(frames.b), encode_png(difference)};
    }

    void record_sound(const NamedPair& pair, const FileComparison& files) {
        if (!files.sound_error) return;
        const bool same = *files.sound_error <= files.sound_limit;
        add(pair, pair.name + ": sound", same ? CaseOutcome::same : CaseOutcome::different,
            same ? ""
                 : format("a sample differs by {:.4f} of 1, at most {:.4f} may", *files.sound_error,
                          files.sound_limit));
    }

    void write_picture(const fs::path& file, const Frame& picture) {
        try {
            write_image(file, picture);
        } catch (const Error&) {
            cannot_write_ = true;
            throw;
        }
    }

    bool wants_pictures() const {
        const auto kept = std::count_if(set_.cases.begin(), set_.cases.end(),
                                        [](const CompareCase& one) { return one.pictures.has_value(); });
        return static_cast<size_t>(kept) < options_.most_pictures;
    }

    const SetOptions& options_;
    CompareSet set_;
    bool cannot_write_ = false;
};

CompareSet compare_folders(const fs::path& expected, const fs::path& actual, const SetOptions& options) {
    const auto matches = match_files(expected, actual);
    if (matches.empty()) {
        throw Error(format("{}: neither it nor {} holds a .png, .exr, .mp4 or .webm; name folders of results",
                           expected.string(), actual.string()));
    }
    SetComparer comparer(options);
    Progress progress(actual.string(), "files", matches.size(), options.quiet);
    Progress interrupts("", "", 0, true);
    size_t number = 0;
    for (const auto& [name, there] : matches) {
        progress.step();
        if (!options.shard.has(number++)) continue;
        const NamedPair pair{.name = name,
                             .expected = there.expected ? expected / name : fs::path(),
                             .actual = there.actual ? actual / name : fs::path()};
        try {
            if (there.expected && there.actual) {
                comparer.compare_pair(pair, [&interrupts](size_t) { interrupts.step(0); });
            } else {
                comparer.add_single(pair);
            }
        } catch (const Error& fault) {
            if (comparer.cannot_write()) throw;
            comparer.add_unreadable(pair, fault.what());
        }
    }
    return comparer.take();
}

CompareSet compare_single(const fs::path& expected, const fs::path& actual, const SetOptions& options) {
    SetComparer comparer(options);
    std::optional<Progress> progress;
    const fs::path named = fs::is_directory(expected) ? actual : expected;
    comparer.compare_pair({.name = named.filename().string(), .expected = expected, .actual = actual},
                          [&](size_t frames) {
                              if (!progress)
                                  progress.emplace(actual.string(), "frames", frames, options.quiet);
                              progress->step();
                          });
    return comparer.take();
}

}  // namespace

const char* to_text(CaseOutcome outcome) {
    switch (outcome) {
        case CaseOutcome::same:
            return "same";
        case CaseOutcome::different:
            return "different";
        case CaseOutcome::missing:
            return "missing";
        case CaseOutcome::extra:
            return "extra";
        case CaseOutcome::unreadable:
            return "unreadable";
    }
    assert(false);
    return "";
}

size_t CompareSet::count(CaseOutcome outcome) const {
    return static_cast<size_t>(std::count_if(
        cases.begin(), cases.end(), [outcome](const CompareCase& one) { return one.outcome == outcome; }));
}

CompareSet compare_sets(const fs::path& expected, const fs::path& actual, const SetOptions& options) {
    for (const fs::path& path : {expected, actual}) {
        if (!fs::exists(path))
            throw Error(format("{}: there is no such file; check the path", path.string()));
    }
    for (const fs::path& folder : {expected, actual}) {
        if (!options.difference_folder.empty() && lies_within(options.difference_folder, folder)) {
            throw Error(format("{}: lies in {}, which is compared; write the differences elsewhere",
                               options.difference_folder.string(), folder.string()));
        }
    }
    const bool folders = fs::is_directory(expected) && fs::is_directory(actual);
    if (!folders && options.shard.count > 1)
        throw Error(format("{}: is compared as a whole, so there is no part {} of {}; give two folders",
                           actual.string(), options.shard.number, options.shard.count));
    return folders ? compare_folders(expected, actual, options) : compare_single(expected, actual, options);
}

}  // namespace chironomia
