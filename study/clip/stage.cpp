#include "study/clip/stage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/render/camera.h"
#include "core/text.h"
#include "raster/embree/ray_renderer.h"
#include "raster/gl/gl_renderer.h"
#include "raster/studio/face_blur.h"
#include "raster/studio/srgb.h"
#include "raster/tiles/tile_renderer.h"
#include "scenes/figures.h"
#include "skinning/skin.h"
#include "study/clip/own_animation.h"
#include "study/clip/parts_outside.h"

namespace chironomia::study {
namespace {

// Two pictures beside each other share the width.
void require_halves(const ClipJob& job) {
    const int people = static_cast<int>(job.performers.size());
    if (job.size.width % (2 * people) == 0) return;
    throw Error(format("{}: {} pixels do not divide among {} people; choose a width that is a multiple of {}",
                       job.out.string(), job.size.width, people, 2 * people));
}

Staging staging_of(std::span<const Avatar* const> avatars, std::span<const Bounds> rooms,
                   const ClipJob& job) {
    if (!job.beside) return stage_scene(job.scene.string(), avatars, job.size, rooms);
    require_halves(job);
    return stage_beside(job.scene.string(), avatars, job.size);
}

std::unique_ptr<Renderer> make_renderer(const Avatar& avatar, const View& view, const ClipJob& job) {
    if (job.drawing.renderer == RendererKind::rays) {
        return make_ray_renderer(avatar, view.scene, view.size,
                                 {.samples = job.drawing.samples, .threads = job.threads});
    }
    if (job.drawing.renderer == RendererKind::gl)
        return make_gl_renderer(avatar, view.scene, view.size, {.backend = job.gl, .threads = job.threads});
    return make_tile_renderer(avatar, view.scene, view.size, {.threads = job.threads});
}

// Hair that is cut out hides nothing of a face for sure.
bool hides_what_is_behind(const Avatar& avatar, const Surface& surface) {
    return surface.material < 0 ||
           avatar.materials[static_cast<std::size_t>(surface.material)].alpha_mode == AlphaMode::opaque;
}

// The region of one of several figures that are joined, `before` being the surfaces of those that come first.
// Another person before the face stays sharp, as the arms of its owner do.
FaceRegion placed(FaceRegion face, const Transform& world_from_figure, std::size_t before,
                  const Avatar& joined) {
    const Mat4 place = to_matrix(world_from_figure);
    for (Vec3* point : {&face.eyes, &face.mouth, &face.chin, &face.middle})
        *point = Vec3(place * Vec4(*point, 1));
    std::vector<std::vector<FacePart>> parts;
    for (const Surface& surface : joined.surfaces) {
        parts.emplace_back(surface.positions.size(),
                           hides_what_is_behind(joined, surface) ? FacePart::arm : FacePart::other);
    }
    for (std::size_t s = 0; s < face.parts.size(); ++s) parts[before + s] = std::move(face.parts[s]);
    face.parts = std::move(parts);
    return face;
}

// Wraps the renderer of a view once for each of its people whose face or mouth is blurred.
void blur_faces_of(StagedView& staged, Stage& stage, std::span<const Performance> people,
                   const Avatar& shown) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < staged.view.figures.size(); ++i) {
        const std::size_t person = staged.view.figures[i];
        const Performance& performance = people[person];
        if (performance.blurred) {
            const FacePart part = performance.blurred->part;
            const Transform place = staged.places.empty() ? Transform() : staged.places[i];
            const FaceBlurSpec spec{.face = placed(performance.blurred->face, place, before, shown),
                                    .part = part,
                                    .sigma = part == FacePart::face ? kFaceSigma : kMouthSigma};
            FaceBlur blur(shown, spec, staged.view.scene.camera, staged.view.size);
            stage.blurs[person] = format("a sigma of {:.2f} of the height of the face, {:.1f} pixels",
                                         spec.sigma, blur.sigma());
            staged.renderer = blur_faces(std::move(staged.renderer), std::move(blur));
        }
        before += performance.avatar.surfaces.size();
    }
}

// What is no person is drawn as large as one, for which the distances in the renderers are meant, and in the
// middle: the picture is the same.
Transform drawn_from_world(const Bounds& room) {
    constexpr float kPerson = 1.8f;  // from end to end [m]
    const float largest = distance(room.low, room.high);
    const float scale = largest > 0 ? kPerson / largest : 1;
    return {.translation = -scale * 0.5f * (room.low + room.high), .scale = Vec3(scale)};
}

Scene drawn(Scene scene, const Transform& from_world) {
    const Mat4 matrix = to_matrix(from_world);
    const float scale = from_world.scale.x;
    scene.camera.eye = Vec3(matrix * Vec4(scene.camera.eye, 1));
    scene.camera.target = Vec3(matrix * Vec4(scene.camera.target, 1));
    scene.camera.near *= scale;
    scene.camera.far *= scale;
    scene.floor_height = scale * scene.floor_height + from_world.translation.y;
    scene.floor_reach *= scale;
    return scene;
}

