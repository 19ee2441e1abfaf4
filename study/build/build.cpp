#include "study/build/build.h"

#include <algorithm>
#include <cerrno>
#include <map>
#include <set>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/files/private_output.h"
#include "core/files/scratch_folder.h"
#include "core/hash.h"
#include "core/text.h"
#include "study/build/draft.h"
#include "study/build/study_files.h"
#include "study/record/study_record.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// Only a study, finished or not, may be built upon.
void require_study_folder(const StudyFolder& study) {
    if (!fs::exists(study.root)) return;
    const auto refuse = [&](const std::string& what) {
        throw Error(format("{}: {}; name a new folder", study.root.string(), what));
    };
    if (!fs::is_directory(study.root)) refuse("this is a file, a folder is needed");
    static const std::set<std::string> known = {"public", "private"};
    for (const auto& entry : fs::directory_iterator(study.root)) {
        const std::string name = entry.path().filename().string();
        if (known.count(name) == 0) refuse(format("holds \"{}\", which is no part of a study", name));
    }
    const bool unfinished = fs::exists(study.work());
    if (fs::exists(study.open()) && !unfinished && !fs::exists(study.manifest())) {
        refuse("holds a folder \"public\" that no study was built into");
    }
}

// Held while a study is built, so that two builds on a machine do not record the same videos. Where a shared file
// system has no such locks they may, with the same result.
class BuildLock {
  public:
    explicit BuildLock(const fs::path& folder)
        : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (handle_ < 0 || ::flock(handle_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
        ::close(handle_);
        throw Error(format("{}: another build is at work here; wait for it or name a new folder",
                           folder.parent_path().string()));
    }
    ~BuildLock() {
        if (handle_ >= 0) ::close(handle_);
    }
    BuildLock(const BuildLock&) = delete;
    BuildLock& operator=(const BuildLock&) = delete;

  private:
    int handle_;
};

// A finished study is replaced only with --replace, and never once people have answered it: their answers would
// have no key any more.
void require_may_replace(const StudyFolder& study, const BuildOptions& options) {
    for (const fs::path& sign :
         {study.answers(), study.database_elsewhere(), study.closed() / "answers.json"}) {
        if (!fs::exists(sign)) continue;
        throw Error(
            format("{}: people have answered this study ({}), and another one in its place would leave "
                   "their answers without a key; name a new folder",
                   study.root.string(), sign.string()));
    }
    if (fs::exists(study.manifest()) && !options.replace) {
        throw Error(format(
            "{}: holds a finished study of another seed, plan, input or program; name a new folder, or "
            "give --replace",
            study.root.string()));
    }
}

// Throws Error while a server shows the study's pages, which are about to be replaced.
void require_no_server(const StudyFolder& study) {
    const int handle = ::open(study.open().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle < 0) return;
    const bool is_free = ::flock(handle, LOCK_EX | LOCK_NB) == 0;
    ::close(handle);
    if (!is_free) {
        throw Error(format("{}: a server shows this study; stop it first, or name a new folder",
                           study.root.string()));
    }
}

void make_folder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) {
        throw Error(format("{}: cannot be made ({}); check that the folder above exists and is writable",
                           folder.string(), problem.message()));
    }
}

// Whether the folder was finished as this study.
bool is_same_study(const StudyFolder& study, const StudyDraft& draft) {
    if (!fs::exists(study.manifest())) return false;
    const Manifest manifest = read_manifest(study.manifest());
    return manifest.format == kManifestFormat && manifest.recipe == draft.recipe;
}

bool is_as_listed(const StudyFolder& study, const ListedFile& output) {
    const fs::path file = study.root / output.path;
    return fs::is_regular_file(file) && sha256_of_file(file) == output.sha256;
}

// Whether it is still there, whole.
bool is_finished(const StudyFolder& study, const StudyDraft& draft) {
    if (!is_same_study(study, draft) || !fs::exists(study.open())) return false;
    return std::ranges::all_of(read_manifest(study.manifest()).outputs,
                               [&](const ListedFile& output) { return is_as_listed(study, output); });
}

// Whether the notes of the finished study's recordings are those that it was built with.
bool has_notes_of_recordings(const StudyFolder& study) {
    if (!fs::exists(study.manifest()) || !fs::exists(study.recordings())) return false;
    return std::ranges::any_of(read_manifest(study.manifest()).outputs, [&](const ListedFile& output) {
        return study.root / output.path == study.recordings() && is_as_listed(study, output);
    });
}

