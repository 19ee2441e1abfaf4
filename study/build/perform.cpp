#include "study/build/perform.h"

#include "core/files/wav_file.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/models/synthesis.h"
#include "synth/speakers/speakers.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

SynthesisJob job_of(const Plan& plan, const PlanClip& clip, const PlanCondition& condition) {
    SynthesisJob job{.source = clip.text,
                     .speaker = condition.speaker,
                     .manner = condition.manner,
                     .voice = speaker_named(clip.voice).voice,
                     .fps = plan.render.fps.per_second(),
                     .seed = clip.seed};
    if (!clip.audio.empty()) job.recording = clip.audio;
    if (!clip.words.empty()) job.words = clip.words;
    return job;
}

// Every condition that has a manner performs the clip. What their scripts do not show is the same for all.
std::vector<std::string> perform_clip(const Plan& plan, const fs::path& folder, std::size_t number,
                                      PlanClip& clip) {
    std::vector<std::string> notes;
    const PlanClip asked = clip;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        if (plan.conditions[i].making != Making::manner) continue;
        const Synthesized made = synthesize(job_of(plan, asked, plan.conditions[i]));
        clip.motions[i] = folder / format("{}-{}.h5", number, i);
        write_motion_hdf5(clip.motions[i], made.performed.motion);
        notes = made.notes;
        if (!asked.audio.empty()) continue;
        clip.audio = folder / format("{}.wav", number);
        write_wav(clip.audio, made.speech.audio);
    }
    return notes;
}

}  // namespace

PerformedClips perform_clips(const Plan& plan) {
    PerformedClips performed{.plan = plan, .notes = {}, .folder = {}};
    if (!has_manners(plan)) return performed;
    performed.folder.emplace("performed");
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        PlanClip& clip = performed.plan.clips[i];
        for (const std::string& note : perform_clip(plan, performed.folder->path(), i, clip))
            performed.notes.push_back({.clip = i, .text = format("clip \"{}\": {}", clip.id, note)});
    }
    return performed;
}

}  // namespace chironomia