Transform drawn(Transform world_from_figure, const Transform& from_world) {
    const Mat4 matrix = to_matrix(from_world);
    world_from_figure.translation = Vec3(matrix * Vec4(world_from_figure.translation, 1));
    world_from_figure.scale *= from_world.scale;
    return world_from_figure;
}

// Figures that a scene puts somewhere or that are drawn in another size are joined into one; a person who
// stands as they are needs no joining.
StagedView staged(View view, std::span<const Performance> people, const ClipJob& job, Stage& stage) {
    StagedView result{.view = std::move(view), .places = {}, .renderer = nullptr};
    Scene& scene = result.view.scene;
    const std::vector<Bounds>& boxes = people[result.view.figures.front()].boxes;
    if (scene.places.empty() && boxes.empty()) {
        const Avatar& alone = people[result.view.figures.front()].avatar;
        result.renderer = make_renderer(alone, result.view, job);
        blur_faces_of(result, stage, people, alone);
        return result;
    }
    std::vector<const Avatar*> avatars;
    for (std::size_t i = 0; i < result.view.figures.size(); ++i) {
        avatars.push_back(&people[result.view.figures[i]].avatar);
        result.places.push_back(scene.places.empty()
                                    ? Transform()
                                    : world_from_figure(measure_figure(*avatars.back()), scene.places[i]));
    }
    if (!boxes.empty()) {
        const Transform to_draw = drawn_from_world(around(boxes));
        for (Transform& place : result.places) place = drawn(place, to_draw);
        scene = drawn(scene, to_draw);
    }
    const Avatar together = join_figures(avatars, result.places);
    result.renderer = make_renderer(together, result.view, job);
    blur_faces_of(result, stage, people, together);
    return result;
}

// Four straight pieces are a smooth bow even for a hand at full speed.
constexpr int kMomentsOfBlur = 5;

PosedMesh skin_view(const StagedView& staged, std::span<const Performance> people, double frame) {
    std::vector<PosedMesh> meshes;
    for (const std::size_t person : staged.view.figures) {
        meshes.push_back(skin(people[person].avatar, people[person].pose_at(frame)));
    }
    if (staged.places.empty()) return std::move(meshes.front());
    return join_meshes(meshes, staged.places);
}

Exposure expose(const StagedView& staged, std::span<const Performance> people, std::size_t frame,
                double motion_blur) {
    const auto middle = static_cast<double>(frame);
    if (motion_blur == 0) return {skin_view(staged, people, middle)};
    Exposure exposure;
    for (int i = 0; i < kMomentsOfBlur; ++i) {
        const double moment = motion_blur * (static_cast<double>(i) / (kMomentsOfBlur - 1) - 0.5);
        exposure.push_back(skin_view(staged, people, middle + moment));
    }
    return exposure;
}

Frame filled(RenderSize size, const Vec3& colour) {
    const SrgbTables& tables = SrgbTables::get();
    Frame frame{.width = size.width, .height = size.height, .rgba = {}};
    frame.rgba.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 4);
    for (int pixel = 0; pixel < size.width * size.height; ++pixel) {
        for (int i = 0; i < 3; ++i) frame.rgba.push_back(tables.rounded(colour[i]));
        frame.rgba.push_back(255);
    }
    return frame;
}

void put(Frame& frame, const Frame& part, int left) {
    for (int y = 0; y < part.height; ++y) {
        const auto row = part.rgba.begin() + static_cast<std::ptrdiff_t>(y) * part.width * 4;
        const auto place = (static_cast<std::ptrdiff_t>(y) * frame.width + left) * 4;
        std::copy(row, row + part.width * 4, frame.rgba.begin() + place);
    }
}

// Where somebody is seen.
struct Sighting {
    const StagedView& staged;
    Transform world_from_figure;
};

Sighting find_person(const Stage& stage, std::size_t person) {
    for (const StagedView& staged : stage.views) {
        const auto& figures = staged.view.figures;
        const auto found = std::find(figures.begin(), figures.end(), person);
        if (found == figures.end()) continue;
        const auto index = static_cast<std::size_t>(found - figures.begin());
        return {.staged = staged,
                .world_from_figure = staged.places.empty() ? Transform() : staged.places[index]};
    }
    assert(false && "everybody is in a view");
    return {.staged = stage.views.front(), .world_from_figure = {}};
}

