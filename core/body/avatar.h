// A skinned figure: surfaces, materials, the skeleton that moves them, and which joint plays which human
// part.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/body/humanoid.h"
#include "core/body/skeleton.h"
#include "core/math.h"

namespace chironomia {

struct Image {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // (H, W, 4), top row first; sRGB or linear as the material's use says
};

// How a texture coordinate outside [0, 1] is read.
enum class Wrap { repeat, mirror, clamp };

struct Texture {
    int image = -1;  // index into Avatar::images; -1: none
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool smooth = true;  // linear filtering; false: nearest
};

enum class AlphaMode { opaque, mask, blend };

// glTF 2.0 metallic-roughness, and what skin and eyes need beyond it.
struct Material {
    std::string name;
    Vec4 base_colour{1};          // linear rgb and alpha, multiplies the texture
    Texture base_colour_texture;  // sRGB
    Texture normal_texture;       // linear, tangent space
    float normal_scale = 1;
    float metallic = 1;
    float roughness = 1;
    Texture metallic_roughness_texture;  // linear; green roughness, blue metallic
    Texture occlusion_texture;           // linear; red
    float occlusion_strength = 1;
    Vec3 emissive{0};          // linear
    Texture emissive_texture;  // sRGB
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  // for AlphaMode::mask
    bool double_sided = false;
    bool unlit = false;
    Vec3 reflectance{0.04f};  // straight on, where it is no metal, linear, in [0, 1]
    float coat = 0;           // how much of a clear, wet layer lies over it, in [0, 1]; eyes, and thinly skin
    float coat_roughness = 0;
    // How much rougher highlights are along a direction of the surface than across it, in [0, 1]; hair, brushed metal.
    // The direction turns from the tangent towards the bitangent.
    float anisotropy = 0;
    float anisotropy_turn = 0;   // [rad]
    Texture anisotropy_texture;  // linear; red and green that direction, blue multiplies `anisotropy`
    Vec3 scatter{0};        // how far red, green and blue light creep round into the shade, as cosines; skin
    bool in_mouth = false;  // teeth, gums and tongue: hidden at rest, seen where the mouth opens
};

struct Influence {
    std::uint32_t joint = 0;  // index into Skin::joints
    float weight = 0;         // the weights of a vertex sum to 1
};

struct Skin {
    std::string name;
    std::vector<int> joints;            // (S) indices into the avatar's skeleton
    std::vector<Mat4> joint_from_mesh;  // (S) inverse bind matrices
};

// A shape that is added to the rest shape with a weight; only the vertices it moves are listed.
struct Morph {
    std::string name;
    std::vector<std::uint32_t> vertices;  // (N) ascending
    std::vector<Vec3> moves;              // (N) [m, mesh]
    std::vector<Vec3> normal_moves;       // (N), or empty: the normals stay
};

// One primitive of a glTF mesh.
struct Surface {
    std::string name;                      // of its mesh
    int joint = -1;                        // the node that carries it, an index into the skeleton
    int skin = -1;                         // index into Avatar::skins; -1: moves rigidly with `joint`
    int material = -1;                     // index into Avatar::materials; -1: the default material
    int figure = 0;                        // which of the figures that were joined; 0 if there is only one
    std::vector<Vec3> positions;           // (V) [m, mesh]
    std::vector<Vec3> normals;             // (V) unit
    std::vector<Vec4> tangents;            // (V) unit xyz, w = +-1 handedness; or empty
    std::vector<Vec2> uvs;                 // (V) or empty
    std::vector<Vec4> colours;             // (V) linear rgba, or empty: white
    std::vector<std::uint32_t> triangles;  // (F, 3) counter-clockwise outside
    std::vector<std::uint32_t> first_influence;  // (V + 1) offsets into `influences`; empty without a skin
    std::vector<Influence> influences;           // any number a vertex
    std::vector<Morph> morphs;
    int first_morph_weight = 0;  // where the weights of `morphs` begin in Pose::morph_weights
};

// One share of an expression: a morph that it moves, and how far.
struct ExpressionBind {
    int morph = 0;     // index into Avatar::morph_names
    float weight = 1;  // of the morph where the expression is whole
};

// A mixture of morphs that a file names as one, as VRM files do.
struct Expression {
    std::string name;  // of VRM 1.0 ("happy", "blinkLeft"), or the file's own
    std::vector<ExpressionBind> binds;
};

struct Avatar {
    std::string source;                               // the file it came from
    std::vector<std::filesystem::path> companions{};  // files beside `source` that it was also read from
    // Every node of the file's scene, so that turned and scaled nodes above the hips count.
    Skeleton skeleton;
    HumanoidMap humanoid;
    std::vector<HumanoidMap> more_humanoids{};  // of the further figures, where several were joined
    std::vector<std::string> humanoid_notes;    // how the map was found and what is missing
    std::vector<std::string> warnings{};        // what of its file is left out
    std::vector<Skin> skins;
    std::vector<Surface> surfaces;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<float> rest_morph_weights;  // (M) of all nodes with morphs, one after the other
    std::vector<std::string> morph_names;   // (M)
    std::vector<Expression> expressions{};
};

// The posture of an avatar at one moment.
struct Pose {
    std::vector<Transform> joints;     // (J) parent_from_joint of Avatar::skeleton
    std::vector<float> morph_weights;  // (M)
};

// The surfaces of a posed avatar in the order of Avatar::surfaces, in the world.
struct PosedSurface {
    std::vector<Vec3> positions;  // (V) [m]
    std::vector<Vec3> normals;    // (V) unit
    std::vector<Vec4> tangents;   // (V) unit xyz, w = handedness; or empty
};

struct PosedMesh {
    std::vector<PosedSurface> surfaces;
};

}  // namespace chironomia
