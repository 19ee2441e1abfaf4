#include "study/build/perform.h"

#include <algorithm>

#include "core/error.h"
#include "core/files/wav_file.h"
#include "core/text.h"
#include "skinning/motion/motion_hdf5.h"
#include "study/models/learned_engine.h"
#include "study/models/style_engine.h"
#include "study/models/synthesis.h"
#include "synth/speakers/speakers.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

LearnedEngine engine_of(const PlanClip& clip, const PlanStyle& style) {
    LearnedEngine engine{.model = style.engine};
    if (!style.checkpoint.empty()) engine.checkpoint = style.checkpoint;
    if (style.content) engine.content_of = clip.motions[*style.content];
    if (!style.of) {
        engine.style_of = style.speaker;
    } else if (style.engine == "mix-stage") {
        engine.style_of = speaker_of_interval(clip.motions[*style.of]);
    } else {
        engine.style_of = clip.motions[*style.of].string();
    }
    return engine;
}

// Speakers that Mix-StAGE was asked for, each with the place in the plan that asks.
struct AskedSpeaker {
    std::string place, speaker;
};

std::vector<AskedSpeaker> asked_speakers(const Plan& plan, std::size_t condition) {
    const PlanStyle& style = plan.conditions[condition].style;
    if (!style.of) return {{format("conditions[{}].style_of", condition), style.speaker}};
    std::vector<AskedSpeaker> asked;
    for (std::size_t i = 0; i < plan.clips.size(); ++i)
        asked.push_back({format("clips[{}].motion.{}", i, plan.conditions[*style.of].name),
                         speaker_of_interval(plan.clips[i].motions[*style.of])});
    return asked;
}

// Mix-StAGE knows styles by the names of the speakers that it has learned from; what is asked of others is refused
// before anything is made.
void check_speakers(const Plan& plan) {
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        const PlanStyle& style = plan.conditions[i].style;
        if (plan.conditions[i].making != Making::style || style.engine != "mix-stage") continue;
        const std::vector<std::string> known = learned_speakers(style.checkpoint);
        for (const AskedSpeaker& asked : asked_speakers(plan, i)) {
            if (std::ranges::find(known, asked.speaker) != known.end()) continue;
            throw Error(format(
                "{}: {}: is {}\"{}\", but \"{}\" is performed by mix-stage, and {} has learned the "
                "styles of {} alone; choose one of them, or let zs-mstm perform it, which shows any style",
                plan.file.string(), asked.place, style.of ? "in the folder of " : "", asked.speaker,
                plan.conditions[i].name, path_in_plan(plan, style.checkpoint), join(known)));
        }
    }
}

SynthesisJob job_of(const Plan& plan, const PlanClip& clip, const PlanCondition& condition) {
    SynthesisJob job{.source = clip.text,
                     .manner = condition.manner,
                     .voice = speaker_named(clip.voice).voice,
                     .fps = plan.render.fps.per_second(),
                     .seed = clip.seed};
    // How far to the side the other stands in that scene [degrees] (docs/dialogs.md).
    constexpr double kPartnerInDyad = 35;
    if (clip.partner && plan.render.scene == "dyad")
        job.partner_deg = plan.render.partner_on_left ? -kPartnerInDyad : kPartnerInDyad;
    if (condition.making == Making::manner) job.speaker = condition.speaker;
    if (condition.making == Making::style) job.learned = engine_of(clip, condition.style);
    if (!clip.audio.empty()) job.recording = clip.audio;
    if (!clip.words.empty()) job.words = clip.words;
    return job;
}

// Every condition that is performed performs the clip. What their scripts do not show is the same for all.
std::vector<std::string> perform_clip(const Plan& plan, const fs::path& folder, std::size_t number,
                                      PlanClip& clip) {
    std::vector<std::string> notes;
    const PlanClip asked = clip;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        if (!is_performed(plan.conditions[i])) continue;
        const Synthesized made = synthesize(job_of(plan, asked, plan.conditions[i]));
        clip.motions[i] = folder / format("{}-{}.h5", number, i);
        write_motion_hdf5(clip.motions[i], made.performed.motion);
        if (plan.conditions[i].style.content) continue;
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
    if (std::ranges::none_of(plan.conditions, is_performed)) return performed;
    check_speakers(plan);
    performed.folder.emplace("performed");
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        PlanClip& clip = performed.plan.clips[i];
        for (const std::string& note : perform_clip(plan, performed.folder->path(), i, clip))
            performed.notes.push_back({.clip = i, .text = format("clip \"{}\": {}", clip.id, note)});
    }
    return performed;
}

}  // namespace chironomia::study
