#include "study/pipeline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <future>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_length.h"
#include "skinning/skin.h"
#include "study/frame_sink.h"
#include "study/performance.h"

namespace chironomia {
namespace {

// Two people share the width of the clip.
RenderSize size_of_one(const ClipJob& job) {
    const int people = static_cast<int>(job.performers.size());
    if (job.size.width % (2 * people) != 0) {
        throw Error(
            format("{}: {} pixels do not divide among {} people; choose a width that is a multiple of {}",
                   job.out.string(), job.size.width, people, 2 * people));
    }
    return {.width = job.size.width / people, .height = job.size.height};
}

// What a figure does while the shutter is open: its mesh at even distances in time.
using Exposure = std::vector<PosedMesh>;

// Four straight pieces are a smooth bow even for a hand at full speed.
constexpr int kMomentsOfBlur = 5;

Exposure expose(const Performance& performance, std::size_t frame, double motion_blur) {
    if (motion_blur == 0) return {skin(performance.avatar, performance.pose_at(frame))};
    Exposure exposure;
    for (int i = 0; i < kMomentsOfBlur; ++i) {
        const double moment = motion_blur * (static_cast<double>(i) / (kMomentsOfBlur - 1) - 0.5);
        const Pose pose = performance.pose_at(static_cast<double>(frame) + moment);
        exposure.push_back(skin(performance.avatar, pose));
    }
    return exposure;
}

std::vector<Exposure> expose_all(const std::vector<Performance>& people, std::size_t frame,
                                 double motion_blur) {
    std::vector<Exposure> exposures;
    for (const Performance& performance : people)
        exposures.push_back(expose(performance, frame, motion_blur));
    return exposures;
}

Frame beside(const Frame& left, const Frame& right) {
    assert(left.height == right.height);
    Frame both{.width = left.width + right.width, .height = left.height, .rgba = {}};
    both.rgba.reserve(left.rgba.size() + right.rgba.size());
    for (int y = 0; y < left.height; ++y) {
        for (const Frame* half : {&left, &right}) {
            const auto row = half->rgba.begin() + static_cast<std::ptrdiff_t>(y) * half->width * 4;
            both.rgba.insert(both.rgba.end(), row, row + half->width * 4);
        }
    }
    return both;
}

Frame draw_all(const std::vector<Performance>& people, const std::vector<Exposure>& exposures) {
    Frame frame = people[0].renderer->render(exposures[0]);
    for (std::size_t i = 1; i < people.size(); ++i)
        frame = beside(frame, people[i].renderer->render(exposures[i]));
    return frame;
}

// The longest motion decides, unless the job or the sound asks for more.
ClipLength length_of_clip(const std::vector<Performance>& people, const ClipJob& job,
                          const std::optional<Audio>& sound) {
    std::size_t frames = 0;
    for (const Performance& performance : people) frames = std::max(frames, performance.fit.poses.size());
    if (job.at_least) {
        frames = std::max(frames,
                          static_cast<std::size_t>(std::ceil(*job.at_least * job.fps.per_second() - 1e-6)));
    }
    ClipLength length = agree_length(frames, job.fps, sound ? &*sound : nullptr);
    for (const Performance& performance : people) {
        length.warnings.insert(length.warnings.end(), performance.warnings.begin(),
                               performance.warnings.end());
        if (performance.frames_outside > 0) {
            length.warnings.push_back(format(
                "{}: the head is outside the picture in {} of {} frames; hold the figure in place with "
                "--body upper, or choose a wider scene",
                performance.motion_file.string(), performance.frames_outside, performance.fit.poses.size()));
        }
        if (performance.fit.poses.size() == frames) continue;
        length.warnings.push_back(format("{}: the motion lasts {} frames of {}; its last pose is held",
                                         performance.motion_file.string(), performance.fit.poses.size(),
                                         length.frames));
    }
    return length;
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

// The sound that belongs to a range of frames, as long as they are.
Audio sound_of(const Audio& sound, const FrameRange& range, const Rate& fps) {
    const Audio whole = fit_to(sound, fps.seconds(*range.last));
    const auto sample_at = [&](std::size_t frame) {
        return static_cast<std::ptrdiff_t>(std::llround(fps.seconds(frame) * sound.rate)) * sound.channels;
    };
    Audio part{.rate = sound.rate, .channels = sound.channels, .samples = {}};
    part.samples.assign(whole.samples.begin() + sample_at(range.first),
                        whole.samples.begin() + sample_at(*range.last));
    return part;
}

// Mesh, pixels and file side by side: while a frame is drawn, the next is skinned and the one before is
// written.
void record_frames(const std::vector<Performance>& people, double motion_blur, const FrameRange& range,
                   FrameSink& sink, Progress& progress) {
    const auto skin_later = [&people, motion_blur](std::size_t frame) {
        return std::async(std::launch::async,
                          [&people, motion_blur, frame] { return expose_all(people, frame, motion_blur); });
    };
    std::future<std::vector<Exposure>> skinned = skin_later(range.first);
    for (std::size_t frame = range.first; frame < *range.last; ++frame) {
        const std::vector<Exposure> exposures = skinned.get();
        if (frame + 1 < *range.last) skinned = skin_later(frame + 1);
        sink.write(draw_all(people, exposures));
        progress.step();
    }
    sink.finish();
}

Json report_of(const ClipJob& job, const ClipResult& result, const std::vector<Performance>& people) {
    Json report;
    report["frames"] = result.frames;
    report["seconds"] = result.seconds;
    report["warnings"] = result.warnings;
    for (const Performance& performance : people) {
        Json fit = to_json(performance.fit.report);
        if (performance.face) {
            fit["face"] = to_json(*performance.face);
            fit["face"]["file"] = performance.face_file.string();
        }
        report["motions"].push_back({{"file", performance.motion_file.string()},
                                     {"detected", performance.notes},
                                     {"fit", std::move(fit)}});
    }
    report["recipe"] = recipe_of(job);
    return report;
}

}  // namespace

ClipResult record_clip(const ClipJob& job) {
    std::vector<Performance> people;
    for (const Performer& performer : job.performers)
        people.push_back(perform(performer, job, size_of_one(job)));

    std::optional<Audio> sound;
    if (job.audio) sound = read_audio(*job.audio);
    const ClipLength length = length_of_clip(people, job, sound);
    const FrameRange range = checked_range(job, length.frames);
    if (sound) sound = sound_of(*sound, range, job.fps);

    const std::size_t frames = *range.last - range.first;
    FrameSink sink(job, sound);
    Progress progress(job.out.filename().string(), "frames", frames, job.quiet);
    record_frames(people, job.drawing.motion_blur, range, sink, progress);

    ClipResult result{
        .frames = frames, .seconds = job.fps.seconds(frames), .warnings = length.warnings, .report = {}};
    result.report = report_of(job, result, people);
    return result;
}

ClipMaker clip_maker() {
    const auto motion_length = [](const ClipJob& job) {
        double longest = 0;
        for (const Performer& performer : job.performers) {
            const PerformerMotions motions = read_motions(performer);
            for (const auto* motion : {&motions.body, &motions.face}) {
                if (*motion) longest = std::max(longest, duration(**motion));
            }
        }
        return longest;
    };
    return {.record = record_clip, .recipe = recipe_of, .motion_length = motion_length};
}

}  // namespace chironomia
