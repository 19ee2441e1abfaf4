#include "study/plan.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "raster/embree/ray_renderer.h"
#include "scenes/scene_file.h"
#include "skinning/lift/lift.h"
#include "study/clip.h"
#include "study/json_value.h"
#include "study/leaks.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr int kSmallestSide = 32;   // [px]
constexpr int kLargestSide = 4096;  // [px]
// [frames a second]
constexpr double kSlowest = 5;
constexpr double kFastest = 120;
constexpr double kFastestMotion = 1000;
constexpr std::size_t kAnswers = 5;
constexpr long long kMostPlanOrders = 10000;

const std::vector<std::string> kLayouts = {"pair"};
const std::vector<std::string> kPresentations = {"two videos", "one video"};
const std::vector<std::string> kBodies = {"full", "upper"};
const std::vector<std::string> kRenderers = {"raster", "rays"};
const std::vector<std::string> kFormats = {"mp4", "webm"};
const std::vector<std::string> kScenes = {"upper", "full", "head", "dyad", "split"};
const std::vector<std::string> kSides = {"left", "right"};
const std::vector<std::string> kCues = {"none", "light"};

const std::vector<std::string>& keys_of(std::string_view object) {
    const auto& all = plan_keys();
    return std::find_if(all.begin(), all.end(), [&](const PlanKeys& each) { return each.object == object; })
        ->keys;
}

// A file named by the plan, which must be there.
fs::path read_path(const JsonValue& value, const fs::path& folder) {
    const fs::path written = value.text();
    const fs::path file = folder / written;
    if (fs::is_directory(file)) {
        value.refuse(format("\"{}\" is a folder, a file is needed; name a file in it", written.string()));
    }
    if (!fs::is_regular_file(file)) {
        value.refuse(
            format("there is no file \"{}\" (looked for {}); check the path, it is taken relative to the "
                   "plan",
                   written.string(), file.string()));
    }
    return file;
}

std::vector<std::string> read_names(const JsonValue& list, std::size_t at_least) {
    std::vector<std::string> names;
    for (const JsonValue& item : list.items(at_least)) {
        const std::string name = item.text();
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (to_lower(names[i]) != to_lower(name)) continue;
            item.refuse(format("\"{}\" is already {}[{}]; give each its own name", name, list.key(), i));
        }
        names.push_back(name);
    }
    return names;
}

int read_side(const JsonValue& value, int multiple) {
    const auto side = static_cast<int>(value.integer(kSmallestSide, kLargestSide));
    if (side % multiple != 0) {
        value.refuse(format("is {} pixels, which is no multiple of {}; use {} or {}", side, multiple,
                            side / multiple * multiple, (side / multiple + 1) * multiple));
    }
    return side;
}

// Chroma is stored for blocks of 2 x 2 pixels, and each of two figures in one video has half its width.
RenderSize read_size(const JsonValue& value, Presentation presentation) {
    const std::vector<JsonValue> sides = value.items(2);
    if (sides.size() != 2) value.refuse(format("is {}, a width and a height are needed", value.shown()));
    const int across = presentation == Presentation::one_video ? 4 : 2;
    return {.width = read_side(sides[0], across), .height = read_side(sides[1], 2)};
}

double read_share(const JsonValue& value) {
    const double share = value.json().is_number() ? value.json().get<double>() : -1;
    if (!(share >= 0 && share <= 1)) value.refuse(format("is {}, 0 to 1 is needed", value.shown()));
    return share;
}

// A number, or a ratio as a text.
Rate read_rate(const JsonValue& value, double fastest) {
    const Json& json = value.json();
    const auto rate = parse_rate(json.is_number() ? json.dump() : json.is_string() ? value.text() : "");
    if (!rate || rate->per_second() < kSlowest || rate->per_second() > fastest) {
        value.refuse(
            format("is {}, a number of frames a second from {} to {} is needed, such as 30 or "
                   "\"30000/1001\"",
                   value.shown(), kSlowest, fastest));
    }
    return *rate;
}

