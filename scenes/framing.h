// Where to put a camera so that a figure and the room it gestures in fill the picture, whatever its build.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/body/avatar.h"
#include "core/body/rest.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"

namespace chironomia {

// What of a figure matters for a picture, measured at rest. Sides are the figure's own.
struct FigureMeasures {
    Vec3 forward{0, 0, 1};  // unit, level: where it faces
    Vec3 middle{0};         // between the shoulders, at floor height [m, world]
    float floor = 0;        // height of the soles [m, world]
    float top = 0;          // of the head with its hair [m, world]
    float head = 0;         // heights of joints [m, world]; that of the neck without a head
    float shoulders = 0;
    float hips = 0;
    float knees = 0;
    float shoulder_width = 0;  // from upper arm to upper arm [m]
    float upper_arm = 0;       // lengths [m]
    float forearm = 0;
    float hand = 0;                // to the tip of the middle finger
    float head_side = 0;           // how far the head reaches from `middle` to either side [m]
    float head_front = 0;          // how far it reaches forward from there [m]
    std::optional<Bounds> room{};  // all that it ever fills, where that is known [m, world]
};

// From the joints of the humanoid map and the vertices; a part that the map lacks is guessed from the
// figure's height and the proportions of an adult. Of a rest pose that sits, as if it stood there.
FigureMeasures measure_figure(const Avatar& avatar);

enum class Framing {
    upper,  // from the middle of the thighs to above the head, with room for the elbows and for hands in
            // front
    full,   // from the floor to the reach of raised arms
    head,   // head and shoulders
    box,    // all that the figure ever fills; without FigureMeasures::room as `full`
};

// The corners of the room that a framing keeps in the picture [m, world].
std::array<Vec3, 8> room_of(const FigureMeasures& figure, Framing framing);

// The same figure where a scene puts it, on a floor at height 0.
FigureMeasures placed(FigureMeasures figure, const Placement& place);

struct Shot {
    Framing framing = Framing::upper;
    float fov_y = 0.42f;  // [rad]
    float yaw = 0;        // round the figures, to the left of who faces the camera [rad]; 0: in front of them
    float pitch = 0;      // looking down [rad]
    float zoom = 1;       // above 1: closer
};

// The nearest camera that holds the rooms of all `figures`, at least one, seen from `front`, a unit, level direction,
// with a margin of 4 % of the picture on each side at zoom 1.
Camera frame_figures(std::span<const FigureMeasures> figures, const Vec3& front, const Shot& shot,
                     RenderSize size);

}  // namespace chironomia
