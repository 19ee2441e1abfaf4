#include "raster/gl/gl_renderer.h"

#include <array>
#include <cassert>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/render/camera.h"
#include "core/text.h"
#include "raster/gl/gl_context.h"
#include "raster/gl/gl_shaders.h"
#include "raster/gl/gl_surfaces.h"
#include "raster/gl/gl_target.h"
#include "raster/gl/gl_textures.h"
#include "raster/studio/backdrop.h"
#include "raster/studio/draw_order.h"
#include "raster/studio/figure_light.h"
#include "raster/studio/layer.h"

namespace chironomia {
namespace {

struct Part {
    GlSurface surface;
    const GlProgram* program = nullptr;
    std::array<GLuint, 6> textures{};  // by texture_unit
};

std::array<GLuint, 6> textures_of(GlTextures& textures, const Avatar& avatar, const Surface& surface,
                                  const Material& material) {
    if (surface.uvs.empty()) return {};
    const auto upload = [&](const Texture& texture, ImageUse use) {
        return textures.upload(avatar.images, texture, use);
    };
    std::array<GLuint, 6> names{};
    names[texture_unit::base_colour] =
        textures.upload(avatar.images, material.base_colour_texture, use_of_base_colour(material),
                        cutoff_in_texture(material));
    if (!surface.tangents.empty())
        names[texture_unit::normal] = upload(material.normal_texture, ImageUse::data);
    names[texture_unit::metallic_roughness] = upload(material.metallic_roughness_texture, ImageUse::data);
    names[texture_unit::occlusion] = upload(material.occlusion_texture, ImageUse::data);
    names[texture_unit::emissive] = upload(material.emissive_texture, ImageUse::colour);
    if (!surface.tangents.empty())
        names[texture_unit::anisotropy] = upload(material.anisotropy_texture, ImageUse::data);
    return names;
}

// All that lives in the context, and goes while the context is current.
struct GlParts {
    GlParts(const GlFunctions& gl, RenderSize size, int samples)
        : target(gl, size, samples), textures(gl), shadow_texture(make_texture(gl)) {}

    GlTarget target;
    GlTextures textures;
    GlName shadow_texture;
    std::map<SurfaceFeatures, std::unique_ptr<GlProgram>> programs;
    std::vector<Part> parts;  // in the order of Avatar::surfaces
};

class GlRenderer : public Renderer {
  public:
    GlRenderer(const Avatar& avatar, const Scene& scene, RenderSize size, const GlOptions& options);
    ~GlRenderer() override;

    Frame render(std::span<const PosedMesh> exposure) override;

  private:
    const GlProgram& program_for(const SurfaceFeatures& features);
    void add_part(const Avatar& avatar, size_t index);
    void set_scene(const GlProgram& program) const;
    void prepare_shadow_texture() const;

    void draw_figure(const PosedMesh& mesh);
    void draw_part(size_t index, const PosedSurface& posed);

