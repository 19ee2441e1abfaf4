#include "scenes/scene_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/files/json.h"
#include "core/render/srgb.h"
#include "core/text.h"
#include "scenes/framing.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

struct Range {
    double least = 0;
    double most = 1;
};

// One object of a scene file, with what is needed to say where something is wrong in it.
class Section {
  public:
    Section(std::string where, const Json& json, const std::vector<std::string>& keys)
        : where_(std::move(where)), json_(json) {
        if (!json.is_object()) {
            const char* colon = begins_file() ? "" : ": ";
            throw Error(format("{}{}{} is no object; write it as {{...}}", where_, colon, json.dump()));
        }
        for (const auto& [key, value] : json.items()) {
            if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
            const auto meant = nearest_name(key, keys);
            throw Error(format("{}: unknown key; {}use one of {}", place_of(key),
                               meant ? format("did you mean {}? ", *meant) : "", join(keys)));
        }
    }

    std::string place_of(const std::string& key) const {
        return begins_file() ? where_ + key : where_ + "." + key;
    }
    bool has(const std::string& key) const { return json_.contains(key); }
    const Json& at(const std::string& key) const {
        if (!has(key)) throw Error(format("{}: is missing; add it", place_of(key)));
        return json_.at(key);
    }

    float number(const std::string& key, const Range& range) const {
        return number_in(at(key), place_of(key), range);
    }

    bool flag(const std::string& key) const {
        const Json& value = at(key);
        if (!value.is_boolean()) {
            throw Error(format("{}: {} is no answer; write true or false", place_of(key), value.dump()));
        }
        return value.get<bool>();
    }

    // "#rrggbb", sRGB; linear rgb.
    Vec3 colour(const std::string& key) const {
        const Json& value = at(key);
        const std::string text = value.is_string() ? value.get<std::string>() : "";
        const bool hexadecimal = text.size() == 7 && text[0] == '#' &&
                                 text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
        if (!hexadecimal) {
            throw Error(format("{}: {} is no colour; write it as \"#rrggbb\"", place_of(key), value.dump()));
        }
        Vec3 linear;
        for (int i = 0; i < 3; ++i) {
            const double level =
                std::stoi(text.substr(static_cast<size_t>(1 + 2 * i), 2), nullptr, 16) / 255.0;
            linear[i] = static_cast<float>(linear_from_srgb(level));
        }
        return linear;
    }

    Vec3 place(const std::string& key) const {
        const Json& value = at(key);
        if (!value.is_array() || value.size() != 3) {
            throw Error(
                format("{}: {} is no place; write it as [x, y, z] in metres", place_of(key), value.dump()));
        }
        Vec3 place;
        for (int i = 0; i < 3; ++i) {
            place[i] =
                number_in(value[static_cast<size_t>(i)], format("{}[{}]", place_of(key), i), {-1000, 1000});
        }
        return place;
    }

  private:
    // The outermost object has only the file before it.
    bool begins_file() const { return where_.ends_with(": "); }

    static float number_in(const Json& value, const std::string& place, const Range& range) {
        if (!value.is_number() || value.get<double>() < range.least || value.get<double>() > range.most) {
            throw Error(format("{}: {} is out of range; give a number from {} to {}", place, value.dump(),
                               range.least, range.most));
        }
        return value.get<float>();
    }

    std::string where_;
    const Json& json_;
};

float angle(const Section& section, const std::string& key, const Range& degrees) {
    return radians(section.number(key, degrees));
}

Framing framing_of(const Section& section) {
    const Json& value = section.at("framing");
    const std::array<std::pair<const char*, Framing>, 4> known = {
        {{"upper", Framing::upper}, {"full", Framing::full}, {"head", Framing::head}, {"box", Framing::box}}};
    for (const auto& [name, framing] : known) {
        if (value == name) return framing;
    }
    throw Error(format("{}: {} is no framing; choose box, full, head or upper", section.place_of("framing"),
                       value.dump()));
}

// Whom a scene shows, measured where they stand, and where the camera's yaw of 0 is.
struct Company {
    std::vector<FigureMeasures> figures;
    Vec3 front{0, 0, 1};  // unit, level
    float floor = 0;      // [m]
    float size = 1;       // of the first, compared with a person
};

