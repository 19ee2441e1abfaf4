#include "study/plan/from_folders.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/files/files.h"
#include "core/text.h"
#include "core/utf8.h"
#include "raster/ffmpeg/clip_info.h"
#include "skinning/motion/motion_file.h"
#include "skinning/motion/picture/openpose.h"
#include "study/plan/parts.h"
#include "synth/markup/letters.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

constexpr double kFrame = 1.0 / 30;        // of GENEA's clips [s]
constexpr double kTolerance = kFrame / 2;  // of times [s]: the segments lie on whole frames

struct Segment {
    std::string where;     // "segments.csv:2: "
    std::string name;      // of its files, without an ending, composed
    std::string speaker;   // empty: unknown
    std::string partner;   // name of the partner's files, composed; empty: as `name` says
    double begin = 0;      // [s]
    double end = 0;        // [s]
    std::size_t turn = 0;  // how many segments of the name come before it

    std::string id() const {
        return format("{}_{}-{}", name, std::lround(begin / kFrame), std::lround(end / kFrame));
    }
    std::string place() const { return where + id(); }
};

// Without ending, and in one form of Unicode: the same name has another one on a disk of macOS than in a table.
std::string name_of(const fs::path& file) {
    return composed(file.stem().string());
}

// The files of a folder by their names; of a motion that has samples all of them, in their order.
using FilesByName = std::map<std::string, std::vector<fs::path>>;

bool consists_of(std::string_view text, char first, char last) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [&](char c) { return c >= first && c <= last; });
}

// "2_scott_0_1_1": an id, the speaker, and numbers.
std::string speaker_in(const std::string& name) {
    const std::vector<std::string_view> parts = split(name, '_');
    const bool is_of_beat =
        parts.size() > 2 && consists_of(parts[0], '0', '9') && consists_of(parts[1], 'a', 'z');
    return is_of_beat ? std::string(parts[1]) : "";
}

std::string without_sample(const std::string& stem) {
    constexpr std::string_view kSample = "_sample_";
    const std::size_t at = stem.rfind(kSample);
    const bool is_sample =
        at != std::string::npos && at > 0 && consists_of(stem.substr(at + kSample.size()), '0', '9');
    return is_sample ? stem.substr(0, at) : stem;
}

// Sample 10 comes after sample 9.
bool comes_first(const fs::path& a, const fs::path& b) {
    const std::string x = name_of(a), y = name_of(b);
    return std::tuple(x.size(), x, a.filename()) < std::tuple(y.size(), y, b.filename());
}

// Endings of files that are looked for; the others count where a folder has none of the usual ones, beside which they
// are something else: a JSON that names points, a film.
struct Endings {
    std::vector<std::string> usual, others;

    std::string list() const { return format("{}, {}", join(usual), join(others)); }
};

const Endings& endings_of_motions() {
    static const Endings kEndings{.usual = {".bvh", ".glb", ".h5", ".npy", ".npz"},
                                  .others = {".csv", ".json"}};
    return kEndings;
}

const Endings& endings_of_sounds() {
    static const Endings kEndings{.usual = {".flac", ".mp3", ".ogg", ".wav"},
                                  .others = {".aac", ".m4a", ".mkv", ".mov", ".mp4", ".opus", ".webm"}};
    return kEndings;
}

// A name in a table may have the ending of a motion or a sound, or none: of "talk.v2" nothing is an ending.
std::string name_in_table(const fs::path& name) {
    const std::string ending = to_lower(name.extension().string());
    for (const Endings* endings : {&endings_of_motions(), &endings_of_sounds()}) {
        for (const auto* some : {&endings->usual, &endings->others}) {
            if (std::find(some->begin(), some->end(), ending) != some->end()) return name_of(name);
        }
    }
    return composed(name.filename().string());
}

// macOS writes a "._NAME" for a file on a disk of another system.
bool is_hidden(const fs::path& file) {
    return file.filename().string().starts_with('.');
}

FilesByName files_that_end(const fs::path& folder, const std::vector<std::string>& endings) {
    FilesByName files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string ending = to_lower(entry.path().extension().string());
        if (is_hidden(entry.path()) || std::find(endings.begin(), endings.end(), ending) == endings.end())
            continue;
        files[without_sample(name_of(entry.path()))].push_back(entry.path());
    }
    return files;
}