    FigureLight light_;
    GlOptions options_;
    GlContext context_;
    const GlFunctions& gl_;
    Frame backdrop_;
    std::optional<DepthMap> depth_;
    std::unique_ptr<GlParts> parts_;
};

GlRenderer::GlRenderer(const Avatar& avatar, const Scene& scene, RenderSize size, const GlOptions& options)
    : light_(avatar, scene, size, options.threads),
      options_(options),
      context_(options.backend, size, options.threads),
      gl_(context_.functions()),
      backdrop_(draw_backdrop(light_.scene(), size, options.threads)) {
    const CurrentGlContext current(context_);
    parts_ = std::make_unique<GlParts>(gl_, size, options.samples);
    prepare_shadow_texture();
    for (size_t i = 0; i < avatar.surfaces.size(); ++i) add_part(avatar, i);
    for (const auto& [features, program] : parts_->programs) set_scene(*program);
}

GlRenderer::~GlRenderer() {
    if (!parts_) return;
    const CurrentGlContext current(context_);
    parts_.reset();
}

const GlProgram& GlRenderer::program_for(const SurfaceFeatures& features) {
    auto& program = parts_->programs[features];
    if (!program) program = std::make_unique<GlProgram>(gl_, features, options_.samples);
    return *program;
}

void GlRenderer::add_part(const Avatar& avatar, size_t index) {
    const Surface& surface = avatar.surfaces[index];
    const LitSurface& lit = light_.surfaces()[index];
    parts_->parts.push_back({.surface = GlSurface(gl_, surface, lit, light_.shadow_at_pixels()),
                             .program = &program_for(lit.features),
                             .textures = textures_of(parts_->textures, avatar, surface, lit.material)});
}

void GlRenderer::prepare_shadow_texture() const {
    gl_.BindTexture(GL_TEXTURE_2D, *parts_->shadow_texture);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowMapSide, kShadowMapSide, 0,
                   GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

// What stays the same for all frames.
void GlRenderer::set_scene(const GlProgram& program) const {
    const Scene& scene = light_.scene();
    program.use();
    Mat4 clip = clip_from_world(scene.camera, light_.size());
    // Upside down, so that the first row read back is the top of the picture.
    for (int column = 0; column < 4; ++column) clip[column].y = -clip[column].y;
    gl_.UniformMatrix4fv(program.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip));
    gl_.Uniform3fv(program.uniform("eye"), 1, glm::value_ptr(scene.camera.eye));
    gl_.Uniform3fv(program.uniform("sky"), 1, glm::value_ptr(scene.sky));
    gl_.Uniform3fv(program.uniform("ground"), 1, glm::value_ptr(scene.ground));
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const auto place = [&](const char* name) {
            return program.uniform(format("{}[{}]", name, i).c_str());
        };
        gl_.Uniform3fv(place("light_towards"), 1, glm::value_ptr(light.towards));
        gl_.Uniform3fv(place("light_radiance"), 1, glm::value_ptr(light.radiance));
        gl_.Uniform1f(place("light_wrap"), light.wrap);
        gl_.Uniform1f(place("light_size"), std::sin(light.angle));
    }
}

Frame GlRenderer::render(std::span<const PosedMesh> exposure) {
    assert(!exposure.empty());
    const PosedMesh& mesh = exposure[exposure.size() / 2];
    assert(mesh.surfaces.size() == parts_->parts.size());
    Frame frame = backdrop_;
    depth_ = light_.cast_shadow(mesh, frame, options_.whole_frame);
    const Rectangle area =
        options_.whole_frame ? Rectangle{0, 0, frame.width, frame.height} : light_.area_of(mesh);
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

void GlRenderer::draw_figure(const PosedMesh& mesh) {
    if (depth_) {
        gl_.ActiveTexture(GL_TEXTURE0 + texture_unit::shadow);
        gl_.BindTexture(GL_TEXTURE_2D, *parts_->shadow_texture);
        gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kShadowMapSide, kShadowMapSide, GL_DEPTH_COMPONENT,
                          GL_FLOAT, depth_->depth.data());
    }
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.FrontFace(GL_CW);  // upside down
    gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

    // What is solid first, then what lets light through, the furthest of it first.
    std::vector<size_t> translucent;
    for (const size_t i : light_.outer_first()) {
        const PosedSurface& posed = mesh.surfaces[i];
        if (posed.positions.empty()) continue;
        const LitSurface& lit = light_.surfaces()[i];
        parts_->parts[i].surface.upload(
            posed, depth_ ? light_.shadow_at_vertices(lit, posed, *depth_) : std::vector<VertexShadow>{});
        if (lit.features.translucent) {
            translucent.push_back(i);
        } else {
            draw_part(i, posed);
        }
    }
    for (const size_t i : furthest_first(translucent, mesh, light_.ahead())) draw_part(i, mesh.surfaces[i]);
}

void GlRenderer::draw_part(size_t index, const PosedSurface& posed) {
    Part& part = parts_->parts[index];
    const LitSurface& lit = light_.surfaces()[index];
    const Material& material = lit.material;
    const GlProgram& program = *part.program;
    program.use();
    gl_.Uniform4fv(program.uniform("base_colour"), 1, glm::value_ptr(material.base_colour));
    gl_.Uniform1f(program.uniform("metallic"), material.metallic);
    gl_.Uniform1f(program.uniform("roughness"), material.roughness);
    gl_.Uniform3fv(program.uniform("emissive"), 1, glm::value_ptr(material.emissive));
    gl_.Uniform1f(program.uniform("normal_scale"), material.normal_scale);
    gl_.Uniform1f(program.uniform("occlusion_strength"), material.occlusion_strength);
    gl_.Uniform1f(program.uniform("alpha_cutoff"), material.alpha_cutoff);
    gl_.Uniform3fv(program.uniform("reflectance"), 1, glm::value_ptr(material.reflectance));
    gl_.Uniform1f(program.uniform("coat"), material.coat);
    gl_.Uniform1f(program.uniform("coat_roughness"), material.coat_roughness);
    gl_.Uniform1f(program.uniform("anisotropy"), material.anisotropy);
    gl_.Uniform1f(program.uniform("anisotropy_turn"), material.anisotropy_turn);
    gl_.Uniform3fv(program.uniform("scatter"), 1, glm::value_ptr(material.scatter));
    if (depth_) {
        const PixelShadow shadow = light_.pixel_shadow_of(lit, *depth_);
        gl_.UniformMatrix4fv(program.uniform("map_from_world"), 1, GL_FALSE,
                             glm::value_ptr(shadow.map_from_world));
        gl_.Uniform1f(program.uniform("shadow_extent"), shadow.extent);
        gl_.Uniform1f(program.uniform("shadow_range"), shadow.range);
        gl_.Uniform1f(program.uniform("shadow_offset"), shadow.offset);
        gl_.Uniform1f(program.uniform("shadow_bias"), shadow.bias);
        gl_.Uniform1f(program.uniform("shadow_least"), shadow.least);
        gl_.Uniform1f(program.uniform("shadow_wide"), shadow.wide);
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
        part.surface.draw_from_behind(posed, light_.ahead());
        gl_.DepthMask(GL_TRUE);
    }
}

}  // namespace

std::unique_ptr<Renderer> make_gl_renderer(const Avatar& avatar, const Scene& scene, RenderSize size,
                                           const GlOptions& options) {
    return std::make_unique<GlRenderer>(avatar, scene, size, options);
}

}  // namespace chironomia