// A value with a file ending is a path; anything else is one of `names`.
fs::path read_path_or_name(const JsonValue& value, const fs::path& folder,
                           const std::vector<std::string>& names) {
    const fs::path written = value.text();
    if (written.has_extension()) return read_path(value, folder);
    return value.choice(names);
}

Drawing read_drawing(const JsonValue& value) {
    Drawing drawing;
    if (const auto renderer = value.find("renderer")) {
        const bool rays = renderer->choice(kRenderers) == "rays";
        drawing.renderer = rays ? RendererKind::rays : RendererKind::raster;
    }
    if (const auto samples = value.find("samples"))
        drawing.samples = static_cast<int>(samples->integer(1, kMostRaySamples));
    if (const auto blur = value.find("motion_blur")) drawing.motion_blur = read_share(*blur);
    // The rasterizer would pass over what only the ray tracer knows.
    if (drawing.renderer == RendererKind::raster && drawing != Drawing{}) {
        value.refuse(
            "asks for samples or motion_blur, which the rasterizer does not know; add "
            "\"renderer\": \"rays\" or leave them out");
    }
    return drawing;
}

// The words of a mode, for JsonValue::choice().
template <typename Mode>
Mode read_mode(const JsonValue& value, const std::map<std::string, Mode>& words) {
    std::vector<std::string> names;
    for (const auto& [name, mode] : words) names.push_back(name);
    return words.at(value.choice(names));
}

Modes read_modes(const JsonValue& value, Modes modes) {
    if (const auto face = value.find("face_mode")) modes.face_mode = read_mode(*face, face_modes());
    if (const auto hands = value.find("hands")) modes.hands = read_mode(*hands, hands_modes());
    return modes;
}

PlanRender read_render(const JsonValue& value, const fs::path& folder, Presentation presentation) {
    value.allow_only(keys_of("render"));
    PlanRender render;
    if (const auto avatar = value.find("avatar")) {
        render.avatar = read_path_or_name(*avatar, folder, avatar_names());
    }
    if (const auto scene = value.find("scene")) render.scene = read_path_or_name(*scene, folder, kScenes);
    if (const auto size = value.find("size")) render.size = read_size(*size, presentation);
    if (const auto fps = value.find("fps")) render.fps = read_rate(*fps, kFastest);
    if (const auto body = value.find("body")) render.upper_body = body->choice(kBodies) == "upper";
    render.drawing = read_drawing(value);
    render.modes = read_modes(value, {});
    if (const auto kind = value.find("format")) render.format = kind->choice(kFormats);
    if (const auto side = value.find("partner_side")) render.partner_on_left = side->choice(kSides) == "left";
    if (const auto cue = value.find("cue")) {
        render.cue = cue->choice(kCues) == "light" ? SpeakingCue::light : SpeakingCue::none;
    }
    return render;
}

// What the reader of motions makes of a word; its refusal is told with the key.
template <typename Value>
Value read_word(const JsonValue& value, Value (*meaning)(std::string_view)) {
    const std::string word = value.json().is_number() ? value.json().dump() : value.text();
    try {
        return meaning(word);
    } catch (const Error& error) {
        value.refuse(error.what());
    }
}

MotionHints read_hints_of_condition(const JsonValue& value, const fs::path& folder) {
    value.allow_only(keys_of("hints.*"));
    MotionHints hints;
    if (const auto fps = value.find("fps")) hints.fps = read_rate(*fps, kFastestMotion).per_second();
    if (const auto up = value.find("up")) hints.up = read_word(*up, up_axis_named);
    if (const auto unit = value.find("unit")) hints.unit = read_word(*unit, unit_named);
    if (const auto facing = value.find("facing")) hints.turn_deg = read_word(*facing, turn_named);
    if (const auto filter = value.find("lift_filter"))
        hints.lift_cutoff = read_word(*filter, lift_cutoff_named);
    if (const auto names = value.find("names")) hints.name_map = read_path(*names, folder);
    return hints;
}

