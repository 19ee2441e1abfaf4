#include "tests/skinning/gltf/made_figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/math.h"

namespace chironomia::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Bone {
    const char* name;
    int parent;
    Vec3 from_parent;
    Vec3 beyond{0};  // how far the body goes on behind the joint, of those at an end
};

const std::vector<Bone> kBones = {{"Hips", -1, {0, 1, 0}},
                                  {"Spine", 0, {0, 0.2f, 0}},
                                  {"Neck", 1, {0, 0.3f, 0}},
                                  {"Head", 2, {0, 0.05f, 0}, {0, 0.2f, 0}},
                                  {"LeftArm", 1, {0.2f, 0.25f, 0}},
                                  {"LeftForeArm", 4, {0.25f, 0, 0}},
                                  {"LeftHand", 5, {0.25f, 0, 0}, {0.1f, 0, 0}},
                                  {"RightArm", 1, {-0.2f, 0.25f, 0}},
                                  {"RightForeArm", 7, {-0.25f, 0, 0}},
                                  {"RightHand", 8, {-0.25f, 0, 0}, {-0.1f, 0, 0}},
                                  {"LeftUpLeg", 0, {0.1f, 0, 0}},
                                  {"LeftLeg", 10, {0, -0.5f, 0}},
                                  {"LeftFoot", 11, {0, -0.45f, 0}},
                                  {"LeftToeBase", 12, {0, -0.02f, 0.12f}, {0, 0, 0.05f}},
                                  {"RightUpLeg", 0, {-0.1f, 0, 0}},
                                  {"RightLeg", 14, {0, -0.5f, 0}},
                                  {"RightFoot", 15, {0, -0.45f, 0}},
                                  {"RightToeBase", 16, {0, -0.02f, 0.12f}, {0, 0, 0.05f}}};

constexpr float kThick = 0.03f;  // half the side of a box [m]
constexpr float kQuantum = 2;    // the position that a normalized 1 stands for [m]
constexpr int kFloat = 5126;

Vec3 place_of(int bone) {
    Vec3 place(0);
    for (; bone >= 0; bone = kBones[static_cast<size_t>(bone)].parent)
        place += kBones[static_cast<size_t>(bone)].from_parent;
    return place;
}

// The vertices of the figure, (V, ...).
struct Body {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Vec2> uvs;
    std::vector<int> joints;     // (V, 2)
    std::vector<float> weights;  // (V, 2)
    std::vector<Vec3> smile;     // how the morph moves each
    std::vector<std::uint32_t> corners;
};

