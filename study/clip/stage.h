// The picture of a clip: whom each part of it shows, and how it is drawn.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/render/renderer.h"
#include "scenes/scene_file.h"
#include "study/clip/performance.h"

namespace chironomia::study {

// A view with its figures in their places, ready to be drawn.
struct StagedView {
    View view;
    std::vector<Transform> places;  // world_from_figure, one for each figure; empty: it stands as it is
    std::unique_ptr<Renderer> renderer;
};

struct Stage {
    std::vector<StagedView> views;
    RenderSize size;
    double motion_blur = 0;               // as Drawing::motion_blur
    Vec3 gap_colour{0};                   // between the views, linear rgb
    std::vector<std::string> blurs = {};  // how the face of each of the people is blurred; empty: it is not
};

// Stages `people` in the scene of `job`. Throws Error as stage_scene.
Stage make_stage(std::span<const Performance> people, const ClipJob& job);

// In how many of the frames that are shown something of one of `people` is not in the picture, as parts_outside.h says.
struct FramesOutside {
    std::size_t figure = 0;   // the head or its top, or the middle of what is no person
    std::size_t hands = 0;    // a hand
    std::size_t feet = 0;     // a foot
    std::size_t of = 0;       // frames that are shown
    bool shows_feet = false;  // the scene shows whole people
};

FramesOutside frames_outside(const Stage& stage, std::span<const Performance> people, std::size_t person,
                             const FrameRange& shown = {});

// Where the cue of one of `people` belongs: under them, near the lower edge of the picture [px].
Vec2 cue_place(const Stage& stage, std::span<const Performance> people, std::size_t person);

// What a view sees while the shutter is open: its mesh at even distances in time.
using Exposure = std::vector<PosedMesh>;

// What each view sees at a frame of the clip.
std::vector<Exposure> expose_all(const Stage& stage, std::span<const Performance> people, std::size_t frame);

// How many calls of draw() may be under way at the same time; one alone must be made by the thread that made the stage.
std::size_t frames_at_once(const Stage& stage);

// `exposures` as expose_all gives them.
Frame draw(const Stage& stage, std::span<const Exposure> exposures);

}  // namespace chironomia::study
