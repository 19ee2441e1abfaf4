#include <algorithm>

#include "core/text.h"
#include "study/plan/parts.h"

namespace chironomia::study {
namespace {

Json early_checks(EarlyChecks checks) {
    if (checks == EarlyChecks::all) return "all";
    return checks == EarlyChecks::first;
}

// A value with a file ending is a path.
std::string name_or_path_in_plan(const Plan& plan, const std::filesystem::path& value) {
    return value.has_extension() ? path_in_plan(plan, value) : value.string();
}

Json partner_as_used(const Plan& plan, const PlanPartner& partner) {
    Json json = {{"motion", path_in_plan(plan, partner.motion)}};
    if (!partner.hints_as_written.is_null()) json["hints"] = partner.hints_as_written;
    if (!partner.face.empty()) json["face"] = path_in_plan(plan, partner.face);
    if (!partner.audio.empty()) json["audio"] = path_in_plan(plan, partner.audio);
    if (!partner.avatar.empty()) json["avatar"] = path_in_plan(plan, partner.avatar);
    return json;
}

Json condition_as_used(const Plan& plan, const PlanCondition& condition) {
    if (condition.making == Making::given) return condition.name;
    if (is_performed(condition)) return condition.as_written;
    Json json = {{"name", condition.name},
                 {"from", plan.conditions[condition.from].name},
                 {"by", kind_of_making(condition)}};
    if (condition.making != Making::anchor) return json;
    if (condition.anchor.kind == DegradationKind::delayed) json["ms"] = condition.anchor.amount;
    if (condition.anchor.kind == DegradationKind::damped) json["factor"] = condition.anchor.amount;
    if (condition.anchor.kind == DegradationKind::jittered) json["degrees"] = condition.anchor.amount;
    return json;
}

// What is said for the conditions that perform it.
void add_script(const Plan& plan, const PlanClip& clip, Json& json) {
    if (!performs_speech(plan)) return;
    if (!clip.words.empty()) json["words"] = path_in_plan(plan, clip.words);
    if (!clip.script.empty()) {
        json["script"] = path_in_plan(plan, clip.script);
    } else if (clip.text) {
        json["text"] = clip.text->text;
    }
    if (clip.audio.empty()) json["voice"] = name_or_path_in_plan(plan, clip.voice);
    json["seed"] = clip.seed;
}

Json clip_as_used(const Plan& plan, const PlanClip& clip) {
    Json json = {{"id", clip.id}};
    if (!clip.speaker.empty()) json["speaker"] = clip.speaker;
    if (!clip.audio.empty()) json["audio"] = path_in_plan(plan, clip.audio);
    add_script(plan, clip, json);
    if (!clip.transcript.empty()) json["transcript"] = clip.transcript;
    if (!clip.caption.empty()) json["caption"] = clip.caption;
    if (clip.cut) json["cut"] = {clip.cut->begin, *clip.cut->end};
    if (clip.practice) json["practice"] = true;
    if (clip.block) json["block"] = *clip.block;
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        if (plan.conditions[i].making != Making::given) continue;
        json["motion"][plan.conditions[i].name] = path_in_plan(plan, clip.motions[i]);
        if (!clip.faces.empty()) json["face"][plan.conditions[i].name] = path_in_plan(plan, clip.faces[i]);
    }
    if (clip.partner) json["partner"] = partner_as_used(plan, *clip.partner);
    return json;
}

Json render_as_used(const Plan& plan) {
    const PlanRender& render = plan.render;
    Json json = {
        {"avatar", path_in_plan(plan, render.avatar)},     {"scene", path_in_plan(plan, render.scene)},
        {"size", {render.size.width, render.size.height}}, {"fps", to_text(render.fps)},
        {"body", render.upper_body ? "upper" : "full"},    {"format", render.format}};
    if (render.travel != Travel::free) json["travel"] = to_text(render.travel);
    json["renderer"] = to_text(render.drawing.renderer);
    if (render.drawing.renderer == RendererKind::rays) {
        json["samples"] = render.drawing.samples;
        json["motion_blur"] = render.drawing.motion_blur;
    }
    json.update(to_json(render.modes));
    if (plan.clips.front().partner) json["partner_side"] = render.partner_on_left ? "left" : "right";
    if (render.cue != SpeakingCue::none) json["cue"] = "light";
    json["loudness"] = render.loudness ? Json(*render.loudness) : Json("as recorded");
    return json;
}

// Who takes part and how much each one sees.
void add_participants(const Plan& plan, Json& json) {
    const PlanParticipants& who = plan.participants;
    if (who.wanted) json["participants"] = *who.wanted;
    json["blocks"] = who.blocks;
    json["each_clip_once"] = who.each_clip_once;
    if (who.pages_each) json["pages_per_participant"] = *who.pages_each;
    if (who.orders) json["orders"] = *who.orders;
}

void add_questions(const Plan& plan, Json& json) {
    for (const Question& question : plan.questions) json["questions"].push_back(to_json(question));
    if (!plan.scales.empty()) json["scales"] = to_json(plan.scales, plan.questions);
    if (!plan.right_answers.empty()) json["right_answers"] = plan.right_answers;
    for (const PagePass& pass : plan.passes) {
        Json ids = Json::array();
        for (const std::size_t question : pass.questions) ids.push_back(plan.questions[question].id);
        json["passes"].push_back({{"sound", pass.sound}, {"questions", std::move(ids)}});
    }
    json["shuffle_questions"] = plan.shuffle_questions;
    if (plan.skip_after) json["skip_after"] = *plan.skip_after;
    for (const Question& question : plan.questionnaire) json["questionnaire"].push_back(to_json(question));
    if (plan.checks.count > 0) {
        json["checks"] = {{"count", plan.checks.count},
                          {"kinds", plan.checks.kinds},
                          {"at_beginning", early_checks(plan.checks.at_beginning)},
                          {"instruction", plan.checks.instruction},
                          {"instruction_of_video", plan.checks.instruction_of_video}};
    }
    json["exclusions"] = {{"failed_checks", plan.exclusions.failed_checks},
                          {"lenient_failed_checks", plan.exclusions.lenient_failed_checks}};
    if (plan.exclusions.fastest_seconds)
        json["exclusions"]["fastest_seconds"] = *plan.exclusions.fastest_seconds;
}

Json paragraphs(const std::string& text) {
    Json list = Json::array();
    for (const std::string_view paragraph : split(text, '\n')) list.push_back(paragraph);
    return list.size() == 1 ? list.front() : list;
}

Json completion_as_used(const PlanCompletion& completion) {
    Json json = Json::object();
    for (const auto& [key, text] : {std::pair{"url", completion.url},
                                    {"code", completion.code},
                                    {"failed_url", completion.failed_url},
                                    {"failed_code", completion.failed_code},
                                    {"declined_url", completion.declined_url}}) {
        if (!text.empty()) json[key] = text;
    }
    if (!json.empty()) json["shown_by"] = completion.by_server ? "server" : "page";
    return json;
}

void add_texts(const Plan& plan, Json& json) {
    const PlanTexts& texts = plan.texts;
    json["instructions"] = paragraphs(texts.instructions);
    if (!texts.consent.empty()) json["consent"] = paragraphs(texts.consent);
    if (!texts.training.empty()) json["training"] = paragraphs(texts.training);
    json["sound_check"] = plan.sound_check;
    if (!texts.page.empty()) json["texts"] = texts.page;
}

}  // namespace

