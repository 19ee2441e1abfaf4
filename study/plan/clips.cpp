#include <algorithm>
#include <map>

#include "core/files/files.h"
#include "core/text.h"
#include "scenes/scene_file.h"
#include "skinning/motion/picture/openpose.h"
#include "study/design/mismatch.h"
#include "study/plan/parts.h"
#include "synth/speakers/speakers.h"

namespace chironomia::study {
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

// A file, or the folder that OpenPose writes for a clip.
fs::path read_motion_path(const JsonValue& value, const fs::path& folder) {
    const fs::path found = find_path(folder, value.text());
    return is_openpose_folder(found) ? found : read_path(value, folder);
}

PlanPartner read_partner(const JsonValue& value, const fs::path& folder, const PlanClip& clip) {
    value.allow_only(keys_of("clips[].partner"));
    PlanPartner partner{.motion = read_motion_path(value.at("motion"), folder)};
    if (const auto hints = value.find("hints")) {
        partner.hints = read_hints_of_condition(*hints, folder);
        partner.hints_as_written = hints->json();
    }
    if (const auto face = value.find("face")) partner.face = read_path(*face, folder);
    if (const auto audio = value.find("audio")) {
        partner.audio = read_path(*audio, folder);
        if (!clip.has_speech()) {
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
    const std::vector<JsonValue> ends = value.items(2);
    if (ends.size() != 2)
        value.refuse(format("is {}, a begin and an end in seconds are needed", value.shown()));
    const Cut cut{.begin = ends[0].number(0, kLatestCut), .end = ends[1].number(0, kLatestCut)};
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

// What only conditions that perform speech have a use for would be passed over.
void refuse_without_performers(const JsonValue& value, const Plan& plan) {
    if (performs_speech(plan)) return;
    for (const char* key : {"text", "script", "words", "voice", "seed"}) {
        if (const auto found = value.find(key)) {
            found->refuse(
                "is of use for conditions that perform it alone, with a \"manner\" or a \"style_of\", and "
                "the plan has none");
        }
    }
}

// Models of style that know words need them in time.
void refuse_speech_without_words(const JsonValue& value, const Plan& plan) {
    for (const PlanCondition& condition : plan.conditions) {
        if (condition.making != Making::style || condition.style.content ||
            condition.style.engine != "zs-mstm")
            continue;
        value.at("audio").refuse(
            format("is performed by \"{}\", which needs to know when its words are said; add \"words\"",
                   condition.name));
    }
}

// What cannot stand beside each other in a clip whose speech is performed.
void refuse_contradictions(const JsonValue& value, const Plan& plan) {
    const auto text = value.find("text"), script = value.find("script"), audio = value.find("audio"),
               words = value.find("words"), voice = value.find("voice");
    if (text && script) text->refuse("stands beside \"script\"; give what is said once");
    if (words && !audio) words->refuse("has no \"audio\", whose words they are; add it");
    const auto& said = text ? text : script;
    if (audio && said && !words)
        said->refuse(
            "stands beside an \"audio\", and nobody knows when its words are said; add \"words\", or leave "
            "the \"audio\" out for a synthetic voice");
    if (audio && voice)
        voice->refuse("is that of a synthetic voice, but the clip has an \"audio\"; leave one of them out");
    if (!audio && !said)
        value.refuse(
            "says nothing that a condition could perform; give it a \"text\", a \"script\" or an \"audio\"");
    if (audio && !words) refuse_speech_without_words(value, plan);
}

// Parsed here, so that a script with a mistake is refused before anything is made of it.
MarkupSource read_source(const JsonValue& value, const PlanClip& clip) {
    MarkupSource source{.language = speaker_named(clip.voice).voice.language};
    if (clip.script.empty()) {
        source.text = value.at("text").text();
        source.name = format("clip \"{}\", text", clip.id);
    } else {
        source.text = read_text(clip.script);
        source.name = clip.script.string();
    }
    parse_marked_text(source);
    return source;
}

// What is said for the conditions that perform it.
void read_speech(const JsonValue& value, const fs::path& folder, const Plan& plan, PlanClip& clip) {
    constexpr long long kHighestSeed = 1'000'000'000;
    refuse_without_performers(value, plan);
    if (!performs_speech(plan)) return;
    refuse_contradictions(value, plan);
    if (const auto words = value.find("words")) clip.words = read_path(*words, folder);
    if (const auto script = value.find("script")) clip.script = read_path(*script, folder);
    if (const auto voice = value.find("voice")) clip.voice = read_speaker_name(*voice, plan);
    if (const auto seed = value.find("seed"))
        clip.seed = static_cast<std::uint64_t>(seed->integer(0, kHighestSeed));
    if (value.find("text") || value.find("script")) clip.text = read_source(value, clip);
}

void read_motions(const JsonValue& value, const fs::path& folder, const Plan& plan, PlanClip& clip) {
    const std::vector<std::string> given = given_names(plan);
    const auto found = value.find("motion");
    if (found && given.empty()) found->refuse("names motions, but all conditions are made; leave it out");
    if (!given.empty()) value.at("motion").allow_only(given);
    for (const PlanCondition& condition : plan.conditions) {
        const bool is_given = condition.making == Making::given;
        clip.motions.push_back(is_given ? read_motion_path(value.at("motion").at(condition.name), folder)
                                        : fs::path());
    }
}

// Models of style read intervals of PATS alone.
void require_intervals(const JsonValue& value, const Plan& plan, const PlanClip& clip) {
    for (const PlanCondition& condition : plan.conditions) {
        for (const auto& read : {condition.style.content, condition.style.of}) {
            if (!read || clip.motions[*read].extension() == ".h5") continue;
            const JsonValue motion = value.at("motion").at(plan.conditions[*read].name);
            motion.refuse(format("is {}, but \"{}\" is performed from an interval of PATS (.h5)",
                                 motion.shown(), condition.name));
        }
    }
}

PlanClip read_clip(const JsonValue& value, const fs::path& folder, const Plan& plan) {
    value.allow_only(keys_of("clips[]"));
    PlanClip clip;
    clip.id = value.at("id").text();
    if (const auto audio = value.find("audio")) clip.audio = read_path(*audio, folder);
    read_speech(value, folder, plan, clip);
    read_motions(value, folder, plan, clip);
    require_intervals(value, plan, clip);
    if (const auto face = value.find("face")) clip.faces = read_faces(*face, clip.id, folder, plan);
    if (const auto partner = value.find("partner")) clip.partner = read_partner(*partner, folder, clip);
    read_notes(value, clip);
    return clip;
}

// What all clips have, or none.
void require_alike(const JsonValue& item, const PlanClip& clip, const PlanClip& first) {
    if (clip.has_speech() != first.has_speech()) {
        item.refuse(format("has {} \"audio\" while clips[0] has {}; give all clips their sound or none",
                           clip.has_speech() ? "an" : "no", clip.has_speech() ? "none" : "one"));
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
}

// How long the clips are, where cuts say so; empty where one has none.
std::vector<SpokenClip> clips_by_cut(const Plan& plan) {
    std::vector<SpokenClip> clips;
    for (const PlanClip& clip : plan.clips) {
        if (!clip.cut) return {};
        const CutFrames shown = cut_frames(*clip.cut, kLatestCut, plan.render.fps, plan.file);
        clips.push_back(
            {.id = clip.id, .speaker = clip.speaker, .seconds = plan.render.fps.seconds(shown.count)});
    }
    return clips;
}

// As far as the plan itself says whether each clip has another one; motions and sounds are read as it is built.
void require_others_for_mismatch(const JsonValue& list, const Plan& plan) {
    if (!has_mismatch(plan)) return;
    std::map<std::string, std::vector<std::size_t>> clips_of;
    for (std::size_t i = 0; i < plan.clips.size(); ++i) clips_of[plan.clips[i].speaker].push_back(i);
    for (const auto& [speaker, clips] : clips_of) {
        if (clips.size() > 1) continue;
        list.items(1)[clips.front()].refuse(format(
            "(\"{}\") is the only one {}, and a mismatched condition shows it with another one; add clips",
            plan.clips[clips.front()].id,
            speaker.empty() ? "without a \"speaker\"" : format("of speaker \"{}\"", speaker)));
    }
    const std::vector<SpokenClip> clips = clips_by_cut(plan);
    if (!clips.empty()) draw_mismatch(clips, {.tolerance = plan.length_tolerance});
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
    require_others_for_mismatch(list, plan);
}

}  // namespace chironomia::study
