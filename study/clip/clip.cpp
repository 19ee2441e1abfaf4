#include "study/clip/clip.h"

#include <algorithm>
#include <cassert>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "core/version.h"
#include "raster/images/text_line.h"
#include "scenes/scene_file.h"
#include "skinning/gltf/gltf.h"
#include "skinning/signal/late_beginning.h"
#include "study/clip/recipe_memory.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

template <typename Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

Json of_cut(const std::optional<Cut>& cut) {
    return cut ? Json{cut->begin, or_null(cut->end)} : Json();
}

Json of_notice(const std::optional<Notice>& notice, RecipeMemory& memory) {
    if (!notice) return Json();
    return {notice->text, notice->from, or_null(notice->to), memory.hash(find_asset(kFontFile))};
}

Json of_spoken(const std::optional<SpokenNotice>& spoken) {
    return spoken ? Json{spoken->text, spoken->language, spoken->at} : Json();
}

Json hints_of(const MotionHints& hints, RecipeMemory& memory) {
    Json json;
    json["fps"] = or_null(hints.fps);
    if (hints.fps_where_missing) json["fps_where_missing"] = true;
    json["up"] = static_cast<int>(hints.up);
    json["unit"] = or_null(hints.unit);
    json["turn_deg"] = or_null(hints.turn_deg);
    const PictureHints& picture = hints.picture;
    json["picture_size"] = picture.size ? Json{picture.size->x, picture.size->y} : Json();
    json["field_of_view"] = or_null(picture.field_of_view);
    json["lift_cutoff"] = or_null(hints.lift_cutoff);
    json["smoothing"] = or_null(hints.smoothing);
    if (!hints.animation.empty()) json["animation"] = hints.animation;
    json["names"] = hints.name_map.empty() ? Json() : Json(memory.hash(hints.name_map));
    return json;
}

Json face_options_of(const FaceOptions& options) {
    return {{"units", options.units},
            {"gaze", options.gaze},
            {"head", static_cast<int>(options.head)},
            {"gains", to_text(options.gains)}};
}

Json recipe_of(const Performer& performer, const CompanionFiles& companions, RecipeMemory& memory) {
    if (!performer.film.empty())
        return {{"film", memory.hash(performer.film)}, {"cut", of_cut(performer.cut)}};
    if (plays_own_animation(performer)) {
        return {{"animation", performer.hints.animation}, {"avatar", memory.avatar(performer.avatar)}};
    }
    const fs::path& motion = performer.motion;
    return {{"motion", motion.empty() ? Json() : memory.hashes(motion, companions.of_motion)},
            {"hints", hints_of(performer.hints, memory)},
            {"face", performer.face ? memory.hashes(*performer.face, companions.of_face) : Json()},
            {"face_options", face_options_of(performer.face_options)},
            {"avatar", memory.avatar(performer.avatar)},
            {"modes", to_json(performer.modes)},
            {"voice", performer.voice ? Json(memory.hash(*performer.voice)) : Json()},
            {"cut", of_cut(performer.cut)},
            {"voice_cut", of_cut(performer.voice_cut)},
            {"anchor", performer.anchor ? Json(to_text(*performer.anchor)) : Json()}};
}

Json options_of(const ClipJob& job, RecipeMemory& memory) {
    Json options;
    options["size"] = {job.size.width, job.size.height};
    options["fps"] = to_text(job.fps);
    options["body"] = job.upper_body ? "upper" : "full";
    options["no_interpenetration"] = job.no_interpenetration;
    options["renderer"] = to_text(job.drawing.renderer);
    if (job.drawing.renderer == RendererKind::rays) {
        options["samples"] = job.drawing.samples;
        options["motion_blur"] = job.drawing.motion_blur;
    }
    if (job.travel != Travel::free) options["travel"] = to_text(job.travel);
    options["beside"] = job.beside;
    options["cue"] = job.cue == SpeakingCue::light ? "light" : "none";
    options["first_frame"] = job.frames.first;
    options["last_frame"] = or_null(job.frames.last);
    options["at_least_s"] = or_null(job.at_least);
    options["cut"] = of_cut(job.cut);
    options["sound_cut"] = of_cut(job.sound_cut);
    options["silent"] = job.silent;
    if (job.stereo) options["stereo"] = true;
    options["loudness"] = or_null(job.loudness);
    options["notice"] = of_notice(job.notice, memory);
    options["spoken"] = of_spoken(job.spoken);
    options["format"] = job.out.extension().string();
    return options;
}