void read_hints(const JsonValue& value, const fs::path& folder, Plan& plan) {
    value.allow_only(plan.conditions);
    plan.hints_as_written = value.json();
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        const auto hints = value.find(plan.conditions[i]);
        if (hints) plan.hints[i] = read_hints_of_condition(*hints, folder);
        const bool same = i == 0 || value.json().value(plan.conditions[i], Json()) ==
                                        value.json().value(plan.conditions[0], Json());
        if (plan.presentation == Presentation::one_video && !same) {
            value.refuse(
                format("differ between \"{}\" and \"{}\", which share one video; give every condition "
                       "the same hints or show \"two videos\"",
                       plan.conditions[0], plan.conditions[i]));
        }
    }
}

// One face for each condition or none at all: a face that one of them lacks would tell it from the others.
std::vector<fs::path> read_faces(const JsonValue& value, const std::string& clip, const fs::path& folder,
                                 const std::vector<std::string>& conditions) {
    value.allow_only(conditions);
    std::vector<fs::path> faces;
    for (const std::string& condition : conditions) {
        const auto face = value.find(condition);
        if (!face) {
            value.refuse(
                format("has no face of the condition \"{}\" in the clip \"{}\"; give every "
                       "condition a face or none",
                       condition, clip));
        }
        faces.push_back(read_path(*face, folder));
    }
    return faces;
}

// What a condition does not say is as in "render".
void read_modes_of_conditions(const JsonValue& value, Plan& plan) {
    value.allow_only(plan.conditions);
    plan.modes_as_written = value.json();
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        const auto modes = value.find(plan.conditions[i]);
        if (!modes) continue;
        modes->allow_only(keys_of("modes.*"));
        plan.modes[i] = read_modes(*modes, plan.render.modes);
    }
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

PlanClip read_clip(const JsonValue& value, const fs::path& folder,
                   const std::vector<std::string>& conditions) {
    value.allow_only(keys_of("clips[]"));
    PlanClip clip;
    clip.id = value.at("id").text();
    if (const auto audio = value.find("audio")) clip.audio = read_path(*audio, folder);
    const JsonValue motion = value.at("motion");
    motion.allow_only(conditions);
    for (const std::string& condition : conditions) {
        clip.motions.push_back(read_path(motion.at(condition), folder));
    }
    if (const auto face = value.find("face")) clip.faces = read_faces(*face, clip.id, folder, conditions);
    if (const auto partner = value.find("partner")) clip.partner = read_partner(*partner, folder, clip);
    return clip;
}

