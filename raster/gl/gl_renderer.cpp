#include "raster/gl/gl_renderer.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <optional>

#include "core/camera.h"
#include "core/error.h"
#include "core/rest.h"
#include "core/text.h"
#include "raster/gl/gl_context.h"
#include "raster/gl/gl_shaders.h"
#include "raster/gl/gl_surfaces.h"
#include "raster/gl/gl_target.h"
#include "raster/gl/gl_textures.h"
#include "raster/studio/ambient_occlusion.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/depth_map.h"
#include "raster/studio/floor_shadow.h"
#include "raster/studio/layer.h"
#include "raster/studio/soft_shadow.h"

namespace chironomia {
namespace {

constexpr int kShadowSide = 768;  // [texels]
// Mean edges of meshes, up to which (or from which) vertices can carry light and shadow. All thresholds here are ours,
// by eye.
struct MeshLimits {
    static constexpr float kLightAndShadow = 0.035f;  // up to it vertices can carry light and shadow [m]
    static constexpr float kLight = 0.06f;            // up to it vertices can carry the light alone [m]
    static constexpr float kClothShadow = 0.022f;     // from it shadows on clothes are wrong at vertices [m]
    static constexpr float kShadowSearch = 0.018f;    // up to it vertices show where shadows may lie [m]
    static constexpr float kPixels = 9;               // up to it vertices are as good as pixels [px]
};

// Materials that vertices can carry.
struct PlainMaterial {
    static constexpr float kMostMetallic = 0.01f;   // below it
    static constexpr float kLeastRoughness = 0.4f;  // from it
    static constexpr float kMostCoat = 0.9f;        // below it
};

// Radii of penumbras, for a figure of 1.7 m [m].
struct PenumbraRadii {
    static constexpr float kSharpest = 0.004f;
    static constexpr float kSoftest = 0.08f;
    static constexpr float kAtPixels = 0.006f;    // where no vertex has a better radius
    static constexpr float kAtVertices = 0.016f;  // from it the vertices of a fine mesh show the shadow
    static constexpr float kOverMeanEdge = 1.2f;  // least radius at vertices, over the mean edge
};

// Boxes around head and hands, for a figure of 1.7 m [m].
struct DelicateBoxes {
    static constexpr float kReach = 0.16f;                         // from the middle to a side
    static constexpr float kHeadUp = 0.09f, kHeadForward = 0.02f;  // of the middle, from the joint
    static constexpr float kHandOut = 0.06f, kHandUp = -0.05f;     // of the middle, from the joint
};

// The shadow map.
struct ShadowExtent {
    static constexpr float kOverFigure = 1.3f;  // over height or width of the figure: arms may reach up
    static constexpr float kLeast = 0.1f;       // [m]
    static constexpr float kOfAdult = 2.2f;     // of a figure of 1.7 m [m]
};

// Where light and shadow are worked out.
enum class Lighting { vertices, vertices_but_shadow, pixels_by_vertex_shadow, pixels };

struct Part {
    GlSurface surface;
    Material material;
    Lighting lighting = Lighting::pixels;
    float coarseness = 0;  // mean edge [m]
    const GlProgram* program = nullptr;
    std::array<GLuint, 5> textures{};  // by texture_unit
};

// The mean length of an edge, larger triangles counting for more [m].
float coarseness_of(const Surface& surface, const PosedSurface& rest) {
    float length_sum = 0, area_sum = 0;
    for (size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        const Vec3 a = rest.positions[surface.triangles[i]];
        const Vec3 b = rest.positions[surface.triangles[i + 1]] - a;
        const Vec3 c = rest.positions[surface.triangles[i + 2]] - a;
        const float area = length(cross(b, c));
        length_sum += area * (length(b) + length(c) + length(c - b)) / 3;
        area_sum += area;
    }
    return area_sum > 0 ? length_sum / area_sum : 0;
}

// Light at the vertices is enough for matt surfaces without metal whose triangles are small. Clothes and hair are
// judged in metres, skin in pixels, because it is seen from near. Light at the vertices costs a software rasteriser a
// fraction of light at the pixels.
Lighting lighting_of(const Material& material, float coarseness, float pixels_per_metre) {
    const bool plain = !material.unlit && material.metallic < PlainMaterial::kMostMetallic &&
                       material.roughness >= PlainMaterial::kLeastRoughness &&
                       material.coat < PlainMaterial::kMostCoat && material.normal_texture.image < 0 &&
                       material.metallic_roughness_texture.image < 0 && material.occlusion_texture.image < 0;
    const bool fine = coarseness < MeshLimits::kShadowSearch;
    const bool delicate = material.alpha_mode == AlphaMode::opaque && material.scatter != Vec3(0);
    const bool fine_in_picture = !fine || !delicate || coarseness * pixels_per_metre < MeshLimits::kPixels;
    const bool even = material.alpha_mode == AlphaMode::opaque && material.scatter == Vec3(0);
    if (plain && even && coarseness >= MeshLimits::kClothShadow && coarseness < MeshLimits::kLight)
        return Lighting::vertices_but_shadow;
    if (plain && coarseness < MeshLimits::kLightAndShadow && fine_in_picture) return Lighting::vertices;
    return fine ? Lighting::pixels_by_vertex_shadow : Lighting::pixels;
}

// At the figure.
float pixels_per_metre(const Camera& camera, RenderSize size) {
    const float height = 2 * distance(camera.eye, camera.target) * std::tan(camera.fov_y / 2);
    return static_cast<float>(size.height) / height;
}

std::array<GLuint, 5> textures_of(GlTextures& textures, const Avatar& avatar, const Surface& surface,
                                  const Material& material) {
    if (surface.uvs.empty()) return {};
    const auto upload = [&](const Texture& texture, ImageUse use) {
        return textures.upload(avatar.images, texture, use);
    };
    const ImageUse colour = material.alpha_mode == AlphaMode::mask    ? ImageUse::cut_out_colour
                            : material.alpha_mode == AlphaMode::blend ? ImageUse::blended_colour
                                                                      : ImageUse::colour;
    std::array<GLuint, 5> names{};
    names[texture_unit::base_colour] =
        textures.upload(avatar.images, material.base_colour_texture, colour,
                        material.alpha_mode == AlphaMode::mask
                            ? material.alpha_cutoff / std::max(material.base_colour.a, 1e-3f)
                            : 0);
    if (!surface.tangents.empty())
        names[texture_unit::normal] = upload(material.normal_texture, ImageUse::data);
    names[texture_unit::metallic_roughness] = upload(material.metallic_roughness_texture, ImageUse::data);
    names[texture_unit::occlusion] = upload(material.occlusion_texture, ImageUse::data);
    names[texture_unit::emissive] = upload(material.emissive_texture, ImageUse::colour);
    return names;
}

// Boxes around the head and the hands in the rest pose, for a figure of `body` times 1.7 m.
std::vector<Bounds> delicate_parts(const Avatar& avatar, float body) {
    using Box = DelicateBoxes;
    const std::vector<Mat4> world = world_from_joints(avatar.skeleton, rest_transforms(avatar.skeleton));
    std::vector<Bounds> parts;
    const auto add = [&](const HumanoidMap& figure, HumanJoint joint, const Vec3& away, float reach) {
        if (!figure.has(joint)) return;
        const Vec3 middle = origin(world[static_cast<size_t>(figure[joint])]) + body * away;
        parts.push_back({.low = middle - body * reach, .high = middle + body * reach});
    };
    std::vector<HumanoidMap> figures = {avatar.humanoid};
    figures.insert(figures.end(), avatar.more_humanoids.begin(), avatar.more_humanoids.end());
    for (const HumanoidMap& figure : figures) {
        add(figure, HumanJoint::head, {0, Box::kHeadUp, Box::kHeadForward}, Box::kReach);
        add(figure, HumanJoint::left_hand, {Box::kHandOut, Box::kHandUp, 0}, Box::kReach);
        add(figure, HumanJoint::right_hand, {-Box::kHandOut, Box::kHandUp, 0}, Box::kReach);
    }
    return parts;
}

// The least occluded surfaces first: clothes come before the skin that they hide, which then costs little.
std::vector<size_t> outer_first(const Avatar& avatar,
                                const std::vector<std::vector<float>>& ambient_occlusion) {
    std::vector<std::pair<float, size_t>> order;
    for (size_t i = 0; i < avatar.surfaces.size(); ++i) {
        const auto& values = ambient_occlusion[i];
        const float sum = std::accumulate(values.begin(), values.end(), 0.0f);
        order.emplace_back(values.empty() ? 0 : -sum / static_cast<float>(values.size()), i);
    }
    std::stable_sort(order.begin(), order.end());
    std::vector<size_t> indices;
    for (const auto& [closed, i] : order) indices.push_back(i);
    return indices;
}

// The scene as the renderer uses it: the light with the shadow first.
Scene checked(Scene scene, RenderSize size) {
    if (size.width < 1 || size.height < 1 || size.width > 8192 || size.height > 8192) {
        throw Error(
            format("picture size: {} x {} pixels, each side must be 1 to 8192", size.width, size.height));
    }
    if (scene.lights.size() > kMostLights) {
        throw Error(format("scene: {} lights, at most {} can be drawn; remove some", scene.lights.size(),
                           kMostLights));
    }
    const auto casts = [](const Light& light) { return light.casts_shadow; };
    const auto casters = std::count_if(scene.lights.begin(), scene.lights.end(), casts);
    if (casters > 1) {
        throw Error(
            format("scene: {} lights cast shadows, at most 1 can be drawn; let the key light alone cast one",
                   casters));
    }
    std::stable_partition(scene.lights.begin(), scene.lights.end(), casts);
    return scene;
}

// All that lives in the context, and goes while the context is current.
struct GlParts {
    GlParts(const GlFunctions& gl, RenderSize size, int samples)
        : target(gl, size, samples), textures(gl), shadow_texture(make_texture(gl)) {}