Camera camera_of(const Section& section, const Company& company, RenderSize size) {
    const float fov_y = angle(section, "fov_deg", {5, 120});
    if (!section.has("eye")) {
        return frame_figures(company.figures, company.front,
                             {.framing = framing_of(section),
                              .fov_y = fov_y,
                              .yaw = angle(section, "yaw_deg", {-180, 180}),
                              .pitch = angle(section, "pitch_deg", {-80, 80}),
                              .zoom = section.number("zoom", {0.1, 10})},
                             size);
    }
    Camera camera{.eye = section.place("eye"), .target = section.place("target"), .fov_y = fov_y};
    const Vec3 ahead = camera.target - camera.eye;
    if (std::hypot(ahead.x, ahead.z) < 1e-3f) {
        throw Error(
            format("{}: lies straight above or below the target, up has no meaning there; move it sideways",
                   section.place_of("eye")));
    }
    camera.near = 0.05f * length(ahead);
    camera.far = 20 * length(ahead);
    return camera;
}

// Lights stand round the camera's line of sight, so that a turned camera sees the figure in the same light.
Light light_of(const Section& section, const Camera& camera) {
    const Vec3 line = camera.eye - camera.target;
    const Vec3 level = normalize(Vec3(line.x, 0, line.z));
    const Vec3 right = cross(Vec3(0, 1, 0), level);
    const float azimuth = angle(section, "azimuth_deg", {-180, 180});
    const float elevation = angle(section, "elevation_deg", {-90, 90});
    return {.towards = std::cos(elevation) * (std::cos(azimuth) * level + std::sin(azimuth) * right) +
                       Vec3(0, std::sin(elevation), 0),
            .radiance = section.colour("colour") * section.number("strength", {0, 100}),
            .casts_shadow = section.flag("shadow"),
            .angle = angle(section, "softness_deg", {0, 30}),
            .wrap = section.number("wrap", {0, 1})};
}

const std::vector<std::string> kCameraKeys = {"framing", "fov_deg", "yaw_deg", "pitch_deg",
                                              "zoom",    "eye",     "target"};
const std::vector<std::string> kLightKeys = {"azimuth_deg", "elevation_deg", "colour", "strength",
                                             "shadow",      "softness_deg",  "wrap"};
const std::vector<std::string> kSceneKeys = {"$schema", "camera",   "lights", "ambient",
                                             "floor",   "backdrop", "places", "split"};
constexpr std::size_t kMostPeople = 2;

// The whole file; what it leaves out is as in upper.json.
struct SceneFile {
    std::string name;
    Json json;

    Section top() const { return {name + ": ", json, kSceneKeys}; }
    Section section(const std::string& key, const std::vector<std::string>& keys) const {
        return {top().place_of(key), top().at(key), keys};
    }
};

const Json& list_in(const Section& section, const std::string& key) {
    const Json& list = section.at(key);
    if (!list.is_array()) {
        throw Error(format("{}: {} is no list; write it as [...]", section.place_of(key), list.dump()));
    }
    return list;
}

std::vector<Placement> places_in(const SceneFile& file) {
    const Section top = file.top();
    if (!top.has("places")) return {};
    const Json& list = list_in(top, "places");
    if (list.empty() || list.size() > kMostPeople) {
        throw Error(format("{}: {} places, a scene shows 1 to {} people; list one place for each",
                           top.place_of("places"), list.size(), kMostPeople));
    }
    std::vector<Placement> places;
    for (size_t i = 0; i < list.size(); ++i) {
        const Section place(format("{}[{}]", top.place_of("places"), i), list[i], {"x", "z", "heading_deg"});
        places.push_back({.x = place.number("x", {-100, 100}),
                          .z = place.number("z", {-100, 100}),
                          .heading = angle(place, "heading_deg", {-180, 180})});
    }
    return places;
}

// How a scene is divided among its people.
struct Split {
    float gap = 0;  // between the pictures, as a share of the whole width
    Vec3 colour{0};
};

