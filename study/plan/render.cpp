#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "raster/embree/ray_renderer.h"
#include "skinning/lift/lift.h"
#include "skinning/signal/smooth.h"
#include "study/plan/parts.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

constexpr int kSmallestSide = 32;   // [px]
constexpr int kLargestSide = 4096;  // [px]
// [frames a second]
constexpr double kSlowest = 5;
constexpr double kFastest = 120;
constexpr double kFastestMotion = 1000;
// [LUFS]
constexpr double kSoftest = -40;
constexpr double kLoudest = -10;

const std::vector<std::string> kBodies = {"full", "upper"};
const std::vector<std::string> kFormats = {"mp4", "webm"};
const std::vector<std::string> kScenes = {"upper", "full", "head", "dyad", "split"};
const std::vector<std::string> kSides = {"left", "right"};
const std::vector<std::string> kCues = {"none", "light"};

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
    if (!value.json().is_array() || value.json().size() != 2)
        value.refuse(
            format("is {}, a width and a height in pixels are needed, such as [1280, 720]", value.shown()));
    const std::vector<JsonValue> sides = value.items(2);
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

// The words of a mode, for JsonValue::choice().
template <typename Mode>
Mode read_mode(const JsonValue& value, const std::map<std::string, Mode>& words) {
    std::vector<std::string> names;
    for (const auto& [name, mode] : words) names.push_back(name);
    return words.at(value.choice(names));
}

Drawing read_drawing(const JsonValue& value) {
    Drawing drawing;
    if (const auto renderer = value.find("renderer"))
        drawing.renderer = read_mode(*renderer, renderer_names());
    if (const auto samples = value.find("samples"))
        drawing.samples = static_cast<int>(samples->integer(1, kMostRaySamples));
    if (const auto blur = value.find("motion_blur")) drawing.motion_blur = read_share(*blur);
    // Other renderers would pass over what only the ray tracer knows.
    if (drawing.renderer != RendererKind::rays && drawing != Drawing{.renderer = drawing.renderer}) {
        value.refuse(
            "asks for samples or motion_blur, which the ray tracer alone knows; add "
            "\"renderer\": \"rays\" or leave them out");
    }
    return drawing;
}

// Hips that are held still go nowhere.
Travel read_travel(const JsonValue& value, bool upper_body) {
    const Travel travel = read_mode(value, travels());
    if (travel != Travel::free && upper_body) {
        value.refuse(format("is {}, but \"body\" is \"upper\", whose hips stand still; leave one of them out",
                            value.shown()));
    }
    return travel;
}

Modes read_modes(const JsonValue& value, Modes modes) {
    if (const auto face = value.find("face_mode")) modes.face_mode = read_mode(*face, face_modes());
    if (const auto hands = value.find("hands")) modes.hands = read_mode(*hands, hands_modes());
    return modes;
}

// A target, or the sounds as they are.
std::optional<double> read_loudness(const JsonValue& value) {
    if (value.json() == "as recorded") return std::nullopt;
    if (!value.json().is_number()) {
        value.refuse(format("is {}, a number of LUFS from {} to {} or \"as recorded\" is needed",
                            value.shown(), kSoftest, kLoudest));
    }
    return value.number(kSoftest, kLoudest);
}

// The value that the reader of motions has for a word. A refusal names the key.
template <typename Value>
Value read_word(const JsonValue& value, Value (*meaning)(std::string_view)) {
    const std::string word = value.json().is_number() ? value.json().dump() : value.text();
    try {
        return meaning(word);
    } catch (const Error& error) {
        value.refuse(error.what());
    }
}

}  // namespace

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
    if (const auto travel = value.find("travel")) render.travel = read_travel(*travel, render.upper_body);
    render.drawing = read_drawing(value);
    render.modes = read_modes(value, {});
    if (const auto kind = value.find("format")) render.format = kind->choice(kFormats);
    if (const auto side = value.find("partner_side")) render.partner_on_left = side->choice(kSides) == "left";
    if (const auto cue = value.find("cue")) {
        render.cue = cue->choice(kCues) == "light" ? SpeakingCue::light : SpeakingCue::none;
    }
    if (const auto loudness = value.find("loudness")) render.loudness = read_loudness(*loudness);
    return render;
}

MotionHints read_hints_of_condition(const JsonValue& value, const fs::path& folder) {
    value.allow_only(keys_of("hints.*"));
    MotionHints hints;
    if (const auto fps = value.find("fps")) hints.fps = read_rate(*fps, kFastestMotion).per_second();
    if (const auto up = value.find("up")) hints.up = read_word(*up, up_axis_named);
    if (const auto unit = value.find("unit")) hints.unit = read_word(*unit, unit_named);
    if (const auto facing = value.find("facing")) hints.turn_deg = read_word(*facing, turn_named);
    if (const auto size = value.find("picture_size"))
        hints.picture.size = read_word(*size, picture_size_named);
    if (const auto view = value.find("field_of_view"))
        hints.picture.field_of_view = read_word(*view, field_of_view_named);
    if (const auto filter = value.find("lift_filter"))
        hints.lift_cutoff = read_word(*filter, lift_cutoff_named);
    if (const auto smooth = value.find("smooth")) hints.smoothing = read_word(*smooth, smoothing_named);
    if (const auto animation = value.find("animation")) hints.animation = animation->text();
    if (const auto names = value.find("names")) hints.name_map = read_path(*names, folder);
    hints.of_several = true;
    return hints;
}

void read_hints(const JsonValue& whole, const fs::path& folder, Plan& plan) {
    plan.hints.resize(plan.conditions.size());
    const auto found = whole.find("hints");
    if (!found) return;
    const JsonValue& value = *found;
    const std::vector<std::string> names = condition_names(plan);
    value.allow_only(names);
    plan.hints_as_written = value.json();
    for (std::size_t i = 0; i < plan.conditions.size(); ++i) {
        const auto hints = value.find(names[plan.conditions[i].from]);
        if (hints) plan.hints[i] = read_hints_of_condition(*hints, folder);
        const bool same =
            i == 0 || value.json().value(names[i], Json()) == value.json().value(names[0], Json());
        if (plan.presentation == Presentation::one_video && !same) {
            value.refuse(
                format("differ between \"{}\" and \"{}\", which share one video; give every condition "
                       "the same hints or show \"two videos\"",
                       names[0], names[i]));
        }
    }
}

// What a condition does not say is as in "render".
void read_modes_of_conditions(const JsonValue& whole, Plan& plan) {
    plan.modes.assign(plan.conditions.size(), plan.render.modes);
    const auto found = whole.find("modes");
    if (!found) return;
    const JsonValue& value = *found;
    const std::vector<std::string> names = condition_names(plan);
    value.allow_only(names);
    plan.modes_as_written = value.json();
    for (std::size_t i = 0; i < names.size(); ++i) {
        // A condition that is made of another is shown like it, but for what is said of itself.
        for (const std::size_t said : {plan.conditions[i].from, i}) {
            const auto modes = value.find(names[said]);
            if (!modes) continue;
            modes->allow_only(keys_of("modes.*"));
            plan.modes[i] = read_modes(*modes, plan.modes[i]);
        }
    }
}

}  // namespace chironomia::study
