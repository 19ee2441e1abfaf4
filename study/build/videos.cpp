#include "study/build/videos.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/cores.h"
#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json_value.h"
#include "core/files/scratch_folder.h"
#include "core/hash.h"
#include "core/progress.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "study/build/workers.h"
#include "study/clip/film.h"
#include "study/design/mismatch.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// The partner stands on their side of the one agent, and both have voices of their own if the partner has.
void add_partner(const Plan& plan, const PlanPartner& partner, const PlanClip& clip, ClipJob& job) {
    Performer performer{.motion = partner.motion,
                        .hints = partner.hints,
                        .face = partner.face.empty() ? std::nullopt : std::optional(partner.face),
                        .avatar = partner.avatar.empty() ? plan.render.avatar : partner.avatar,
                        .modes = plan.render.modes};
    if (!partner.audio.empty()) {
        performer.voice = partner.audio;
        job.performers.front().voice = clip.audio;
    }
    job.performers.insert(plan.render.partner_on_left ? job.performers.begin() : job.performers.end(),
                          std::move(performer));
}

// The clip whose motion, and the clip whose speech a video shows.
struct Sources {
    std::size_t motion = 0;
    std::size_t speech = 0;
};

// `other` is what each clip is mismatched with.
Sources sources_of(const Plan& plan, const VideoWish& wish, const std::vector<std::size_t>& other) {
    const Making making = plan.conditions[wish.conditions.front()].making;
    return {.motion = making == Making::mismatched_motion ? other[wish.clip] : wish.clip,
            .speech = making == Making::mismatched_speech ? other[wish.clip] : wish.clip};
}

// A condition on a clip: the motion is its own, or that of the condition that it is made of.
Performer performer_of(const Plan& plan, std::size_t condition, const PlanClip& clip, const ClipJob& job) {
    const PlanCondition& made = plan.conditions[condition];
    const std::size_t source = has_motions(made) ? condition : made.from;
    const bool has_face = !clip.faces.empty() && !clip.faces[source].empty();
    Performer performer{.motion = clip.motions[source],
                        .hints = plan.hints[condition],
                        .face = has_face ? std::optional(clip.faces[source]) : std::nullopt,
                        .avatar = plan.render.avatar,
                        .modes = plan.modes[condition],
                        .cut = clip.cut || !job.cut ? clip.cut : Cut{}};
    if (made.making == Making::anchor) performer.anchor = made.anchor;
    if (!is_film(performer.motion)) return performer;
    if (performer.anchor || performer.face) {
        throw Error(format("{}: is a film, which has no {}; name a motion for the condition \"{}\"",
                           performer.motion.string(),
                           performer.anchor ? "joints to make worse" : "other face",
                           plan.conditions[condition].name));
    }
    performer.film = std::exchange(performer.motion, {});
    return performer;
}

// Text comes when the clip has been seen for a while and stays; speech begins early enough to end in the
// clip.
void add_notice(const Plan& plan, const CheckNotice& notice, double seconds, ClipJob& job) {
    constexpr double kTextAt = 0.3;    // of the length
    constexpr double kSpokenAt = 0.5;  // [s]
    if (notice.spoken) {
        job.spoken = SpokenNotice{.text = notice.text, .language = plan.texts.language, .at = kSpokenAt};
        require_notice_fits(*job.spoken, seconds);
    } else {
        require_notice_fits(notice.text, job.size);
        job.notice = Notice{.text = notice.text, .from = kTextAt * seconds};
    }
}

