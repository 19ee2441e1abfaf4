#include "raster/studio/face_blur.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "core/body/rest.h"
#include "core/error.h"
#include "core/render/camera.h"
#include "core/smooth_step.h"
#include "core/text.h"
#include "raster/studio/gaussian.h"
#include "raster/studio/rectangle.h"
#include "raster/studio/srgb.h"

namespace chironomia {
namespace {

// The soft edge, of the sigma of the blur; and how much of what is seen around a pixel must be region for it
// to be blurred whole.
constexpr float kEdgeSigma = 0.5f;
constexpr float kWhole = 0.25f;
constexpr float kNone = 0.01f;      // and how much for it to be blurred at all
constexpr float kEdgeReach = 2.4f;  // how far off that can still be, in sigmas of the edge

// A Gaussian needs no more samples a sigma.
constexpr float kSamplesPerSigma = 3;
constexpr int kCoarsest = 24;  // [px]
constexpr int kLooks = 2;      // at what is seen, across one sample

struct Triangle {
    std::array<std::uint32_t, 3> corners{};
    FacePart part = FacePart::other;  // arm, or one that is blurred, or other
};

// What of a surface may be seen before or in the region.
struct Solid {
    std::vector<Triangle> triangles;
    bool double_sided = false;
};

// A vertex in the picture.
struct Seen {
    float x = 0;  // [px]
    float y = 0;
    float nearness = 0;  // 1 / distance along the view [1/m]; 0: not in front of the camera
};

// What a look at the picture meets first.
struct Look {
    float nearness = 0;
    FacePart part = FacePart::other;
};

bool is_all(const std::vector<FacePart>& parts, const Triangle& triangle, FacePart least) {
    return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                       [&](std::uint32_t corner) { return parts[corner] >= least; });
}

FacePart part_of(const std::vector<FacePart>& parts, const Triangle& triangle, FacePart blurred) {
    if (is_all(parts, triangle, blurred)) return blurred;
    for (const std::uint32_t corner : triangle.corners) {
        if (parts[corner] != FacePart::arm) return FacePart::other;
    }
    return FacePart::arm;
}

// Cut-out hair and lace hide nothing of a face for sure; all else of a surface hides what is behind it.
Solid solid_of(const Avatar& avatar, size_t index, const std::vector<FacePart>& parts, FacePart blurred) {
    const Surface& surface = avatar.surfaces[index];
    const Material material =
        surface.material >= 0 ? avatar.materials[static_cast<size_t>(surface.material)] : Material{};
    Solid solid{.triangles = {}, .double_sided = material.double_sided};
    for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        Triangle triangle{
            .corners = {surface.triangles[i], surface.triangles[i + 1], surface.triangles[i + 2]}};
        triangle.part = part_of(parts, triangle, blurred);
        if (triangle.part != FacePart::other || material.alpha_mode == AlphaMode::opaque)
            solid.triangles.push_back(triangle);
    }
    return solid;
}

// A grid of looks over a part of the picture, `step` pixels apart.
struct LookOut {
    Rectangle area;
    int step = 1;
    Grid<Look> looks;

    LookOut(const Rectangle& over, int apart)
        : area(over),
          step(apart),
          looks((over.width + apart - 1) / apart, (over.height + apart - 1) / apart) {}

    // In looks: the first lies at 0.
    Seen at(const Seen& seen) const {
        const auto across = static_cast<float>(step);
        return {(seen.x - static_cast<float>(area.x)) / across - 0.5f,
                (seen.y - static_cast<float>(area.y)) / across - 0.5f, seen.nearness};
    }
};

// The looks that a triangle may meet; none where it is turned away.
struct Span2 {
    int x0, x1, y0, y1;
};

Span2 span_of(const LookOut& out, const Seen& a, const Seen& b, const Seen& c) {
    const auto last_x = static_cast<float>(out.looks.width - 1);
    const auto last_y = static_cast<float>(out.looks.height - 1);
    return {.x0 = static_cast<int>(std::ceil(std::max(0.0f, std::min({a.x, b.x, c.x})))),
            .x1 = static_cast<int>(std::floor(std::min(last_x, std::max({a.x, b.x, c.x})))),
            .y0 = static_cast<int>(std::ceil(std::max(0.0f, std::min({a.y, b.y, c.y})))),
            .y1 = static_cast<int>(std::floor(std::min(last_y, std::max({a.y, b.y, c.y}))))};
}

