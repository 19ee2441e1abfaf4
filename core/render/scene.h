// What stands around the avatar: camera, light, floor and backdrop. Colours are linear rgb.
#pragma once

#include <vector>

#include "core/math.h"

namespace chironomia {

struct Camera {
    Vec3 eye{0, 1, 3};     // [m, world]
    Vec3 target{0, 1, 0};  // [m, world]
    Vec3 up{0, 1, 0};
    float fov_y = 0.5f;  // whole vertical field of view [rad]
    float near = 0.1f;   // [m]
    float far = 50.0f;   // [m]
};

struct Light {
    Vec3 towards{0, 1, 0};  // unit, from the scene to the light
    Vec3 radiance{1};
    bool casts_shadow = false;
    float angle = 0.05f;  // the light's own angular radius; how soft its shadow is [rad]
    float wrap = 0;       // how far it reaches round into the shade, as a large soft box does; 0: Lambert
};

// Where a figure stands on the floor.
struct Placement {
    float x = 0;        // of the middle between its shoulders [m]
    float z = 0;        // [m]
    float heading = 0;  // round +y from +z to +x, which is to the figure's own left [rad]; 0: it faces +z
};

// The floor and the backdrop are seen in the colours given here, as on a lit studio sweep; only shadows
// darken them.
struct Scene {
    Camera camera;
    std::vector<Light> lights;
    std::vector<Placement> places;  // one for each figure; empty: the figure stands as its file has it
    Vec3 sky{0.5f};                 // ambient light from above
    Vec3 ground{0.25f};             // ambient light from below
    bool floor = true;              // a level plane that takes the shadow and fades into the backdrop
    float floor_height = 0;         // [m]
    float floor_reach = 5;          // from the camera's target to where the floor has become the backdrop [m]
    Vec3 floor_colour{0.8f};
    float floor_shadow = 0.6f;  // how much of the floor's colour the deepest shadow takes, in [0, 1]
    Vec3 backdrop_top{0.8f};
    Vec3 backdrop_bottom{0.8f};
};

}  // namespace chironomia
