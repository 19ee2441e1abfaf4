#include "raster/tiles/tile_painter.h"

#include <algorithm>
#include <bit>

namespace chironomia {
namespace {

// `front` over `back`, RGBA8 multiplied by alpha.
std::uint32_t over(std::uint32_t front, std::uint32_t back) {
    const std::uint32_t through = 255 - (front >> 24);
    std::uint32_t result = 0;
    for (int shift = 0; shift < 32; shift += 8) {
        const std::uint32_t behind = ((back >> shift & 255) * through + 127) / 255;
        result |= std::min<std::uint32_t>(255, (front >> shift & 255) + behind) << shift;
    }
    return result;
}

}  // namespace

TilePainter::TilePainter()
    : tile_(std::make_unique<Tile>()),
      items_(std::make_unique<TileItems>()),
      covered_(std::make_unique<TileCoverage>()),
      seen_(kTileSamples * kTilePixels),
      pixels_(kTilePixels) {}

std::span<const std::uint8_t> TilePainter::paint(int x, int y, const TileFigure& figure,
                                                 std::span<const std::uint32_t> list) {
    figure_ = &figure;
    list_ = list;
    std::fill_n(tile_->nearness[0], kTileSamples * kTilePixels, 0.0f);
    std::fill_n(tile_->triangle[0], kTileSamples * kTilePixels, 0u);
    std::fill_n(tile_->colour[0], kTileSamples * kTilePixels, 0u);
    std::fill_n(tile_->block_near, kBlocks, 0.0f);
    std::fill_n(tile_->drawn, kBlocks, 0);
    tile_->x = x;
    tile_->y = y;
    std::uint32_t id = 1;
    for (; id <= list.size(); ++id) {
        const TileSurface& surface = figure.surface(triangle(id).surface);
        if (surface.lit->features.translucent) break;
        if (surface.lit->features.cut_out) {
            cover_cut_out(*tile_, triangle(id), surface, id);
        } else {
            cover_solid(*tile_, triangle(id), id);
        }
    }
    collect();
    paint_solid();
    for (; id <= list.size(); ++id) paint_translucent(id);
    finish_triangle();
    shade_items();
    resolve(*tile_, pixels_.data());
    static_assert(std::endian::native == std::endian::little, "RGBA8 is read as bytes");
    return {reinterpret_cast<const std::uint8_t*>(pixels_.data()), 4 * pixels_.size()};
}

// Finds the triangles of each pixel, and sorts what was found by triangle: its surface's light is then worked out
// for many pixels at once.
void TilePainter::collect() {
    places_.assign(list_.size() + 2, 0);
    size_t count = 0;
    const auto add_seen = [&](std::uint32_t id, int pixel, int samples) {
        if (id == 0) return;
        seen_[count++] = {id, pixel, samples};
        ++places_[id + 1];
    };
    for (int pixel = 0; pixel < kTilePixels; ++pixel) {
        std::uint32_t ids[kTileSamples];
        for (int s = 0; s < kTileSamples; ++s) ids[s] = tile_->triangle[s][pixel];
        if (ids[0] == ids[1] && ids[0] == ids[2] && ids[0] == ids[3]) {
            add_seen(ids[0], pixel, (1 << kTileSamples) - 1);
            continue;
        }
        for (int s = 0; s < kTileSamples; ++s) {
            int samples = 0;
            bool first = true;
            for (int other = 0; other < kTileSamples; ++other) {
                if (ids[other] != ids[s]) continue;
                if (other < s) first = false;
                samples |= 1 << other;
            }
            if (first) add_seen(ids[s], pixel, samples);
        }
    }
    for (size_t i = 1; i < places_.size(); ++i) places_[i] += places_[i - 1];
    sorted_.resize(count);
    for (size_t i = 0; i < count; ++i) sorted_[places_[seen_[i].id]++] = seen_[i];
}

void TilePainter::paint_solid() {
    blending_ = false;
    for (const Item& item : sorted_) add(item);
    finish_triangle();
    shade_items();
    blending_ = true;
}

void TilePainter::paint_translucent(std::uint32_t id) {
    const int count = cover_translucent(*tile_, triangle(id), *covered_);
    for (int i = 0; i < count; ++i) add({id, covered_->pixel[i], covered_->samples[i]});
}

// Items of one surface are shaded together.
void TilePainter::add(const Item& item) {
    if (item.id != drawn_) {
        const bool other_surface = drawn_ != 0 && triangle(drawn_).surface != triangle(item.id).surface;
        finish_triangle();
        if (other_surface) shade_items();
    }
    if (items_->count == TileItems::kMost) {
        finish_triangle();
        shade_items();
    }
    if (drawn_ != item.id) {
        drawn_ = item.id;
        items_->first = items_->count;
    }
    items_->pixel[items_->count] = item.pixel;
    items_->samples[items_->count++] = item.samples;
}

void TilePainter::finish_triangle() {
    if (drawn_ != 0 && items_->first < items_->count) {
        const TileTriangle& done = triangle(drawn_);
        interpolate(*items_, *tile_, done, figure_->surface(done.surface));
    }
    items_->first = items_->count;
}

void TilePainter::shade_items() {
    if (items_->count == 0) return;
    shade(*items_, figure_->surface(triangle(drawn_).surface), figure_->lights());
    constexpr int kAll = (1 << kTileSamples) - 1;
    for (int i = 0; i < items_->count; ++i) {
        if (!blending_ && items_->samples[i] == kAll) {
            for (auto& colours : tile_->colour) colours[items_->pixel[i]] = items_->result[i];
            continue;
        }
        for (int s = 0; s < kTileSamples; ++s) {
            if ((items_->samples[i] >> s & 1) == 0) continue;
            std::uint32_t& colour = tile_->colour[s][items_->pixel[i]];
            colour = blending_ ? over(items_->result[i], colour) : items_->result[i];
        }
    }
    items_->count = items_->first = 0;
    drawn_ = 0;
}

}  // namespace chironomia
