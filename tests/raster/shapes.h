// Small avatars of known shape for the tests of the renderers.
#pragma once

#include "core/body/avatar.h"
#include "core/render/scene.h"

namespace chironomia::testing {

// Rigid surfaces on one joint at the origin, all with `material`.
Avatar avatar_of(std::vector<Surface> surfaces, const Material& material = {});

// A rectangle that faces +z; counter-clockwise seen from there.
struct Quad {
    Vec2 low{-1};  // x, y [m]
    Vec2 high{1};
    float z = 0;
};
Surface quad(const Quad& shape);

// Squares behind each other, pieces of one white surface without light whose alpha is its cutoff: each of them covers
// half of the samples of a pixel.
Avatar half_covered_cards(int count);

struct Capsule {
    Vec3 from{0};
    Vec3 to{0};  // `from` = `to`: a sphere
    float radius = 1;
    int around = 32;
};
Surface capsule(const Capsule& shape);

// A standing figure of capsules, 1.7 m high, arms a little away from the body.
Avatar capsule_figure();

// A full view of that figure in a lit studio, with key, fill and rim light and the floor in sight.
Scene studio_scene();

}  // namespace chironomia::testing