std::optional<Split> split_in(const SceneFile& file) {
    if (!file.top().has("split")) return std::nullopt;
    const Section section = file.section("split", {"gap", "colour"});
    return Split{.gap = section.number("gap", {0, 0.2}), .colour = section.colour("colour")};
}

std::size_t people_in(const SceneFile& file) {
    const std::vector<Placement> places = places_in(file);
    if (!split_in(file)) return std::max<std::size_t>(places.size(), 1);
    if (!places.empty() && places.size() != kMostPeople) {
        throw Error(format("{}: 1 place, but a split scene shows {} people; list {} places or none",
                           file.top().place_of("places"), kMostPeople, kMostPeople));
    }
    return kMostPeople;
}

// Whom or what a picture shows; `rooms` is empty or has one for each.
struct Cast {
    std::span<const Avatar* const> avatars;
    std::span<const Bounds> rooms;

    Cast only(size_t index) const {
        return {avatars.subspan(index, 1), rooms.empty() ? rooms : rooms.subspan(index, 1)};
    }
};

// `places` is empty or has one for each of the cast.
Company company_of(const Cast& cast, const std::vector<Placement>& places) {
    constexpr float kPerson = 1.8f;  // from end to end [m]
    Company company;
    for (size_t i = 0; i < cast.avatars.size(); ++i) {
        FigureMeasures figure = measure_figure(*cast.avatars[i]);
        if (!cast.rooms.empty()) figure.room = cast.rooms[i];
        company.figures.push_back(places.empty() ? figure : placed(figure, places[i]));
    }
    const FigureMeasures& first = company.figures.front();
    company.floor = first.floor;
    if (places.empty()) company.front = first.forward;
    if (first.room) {
        const float largest = distance(first.room->low, first.room->high);
        company.floor = first.room->low.y;
        company.size = largest > 0 ? largest / kPerson : 1;
    }
    return company;
}

Scene scene_from(const SceneFile& file, const Cast& cast, const std::vector<Placement>& places,
                 RenderSize size) {
    const Company company = company_of(cast, places);
    Scene scene;
    scene.camera = camera_of(file.section("camera", kCameraKeys), company, size);
    scene.places = places;

    const Section top = file.top();
    const Json& lights = list_in(top, "lights");
    for (size_t i = 0; i < lights.size(); ++i) {
        const Section light(format("{}[{}]", top.place_of("lights"), i), lights[i], kLightKeys);
        scene.lights.push_back(light_of(light, scene.camera));
    }

    const Section ambient = file.section("ambient", {"sky", "ground", "strength"});
    scene.sky = ambient.colour("sky") * ambient.number("strength", {0, 100});
    scene.ground = ambient.colour("ground") * ambient.number("strength", {0, 100});

    const Section floor = file.section("floor", {"visible", "colour", "reach", "shadow"});
    scene.floor = floor.flag("visible");
    scene.floor_height = company.floor;
    scene.floor_reach = floor.number("reach", {0.1, 1000}) * company.size;
    scene.floor_colour = floor.colour("colour");
    scene.floor_shadow = floor.number("shadow", {0, 1});

    const Section backdrop = file.section("backdrop", {"top", "bottom"});
    scene.backdrop_top = backdrop.colour("top");
    scene.backdrop_bottom = backdrop.colour("bottom");
    return scene;
}

fs::path bundled_file(const std::string& name) {
    return find_asset("scenes/" + name + ".json");
}

// What `file` leaves out is as in `otherwise`. Lists are replaced whole.
Json completed(const Json& file, Json otherwise) {
    if (!file.is_object() || !otherwise.is_object()) return file;
    for (const auto& [key, value] : file.items()) {
        otherwise[key] = otherwise.contains(key) ? completed(value, otherwise[key]) : value;
    }
    return otherwise;
}

// A camera is placed by its eye and target, or so that it frames the figure.
void refuse_two_ways(const SceneFile& file) {
    if (!file.json.is_object() || !file.json.contains("camera")) return;
    const Json& camera = file.json["camera"];
    if (!camera.is_object() || !camera.contains("eye")) return;
    for (const char* key : {"framing", "yaw_deg", "pitch_deg", "zoom"}) {
        if (camera.contains(key))
            throw Error(format("{}: camera.{}: changes nothing beside eye and target; leave it or them out",
                               file.name, key));
    }
}