void draw(LookOut& out, const std::array<Seen, 3>& corners, FacePart part, bool double_sided) {
    const Seen a = out.at(corners[0]), b = out.at(corners[1]), c = out.at(corners[2]);
    const Span2 span = span_of(out, a, b, c);
    if (span.x0 > span.x1 || span.y0 > span.y1) return;
    // Counter-clockwise outside, and y points down here.
    const float twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(twice_area) < 1e-9f || (twice_area > 0 && !double_sided)) return;
    const float scale = 1 / twice_area;
    for (int y = span.y0; y <= span.y1; ++y) {
        Look* row = out.looks.row(y);
        const float down = static_cast<float>(y) - a.y;
        for (int x = span.x0; x <= span.x1; ++x) {
            const float along = static_cast<float>(x) - a.x;
            const float weight_b = (along * (c.y - a.y) - down * (c.x - a.x)) * scale;
            const float weight_c = (down * (b.x - a.x) - along * (b.y - a.y)) * scale;
            if (weight_b < -1e-4f || weight_c < -1e-4f || weight_b + weight_c > 1.0001f) continue;
            const float nearness =
                a.nearness + weight_b * (b.nearness - a.nearness) + weight_c * (c.nearness - a.nearness);
            if (nearness > row[x].nearness) row[x] = {.nearness = nearness, .part = part};
        }
    }
}

std::vector<Seen> project(const std::vector<Vec3>& positions, const Mat4& clip, RenderSize size,
                          float closest) {
    const float half_width = 0.5f * static_cast<float>(size.width);
    const float half_height = 0.5f * static_cast<float>(size.height);
    std::vector<Seen> all(positions.size());
    for (size_t i = 0; i < all.size(); ++i) {
        const Vec4 place = clip * Vec4(positions[i], 1);
        if (place.w < closest) continue;
        const float nearness = 1 / place.w;
        all[i] = {.x = half_width + half_width * place.x * nearness,
                  .y = half_height - half_height * place.y * nearness,
                  .nearness = nearness};
    }
    return all;
}

Rectangle widened(const Rectangle& area, int by, RenderSize size) {
    return intersection({area.x - by, area.y - by, area.width + 2 * by, area.height + 2 * by},
                        {0, 0, size.width, size.height});
}

// Grown to whole samples, which begin at the corner of the picture so that they stay where they are from
// frame to frame.
Rectangle in_samples(const Rectangle& area, int sample, RenderSize size) {
    const int left = area.x / sample * sample, top = area.y / sample * sample;
    const int right = std::min((area.x + area.width + sample - 1) / sample * sample, size.width);
    const int bottom = std::min((area.y + area.height + sample - 1) / sample * sample, size.height);
    return {left, top, right - left, bottom - top};
}

// Values between the samples of a grid that begins at `area`.
struct Between {
    int first = 0;
    int second = 0;
    float part = 0;  // of the second
};

Between between(int pixel, int sample, int count) {
    const float place = (static_cast<float>(pixel) + 0.5f) / static_cast<float>(sample) - 0.5f;
    const float floored = std::floor(place);
    const int first = static_cast<int>(floored);
    return {.first = std::clamp(first, 0, count - 1),
            .second = std::clamp(first + 1, 0, count - 1),
            .part = place - floored};
}

template <typename Value>
Value mixed(const Value& a, const Value& b, float part) {
    return a + (b - a) * part;
}

// A sample this wide keeps enough of them to a sigma.
int sample_for(float sigma) {
    const int widest = std::clamp(static_cast<int>(sigma / kSamplesPerSigma), 1, kCoarsest);
    return widest < kLooks ? widest : widest / kLooks * kLooks;
}

// The sigma that is left to do, in samples: taking means over squares and drawing lines between them has
// blurred already.
float sigma_in_samples(float sigma, int sample) {
    const auto side = static_cast<float>(sample);
    return std::sqrt(std::max(0.01f, sigma * sigma - (side * side - 1) / 4)) / side;
}

std::array<Seen, 3> corners_of(const std::vector<Seen>& seen, const Triangle& triangle) {
    return {seen[triangle.corners[0]], seen[triangle.corners[1]], seen[triangle.corners[2]]};
}

// Whether a triangle that is nearer than `furthest` may be seen in the area.
bool may_hide(const std::array<Seen, 3>& corners, const Rectangle& area, float furthest) {
    Vec2 low(corners[0].x, corners[0].y), high = low;
    for (const Seen& corner : corners) {
        if (corner.nearness <= furthest) return false;
        low = glm::min(low, Vec2(corner.x, corner.y));
        high = glm::max(high, Vec2(corner.x, corner.y));
    }
    const Vec2 first(static_cast<float>(area.x), static_cast<float>(area.y));
    const Vec2 last = first + Vec2(static_cast<float>(area.width), static_cast<float>(area.height));
    return high.x > first.x && low.x < last.x && high.y > first.y && low.y < last.y;
}