// A folder of OpenPose is a motion.
FilesByName openpose_folders(const fs::path& folder) {
    FilesByName found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (is_openpose_folder(entry.path()))
            found[composed(entry.path().filename().string())] = {entry.path()};
    return found;
}

FilesByName list_by_name(const fs::path& folder, const Endings& endings) {
    if (!fs::is_directory(folder))
        throw Error(format("{}: there is no such folder; check the path", folder.string()));
    FilesByName files = files_that_end(folder, endings.usual);
    if (files.empty()) files = files_that_end(folder, endings.others);
    if (files.empty() && &endings == &endings_of_motions()) files = openpose_folders(folder);
    if (files.empty()) {
        throw Error(format("{}: holds no file that ends in {}; name the folder that does", folder.string(),
                           endings.list()));
    }
    for (auto& [name, all] : files) std::sort(all.begin(), all.end(), comes_first);
    return files;
}

std::size_t column_of(const CsvTable& table, const char* name) {
    const auto column = find_column(table, {name});
    if (!column)
        throw Error(
            format("{}: has no column {}; its columns are {}", table.where, name, join(table.columns)));
    return *column;
}

double seconds_in(const CsvTable& table, const CsvRow& row, std::size_t column) {
    const double seconds = number_in(table, row, column);
    if (!std::isfinite(seconds) || seconds < 0 || seconds > kLatestCut)
        throw Error(format("{}{} is {}; a time from 0 to {:g} s is needed", table.at(row),
                           table.columns[column], row.cells[column], kLatestCut));
    return seconds;
}

void expect_utf8(const std::string& text, const fs::path& file) {
    const auto fault = fault_in_utf8(text);
    if (!fault) return;
    const auto bad = text.begin() + static_cast<std::ptrdiff_t>(*fault);
    throw Error(format("{}:{}: the byte 0x{:02x} is not UTF-8; save the table as UTF-8", file.string(),
                       1 + std::count(text.begin(), bad, '\n'), static_cast<unsigned char>(*bad)));
}

// What a plan would refuse later, where nobody knows the rows any more.
void expect_possible(const Segment& segment, const CsvTable& table, const CsvRow& row) {
    if (segment.name.empty())
        throw Error(format("{}file_name is empty; write the name of the segment's files", segment.where));
    const double lasts = segment.end - segment.begin;
    if (lasts <= 0)
        throw Error(format("{}start_seconds is {:g} and end_seconds is {:g}; the end must be later",
                           segment.where, segment.begin, segment.end));
    if (lasts < kFrame - 1e-6)
        throw Error(
            format("{}from start_seconds, {:g}, to end_seconds, {:g}, it lasts {:.3f} s; a frame of {:.3f} s "
                   "is the least",
                   segment.where, segment.begin, segment.end, lasts, kFrame));
    const auto duration = find_column(table, {"duration_seconds"});
    if (duration && std::abs(seconds_in(table, row, *duration) - lasts) > kTolerance)
        throw Error(
            format("{}duration_seconds is {}, but from start_seconds, {:g}, to end_seconds, {:g}, it lasts "
                   "{:.3f} s; mend one of them",
                   segment.where, row.cells[*duration], segment.begin, segment.end, lasts));
}

// "x.wav" from 0 s to 2 s
std::string shown(const CsvTable& table, const CsvRow& row) {
    const auto cell = [&](const char* column) { return row.cells[column_of(table, column)]; };
    return format("\"{}\" from {} s to {} s", cell("file_name"), cell("start_seconds"), cell("end_seconds"));
}

