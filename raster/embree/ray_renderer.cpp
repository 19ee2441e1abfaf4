#include "raster/embree/ray_renderer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/render/camera.h"
#include "core/render/srgb.h"
#include "core/text.h"
#include "raster/embree/embree.h"
#include "raster/embree/ray_figure.h"
#include "raster/embree/ray_light.h"
#include "raster/embree/ray_samples.h"
#include "raster/embree/ray_scene.h"
#include "raster/embree/ray_surface.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/figure_light.h"
#include "raster/studio/rectangle.h"
#include "raster/studio/shading.h"
#include "raster/studio/share_work.h"
#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

constexpr int kTile = 16;              // side of the square that a thread takes [px]
constexpr int kAcross = 4, kDown = 2;  // the pixels whose rays are followed together
static_assert(kAcross * kDown == kLanes);
constexpr int kMostLayers = 32;  // of translucent surfaces, one behind the other
constexpr int kMostOcclusionRays = 16;
constexpr float kSolid = 0.998f;  // alpha above which nothing behind would be seen

// Which pattern of a pixel a pair of numbers comes from.
enum class CameraUse : std::uint32_t { place = 1, moment = 2 };

void require_within(const char* what, int value, int least, int most) {
    if (value >= least && value <= most) return;
    throw Error(format("ray tracer: {} {} were asked for, {} to {} can be done", value, what, least, most));
}

void require_possible(RenderSize size, const RayOptions& options) {
    require_drawable(size);
    require_within("samples a pixel", options.samples, 1, kMostRaySamples);
    require_within("occlusion rays a sample", options.occlusion_rays, 0, kMostOcclusionRays);
}

// Few samples need more rays each, or the shade between fingers is noise.
int occlusion_rays_of(const RayOptions& options) {
    if (options.occlusion_rays > 0) return options.occlusion_rays;
    return options.samples <= 4 ? 4 : options.samples <= 16 ? 2 : 1;
}

Bounds bounds_of(const RayFigure& figure) {
    Bounds box{.low = Vec3(1e9f), .high = Vec3(-1e9f)};
    for (const RayMoment& moment : figure.moments) {
        for (size_t i = 0; i + 1 < moment.positions.size(); ++i) box.grow(moment.positions[i]);
    }
    return box;
}

// Where on the floor a shadow may lie: x and z of its corners [m].
struct FloorArea {
    Vec2 low{1};
    Vec2 high{-1};
};

FloorArea floor_area_of(const Bounds& box, const Scene& scene) {
    constexpr float kAround = 0.5f;  // of the shade under what hides the sky [m]
    FloorArea area{Vec2(box.low.x, box.low.z) - kAround, Vec2(box.high.x, box.high.z) + kAround};
    const float height = std::max(0.0f, box.high.y - scene.floor_height);
    for (const Light& light : scene.lights) {
        if (!light.casts_shadow || light.towards.y <= 0.05f) continue;
        // The flattest ray to the disc of the light goes furthest.
        const float elevation = std::asin(std::min(1.0f, light.towards.y));
        const float flattest = std::max(0.01f, elevation - light.angle);
        const Vec2 level(light.towards.x, light.towards.z);
        const Vec2 away = -level / std::max(1e-6f, length(level)) * (height / std::tan(flattest));
        const float wide = height * std::tan(light.angle) / (std::sin(elevation) * std::sin(flattest));
        area.low = glm::min(area.low, Vec2(box.low.x, box.low.z) + glm::min(away, Vec2(0)) - wide);
        area.high = glm::max(area.high, Vec2(box.high.x, box.high.z) + glm::max(away, Vec2(0)) + wide);
    }
    return area;
}

// What the samples of a pixel have seen so far; weights count samples.
struct PixelSum {
    Vec3 lit{0};  // linear, to be tone mapped
    float lit_weight = 0;
    Vec3 shown{0};         // linear, as it is shown
    float floor_left = 0;  // of the backdrop, where nothing covers it
};

// A sample on its way through translucent surfaces, which lie over each other as the rasterizer blends them:
// in sRGB.
struct Layers {
    Vec3 srgb{0};       // multiplied by `covered`
    float covered = 0;  // by what is translucent, and what is seen through it
    float through = 1;  // of what is behind
};

// One sample of each pixel of a block.
struct BlockSample {
    RayPack rays;
    Lanes<SampleNumber> numbers;
};

Vec3 encoded(const Vec3& linear) {
    const SrgbTables& tables = SrgbTables::get();
    return Vec3(tables.level(linear.r), tables.level(linear.g), tables.level(linear.b)) / 255.0f;
}