SceneFile read_scene(const std::string& name_or_file) {
    const fs::path file = scene_file(name_or_file);
    const SceneFile own{.name = file.string(), .json = read_json(file)};
    refuse_two_ways(own);
    return {.name = own.name, .json = completed(own.json, read_json(bundled_file("upper")))};
}

// The views of several pictures beside each other, one figure in each.
std::vector<View> views_beside(const SceneFile& file, const Cast& cast, RenderSize size, int gap) {
    const int people = static_cast<int>(cast.avatars.size());
    const RenderSize panel{.width = (size.width - gap * (people - 1)) / people, .height = size.height};
    const std::vector<Placement> places = places_in(file);
    std::vector<View> views;
    for (size_t i = 0; i < cast.avatars.size(); ++i) {
        std::vector<Placement> own;
        if (!places.empty()) own = {places[std::min(i, places.size() - 1)]};
        views.push_back({.scene = scene_from(file, cast.only(i), own, panel),
                         .figures = {i},
                         .left = static_cast<int>(i) * (panel.width + gap),
                         .size = panel});
    }
    return views;
}

// The nearest width of the gap that leaves pictures of the same width on both sides [px].
int gap_in_pixels(const Split& split, RenderSize size) {
    const int odd = size.width % 2;
    return odd + 2 * static_cast<int>(std::lround((split.gap * static_cast<float>(size.width) - odd) / 2));
}

}  // namespace

std::vector<std::string> scene_names() {
    return {"dyad", "full", "head", "object", "split", "upper"};
}

fs::path scene_file(const std::string& name_or_file) {
    const std::vector<std::string> names = scene_names();
    if (std::find(names.begin(), names.end(), name_or_file) != names.end()) return bundled_file(name_or_file);
    if (!name_or_file.ends_with(".json") && !fs::exists(name_or_file)) {
        const auto meant = nearest_name(name_or_file, names);
        throw Error(format("scene \"{}\": there is no such scene; {}choose one of {}, or name a JSON file",
                           name_or_file, meant ? format("did you mean {}? ", *meant) : "", join(names)));
    }
    return name_or_file;
}

std::size_t people_in_scene(const std::string& name_or_file) {
    return people_in(read_scene(name_or_file));
}

Scene make_scene(const std::string& name_or_file, const Avatar& avatar, RenderSize size) {
    const Avatar* figure = &avatar;
    return stage_scene(name_or_file, std::span(&figure, 1), size).views.front().scene;
}

Staging stage_scene(const std::string& name_or_file, std::span<const Avatar* const> figures, RenderSize size,
                    std::span<const Bounds> rooms) {
    assert(rooms.empty() || rooms.size() == figures.size());
    const SceneFile file = read_scene(name_or_file);
    if (people_in(file) != figures.size()) {
        throw Error(format("scene {}: shows {} people, but there {} {}; {}", name_or_file, people_in(file),
                           figures.size() == 1 ? "is" : "are", figures.size(),
                           people_in(file) == 1 ? "choose dyad or split for two"
                                                : "give two motions, or choose upper, full or head"));
    }
    if (const auto split = split_in(file)) {
        return {.views = views_beside(file, {figures, rooms}, size, gap_in_pixels(*split, size)),
                .gap_colour = split->colour};
    }
    std::vector<std::size_t> all(figures.size());
    std::iota(all.begin(), all.end(), 0);
    return {.views = {{.scene = scene_from(file, {figures, rooms}, places_in(file), size),
                       .figures = all,
                       .left = 0,
                       .size = size}}};
}

Staging stage_beside(const std::string& name_or_file, std::span<const Avatar* const> figures,
                     RenderSize size) {
    const SceneFile file = read_scene(name_or_file);
    if (people_in(file) != 1) {
        throw Error(format("scene {}: shows {} people, a scene for one is needed; choose upper, full or head",
                           name_or_file, people_in(file)));
    }
    return {.views = views_beside(file, {figures, {}}, size, 0)};
}

}  // namespace chironomia
