#include "skinning/gltf/gltf_mesh.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "skinning/gltf/gltf_checks.h"

namespace chironomia {
namespace {

constexpr size_t kMostVertices = 8'000'000;  // of all surfaces together
constexpr size_t kMostMorphs = 10'000;       // of all nodes together
// Ours: programs that keep the four largest of many weights leave less than 1, and rounding to bytes a little more.
constexpr float kLeastWeights = 0.5f, kMostWeights = 1.1f;

std::vector<Vec3> to_vec3(const std::vector<float>& numbers) {
    std::vector<Vec3> vectors(numbers.size() / 3);
    for (size_t v = 0; v < vectors.size(); ++v) vectors[v] = glm::make_vec3(&numbers[3 * v]);
    return vectors;
}

// A vector of no length keeps its place with a direction that does no harm.
Vec3 unit_or(const Vec3& vector, const Vec3& otherwise) {
    const float size = length(vector);
    return size > 1e-20f ? vector / size : otherwise;
}

std::vector<std::string> strings_in(const tinygltf::Value& extras, const char* key) {
    std::vector<std::string> strings;
    if (!extras.IsObject() || !extras.Get(key).IsArray()) return strings;
    const tinygltf::Value& array = extras.Get(key);
    for (size_t i = 0; i < array.ArrayLen(); ++i) {
        const tinygltf::Value& value = array.Get(static_cast<int>(i));
        strings.push_back(value.IsString() ? value.Get<std::string>() : "");
    }
    return strings;
}

// The morph that an expression moves, if it is one alone and of this node or mesh.
std::optional<size_t> bound_morph(const Json& binds, const char* owner_key, int owner) {
    if (!binds.is_array() || binds.size() != 1 || !binds[0].is_object()) return std::nullopt;
    const Json owner_found = binds[0].value(owner_key, Json()), index = binds[0].value("index", Json());
    if (!owner_found.is_number_integer() || owner_found != owner || !index.is_number_unsigned())
        return std::nullopt;
    return index.get<size_t>();
}

// What the expressions of a VRM call the morphs of a node: VRM 1.0 binds nodes, VRM 0.x meshes.
std::vector<std::string> expression_names(const Json& json, const MorphSet& morphs) {
    std::vector<std::string> names(static_cast<size_t>(morphs.morphs));
    const auto add = [&](const std::string& name, std::optional<size_t> morph) {
        if (morph && *morph < names.size()) names[*morph] = name;
    };
    const Json none;
    const auto in = [&](const Json& object, const char* key) -> const Json& {
        return object.is_object() && object.contains(key) ? object[key] : none;
    };
    const Json& extensions = in(json, "extensions");
    for (const char* kind : {"preset", "custom"}) {
        for (const auto& [name, expression] : in(in(in(extensions, "VRMC_vrm"), "expressions"), kind).items())
            add(name, bound_morph(in(expression, "morphTargetBinds"), "node", morphs.node));
    }
    for (const Json& group : in(in(in(extensions, "VRM"), "blendShapeMaster"), "blendShapeGroups")) {
        const Json& name = in(group, "name");
        if (name.is_string())
            add(name.get<std::string>(), bound_morph(in(group, "binds"), "mesh", morphs.mesh));
    }
    return names;
}

// The names that the mesh gives its morphs, else those of a VRM's expressions, else numbers.
std::vector<std::string> morph_names(const GltfFile& file, const tinygltf::Mesh& mesh,
                                     const MorphSet& morphs) {
    std::vector<std::string> names = strings_in(mesh.extras, "targetNames");
    if (names.empty() && !mesh.primitives.empty())
        names = strings_in(mesh.primitives.front().extras, "targetNames");
    const std::vector<std::string> expressions = expression_names(file.json, morphs);
    names.resize(expressions.size());
    for (size_t m = 0; m < names.size(); ++m) {
        if (names[m].empty()) names[m] = expressions[m];
        if (names[m].empty()) names[m] = format("morph {}", m);
    }
    return names;
}

// Corners of triangles from the corners of a list, strip or fan.
std::vector<std::uint32_t> triangles_of(const std::vector<std::uint32_t>& corners, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return corners;
    std::vector<std::uint32_t> triangles;
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const bool odd = strip && i % 2 == 1;
        const std::uint32_t a = strip ? corners[i] : corners[0];
        const std::uint32_t b = corners[i + (odd ? 2 : 1)];
        const std::uint32_t c = corners[i + (odd ? 1 : 2)];
        if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

bool has_triangles(int mode) {
    return mode == -1 || mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

template <typename Value>
void keep_only(std::vector<Value>& values, const std::vector<std::uint32_t>& kept) {
    if (values.empty()) return;
    std::vector<Value> result;
    result.reserve(kept.size());
    for (const std::uint32_t v : kept) result.push_back(values[v]);
    values = std::move(result);
}

void keep_influences(Surface& surface, const std::vector<std::uint32_t>& kept) {
    if (surface.first_influence.empty()) return;
    std::vector<std::uint32_t> first = {0};
    std::vector<Influence> influences;
    for (const std::uint32_t v : kept) {
        for (std::uint32_t i = surface.first_influence[v]; i < surface.first_influence[v + 1]; ++i)
            influences.push_back(surface.influences[i]);
        first.push_back(static_cast<std::uint32_t>(influences.size()));
    }
    surface.first_influence = std::move(first);
    surface.influences = std::move(influences);
}

void keep_moves(Morph& morph, const std::vector<std::int64_t>& new_place) {
    Morph result{.name = morph.name, .vertices = {}, .moves = {}, .normal_moves = {}};
    for (size_t m = 0; m < morph.vertices.size(); ++m) {
        const std::int64_t place = new_place[morph.vertices[m]];
        if (place < 0) continue;
        result.vertices.push_back(static_cast<std::uint32_t>(place));
        result.moves.push_back(morph.moves[m]);
        if (!morph.normal_moves.empty()) result.normal_moves.push_back(morph.normal_moves[m]);
    }
    morph = std::move(result);
}

// Exporters let the primitives of a mesh share one list of vertices; each surface keeps its own alone.
void drop_unused_vertices(Surface& surface) {
    std::vector<std::int64_t> new_place(surface.positions.size(), -1);
    for (const std::uint32_t corner : surface.triangles) new_place[corner] = 0;
    std::vector<std::uint32_t> kept;
    for (size_t v = 0; v < new_place.size(); ++v) {
        if (new_place[v] < 0) continue;
        new_place[v] = static_cast<std::int64_t>(kept.size());
        kept.push_back(static_cast<std::uint32_t>(v));
    }
    if (kept.size() == surface.positions.size()) return;

    for (std::uint32_t& corner : surface.triangles) corner = static_cast<std::uint32_t>(new_place[corner]);
    keep_only(surface.positions, kept);
    keep_only(surface.normals, kept);
    keep_only(surface.tangents, kept);
    keep_only(surface.uvs, kept);
    keep_only(surface.colours, kept);
    keep_influences(surface, kept);
    for (Morph& morph : surface.morphs) keep_moves(morph, new_place);
}

// The attributes of a primitive, or of a morph of it.
struct VertexData {
    const std::map<std::string, int>& accessors;  // "NORMAL" and its accessor
    size_t vertices = 0;
    std::string label;  // for messages
};

class MeshReader {
  public:
    MeshReader(Accessors& accessors, const tinygltf::Model& model, const MeshContext& context)
        : accessors_(accessors), file_(accessors.file()), model_(model), context_(context) {}

    MeshSet read();

  private:
    void add_node(int joint, const tinygltf::Node& node);
    void add_rest_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh, size_t morphs,
                          const std::string& label);
    Surface surface_of(const tinygltf::Primitive& primitive, const std::string& label);
    std::vector<std::uint32_t> corners(const tinygltf::Primitive& primitive, const Surface& surface,
                                       const std::string& label);
    void add_uvs(Surface& surface, const VertexData& data);
    void add_colours(Surface& surface, const VertexData& data);
    void add_tangents(Surface& surface, const VertexData& data);
    void add_influences(Surface& surface, const VertexData& data);
    Morph morph_of(const VertexData& target);
    // The vectors of an attribute, one a vertex; empty if there are none.
    std::vector<float> attribute(const VertexData& data, const std::string& name, size_t components);
    int checked_material(int material, const std::string& label);

    Accessors& accessors_;
    const GltfFile& file_;
    const tinygltf::Model& model_;
    const MeshContext& context_;
    MeshSet set_;
    size_t vertices_ = 0;
};

void check_count(const GltfFile& file, size_t count, size_t vertices, const std::string& what) {
    if (count != vertices) {
        refuse(file,
               format("{} has {} elements, its {} positions need as many; the file is broken, get it again",
                      what, count, vertices));
    }
}

std::vector<float> MeshReader::attribute(const VertexData& data, const std::string& name, size_t components) {
    const auto found = data.accessors.find(name);
    if (found == data.accessors.end()) return {};
    const std::string what = data.label + ": " + name;
    check_count(file_, accessors_.count(found->second, what), data.vertices, what);
    check_attribute_type(file_, model_.accessors[static_cast<size_t>(found->second)], name, what);
    return accessors_.floats(found->second, components, what);
}

std::vector<std::uint32_t> MeshReader::corners(const tinygltf::Primitive& primitive, const Surface& surface,
                                               const std::string& label) {
    const size_t vertices = surface.positions.size();
    std::vector<std::uint32_t> corners;
    if (primitive.indices < 0) {
        for (std::uint32_t v = 0; v < vertices; ++v) corners.push_back(v);
    } else {
        corners = accessors_.integers(primitive.indices, 1, label + ": its indices");
    }
    for (const std::uint32_t corner : corners) {
        if (corner >= vertices) {
            refuse(file_, format("{} has index {} and {} vertices; the file is broken, get it again", label,
                                 corner, vertices));
        }
    }
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode == TINYGLTF_MODE_TRIANGLES && corners.size() % 3 != 0) {
        refuse(file_,
               format("{} has {} corners of triangles, a multiple of 3 is needed; the file is broken, get it "
                      "again",
                      label, corners.size()));
    }
    return triangles_of(corners, mode);
}

int MeshReader::checked_material(int material, const std::string& label) {
    const size_t count = context_.materials.materials.size();
    if (material >= 0 && static_cast<size_t>(material) >= count) {
        refuse(file_, format("{} has material {}, there are {}; the file is broken, get it again", label,
                             material, count));
    }
    return std::max(material, -1);
}

void MeshReader::add_uvs(Surface& surface, const VertexData& data) {
    const UvUse use =
        surface.material < 0 ? UvUse{} : context_.materials.uv_uses[static_cast<size_t>(surface.material)];
    const std::vector<float> numbers = attribute(data, format("TEXCOORD_{}", use.set), 2);
    const float cosine = std::cos(use.rotation), sine = std::sin(use.rotation);
    for (size_t n = 0; n + 1 < numbers.size(); n += 2) {
        const Vec2 uv = Vec2(numbers[n], numbers[n + 1]) * use.scale;
        surface.uvs.push_back(Vec2(cosine * uv.x + sine * uv.y, -sine * uv.x + cosine * uv.y) + use.offset);
    }
    check_uvs(file_, surface, context_.materials, data.label);
}

void MeshReader::add_colours(Surface& surface, const VertexData& data) {
    const auto found = data.accessors.find("COLOR_0");
    if (found == data.accessors.end()) return;
    const size_t components = accessors_.components(found->second, data.label + ": COLOR_0") == 3 ? 3 : 4;
    const std::vector<float> numbers = attribute(data, "COLOR_0", components);
    for (size_t n = 0; n + components <= numbers.size(); n += components) {
        surface.colours.push_back(
            {numbers[n], numbers[n + 1], numbers[n + 2], components == 4 ? numbers[n + 3] : 1.0f});
    }
}

void MeshReader::add_tangents(Surface& surface, const VertexData& data) {
    if (surface.material < 0) return;
    const Material& material = context_.materials.materials[static_cast<size_t>(surface.material)];
    if (material.normal_texture.image < 0 && material.anisotropy <= 0) return;
    const std::vector<float> numbers = attribute(data, "TANGENT", 4);
    for (size_t n = 0; n + 3 < numbers.size(); n += 4) {
        const Vec3 along = unit_or({numbers[n], numbers[n + 1], numbers[n + 2]}, {1, 0, 0});
        surface.tangents.emplace_back(along, numbers[n + 3] < 0 ? -1.0f : 1.0f);
    }
    if (surface.tangents.empty() && !surface.uvs.empty()) surface.tangents = vertex_tangents(surface);
}

void MeshReader::add_influences(Surface& surface, const VertexData& data) {
    const auto& [accessors, vertices, label] = data;
    const size_t joints = context_.skins[static_cast<size_t>(surface.skin)].joints.size();
    std::vector<std::vector<std::uint32_t>> joint_sets;
    std::vector<std::vector<float>> weight_sets;
    for (int set = 0; accessors.contains(format("JOINTS_{}", set)); ++set) {
        const std::string name = format("JOINTS_{}", set);
        const int accessor = accessors.at(name);
        check_count(file_, accessors_.count(accessor, label + ": " + name), vertices, label + ": " + name);
        joint_sets.push_back(accessors_.integers(accessor, 4, label + ": " + name));
        weight_sets.push_back(attribute(data, format("WEIGHTS_{}", set), 4));
        if (weight_sets.back().empty() && vertices > 0)
            refuse(file_, format("{} has {} without WEIGHTS_{}; the file is broken, get it again", label,
                                 name, set));
    }
    surface.first_influence.push_back(0);
    size_t uneven = 0;
    float least = std::numeric_limits<float>::infinity(), most = 0;
    for (size_t v = 0; v < vertices; ++v) {
        const size_t first = surface.influences.size();
        std::vector<float> weights;
        for (const std::vector<float>& set : weight_sets)
            weights.insert(weights.end(), &set[4 * v], &set[4 * v] + 4);
        check_weights(file_, weights, format("{}: vertex {}", label, v));
        float sum = 0;
        for (size_t set = 0; set < joint_sets.size(); ++set) {
            for (size_t n = 4 * v; n < 4 * v + 4; ++n) {
                const float weight = weight_sets[set][n];
                if (!(weight > 0)) continue;
                if (joint_sets[set][n] >= joints) {
                    refuse(file_,
                           format("{}: vertex {} is moved by joint {}, its skin has {}; the file is broken, "
                                  "get it again",
                                  label, v, joint_sets[set][n], joints));
                }
                surface.influences.push_back({joint_sets[set][n], weight});
                sum += weight;
            }
        }
        if (!(sum > 0)) {
            refuse(file_, format("{}: no joint moves vertex {} (its weights are 0); repair the skin weights",
                                 label, v));
        }
        for (size_t i = first; i < surface.influences.size(); ++i) surface.influences[i].weight /= sum;
        surface.first_influence.push_back(static_cast<std::uint32_t>(surface.influences.size()));
        if (sum >= kLeastWeights && sum <= kMostWeights) continue;
        ++uneven;
        least = std::min(least, sum);
        most = std::max(most, sum);
    }
    if (uneven == 0) return;
    const std::string low = format("{:.4g}", least), high = format("{:.4g}", most);
    set_.notes.push_back(format("{}: weights of {} of {} vertices sum to {}, not 1; they are normalised",
                                label, uneven, vertices, low == high ? low : format("{} to {}", low, high)));
}

Morph MeshReader::morph_of(const VertexData& target) {
    const std::vector<Vec3> moves = to_vec3(attribute(target, "POSITION", 3));
    const std::vector<Vec3> normal_moves = to_vec3(attribute(target, "NORMAL", 3));
    Morph morph;
    for (size_t v = 0; v < target.vertices; ++v) {
        const Vec3 move = moves.empty() ? Vec3(0) : moves[v];
        const Vec3 normal_move = normal_moves.empty() ? Vec3(0) : normal_moves[v];
        if (move == Vec3(0) && normal_move == Vec3(0)) continue;
        morph.vertices.push_back(static_cast<std::uint32_t>(v));
        morph.moves.push_back(move);
        if (!normal_moves.empty()) morph.normal_moves.push_back(normal_move);
    }
    return morph;
}

Surface MeshReader::surface_of(const tinygltf::Primitive& primitive, const std::string& label) {
    Surface surface;
    surface.material = checked_material(primitive.material, label);
    const auto positions = primitive.attributes.find("POSITION");
    if (positions == primitive.attributes.end())
        refuse(file_, format("{} has no POSITION; the file is broken, get it again", label));
    vertices_ += accessors_.count(positions->second, label + ": POSITION");
    if (vertices_ > kMostVertices) {
        refuse(file_,
               format("has more than {} million vertices; use a smaller model", kMostVertices / 1'000'000));
    }
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<size_t>(positions->second)];
    check_attribute_type(file_, accessor, "POSITION", label + ": POSITION");
    const std::vector<float> numbers = accessors_.floats(positions->second, 3, label + ": POSITION");
    check_bounds(file_, accessor, numbers, label + ": POSITION");
    surface.positions = to_vec3(numbers);
    surface.triangles = corners(primitive, surface, label);
    const VertexData data{
        .accessors = primitive.attributes, .vertices = surface.positions.size(), .label = label};
    surface.normals = to_vec3(attribute(data, "NORMAL", 3));
    for (Vec3& normal : surface.normals) normal = unit_or(normal, {0, 0, 1});
    if (surface.normals.empty()) surface.normals = vertex_normals(surface.positions, surface.triangles);
    add_uvs(surface, data);
    add_colours(surface, data);
    add_tangents(surface, data);
    return surface;
}

void MeshReader::add_node(int joint, const tinygltf::Node& node) {
    if (static_cast<size_t>(node.mesh) >= model_.meshes.size()) {
        refuse(file_, format("node \"{}\" has mesh {}, there are {}; the file is broken, get it again",
                             node.name, node.mesh, model_.meshes.size()));
    }
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<size_t>(node.mesh)];
    const std::string label =
        mesh.name.empty() ? format("mesh {}", node.mesh) : format("mesh \"{}\"", mesh.name);
    if (node.skin >= 0 && static_cast<size_t>(node.skin) >= context_.skins.size()) {
        refuse(file_, format("{} has skin {}, there are {}; the file is broken, get it again", label,
                             node.skin, context_.skins.size()));
    }
    size_t morphs = 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        morphs = std::max(morphs, primitive.targets.size());
        if (primitive.targets.size() != mesh.primitives.front().targets.size()) {
            refuse(
                file_,
                format(
                    "{} has a primitive with {} morph targets and one with {}, as many are needed; the file "
                    "is broken, get it again",
                    label, mesh.primitives.front().targets.size(), primitive.targets.size()));
        }
    }
    const size_t first_weight = set_.rest_morph_weights.size();
    if (first_weight + morphs > kMostMorphs)
        refuse(file_, format("has more than {} morph targets; use a smaller model", kMostMorphs));

    const MorphSet morph_set{.node = context_.nodes.node_of_joint[static_cast<size_t>(joint)],
                             .mesh = node.mesh,
                             .first = static_cast<int>(first_weight),
                             .morphs = static_cast<int>(morphs)};
    const std::vector<std::string> names = morph_names(file_, mesh, morph_set);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (!has_triangles(primitive.mode)) continue;
        Surface surface = surface_of(primitive, label);
        surface.name = mesh.name;
        surface.joint = joint;
        surface.skin = std::max(node.skin, -1);
        surface.first_morph_weight = static_cast<int>(first_weight);
        if (surface.skin >= 0) {
            if (!primitive.attributes.contains("JOINTS_0")) {
                refuse(
                    file_,
                    format(
                        "{} has skin {} and no JOINTS_0; write the file again with it, or without the skin",
                        label, surface.skin));
            }
            add_influences(
                surface,
                {.accessors = primitive.attributes, .vertices = surface.positions.size(), .label = label});
        }
        for (size_t m = 0; m < primitive.targets.size(); ++m) {
            surface.morphs.push_back(morph_of({.accessors = primitive.targets[m],
                                               .vertices = surface.positions.size(),
                                               .label = format("{}: morph \"{}\"", label, names[m])}));
            surface.morphs.back().name = names[m];
        }
        if (surface.triangles.empty()) continue;
        drop_unused_vertices(surface);
        set_.surfaces.push_back(std::move(surface));
    }

    add_rest_weights(node, mesh, morphs, label);
    set_.morph_sets.push_back(morph_set);
    set_.morph_names.insert(set_.morph_names.end(), names.begin(), names.end());
}

