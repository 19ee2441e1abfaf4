// Meshes that KHR_draco_mesh_compression keeps small.
#pragma once

#include "skinning/gltf/gltf_file.h"

namespace chironomia {

// The same file without the extension: corners and attributes of each compressed primitive are in a buffer of its own,
// in the type that their accessors have.
// Khronos, KHR_draco_mesh_compression (extension of glTF 2.0). Decoded by Google's Draco.
// Comes after without_meshopt() and before any accessor is read.
// Throws Error if a primitive is broken or its accessors have other counts than what it holds.
GltfFile without_draco(GltfFile file);

}  // namespace chironomia