Json plan_as_used(const Plan& plan) {
    Json json = Json::object();
    if (!plan.preset.empty()) json["from_preset"] = plan.preset;
    json["title"] = plan.texts.title;
    json["language"] = plan.texts.language;
    json["layout"] = to_text(plan.layout);
    if (plan.layout == Layout::pair)
        json["presentation"] = presentation_names()[static_cast<std::size_t>(plan.presentation)];
    for (const PlanCondition& condition : plan.conditions)
        json["conditions"].push_back(condition_as_used(plan, condition));
    if (plan.reference) json["reference"] = plan.conditions[*plan.reference].name;
    if (!plan.compare_as_written.is_null()) json["compare"] = plan.compare_as_written;
    if (plan.fixed_sides) json["sides"] = "fixed";
    if (has_mismatch(plan)) json["length_tolerance"] = plan.length_tolerance;
    add_texts(plan, json);
    add_questions(plan, json);
    add_participants(plan, json);
    const Json completion = completion_as_used(plan.completion);
    if (!completion.empty()) json["completion"] = completion;
    if (!plan.preregistration.is_null()) {
        json["preregistration"] = plan.preregistration;
        if (plan.smallest_effect) json["preregistration"]["smallest_effect"] = *plan.smallest_effect;
    }
    json["silent"] = plan.silent;
    json["render"] = render_as_used(plan);
    if (!plan.hints_as_written.is_null()) json["hints"] = plan.hints_as_written;
    if (!plan.modes_as_written.is_null()) json["modes"] = plan.modes_as_written;
    for (const PlanClip& clip : plan.clips) json["clips"].push_back(clip_as_used(plan, clip));
    return json;
}

}  // namespace chironomia::study