// The weights at rest: the node's own, else its mesh's, else none.
void MeshReader::add_rest_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh, size_t morphs,
                                  const std::string& label) {
    const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
    if (!weights.empty() && weights.size() != morphs) {
        refuse(
            file_,
            format(
                "{} has {} weights of morphs, its {} morph targets need as many; the file is broken, get it "
                "again",
                label, weights.size(), morphs));
    }
    for (size_t m = 0; m < morphs; ++m) {
        const float weight = m < weights.size() ? static_cast<float>(weights[m]) : 0.0f;
        if (!std::isfinite(weight))
            refuse(file_, format("{}: weight {} is not finite; repair the model", label, m));
        set_.rest_morph_weights.push_back(weight);
    }
}

MeshSet MeshReader::read() {
    for (size_t joint = 0; joint < context_.nodes.node_of_joint.size(); ++joint) {
        const tinygltf::Node& node = model_.nodes[static_cast<size_t>(context_.nodes.node_of_joint[joint])];
        if (node.mesh >= 0) add_node(static_cast<int>(joint), node);
    }
    return std::move(set_);
}

}  // namespace

std::vector<Vec3> vertex_normals(const std::vector<Vec3>& positions,
                                 const std::vector<std::uint32_t>& triangles) {
    std::vector<Vec3> normals(positions.size(), Vec3(0));
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        const Vec3& a = positions[triangles[t]];
        // As long as twice the triangle's area: the weight of its direction.
        const Vec3 normal = cross(positions[triangles[t + 1]] - a, positions[triangles[t + 2]] - a);
        for (size_t corner = t; corner < t + 3; ++corner) normals[triangles[corner]] += normal;
    }
    for (Vec3& normal : normals) normal = unit_or(normal, {0, 0, 1});
    return normals;
}

