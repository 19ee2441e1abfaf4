// Gaussian means of pictures and of coarser grids laid over them.
#pragma once

#include <span>
#include <vector>

#include "raster/studio/rectangle.h"

namespace chironomia {

// Four floats that the compiler keeps in one register on every machine of the architecture.
using Texel = float __attribute__((vector_size(16)));

// (height, width) values, row by row.
template <typename Value>
struct Grid {
    int width = 0;
    int height = 0;
    std::vector<Value> values;

    Grid(int w, int h)
        : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h), Value{}) {}
    Value* row(int y) { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
    const Value* row(int y) const {
        return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
    }
};

// Weights at 0, 1, 2 ... from the middle, up to three sigma; both sides together sum to 1.
std::vector<float> gaussian_weights(float sigma);

// Each value becomes the weighted sum of its neighbours in both directions; there is nothing beyond the
// edges.
void blur(Grid<Texel>& grid, std::span<const float> weights);
void blur(Grid<float>& grid, std::span<const float> weights);

}  // namespace chironomia
