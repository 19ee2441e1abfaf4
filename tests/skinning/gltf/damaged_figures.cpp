// Damage to a figure that can be drawn: each kind with what its refusal says.
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "tests/skinning/gltf/made_figures.h"

namespace chironomia::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Json& primitive_of(GltfBuilder& file) {
    return file.json["meshes"][0]["primitives"][0];
}

Json& accessor_named(GltfBuilder& file, const std::string& attribute) {
    return file.json["accessors"][primitive_of(file)["attributes"][attribute].get<size_t>()];
}

Json& matrices_of(GltfBuilder& file) {
    return file.json["accessors"][file.json["skins"][0]["inverseBindMatrices"].get<size_t>()];
}

Json& indices_of(GltfBuilder& file) {
    return file.json["accessors"][primitive_of(file)["indices"].get<size_t>()];
}

Json& view_of(GltfBuilder& file, const Json& accessor) {
    return file.json["bufferViews"][accessor["bufferView"].get<size_t>()];
}

std::uint8_t* bytes_at(GltfBuilder& file, const Json& accessor, size_t element, size_t width) {
    return &file.binary[view_of(file, accessor)["byteOffset"].get<size_t>() +
                        accessor["byteOffset"].get<size_t>() + element * width];
}

// The numbers of an element of floats.
void put(GltfBuilder& file, const Json& accessor, size_t element, const std::vector<float>& numbers) {
    std::memcpy(bytes_at(file, accessor, element, 4 * numbers.size()), numbers.data(), 4 * numbers.size());
}

size_t any_element(const Json& accessor, Random& random) {
    return random.below(accessor["count"].get<std::uint32_t>());
}

void put_anywhere(GltfBuilder& file, const Json& accessor, Random& random,
                  const std::vector<float>& numbers) {
    put(file, accessor, any_element(accessor, random), numbers);
}

size_t any_node(GltfBuilder& file, Random& random) {
    return random.below(static_cast<std::uint32_t>(file.json["nodes"].size()));
}

using Damage = void (*)(GltfBuilder&, Random&);

struct Kind {
    const char* name;
    const char* message;
    Damage damage;
};

const Kind kNumbers[] = {
    {"weight below 0", "has the weight -0.5, 0 to 1 is needed; repair the skin weights",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "WEIGHTS_0"), r, {1, -0.5f, 0, 0});
     }},
    {"weight of 2", "has the weight 2, 0 to 1 is needed",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "WEIGHTS_0"), r, {2, 0, 0, 0});
     }},
    {"no weight", "(its weights are 0); repair the skin weights",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "WEIGHTS_0"), r, {0, 0, 0, 0});
     }},
    {"weight not a number", "WEIGHTS_0 is nan at element",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "WEIGHTS_0"), r, {kNan, 0, 0, 0});
     }},
    {"inverse bind of zeros", "is flat (its axes span a volume of 0",
     [](auto& f, auto& r) { put_anywhere(f, matrices_of(f), r, std::vector<float>(16, 0.0f)); }},
    {"inverse bind of zeros but for its last number", "is flat (its axes span a volume of 0",
     [](auto& f, auto& r) {
         std::vector<float> matrix(16, 0.0f);
         matrix[15] = 1;
         put_anywhere(f, matrices_of(f), r, matrix);
     }},
    {"inverse bind with one axis twice", "is flat (its axes span a volume of 0",
     [](auto& f, auto& r) {
         put_anywhere(f, matrices_of(f), r, {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
     }},
    {"inverse bind with another last row", "has the last row 0 0 0.5 1, 0 0 0 1 is needed",
     [](auto& f, auto& r) {
         put_anywhere(f, matrices_of(f), r, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5f, 0, 0, 0, 1});
     }},
    {"inverse bind not a number", "inverseBindMatrices is nan at element",
     [](auto& f, auto& r) { put_anywhere(f, matrices_of(f), r, std::vector<float>(16, kNan)); }},
    {"position not a number", "POSITION is nan at element",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "POSITION"), r, {0, kNan, 0});
     }},
    {"infinite position", "POSITION is inf at element",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "POSITION"), r, {kInfinity, 0, 0});
     }},
    {"position far away", "POSITION reaches from ",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "POSITION"), r, {0, 1000, 0});
     }},
    {"normal not a number", "NORMAL is nan at element",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "NORMAL"), r, {0, kNan, 0});
     }},
    {"texture coordinate not a number", "TEXCOORD_0 is nan at element",
     [](auto& f, auto& r) {
         put_anywhere(f, accessor_named(f, "TEXCOORD_0"), r, {0, kNan});
     }},
    {"index out of range", "and 176 vertices; the file is broken",
     [](auto& f, auto& r) {
         Json& indices = indices_of(f);
         const size_t width = indices["componentType"] == 5125 ? 4 : indices["componentType"] == 5123 ? 2 : 1;
         *bytes_at(f, indices, any_element(indices, r), width) = 200;
     }},
    {"joint out of range", "is moved by joint 99, its skin has 18",
     [](auto& f, auto& r) {
         Json& joints = accessor_named(f, "JOINTS_0");
         *bytes_at(f, joints, any_element(joints, r), joints["componentType"] == 5123 ? 8 : 4) = 99;
     }},
};

