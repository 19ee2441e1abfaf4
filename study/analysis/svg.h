// A picture of lines, shapes and words, written as SVG that stands alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chironomia::study::analysis {

struct Point {
    double x = 0;  // to the right [px]
    double y = 0;  // down [px]
};

struct Box {
    double x = 0, y = 0;           // of its upper left corner [px]
    double width = 0, height = 0;  // below 0: 0 [px]
};

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

class Svg {
  public:
    // `description` is read to those who cannot see it.
    Svg(double width, double height, std::string description);

    void line(const Point& from, const Point& to, const Paint& paint);
    void rectangle(const Box& box, const Paint& paint);
    void circle(const Point& middle, double radius, const Paint& paint);
    void polyline(const std::vector<Point>& points, bool closed, const Paint& paint);
    void words(const Point& at, std::string_view text, const Words& words);

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
