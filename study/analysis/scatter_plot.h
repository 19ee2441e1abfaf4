// Labelled points in a plane, such as a map by t-SNE, as a picture without axes.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace chironomia::study::analysis {

struct ScatterPoint {
    double x = 0;  // to the right, any unit
    double y = 0;  // up, the same unit
    std::size_t group = 0;
};

struct ScatterPlot {
    std::string title;
    std::vector<std::string> groups;  // names, in the order of the legend
    std::vector<ScatterPoint> points;
};

// An SVG that stands alone. Each group has a colour and a shape, both other than its neighbours' in the legend,
// so that nobody needs colours to read it. The colours, which the colour-blind can part, are those of Okabe and
// Ito, "Color Universal Design", with a grey for black and without the yellow. Both axes have the same scale.
// Throws Error of more than 56 groups, which would repeat, and if a point is not finite or has no group.
std::string draw_scatter_plot(const ScatterPlot& plot);

}  // namespace chironomia::study::analysis