std::vector<Segment> read_segments(const fs::path& file) {
    const std::string text = read_text(file);
    expect_utf8(text, file);
    const CsvTable table = parse_csv_table(text, file.string());
    const std::size_t name = column_of(table, "file_name"), begin = column_of(table, "start_seconds"),
                      end = column_of(table, "end_seconds");
    const auto speaker = find_column(table, {"speaker"}), partner = find_column(table, {"partner_file_name"});
    std::map<std::string, std::size_t> turns;
    std::map<std::string, const CsvRow*> rows;  // by the id, in lower case
    std::vector<Segment> segments;
    for (const CsvRow& row : table.rows) {
        Segment segment{.where = table.at(row),
                        .name = name_in_table(fs::path(trim(row.cells[name]))),
                        .speaker = speaker ? std::string(trim(row.cells[*speaker])) : "",
                        .partner = partner ? name_in_table(fs::path(trim(row.cells[*partner]))) : "",
                        .begin = seconds_in(table, row, begin),
                        .end = seconds_in(table, row, end)};
        expect_possible(segment, table, row);
        const auto [first, is_new] = rows.emplace(to_lower(segment.id()), &row);
        if (!is_new) {
            const auto name_of = [&](const CsvRow& one) {
                return name_in_table(fs::path(trim(one.cells[name])));
            };
            const bool differ = name_of(row) != name_of(*first->second);
            throw Error(format(
                "{}{} is the same clip, {}, as {} in line {}; {}", segment.where, shown(table, row),
                segment.id(), shown(table, *first->second), first->second->line,
                differ ? "leave one of them out, or rename it, as names that differ in case alone are one"
                       : "leave one of them out"));
        }
        if (segment.speaker.empty()) segment.speaker = speaker_in(segment.name);
        segment.turn = turns[segment.name]++;
        segments.push_back(std::move(segment));
    }
    return segments;
}

// How long motions last; each is read once.
class Lengths {
  public:
    struct Length {
        double seconds = 0;
        bool lacks_rate = false;  // it is at the rate that was given
    };

    explicit Lengths(std::optional<double> fps) : fps_(fps) {}

    const Length& of(const fs::path& motion) {
        const auto found = lengths_.find(motion);
        return found != lengths_.end() ? found->second
                                       : lengths_.emplace(motion, measure(motion)).first->second;
    }

  private:
    Length measure(const fs::path& motion) const {
        try {
            return {.seconds = duration(read_motion(motion))};
        } catch (const Error&) {
            if (!fps_) throw;
            return {.seconds = duration(read_motion(motion, {.fps = fps_})), .lacks_rate = true};
        }
    }

    std::optional<double> fps_;
    std::map<fs::path, Length> lengths_;
};

// The files of a folder, and which of them the table wants.
struct Folder {
    std::string whose;  // "ours", "the partners"
    std::string kind;   // "motions"
    fs::path path;      // empty: there is none
    FilesByName files{};
    std::set<std::string> wanted{};

    std::string what() const { return format("the {}{}{}", kind, whose.empty() ? "" : " of ", whose); }
};

Folder read_folder(const std::string& whose, bool of_motions, const fs::path& path) {
    Folder folder{.whose = whose, .kind = of_motions ? "motions" : "sounds", .path = path};
    if (!path.empty())
        folder.files = list_by_name(path, of_motions ? endings_of_motions() : endings_of_sounds());
    return folder;
}

// How the partner's files of a segment are called. GENEA 2023 has "..._main-agent" and "..._interloctr".
std::string partner_of(const Segment& segment, const Folder& partners) {
    constexpr std::string_view kAgent = "main-agent", kPartner = "interloctr";
    if (!segment.partner.empty()) return segment.partner;
    const std::size_t at = segment.name.rfind(kAgent);
    if (at == segment.name.npos || partners.files.contains(segment.name)) return segment.name;
    return std::string(segment.name).replace(at, kAgent.size(), kPartner);
}

// What the folders have for the segments of a table.
class Matching {
  public:
    explicit Matching(const FoldersJob& job)
        : job_(job),
          sounds_(read_folder("", false, job.audio)),
          partners_(read_folder("the partners", true, job.partner)),
          partner_sounds_(read_folder("the partners", false, job.partner_audio)),
          lengths_(job.fps) {
        for (const ConditionFolder& condition : job.conditions)
            motions_.push_back(read_folder(condition.name, true, condition.folder));
    }