// 1 where something was met or a pixel beside it, so that no mixed pixel at an edge is taken for face.
Grid<std::uint8_t> widened(const Grid<Look>& looks) {
    Grid<std::uint8_t> grid(looks.width, looks.height);
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            if (looks.row(y)[x].nearness == 0) continue;
            for (int j = std::max(0, y - 1); j <= std::min(grid.height - 1, y + 1); ++j) {
                for (int i = std::max(0, x - 1); i <= std::min(grid.width - 1, x + 1); ++i)
                    grid.row(j)[i] = 1;
            }
        }
    }
    return grid;
}

// What is laid over a part of the picture.
struct Layers {
    const Grid<Texel>& blurred;    // linear rgb by weight, and the weight; one value a sample
    const Grid<float>& strengths;  // one value a sample
    const Grid<std::uint8_t>& arms;
};

// The samples on the height of one row of pixels.
struct SampleRow {
    std::vector<float> strengths;
    std::vector<Texel> colours;  // linear
    std::vector<Texel> levels;   // the same in sRGB, 0 to 255
    int begin = 0;               // samples around which any pixel is blurred
    int end = 0;
};

SampleRow row_between(const Layers& layers, const Between& rows) {
    const SrgbTables& tables = SrgbTables::get();
    SampleRow row;
    for (int i = 0; i < layers.strengths.width; ++i) {
        const float strength =
            mixed(layers.strengths.row(rows.first)[i], layers.strengths.row(rows.second)[i], rows.part);
        const Texel sum =
            mixed(layers.blurred.row(rows.first)[i], layers.blurred.row(rows.second)[i], rows.part);
        const Texel colour = sum[3] > 0 ? sum / sum[3] : sum;
        row.strengths.push_back(strength);
        row.colours.push_back(colour);
        row.levels.push_back(
            Texel{tables.level(colour[0]), tables.level(colour[1]), tables.level(colour[2]), 0});
        if (strength <= 0) continue;
        if (row.end == 0) row.begin = std::max(0, i - 1);
        row.end = i + 2;
    }
    return row;
}

// Where the blur is whole it is drawn in levels, between which straight lines are straight enough.
void mix_pixel(std::uint8_t* pixel, const SampleRow& row, const Between& column) {
    const auto first = static_cast<size_t>(column.first), second = static_cast<size_t>(column.second);
    const float strength = mixed(row.strengths[first], row.strengths[second], column.part);
    if (strength >= 1) {
        const Texel level = mixed(row.levels[first], row.levels[second], column.part);
        for (int i = 0; i < 3; ++i) pixel[i] = static_cast<std::uint8_t>(level[i] + 0.5f);
    } else if (strength > 0) {
        const SrgbTables& tables = SrgbTables::get();
        const Texel colour = mixed(row.colours[first], row.colours[second], column.part);
        for (int i = 0; i < 3; ++i)
            pixel[i] = tables.rounded(mixed(tables.linear(pixel[i]), colour[i], strength));
    }
}

}  // namespace

struct FaceBlur::Parts {
    std::vector<Solid> solids;  // (S)
    Mat4 clip{1};
    float closest = 0.1f;  // [m]
    RenderSize size;
    float sigma = 1;  // [px]
    int sample = 1;   // [px]
    FacePart blurred = FacePart::face;

    std::vector<std::vector<Seen>> seen(const PosedMesh& mesh) const;
    Rectangle around_region(const std::vector<std::vector<Seen>>& seen) const;
    LookOut look(const std::vector<std::vector<Seen>>& seen, const Rectangle& area) const;
    Grid<float> strengths(const LookOut& out) const;
    Grid<std::uint8_t> arms(const std::vector<std::vector<Seen>>& seen, const Rectangle& area,
                            float furthest) const;
    Grid<Texel> means(const Frame& frame, const Rectangle& area, const Grid<std::uint8_t>& arms) const;
    void mix(Frame& frame, const Rectangle& area, const Layers& layers) const;
};

std::vector<std::vector<Seen>> FaceBlur::Parts::seen(const PosedMesh& mesh) const {
    std::vector<std::vector<Seen>> all;
    for (size_t s = 0; s < solids.size(); ++s) {
        const bool counts = !solids[s].triangles.empty();
        all.push_back(counts ? project(mesh.surfaces[s].positions, clip, size, closest)
                             : std::vector<Seen>{});
    }
    return all;
}

