#include "synth/learned/training/loss_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/files/xml_text.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr double kWidth = 640, kHeight = 360;
constexpr double kLeft = 72, kRight = 16, kTop = 40, kBottom = 44;  // of the plot, from the edges

// A line of the plot.
struct Loss {
    const char* name;
    const char* ink;
    double CurvePoint::*value;
};
constexpr Loss kLosses[] = {{"training", "#1f77b4", &CurvePoint::train},
                            {"validation", "#d95f02", &CurvePoint::validation}};

// Where a number lies on an axis between the two ends of the plot [px].
struct Axis {
    double low = 0, high = 1;
    double begin = 0, end = 1;
    bool logarithmic = false;

    double scaled(double value) const { return logarithmic ? std::log10(value) : value; }
    double at(double value) const {
        const double share = (scaled(value) - scaled(low)) / (scaled(high) - scaled(low));
        return begin + share * (end - begin);
    }
};

Axis loss_axis(const std::vector<CurvePoint>& curve) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const CurvePoint& point : curve) {
        low = std::min({low, point.train, point.validation});
        high = std::max({high, point.train, point.validation});
    }
    Axis axis{.low = low, .high = high, .begin = kHeight - kBottom, .end = kTop};
    axis.logarithmic = low > 0 && high > 5 * low;
    if (axis.logarithmic) {
        axis.low /= 1.05;
        axis.high *= 1.05;
    } else {
        const double margin = std::max(1e-12, 0.05 * (high - low));
        axis.low -= margin;
        axis.high += margin;
    }
    return axis;
}

// Round numbers, 1, 2 or 5 times a power of ten apart.
std::vector<double> even_ticks(double low, double high) {
    const double rough = (high - low) / 5;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double step = power * (rough > 5 * power ? 10 : rough > 2 * power ? 5 : rough > power ? 2 : 1);
    std::vector<double> ticks;
    for (double n = std::ceil(low / step); n * step <= high; ++n) ticks.push_back(n * step);
    return ticks;
}

std::vector<double> ticks_of(const Axis& axis) {
    if (!axis.logarithmic) return even_ticks(axis.low, axis.high);
    std::vector<double> ticks;
    for (double power = std::pow(10, std::floor(std::log10(axis.low))); power <= axis.high; power *= 10)
        for (const double digit : {1, 2, 5})
            if (digit * power >= axis.low && digit * power <= axis.high) ticks.push_back(digit * power);
    return ticks;
}

std::string label(double x, double y, const char* anchor, std::string_view text) {
    return format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)"
                  "\n",
                  x, y, anchor, text);
}

std::string drawn_axes(const Axis& steps, const Axis& losses) {
    std::string svg;
    for (const double tick : ticks_of(losses)) {
        svg += format(R"(<path class="grid" d="M{:.1f} {:.1f}H{:.1f}"/>)"
                      "\n",
                      steps.begin, losses.at(tick), steps.end);
        svg += label(steps.begin - 6, losses.at(tick) + 4, "end", format("{:.3g}", tick));
    }
    for (const double tick : ticks_of(steps)) {
        svg += format(R"(<path class="axis" d="M{:.1f} {:.1f}v5"/>)"
                      "\n",
                      steps.at(tick), losses.begin);
        svg += label(steps.at(tick), losses.begin + 18, "middle", format("{:.12g}", tick));
    }
    svg += format(R"(<path class="axis" d="M{:.1f} {:.1f}V{:.1f}H{:.1f}"/>)"
                  "\n",
                  steps.begin, losses.end, losses.begin, steps.end);
    return svg + label((steps.begin + steps.end) / 2, kHeight - 8, "middle", "steps");
}

std::string drawn_line(const Axis& steps, const Axis& losses, const std::vector<CurvePoint>& curve,
                       const Loss& loss) {
    std::string points;
    for (const CurvePoint& point : curve) {
        points +=
            format("{:.1f},{:.1f} ", steps.at(static_cast<double>(point.step)), losses.at(point.*loss.value));
    }
    std::string svg = format(R"(<polyline points="{}" stroke="{}"/>)"
                             "\n",
                             trim(points), loss.ink);
    if (curve.size() == 1) {
        svg +=
            format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="3" fill="{}"/>)"
                   "\n",
                   steps.at(static_cast<double>(curve[0].step)), losses.at(curve[0].*loss.value), loss.ink);
    }
    return svg;
}

std::string legend() {
    std::string svg;
    double x = kWidth - kRight - 180;
    for (const Loss& loss : kLosses) {
        svg += format(R"(<path d="M{:.1f} 22h18" stroke="{}"/>)"
                      "\n",
                      x, loss.ink);
        svg += label(x + 23, 26, "start", loss.name);
        x += 90;
    }
    return svg;
}

}  // namespace

std::string draw_loss_curve(const std::string& title, const std::vector<CurvePoint>& curve) {
    std::string svg =
        format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}">
<style>text{{font:12px sans-serif;fill:#333}} path,polyline{{fill:none;stroke-width:1.6}}
.grid{{stroke:#e4e4e4;stroke-width:1}} .axis{{stroke:#333;stroke-width:1}}</style>
<rect width="{0}" height="{1}" fill="#fff"/>
)",
               kWidth, kHeight);
    svg += label(kLeft, 26, "start", escape_xml(title));
    if (!curve.empty()) {
        const Axis steps{.low = 0,
                         .high = static_cast<double>(std::max<std::size_t>(1, curve.back().step)),
                         .begin = kLeft,
                         .end = kWidth - kRight};
        const Axis losses = loss_axis(curve);
        svg += drawn_axes(steps, losses) + legend();
        for (const Loss& loss : kLosses) svg += drawn_line(steps, losses, curve, loss);
    }
    return svg + "</svg>\n";
}

}  // namespace chironomia