const CompanionFiles& companions_of(const Performer& performer, RecipeMemory& memory) {
    return memory.companions(performer, hints_of(performer.hints, memory));
}

Json recipe_of(const ClipJob& job, std::span<const CompanionFiles> companions, RecipeMemory& memory) {
    assert(companions.size() == job.performers.size());
    Json recipe;
    recipe["program"] = {{"version", program_version()}, {"sha256", memory.hash("/proc/self/exe")}};
    for (std::size_t i = 0; i < companions.size(); ++i)
        recipe["performers"].push_back(recipe_of(job.performers[i], companions[i], memory));
    for (const Performer& performer : job.performers) {
        for (const Performer& followed : performer.followed)
            recipe["followed"].push_back(recipe_of(followed, companions_of(followed, memory), memory));
    }
    recipe["audio"] = job.audio ? Json(memory.hash(*job.audio)) : Json();
    recipe["scene"] = memory.hash(scene_file(job.scene.string()));
    recipe["options"] = options_of(job, memory);
    return recipe;
}

void cut_to(const Cut& part, PerformerMotions& motions, const Performer& performer, const Rate& fps) {
    double longest = 0;
    for (const auto* motion : {&motions.body, &motions.face})
        if (*motion) longest = std::max(longest, duration(**motion));
    const fs::path& file = performer.motion.empty() ? *performer.face : performer.motion;
    const CutFrames shown = cut_frames(part, longest, fps, file);
    for (auto* motion : {&motions.body, &motions.face})
        if (*motion) *motion = cut_motion(**motion, shown, fps);
    motions.frames = shown.count;
}

// The file may be a part of a longer recording, whose sound begins where the file does, or with the recording.
std::vector<std::string> warn_of_late_beginnings(const PerformerMotions& motions) {
    std::vector<std::string> warnings;
    for (const auto* motion : {&motions.body, &motions.face}) {
        const auto first = *motion ? late_beginning_of(**motion) : std::nullopt;
        if (!first) continue;
        warnings.push_back(
            format("{}: its times begin at {:.6g} s, which is second 0 of the clip; a sound of the "
                   "whole recording is cut to it by --audio-cut {:.6g}:",
                   (*motion)->source, *first, *first));
    }
    return warnings;
}

}  // namespace

CompanionFiles PerformerMotions::companions() const {
    CompanionFiles files;
    if (body) files.of_motion = body->companions;
    if (face) files.of_face = face->companions;
    return files;
}

PerformerMotions read_motions(const Performer& performer) {
    PerformerMotions motions;
    if (!performer.motion.empty()) motions.body = read_motion(performer.motion, performer.hints);
    if (performer.face)
        motions.face = read_motion(*performer.face, {.fps = performer.hints.fps, .fps_where_missing = true});
    if (motions.face && !motions.face->face) {
        throw Error(format("{}: this motion holds no face; give a file of action units, head turns or gaze",
                           performer.face->string()));
    }
    return motions;
}

PerformerMotions read_motions(const Performer& performer, const ClipJob& job) {
    PerformerMotions motions = read_motions(performer);
    if (!job.sound_cut && !performer.voice_cut) motions.warnings = warn_of_late_beginnings(motions);
    const MotionHints& hints = performer.hints;
    if (motions.body && hints.fps && hints.fps_where_missing && motions.body->fps != *hints.fps)
        motions.warnings.push_back(format(
            "{}: it has {:g} frames/s of its own; {:g}, which is set once for all, is for motions that have none",
            performer.motion.string(), motions.body->fps, *hints.fps));
    if (const auto& part = cut_of(performer, job)) cut_to(*part, motions, performer, job.fps);
    if (!performer.anchor) return motions;
    for (auto* motion : {&motions.body, &motions.face})
        if (*motion) *motion = degrade(**motion, *performer.anchor, performer.hints.lift_cutoff);
    return motions;
}

Json recipe_of(const ClipJob& job) {
    RecipeMemory memory;
    return recipe_of(job, memory);
}

Json recipe_of(const ClipJob& job, RecipeMemory& memory) {
    std::vector<CompanionFiles> companions;
    for (const Performer& performer : job.performers) {
        const bool moved = performer.film.empty() && !plays_own_animation(performer);
        companions.push_back(moved ? companions_of(performer, memory) : CompanionFiles());
    }
    return recipe_of(job, companions, memory);
}

Json recipe_of(const ClipJob& job, std::span<const CompanionFiles> companions) {
    RecipeMemory memory;
    return recipe_of(job, companions, memory);
}

}  // namespace chironomia::study
