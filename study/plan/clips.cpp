#include <algorithm>
#include <map>

#include "core/text.h"
#include "scenes/scene_file.h"
#include "study/plan/parts.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr long long kMostBlocks = 1000;

// The conditions that need files.
std::vector<std::string> given_names(const Plan& plan) {
    std::vector<std::string> names;
    for (const PlanCondition& condition : plan.conditions) {
        if (condition.making == Making::given) names.push_back(condition.name);
    }
    return names;
}

// One face for each condition or none at all: participants would recognise a condition that alone lacks a face.
std::vector<fs::path> read_faces(const JsonValue& value, const std::string& clip, const fs::path& folder,
                                 const Plan& plan) {
    value.allow_only(given_names(plan));
    std::vector<fs::path> faces;
    for (const PlanCondition& condition : plan.conditions) {
        if (condition.making != Making::given) {
            faces.emplace_back();
            continue;
        }
        const auto face = value.find(condition.name);
        if (!face) {
            value.refuse(
                format("has no face of the condition \"{}\" in the clip \"{}\"; give every "
                       "condition a face or none",
                       condition.name, clip));
        }
        faces.push_back(read_path(*face, folder));
    }
    return faces;
}

PlanPartner read_partner(const JsonValue& value, const fs::path& folder, const PlanClip& clip) {
    value.allow_only(keys_of("clips[].partner"));
    PlanPartner partner{.motion = read_path(value.at("motion"), folder)};
    if (const auto hints = value.find("hints")) {
        partner.hints = read_hints_of_condition(*hints, folder);
        partner.hints_as_written = hints->json();
    }
    if (const auto face = value.find("face")) partner.face = read_path(*face, folder);
    if (const auto audio = value.find("audio")) {
        partner.audio = read_path(*audio, folder);
        if (clip.audio.empty()) {
            audio->refuse(
                format("is the voice of the partner, and clip \"{}\" has no \"audio\" of the "
                       "agent; give both or neither",
                       clip.id));
        }
    }
    if (const auto avatar = value.find("avatar")) {
        partner.avatar = read_path_or_name(*avatar, folder, avatar_names());
    }
    return partner;
}

// [begin, end] in seconds.
Cut read_cut(const JsonValue& value) {
    constexpr double kLatest = 36000;  // [s]
    const std::vector<JsonValue> ends = value.items(2);
    if (ends.size() != 2)
        value.refuse(format("is {}, a begin and an end in seconds are needed", value.shown()));
    const Cut cut{.begin = ends[0].number(0, kLatest), .end = ends[1].number(0, kLatest)};
    if (cut.begin >= *cut.end)
        value.refuse(format("is {}, the end must be later than the begin", value.shown()));
    return cut;
}

// The texts and notes of a clip that is otherwise read.
void read_notes(const JsonValue& value, PlanClip& clip) {
    if (const auto speaker = value.find("speaker")) clip.speaker = speaker->text();
    if (const auto transcript = value.find("transcript")) clip.transcript = transcript->text();
    if (const auto caption = value.find("caption")) clip.caption = caption->text();
    if (const auto cut = value.find("cut")) clip.cut = read_cut(*cut);
    if (const auto practice = value.find("practice")) clip.practice = practice->flag();
    if (const auto block = value.find("block"))
        clip.block = static_cast<std::size_t>(block->integer(0, kMostBlocks - 1));
}

PlanClip read_clip(const JsonValue& value, const fs::path& folder, const Plan& plan) {
    value.allow_only(keys_of("clips[]"));
    PlanClip clip;
    clip.id = value.at("id").text();
    if (const auto audio = value.find("audio")) clip.audio = read_path(*audio, folder);
    const JsonValue motion = value.at("motion");
    motion.allow_only(given_names(plan));
    for (const PlanCondition& condition : plan.conditions) {
        const bool given = condition.making == Making::given;
        clip.motions.push_back(given ? read_path(motion.at(condition.name), folder) : fs::path());
    }
    if (const auto face = value.find("face")) clip.faces = read_faces(*face, clip.id, folder, plan);
    if (const auto partner = value.find("partner")) clip.partner = read_partner(*partner, folder, clip);
    read_notes(value, clip);
    return clip;
}

