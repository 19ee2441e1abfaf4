#include "study/videos.h"

#include <algorithm>
#include <optional>
#include <set>
#include <thread>

#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/progress.h"
#include "core/text.h"
#include "study/workers.h"

namespace chironomia {
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

ClipJob job_of(const Plan& plan, const Video& video) {
    const PlanClip& clip = plan.clips[video.clip];
    ClipJob job;
    job.performers.clear();
    for (const std::size_t condition : video.conditions) {
        job.performers.push_back(
            {.motion = clip.motions[condition],
             .hints = plan.hints[condition],
             .face = clip.faces.empty() ? std::nullopt : std::optional(clip.faces[condition]),
             .avatar = plan.render.avatar,
             .modes = plan.modes[condition]});
    }
    if (clip.partner) add_partner(plan, *clip.partner, clip, job);
    job.beside = video.conditions.size() > 1;
    const bool has_voices = clip.partner && !clip.partner->audio.empty();
    if (!clip.audio.empty() && !has_voices) job.audio = clip.audio;
    job.cue = plan.render.cue;
    job.scene = plan.render.scene;
    job.size = plan.render.size;
    job.fps = plan.render.fps;
    job.upper_body = plan.render.upper_body;
    job.drawing = plan.render.drawing;
    job.quiet = true;
    return job;
}

std::vector<Video> videos_without_jobs(const Plan& plan, const Design& design) {
    std::vector<Video> videos;
    if (plan.presentation == Presentation::one_video) {
        for (const Comparison& page : design.pages) {
            videos.emplace_back().clip = page.clip;
            videos.back().conditions = {page.left, page.right};
        }
        std::stable_sort(videos.begin(), videos.end(),
                         [](const Video& a, const Video& b) { return a.clip < b.clip; });
        return videos;
    }
    for (std::size_t clip = 0; clip < plan.clips.size(); ++clip) {
        for (std::size_t condition = 0; condition < plan.conditions.size(); ++condition) {
            videos.emplace_back().clip = clip;
            videos.back().conditions = {condition};
        }
    }
    return videos;
}

Json as_json(const ClipResult& result) {
    return {{"frames", result.frames},
            {"seconds", result.seconds},
            {"warnings", result.warnings},
            {"report", result.report}};
}

// A recording that is there, whole and unchanged.
std::optional<RecordedVideo> find_recording(const fs::path& folder, const Video& video) {
    const fs::path file = recording_file(folder, video);
    const fs::path note = recording_note(folder, video);
    if (!fs::exists(file) || !fs::exists(note)) return std::nullopt;
    const Json json = read_json(note);
    if (sha256_of_file(file) != json.at("sha256")) return std::nullopt;
    RecordedVideo found{.file = file, .result = {}, .sha256 = json.at("sha256")};
    found.result.frames = json.at("frames");
    found.result.seconds = json.at("seconds");
    found.result.warnings = json.at("warnings").get<std::vector<std::string>>();
    found.result.report = json.at("report");
    return found;
}

int threads_for(int jobs) {
    if (jobs == 1) return 0;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / jobs);
}

void record_one(const Video& video, const RecordingOptions& options, const ClipMaker& maker) {
    ClipJob job = video.job;
    job.out = recording_file(options.folder, video);
    job.threads = threads_for(options.jobs);
    Json note = as_json(maker.record(job));
    note["sha256"] = sha256_of_file(job.out);
    write_json(recording_note(options.folder, video), note);
}

// Which condition of a clip has a face that moves, and which has none, as far as that is known by now.
struct Faces {
    std::optional<std::size_t> with;
    std::optional<std::size_t> without;
};

// A face that moves in one condition alone would tell it from the others.
void require_faces_of_all_or_none(const Plan& plan, const Video& video, const ClipMotions& motions,
                                  Faces& faces) {
    const PlanClip& clip = plan.clips[video.clip];
    const std::size_t first = clip.partner && plan.render.partner_on_left ? 1 : 0;
    for (std::size_t i = 0; i < video.conditions.size(); ++i) {
        // Where a mode holds the face still that is a factor of the study, as the plan says.
        if (plan.modes[video.conditions[i]].face_mode == FaceMode::neutral) continue;
        (motions.shown_face[first + i] ? faces.with : faces.without) = video.conditions[i];
    }
    if (!faces.with || !faces.without) return;
    throw Error(format(
        "clip \"{}\": \"{}\" moves the face and \"{}\" does not; give every condition a \"face\", or set "
        "the \"face_mode\" to \"neutral\"",
        clip.id, plan.conditions[*faces.with], plan.conditions[*faces.without]));
}

}  // namespace

fs::path recording_file(const fs::path& folder, const Video& video) {
    return folder / (video.recipe + video.job.out.extension().string());
}

fs::path recording_note(const fs::path& folder, const Video& video) {
    return folder / (video.recipe + ".json");
}

std::vector<Video> list_videos(const Plan& plan, const Design& design, const ClipMaker& maker) {
    std::vector<Video> videos = videos_without_jobs(plan, design);
    std::vector<double> longest(plan.clips.size(), 0);  // [s]
    std::vector<Faces> faces(plan.clips.size());
    for (Video& video : videos) {
        video.job = job_of(plan, video);
        video.job.out = "video." + plan.render.format;
        const ClipMotions motions = maker.motions(video.job);
        longest[video.clip] = std::max(longest[video.clip], motions.length);
        require_faces_of_all_or_none(plan, video, motions, faces[video.clip]);
    }
    for (Video& video : videos) {
        video.job.at_least = longest[video.clip];
        video.recipe = sha256(maker.recipe(video.job).dump());
    }
    return videos;
}

Recordings record_videos(const std::vector<Video>& videos, const RecordingOptions& options,
                         const ClipMaker& maker) {
    std::vector<const Video*> missing;
    std::set<std::string> listed;
    for (const Video& video : videos) {
        if (find_recording(options.folder, video) || !listed.insert(video.recipe).second) continue;
        missing.push_back(&video);
    }
    Progress progress("study", "videos", missing.size(), options.quiet);
    perform_all({.count = missing.size(),
                 .perform = [&](std::size_t i) { record_one(*missing[i], options, maker); },
                 .name = [&](std::size_t i) { return missing[i]->job.performers.front().motion.string(); }},
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

}  // namespace chironomia