ClipJob job_of(const Plan& plan, const VideoWish& wish, const Sources& sources) {
    const PlanClip& clip = plan.clips[wish.clip];
    const PlanClip& heard = plan.clips[sources.speech];
    ClipJob job;
    job.cut = heard.cut;
    job.performers.clear();
    for (const std::size_t condition : wish.conditions)
        job.performers.push_back(performer_of(plan, condition, plan.clips[sources.motion], job));
    if (clip.partner) add_partner(plan, *clip.partner, clip, job);
    job.beside = wish.conditions.size() > 1;
    const bool has_voices = clip.partner && !clip.partner->audio.empty();
    if (!clip.audio.empty() && !has_voices) {
        job.audio = heard.audio;
        if (sources.speech != sources.motion) job.sound_cut = heard.cut.value_or(Cut{});
    }
    job.silent = plan.silent;
    // The number of channels would reveal whose speech it is.
    job.stereo = has_mismatch(plan);
    if (has_sound(plan)) job.loudness = plan.render.loudness;
    job.cue = plan.render.cue;
    job.scene = plan.render.scene;
    job.size = plan.render.size;
    job.fps = plan.render.fps;
    job.upper_body = plan.render.upper_body;
    job.travel = plan.render.travel;
    job.drawing = plan.render.drawing;
    job.out = "video." + plan.render.format;
    job.quiet = true;
    return job;
}

Json as_json(const ClipResult& result) {
    return {{"frames", result.frames},
            {"seconds", result.seconds},
            {"warnings", result.warnings},
            {"report", result.report}};
}

RecordedVideo read_recording(const fs::path& file, const fs::path& note) {
    constexpr long long kMost = 1LL << 40;
    const Json json = read_json(note);
    const JsonValue value(json, note.string());
    RecordedVideo recorded{.file = file, .result = {}, .sha256 = value.at("sha256").text()};
    recorded.result.frames = static_cast<std::size_t>(value.at("frames").integer(0, kMost));
    recorded.result.seconds = value.at("seconds").number(0, kMost);
    recorded.result.warnings = warnings_of_note(value);
    recorded.result.report = value.at("report").json();
    return recorded;
}

// A recording that is there, whole and unchanged. One whose note is damaged is made again.
std::optional<RecordedVideo> find_recording(const fs::path& folder, const Video& video) {
    const fs::path file = recording_file(folder, video);
    const fs::path note = recording_note(folder, video);
    if (!fs::exists(file) || !fs::exists(note)) return std::nullopt;
    try {
        RecordedVideo found = read_recording(file, note);
        if (sha256_of_file(file) != found.sha256) return std::nullopt;
        return found;
    } catch (const Error&) {
        return std::nullopt;
    }
}

int threads_for(int jobs) {
    if (jobs == 1) return 0;
    return std::max(1, available_cores() / jobs);
}

// A note with another beginning of the paths that lie in a folder, so that it does not depend on where that is.
Json with_folder_renamed(const Json& note, const fs::path& folder, const std::string& name) {
    if (folder.empty()) return note;
    const std::string quoted = Json((folder / "").string()).dump();
    const std::string beginning = quoted.substr(1, quoted.size() - 2);
    std::string text = note.dump();
    for (std::size_t at = 0; (at = text.find(beginning, at)) != std::string::npos;) {
        // Elsewhere it is the middle of another path.
        const bool begins_path = std::string_view("\" (").find(text[at - 1]) != std::string_view::npos;
        if (begins_path) text.replace(at, beginning.size(), name);
        at += begins_path ? name.size() : 1;
    }
    return Json::parse(text);
}

// Makes file and note in `scratch`, then puts them in place.
void record_one(const Video& video, const RecordingOptions& options, const ScratchFolder& scratch,
                const ClipMaker& maker) {
    ClipJob job = video.job;
    job.out = recording_file(scratch.path(), video);
    job.threads = threads_for(options.jobs);
    Json note = as_json(maker.record(job));
    note = with_folder_renamed(note, options.performed, "performed/");
    note = with_folder_renamed(note, options.plan_folder, "");
    note["sha256"] = sha256_of_file(job.out);
    write_json(recording_note(scratch.path(), video), note);
    for (const auto& place : {recording_file, recording_note})
        scratch.move_out(place(fs::path(), video), place(options.folder, video));
}

// Which condition of a clip has a face that moves, and which has none, as far as that is known by now.
struct Faces {
    std::optional<std::size_t> with;
    std::optional<std::size_t> without;
};