Vec3 decoded(const Vec3& srgb) {
    const auto linear = [](float value) {
        return static_cast<float>(linear_from_srgb(std::clamp(value, 0.0f, 1.0f)));
    };
    return {linear(srgb.r), linear(srgb.g), linear(srgb.b)};
}

bool holds(const FloorArea& area, const Vec3& place) {
    return place.x >= area.low.x && place.z >= area.low.y && place.x <= area.high.x && place.z <= area.high.y;
}

// A sample that ends at a surface which nothing shines through.
void add_solid(PixelSum& sum, const SurfacePoint& surface, const Vec3& colour) {
    if (surface.unlit) {
        sum.shown += glm::clamp(Vec3(surface.base), 0.0f, 1.0f);
    } else {
        sum.lit += colour;
        sum.lit_weight += 1;
    }
}

class RayRenderer : public Renderer {
  public:
    RayRenderer(const Avatar& avatar, const Scene& scene, RenderSize size, const RayOptions& options)
        : scene_(scene),
          size_(size),
          options_(options),
          rays_(pixel_rays(scene.camera, size)),
          backdrop_(draw_backdrop(scene, size)),
          figure_(avatar),
          log2_width_at_1_(std::log2(length(rays_.right)) -
                           0.5f * std::log2(static_cast<float>(options.samples))),
          embree_(figure_),
          light_(embree_, scene, options.samples, occlusion_rays_of(options)),
          pattern_(static_cast<std::uint32_t>(options.samples)),
          columns_((size.width + kTile - 1) / kTile),
          rows_((size.height + kTile - 1) / kTile),
          touched_(static_cast<size_t>(columns_ * rows_)) {}

    Frame render(std::span<const PosedMesh> exposure) override;

  private:
    using Block = Lanes<PixelSum>;

    void find_figure();
    void draw_tile(Frame& frame, const Rectangle& tile) const;
    void draw_block(Frame& frame, int x, int y) const;
    void add_sample(Block& block, const BlockSample& first) const;
    LaneMask add_layer(Block& block, Lanes<Layers>& layers, BlockSample& sample, const HitPack& found) const;
    void add_emptiness(Block& block, const BlockSample& sample, const Lanes<float>& empty) const;
    Vec3 direction_at(const Vec2& pixel) const {
        return rays_.corner + pixel.x * rays_.right + pixel.y * rays_.down;
    }
    bool may_see_shadow(const Rectangle& tile) const;
    void put(std::uint8_t* pixel, const PixelSum& sum) const;

    Scene scene_;
    RenderSize size_;
    RayOptions options_;
    PixelRays rays_;
    Frame backdrop_;
    RayFigure figure_;
    float log2_width_at_1_;
    RayScene embree_;
    RayLight light_;
    SamplePattern pattern_;
    int columns_ = 0, rows_ = 0;  // of tiles
    std::vector<bool> touched_;   // (rows, columns) by the figure, maybe
    FloorArea shadow_area_;
};

Frame RayRenderer::render(std::span<const PosedMesh> exposure) {
    assert(!exposure.empty());
    figure_.move_to(exposure);
    embree_.follow_figure();
    const Bounds box = bounds_of(figure_);
    find_figure();
    shadow_area_ = floor_area_of(box, scene_);

    Frame frame = backdrop_;
    share_work(columns_ * rows_, options_.threads, [&](int tile) {
        const Rectangle whole{0, 0, size_.width, size_.height};
        const Rectangle square{tile % columns_ * kTile, tile / columns_ * kTile, kTile, kTile};
        const Rectangle pixels = intersection(whole, square);
        // Most of a picture is backdrop.
        if (touched_[static_cast<size_t>(tile)] || may_see_shadow(pixels)) draw_tile(frame, pixels);
    });
    return frame;
}