// All pixels of the region's triangles, seen or not.
Rectangle FaceBlur::Parts::around_region(const std::vector<std::vector<Seen>>& seen) const {
    const auto wide = static_cast<float>(size.width), high = static_cast<float>(size.height);
    Vec2 low(wide, high), most(0);
    for (size_t s = 0; s < solids.size(); ++s) {
        for (const Triangle& triangle : solids[s].triangles) {
            if (triangle.part != blurred) continue;
            for (const std::uint32_t corner : triangle.corners) {
                const Seen& place = seen[s][corner];
                if (place.nearness == 0) continue;
                low = glm::min(low, Vec2(place.x, place.y));
                most = glm::max(most, Vec2(place.x, place.y));
            }
        }
    }
    if (low.x >= most.x || low.y >= most.y) return {};
    low = glm::clamp(low, Vec2(-wide, -high), 2.0f * Vec2(wide, high));
    most = glm::clamp(most, Vec2(-wide, -high), 2.0f * Vec2(wide, high));
    const int left = static_cast<int>(std::floor(low.x)), top = static_cast<int>(std::floor(low.y));
    return {left, top, static_cast<int>(std::ceil(most.x)) - left, static_cast<int>(std::ceil(most.y)) - top};
}

LookOut FaceBlur::Parts::look(const std::vector<std::vector<Seen>>& seen, const Rectangle& area) const {
    LookOut out(area, std::max(1, sample / kLooks));
    for (size_t s = 0; s < solids.size(); ++s) {
        for (const Triangle& triangle : solids[s].triangles) {
            const std::array<Seen, 3> corners = corners_of(seen[s], triangle);
            if (corners[0].nearness > 0 && corners[1].nearness > 0 && corners[2].nearness > 0)
                draw(out, corners, triangle.part, solids[s].double_sided);
        }
    }
    return out;
}

// How much of the blurred picture each sample takes, in [0, 1].
Grid<float> FaceBlur::Parts::strengths(const LookOut& out) const {
    const int across = sample / out.step;
    Grid<float> grid((out.area.width + sample - 1) / sample, (out.area.height + sample - 1) / sample);
    for (int y = 0; y < out.looks.height; ++y) {
        for (int x = 0; x < out.looks.width; ++x) {
            if (out.looks.row(y)[x].part == blurred)
                grid.row(y / across)[x / across] += 1.0f / static_cast<float>(across * across);
        }
    }
    blur(grid, gaussian_weights(sigma_in_samples(kEdgeSigma * sigma, sample)));
    for (float& strength : grid.values) strength = smooth_step((strength - kNone) / (kWhole - kNone));
    return grid;
}

// 1 where arms pass nearer than the furthest that is seen of the region.
Grid<std::uint8_t> FaceBlur::Parts::arms(const std::vector<std::vector<Seen>>& seen, const Rectangle& area,
                                         float furthest) const {
    std::optional<LookOut> out;
    for (size_t s = 0; s < solids.size(); ++s) {
        for (const Triangle& triangle : solids[s].triangles) {
            if (triangle.part != FacePart::arm) continue;
            const std::array<Seen, 3> corners = corners_of(seen[s], triangle);
            if (!may_hide(corners, area, furthest)) continue;
            if (!out) out.emplace(area, 1);
            draw(*out, corners, FacePart::arm, true);
        }
    }
    return out ? widened(out->looks) : Grid<std::uint8_t>(area.width, area.height);
}

// Linear rgb of every sample times the share of its pixels that count, and that share.
Grid<Texel> FaceBlur::Parts::means(const Frame& frame, const Rectangle& area,
                                   const Grid<std::uint8_t>& arms) const {
    const SrgbTables& tables = SrgbTables::get();
    Grid<Texel> grid((area.width + sample - 1) / sample, (area.height + sample - 1) / sample);
    const float share = 1.0f / static_cast<float>(sample * sample);
    for (int y = 0; y < area.height; ++y) {
        const std::uint8_t* pixel =
            frame.rgba.data() + (static_cast<size_t>(area.y + y) * static_cast<size_t>(frame.width) +
                                 static_cast<size_t>(area.x)) *
                                    4;
        const std::uint8_t* hidden = arms.row(y);
        Texel* means = grid.row(y / sample);
        for (int x = 0; x < area.width; ++means) {
            Texel sum{};
            for (const int end = std::min(x + sample, area.width); x < end; ++x, pixel += 4) {
                if (hidden[x]) continue;
                sum += Texel{tables.linear(pixel[0]), tables.linear(pixel[1]), tables.linear(pixel[2]), 1};
            }
            *means += sum * share;
        }
    }
    return grid;
}

