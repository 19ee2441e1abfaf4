#include "study/analysis/svg.h"

#include <algorithm>
#include <utility>

#include "core/text.h"
#include "core/utf8.h"
#include "study/html/html.h"

namespace chironomia::study::analysis {
namespace {

std::string attributes(const Paint& paint) {
    std::string text = format("fill=\"{}\"", paint.fill);
    if (paint.opacity < 1) text += format(" fill-opacity=\"{:g}\"", paint.opacity);
    if (paint.line != "none") text += format(" stroke=\"{}\" stroke-width=\"{:g}\"", paint.line, paint.width);
    if (!paint.dash.empty()) text += format(" stroke-dasharray=\"{}\"", paint.dash);
    return text;
}

}  // namespace

Svg::Svg(double width, double height, std::string description)
    : width_(width), height_(height), description_(std::move(description)) {}

void Svg::line(const Point& from, const Point& to, const Paint& paint) {
    body_ += format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.x, from.y,
                    to.x, to.y, attributes(paint));
}

void Svg::rectangle(const Box& box, const Paint& paint) {
    body_ += format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", box.x, box.y,
                    std::max(box.width, 0.0), std::max(box.height, 0.0), attributes(paint));
}

void Svg::circle(const Point& middle, double radius, const Paint& paint) {
    body_ += format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" {}/>\n", middle.x, middle.y, radius,
                    attributes(paint));
}

void Svg::polyline(const std::vector<Point>& points, bool closed, const Paint& paint) {
    std::string path;
    for (const auto& [x, y] : points) path += format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    body_ += format("<path d=\"{}{}\" stroke-linejoin=\"round\" {}/>\n", path, closed ? "Z" : "",
                    attributes(paint));
}

void Svg::words(const Point& at, std::string_view text, const Words& words) {
    body_ += format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n",
        at.x, at.y, words.size, words.anchor, words.fill, words.bold ? " font-weight=\"600\"" : "",
        escape_html(text));
}

std::string Svg::text() const {
    return format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
        "height=\"{1:g}\" "
        "role=\"img\" font-family=\"system-ui, 'Segoe UI', Roboto, 'Noto Sans', 'Liberation Sans', "
        "sans-serif\">\n"
        "<title>{2}</title>\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
        width_, height_, escape_html(description_), body_);
}

double width_of_words(std::string_view text, double size) {
    return 0.56 * size * static_cast<double>(count_characters(text));
}

}  // namespace chironomia::study::analysis
