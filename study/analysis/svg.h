// A picture of lines, shapes and words, written as SVG that stands alone.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace chironomia::study::analysis {

struct Paint {
    std::string fill = "none";
    std::string line = "none";
    double width = 1;       // of the line [px]
    double opacity = 1;     // of the fill
    std::string dash = "";  // "4 3"
};

struct Words {
    double size = 13;              // [px]
    std::string anchor = "start";  // "start", "middle", "end"
    std::string fill = "#1d2329";
    bool bold = false;
};

// Coordinates in pixels, x to the right, y down.
class Svg {
  public:
    // `description` is read to those who cannot see it.
    Svg(double width, double height, std::string description);

    void line(double x1, double y1, double x2, double y2, const Paint& paint);
    void rectangle(double x, double y, double width, double height, const Paint& paint);
    void circle(double x, double y, double radius, const Paint& paint);
    void polyline(const std::vector<std::pair<double, double>>& points, bool closed, const Paint& paint);
    void words(double x, double y, std::string_view text, const Words& words);

    // The whole file, on white.
    std::string text() const;

  private:
    double width_;
    double height_;
    std::string description_;
    std::string body_;
};

// How wide a text is about, in pixels.
double width_of_words(std::string_view text, double size);

}  // namespace chironomia::study::analysis
