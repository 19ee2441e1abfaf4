#include "study/clip/pipeline.h"

#include <malloc.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <future>
#include <latch>
#include <thread>

#include "core/cores.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_length.h"
#include "study/clip/film.h"
#include "study/clip/frame_sink.h"
#include "study/clip/notice.h"
#include "study/clip/performance.h"
#include "study/clip/recipe_memory.h"
#include "study/clip/soundtrack.h"
#include "study/clip/stage.h"
#include "study/clip/walkers.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// Threads that the libraries of drawing, encoding and images start: ours, counted with `--threads 0`.
constexpr std::size_t kThreadsPerCore = 6;
constexpr std::size_t kOtherThreads = 8;

// Throws std::system_error if the system allows fewer threads than the clip needs: starts as many and ends
// them again. The libraries would end the program when one is refused to them.
void check_thread_limit(const ClipJob& job) {
    const std::size_t cores = static_cast<std::size_t>(available_cores());
    std::vector<std::jthread> asked;
    std::latch together(1);
    try {
        while (asked.size() <
               kThreadsPerCore * cores + kOtherThreads + 2 * static_cast<std::size_t>(job.threads))
            asked.emplace_back([&together] { together.wait(); });
    } catch (...) {
        together.count_down();
        throw;
    }
    together.count_down();
}

// Whether a video of a study ends before so many frames: what is cut away needs no warning.
bool ends_before(const ClipJob& job, double frames) {
    return job.at_least && job.frames.last && static_cast<double>(*job.frames.last) <= frames;
}

// What moves decides, unless the job or the sound asks for more.
ClipLength length_of_clip(std::size_t frames, const ClipJob& job, const std::optional<Audio>& sound) {
    if (job.at_least) {
        frames = std::max(frames,
                          static_cast<std::size_t>(std::ceil(*job.at_least * job.fps.per_second() - 1e-6)));
    }
    ClipLength length =
        match_lengths(frames, job.fps, sound && !picture_sets_length(job) ? &*sound : nullptr);
    const double moved = static_cast<double>(frames);
    const double heard = sound ? sound->duration() * job.fps.per_second() + 1 : moved;
    if (ends_before(job, std::min(moved, heard))) length.warnings.clear();
    return length;
}

// The longest motion decides.
ClipLength length_of_clip(const std::vector<Performance>& people, const ClipJob& job,
                          const std::optional<Audio>& sound) {
    std::size_t frames = 0;
    for (const Performance& performance : people) frames = std::max(frames, performance.fit.poses.size());
    ClipLength length = length_of_clip(frames, job, sound);
    for (const Performance& performance : people) {
        length.warnings.insert(length.warnings.end(), performance.warnings.begin(),
                               performance.warnings.end());
        const std::size_t moved = performance.fit.poses.size();
        if (moved == length.frames - length.held_frames || ends_before(job, static_cast<double>(moved)))
            continue;
        length.warnings.push_back(format("{}: the motion lasts {} frames of {}; its last pose is held",
                                         performance.motion_file.string(), performance.fit.poses.size(),
                                         length.frames));
    }
    return length;
}

// A motion may leave the fixed picture; whoever shows the clip must know. A part is named where it is outside in more
// frames than those before it, since a walker takes all of them along.
std::vector<std::string> warn_of_frames_outside(const FramesOutside& outside, const Performance& person,
                                                std::size_t people) {
    constexpr std::string_view kWider =
        "choose a wider scene, such as a scene file with {\"camera\": {\"zoom\": 0.9}}";
    const std::string file = person.motion_file.string();
    const auto warning = [&](std::string_view what, std::size_t frames, std::string_view advice) {
        return format("{}: {} in {} of {} frames; {}", file, what, frames, outside.of, advice);
    };
    if (!person.boxes.empty()) {
        if (outside.figure == 0) return {};
        return {warning("the middle of the model is outside the picture", outside.figure,
                        "let --scene object follow its size, or choose a wider scene")};
    }
    const std::string_view go_along =
        people > 1 ? "hold the figure with --in-place or --body upper (of a plan: \"travel\": \"in-place\", "
                     "\"body\": \"upper\"), or choose a wider scene"
                   : "go along with --follow, or hold the figure with --in-place or --body upper (of a plan: "
                     "\"travel\": \"follow\" or \"in-place\", \"body\": \"upper\"), or choose a wider scene";
    std::vector<std::string> warnings;
    if (outside.figure > 0)
        warnings.push_back(warning("the head is outside the picture", outside.figure, go_along));
    if (outside.feet > outside.figure)
        warnings.push_back(warning("a foot is outside the picture", outside.feet, go_along));
    if (outside.hands > std::max(outside.figure, outside.feet))
        warnings.push_back(warning(outside.shows_feet
                                       ? "a hand is outside the picture"
                                       : "a hand leaves the picture by its upper edge or a side",
                                   outside.hands, kWider));
    return warnings;
}