    // The clip of a segment, or nothing where something is missing.
    std::optional<Json> clip_of(const Segment& segment) {
        Json clip = {{"id", segment.id()}, {"cut", {segment.begin, segment.end}}};
        if (!segment.speaker.empty()) clip["speaker"] = segment.speaker;
        bool is_whole = add_sound(clip, sounds_, segment, segment.name);
        for (Folder& folder : motions_) {
            const auto motion = motion_of(folder, segment, segment.name);
            is_whole = is_whole && motion;
            if (motion) clip["motion"][folder.whose] = path_of(*motion);
            if (motion && lengths_.of(*motion).lacks_rate) hints_[folder.whose]["fps"] = *job_.fps;
        }
        if (!job_.partner.empty()) is_whole = add_partner(clip, segment) && is_whole;
        return is_whole ? std::optional(std::move(clip)) : std::nullopt;
    }

    std::vector<std::string> take_faults() {
        for (const auto& [sound, beyond] : begun_after_)
            faults_.push_back(line_of(sound, beyond, "begin", ""));
        for (const Folder& folder : motions_) report_unused(folder);
        for (const Folder* folder : {&sounds_, &partners_, &partner_sounds_}) report_unused(*folder);
        return std::move(faults_);
    }

    // Of conditions whose motions have no rate; null if all have one.
    const Json& hints() const { return hints_; }

    std::vector<std::string> notes() const {
        std::vector<std::string> notes;
        for (const auto& [sound, beyond] : ended_after_)
            notes.push_back(line_of(sound, beyond, "end", ", in silence"));
        for (const auto& [name, most] : most_samples_)
            notes.push_back(
                format("{}: gives up to {} samples for a name; its segments take them in turn", name, most));
        return notes;
    }

  private:
    // By the name that the file has in its folder, though it may be a link into a store of unnamed ones.
    std::string path_of(const fs::path& file) const {
        const fs::path real = fs::canonical(file.parent_path()) / file.filename();
        return real.lexically_relative(fs::weakly_canonical(job_.plan_folder)).generic_string();
    }

    // Whether there is a sound, or none is asked for.
    bool add_sound(Json& json, Folder& sounds, const Segment& segment, const std::string& name) {
        if (sounds.path.empty()) return true;
        const auto sound = sound_of(sounds, segment, name);
        if (sound) json["audio"] = path_of(*sound);
        return sound.has_value();
    }

    bool add_partner(Json& clip, const Segment& segment) {
        const std::string name = partner_of(segment, partners_);
        Json& partner = clip["partner"];
        const auto motion = motion_of(partners_, segment, name);
        if (motion) partner["motion"] = path_of(*motion);
        if (motion && lengths_.of(*motion).lacks_rate) partner["hints"]["fps"] = *job_.fps;
        return add_sound(partner, partner_sounds_, segment, name) && motion;
    }

    // The segments that begin or end after their sound has ended.
    struct Beyond {
        std::size_t segments = 0;
        double most = 0;    // after the sound's end [s]
        std::string worst;  // id of the one that does so by most

        void add(const Segment& segment, double seconds) {
            if (segments++ > 0 && seconds <= most) return;
            most = seconds;
            worst = segment.id();
        }
    };

    std::string line_of(const fs::path& sound, const Beyond& beyond, std::string_view verb,
                        std::string_view more) const {
        const bool is_one = beyond.segments == 1;
        return format("{}: lasts {:.2f} s, and {} segment{} {}{} later{}{} {}, by {:.2f} s",
                      sound.filename().string(), sound_seconds_.at(sound), beyond.segments, is_one ? "" : "s",
                      verb, is_one ? "s" : "", more, is_one ? ":" : "; the worst is", beyond.worst,
                      beyond.most);
    }

    // The files of a name; empty where there are none, or two differ in their ending alone.
    std::vector<fs::path> files_of(Folder& folder, const Segment& segment, const std::string& name) {
        folder.wanted.insert(name);
        const auto found = folder.files.find(name);
        if (found == folder.files.end()) {
            const std::string called = name == segment.name ? "" : format(" {}", name);
            faults_.push_back(format("{}:{} is not among {}", segment.place(), called, folder.what()));
            return {};
        }
        const auto same =
            std::adjacent_find(found->second.begin(), found->second.end(),
                               [](const fs::path& a, const fs::path& b) { return name_of(a) == name_of(b); });
        if (same == found->second.end()) return found->second;
        const fs::path& other = *std::next(same);
        const bool look_alike = same->extension() == other.extension();
        faults_.push_back(format("{}: is twice among {}, {} and {}{}", segment.place(), folder.what(),
                                 same->filename().string(), other.filename().string(),
                                 look_alike ? ", which differ in their Unicode form alone" : ""));
        return {};
    }