FaceBlur::FaceBlur(const Avatar& avatar, const FaceBlurSpec& spec, const Camera& camera, RenderSize size)
    : parts_(std::make_unique<Parts>()) {
    const FaceRegion& face = spec.face;
    assert(spec.part >= FacePart::face && face.parts.size() == avatar.surfaces.size());
    parts_->clip = clip_from_world(camera, size);
    parts_->closest = camera.near;
    parts_->size = size;
    parts_->blurred = spec.part;
    const float distance = (parts_->clip * Vec4(face.middle, 1)).w;
    if (!(distance > 0)) {
        throw Error(
            format("scene: the face of {} is {:.2f} m behind the camera, so it cannot be blurred; place the "
                   "camera before the face, or choose another face mode",
                   avatar.source, -distance));
    }
    const float pixels_per_metre =
        static_cast<float>(size.height) / (2 * std::tan(camera.fov_y / 2) * distance);
    parts_->sigma = std::max(0.5f, spec.sigma * face.height * pixels_per_metre);
    parts_->sample = sample_for(parts_->sigma);
    for (size_t s = 0; s < avatar.surfaces.size(); ++s)
        parts_->solids.push_back(solid_of(avatar, s, face.parts[s], spec.part));
}

FaceBlur::~FaceBlur() = default;
FaceBlur::FaceBlur(FaceBlur&&) noexcept = default;

float FaceBlur::sigma() const {
    return parts_->sigma;
}

void FaceBlur::Parts::mix(Frame& frame, const Rectangle& area, const Layers& layers) const {
    std::vector<Between> columns;
    for (int x = 0; x < area.width; ++x) columns.push_back(between(x, sample, layers.strengths.width));
    for (int y = 0; y < area.height; ++y) {
        const SampleRow row = row_between(layers, between(y, sample, layers.strengths.height));
        std::uint8_t* pixel =
            frame.rgba.data() + (static_cast<size_t>(area.y + y) * static_cast<size_t>(frame.width) +
                                 static_cast<size_t>(area.x)) *
                                    4;
        const std::uint8_t* hidden = layers.arms.row(y);
        const int end = std::min(area.width, row.end * sample);
        for (int x = row.begin * sample; x < end; ++x) {
            if (!hidden[x]) mix_pixel(pixel + 4 * x, row, columns[static_cast<size_t>(x)]);
        }
    }
}

void FaceBlur::apply(Frame& frame, const PosedMesh& mesh) const {
    const Parts& parts = *parts_;
    assert(frame.width == parts.size.width && frame.height == parts.size.height);
    const auto seen = parts.seen(mesh);
    const Rectangle region = parts.around_region(seen);
    const int reach =
        static_cast<int>(std::ceil((3 + kEdgeReach * kEdgeSigma) * parts.sigma)) + 2 * parts.sample;
    if (is_empty(region) || is_empty(widened(region, reach, parts.size))) return;
    const Rectangle area = in_samples(widened(region, reach, parts.size), parts.sample, parts.size);

    // What of the face the camera sees.
    const LookOut out = parts.look(seen, area);
    float furthest = std::numeric_limits<float>::max();
    for (const Look& look : out.looks.values) {
        if (look.part == parts.blurred) furthest = std::min(furthest, look.nearness);
    }
    if (furthest == std::numeric_limits<float>::max()) return;

    const Grid<float> strengths = parts.strengths(out);
    const Grid<std::uint8_t> arms = parts.arms(seen, area, furthest);
    Grid<Texel> means = parts.means(frame, area, arms);
    blur(means, gaussian_weights(sigma_in_samples(parts.sigma, parts.sample)));
    parts.mix(frame, area, {.blurred = means, .strengths = strengths, .arms = arms});
}

namespace {

class BlurringRenderer : public Renderer {
  public:
    BlurringRenderer(std::unique_ptr<Renderer> renderer, FaceBlur blur)
        : renderer_(std::move(renderer)), blur_(std::move(blur)) {}

    int frames_at_once() const override { return renderer_->frames_at_once(); }
    using Renderer::render;
    Frame render(std::span<const PosedMesh> exposure) override {
        Frame frame = renderer_->render(exposure);
        blur_.apply(frame, exposure[exposure.size() / 2]);
        return frame;
    }

  private:
    std::unique_ptr<Renderer> renderer_;
    FaceBlur blur_;
};

}  // namespace

std::unique_ptr<Renderer> blur_faces(std::unique_ptr<Renderer> renderer, FaceBlur blur) {
    return std::make_unique<BlurringRenderer>(std::move(renderer), std::move(blur));
}

}  // namespace chironomia
