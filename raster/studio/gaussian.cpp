#include "raster/studio/gaussian.h"

#include <algorithm>
#include <cmath>

namespace chironomia {
namespace {

template <typename Value>
void blur_rows(const Grid<Value>& from, Grid<Value>& to, std::span<const float> weights) {
    const int reach = static_cast<int>(weights.size()) - 1;
    for (int y = 0; y < from.height; ++y) {
        const Value* source = from.row(y);
        Value* target = to.row(y);
        for (int x = 0; x < from.width; ++x) {
            Value sum = source[x] * weights[0];
            for (int i = std::max(-reach, -x); i < 0; ++i) sum += source[x + i] * weights[size_t(-i)];
            const int last = std::min(reach, from.width - 1 - x);
            for (int i = 1; i <= last; ++i) sum += source[x + i] * weights[size_t(i)];
            target[x] = sum;
        }
    }
}

template <typename Value>
void blur_columns(const Grid<Value>& from, Grid<Value>& to, std::span<const float> weights) {
    const int reach = static_cast<int>(weights.size()) - 1;
    for (int y = 0; y < from.height; ++y) {
        Value* target = to.row(y);
        std::fill(target, target + to.width, Value{});
        const int first = std::max(0, y - reach), last = std::min(from.height - 1, y + reach);
        for (int other = first; other <= last; ++other) {
            const float weight = weights[size_t(std::abs(other - y))];
            const Value* source = from.row(other);
            for (int x = 0; x < from.width; ++x) target[x] += source[x] * weight;
        }
    }
}

template <typename Value>
void blur_both_ways(Grid<Value>& grid, std::span<const float> weights) {
    Grid<Value> rows(grid.width, grid.height);
    blur_rows(grid, rows, weights);
    blur_columns(rows, grid, weights);
}

}  // namespace

std::vector<float> gaussian_weights(float sigma) {
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    std::vector<float> weights;
    float sum = 0;
    for (int i = 0; i <= reach; ++i) {
        const float place = static_cast<float>(i) / sigma;
        weights.push_back(std::exp(-0.5f * place * place));
        sum += (i == 0 ? 1.0f : 2.0f) * weights.back();
    }
    for (float& weight : weights) weight /= sum;
    return weights;
}

void blur(Grid<Texel>& grid, std::span<const float> weights) {
    blur_both_ways(grid, weights);
}

void blur(Grid<float>& grid, std::span<const float> weights) {
    blur_both_ways(grid, weights);
}

}  // namespace chironomia
