#include "study/batch/forecast.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "core/files/scratch_folder.h"
#include "core/text.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostSamples = 4;    // videos that are measured
constexpr std::size_t kSampleFrames = 30;  // of each, from its middle
// ours: long against reading the plan, short enough for a scheduler to fit in
constexpr double kTaskSeconds = 1800;
constexpr std::size_t kMostTasks = 1000;    // of an array, as Slurm is set up by default (MaxArraySize 1001)
constexpr double kReserve = 2;              // ours: other nodes may be half as fast
constexpr double kMemoryReserve = 0.5;      // ours: of a process
constexpr std::size_t kShortestLimit = 10;  // [min]

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// What all cores have spent on this process and its helpers [s].
double spent_seconds() {
    double seconds = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        ::getrusage(who, &usage);
        seconds += seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    }
    return seconds;
}

double peak_megabytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Frames that a video has; one at least.
std::size_t frames_of(const ClipJob& job) {
    const double whole = std::round(job.at_least.value_or(0) * job.fps.per_second());
    const std::size_t last = job.frames.last.value_or(static_cast<std::size_t>(whole));
    return std::max<std::size_t>(1, last - std::min(last, job.frames.first));
}

struct Cost {
    double seconds = 0;  // of a core
    double bytes = 0;
};

// Of `count` frames in the middle of a video.
Cost cost_of(ClipJob job, std::size_t count, const fs::path& folder, const ClipMaker& maker) {
    const std::size_t first = job.frames.first + (frames_of(job) - count) / 2;
    job.frames = {.first = first, .last = first + count};
    job.out = folder / ("sample" + job.out.extension().string());
    const double before = spent_seconds();
    maker.record(job);
    return {.seconds = spent_seconds() - before, .bytes = static_cast<double>(fs::file_size(job.out))};
}

// A video costs something for itself, and something for each frame.
struct Rates {
    Cost video;
    Cost frame;
    std::size_t measured_frames = 0;
    std::size_t measured_videos = 0;
};

Rates measure_rates(const StudyState& state, const ClipMaker& maker) {
    const ScratchFolder folder("forecast");
    const std::size_t samples = std::min(kMostSamples, state.missing.size());
    Rates rates;
    // The first video of a process also compiles shaders.
    cost_of(state.distinct[state.missing.front()].job, 1, folder.path(), maker);
    for (std::size_t i = 0; i < samples; ++i) {
        const ClipJob& job = state.distinct[state.missing[i * state.missing.size() / samples]].job;
        const std::size_t count = std::min(kSampleFrames, frames_of(job));
        const Cost one = cost_of(job, 1, folder.path(), maker);
        rates.video.seconds += one.seconds / static_cast<double>(samples);
        rates.video.bytes += one.bytes / static_cast<double>(samples);
        rates.measured_frames += 1;
        if (count == 1) continue;
        const Cost many = cost_of(job, count, folder.path(), maker);
        const auto more = static_cast<double>((count - 1) * samples);
        rates.frame.seconds += std::max(0.0, many.seconds - one.seconds) / more;
        rates.frame.bytes += std::max(0.0, many.bytes - one.bytes) / more;
        rates.measured_frames += count;
    }
    rates.measured_videos = samples;
    return rates;
}

std::string gigabytes(double bytes) {
    return bytes < 1e9 ? format("{:.0f} MB", std::ceil(bytes / 1e6)) : format("{:.1f} GB", bytes / 1e9);
}

}  // namespace

Forecast forecast_build(const Plan& plan, const BuildOptions& options, const ClipMaker& maker) {
    const double before = spent_seconds();
    const StudyState state = inspect_study(draft_study(plan, options.seed, maker), options);
    Forecast forecast{.videos = state.distinct.size(),
                      .missing = state.missing.size(),
                      .size = plan.render.size,
                      .draft_seconds = spent_seconds() - before,
                      .jobs = options.jobs};
    if (!state.missing.empty()) {
        const Rates rates = measure_rates(state, maker);
        for (const std::size_t video : state.missing) forecast.frames += frames_of(state.distinct[video].job);
        forecast.cpu_seconds = static_cast<double>(forecast.missing) * rates.video.seconds +
                               static_cast<double>(forecast.frames) * rates.frame.seconds;
        const auto bytes_of = [&](const std::vector<Video>& videos) {
            double bytes = 0;
            for (const Video& video : videos)
                bytes += rates.video.bytes + static_cast<double>(frames_of(video.job)) * rates.frame.bytes;
            return bytes;
        };
        forecast.distinct_bytes = bytes_of(state.distinct);
        forecast.bytes = bytes_of(state.draft.videos);
        forecast.measured_frames = rates.measured_frames;
        forecast.measured_videos = rates.measured_videos;
    }
    forecast.peak_mb = peak_megabytes();
    return forecast;
}

SlurmArray array_for(const Forecast& forecast) {
    const double seconds = forecast.cpu_seconds / forecast.jobs;
    const auto wanted = static_cast<std::size_t>(std::ceil(seconds / kTaskSeconds));
    SlurmArray array;
    array.tasks =
        std::clamp<std::size_t>(wanted, 1, std::clamp<std::size_t>(forecast.missing, 1, kMostTasks));
    const double task = forecast.draft_seconds + seconds / static_cast<double>(array.tasks);
    array.minutes = std::max(kShortestLimit, static_cast<std::size_t>(std::ceil(kReserve * task / 60)));
    const double megabytes = (forecast.jobs + kMemoryReserve) * forecast.peak_mb;
    array.megabytes = static_cast<std::size_t>(std::ceil(megabytes / 100)) * 100;
    return array;
}

std::string to_text(const Forecast& forecast) {
    std::string text =
        labelled_list("videos", {format("{}, {} of them to be rendered", forecast.videos, forecast.missing)});
    if (forecast.missing == 0) return text;
    const SlurmArray array = array_for(forecast);
    return text +
           labelled_list("frames", {format("{} of {}x{}", forecast.frames, forecast.size.width,
                                           forecast.size.height)}) +
           labelled_list(
               "cpu",
               {format("{:.2f} hours of one core like those here; measured on {} frames of {} videos",
                       forecast.cpu_seconds / 3600, forecast.measured_frames, forecast.measured_videos)}) +
           labelled_list("disk", {format("{} at the end; {} while it is laid out", gigabytes(forecast.bytes),
                                         gigabytes(forecast.distinct_bytes + forecast.bytes))}) +
           labelled_list("ask for",
                         {format("--slurm --array {}{} --time {}:{:02}:00 --sbatch \"--mem={}M\"",
                                 array.tasks, forecast.jobs > 1 ? format(" --jobs {}", forecast.jobs) : "",
                                 array.minutes / 60, array.minutes % 60, array.megabytes)});
}

}  // namespace chironomia::study