std::vector<std::string> warn_of_frames_outside(const Stage& stage, const std::vector<Performance>& people,
                                                const FrameRange& shown) {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < people.size(); ++i) {
        const std::vector<std::string> more =
            warn_of_frames_outside(frames_outside(stage, people, i, shown), people[i], people.size());
        warnings.insert(warnings.end(), more.begin(), more.end());
    }
    return warnings;
}

FrameRange checked_range(const ClipJob& job, std::size_t frames) {
    const std::size_t last = job.frames.last.value_or(frames);
    if (job.frames.first >= frames || last > frames) {
        throw Error(
            format("{}: frames {}:{} were asked for, but the clip has {} frames; choose a range within 0:{}",
                   job.out.string(), job.frames.first, last, frames, frames));
    }
    return {.first = job.frames.first, .last = last};
}

// How strongly each of the people is shown to speak, at every frame of the clip; nobody if no cue is drawn.
using CueStrengths = std::vector<std::vector<float>>;

CueStrengths strengths_of_cues(const ClipJob& job, const std::vector<Audio>& voices, std::size_t frames) {
    if (job.cue == SpeakingCue::none) return {};
    if (voices.empty()) {
        throw Error(
            "speaking cue: needs the voices of two people; give two motions and --audio twice, or no cue");
    }
    CueStrengths strengths;
    for (const Audio& voice : voices) strengths.push_back(cue_strengths(voice, job.fps, frames));
    return strengths;
}

// Where and how strongly it shows who speaks.
struct Cues {
    std::vector<Vec2> places;  // of the people [px]
    CueStrengths strengths;
};

Cues place_cues(CueStrengths strengths, const Stage& stage, const std::vector<Performance>& people) {
    Cues cues{.strengths = std::move(strengths)};
    for (std::size_t i = 0; i < cues.strengths.size(); ++i)
        cues.places.push_back(cue_place(stage, people, i));
    return cues;
}

// What is drawn over the frames of a clip.
struct Overlays {
    Cues cues;
    std::optional<NoticePlate> notice;

    void draw_on(Frame& picture, std::size_t frame) const {
        for (std::size_t i = 0; i < cues.places.size(); ++i)
            draw_cue(picture, cues.places[i], cues.strengths[i][frame]);
        if (notice) notice->draw_on(picture, frame);
    }
};

std::optional<NoticePlate> make_notice(const ClipJob& job, std::size_t frames) {
    if (!job.notice) return std::nullopt;
    return NoticePlate(*job.notice, job.size, job.fps, frames);
}

// All that a frame shows.
struct Shown {
    const Stage& stage;
    const std::vector<Performance>& people;
    const Overlays& overlays;
};

// Mesh, pixels and file side by side: while a frame is drawn, the next is skinned, or drawn as well, and the one before
// is written.
void record_frames(const Shown& shown, const FrameRange& range, FrameSink& sink, Progress& progress) {
    const std::size_t at_once = frames_at_once(shown.stage);
    const auto draw_later = [&](std::size_t frame) {
        auto exposed = std::async(std::launch::async,
                                  [&shown, frame] { return expose_all(shown.stage, shown.people, frame); });
        // One at a time is drawn by this thread, when it is waited for.
        return std::async(
            at_once > 1 ? std::launch::async : std::launch::deferred,
            [&shown, exposed = std::move(exposed)]() mutable { return draw(shown.stage, exposed.get()); });
    };
    std::deque<std::future<Frame>> drawn;
    for (std::size_t frame = range.first, next = frame; frame < *range.last; ++frame) {
        while (next < *range.last && drawn.size() < std::max<std::size_t>(2, at_once))
            drawn.push_back(draw_later(next++));
        Frame picture = drawn.front().get();
        drawn.pop_front();
        shown.overlays.draw_on(picture, frame);
        sink.write(std::move(picture));
        progress.step();
    }
    sink.finish();
}

void describe(const Performance& performance, const std::string& blur, Json& motions) {
    Json modes = performance.modes;
    if (!blur.empty()) modes.push_back(format("blurred with {}", blur));
    Json fit = performance.boxes.empty() ? to_json(performance.fit.report) : Json();
    if (performance.face) {
        fit["face"] = to_json(*performance.face);
        fit["face"]["file"] = performance.face_file.string();
    }
    motions.push_back({{"file", performance.motion_file.string()},
                       {"detected", performance.notes},
                       {"modes", std::move(modes)},
                       {"fit", std::move(fit)}});
}

// `motions` says how each was shown.
ClipResult with_report(ClipResult result, Json motions, Json recipe) {
    result.report = {{"frames", result.frames},
                     {"seconds", result.seconds},
                     {"warnings", result.warnings},
                     {"motions", std::move(motions)},
                     {"recipe", std::move(recipe)}};
    return result;
}