// Takes back from the finished study in the folder what the new one needs too.
void unpack_recordings(const StudyFolder& study, const std::vector<Video>& videos) {
    constexpr long long kMostBytes = 1LL << 40;
    if (!has_notes_of_recordings(study)) return;
    std::map<std::string, const Video*> wanted;
    for (const Video& video : videos) wanted.emplace(video.recipe, &video);
    const Json notes = read_json(study.recordings());
    for (const JsonValue& note : JsonValue(notes, study.recordings().string()).items(0)) {
        const auto video = wanted.find(note.at("recipe").text());
        const fs::path file = study.open() / note.at("file").text();
        if (video == wanted.end() || !fs::is_regular_file(file)) continue;
        const fs::path copy = recording_file(study.work(), *video->second);
        if (fs::exists(copy)) continue;
        const auto length = static_cast<std::size_t>(note.at("bytes").integer(0, kMostBytes));
        const std::string bytes = read_text(file).substr(0, length);
        if (sha256(bytes) != note.at("sha256").text()) continue;
        write_text(copy, bytes);
        write_json(recording_note(study.work(), *video->second), note.json());
    }
}

// Participants could recognise conditions by the lengths of their videos.
void require_equal_lengths(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded) {
    std::map<std::size_t, std::size_t> first_of_clip;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        const std::size_t first = first_of_clip.emplace(draft.videos[i].shows.clip, i).first->second;
        if (recorded[i].result.frames == recorded[first].result.frames) continue;
        throw Error(
            format("clip \"{}\": its videos have {} and {} frames, all must be equally long; this is a "
                   "fault of the program, please report it",
                   draft.plan.clips[draft.videos[i].shows.clip].id, recorded[first].result.frames,
                   recorded[i].result.frames));
    }
}

// Lays the study out beside its recordings, and puts it in place: the private files, then public/ by one rename.
void lay_out(const StudyDraft& draft, const std::vector<RecordedVideo>& recorded, const StudyFolder& study) {
    const ScratchFolder scratch = ScratchFolder::within(study.work());
    const StudyFolder made{scratch.path()};
    make_folder(made.open());
    make_folder(made.closed());
    write_public_files(draft, recorded, made.open());
    write_private_files(draft, recorded, made);

    fs::remove_all(study.open());
    for (const std::string& name : list_files(made.closed()))
        scratch.move_out(fs::path("private") / name, study.closed() / name);
    scratch.move_out("public", study.open());
}

std::string conditions_of(const StudyDraft& draft, const Video& video) {
    std::vector<std::string> conditions;
    for (const std::size_t condition : video.shows.conditions)
        conditions.push_back(draft.plan.conditions[condition].name);
    return join(conditions, " and ");
}

std::vector<std::string> list_warnings(const StudyDraft& draft, const Video& video,
                                       const RecordedVideo& recorded) {
    std::vector<std::string> warnings;
    for (const std::string& warning : recorded.result.warnings) {
        warnings.push_back(format("clip \"{}\", {}: {}", draft.plan.clips[video.shows.clip].id,
                                  conditions_of(draft, video), warning));
    }
    return warnings;
}

// Of all videos of the study that are among `distinct` by their recipes, and of the scripts of their clips.
std::vector<std::string> list_warnings(const StudyDraft& draft, const std::vector<Video>& distinct,
                                       const std::vector<RecordedVideo>& recorded) {
    std::map<std::string_view, const RecordedVideo*> by_recipe;
    for (std::size_t i = 0; i < recorded.size(); ++i) by_recipe.emplace(distinct[i].recipe, &recorded[i]);
    std::set<std::size_t> clips;
    std::map<std::pair<std::size_t, std::string>, const Video*> first_alike;  // by clip and bytes
    std::vector<std::string> of_scripts, of_videos;
    for (const Video& video : draft.videos) {
        const auto found = by_recipe.find(video.recipe);
        if (found == by_recipe.end()) continue;
        clips.insert(video.shows.clip);
        const std::vector<std::string> more = list_warnings(draft, video, *found->second);
        of_videos.insert(of_videos.end(), more.begin(), more.end());
        const auto [first, is_new] =
            first_alike.emplace(std::pair(video.shows.clip, found->second->sha256), &video);
        if (is_new) continue;
        of_videos.push_back(format("clip \"{}\": the videos of {} and of {} are the same, byte for byte",
                                   draft.plan.clips[video.shows.clip].id,
                                   conditions_of(draft, *first->second), conditions_of(draft, video)));
    }
    for (const ClipNote& note : draft.performed.notes)
        if (clips.contains(note.clip)) of_scripts.push_back(note.text);
    of_scripts.insert(of_scripts.end(), of_videos.begin(), of_videos.end());
    return of_scripts;
}

