#include "raster/gl/gl_surfaces.h"

#include <cassert>

#include "raster/gl/gl_shaders.h"
#include "raster/studio/draw_order.h"

namespace chironomia {
namespace {

template <typename T>
GLsizeiptr bytes_of(const std::vector<T>& values) {
    return static_cast<GLsizeiptr>(values.size() * sizeof(T));
}

// A buffer of floats that feeds one attribute; without values the attribute is the constant `otherwise`.
template <typename T>
GlName attribute_buffer(const GlFunctions& gl, GLuint place, const std::vector<T>& values, GLenum usage) {
    GlName buffer = make_buffer(gl);
    gl.BindBuffer(GL_ARRAY_BUFFER, *buffer);
    gl.BufferData(GL_ARRAY_BUFFER, bytes_of(values), values.data(), usage);
    gl.VertexAttribPointer(place, sizeof(T) / sizeof(float), GL_FLOAT, GL_FALSE, sizeof(T), nullptr);
    if (!values.empty()) gl.EnableVertexAttribArray(place);
    return buffer;
}

}  // namespace

GlSurface::GlSurface(const GlFunctions& gl, const Surface& surface, const LitSurface& lit,
                     const VertexShadow& shadow)
    : gl_(gl),
      vertex_array_(make_vertex_array(gl)),
      vertex_count_(surface.positions.size()),
      indices_(surface.triangles) {
    gl.BindVertexArray(*vertex_array_);
    positions_ = attribute_buffer(gl, attribute::position, surface.positions, GL_STREAM_DRAW);
    normals_ = attribute_buffer(gl, attribute::normal, surface.normals, GL_STREAM_DRAW);
    tangents_ = attribute_buffer(gl, attribute::tangent, surface.tangents, GL_STREAM_DRAW);
    uvs_ = attribute_buffer(gl, attribute::uv, surface.uvs, GL_STATIC_DRAW);
    colours_ = attribute_buffer(gl, attribute::colour, surface.colours, GL_STATIC_DRAW);
    ambient_occlusion_ =
        attribute_buffer(gl, attribute::ambient_occlusion, lit.ambient_occlusion, GL_STATIC_DRAW);
    shadows_ = attribute_buffer(gl, attribute::shadow, std::vector<VertexShadow>(vertex_count_, shadow),
                                GL_STREAM_DRAW);
    const auto orders = lit.features.cut_out ? sample_orders(surface) : std::vector<std::uint8_t>{};
    sample_orders_ = attribute_buffer(gl, attribute::sample_order,
                                      std::vector<float>(orders.begin(), orders.end()), GL_STATIC_DRAW);
    triangles_ = make_buffer(gl);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, *triangles_);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, bytes_of(indices_), indices_.data(), GL_STATIC_DRAW);
    gl.BindVertexArray(0);
}

void GlSurface::upload(const PosedSurface& posed, const std::vector<VertexShadow>& shadows) {
    assert(posed.positions.size() == vertex_count_ && posed.normals.size() == vertex_count_);
    const auto replace = [this](const GlName& buffer, const auto& values) {
        gl_.BindBuffer(GL_ARRAY_BUFFER, *buffer);
        gl_.BufferSubData(GL_ARRAY_BUFFER, 0, bytes_of(values), values.data());
    };
    replace(positions_, posed.positions);
    replace(normals_, posed.normals);
    if (!posed.tangents.empty()) replace(tangents_, posed.tangents);
    if (!shadows.empty()) replace(shadows_, shadows);
}

void GlSurface::draw() const {
    gl_.BindVertexArray(*vertex_array_);
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices_.size()), GL_UNSIGNED_INT, nullptr);
}

void GlSurface::draw_from_behind(const PosedSurface& posed, const Vec3& view_direction) {
    const auto sorted = triangles_from_behind(indices_, posed, view_direction);
    gl_.BindVertexArray(*vertex_array_);
    gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, bytes_of(sorted), sorted.data());
    draw();
}

}  // namespace chironomia