    GlTarget target;
    GlTextures textures;
    GlName shadow_texture;
    std::map<ShaderFeatures, std::unique_ptr<GlProgram>> programs;
    std::vector<Part> parts;          // in the order of Avatar::surfaces
    std::vector<size_t> outer_first;  // indices of `parts`
};

class GlRenderer : public Renderer {
  public:
    GlRenderer(const Avatar& avatar, const Scene& scene, RenderSize size, const GlOptions& options);
    ~GlRenderer() override;

    Frame render(std::span<const PosedMesh> exposure) override;

  private:
    bool has_shadow() const { return !scene_.lights.empty() && scene_.lights.front().casts_shadow; }
    float body() const { return extent_ / ShadowExtent::kOfAdult; }  // 1 for a figure of 1.7 m
    Penumbra penumbra_on(const Part& part) const;
    const GlProgram& program_for(const ShaderFeatures& features);
    void add_part(const Avatar& avatar, const Surface& surface, const PosedSurface& rest,
                  const std::vector<float>& ambient_occlusion);
    void set_scene(const GlProgram& program) const;
    void prepare_shadow_texture() const;

    Rectangle area_of(const PosedMesh& mesh) const;
    void cast_shadow(const PosedMesh& mesh, Frame& frame);
    void draw_figure(const PosedMesh& mesh);
    void draw_part(size_t index, const PosedSurface& posed);