// Which tiles a triangle may touch at any moment of the exposure. Between two moments it stays in the rectangle around
// both.
void RayRenderer::find_figure() {
    std::fill(touched_.begin(), touched_.end(), false);
    const Mat4 clip = clip_from_world(scene_.camera, size_);
    std::vector<Rectangle> places;  // of each vertex, over all moments: the tiles from its first to its last
    const size_t count = figure_.moments.front().positions.size();
    for (size_t v = 0; v < count; ++v) {
        Vec2 low(1e6f), high(-1e6f);
        for (const RayMoment& moment : figure_.moments) {
            const Vec4 seen = clip * Vec4(moment.positions[v], 1);
            const bool before_eye = seen.w >= scene_.camera.near;
            const Vec2 pixel =
                (Vec2(seen.x, -seen.y) / seen.w + 1.0f) * 0.5f * Vec2(size_.width, size_.height);
            low = before_eye ? glm::min(low, pixel) : Vec2(-1e6f);
            high = before_eye ? glm::max(high, pixel) : Vec2(1e6f);
        }
        const auto tile = [](float place) {
            return static_cast<int>(std::floor(std::clamp(place, -1e5f, 1e5f) / kTile));
        };
        const int x = tile(low.x - 1), y = tile(low.y - 1);
        places.push_back({x, y, tile(high.x + 1) - x + 1, tile(high.y + 1) - y + 1});
    }
    const Rectangle whole{0, 0, columns_, rows_};
    for (size_t i = 0; i + 2 < figure_.triangles.size(); i += 3) {
        const std::uint32_t* corners = figure_.triangles.data() + i;
        const Rectangle all =
            enclosing(places[corners[0]], enclosing(places[corners[1]], places[corners[2]]));
        const Rectangle tiles = intersection(whole, all);
        for (int y = tiles.y; y < tiles.y + tiles.height; ++y)
            for (int x = tiles.x; x < tiles.x + tiles.width; ++x)
                touched_[static_cast<size_t>(y * columns_ + x)] = true;
    }
}

// Whether rays through the tile may meet the floor where a shadow may lie.
bool RayRenderer::may_see_shadow(const Rectangle& tile) const {
    if (!scene_.floor || rays_.eye.y <= scene_.floor_height) return false;
    constexpr float kEverywhere = 1e9f;
    Vec2 low(kEverywhere), high(-kEverywhere);
    bool sees_floor = false;
    for (const int x : {tile.x - 1, tile.x + tile.width}) {
        for (const int y : {tile.y - 1, tile.y + tile.height}) {
            const Vec3 direction = direction_at({x, y});
            if (direction.y >= 0) {
                low = Vec2(-kEverywhere);  // the horizon lies in the tile, or below it
                high = Vec2(kEverywhere);
                continue;
            }
            sees_floor = true;
            const Vec3 place = rays_.eye + direction * ((scene_.floor_height - rays_.eye.y) / direction.y);
            low = glm::min(low, Vec2(place.x, place.z));
            high = glm::max(high, Vec2(place.x, place.z));
        }
    }
    return sees_floor && glm::all(glm::lessThanEqual(low, shadow_area_.high)) &&
           glm::all(glm::greaterThanEqual(high, shadow_area_.low));
}

void RayRenderer::draw_tile(Frame& frame, const Rectangle& tile) const {
    for (int y = tile.y; y < tile.y + tile.height; y += kDown) {
        for (int x = tile.x; x < tile.x + tile.width; x += kAcross) draw_block(frame, x, y);
    }
}

