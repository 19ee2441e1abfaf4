// Smaller and smaller pictures of a texture, for its view from afar.
#pragma once

#include <optional>
#include <vector>

#include "core/body/avatar.h"

namespace chironomia {

// sRGB or linear, and what its alpha says.
enum class ImageUse { colour, blended_colour, cut_out_colour, data };

ImageUse use_of_base_colour(const Material& material);
// The alpha of its texture at which a material is cut out; 0 for one that is not.
float cutoff_in_texture(const Material& material);

// For what is solid. All levels down to 1 x 1, each side half of the one before, rounded down: the mean of four
// texels, colours (`is_srgb`) in linear light.
std::vector<Image> solid_mip_levels(const Image& image, bool is_srgb);

// For what has holes, such as hair, lashes or lace. All levels down to 1 x 1, each side half of the one before, rounded
// down. Colours are averaged in linear light, weighted with their alpha, so that what is hidden leaves no fringe;
// texels without alpha take the colour of what surrounds them. With a `cutoff` the alpha of every level but the first
// is the share of the texel that is at least the cutoff in the first one: alpha that is averaged and then cut loses
// thin strands with distance.
std::vector<Image> mip_levels(const Image& image, std::optional<float> cutoff);

// Either of them; `cutoff` is that of a cut-out colour.
std::vector<Image> mip_levels_for(const Image& image, ImageUse use, float cutoff);

}  // namespace chironomia