// Whether the middle of the picture shows a place in the box, as it does where a scene shows a part of a model.
bool shows_part_of(const Bounds& box, const Mat4& clip) {
    Vec2 low(std::numeric_limits<float>::max()), high(-low);
    for (int corner = 0; corner < 8; ++corner) {
        const auto side = [&](int axis) {
            return (corner >> axis & 1) != 0 ? box.high[axis] : box.low[axis];
        };
        const Vec4 place = clip * Vec4(side(0), side(1), side(2), 1);
        if (place.w <= 0) continue;
        low = glm::min(low, Vec2(place) / place.w);
        high = glm::max(high, Vec2(place) / place.w);
    }
    return low.x < 0 && low.y < 0 && high.x > 0 && high.y > 0;
}

// Of what is no person the middle counts, unless a part of it fills the picture. After its animation the last box is
// held.
FramesOutside boxes_outside(std::span<const Bounds> boxes, const Mat4& clip, std::size_t first,
                            std::size_t frames) {
    FramesOutside outside{.of = frames};
    for (std::size_t t = first; t < first + frames; ++t) {
        const Bounds& box = boxes[std::min(t, boxes.size() - 1)];
        const Vec4 place = clip * Vec4((box.low + box.high) * 0.5f, 1);
        const bool is_outside = place.w <= 0 || std::abs(place.x) > place.w || std::abs(place.y) > place.w;
        outside.figure += is_outside && !shows_part_of(box, clip);
    }
    return outside;
}

}  // namespace

Stage make_stage(std::span<const Performance> people, const ClipJob& job) {
    std::vector<const Avatar*> avatars;
    std::vector<Bounds> rooms;
    for (const Performance& performance : people) {
        avatars.push_back(&performance.avatar);
        if (!performance.boxes.empty()) rooms.push_back(around(performance.boxes));
    }
    Staging staging = staging_of(avatars, rooms, job);
    Stage stage{.views = {},
                .size = job.size,
                .motion_blur = job.drawing.motion_blur,
                .gap_colour = staging.gap_colour};
    stage.blurs.resize(people.size());
    for (View& view : staging.views) stage.views.push_back(staged(std::move(view), people, job, stage));
    return stage;
}

FramesOutside frames_outside(const Stage& stage, std::span<const Performance> people, std::size_t person,
                             const FrameRange& shown) {
    const Sighting sighting = find_person(stage, person);
    const View& view = sighting.staged.view;
    const Mat4 clip = clip_from_world(view.scene.camera, view.size) * to_matrix(sighting.world_from_figure);
    const Performance& performance = people[person];
    const std::size_t frames = shown.last.value_or(performance.fit.poses.size()) - shown.first;
    if (!performance.boxes.empty()) return boxes_outside(performance.boxes, clip, shown.first, frames);
    const PartsOutside parts =
        find_parts_outside({.avatar = performance.avatar,
                            .pose_at = [&](std::size_t t) { return performance.pose_at(shown.first + t); },
                            .frames = frames,
                            .fps = performance.fit.fps},
                           clip);
    const auto count = [](const std::vector<bool>& outside) {
        return static_cast<std::size_t>(std::count(outside.begin(), outside.end(), true));
    };
    return {.figure = count(parts.head),
            .hands = count(parts.hands),
            .feet = count(parts.feet),
            .of = frames,
            .shows_feet = parts.shows_feet};
}

Vec2 cue_place(const Stage& stage, std::span<const Performance> people, std::size_t person) {
    const Sighting sighting = find_person(stage, person);
    const View& view = sighting.staged.view;
    const FigureMeasures figure = measure_figure(people[person].avatar);
    const Vec3 hips(figure.middle.x, figure.hips, figure.middle.z);
    const Vec3 place(to_matrix(sighting.world_from_figure) * Vec4(hips, 1));
    const Vec2 pixel = pixel_of(view.scene.camera, view.size, place);
    return {static_cast<float>(view.left) + pixel.x, 0.955f * static_cast<float>(view.size.height)};
}

std::vector<Exposure> expose_all(const Stage& stage, std::span<const Performance> people, std::size_t frame) {
    std::vector<Exposure> exposures;
    for (const StagedView& staged : stage.views) {
        exposures.push_back(expose(staged, people, frame, stage.motion_blur));
    }
    return exposures;
}

std::size_t frames_at_once(const Stage& stage) {
    int least = stage.views.front().renderer->frames_at_once();
    for (const StagedView& view : stage.views) least = std::min(least, view.renderer->frames_at_once());
    return static_cast<std::size_t>(least);
}

Frame draw(const Stage& stage, std::span<const Exposure> exposures) {
    assert(exposures.size() == stage.views.size());
    if (stage.views.size() == 1) return stage.views[0].renderer->render(exposures[0]);
    Frame frame = filled(stage.size, stage.gap_colour);
    for (std::size_t i = 0; i < exposures.size(); ++i) {
        put(frame, stage.views[i].renderer->render(exposures[i]), stage.views[i].view.left);
    }
    return frame;
}

}  // namespace chironomia::study