void RayRenderer::draw_block(Frame& frame, int x, int y) const {
    Block block{};
    BlockSample sample;
    Lanes<Vec2> pixels;
    for (int lane = 0; lane < kLanes; ++lane) {
        const int column = x + lane % kAcross, row = y + lane / kAcross;
        if (column < size_.width && row < size_.height) sample.rays.active |= 1u << lane;
        const auto i = static_cast<size_t>(lane);
        pixels[i] = {column, row};
        sample.numbers[i].pixel = mixed(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    }
    const bool moves = figure_.moments.size() > 1;
    for (int number = 0; number < options_.samples; ++number) {
        const auto pairs = [&](CameraUse use) {
            Lanes<std::uint32_t> indices, seeds;
            indices.fill(static_cast<std::uint32_t>(number));
            for (size_t i = 0; i < kLanes; ++i)
                seeds[i] = mixed(sample.numbers[i].pixel, static_cast<std::uint32_t>(use));
            return pattern_.points(indices, seeds);
        };
        const LanePlaces places = pairs(CameraUse::place);
        const Lanes<float> moments = moves ? pairs(CameraUse::moment).x : Lanes<float>{};
        for (size_t i = 0; i < kLanes; ++i) {
            sample.numbers[i].index = static_cast<std::uint32_t>(number);
            sample.rays.rays[i] = {
                .origin = rays_.eye,
                .direction = direction_at(pixels[i] + Vec2(places.x[i], places.y[i]) - 0.5f),
                .near = scene_.camera.near,
                .far = scene_.camera.far,
                .moment = moments[i]};
        }
        add_sample(block, sample);
    }
    for (size_t i = 0; i < kLanes; ++i) {
        if (!has(sample.rays.active, i)) continue;
        const auto pixel = static_cast<size_t>(pixels[i].y) * static_cast<size_t>(size_.width) +
                           static_cast<size_t>(pixels[i].x);
        put(frame.rgba.data() + 4 * pixel, block[i]);
    }
}

// Follows one sample of each pixel through all that is translucent.
void RayRenderer::add_sample(Block& block, const BlockSample& first) const {
    BlockSample sample = first;
    Lanes<Layers> layers;
    for (int layer = 0; layer < kMostLayers && sample.rays.active != 0; ++layer) {
        const HitPack found = embree_.nearest(sample.rays);
        if (found.hit == 0) break;
        sample.rays.active = add_layer(block, layers, sample, found);
    }
    Lanes<float> empty{};
    for (size_t i = 0; i < kLanes; ++i) {
        if (!has(first.rays.active, i)) continue;
        empty[i] = layers[i].through;
        if (layers[i].covered == 0) continue;
        block[i].shown += layers[i].covered * decoded(layers[i].srgb / layers[i].covered);
    }
    add_emptiness(block, first, empty);
}

// Adds what the rays have met, and moves those that go on behind it. Returns these.
LaneMask RayRenderer::add_layer(Block& block, Lanes<Layers>& layers, BlockSample& sample,
                                const HitPack& found) const {
    Lanes<LitPoint> points;
    LaneMask lit = 0;
    for (size_t i = 0; i < kLanes; ++i) {
        if (!has(found.hit, i)) continue;
        const Ray& ray = sample.rays.rays[i];
        const float log2_width = log2_width_at_1_ + std::log2(std::max(found.hits[i].distance, 1e-6f));
        points[i] = {.surface = surface_point(figure_, ray, found.hits[i], log2_width),
                     .towards_eye = -normalize(ray.direction),
                     .moment = ray.moment,
                     .sample = sample.numbers[i]};
        if (!points[i].surface.unlit) lit |= 1u << i;
    }
    const auto colours = light_.seen(points, lit);
    LaneMask go_on = 0;
    for (size_t i = 0; i < kLanes; ++i) {
        if (!has(found.hit, i)) continue;
        const SurfacePoint& surface = points[i].surface;
        if (surface.alpha >= kSolid && layers[i].covered == 0) {
            add_solid(block[i], surface, colours[i]);
            layers[i].through = 0;
            continue;
        }
        const float alpha = surface.alpha >= kSolid ? 1 : surface.alpha;
        const Vec3 shown = surface.unlit ? Vec3(surface.base) : shading::neutral_tone(colours[i]);
        layers[i].srgb += layers[i].through * alpha * encoded(shown);
        layers[i].covered += layers[i].through * alpha;
        layers[i].through *= 1 - alpha;
        if (layers[i].through == 0) continue;
        go_on |= 1u << i;
        sample.rays.rays[i].near = found.hits[i].distance * (1 + 1e-6f) + 1e-5f;
    }
    return go_on;
}

// The floor's shadow where a sample meets the floor, and the backdrop as it is elsewhere.
void RayRenderer::add_emptiness(Block& block, const BlockSample& sample, const Lanes<float>& empty) const {
    Lanes<FloorPoint> points;
    LaneMask in_shadow = 0;
    const float drop = scene_.floor_height - rays_.eye.y;
    for (size_t i = 0; i < kLanes; ++i) {
        const Ray& ray = sample.rays.rays[i];
        const Vec3& direction = ray.direction;
        if (empty[i] == 0 || !scene_.floor || direction.y >= 0 || drop >= 0) continue;
        const Vec3 place = rays_.eye + direction * (drop / direction.y);
        if (!holds(shadow_area_, place)) continue;
        points[i] = {.position = place, .moment = ray.moment, .sample = sample.numbers[i]};
        in_shadow |= 1u << i;
    }
    Lanes<float> left;
    left.fill(1);
    if (in_shadow != 0) left = light_.floor_light_share(points, in_shadow);
    for (size_t i = 0; i < kLanes; ++i) block[i].floor_left += empty[i] * left[i];
}

void RayRenderer::put(std::uint8_t* pixel, const PixelSum& sum) const {
    const auto samples = static_cast<float>(options_.samples);
    if (sum.floor_left == samples) return;  // the backdrop as it is
    const SrgbTables& tables = SrgbTables::get();
    Vec3 colour = sum.shown;
    if (sum.lit_weight > 0) colour += sum.lit_weight * shading::neutral_tone(sum.lit / sum.lit_weight);
    for (int i = 0; i < 3; ++i) {
        colour[i] += sum.floor_left * tables.linear(pixel[i]);
        pixel[i] = tables.rounded(colour[i] / samples);
    }
}

}  // namespace

std::unique_ptr<Renderer> make_ray_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                            const RayOptions& options) {
    require_possible(size, options);
    return std::make_unique<RayRenderer>(avatar, scene, size, options);
}

std::string embree_version() {
    return RTC_VERSION_STRING;
}

}  // namespace chironomia