// A face that moves in some conditions only would reveal them.
void require_faces_of_all_or_none(const Plan& plan, const VideoWish& wish, const ClipMotions& motions,
                                  Faces& faces) {
    const PlanClip& clip = plan.clips[wish.clip];
    const std::size_t first = clip.partner && plan.render.partner_on_left ? 1 : 0;
    for (std::size_t i = 0; i < wish.conditions.size(); ++i) {
        // A mode that holds the face still is a factor of the study.
        if (plan.modes[wish.conditions[i]].face_mode == FaceMode::neutral) continue;
        // A film shows a real face; a plan that compares it with an avatar does so on purpose.
        if (motions.is_film) continue;
        (motions.shown_face[first + i] ? faces.with : faces.without) = wish.conditions[i];
    }
    if (!faces.with || !faces.without) return;
    throw Error(format(
        "clip \"{}\": \"{}\" moves the face and \"{}\" does not; give every condition a \"face\", or set "
        "the \"face_mode\" to \"neutral\"",
        clip.id, plan.conditions[*faces.with].name, plan.conditions[*faces.without].name));
}

// One camera for all conditions of a clip: it follows all of them. A film has no hips to follow.
void follow_all_conditions(const Plan& plan, const std::vector<std::size_t>& other, const VideoWish& wish,
                           ClipJob& job) {
    std::vector<Performer> followed;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        const Sources sources = sources_of(plan, {.clip = wish.clip, .conditions = {i}}, other);
        Performer performer = performer_of(plan, i, plan.clips[sources.motion], job);
        if (performer.film.empty()) followed.push_back(std::move(performer));
    }
    const bool behind_partner = plan.clips[wish.clip].partner && plan.render.partner_on_left;
    for (std::size_t i = 0; i < wish.conditions.size(); ++i)
        job.performers[(behind_partner ? 1 : 0) + i].followed = followed;
}

// The motions of each clip, each alone in a video; of all conditions that have their own, whatever the wishes need.
using MotionsOfClips = std::vector<std::map<std::size_t, ClipMotions>>;

MotionsOfClips read_motions_of_clips(const Plan& plan, const ClipMaker& maker) {
    MotionsOfClips all(plan.clips.size());
    for (std::size_t clip = 0; clip < plan.clips.size(); ++clip) {
        for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
            if (!has_motions(plan.conditions[condition])) continue;
            const ClipJob job =
                job_of(plan, {.clip = clip, .conditions = {condition}}, {.motion = clip, .speech = clip});
            all[clip].emplace(condition, maker.motions(job));
        }
    }
    return all;
}

// Of the longest motion of each clip [s].
std::vector<double> lengths_of_clips(const MotionsOfClips& motions) {
    std::vector<double> longest;
    for (const auto& of_clip : motions) {
        longest.push_back(0);
        for (const auto& [condition, of_condition] : of_clip)
            longest.back() = std::max(longest.back(), of_condition.length);
    }
    return longest;
}

// Whole sounds are heard to their end, and then by the clips that are mismatched with them, too.
void cover_sounds(const Plan& plan, std::vector<double>& lengths) {
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const PlanClip& clip = plan.clips[i];
        if (clip.cut) continue;
        for (const fs::path& file : {clip.audio, clip.partner ? clip.partner->audio : fs::path()})
            if (!file.empty()) lengths[i] = std::max(lengths[i], read_audio(file).duration());
    }
}

// The motions of a video, which are not read twice. `moved` is the clip that they are of.
ClipMotions motions_of(const Video& video, std::size_t moved, const MotionsOfClips& known,
                       const ClipMaker& maker) {
    const VideoWish& wish = video.shows;
    if (wish.conditions.size() > 1 || moved != wish.clip) return maker.motions(video.job);
    const auto found = known[wish.clip].find(wish.conditions.front());
    return found == known[wish.clip].end() ? maker.motions(video.job) : found->second;
}

// What each clip is mismatched with; itself where nothing is.
std::vector<std::size_t> draw_others(const Plan& plan, const std::vector<double>& lengths,
                                     std::uint64_t seed) {
    if (!has_mismatch(plan)) {
        std::vector<std::size_t> none(plan.clips.size());
        std::iota(none.begin(), none.end(), 0u);
        return none;
    }
    std::vector<SpokenClip> clips;
    for (std::size_t i = 0; i < plan.clips.size(); ++i)
        clips.push_back({.id = plan.clips[i].id, .speaker = plan.clips[i].speaker, .seconds = lengths[i]});
    return draw_mismatch(clips, {.tolerance = plan.length_tolerance, .seed = seed});
}

}  // namespace

