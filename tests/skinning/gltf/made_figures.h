// Avatars that can be drawn, as many programs write them, and the same damaged: made from numbers alone.
#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "tests/skinning/gltf/gltf_builder.h"

namespace chironomia::testing {

// How the same figure is written. Every choice is one that glTF 2.0 leaves to a program.
struct FigureForm {
    int index_type = 5123;   // 5121, 5123 or 5125; 0: without indices
    int joint_type = 5121;   // 5121 or 5123
    int weight_type = 5126;  // 5126, or 5121 or 5123 normalized
    int uv_type = 5126;      // the same
    int uv_set = 0;          // which the texture reads
    int primitives = 1;
    bool interleaved = false;    // all of a vertex together, with room between vertices
    bool offsets = false;        // each accessor begins behind something else in its view
    bool sparse = false;         // some positions stand in a sparse part
    bool quantized = false;      // positions are normalized shorts
    bool second_set = false;     // a second set of influences
    float weight_sum = 1;        // of a vertex
    bool weights_twice = false;  // each influence stands there twice, so that weights sum to 2
    bool matrices = false;       // nodes have a matrix in place of translations
    bool textured = true;        // false: without any material
    bool has_normals = true;
    bool as_text = false;  // a .gltf with its buffer inside
};

// A person of 18 joints with Mixamo's names and a box along each bone, 1.7 m tall, facing +z. Skinned, with a texture
// and a morph "smile" of the head.
GltfBuilder made_figure(const FigureForm& form);

// The kinds of choices, each by its name; a form that makes this one alone, and one that by the seed makes others too.
std::vector<std::string> figure_kinds();
FigureForm figure_of_kind(const std::string& kind);
FigureForm figure_form(const std::string& kind, Random& random);

struct DamagedFigure {
    std::string kind;     // what was done to it
    std::string message;  // what its refusal says
    std::vector<std::uint8_t> glb;
};

// So many damaged figures, of all kinds in turn; the seed chooses the vertex, joint or place that is hit.
std::vector<DamagedFigure> damaged_figures(size_t count, std::uint64_t seed);

}  // namespace chironomia::testing
