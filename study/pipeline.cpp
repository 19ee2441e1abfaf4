#include "study/pipeline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <future>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "raster/ffmpeg/clip_length.h"
#include "study/frame_sink.h"
#include "study/performance.h"
#include "study/soundtrack.h"
#include "study/stage.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

// The longest motion decides, unless the job or the sound asks for more.
ClipLength length_of_clip(const std::vector<Performance>& people, const ClipJob& job,
                          const std::optional<Audio>& sound) {
    std::size_t frames = 0;
    for (const Performance& performance : people) frames = std::max(frames, performance.fit.poses.size());
    if (job.at_least) {
        frames = std::max(frames,
                          static_cast<std::size_t>(std::ceil(*job.at_least * job.fps.per_second() - 1e-6)));
    }
    ClipLength length = agree_length(frames, job.fps, sound && !picture_decides(job) ? &*sound : nullptr);
    for (const Performance& performance : people) {
        length.warnings.insert(length.warnings.end(), performance.warnings.begin(),
                               performance.warnings.end());
        if (performance.fit.poses.size() == frames) continue;
        length.warnings.push_back(format("{}: the motion lasts {} frames of {}; its last pose is held",
                                         performance.motion_file.string(), performance.fit.poses.size(),
                                         length.frames));
    }
    return length;
}

// A motion may walk out of the fixed picture; whoever shows the clip must know.
std::vector<std::string> warn_of_frames_outside(const Stage& stage, const std::vector<Performance>& people) {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < people.size(); ++i) {
        const std::size_t outside = frames_outside(stage, people, i);
        if (outside == 0) continue;
        const bool person = people[i].boxes.empty();
        warnings.push_back(format(
            "{}: the {} is outside the picture in {} of {} frames; {}, or choose a "
            "wider scene",
            people[i].motion_file.string(), person ? "head" : "middle of the model", outside,
            people[i].fit.poses.size(),
            person ? "hold the figure in place with --body upper" : "let --scene object follow its size"));
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

// Where and how strongly it shows who speaks.
struct Cues {
    std::vector<Vec2> places;                   // of the people [px]; empty: none are drawn
    std::vector<std::vector<float>> strengths;  // of each at every frame of the clip
};

Cues make_cues(const ClipJob& job, const Stage& stage, const std::vector<Performance>& people,
               const std::vector<Audio>& voices, std::size_t frames) {
    if (job.cue == SpeakingCue::none) return {};
    if (voices.empty()) {
        throw Error(
            "speaking cue: needs the voices of two people; give two motions and --audio twice, or no cue");
    }
    Cues cues;
    for (std::size_t i = 0; i < people.size(); ++i) {
        cues.places.push_back(cue_place(stage, people, i));
        cues.strengths.push_back(voice_activity(voices[i], job.fps, frames));
    }
    return cues;
}

// Mesh, pixels and file side by side: while a frame is drawn, the next is skinned and the one before is
// written.
void record_frames(const Stage& stage, const std::vector<Performance>& people, const Cues& cues,
                   const FrameRange& range, FrameSink& sink, Progress& progress) {
    const auto expose_later = [&stage, &people](std::size_t frame) {
        return std::async(std::launch::async,
                          [&stage, &people, frame] { return expose_all(stage, people, frame); });
    };
    std::future<std::vector<Exposure>> exposed = expose_later(range.first);
    for (std::size_t frame = range.first; frame < *range.last; ++frame) {
        const std::vector<Exposure> exposures = exposed.get();
        if (frame + 1 < *range.last) exposed = expose_later(frame + 1);
        Frame picture = draw(stage, exposures);
        for (std::size_t i = 0; i < cues.places.size(); ++i)
            draw_cue(picture, cues.places[i], cues.strengths[i][frame]);
        sink.write(std::move(picture));
        progress.step();
    }
    sink.finish();
}

Json report_of(const ClipJob& job, const ClipResult& result, const Stage& stage,
               const std::vector<Performance>& people) {
    Json report;
    report["frames"] = result.frames;
    report["seconds"] = result.seconds;
    report["warnings"] = result.warnings;
    for (std::size_t i = 0; i < people.size(); ++i) {
        const Performance& performance = people[i];
        Json modes = performance.modes;
        if (!stage.blurs[i].empty()) modes.push_back(format("blurred with {}", stage.blurs[i]));
        Json fit = performance.boxes.empty() ? to_json(performance.fit.report) : Json();
        if (performance.face) {
            fit["face"] = to_json(*performance.face);
            fit["face"]["file"] = performance.face_file.string();
        }
        report["motions"].push_back({{"file", performance.motion_file.string()},
                                     {"detected", performance.notes},
                                     {"modes", std::move(modes)},
                                     {"fit", std::move(fit)}});
    }
    report["recipe"] = recipe_of(job);
    return report;
}

}  // namespace

ClipResult record_clip(const ClipJob& job) {
    std::vector<Performance> people;
    for (const Performer& performer : job.performers) people.push_back(perform(performer, job));
    const Stage stage = make_stage(people, job);
    for (Performance& person : people) person.avatar.images = {};  // the renderers have their own by now

    Soundtrack track = read_soundtrack(job);
    const ClipLength length = length_of_clip(people, job, track.sound);
    const FrameRange range = checked_range(job, length.frames);
    finish(track, job, length.frames, range);
    std::vector<std::string> warnings = warn_of_frames_outside(stage, people);
    for (const auto& more : {track.warnings, length.warnings})
        warnings.insert(warnings.end(), more.begin(), more.end());

    const std::size_t frames = *range.last - range.first;
    const Cues cues = make_cues(job, stage, people, track.voices, length.frames);
    FrameSink sink(job, track.sound);
    Progress progress(job.out.filename().string(), "frames", frames, job.quiet);
    record_frames(stage, people, cues, range, sink, progress);

    ClipResult result{
        .frames = frames, .seconds = job.fps.seconds(frames), .warnings = std::move(warnings), .report = {}};
    result.report = report_of(job, result, stage, people);
    return result;
}

ClipMaker clip_maker() {
    const auto read_all = [](const ClipJob& job) {
        ClipMotions all;
        for (const Performer& performer : job.performers) {
            const PerformerMotions motions = read_motions(performer, job);
            if (motions.frames) all.length = std::max(all.length, job.fps.seconds(*motions.frames));
            bool told = false;
            for (const auto* motion : {&motions.body, &motions.face}) {
                if (!*motion) continue;
                if (!motions.frames) all.length = std::max(all.length, duration(**motion));
                told = told || (*motion)->face;
            }
            all.shown_face.push_back(told && !is_stick(performer.avatar) &&
                                     performer.modes.face_mode != FaceMode::neutral);
        }
        return all;
    };
    return {.record = record_clip, .recipe = recipe_of, .motions = read_all};
}

}  // namespace chironomia