// Options of a face may be given once for two people, of whom one has a face.
void refuse_options_of_faces(const ClipJob& job, const std::vector<Performance>& people) {
    for (const Performance& person : people)
        if (person.face) return;
    for (std::size_t i = 0; i < people.size(); ++i)
        chironomia::refuse_options_of_faces(job.performers[i].face_options, people[i].motion_file);
}

// What has been filmed needs no avatar and no scene.
ClipResult record_film(const ClipJob& job) {
    Film film(job);
    Soundtrack track = read_soundtrack(job);
    const ClipLength length = length_of_clip(film.frames(), job, track.sound);
    const FrameRange range = checked_range(job, length.frames);
    finish(track, job, length.frames, range);
    const Overlays overlays{.cues = {}, .notice = make_notice(job, length.frames)};
    std::vector<std::string> warnings = track.warnings;
    warnings.insert(warnings.end(), length.warnings.begin(), length.warnings.end());

    FrameSink sink(job, track.sound);
    const std::size_t frames = *range.last - range.first;
    Progress progress(job.out.filename().string(), "frames", frames, job.quiet);
    for (std::size_t frame = 0; frame < *range.last; ++frame) {
        Frame picture = film.next();
        if (frame < range.first) continue;
        overlays.draw_on(picture, frame);
        sink.write(std::move(picture));
        progress.step();
    }
    sink.finish();
    Json motions = Json::array({{{"file", job.performers.front().film.string()},
                                 {"detected", {"a film"}},
                                 {"modes", Json::array()},
                                 {"fit", Json()}}});
    return with_report(
        {.frames = frames, .seconds = job.fps.seconds(frames), .warnings = std::move(warnings), .report = {}},
        std::move(motions), recipe_of(job, std::vector<CompanionFiles>(1)));
}

}  // namespace

ClipResult record_clip(const ClipJob& job) {
    // Each frame is made by threads of its own. With a heap for each of them the program takes a fifth more memory.
    mallopt(M_ARENA_MAX, 2);
    check_thread_limit(job);
    for (const Performer& performer : job.performers)
        if (!performer.film.empty()) return record_film(job);
    std::vector<Performance> people;
    for (const Performer& performer : job.performers) people.push_back(perform(performer, job));
    refuse_options_of_faces(job, people);
    const Stage stage = make_stage(people, job);
    follow_walkers(people, job, stage);
    for (Performance& person : people) person.avatar.images = {};  // the renderers have their own by now
    malloc_trim(0);  // what reading and preparing took is not needed again

    Soundtrack track = read_soundtrack(job);
    const ClipLength length = length_of_clip(people, job, track.sound);
    const FrameRange range = checked_range(job, length.frames);
    finish(track, job, length.frames, range);
    std::vector<std::string> warnings = warn_of_frames_outside(stage, people, range);
    for (const auto& more : {track.warnings, length.warnings})
        warnings.insert(warnings.end(), more.begin(), more.end());

    const std::size_t frames = *range.last - range.first;
    const Overlays overlays{
        .cues = place_cues(strengths_of_cues(job, track.voices, length.frames), stage, people),
        .notice = make_notice(job, length.frames)};
    FrameSink sink(job, track.sound);
    Progress progress(job.out.filename().string(), "frames", frames, job.quiet);
    record_frames({.stage = stage, .people = people, .overlays = overlays}, range, sink, progress);

    Json motions = Json::array();
    std::vector<CompanionFiles> companions;
    for (std::size_t i = 0; i < people.size(); ++i) {
        describe(people[i], stage.blurs[i], motions);
        companions.push_back(people[i].companions);
    }
    return with_report(
        {.frames = frames, .seconds = job.fps.seconds(frames), .warnings = std::move(warnings), .report = {}},
        std::move(motions), recipe_of(job, companions));
}

ClipMaker clip_maker() {
    const auto read_all = [](const ClipJob& job) {
        ClipMotions all;
        for (const Performer& performer : job.performers) {
            if (!performer.film.empty()) {
                all.length = std::max(all.length, job.fps.seconds(Film(job).frames()));
                all.shown_face.push_back(true);
                all.is_film = true;
                continue;
            }
            const PerformerMotions motions = read_motions(performer, job);
            if (motions.frames) all.length = std::max(all.length, job.fps.seconds(*motions.frames));
            bool has_face = false;
            for (const auto* motion : {&motions.body, &motions.face}) {
                if (!*motion) continue;
                if (!motions.frames) all.length = std::max(all.length, duration(**motion));
                has_face = has_face || (*motion)->face;
            }
            all.shown_face.push_back(has_face && !is_stick(performer.avatar) &&
                                     performer.modes.face_mode != FaceMode::neutral);
        }
        return all;
    };
    return {
        .record = record_clip,
        .recipe = [memory = RecipeMemory()](const ClipJob& job) mutable { return recipe_of(job, memory); },
        .motions = read_all};
}

}  // namespace chironomia::study