fs::path recording_file(const fs::path& folder, const Video& video) {
    return folder / (video.recipe + video.job.out.extension().string());
}

std::vector<std::string> warnings_of_note(const JsonValue& note) {
    std::vector<std::string> warnings;
    for (const JsonValue& warning : note.at("warnings").items(0)) {
        if (!warning.json().is_string()) warning.refuse(format("is {}, a text is needed", warning.shown()));
        warnings.push_back(warning.json().get<std::string>());
    }
    return warnings;
}

fs::path recording_note(const fs::path& folder, const Video& video) {
    return folder / (video.recipe + ".json");
}

std::vector<Video> list_videos(const Plan& plan, const std::vector<VideoWish>& wishes, std::uint64_t seed,
                               const ClipMaker& maker) {
    const MotionsOfClips motions = read_motions_of_clips(plan, maker);
    std::vector<double> lengths = lengths_of_clips(motions);
    if (has_mismatch(plan)) cover_sounds(plan, lengths);
    const std::vector<std::size_t> other = draw_others(plan, lengths, seed);
    std::vector<Faces> faces(plan.clips.size());
    std::vector<Video> videos;
    for (const VideoWish& wish : wishes) {
        const Sources sources = sources_of(plan, wish, other);
        Video video{.shows = wish,
                    .motion = sources.motion,
                    .speech = sources.speech,
                    .job = job_of(plan, wish, sources)};
        if (plan.render.travel == Travel::follow) follow_all_conditions(plan, other, wish, video.job);
        require_faces_of_all_or_none(plan, wish, motions_of(video, sources.motion, motions, maker),
                                     faces[wish.clip]);
        video.job.at_least = lengths[wish.clip];
        // A pose that is held, or speech that is missing at the end, would reveal the mismatched condition.
        const double shown = std::min(lengths[wish.clip], lengths[other[wish.clip]]);
        if (has_mismatch(plan))
            video.job.frames.last = static_cast<std::size_t>(shown * plan.render.fps.per_second() + 1e-6);
        try {
            if (wish.notice) add_notice(plan, *wish.notice, shown, video.job);
        } catch (const Error& fault) {
            throw Error(format("clip \"{}\": {}", plan.clips[wish.clip].id, fault.what()));
        }
        video.recipe = sha256(maker.recipe(video.job).dump());
        videos.push_back(std::move(video));
    }
    return videos;
}

std::vector<Video> distinct_videos(const std::vector<Video>& videos) {
    std::vector<Video> distinct;
    std::set<std::string> known;
    for (const Video& video : videos) {
        if (known.insert(video.recipe).second) distinct.push_back(video);
    }
    return distinct;
}

std::vector<std::size_t> list_missing(const std::vector<Video>& distinct, const fs::path& folder) {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < distinct.size(); ++i) {
        if (!find_recording(folder, distinct[i])) missing.push_back(i);
    }
    return missing;
}

Recordings record_videos(const std::vector<Video>& videos, const RecordingOptions& options,
                         const ClipMaker& maker) {
    const std::vector<Video> distinct = distinct_videos(videos);
    const std::vector<std::size_t> missing = list_missing(distinct, options.folder);
    Progress progress("study", "videos", missing.size(), options.quiet);
    const ScratchFolder scratch = ScratchFolder::within(options.folder);
    perform_all({.count = missing.size(),
                 .perform = [&](std::size_t i) { record_one(distinct[missing[i]], options, scratch, maker); },
                 .name =
                     [&](std::size_t i) {
                         const Performer& first = distinct[missing[i]].job.performers.front();
                         return (first.film.empty() ? first.motion : first.film).string();
                     }},
                options.jobs, progress);

    Recordings all{.videos = {}, .recorded = missing.size()};
    for (const Video& video : videos) {
        auto found = find_recording(options.folder, video);
        if (!found) {
            throw Error(format("{}: changed while the study was being built; build again",
                               recording_file(options.folder, video).string()));
        }
        all.videos.push_back(std::move(*found));
    }
    return all;
}

}  // namespace chironomia::study
