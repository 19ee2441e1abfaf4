// Buffer views that EXT_meshopt_compression keeps small, as gltfpack writes them.
#pragma once

#include "skinning/gltf/gltf_file.h"

namespace chironomia {

// The same file without the extension: what each compressed view holds is in a buffer of its own.
// Khronos, EXT_meshopt_compression (vendor extension of glTF 2.0): modes ATTRIBUTES, TRIANGLES, INDICES; filters NONE,
// OCTAHEDRAL, QUATERNION, EXPONENTIAL. Decoded by meshoptimizer.
// Throws Error if a view is broken, or all together hold more than 1 GiB.
GltfFile without_meshopt(GltfFile file);

}  // namespace chironomia
