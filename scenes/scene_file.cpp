#include "scenes/scene_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
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
            const double light = level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
            linear[i] = static_cast<float>(light);
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
    const std::array<std::pair<const char*, Framing>, 3> known = {
        {{"upper", Framing::upper}, {"full", Framing::full}, {"head", Framing::head}}};
    for (const auto& [name, framing] : known) {
        if (value == name) return framing;
    }
    throw Error(format("{}: {} is no framing; choose full, head or upper", section.place_of("framing"),
                       value.dump()));
}

Camera camera_of(const Section& section, const FigureMeasures& figure, RenderSize size) {
    const float fov_y = angle(section, "fov_deg", {5, 120});
    if (!section.has("eye")) {
        return frame_figure(figure,
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
const std::vector<std::string> kSceneKeys = {"$schema", "camera", "lights", "ambient", "floor", "backdrop"};

Scene scene_from(const std::string& file, const Json& json, const Avatar& avatar, RenderSize size) {
    const Section top(file + ": ", json, kSceneKeys);
    const auto section = [&](const std::string& key, const std::vector<std::string>& keys) {
        return Section(top.place_of(key), top.at(key), keys);
    };
    const FigureMeasures figure = measure_figure(avatar);
    Scene scene;
    scene.camera = camera_of(section("camera", kCameraKeys), figure, size);

    const Json& lights = top.at("lights");
    if (!lights.is_array()) {
        throw Error(format("{}: {} is no list; write it as [...]", top.place_of("lights"), lights.dump()));
    }
    for (size_t i = 0; i < lights.size(); ++i) {
        const Section light(format("{}[{}]", top.place_of("lights"), i), lights[i], kLightKeys);
        scene.lights.push_back(light_of(light, scene.camera));
    }

    const Section ambient = section("ambient", {"sky", "ground", "strength"});
    scene.sky = ambient.colour("sky") * ambient.number("strength", {0, 100});
    scene.ground = ambient.colour("ground") * ambient.number("strength", {0, 100});

    const Section floor = section("floor", {"visible", "colour", "reach", "shadow"});
    scene.floor = floor.flag("visible");
    scene.floor_height = figure.floor;
    scene.floor_reach = floor.number("reach", {0.1, 1000});
    scene.floor_colour = floor.colour("colour");
    scene.floor_shadow = floor.number("shadow", {0, 1});

    const Section backdrop = section("backdrop", {"top", "bottom"});
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

Scene scene_in(const std::string& file, const Avatar& avatar, RenderSize size) {
    return scene_from(file, completed(read_json(file), read_json(bundled_file("upper"))), avatar, size);
}

}  // namespace

std::vector<std::string> scene_names() {
    return {"full", "head", "upper"};
}

Scene make_scene(const std::string& name_or_file, const Avatar& avatar, RenderSize size) {
    const std::vector<std::string> names = scene_names();
    if (std::find(names.begin(), names.end(), name_or_file) != names.end()) {
        return scene_in(bundled_file(name_or_file).string(), avatar, size);
    }
    if (!name_or_file.ends_with(".json") && !fs::exists(name_or_file)) {
        const auto meant = nearest_name(name_or_file, names);
        throw Error(format("scene \"{}\": there is no such scene; {}choose one of {}, or name a JSON file",
                           name_or_file, meant ? format("did you mean {}? ", *meant) : "", join(names)));
    }
    return scene_in(name_or_file, avatar, size);
}

}  // namespace chironomia