const Kind kAccessors[] = {
    {"count too large", "elements of 12 bytes from byte 0 on, and buffer view",
     [](auto& f, auto&) {
         for (Json& accessor : f.json["accessors"])
             if (accessor["count"] == 176) accessor["count"] = 180;
     }},
    {"counts that differ", "its 176 positions need as many",
     [](auto& f, auto& r) { accessor_named(f, "NORMAL")["count"] = r.below(176); }},
    {"corners that are no triangles", "corners of triangles, a multiple of 3 is needed",
     [](auto& f, auto& r) { indices_of(f)["count"] = 3 * r.below(60) + 1; }},
    {"too few matrices", "matrices, its 18 joints need as many",
     [](auto& f, auto& r) { matrices_of(f)["count"] = 1 + r.below(17); }},
    {"accessor that begins late", "elements of 12 bytes from byte 400 on, and buffer view",
     [](auto& f, auto&) { accessor_named(f, "POSITION")["byteOffset"] = 400; }},
    {"accessor that begins at another number", "its accessor says from",
     [](auto& f, auto& r) { accessor_named(f, "POSITION")["byteOffset"] = 4 + 4 * r.below(2); }},
    {"accessor that begins within a number", "and begins at byte ",
     [](auto& f, auto& r) { accessor_named(f, "POSITION")["byteOffset"] = 1 + r.below(3); }},
    {"offset below 0", "its byteOffset is -4, a whole number from 0 to",
     [](auto& f, auto&) { accessor_named(f, "POSITION")["byteOffset"] = -4; }},
    {"stride too small", "has elements of 12 bytes, 8 apart",
     [](auto& f, auto&) { view_of(f, accessor_named(f, "POSITION"))["byteStride"] = 8; }},
    {"stride too large", "elements of 12 bytes from byte 0 on, and buffer view",
     [](auto& f, auto& r) {
         view_of(f, accessor_named(f, "POSITION"))["byteStride"] = 16 + 4 * r.below(20);
     }},
    {"stride within a number", "`byteStride' must be the multiple of 4 : 13",
     [](auto& f, auto&) { view_of(f, accessor_named(f, "NORMAL"))["byteStride"] = 13; }},
    {"positions as shorts", "POSITION has components of type 5123; floats (5126) are needed",
     [](auto& f, auto&) { accessor_named(f, "POSITION")["componentType"] = 5123; }},
    {"weights as bytes", "WEIGHTS_0 has components of type 5121; floats (5126) or normalized bytes",
     [](auto& f, auto&) { accessor_named(f, "WEIGHTS_0")["componentType"] = 5121; }},
    {"texture coordinates as signed shorts",
     "TEXCOORD_0 has components of type 5122; floats (5126) or normalized",
     [](auto& f, auto&) { accessor_named(f, "TEXCOORD_0")["componentType"] = 5122; }},
    {"joints as floats", "JOINTS_0 has components of type 5126, unsigned integers are needed",
     [](auto& f, auto&) {
         primitive_of(f)["attributes"]["JOINTS_0"] = primitive_of(f)["attributes"]["WEIGHTS_0"];
     }},
    {"indices as floats", "its indices has components of type 5126, unsigned integers are needed",
     [](auto& f, auto&) { indices_of(f)["componentType"] = 5126; }},
    {"positions of two numbers", "POSITION has 2 components of type 5126, 3 are needed",
     [](auto& f, auto&) { accessor_named(f, "POSITION")["type"] = "VEC2"; }},
    {"bounds of another model", "its accessor says from",
     [](auto& f, auto&) {
         accessor_named(f, "POSITION")["max"] = {100, 180, 20};
     }},
    {"view beyond its buffer", "which ends at byte",
     [](auto& f, auto&) { view_of(f, accessor_named(f, "POSITION"))["byteLength"] = 1'000'000; }},
    {"view of no buffer", "is in buffer 4, there are 1",
     [](auto& f, auto&) { view_of(f, accessor_named(f, "POSITION"))["buffer"] = 4; }},
    {"accessor of no view", "is in buffer view 99, there are",
     [](auto& f, auto&) { accessor_named(f, "NORMAL")["bufferView"] = 99; }},
    {"sparse part that does not ascend", "and they are to ascend",
     [](auto& f, auto&) {
         const int at = f.view(GltfBuilder::bytes_of(std::vector<std::uint16_t>{5, 5}));
         const int from = f.view(GltfBuilder::bytes_of(std::vector<float>(6, 0.1f)));
         accessor_named(f, "NORMAL")["sparse"] = {{"count", 2},
                                                  {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                                  {"values", {{"bufferView", from}}}};
     }},
    {"sparse part out of range", "NORMAL replaces element 999 of 176",
     [](auto& f, auto&) {
         const int at = f.view(GltfBuilder::bytes_of(std::vector<std::uint16_t>{999}));
         const int from = f.view(GltfBuilder::bytes_of(std::vector<float>(3, 0.1f)));
         accessor_named(f, "NORMAL")["sparse"] = {{"count", 1},
                                                  {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                                  {"values", {{"bufferView", from}}}};
     }},
    {"sparse part of less than nothing", "its sparse part: its count is -1",
     [](auto& f, auto&) {
         accessor_named(f, "NORMAL")["sparse"] = {{"count", -1},
                                                  {"indices", {{"bufferView", 0}, {"componentType", 5123}}},
                                                  {"values", {{"bufferView", 0}}}};
     }},
};

const Kind kStructure[] = {
    {"missing accessor", "POSITION is accessor 999, there are",
     [](auto& f, auto&) { primitive_of(f)["attributes"]["POSITION"] = 999; }},
    {"accessor below 0", "the accessor of NORMAL is -1, a whole number",
     [](auto& f, auto&) { primitive_of(f)["attributes"]["NORMAL"] = -1; }},
    {"skin of fewer joints", "is moved by joint",
     [](auto& f, auto& r) {
         Json& joints = f.json["skins"][0]["joints"];
         for (auto kept = 1 + r.below(17); joints.size() > kept;) joints.erase(joints.size() - 1);
     }},
    {"joint that is no node", "has joint node 99, there are 19 nodes",
     [](auto& f, auto& r) { f.json["skins"][0]["joints"][r.below(18)] = 99; }},
    {"joint outside the scene", "is not in the scene; write the file again with it",
     [](auto& f, auto&) {
         f.json["nodes"].push_back({{"name", "lost"}});
         f.json["skins"][0]["joints"][5] = 19;
     }},
    {"joints that are missing", "has skin 0 and no JOINTS_0",
     [](auto& f, auto&) { primitive_of(f)["attributes"].erase("JOINTS_0"); }},
    {"weights that are missing", "has JOINTS_0 without WEIGHTS_0",
     [](auto& f, auto&) { primitive_of(f)["attributes"].erase("WEIGHTS_0"); }},
    {"skin that is missing", "has skin 3, there are 1",
     [](auto& f, auto&) { f.json["nodes"][18]["skin"] = 3; }},
    {"mesh that is missing", "has mesh 7, there are 1",
     [](auto& f, auto&) { f.json["nodes"][18]["mesh"] = 7; }},
    {"mesh by a fraction", "its mesh is 0.5, a whole number",
     [](auto& f, auto&) { f.json["nodes"][18]["mesh"] = 0.5; }},
    {"circle of nodes", "has two parents or is its own ancestor",
     [](auto& f, auto& r) {
         f.json["nodes"][13]["children"] = {std::vector<int>{0, 10, 11, 12}[r.below(4)]};
     }},
    {"circle of nodes outside the scene", "has two parents or is its own ancestor",
     [](auto& f, auto&) {
         f.json["nodes"].push_back({{"children", {20}}});
         f.json["nodes"].push_back({{"children", {19}}});
     }},
    {"node that is its own child", "has two parents or is its own ancestor",
     [](auto& f, auto&) {
         f.json["nodes"].push_back({{"children", {19}}});
     }},
    {"child that is missing", "a node has child 77, there are 19 nodes",
     [](auto& f, auto&) { f.json["nodes"][9]["children"] = {77}; }},
    {"scene that is missing", "its scene is 3, there are 1", [](auto& f, auto&) { f.json["scene"] = 3; }},
    {"root that is missing", "its scene has node 50, there are 19",
     [](auto& f, auto&) { f.json["scenes"][0]["nodes"].push_back(50); }},
    {"turn that is none", "its rotation has length 0, 1 is needed",
     [](auto& f, auto& r) {
         f.json["nodes"][any_node(f, r)]["rotation"] = {0, 0, 0, 0};
     }},
    {"turn of a word", "a number of its rotation is \"x\"",
     [](auto& f, auto& r) {
         f.json["nodes"][any_node(f, r)]["rotation"] = {0, 0, "x", 1};
     }},
    {"scale of two numbers", "its scale has 2 numbers, 3 are needed",
     [](auto& f, auto& r) {
         f.json["nodes"][any_node(f, r)]["scale"] = {1, 1};
     }},
    {"infinite place", "a number from",
     [](auto& f, auto& r) {
         f.json["nodes"][any_node(f, r)]["translation"] = {0, 1e300, 0};
     }},
    {"sheared matrix", "its matrix is sheared",
     [](auto& f, auto& r) {
         f.json["nodes"][any_node(f, r)]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
     }},
    {"morphs without names for weights", "has 3 weights of morphs, its 1 morph targets need as many",
     [](auto& f, auto&) {
         f.json["meshes"][0]["weights"] = {0, 0, 0};
     }},
    {"primitives of other morphs", "and one with 0, as many are needed",
     [](auto& f, auto&) {
         Json other = primitive_of(f);
         other.erase("targets");
         f.json["meshes"][0]["primitives"].push_back(other);
     }},
    {"kind of primitive that is none", "its mode is 7, one of 0, 1, 2",
     [](auto& f, auto&) { primitive_of(f)["mode"] = 7; }},
    {"no triangles", "has no triangles in its scene", [](auto& f, auto&) { primitive_of(f)["mode"] = 0; }},
};

const Kind kMaterials[] = {
    {"texture set that is missing", "its material \"Skin\" reads TEXCOORD_7, which it lacks",
     [](auto& f, auto&) {
         f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 7;
     }},
    {"texture set below 0", "a texture: its texCoord is -1, a whole number",
     [](auto& f, auto&) {
         f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = -1;
     }},
    {"texture that is missing", "has texture 4, there are 1",
     [](auto& f, auto&) { f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 4; }},
    {"sampler that is missing", "has sampler 9, there are 1",
     [](auto& f, auto&) { f.json["textures"][0]["sampler"] = 9; }},
    {"image that is missing", "a texture has image 3, there are 1",
     [](auto& f, auto&) { f.json["textures"][0]["source"] = 3; }},
    {"material that is missing", "has material 5, there are 1",
     [](auto& f, auto&) { primitive_of(f)["material"] = 5; }},
    {"colour above 1", "a number of its baseColorFactor is 2.0, a number from 0 to 1",
     [](auto& f, auto& r) {
         f.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][r.below(4)] = 2.0;
     }},
    {"colour of three numbers", "its baseColorFactor has 3 numbers, 4 are needed",
     [](auto& f, auto&) {
         f.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
     }},
    {"roughness below 0", "its roughnessFactor is -1, a number from 0 to 1",
     [](auto& f, auto&) { f.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = -1; }},
    {"anisotropy above 1", "its anisotropyStrength is 2, a number from 0 to 1",
     [](auto& f, auto&) {
         f.json["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 2;
     }},
    {"specular above 1", "its specularFactor is 3, a number from 0 to 1",
     [](auto& f, auto&) {
         f.json["materials"][0]["extensions"]["KHR_materials_specular"]["specularFactor"] = 3;
     }},
    {"specular colour below 0", "a number of its specularColorFactor is -1",
     [](auto& f, auto&) {
         f.json["materials"][0]["extensions"]["KHR_materials_specular"]["specularColorFactor"] = {1, -1, 1};
     }},
    {"transmission above 1", "its transmissionFactor is 3, a number from 0 to 1",
     [](auto& f, auto&) {
         f.json["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 3;
     }},
    {"index of refraction below 0", "its ior is -1",
     [](auto& f, auto&) { f.json["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = -1; }},
    {"alpha that is none", "its alphaMode is \"GLASS\", one of \"OPAQUE\", \"MASK\", \"BLEND\"",
     [](auto& f, auto&) { f.json["materials"][0]["alphaMode"] = "GLASS"; }},
    {"wrapping that is none", "its wrapS is 1, one of 33071",
     [](auto& f, auto&) { f.json["samplers"][0]["wrapS"] = 1; }},
    {"image that is cut off", "cannot be decoded; it is cut off or broken",
     [](auto& f, auto&) {
         view_of(f, Json{{"bufferView", f.json["images"][0]["bufferView"]}})["byteLength"] = 70;
     }},
    {"image that is none", "is neither PNG nor JPEG nor WebP",
     [](auto& f, auto&) { f.json["images"][0]["bufferView"] = 0; }},
};

std::vector<Kind> all_kinds() {
    std::vector<Kind> kinds;
    for (const auto& list : {std::span<const Kind>(kNumbers), std::span<const Kind>(kAccessors),
                             std::span<const Kind>(kStructure), std::span<const Kind>(kMaterials)})
        kinds.insert(kinds.end(), list.begin(), list.end());
    return kinds;
}

}  // namespace

std::vector<DamagedFigure> damaged_figures(size_t count, std::uint64_t seed) {
    const std::vector<Kind> kinds = all_kinds();
    std::vector<DamagedFigure> figures;
    for (size_t n = 0; n < count; ++n) {
        const Kind& kind = kinds[n % kinds.size()];
        Random random(seed, n);
        const FigureForm form = {.index_type = std::vector<int>{5121, 5123, 5125}[random.below(3)],
                                 .joint_type = std::vector<int>{5121, 5123}[random.below(2)]};
        GltfBuilder file = made_figure(form);
        kind.damage(file, random);
        figures.push_back({.kind = kind.name, .message = kind.message, .glb = file.glb()});
    }
    return figures;
}

}  // namespace chironomia::testing