std::vector<PlanClip> read_clips(const JsonValue& list, const fs::path& folder,
                                 const std::vector<std::string>& conditions) {
    std::vector<PlanClip> clips;
    std::map<std::string, std::size_t> taken;
    for (const JsonValue& item : list.items(1)) {
        PlanClip clip = read_clip(item, folder, conditions);
        const auto [first, is_new] = taken.emplace(to_lower(clip.id), clips.size());
        if (!is_new) {
            item.at("id").refuse(format("\"{}\" is already the id of clips[{}]; give each clip its own",
                                        clip.id, first->second));
        }
        if (!clips.empty() && clip.audio.empty() != clips.front().audio.empty()) {
            item.refuse(format("has {} \"audio\" while clips[0] has {}; give all clips their sound or none",
                               clip.audio.empty() ? "no" : "an", clip.audio.empty() ? "one" : "none"));
        }
        if (!clips.empty() && clip.partner.has_value() != clips.front().partner.has_value()) {
            item.refuse(format("has {} \"partner\" while clips[0] has {}; give all clips a partner or none",
                               clip.partner ? "a" : "no", clip.partner ? "none" : "one"));
        }
        clips.push_back(std::move(clip));
    }
    return clips;
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

// Which of two people a question is about.
std::string agent_of(const PlanRender& render) {
    return render.partner_on_left ? "the person on the right" : "the person on the left";
}

std::string question_about_agent(const PlanRender& render, bool with_sound) {
    return with_sound ? format("In which video do the movements of {} fit the conversation better?",
                               agent_of(render))
                      : format("In which video does {} move more like a real person?", agent_of(render));
}

// The neutral questions and answers of pairwise studies; FIELD calls the silent one realism and the other
// alignment.
std::string default_question(Presentation presentation, bool with_sound) {
    if (presentation == Presentation::two_videos) {
        return with_sound ? "In which video do the character's movements fit the speech better?"
                          : "In which video does the character move more like a real person?";
    }
    return with_sound ? "Which character's movements fit the speech better?"
                      : "Which character moves more like a real person?";
}

std::string default_instructions(const Plan& plan, bool with_sound) {
    const std::string what =
        plan.clips.front().partner
            ? format("On each page you see two videos, A and B, of two people. Please look at {}.",
                     agent_of(plan.render))
        : plan.presentation == Presentation::two_videos
            ? "On each page you see two videos of a character, A and B."
            : "On each page you see a video of two characters, A on the left and B on the "
              "right.";
    return what +
           (with_sound ? " Please watch to the end, with the sound on, and then answer the question below."
                       : " Please watch to the end, and then answer the question below. There is no sound.") +
           " There are no right or wrong answers; your own impression counts.";
}

const std::vector<std::string> kDefaultAnswers = {"A is clearly better", "A is slightly better",
                                                  "They are equal", "B is slightly better",
                                                  "B is clearly better"};

// Texts that participants read. A condition's name in one of them would give it away.
std::string read_public_text(const JsonValue& value, const std::vector<std::string>& conditions) {
    const std::string text = value.text();
    if (const auto name = find_word(text, conditions)) {
        value.refuse(format("tells participants the name of the condition \"{}\"; write it without", *name));
    }
    return text;
}

std::vector<std::string> read_answers(const JsonValue& list, const std::vector<std::string>& conditions) {
    read_names(list, kAnswers);
    std::vector<std::string> answers;
    for (const JsonValue& item : list.items(kAnswers)) answers.push_back(read_public_text(item, conditions));
    if (answers.size() != kAnswers) {
        list.refuse(
            format("has {} entries, {} are needed: from A clearly to B clearly", answers.size(), kAnswers));
    }
    return answers;
}

void read_texts(const JsonValue& value, Plan& plan) {
    const bool with_sound = !plan.clips.front().audio.empty();
    const auto text_or = [&](std::string_view key, const std::string& otherwise) {
        const auto found = value.find(key);
        return found ? read_public_text(*found, plan.conditions) : otherwise;
    };
    plan.title = read_public_text(value.at("title"), plan.conditions);
    plan.question =
        text_or("question", plan.clips.front().partner ? question_about_agent(plan.render, with_sound)
                                                       : default_question(plan.presentation, with_sound));
    plan.instructions = text_or("instructions", default_instructions(plan, with_sound));
    const auto answers = value.find("answers");
    plan.answers = answers ? read_answers(*answers, plan.conditions) : kDefaultAnswers;
}

Json partner_as_used(const Plan& plan, const PlanPartner& partner) {
    Json json = {{"motion", path_in_plan(plan, partner.motion)}};
    if (!partner.hints_as_written.is_null()) json["hints"] = partner.hints_as_written;
    if (!partner.face.empty()) json["face"] = path_in_plan(plan, partner.face);
    if (!partner.audio.empty()) json["audio"] = path_in_plan(plan, partner.audio);
    if (!partner.avatar.empty()) json["avatar"] = path_in_plan(plan, partner.avatar);
    return json;
}

}  // namespace

const std::vector<PlanKeys>& plan_keys() {
    static const std::vector<PlanKeys> keys = {
        {.object = "",
         .keys = {"$schema", "title", "layout", "presentation", "conditions", "instructions", "question",
                  "answers", "orders", "render", "hints", "modes", "clips"},
         .required = {"title", "layout", "conditions", "clips"}},
        {.object = "render",
         .keys = {"avatar", "scene", "size", "fps", "body", "renderer", "samples", "motion_blur", "face_mode",
                  "hands", "format", "partner_side", "cue"},
         .required = {}},
        {.object = "hints.*",
         .keys = {"fps", "up", "unit", "facing", "lift_filter", "names"},
         .required = {}},
        {.object = "modes.*", .keys = {"face_mode", "hands"}, .required = {}},
        {.object = "clips[]",
         .keys = {"id", "audio", "motion", "face", "partner"},
         .required = {"id", "motion"}},
        {.object = "clips[].partner",
         .keys = {"motion", "hints", "face", "audio", "avatar"},
         .required = {"motion"}},
    };
    return keys;
}

