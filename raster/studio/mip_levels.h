// Smaller and smaller pictures of a texture with holes, such as hair, lashes or lace, for its view from afar.
#pragma once

#include <optional>
#include <vector>

#include "core/avatar.h"

namespace chironomia {

// All levels down to 1 x 1, each side half of the one before, rounded down. Colours are averaged in linear
// light, weighted with their alpha, so that what is hidden leaves no fringe; texels without alpha take the
// colour of what surrounds them. With a `cutoff` the alpha of every level but the first is the share of the
// texel that is at least the cutoff in the first one: alpha that is averaged and then cut loses thin strands
// with distance.
std::vector<Image> mip_levels(const Image& image, std::optional<float> cutoff);

}  // namespace chironomia
