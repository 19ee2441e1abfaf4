#include "study/analysis/scatter_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "study/analysis/svg.h"

namespace chironomia::study::analysis {
namespace {

constexpr double kPlotSide = 560;    // [px] of the square that holds the points
constexpr double kScatterEdge = 24;  // [px] around it
constexpr double kScatterTop = 52;   // [px] above it, with the title
constexpr double kLegendRow = 22;    // [px]
constexpr double kSymbol = 5;        // [px] radius of a circle of the same area, in the legend
constexpr double kLeastSymbol = 3;   // [px] among many points
constexpr double kUncrowded = 600;   // points that may have the largest symbols

// Okabe and Ito's colours that stand out from white, the yellow left out, and a grey.
constexpr std::array<const char*, 7> kGroupColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#56b4e9", "#e69f00", "#4d4d4d"};

constexpr std::size_t kShapes = 8;  // no multiple of the colours, so that all pairs come up

// Corners around a middle, as (angle [rad, from the right, clockwise], radius).
using Corners = std::vector<std::pair<double, double>>;

Corners regular(int corners, double first, double radius) {
    Corners found;
    for (int i = 0; i < corners; ++i) found.emplace_back(first + 2 * std::numbers::pi * i / corners, radius);
    return found;
}

// Corners and dents in turn.
Corners star(int points, double first, double radius, double dent) {
    Corners found;
    for (int i = 0; i < 2 * points; ++i)
        found.emplace_back(first + std::numbers::pi * i / points, i % 2 == 0 ? radius : dent);
    return found;
}

// A cross, its first arm at an angle.
Corners four_arms(double first) {
    Corners found;
    for (int arm = 0; arm < 4; ++arm) {
        const double middle = first + std::numbers::pi / 2 * arm;
        found.insert(found.end(),
                     {{middle - 0.32, 1.4}, {middle + 0.32, 1.4}, {middle + std::numbers::pi / 4, 0.62}});
    }
    return found;
}

// In radii of the circle that is the first shape (no corners); about as large to the eye.
const std::array<Corners, kShapes>& shapes() {
    constexpr double kUp = -std::numbers::pi / 2, kDown = -kUp, kAslant = std::numbers::pi / 4;
    static const std::array<Corners, kShapes> all = {
        Corners{},    regular(3, kUp, 1.42),   regular(4, kAslant, 1.28), regular(4, kUp, 1.38),
        four_arms(0), regular(3, kDown, 1.42), star(5, kUp, 1.6, 0.72),   four_arms(kAslant)};
    return all;
}

void draw_symbol(Svg& svg, const Point& middle, std::size_t group, double size = kSymbol) {
    const Paint paint{.fill = kGroupColours[group % kGroupColours.size()],
                      .line = "#ffffff",
                      .width = 0.8,
                      .opacity = 0.85};
    const Corners& corners = shapes()[group % shapes().size()];
    if (corners.empty()) return svg.circle(middle, size, paint);
    std::vector<Point> outline;
    for (const auto& [angle, radius] : corners)
        outline.push_back(
            {middle.x + size * radius * std::cos(angle), middle.y + size * radius * std::sin(angle)});
    svg.polyline(outline, true, paint);
}

// As much ink for many points as for some.
double symbol_size(std::size_t points) {
    const double share = kUncrowded / static_cast<double>(std::max<std::size_t>(points, 1));
    return std::clamp(kSymbol * std::sqrt(share), kLeastSymbol, kSymbol);
}

struct PlotRange {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double middle() const { return (low + high) / 2; }
};

// Where the points lie on the picture: the same scale both ways, the middle in the middle.
struct PlotFrame {
    PlotRange x, y;

    double scale() const {
        const double side = std::max(x.high - x.low, y.high - y.low);
        return side > 0 ? kPlotSide / side : 0;
    }
    Point place_of(const ScatterPoint& point) const {
        return {kScatterEdge + kPlotSide / 2 + scale() * (point.x - x.middle()),
                kScatterTop + kPlotSide / 2 - scale() * (point.y - y.middle())};
    }
};

PlotFrame frame_of(const std::vector<ScatterPoint>& points) {
    PlotFrame frame;
    for (const ScatterPoint& point : points) {
        frame.x.include(point.x);
        frame.y.include(point.y);
    }
    return frame;
}

void check_plot(const ScatterPlot& plot) {
    constexpr std::size_t kMost = kGroupColours.size() * kShapes;
    if (plot.groups.size() > kMost)
        throw Error(format("{}: {} groups, at most {} look different; draw fewer", plot.title,
                           plot.groups.size(), kMost));
    for (std::size_t i = 0; i < plot.points.size(); ++i) {
        const ScatterPoint& point = plot.points[i];
        if (!std::isfinite(point.x) || !std::isfinite(point.y))
            throw Error(format("{}: point {} lies at ({}, {}); only finite points can be drawn", plot.title,
                               i, point.x, point.y));
        if (point.group >= plot.groups.size())
            throw Error(format("{}: point {} is of group {}, there are {}; name the others too", plot.title,
                               i, point.group, plot.groups.size()));
    }
}

// Rows of the legend; beyond those that fit beside the points it gets another column.
std::size_t legend_rows(const ScatterPlot& plot) {
    const auto fit = static_cast<std::size_t>(kPlotSide / kLegendRow);
    return std::clamp<std::size_t>(plot.groups.size(), 1, fit);
}

double legend_column(const ScatterPlot& plot) {
    double width = 0;
    for (const std::string& name : plot.groups) width = std::max(width, width_of_words(name, 13));
    return width + 40;
}

void draw_legend(Svg& svg, const ScatterPlot& plot) {
    const double left = kPlotSide + 2 * kScatterEdge + 8, column = legend_column(plot);
    for (std::size_t group = 0; group < plot.groups.size(); ++group) {
        const double x = left + column * static_cast<double>(group / legend_rows(plot));
        const double y = kScatterTop + 12 + kLegendRow * static_cast<double>(group % legend_rows(plot));
        draw_symbol(svg, {x + kSymbol, y}, group);
        svg.words({x + 20, y + 4.5}, plot.groups[group], {});
    }
}

}  // namespace

std::string draw_scatter_plot(const ScatterPlot& plot) {
    check_plot(plot);
    const std::size_t columns = (plot.groups.size() + legend_rows(plot) - 1) / legend_rows(plot);
    const double width = kPlotSide + 3 * kScatterEdge + legend_column(plot) * static_cast<double>(columns);
    Svg svg(width, kScatterTop + kPlotSide + kScatterEdge, plot.title);
    svg.words({kScatterEdge, 30}, plot.title, {.size = 16, .bold = true});
    svg.rectangle({kScatterEdge - 12, kScatterTop - 12, kPlotSide + 24, kPlotSide + 24}, {.fill = "#f6f8fa"});
    const PlotFrame frame = frame_of(plot.points);
    const double size = symbol_size(plot.points.size());
    for (const ScatterPoint& point : plot.points) draw_symbol(svg, frame.place_of(point), point.group, size);
    draw_legend(svg, plot);
    return svg.text();
}

}  // namespace chironomia::study::analysis