// A box from a to b; what is near to a is moved by the first joint, what is near to b by both.
void add_box(Body& body, const Vec3& a, const Vec3& b, int first, int second) {
    const Vec3 low = glm::min(a, b) - kThick, high = glm::max(a, b) + kThick;
    const auto begin = static_cast<std::uint32_t>(body.positions.size());
    for (int corner = 0; corner < 8; ++corner) {
        const bool x = corner & 1, y = corner & 2, z = corner & 4;
        const Vec3 place(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
        const bool far = distance(place, b) < distance(place, a);
        body.positions.push_back(place);
        body.normals.push_back(normalize(Vec3(x ? 1 : -1, y ? 1 : -1, z ? 1 : -1)));
        body.uvs.emplace_back(x ? 1.0f : 0.0f, y != z ? 1.0f : 0.0f);
        body.joints.insert(body.joints.end(), {first, second});
        body.weights.insert(body.weights.end(), {far ? 0.5f : 1.0f, far ? 0.5f : 0.0f});
        body.smile.push_back(first == 3 && z ? Vec3(0, 0, 0.01f) : Vec3(0));
    }
    for (const std::uint32_t corner : {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5})
        body.corners.push_back(begin + corner);
}

Body make_body() {
    Body body;
    for (int bone = 0; bone < static_cast<int>(kBones.size()); ++bone) {
        const Bone& one = kBones[static_cast<size_t>(bone)];
        if (one.parent >= 0) add_box(body, place_of(one.parent), place_of(bone), one.parent, bone);
        if (one.beyond != Vec3(0))
            add_box(body, place_of(bone), place_of(bone) + one.beyond, bone, one.parent);
    }
    return body;
}

// Numbers as they are stored: floats as they are, shares as normalized whole numbers.
template <typename Stored>
Bytes stored(const std::vector<float>& numbers, float largest) {
    std::vector<Stored> result;
    for (const float number : numbers) result.push_back(static_cast<Stored>(std::lround(number * largest)));
    return GltfBuilder::bytes_of(result);
}

Bytes stored_as(int type, const std::vector<float>& numbers, bool is_share) {
    if (type == 5121) return stored<std::uint8_t>(numbers, is_share ? 255.0f : 1.0f);
    if (type == 5122) return stored<std::int16_t>(numbers, 32767.0f);
    if (type == 5123) return stored<std::uint16_t>(numbers, is_share ? 65535.0f : 1.0f);
    if (type == 5125) return stored<std::uint32_t>(numbers, 1.0f);
    return GltfBuilder::bytes_of(numbers);
}

// An attribute on its way into buffer views.
struct Attribute {
    std::string name;
    std::string type;
    int component = kFloat;
    bool normalized = false;
    Bytes bytes;  // packed

    size_t width(size_t vertices) const { return bytes.size() / vertices; }
};

class FigureWriter {
  public:
    explicit FigureWriter(const FigureForm& form) : form_(form), body_(make_body()) {}

    GltfBuilder write() {
        if (form_.index_type == 0) unshare_vertices();
        add_nodes();
        gather();
        add_mesh();
        add_skin();
        if (form_.textured) add_material();
        return std::move(file_);
    }

  private:
    size_t vertices() const { return body_.positions.size(); }

    void add_nodes() {
        Json& nodes = file_.json["nodes"] = Json::array();
        for (const Bone& bone : kBones) {
            Json node = {{"name", std::string("mixamorig:") + bone.name}};
            const Vec3& t = bone.from_parent;
            if (form_.matrices) {
                node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, t.x, t.y, t.z, 1};
            } else {
                node["translation"] = {t.x, t.y, t.z};
            }
            if (bone.parent >= 0) nodes[static_cast<size_t>(bone.parent)]["children"].push_back(nodes.size());
            nodes.push_back(std::move(node));
        }
        nodes.push_back({{"name", "Body"}, {"mesh", 0}, {"skin", 0}});
        file_.json["scenes"] = Json::array({{{"nodes", {0, kBones.size()}}}});
        file_.json["scene"] = 0;
    }

    static std::vector<float> flat(const std::vector<Vec3>& vectors) {
        std::vector<float> numbers;
        for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
        return numbers;
    }

    void gather() {
        std::vector<float> positions = flat(body_.positions), uvs, joints, weights, more_joints, more_weights;
        for (const Vec2& uv : body_.uvs) uvs.insert(uvs.end(), {uv.x, uv.y});
        for (size_t v = 0; v < vertices(); ++v) {
            const auto first = static_cast<float>(body_.joints[2 * v]);
            const auto second = static_cast<float>(std::max(body_.joints[2 * v + 1], 0));
            const float most = form_.weight_sum * body_.weights[2 * v];
            const float share = form_.weight_sum * body_.weights[2 * v + 1];
            const float again = form_.weights_twice ? 1 : 0;
            // The second influence may stand in a set of its own.
            joints.insert(joints.end(),
                          {first, form_.second_set ? 0 : second, again * first, again * second});
            weights.insert(weights.end(), {most, form_.second_set ? 0 : share, again * most, again * share});
            more_joints.insert(more_joints.end(), {second, 0, 0, 0});
            more_weights.insert(more_weights.end(), {share, 0, 0, 0});
        }
        if (form_.quantized) {
            for (float& number : positions) number /= kQuantum;
            file_.json["extensionsUsed"] = {"KHR_mesh_quantization"};
            file_.json["extensionsRequired"] = {"KHR_mesh_quantization"};
        }
        add("POSITION", "VEC3", form_.quantized ? 5122 : kFloat, true, positions);
        if (form_.has_normals) add("NORMAL", "VEC3", kFloat, false, flat(body_.normals));
        for (int set = 0; set <= form_.uv_set; ++set)
            add("TEXCOORD_" + std::to_string(set), "VEC2", form_.uv_type, true, uvs);
        add("JOINTS_0", "VEC4", form_.joint_type, false, joints);
        add("WEIGHTS_0", "VEC4", form_.weight_type, true, weights);
        if (!form_.second_set) return;
        add("JOINTS_1", "VEC4", form_.joint_type, false, more_joints);
        add("WEIGHTS_1", "VEC4", form_.weight_type, true, more_weights);
    }

    void add(const std::string& name, const std::string& type, int component, bool is_share,
             const std::vector<float>& numbers) {
        Attribute attribute{.name = name,
                            .type = type,
                            .component = component,
                            .normalized = is_share && component != kFloat,
                            .bytes = stored_as(component, numbers, is_share)};
        if (form_.quantized && name == "POSITION") pad(attribute, 8);
        if (attribute.width(vertices()) % 4 != 0) pad(attribute, 4);
        attributes_.push_back(std::move(attribute));
    }

    // Each element gets so many bytes: elements of attributes begin at multiples of 4.
    void pad(Attribute& attribute, size_t width) {
        const size_t old = attribute.width(vertices());
        Bytes padded;
        for (size_t v = 0; v < vertices(); ++v) {
            padded.insert(padded.end(), &attribute.bytes[v * old], &attribute.bytes[v * old] + old);
            padded.resize((v + 1) * width);
        }
        attribute.bytes = std::move(padded);
        stride_of_[attribute.name] = static_cast<int>(width);
    }

    Json placed_attributes() {
        Json places;
        Bytes together;
        const size_t room = 8;  // bytes between vertices
        size_t stride = room;
        for (const Attribute& attribute : attributes_) stride += attribute.width(vertices());
        if (form_.interleaved) {
            for (size_t v = 0; v < vertices(); ++v) {
                for (const Attribute& attribute : attributes_) {
                    const size_t width = attribute.width(vertices());
                    together.insert(together.end(), &attribute.bytes[v * width],
                                    &attribute.bytes[v * width] + width);
                }
                together.resize((v + 1) * stride, 0xAA);
            }
            const int view = file_.view(together, static_cast<int>(stride));
            size_t offset = 0;
            for (const Attribute& attribute : attributes_) {
                places[attribute.name] = place(attribute, view, offset);
                offset += attribute.width(vertices());
            }
            return places;
        }
        for (const Attribute& attribute : attributes_) {
            // What stands before and behind is not meant by the accessor.
            Bytes bytes(form_.offsets ? 12 : 0, 0xAA);
            bytes.insert(bytes.end(), attribute.bytes.begin(), attribute.bytes.end());
            bytes.resize(bytes.size() + 16, 0xAA);
            const auto stride_found = stride_of_.find(attribute.name);
            const int view = file_.view(bytes, stride_found == stride_of_.end() ? 0 : stride_found->second);
            places[attribute.name] = place(attribute, view, form_.offsets ? 12 : 0);
        }
        return places;
    }

    int place(const Attribute& attribute, int view, size_t offset) {
        const int accessor = file_.accessor_in(view, attribute.component, attribute.type, vertices(), offset);
        Json& written = file_.json["accessors"].back();
        if (attribute.normalized) written["normalized"] = true;
        if (attribute.name == "POSITION" && !form_.quantized) {
            Vec3 low = body_.positions.front(), high = low;
            for (const Vec3& p : body_.positions) low = glm::min(low, p), high = glm::max(high, p);
            written["min"] = {low.x, low.y, low.z};
            written["max"] = {high.x, high.y, high.z};
            if (form_.sparse) make_sparse(accessor);
        }
        return accessor;
    }

    // Every seventh position is wrong where it stands, and right in the sparse part.
    void make_sparse(int accessor) {
        std::vector<std::uint16_t> indices;
        std::vector<float> values;
        const Json& written = file_.json["accessors"][static_cast<size_t>(accessor)];
        const Json& view = file_.json["bufferViews"][written["bufferView"].get<size_t>()];
        const size_t begin = view["byteOffset"].get<size_t>() + written["byteOffset"].get<size_t>();
        const size_t stride = view.value("byteStride", size_t{12});
        for (size_t v = 0; v < vertices(); v += 7) {
            indices.push_back(static_cast<std::uint16_t>(v));
            const Vec3& p = body_.positions[v];
            values.insert(values.end(), {p.x, p.y, p.z});
            std::fill_n(file_.binary.begin() + static_cast<std::ptrdiff_t>(begin + v * stride), 12, 0);
        }
        const int at = file_.view(GltfBuilder::bytes_of(indices)),
                  from = file_.view(GltfBuilder::bytes_of(values));
        file_.json["accessors"][static_cast<size_t>(accessor)]["sparse"] = {
            {"count", indices.size()},
            {"indices", {{"bufferView", at}, {"componentType", 5123}}},
            {"values", {{"bufferView", from}}}};
    }

    void add_mesh() {
        const Json attributes = placed_attributes();
        std::vector<float> moves = flat(body_.smile);
        for (float& number : moves) number /= form_.quantized ? kQuantum : 1;
        const int smile = file_.accessor(moves, "VEC3");
        Json primitives = Json::array();
        const size_t triangles = body_.corners.size() / 3,
                     parts = form_.index_type == 0 ? 1 : static_cast<size_t>(form_.primitives);
        for (size_t part = 0; part < parts; ++part) {
            Json primitive = {{"attributes", attributes}, {"targets", Json::array({{{"POSITION", smile}}})}};
            if (form_.textured) primitive["material"] = 0;
            if (form_.index_type != 0) {
                const size_t first = triangles * part / parts * 3, last = triangles * (part + 1) / parts * 3;
                std::vector<float> corners(body_.corners.begin() + static_cast<std::ptrdiff_t>(first),
                                           body_.corners.begin() + static_cast<std::ptrdiff_t>(last));
                const int view = file_.view(stored_as(form_.index_type, corners, false));
                primitive["indices"] = file_.accessor_in(view, form_.index_type, "SCALAR", corners.size());
            }
            primitives.push_back(std::move(primitive));
        }
        file_.json["meshes"] = Json::array({{{"name", "Body"},
                                             {"primitives", primitives},
                                             {"weights", {0}},
                                             {"extras", {{"targetNames", {"smile"}}}}}});
    }

    // A vertex for each corner, as without indices.
    void unshare_vertices() {
        Body whole;
        for (const std::uint32_t v : body_.corners) {
            whole.corners.push_back(static_cast<std::uint32_t>(whole.positions.size()));
            whole.positions.push_back(body_.positions[v]);
            whole.normals.push_back(body_.normals[v]);
            whole.uvs.push_back(body_.uvs[v]);
            whole.smile.push_back(body_.smile[v]);
            whole.joints.insert(whole.joints.end(), {body_.joints[2 * v], body_.joints[2 * v + 1]});
            whole.weights.insert(whole.weights.end(), {body_.weights[2 * v], body_.weights[2 * v + 1]});
        }
        body_ = std::move(whole);
    }

    void add_skin() {
        Json skin = {{"name", "Skeleton"}, {"joints", Json::array()}};
        std::vector<float> matrices;
        for (size_t bone = 0; bone < kBones.size(); ++bone) {
            skin["joints"].push_back(bone);
            const Vec3 back = -place_of(static_cast<int>(bone));
            const float s = form_.quantized ? kQuantum : 1;
            matrices.insert(matrices.end(), {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, back.x, back.y, back.z, 1});
        }
        skin["inverseBindMatrices"] = file_.accessor(matrices, "MAT4");
        file_.json["skins"] = Json::array({skin});
    }

    void add_material() {
        const int picture = file_.view(png_file(4, 8, 3, Bytes(48, 99)));
        file_.json["images"] = Json::array({{{"bufferView", picture}, {"mimeType", "image/png"}}});
        file_.json["samplers"] = Json::array({{{"wrapS", 33071}, {"magFilter", 9728}}});
        file_.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
        file_.json["materials"] =
            Json::array({{{"name", "Skin"},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.8, 0.6, 0.5, 1}},
                            {"metallicFactor", 0},
                            {"baseColorTexture", {{"index", 0}, {"texCoord", form_.uv_set}}}}}}});
    }

    FigureForm form_;
    Body body_;
    GltfBuilder file_;
    std::vector<Attribute> attributes_;
    std::map<std::string, int> stride_of_;  // of attributes with room between their elements
};