std::vector<Vec4> vertex_tangents(const Surface& surface) {
    const size_t vertices = surface.positions.size();
    std::vector<Vec3> along_u(vertices, Vec3(0)), along_v(vertices, Vec3(0));
    for (size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
        const std::uint32_t a = surface.triangles[t], b = surface.triangles[t + 1],
                            c = surface.triangles[t + 2];
        const Vec3 ab = surface.positions[b] - surface.positions[a],
                   ac = surface.positions[c] - surface.positions[a];
        const Vec2 ab_uv = surface.uvs[b] - surface.uvs[a], ac_uv = surface.uvs[c] - surface.uvs[a];
        const float area = ab_uv.x * ac_uv.y - ac_uv.x * ab_uv.y;
        if (std::abs(area) < 1e-20f) continue;
        const Vec3 u = (ab * ac_uv.y - ac * ab_uv.y) / area;
        const Vec3 v = (ac * ab_uv.x - ab * ac_uv.x) / area;
        for (const std::uint32_t corner : {a, b, c}) {
            along_u[corner] += u;
            along_v[corner] += v;
        }
    }
    std::vector<Vec4> tangents;
    tangents.reserve(vertices);
    for (size_t i = 0; i < vertices; ++i) {
        const Vec3& normal = surface.normals[i];
        const Vec3 any = std::abs(normal.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
        const Vec3 fallback = normalize(any - normal * dot(normal, any));
        const Vec3 tangent = unit_or(along_u[i] - normal * dot(normal, along_u[i]), fallback);
        // glTF's bitangent is cross(normal, tangent) * w and points to smaller image rows, that is to smaller
        // v.
        const float side = dot(cross(normal, tangent), along_v[i]);
        tangents.emplace_back(tangent, side > 0 ? -1.0f : 1.0f);
    }
    return tangents;
}

// Whether most triangles show their backs where the normals say outside.
bool winds_against_normals(const Surface& surface) {
    size_t against = 0;
    for (size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
        const auto corner = [&](size_t c) { return surface.positions[surface.triangles[t + c]]; };
        const Vec3 front = cross(corner(1) - corner(0), corner(2) - corner(0));
        if (dot(front, surface.normals[surface.triangles[t]]) < 0) ++against;
    }
    return against > surface.triangles.size() / 6;
}

void turn_mirrored_triangles(std::vector<Surface>& surfaces, const Skeleton& skeleton,
                             const std::vector<Skin>& skins) {
    const std::vector<Mat4> world_from_joint = world_from_joints(skeleton, rest_transforms(skeleton));
    const auto mirrors = [](const Mat4& matrix) { return glm::determinant(Mat3(matrix)) < 0; };
    for (Surface& surface : surfaces) {
        const Mat4& world_from_node = world_from_joint[static_cast<size_t>(surface.joint)];
        Mat4 world_from_mesh = world_from_node;
        if (surface.skin >= 0) {
            const Skin& skin = skins[static_cast<size_t>(surface.skin)];
            const size_t first = surface.influences.front().joint;
            world_from_mesh =
                world_from_joint[static_cast<size_t>(skin.joints[first])] * skin.joint_from_mesh[first];
        }
        // Blender writes a skinned mesh below a mirrored node as it stands, with its corners in the mirrored order.
        const bool inside_out = mirrors(world_from_node) && winds_against_normals(surface);
        if (mirrors(world_from_mesh) == inside_out) continue;
        for (size_t t = 0; t + 2 < surface.triangles.size(); t += 3)
            std::swap(surface.triangles[t + 1], surface.triangles[t + 2]);
    }
}

MeshSet read_meshes(Accessors& accessors, const tinygltf::Model& model, const MeshContext& context) {
    return MeshReader(accessors, model, context).read();
}

}  // namespace chironomia
