#include "skinning/stick/stick_solids.h"

#include <array>
#include <cmath>

namespace chironomia {
namespace {

// How a kind is drawn, for an adult.
struct Stroke {
    const char* name;
    Vec3 colour;  // linear rgb
    float line;   // radius [m]
    float dot;    // radius [m]
};

float linear(int level) {
    const float encoded = static_cast<float>(level) / 255;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Vec3 srgb(int red, int green, int blue) {
    return {linear(red), linear(green), linear(blue)};
}

// Blue is left and vermilion right, arms darker than legs, for all kinds of colour vision; after Okabe and
// Ito, "Color Universal Design", 2008.
const std::array<Stroke, kStickKinds>& strokes() {
    static const std::array<Stroke, kStickKinds> all = {{
        {"trunk", srgb(68, 75, 84), 0.0115f, 0.0175f},
        {"left arm", srgb(0, 104, 190), 0.0115f, 0.0175f},
        {"right arm", srgb(222, 78, 0), 0.0115f, 0.0175f},
        {"left leg", srgb(74, 168, 222), 0.0115f, 0.0175f},
        {"right leg", srgb(240, 152, 40), 0.0115f, 0.0175f},
        {"left hand", srgb(0, 104, 190), 0.0045f, 0.0065f},
        {"right hand", srgb(222, 78, 0), 0.0045f, 0.0065f},
        {"face", srgb(58, 64, 72), 0.0035f, 0.0065f},
    }};
    return all;
}

const Stroke& stroke_of(StickKind kind) {
    return strokes()[static_cast<size_t>(kind)];
}

constexpr std::uint32_t kSides = 20;  // of a tube
constexpr std::uint32_t kRings = 10;  // of a ball, from pole to pole
constexpr float kShortest = 1e-4f;    // line that has a direction [m]

Vec3 around(std::uint32_t side) {
    const float angle = 2 * kPi * static_cast<float>(side) / kSides;
    return {std::cos(angle), 0, std::sin(angle)};
}

// Collects vertices that follow one joint each.
class SolidBuilder {
  public:
    explicit SolidBuilder(Surface& surface) : surface_(surface) {}

    // From the joint's origin to y = 1.
    void tube(std::uint32_t joint, float radius) {
        const std::uint32_t first = count();
        for (const float y : {0.0f, 1.0f}) {
            for (std::uint32_t side = 0; side < kSides; ++side)
                vertex(around(side) * radius + Vec3(0, y, 0), around(side), joint);
        }
        band(first);
    }

    void ball(std::uint32_t joint, float radius) {
        std::uint32_t first = count();
        for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
            const float angle = kPi * (static_cast<float>(ring) / kRings - 0.5f);
            for (std::uint32_t side = 0; side < kSides; ++side) {
                const Vec3 normal = around(side) * std::cos(angle) + Vec3(0, std::sin(angle), 0);
                vertex(normal * radius, normal, joint);
            }
            if (ring == 0) continue;
            band(first);
            first += kSides;
        }
    }

  private:
    std::uint32_t count() const { return static_cast<std::uint32_t>(surface_.positions.size()); }

    void vertex(const Vec3& position, const Vec3& normal, std::uint32_t joint) {
        surface_.positions.push_back(position);
        surface_.normals.push_back(normal);
        surface_.first_influence.push_back(static_cast<std::uint32_t>(surface_.influences.size()));
        surface_.influences.push_back({.joint = joint, .weight = 1});
    }

    // Between a ring of vertices and the next one above it.
    void band(std::uint32_t first) {
        for (std::uint32_t side = 0; side < kSides; ++side) {
            const std::uint32_t a = first + side, b = first + (side + 1) % kSides;
            for (const std::uint32_t corner : {a, a + kSides, b, b, a + kSides, b + kSides})
                surface_.triangles.push_back(corner);
        }
    }

    Surface& surface_;
};

Transform at_point(const Vec3& place) {
    return {.translation = place};
}

// A tube of length 1, laid from one place to another.
Transform along(const Vec3& from, const Vec3& to) {
    const float length = distance(from, to);
    if (length < kShortest) return {.translation = from, .scale = Vec3(1, kShortest, 1)};
    return {.translation = from, .rotation = turn_between({0, 1, 0}, to - from), .scale = {1, length, 1}};
}

// A joint that is not seen has no size; it waits where the person was last.
Transform hidden(const Vec3& place) {
    return {.translation = place, .scale = Vec3(0)};
}

Material matt(const Stroke& stroke) {
    return {.name = stroke.name, .base_colour = Vec4(stroke.colour, 1), .metallic = 0, .roughness = 0.85f};
}

Surface make_surface(const StickSketch& sketch, StickKind kind) {
    const Stroke& stroke = stroke_of(kind);
    Surface surface{.name = stroke.name, .skin = 0, .material = static_cast<int>(kind)};
    SolidBuilder builder(surface);
    for (size_t p = 0; p < sketch.points.size(); ++p) {
        const StickPoint& point = sketch.points[p];
        if (point.kind == kind)
            builder.ball(static_cast<std::uint32_t>(p), sketch.size * (point.dot ? stroke.dot : stroke.line));
    }
    for (size_t l = 0; l < sketch.lines.size(); ++l) {
        if (sketch.lines[l].kind == kind)
            builder.tube(static_cast<std::uint32_t>(sketch.points.size() + l), sketch.size * stroke.line);
    }
    surface.first_influence.push_back(static_cast<std::uint32_t>(surface.influences.size()));
    return surface;
}

bool is_hand(StickKind kind) {
    return kind == StickKind::left_hand || kind == StickKind::right_hand;
}

// (T, P) A finger's point that hangs together with nothing says nothing.
std::vector<bool> shown_points(const StickSketch& sketch) {
    std::vector<bool> shown = sketch.seen;
    for (size_t t = 0; t < sketch.frames; ++t) {
        std::vector<bool> joined(sketch.points.size(), false);
        for (const StickLine& line : sketch.lines) {
            if (!sketch.sees(t, line.from) || !sketch.sees(t, line.to)) continue;
            joined[line.from] = joined[line.to] = true;
        }
        for (size_t p = 0; p < joined.size(); ++p) {
            if (is_hand(sketch.points[p].kind) && !joined[p]) shown[t * joined.size() + p] = false;
        }
    }
    return shown;
}

}  // namespace

Vec3 colour_of(StickKind kind) {
    return stroke_of(kind).colour;
}

Avatar make_stick_avatar(const StickSketch& sketch) {
    Avatar avatar;
    avatar.source = "stick";
    avatar.humanoid = sketch.parts;
    avatar.humanoid_notes = {};
    for (const StickPoint& point : sketch.points)
        avatar.skeleton.joints.push_back({.name = point.name, .rest = at_point(point.rest)});
    for (const StickLine& line : sketch.lines) {
        avatar.skeleton.joints.push_back(
            {.name = sketch.points[line.from].name + " to " + sketch.points[line.to].name,
             .rest = along(sketch.points[line.from].rest, sketch.points[line.to].rest)});
    }
    Skin& skin = avatar.skins.emplace_back();
    for (size_t j = 0; j < avatar.skeleton.joints.size(); ++j) {
        skin.joints.push_back(static_cast<int>(j));
        skin.joint_from_mesh.emplace_back(1);
    }
    for (const Stroke& stroke : strokes()) avatar.materials.push_back(matt(stroke));
    for (int kind = 0; kind < kStickKinds; ++kind) {
        Surface surface = make_surface(sketch, static_cast<StickKind>(kind));
        if (!surface.positions.empty()) avatar.surfaces.push_back(std::move(surface));
    }
    return avatar;
}

PoseTrack stick_poses(const StickSketch& sketch) {
    const std::vector<bool> shown = shown_points(sketch);
    PoseTrack poses;
    std::vector<Vec3> last;
    for (const StickPoint& point : sketch.points) last.push_back(point.rest);
    for (size_t t = 0; t < sketch.frames; ++t) {
        std::vector<Transform> joints;
        for (size_t p = 0; p < sketch.points.size(); ++p) {
            if (sketch.sees(t, p)) last[p] = sketch.place(t, p);
            joints.push_back(shown[t * sketch.points.size() + p] ? at_point(last[p]) : hidden(last[p]));
        }
        for (const StickLine& line : sketch.lines) {
            const bool seen = sketch.sees(t, line.from) && sketch.sees(t, line.to);
            joints.push_back(seen ? along(last[line.from], last[line.to]) : hidden(last[line.from]));
        }
        poses.push_back({.joints = std::move(joints), .morph_weights = {}});
    }
    return poses;
}

}  // namespace chironomia