    std::optional<fs::path> sound_of(Folder& sounds, const Segment& segment, const std::string& name) {
        const std::vector<fs::path> files = files_of(sounds, segment, name);
        if (files.empty()) return std::nullopt;
        const fs::path& sound = files.front();
        const auto found = sound_seconds_.find(sound);
        const double seconds = found != sound_seconds_.end() ? found->second : seconds_of_sound(sound);
        sound_seconds_.emplace(sound, seconds);
        if (segment.begin >= seconds) {
            begun_after_[sound].add(segment, segment.begin - seconds);
            return std::nullopt;
        }
        if (seconds + kTolerance < segment.end) ended_after_[sound].add(segment, segment.end - seconds);
        return sound;
    }

    static double seconds_of_sound(const fs::path& file) {
        const ClipInfo info = read_clip_info(file);
        if (!info.sound) throw Error(format("{}: there is no sound in it", file.string()));
        return info.sound->duration_s;
    }

    std::optional<fs::path> motion_of(Folder& folder, const Segment& segment, const std::string& name) {
        const std::vector<fs::path> samples = files_of(folder, segment, name);
        if (samples.empty()) return std::nullopt;
        if (samples.size() > 1) {
            std::size_t& most = most_samples_[folder.whose];
            most = std::max(most, samples.size());
        }
        const fs::path& motion = samples[segment.turn % samples.size()];
        if (const std::string fault = fault_of(motion, segment); !fault.empty()) {
            faults_.push_back(format("{}: {}: {}", segment.place(), folder.whose, fault));
            return std::nullopt;
        }
        return motion;
    }

    std::string fault_of(const fs::path& motion, const Segment& segment) {
        try {
            const double seconds = lengths_.of(motion).seconds;
            if (seconds + kTolerance >= segment.end) return "";
            return format("{} lasts {:.2f} s, and the segment ends at {:.2f} s", motion.filename().string(),
                          seconds, segment.end);
        } catch (const Error& error) {
            return error.what();
        }
    }

    void report_unused(const Folder& folder) {
        std::vector<std::string> unused;
        for (const auto& [name, all] : folder.files) {
            if (!folder.wanted.contains(name)) unused.push_back(name);
        }
        if (!unused.empty())
            faults_.push_back(format("{}: no segment names {}", folder.path.string(), join(unused)));
    }

    const FoldersJob& job_;
    std::vector<Folder> motions_;  // of each condition
    Folder sounds_, partners_, partner_sounds_;
    std::map<std::string, std::size_t> most_samples_;  // by whose they are, where there are several
    std::map<fs::path, double> sound_seconds_;
    std::map<fs::path, Beyond> begun_after_, ended_after_;  // by the sound
    Lengths lengths_;
    Json hints_;
    std::vector<std::string> faults_;
};

}  // namespace

FoldersPlan plan_from_folders(const FoldersJob& job) {
    Matching matching(job);
    const std::vector<Segment> segments = read_segments(job.segments);
    Json clips = Json::array(), names = Json::array();
    for (const ConditionFolder& condition : job.conditions) names.push_back(condition.name);
    for (const Segment& segment : segments) {
        if (auto clip = matching.clip_of(segment)) clips.push_back(std::move(*clip));
    }
    FoldersPlan made{.plan = {}, .segments = segments.size(), .clips = clips.size()};
    made.notes = matching.notes();
    made.mismatches = matching.take_faults();
    if (clips.empty()) {
        throw Error(format("{}: no segment has a motion of every system: {}", job.segments.string(),
                           made.mismatches.front()));
    }
    made.plan["preset"] = job.preset;
    made.plan["conditions"] = std::move(names);
    if (!matching.hints().is_null()) made.plan["hints"] = matching.hints();
    made.plan["clips"] = std::move(clips);
    return made;
}

}  // namespace chironomia::study