Plan read_plan(const fs::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    whole.allow_only(keys_of(""));
    const fs::path folder = file.parent_path();

    Plan plan;
    plan.file = file;
    whole.at("layout").choice(kLayouts);
    if (const auto value = whole.find("presentation")) {
        const bool one = value->choice(kPresentations) == "one video";
        plan.presentation = one ? Presentation::one_video : Presentation::two_videos;
    }
    plan.conditions = read_names(whole.at("conditions"), 2);
    if (const auto render = whole.find("render")) {
        plan.render = read_render(*render, folder, plan.presentation);
    }
    plan.hints.resize(plan.conditions.size());
    if (const auto hints = whole.find("hints")) read_hints(*hints, folder, plan);
    plan.modes.assign(plan.conditions.size(), plan.render.modes);
    if (const auto modes = whole.find("modes")) read_modes_of_conditions(*modes, plan);
    plan.clips = read_clips(whole.at("clips"), folder, plan.conditions);
    require_scene_for_all(whole, plan);
    if (const auto orders = whole.find("orders")) {
        plan.orders = static_cast<std::size_t>(orders->integer(1, kMostPlanOrders));
    }
    read_texts(whole, plan);
    return plan;
}

std::string path_in_plan(const Plan& plan, const fs::path& path) {
    const fs::path relative = path.lexically_relative(plan.file.parent_path());
    return relative.empty() || *relative.begin() == ".." ? path.string() : relative.string();
}

Json plan_as_used(const Plan& plan) {
    const PlanRender& render = plan.render;
    Json clips = Json::array();
    for (const PlanClip& clip : plan.clips) {
        Json json = {{"id", clip.id}};
        if (!clip.audio.empty()) json["audio"] = path_in_plan(plan, clip.audio);
        for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
            json["motion"][plan.conditions[i]] = path_in_plan(plan, clip.motions[i]);
        }
        for (std::size_t i = 0; i < clip.faces.size(); ++i) {
            json["face"][plan.conditions[i]] = path_in_plan(plan, clip.faces[i]);
        }
        if (clip.partner) json["partner"] = partner_as_used(plan, *clip.partner);
        clips.push_back(std::move(json));
    }
    Json json = {{"title", plan.title}, {"layout", kLayouts.front()}};
    json["presentation"] = plan.presentation == Presentation::one_video ? "one video" : "two videos";
    json["conditions"] = plan.conditions;
    json["instructions"] = plan.instructions;
    json["question"] = plan.question;
    json["answers"] = plan.answers;
    if (plan.orders) json["orders"] = *plan.orders;
    json["render"] = {
        {"avatar", path_in_plan(plan, render.avatar)},     {"scene", path_in_plan(plan, render.scene)},
        {"size", {render.size.width, render.size.height}}, {"fps", to_text(render.fps)},
        {"body", render.upper_body ? "upper" : "full"},    {"format", render.format}};
    json["render"]["renderer"] = to_text(render.drawing.renderer);
    if (render.drawing.renderer == RendererKind::rays) {
        json["render"]["samples"] = render.drawing.samples;
        json["render"]["motion_blur"] = render.drawing.motion_blur;
    }
    json["render"].update(to_json(render.modes));
    if (plan.clips.front().partner)
        json["render"]["partner_side"] = render.partner_on_left ? "left" : "right";
    if (render.cue != SpeakingCue::none) json["render"]["cue"] = "light";
    if (!plan.hints_as_written.is_null()) json["hints"] = plan.hints_as_written;
    if (!plan.modes_as_written.is_null()) json["modes"] = plan.modes_as_written;
    json["clips"] = std::move(clips);
    return json;
}

Json modes_by_condition(const Plan& plan) {
    Json json = Json::object();
    for (std::size_t i = 0; i < plan.conditions.size(); ++i)
        json[plan.conditions[i]] = to_json(plan.modes[i]);
    return json;
}

}  // namespace chironomia