// What all clips have, or none.
void require_alike(const JsonValue& item, const PlanClip& clip, const PlanClip& first) {
    if (clip.audio.empty() != first.audio.empty()) {
        item.refuse(format("has {} \"audio\" while clips[0] has {}; give all clips their sound or none",
                           clip.audio.empty() ? "no" : "an", clip.audio.empty() ? "one" : "none"));
    }
    if (clip.partner.has_value() != first.partner.has_value()) {
        item.refuse(format("has {} \"partner\" while clips[0] has {}; give all clips a partner or none",
                           clip.partner ? "a" : "no", clip.partner ? "none" : "one"));
    }
    if (clip.block.has_value() != first.block.has_value()) {
        item.refuse(format("has {} \"block\" while clips[0] has {}; give all clips their block or none",
                           clip.block ? "a" : "no", clip.block ? "none" : "one"));
    }
}

// The scene must show as many people as are in a clip.
void require_scene_for_all(const JsonValue& whole, const Plan& plan) {
    const auto render = whole.find("render");
    const bool with_partner = plan.clips.front().partner.has_value();
    const std::size_t shown = people_in_scene(plan.render.scene.string());
    if (with_partner && plan.presentation == Presentation::one_video) {
        whole.at("presentation")
            .refuse(
                "is \"one video\", where both conditions share a picture, but the clips have a partner; "
                "show \"two videos\"");
    }
    if (with_partner && shown != 2) {
        whole.at("clips").refuse(
            format("have a partner, but the scene \"{}\" shows 1 person; let "
                   "render.scene be dyad or split",
                   plan.render.scene.string()));
    }
    if (!with_partner && shown != 1) {
        render->at("scene").refuse(
            format("\"{}\" shows 2 people, but the clips have no partner; give each "
                   "clip a \"partner\", or choose upper, full or head",
                   plan.render.scene.string()));
    }
    const auto has_voices = [](const PlanClip& clip) { return clip.partner && !clip.partner->audio.empty(); };
    if (plan.render.cue != SpeakingCue::none &&
        !std::all_of(plan.clips.begin(), plan.clips.end(), has_voices)) {
        render->at("cue").refuse("needs two voices in each clip; give every partner an \"audio\"");
    }
}

// Mismatched speech needs clips with speech.
void require_sound_for_mismatch(const JsonValue& whole, const Plan& plan) {
    if (!has_mismatch(plan)) return;
    if (!has_sound(plan)) {
        whole.at("clips").refuse(
            "have no sound that participants hear, but a condition is mismatched; give every clip an "
            "\"audio\"");
    }
    if (!plan.clips.front().partner) return;
    const auto has_other_speech = [](const PlanCondition& each) {
        return each.making == Making::mismatched_speech;
    };
    if (std::any_of(plan.conditions.begin(), plan.conditions.end(), has_other_speech)) {
        whole.at("clips").refuse(
            "have partners, and a condition has the speech of another clip, which would not be theirs; "
            "make it by \"mismatched motion\"");
    }
    // A cut is of all who are in the clip, and the other clip's motion has a cut of its own.
    const auto is_cut = [](const PlanClip& clip) { return clip.cut.has_value(); };
    if (std::any_of(plan.clips.begin(), plan.clips.end(), is_cut))
        whole.at("clips").refuse(
            "have partners and cuts, and a condition is mismatched; cut the files themselves");
}

}  // namespace

void read_clips(const JsonValue& whole, const fs::path& folder, Plan& plan) {
    const JsonValue list = whole.at("clips");
    std::map<std::string, std::size_t> taken;
    for (const JsonValue& item : list.items(1)) {
        PlanClip clip = read_clip(item, folder, plan);
        const auto [first, is_new] = taken.emplace(to_lower(clip.id), plan.clips.size());
        if (!is_new) {
            item.at("id").refuse(format("\"{}\" is already the id of clips[{}]; give each clip its own",
                                        clip.id, first->second));
        }
        if (!plan.clips.empty()) require_alike(item, clip, plan.clips.front());
        plan.clips.push_back(std::move(clip));
    }
    const auto is_practice = [](const PlanClip& clip) { return clip.practice; };
    if (std::all_of(plan.clips.begin(), plan.clips.end(), is_practice))
        list.refuse("are all for practice; leave \"practice\" out of those that are judged");
    require_scene_for_all(whole, plan);
    require_sound_for_mismatch(whole, plan);
}

}  // namespace chironomia