    Scene scene_;
    RenderSize size_;
    GlOptions options_;
    GlContext context_;
    const GlFunctions& gl_;
    Frame backdrop_;
    ShadowCaster caster_;
    float extent_ = 2.5f;  // of the shadow map [m]
    std::optional<DepthMap> depth_;
    std::unique_ptr<GlParts> parts_;
};

GlRenderer::GlRenderer(const Avatar& avatar, const Scene& scene, RenderSize size, const GlOptions& options)
    : scene_(checked(scene, size)),
      size_(size),
      options_(options),
      context_(options.backend, size, options.threads),
      gl_(context_.functions()),
      backdrop_(draw_backdrop(scene_, size)),
      caster_(shadow_caster_of(avatar)) {
    const PosedMesh rest = rest_mesh(avatar);
    const Bounds bounds = bounds_of(rest);
    // Room for arms that reach up, so that the grid keeps its scale.
    extent_ =
        ShadowExtent::kOverFigure * std::max(bounds.high.y - bounds.low.y, bounds.high.x - bounds.low.x);
    extent_ = std::max(extent_, ShadowExtent::kLeast);

    const CurrentGlContext current(context_);
    parts_ = std::make_unique<GlParts>(gl_, size, options.samples);
    prepare_shadow_texture();
    const auto ambient_occlusion =
        ambient_occlusion_of(rest, caster_, delicate_parts(avatar, extent_ / ShadowExtent::kOfAdult));
    for (size_t i = 0; i < avatar.surfaces.size(); ++i) {
        add_part(avatar, avatar.surfaces[i], rest.surfaces[i], ambient_occlusion[i]);
    }
    parts_->outer_first = outer_first(avatar, ambient_occlusion);
    for (const auto& [features, program] : parts_->programs) set_scene(*program);
}

GlRenderer::~GlRenderer() {
    if (!parts_) return;
    const CurrentGlContext current(context_);
    parts_.reset();
}

// Vertices cannot show an edge that is sharper than they are dense.
Penumbra GlRenderer::penumbra_on(const Part& part) const {
    const float least = PenumbraRadii::kSharpest * body();
    const float dense =
        part.lighting == Lighting::vertices ? PenumbraRadii::kOverMeanEdge * part.coarseness : 0;
    const bool between = part.lighting == Lighting::vertices_but_shadow;
    return {.spread = std::tan(scene_.lights.front().angle),
            .least = std::max(least, dense),
            .most = (between ? PenumbraRadii::kAtVertices : PenumbraRadii::kSoftest) * body(),
            .around = between ? part.coarseness : 0};
}

const GlProgram& GlRenderer::program_for(const ShaderFeatures& features) {
    auto& program = parts_->programs[features];
    if (!program) program = std::make_unique<GlProgram>(gl_, features);
    return *program;
}

void GlRenderer::add_part(const Avatar& avatar, const Surface& surface, const PosedSurface& rest,
                          const std::vector<float>& ambient_occlusion) {
    const Material material =
        surface.material >= 0 ? avatar.materials[static_cast<size_t>(surface.material)] : Material{};
    const auto textures = textures_of(parts_->textures, avatar, surface, material);
    const float coarseness = coarseness_of(surface, rest);
    const Lighting lighting = lighting_of(material, coarseness, pixels_per_metre(scene_.camera, size_));
    const ShaderFeatures features{
        .lights = material.unlit ? 0 : static_cast<int>(scene_.lights.size()),
        .per_vertex = lighting == Lighting::vertices || lighting == Lighting::vertices_but_shadow,
        .pixel_shadow = lighting == Lighting::vertices_but_shadow,
        .shadow = !material.unlit && has_shadow(),
        .base_colour_map = textures[texture_unit::base_colour] != 0,
        .normal_map = textures[texture_unit::normal] != 0 && !material.unlit,
        .metallic_roughness_map = textures[texture_unit::metallic_roughness] != 0 && !material.unlit,
        .occlusion_map = textures[texture_unit::occlusion] != 0 && !material.unlit,
        .emissive_map = textures[texture_unit::emissive] != 0 && !material.unlit,
        .vertex_colour = !surface.colours.empty(),
        .coated = material.coat > 0 && !material.unlit,
        .scattering = material.scatter != Vec3(0) && !material.unlit,
        .unlit = material.unlit,
        .cut_out = material.alpha_mode == AlphaMode::mask,
        .many_samples = material.alpha_mode == AlphaMode::mask && options_.samples > 1,
        .translucent = material.alpha_mode == AlphaMode::blend,
        .double_sided = material.double_sided && !material.unlit,
    };
    // Where vertices are too far apart to find shadows, every pixel searches for them.
    const VertexShadow everywhere{.visible = 1, .radius = PenumbraRadii::kAtPixels * body()};
    parts_->parts.push_back({.surface = GlSurface(gl_, surface, ambient_occlusion, everywhere),
                             .material = material,
                             .lighting = lighting,
                             .coarseness = coarseness,
                             .program = &program_for(features),
                             .textures = textures});
}

void GlRenderer::prepare_shadow_texture() const {
    gl_.BindTexture(GL_TEXTURE_2D, *parts_->shadow_texture);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowSide, kShadowSide, 0, GL_DEPTH_COMPONENT,
                   GL_FLOAT, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

// What stays the same for all frames.
void GlRenderer::set_scene(const GlProgram& program) const {
    program.use();
    Mat4 clip = clip_from_world(scene_.camera, size_);
    // Upside down, so that the first row read back is the top of the picture.
    for (int column = 0; column < 4; ++column) clip[column].y = -clip[column].y;
    gl_.UniformMatrix4fv(program.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip));
    gl_.Uniform3fv(program.uniform("eye"), 1, glm::value_ptr(scene_.camera.eye));
    gl_.Uniform3fv(program.uniform("sky"), 1, glm::value_ptr(scene_.sky));
    gl_.Uniform3fv(program.uniform("ground"), 1, glm::value_ptr(scene_.ground));
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        const auto place = [&](const char* name) {
            return program.uniform(format("{}[{}]", name, i).c_str());
        };
        gl_.Uniform3fv(place("light_towards"), 1, glm::value_ptr(light.towards));
        gl_.Uniform3fv(place("light_radiance"), 1, glm::value_ptr(light.radiance));
        gl_.Uniform1f(place("light_wrap"), light.wrap);
        gl_.Uniform1f(place("light_size"), std::sin(light.angle));
    }
}

// The pixels that the figure may touch.
Rectangle GlRenderer::area_of(const PosedMesh& mesh) const {
    const Rectangle whole{0, 0, size_.width, size_.height};
    if (options_.whole_frame) return whole;
    const Mat4 clip = clip_from_world(scene_.camera, size_);
    Vec2 low(2), high(-2);
    for (const PosedSurface& surface : mesh.surfaces) {
        for (const Vec3& position : surface.positions) {
            const Vec4 seen = clip * Vec4(position, 1);
            if (seen.w < scene_.camera.near) return whole;
            const Vec2 place(seen.x / seen.w, -seen.y / seen.w);
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    }
    const Vec2 size(static_cast<float>(size_.width), static_cast<float>(size_.height));
    const Vec2 first = glm::clamp(glm::floor((low * 0.5f + 0.5f) * size) - 1.0f, Vec2(0), size);
    const Vec2 last = glm::clamp(glm::ceil((high * 0.5f + 0.5f) * size) + 1.0f, Vec2(0), size);
    return {static_cast<int>(first.x), static_cast<int>(first.y),
            std::max(0, static_cast<int>(last.x - first.x)), std::max(0, static_cast<int>(last.y - first.y))};
}

Frame GlRenderer::render(std::span<const PosedMesh> exposure) {
    assert(!exposure.empty());
    const PosedMesh& mesh = exposure[exposure.size() / 2];
    assert(mesh.surfaces.size() == parts_->parts.size());
    Frame frame = backdrop_;
    cast_shadow(mesh, frame);
    const Rectangle area = area_of(mesh);
    if (is_empty(area)) return frame;

    const CurrentGlContext current(context_);
    parts_->target.begin(area);
    draw_figure(mesh);
    put_in_front(frame, area, parts_->target.read(area));
    if (const GLenum fault = gl_.GetError(); fault != GL_NO_ERROR) {
        throw Error(
            format("OpenGL: a picture cannot be drawn (error {:#x}); free memory, or choose a smaller --size",
                   fault));
    }
    return frame;
}

void GlRenderer::cast_shadow(const PosedMesh& mesh, Frame& frame) {
    if (!has_shadow()) return;
    const Light& key = scene_.lights.front();
    depth_ = draw_depth_map(mesh, caster_, {.towards = key.towards, .extent = extent_, .side = kShadowSide});
    shade_floor(frame, mesh, caster_, scene_, *depth_,
                {.extent = extent_, .whole_frame = options_.whole_frame});
}

void GlRenderer::draw_figure(const PosedMesh& mesh) {
    if (has_shadow()) {
        gl_.ActiveTexture(GL_TEXTURE0 + texture_unit::shadow);
        gl_.BindTexture(GL_TEXTURE_2D, *parts_->shadow_texture);
        gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kShadowSide, kShadowSide, GL_DEPTH_COMPONENT, GL_FLOAT,
                          depth_->depth.data());
    }
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.FrontFace(GL_CW);  // upside down
    gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

    // What is solid first, then what lets light through, the furthest of it first.
    const Vec3 ahead = normalize(scene_.camera.target - scene_.camera.eye);
    std::vector<std::pair<float, size_t>> translucent;
    for (const size_t i : parts_->outer_first) {
        const PosedSurface& posed = mesh.surfaces[i];
        if (posed.positions.empty()) continue;
        Part& part = parts_->parts[i];
        const bool shaded = has_shadow() && part.lighting != Lighting::pixels && !part.material.unlit;
        const bool strands = part.material.alpha_mode == AlphaMode::mask && part.material.double_sided;
        part.surface.upload(posed, shaded ? soft_shadow_of(posed, *depth_, penumbra_on(part), strands)
                                          : std::vector<VertexShadow>{});
        if (parts_->parts[i].material.alpha_mode != AlphaMode::blend) {
            draw_part(i, posed);
            continue;
        }
        Vec3 sum(0);
        for (const Vec3& position : posed.positions) sum += position;
        translucent.emplace_back(-dot(sum, ahead) / static_cast<float>(posed.positions.size()), i);
    }
    std::stable_sort(translucent.begin(), translucent.end());
    for (const auto& [depth, i] : translucent) draw_part(i, mesh.surfaces[i]);
}

void GlRenderer::draw_part(size_t index, const PosedSurface& posed) {
    Part& part = parts_->parts[index];
    const Material& material = part.material;
    const GlProgram& program = *part.program;
    program.use();
    gl_.Uniform4fv(program.uniform("base_colour"), 1, glm::value_ptr(material.base_colour));
    gl_.Uniform1f(program.uniform("metallic"), material.metallic);
    gl_.Uniform1f(program.uniform("roughness"), material.roughness);
    gl_.Uniform3fv(program.uniform("emissive"), 1, glm::value_ptr(material.emissive));
    gl_.Uniform1f(program.uniform("normal_scale"), material.normal_scale);
    gl_.Uniform1f(program.uniform("occlusion_strength"), material.occlusion_strength);
    gl_.Uniform1f(program.uniform("alpha_cutoff"), material.alpha_cutoff);
    gl_.Uniform1f(program.uniform("coat"), material.coat);
    gl_.Uniform1f(program.uniform("coat_roughness"), material.coat_roughness);
    gl_.Uniform3fv(program.uniform("scatter"), 1, glm::value_ptr(material.scatter));
    if (has_shadow()) {
        const Mat4 map = map_from_world(*depth_);
        gl_.UniformMatrix4fv(program.uniform("map_from_world"), 1, GL_FALSE, glm::value_ptr(map));
        gl_.Uniform1f(program.uniform("shadow_extent"), depth_->texel * static_cast<float>(depth_->side));
        gl_.Uniform1f(program.uniform("shadow_range"), depth_->range);
        gl_.Uniform1f(program.uniform("shadow_offset"), 0.7f * depth_->texel);
        gl_.Uniform1f(program.uniform("shadow_bias"), 1.0f * depth_->texel / depth_->range);
        gl_.Uniform1f(program.uniform("shadow_least"), penumbra_on(part).least);
        // Where the shadow alone is worked out at the pixels, no radius is above kAtVertices (penumbra_on).
        // With twice that as the limit the shader never mixes in the shadow of the vertices.
        const float limit = part.lighting == Lighting::vertices_but_shadow ? 2.0f : 1.0f;
        gl_.Uniform1f(program.uniform("shadow_wide"), limit * PenumbraRadii::kAtVertices * body());
    }
    for (size_t unit = 0; unit < part.textures.size(); ++unit) {
        if (part.textures[unit] == 0) continue;
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl_.BindTexture(GL_TEXTURE_2D, part.textures[unit]);
    }
    material.double_sided ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
    if (material.alpha_mode != AlphaMode::blend) {
        gl_.Disable(GL_BLEND);
        gl_.DepthMask(GL_TRUE);
        part.surface.draw();
    } else {
        gl_.Enable(GL_BLEND);
        gl_.DepthMask(GL_FALSE);
        part.surface.draw_from_behind(posed, normalize(scene_.camera.target - scene_.camera.eye));
        gl_.DepthMask(GL_TRUE);
    }
}

}  // namespace

std::unique_ptr<Renderer> make_gl_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                           const GlOptions& options) {
    return std::make_unique<GlRenderer>(avatar, scene, size, options);
}

}  // namespace chironomia