BuildSummary summary_of(const StudyDraft& draft, const BuildOptions& options) {
    return {.folder = options.out,
            .pages = draft.all.design.pages.size(),
            .sheets = draft.all.sheets.size(),
            .videos = draft.videos.size(),
            .recorded = 0,
            .warnings = {}};
}

// Refuses a folder that may not become this study.
void require_same_study_or_leave(const StudyDraft& draft, const StudyFolder& study,
                                 const BuildOptions& options) {
    if (!is_same_study(study, draft)) require_may_replace(study, options);
    require_no_server(study);
}

// Records what is missing of `videos`, which are all or some of the study's.
Recordings record_missing(const StudyDraft& draft, const std::vector<Video>& videos,
                          const BuildOptions& options, const ClipMaker& maker) {
    const StudyFolder study{options.out};
    make_folder(study.work());
    unpack_recordings(study, videos);
    return record_videos(videos,
                         {.folder = study.work(),
                          .performed = draft.performed.folder ? draft.performed.folder->path() : fs::path(),
                          .plan_folder = draft.plan.file.parent_path(),
                          .jobs = options.jobs,
                          .quiet = options.quiet},
                         maker);
}

// Recordings that nobody needs any more. Another process may remove them at the same time.
void remove_recordings(const StudyFolder& study) {
    std::error_code ignored;
    fs::remove_all(study.work(), ignored);
}

}  // namespace

BuildSummary build_study(const Plan& plan, const BuildOptions& options, const ClipMaker& maker) {
    const StudyFolder study{options.out};
    require_study_folder(study);
    const StudyDraft draft = draft_study(plan, options.seed, maker);
    BuildSummary summary = summary_of(draft, options);

    make_private_folder(study.closed());
    const BuildLock lock(study.closed());
    if (is_finished(study, draft)) return summary;
    require_same_study_or_leave(draft, study, options);
    try {
        const Recordings recordings = record_missing(draft, draft.videos, options, maker);
        require_equal_lengths(draft, recordings.videos);
        summary.recorded = recordings.recorded;
        summary.warnings = list_warnings(draft, draft.videos, recordings.videos);
        require_same_study_or_leave(draft, study, options);
        if (!is_finished(study, draft)) lay_out(draft, recordings.videos, study);
    } catch (const Error&) {
        // Another process may have finished the study, and taken the recordings away.
        if (!is_finished(study, draft)) throw;
    }
    remove_recordings(study);
    return summary;
}

StudyState inspect_study(StudyDraft draft, const BuildOptions& options) {
    const StudyFolder study{options.out};
    require_study_folder(study);
    StudyState state{.draft = std::move(draft), .distinct = {}};
    state.distinct = distinct_videos(state.draft.videos);
    state.finished = is_finished(study, state.draft);
    if (state.finished) return state;
    require_same_study_or_leave(state.draft, study, options);
    state.missing = list_missing(state.distinct, study.work());
    return state;
}

std::vector<std::string> warnings_of_finished(const StudyDraft& draft, const fs::path& folder) {
    const fs::path file = StudyFolder{folder}.recordings();
    const Json json = read_json(file);
    const std::vector<JsonValue> notes = JsonValue(json, file.string()).items(draft.videos.size());
    std::vector<RecordedVideo> recorded(draft.videos.size());
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        recorded[i].result.warnings = warnings_of_note(notes[i]);
        recorded[i].sha256 = notes[i].at("sha256").text();
    }
    return list_warnings(draft, draft.videos, recorded);
}

ShardSummary build_shard(const Plan& plan, const Shard& shard, const BuildOptions& options,
                         const ClipMaker& maker) {
    const StudyFolder study{options.out};
    require_study_folder(study);
    const StudyDraft draft = draft_study(plan, options.seed, maker);
    const std::vector<Video> videos = part_of(distinct_videos(draft.videos), shard);
    ShardSummary summary{.videos = videos.size()};

    make_private_folder(study.closed());
    if (is_finished(study, draft)) return summary;
    require_same_study_or_leave(draft, study, options);
    try {
        const Recordings recordings = record_missing(draft, videos, options, maker);
        summary.recorded = recordings.recorded;
        summary.warnings = list_warnings(draft, videos, recordings.videos);
    } catch (const Error&) {
        if (!is_finished(study, draft)) throw;
    }
    if (is_finished(study, draft)) remove_recordings(study);
    return summary;
}

}  // namespace chironomia::study
