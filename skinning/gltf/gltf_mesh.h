// The meshes of a glTF scene as surfaces.
#pragma once

#include "core/body/avatar.h"
#include "skinning/gltf/gltf_accessor.h"
#include "skinning/gltf/gltf_material.h"
#include "skinning/gltf/gltf_nodes.h"

namespace chironomia {

// What the surfaces of a scene refer to.
struct MeshContext {
    const NodeTree& nodes;
    const MaterialSet& materials;
    const std::vector<Skin>& skins;
};

// The morphs of one node.
struct MorphSet {
    int node = -1;  // of the file
    int mesh = -1;  // of the file
    int first = 0;  // where its morphs begin in MeshSet::morph_names
    int morphs = 0;
};

struct MeshSet {
    std::vector<Surface> surfaces;
    std::vector<float> rest_morph_weights;
    std::vector<std::string> morph_names;
    std::vector<MorphSet> morph_sets;
    std::vector<std::string> notes;  // a mesh whose weights are far from normalised
};

// Strips and fans become triangles, weights are normalised, vertices that no triangle uses are left out, and
// texture coordinates are transformed as their material says. Missing normals are the area-weighted means of
// the triangles at a vertex; missing tangents are derived where the material has a normal map
// or is anisotropic.
// Throws Error if an index is out of range, a number is not finite, a vertex has no weight at all, and for what
// gltf_checks.h lists.
MeshSet read_meshes(Accessors& accessors, const tinygltf::Model& model, const MeshContext& context);

// A surface that its matrices mirror at rest shows its inside: turns its triangles round, so that they are
// counter-clockwise outside wherever they are drawn.
void turn_mirrored_triangles(std::vector<Surface>& surfaces, const Skeleton& skeleton,
                             const std::vector<Skin>& skins);

// Area-weighted mean of the normals of the triangles around each vertex, (V) unit.
std::vector<Vec3> vertex_normals(const std::vector<Vec3>& positions,
                                 const std::vector<std::uint32_t>& triangles);

// Tangents along growing u, at right angles to the normals, w = handedness, (V).
// Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh": sums over the triangles of a
// vertex.
std::vector<Vec4> vertex_tangents(const Surface& surface);

}  // namespace chironomia