// Each kind of choice with what makes it.
const std::vector<std::pair<std::string, void (*)(FigureForm&)>> kChoices = {
    {"byte_indices", [](FigureForm& form) { form.index_type = 5121; }},
    {"long_indices", [](FigureForm& form) { form.index_type = 5125; }},
    {"no_indices", [](FigureForm& form) { form.index_type = 0; }},
    {"short_joints", [](FigureForm& form) { form.joint_type = 5123; }},
    {"byte_weights", [](FigureForm& form) { form.weight_type = 5121; }},
    {"short_weights", [](FigureForm& form) { form.weight_type = 5123; }},
    {"byte_uvs", [](FigureForm& form) { form.uv_type = 5121; }},
    {"short_uvs", [](FigureForm& form) { form.uv_type = 5123; }},
    {"second_uvs", [](FigureForm& form) { form.uv_set = 1; }},
    {"primitives", [](FigureForm& form) { form.primitives = 3; }},
    {"interleaved", [](FigureForm& form) { form.interleaved = true; }},
    {"offsets", [](FigureForm& form) { form.offsets = true; }},
    {"sparse", [](FigureForm& form) { form.sparse = true; }},
    {"quantized", [](FigureForm& form) { form.quantized = true; }},
    {"second_influences", [](FigureForm& form) { form.second_set = true; }},
    {"low_weights", [](FigureForm& form) { form.weight_sum = 0.4f; }},
    {"double_weights", [](FigureForm& form) { form.weights_twice = true; }},
    {"matrices", [](FigureForm& form) { form.matrices = true; }},
    {"no_material", [](FigureForm& form) { form.textured = false; }},
    {"no_normals", [](FigureForm& form) { form.has_normals = false; }},
    {"text", [](FigureForm& form) { form.as_text = true; }},
};

void choose(FigureForm& form, const std::string& kind) {
    for (const auto& [name, change] : kChoices) {
        if (name == kind) change(form);
    }
}

}  // namespace

GltfBuilder made_figure(const FigureForm& form) {
    return FigureWriter(form).write();
}

std::vector<std::string> figure_kinds() {
    std::vector<std::string> kinds;
    for (const auto& [kind, change] : kChoices) kinds.push_back(kind);
    return kinds;
}

FigureForm figure_of_kind(const std::string& kind) {
    FigureForm form;
    choose(form, kind);
    return form;
}

FigureForm figure_form(const std::string& kind, Random& random) {
    FigureForm form;
    // One in three of the other choices, and at last the one that is asked for.
    for (const std::string& other : figure_kinds()) {
        if (random.below(3) == 0) choose(form, other);
    }
    choose(form, kind);
    return form;
}

}  // namespace chironomia::testing
