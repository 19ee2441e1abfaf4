#include "study/analysis/plots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/text.h"
#include "study/analysis/simulated_rater.h"
#include "study/analysis/svg.h"
#include "study/measure/proportions.h"

namespace chironomia::study::analysis {
namespace {

constexpr double kWidth = 720;
constexpr double kRight = 24;
constexpr double kMostLabel = 250;
constexpr const char* kInk = "#1d2329";
constexpr const char* kQuiet = "#55606b";
constexpr const char* kGrid = "#dde2e7";
constexpr const char* kAccent = "#1f5fa8";

std::string shortened(const std::string& text, double width, double size) {
    if (width_of_words(text, size) <= width) return text;
    std::string cut = text;
    while (!cut.empty() && width_of_words(cut + "…", size) > width) {
        // Whole characters go, not bytes of them.
        while (!cut.empty() && (cut.back() & 0xc0) == 0x80) cut.pop_back();
        if (!cut.empty()) cut.pop_back();
    }
    return cut + "…";
}

double label_width(const std::vector<std::string>& labels) {
    double width = 60;
    for (const std::string& label : labels) width = std::max(width, width_of_words(label, 13));
    return std::min(width, kMostLabel) + 16;
}

// A scale from left to right, with the values that are written below it.
struct Axis {
    double low = 0;
    double high = 1;
    double left = 0;  // [px]
    double right = 0;
    std::vector<double> ticks;
    std::string (*tick_text)(double) = nullptr;

    double at(double value) const { return left + (right - left) * (value - low) / (high - low); }
};

std::string plain(double value) {
    return format("{:g}", value);
}

std::string in_percent(double value) {
    return format("{:.0f} %", 100 * value);
}

// Round values, about `count` of them.
std::vector<double> round_ticks(double low, double high, int count) {
    const double rough = (high - low) / count;
    const double magnitude = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * magnitude;
    for (const double nice : {5.0, 2.0, 1.0}) {
        if (rough <= nice * magnitude) step = nice * magnitude;
    }
    std::vector<double> ticks;
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
        ticks.push_back(i * step + 0.0);  // no -0
    return ticks;
}

void draw_axis(Svg& svg, const Axis& axis, double top, double bottom) {
    for (const double tick : axis.ticks) {
        svg.line({axis.at(tick), top}, {axis.at(tick), bottom}, {.line = kGrid});
        svg.words({axis.at(tick), bottom + 17}, axis.tick_text(tick),
                  {.size = 12, .anchor = "middle", .fill = kQuiet});
    }
    svg.line({axis.left, bottom}, {axis.right, bottom}, {.line = "#8a949e"});
}

void draw_simulated(Svg& svg, const Dataset& data, double height) {
    if (data.simulated)
        svg.words({kWidth - kRight, height - 8}, kSimulatedRaters,
                  {.size = 12, .anchor = "end", .fill = "#a3341f", .bold = true});
}

// A row for each condition: how its scores are spread, and under it the mean with its interval.
std::string density_plot(const Dataset& data, const ScoreResult& result) {
    constexpr double kRow = 78, kTop = 14, kHill = 50;
    std::vector<std::string> labels, notes;
    double highest = 0;
    for (const CellResult& cell : result.cells) {
        labels.push_back(data.cells[cell.cell]);
        notes.push_back(format("n = {}, mean {:.2f}", cell.participants.n, cell.participants.mean));
        if (!cell.density) continue;
        highest =
            std::max(highest, *std::max_element(cell.density->height.begin(), cell.density->height.end()));
    }
    const double bottom = kTop + kRow * static_cast<double>(labels.size()), height = bottom + 46;
    Svg svg(kWidth, height, format("Scores of {}", data.questions[result.question].id));
    Axis axis{.low = result.range.low,
              .high = result.range.high,
              .left = std::max(label_width(labels), label_width(notes)),
              .right = kWidth - kRight};
    const double span = axis.high - axis.low;
    axis.ticks = round_ticks(axis.low, axis.high, span <= 11 ? static_cast<int>(std::max(span, 1.0)) : 10);
    axis.tick_text = plain;
    draw_axis(svg, axis, kTop, bottom);
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const CellResult& cell = result.cells[i];
        const Summary& scores = cell.participants;
        const double base = kTop + kRow * static_cast<double>(i) + 56;
        svg.words({0, base - 22}, shortened(labels[i], kMostLabel, 13), {.bold = true});
        svg.words({0, base - 5}, notes[i], {.size = 12, .fill = kQuiet});
        if (cell.density) {
            std::vector<Point> hill = {{axis.at(cell.density->at.front()), base}};
            for (std::size_t k = 0; k < cell.density->at.size(); ++k)
                hill.push_back(
                    {axis.at(cell.density->at[k]), base - kHill * cell.density->height[k] / highest});
            hill.push_back({axis.at(cell.density->at.back()), base});
            svg.polyline(hill, true, {.fill = kAccent, .line = kAccent, .width = 1.5, .opacity = 0.22});
        }
        svg.line({axis.left, base}, {axis.right, base}, {.line = "#b6bfc8"});
        const double y = base + 9;
        if (scores.mean_95)
            svg.line({axis.at(std::max(scores.mean_95->low, axis.low)), y},
                     {axis.at(std::min(scores.mean_95->high, axis.high)), y}, {.line = kInk, .width = 2.5});
        svg.circle({axis.at(scores.mean), y}, 4.5, {.fill = kInk});
        svg.line({axis.at(scores.median), y - 6}, {axis.at(scores.median), y + 6},
                 {.line = kInk, .width = 1.5});
    }
    draw_simulated(svg, data, height);
    return svg.text();
}

// A value with its interval.
struct ForestRow {
    std::string label;
    std::string note;  // "n = 31"
    double value = 0;
    std::optional<Interval> interval;
    std::string text;  // the value in words
};

struct ForestStyle {
    std::string description;
    Axis axis;                        // without its ends on the picture
    std::optional<double> reference;  // a line that means "no difference"
    bool bars = false;
};

std::string forest_plot(const Dataset& data, const std::vector<ForestRow>& rows, ForestStyle style) {
    constexpr double kRow = 40, kTop = 12, kValues = 150;
    std::vector<std::string> labels;
    for (const ForestRow& row : rows) labels.insert(labels.end(), {row.label, row.note});
    const double bottom = kTop + kRow * static_cast<double>(rows.size()), height = bottom + 46;
    Svg svg(kWidth, height, style.description);
    Axis& axis = style.axis;
    axis.left = label_width(labels);
    axis.right = kWidth - kRight - kValues;
    draw_axis(svg, axis, kTop, bottom);
    if (style.reference)
        svg.line({axis.at(*style.reference), kTop}, {axis.at(*style.reference), bottom},
                 {.line = kInk, .width = 1.5, .dash = "5 4"});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ForestRow& row = rows[i];
        const double y = kTop + kRow * (static_cast<double>(i) + 0.5);
        svg.words({0, y - 1}, shortened(row.label, kMostLabel, 13), {.bold = true});
        svg.words({0, y + 14}, row.note, {.size = 11.5, .fill = kQuiet});
        const auto inside = [&](double value) { return axis.at(std::clamp(value, axis.low, axis.high)); };
        if (style.bars)
            svg.rectangle({axis.left, y - 9, inside(row.value) - axis.left, 18}, {.fill = "#8fb3da"});
        if (row.interval) {
            svg.line({inside(row.interval->low), y}, {inside(row.interval->high), y},
                     {.line = kInk, .width = 2.5});
            for (const double end : {row.interval->low, row.interval->high}) {
                if (end >= axis.low && end <= axis.high)
                    svg.line({inside(end), y - 5}, {inside(end), y + 5}, {.line = kInk, .width = 2});
            }
        }
        if (!style.bars)
            svg.circle({inside(row.value), y}, 5.5, {.fill = kAccent, .line = "#ffffff", .width = 1.5});
        svg.words({axis.right + 16, y + 5}, row.text, {.size = 13});
    }
    draw_simulated(svg, data, height);
    return svg.text();
}

Axis share_axis() {
    return {.low = 0, .high = 1, .ticks = {0, 0.25, 0.5, 0.75, 1}, .tick_text = in_percent};
}

std::string share_text(double share, const std::optional<Interval>& interval) {
    if (!interval) return format("{:.0f} %", 100 * share);
    return format("{:.0f} % [{:.0f}, {:.0f}]", 100 * share, 100 * interval->low, 100 * interval->high);
}

ForestRow share_row(const std::string& label, std::size_t chosen, std::size_t of) {
    const double share = static_cast<double>(chosen) / static_cast<double>(std::max<std::size_t>(of, 1));
    const auto interval = of > 0 ? std::optional(exact_share_95(chosen, of)) : std::nullopt;
    return {.label = label,
            .note = format("{} of {}", chosen, of),
            .value = share,
            .interval = interval,
            .text = share_text(share, interval)};
}

std::string elo_text(const EloRow& row) {
    if (!row.elo_95) return format("{:.0f}", row.elo);
    const auto end = [](double at) { return std::isfinite(at) ? format("{:.0f}", at) : "–"; };
    return format("{:.0f} [{}, {}]", row.elo, end(row.elo_95->low), end(row.elo_95->high));
}

std::string elo_plot(const Dataset& data, const EloResult& result) {
    std::vector<ForestRow> rows;
    double low = 1000, high = 1000;
    for (const EloRow& row : result.table.rows) {
        low = std::min(low, row.elo);
        high = std::max(high, row.elo);
        if (row.elo_95 && std::isfinite(row.elo_95->low)) low = std::min(low, row.elo_95->low);
        if (row.elo_95 && std::isfinite(row.elo_95->high)) high = std::max(high, row.elo_95->high);
        rows.push_back({.label = data.conditions[result.conditions[row.condition]].name,
                        .note = format("{} votes", row.votes),
                        .value = row.elo,
                        .interval = row.elo_95,
                        .text = elo_text(row)});
    }
    const double margin = std::max(20.0, 0.06 * (high - low));
    Axis axis{.low = low - margin, .high = high + margin, .tick_text = plain};
    axis.ticks = round_ticks(axis.low, axis.high, 5);
    // Ends without bound go to the end of the axis.
    for (ForestRow& row : rows) {
        if (row.interval)
            row.interval =
                Interval{std::max(axis.low, row.interval->low), std::min(axis.high, row.interval->high)};
    }
    return forest_plot(data, rows,
                       {.description = "Strengths on the scale of Elo", .axis = axis, .reference = 1000});
}

// From the first clearly to the second clearly, as shares of one bar.
std::string wins_plot(const Dataset& data, const VoteResult& result) {
    constexpr double kRow = 62, kTop = 30, kBar = 26;
    // Dark, light, none, light, dark: the middle is what neither won.
    constexpr const char* kFills[] = {"#1f5fa8", "#a9c6e6", "#eef0f2", "#f0c9a8", "#b5551b"};
    constexpr const char* kTexts[] = {"#ffffff", kInk, kInk, kInk, "#ffffff"};
    const double height = kTop + kRow * static_cast<double>(result.pairs.size()) + 20;
    Svg svg(kWidth, height, format("Wins, ties and losses of {}", data.questions[result.question].id));
    const double left = 8, right = kWidth - 8;
    svg.words({left, 16}, "clearly, slightly", {.size = 12, .fill = kQuiet});
    svg.words({(left + right) / 2, 16}, "equal", {.size = 12, .anchor = "middle", .fill = kQuiet});
    svg.words({right, 16}, "slightly, clearly", {.size = 12, .anchor = "end", .fill = kQuiet});
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
        const VotePair& pair = result.pairs[i];
        const double y = kTop + kRow * static_cast<double>(i);
        svg.words({left, y + 12}, shortened(data.conditions[pair.first].name, 280, 13), {.bold = true});
        svg.words({right, y + 12}, shortened(data.conditions[pair.second].name, 280, 13),
                  {.anchor = "end", .bold = true});
        svg.words({(left + right) / 2, y + 12}, format("{} votes, n = {}", pair.votes(), pair.participants),
                  {.size = 12, .anchor = "middle", .fill = kQuiet});
        const std::size_t counts[] = {pair.clear_wins, pair.wins - pair.clear_wins, pair.ties,
                                      pair.losses - pair.clear_losses, pair.clear_losses};
        double x = left;
        for (std::size_t k = 0; k < 5; ++k) {
            const double share = static_cast<double>(counts[k]) / static_cast<double>(pair.votes());
            const double width = share * (right - left);
            svg.rectangle({x, y + 19, width, kBar}, {.fill = kFills[k], .line = "#ffffff", .width = 1.5});
            if (width > 40)
                svg.words({x + width / 2, y + 37}, format("{:.0f} %", 100 * share),
                          {.size = 12.5, .anchor = "middle", .fill = kTexts[k]});
            x += width;
        }
        svg.rectangle({left, y + 19, right - left, kBar}, {.line = "#8a949e"});
        // Half of the votes, above and below so that no number is crossed out.
        svg.line({(left + right) / 2, y + 15}, {(left + right) / 2, y + 20}, {.line = kInk, .width = 1.5});
        svg.line({(left + right) / 2, y + 44}, {(left + right) / 2, y + 49}, {.line = kInk, .width = 1.5});
    }
    draw_simulated(svg, data, height);
    return svg.text();
}

// White for never, dark for always.
std::string shade(double share) {
    const auto mix = [&](int light, int dark) {
        return static_cast<int>(std::lround(light + (dark - light) * share));
    };
    return format("#{:02x}{:02x}{:02x}", mix(0xf7, 0x12), mix(0xfa, 0x3c), mix(0xfd, 0x70));
}

std::string heat_plot(const Dataset& data, const VoteResult& result, const EloResult& group) {
    std::vector<std::size_t> order;
    std::vector<std::string> names;
    for (const EloRow& row : group.table.rows) {
        order.push_back(group.conditions[row.condition]);
        names.push_back(data.conditions[order.back()].name);
    }
    const double left = label_width(names), top = 34;
    const double cell = std::min(92.0, (kWidth - left - kRight) / static_cast<double>(order.size()));
    const double tall = std::min(cell, 62.0), height = top + tall * static_cast<double>(order.size()) + 28;
    Svg svg(kWidth, height, format("Weighted share of wins of {}", data.questions[result.question].id));
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double y = top + tall * static_cast<double>(i);
        svg.words({left - 10, y + tall / 2 + 4}, shortened(names[i], kMostLabel, 13),
                  {.anchor = "end", .bold = true});
        svg.words({left + cell * (static_cast<double>(i) + 0.5), top - 10}, shortened(names[i], cell - 6, 12),
                  {.size = 12, .anchor = "middle"});
        for (std::size_t j = 0; j < order.size(); ++j) {
            const double x = left + cell * static_cast<double>(j);
            const auto pair =
                std::find_if(result.pairs.begin(), result.pairs.end(), [&](const VotePair& each) {
                    return std::minmax(each.first, each.second) == std::minmax(order[i], order[j]);
                });
            if (pair == result.pairs.end()) {
                svg.rectangle({x, y, cell, tall}, {.fill = "#f4f6f7", .line = "#ffffff", .width = 2});
                continue;
            }
            const double share = pair->first == order[i] ? pair->share.share : 1 - pair->share.share;
            svg.rectangle({x, y, cell, tall}, {.fill = shade(share), .line = "#ffffff", .width = 2});
            const char* ink = share > 0.5 ? "#ffffff" : kInk;
            svg.words({x + cell / 2, y + tall / 2}, in_percent(share),
                      {.size = 13, .anchor = "middle", .fill = ink, .bold = true});
            svg.words({x + cell / 2, y + tall / 2 + 16}, format("n = {}", pair->votes()),
                      {.size = 11, .anchor = "middle", .fill = ink});
        }
    }
    draw_simulated(svg, data, height);
    return svg.text();
}

// How often conditions are preferred to what was made of them.
std::string made_plot(const Dataset& data, const std::vector<VotePair>& pairs) {
    std::vector<ForestRow> rows;
    for (const VotePair& pair : pairs) {
        if (!pair.made_of_it) continue;
        rows.push_back({.label = data.conditions[pair.first].name,
                        .note = format("{}, n = {}", data.conditions[pair.second].made, pair.votes()),
                        .value = pair.share.share,
                        .interval = pair.share.share_95,
                        .text = share_text(pair.share.share, pair.share.share_95)});
    }
    if (rows.empty()) return "";
    return forest_plot(
        data, rows,
        {.description = "How often the original is preferred", .axis = share_axis(), .reference = 0.5});
}

std::string reasons_plot(const Dataset& data, const std::vector<ReasonCount>& reasons) {
    std::vector<ForestRow> rows;
    for (const ReasonCount& reason : reasons)
        rows.push_back(share_row(reason.text, reason.chosen, reason.of));
    return forest_plot(data, rows, {.description = "Reasons", .axis = share_axis(), .bars = true});
}

std::string choices_plot(const Dataset& data, const ChoiceResult& result) {
    std::vector<ForestRow> rows;
    for (const OptionCount& option : result.options)
        rows.push_back(share_row(option.text, option.chosen, option.of));
    return forest_plot(data, rows,
                       {.description = format("Choices on pages with {}", result.shown),
                        .axis = share_axis(),
                        .bars = true});
}

// Adds a plot unless it is empty. `added.name` is its kind; its full name is "<question>-<kind>", with "-2",
// "-3", ... at the end if the question has several of the kind.
void add(std::vector<Plot>& plots, const Dataset& data, Plot added) {
    if (added.svg.empty()) return;
    const std::string name = format("{}-{}", data.questions[added.question].id, added.name);
    const auto same = std::count_if(plots.begin(), plots.end(), [&](const Plot& plot) {
        return plot.name == name || plot.name.starts_with(name + "-");
    });
    added.name = same > 0 ? format("{}-{}", name, same + 1) : name;
    plots.push_back(std::move(added));
}

void add_votes(std::vector<Plot>& plots, const Dataset& data, const VoteResult& result) {
    const std::size_t question = result.question;
    for (const EloResult& group : result.elo) {
        add(plots, data,
            {.name = "elo",
             .question = question,
             .caption =
                 "Strengths on the scale of Elo with 95 % intervals from resampled participants; dashed: "
                 "the mean.",
             .svg = elo_plot(data, group)});
    }
    add(plots, data,
        {.name = "wins",
         .question = question,
         .caption =
             "Votes for the condition on the left, for neither, and for the one on the right; ticks: half.",
         .svg = wins_plot(data, result)});
    for (const EloResult& group : result.elo) {
        add(plots, data,
            {.name = "win-fractions",
             .question = question,
             .caption = "How often the row was preferred to the column (ties half, clear answers double).",
             .svg = heat_plot(data, result, group)});
    }
    add(plots, data,
        {.name = "originals",
         .question = question,
         .caption =
             "How often a condition was preferred to what was made of it (ties half, clear answers double), "
             "with 95 % intervals from resampled participants; dashed: chance.",
         .svg = made_plot(data, result.pairs)});
    if (!result.reasons.empty()) {
        add(plots, data,
            {.name = "reasons",
             .question = question,
             .caption = "Share of the answers with reasons that gave each, with exact 95 % intervals.",
             .svg = reasons_plot(data, result.reasons)});
    }
}

}  // namespace

std::vector<Plot> plots_of(const Dataset& data, const Results& results) {
    std::vector<Plot> plots;
    for (const ScoreResult& result : results.scores) {
        add(plots, data,
            {.name = "densities",
             .question = result.question,
             .caption =
                 "How the participants' scores are spread; below each the mean with its 95 % interval (dot "
                 "and bar) and the median (tick).",
             .svg = density_plot(data, result)});
    }
    for (const VoteResult& result : results.votes) add_votes(plots, data, result);
    for (const ChoiceResult& result : results.choices) {
        add(plots, data,
            {.name = "choices",
             .question = result.question,
             .caption = format("What was chosen on pages with {}, with exact 95 % intervals.", result.shown),
             .svg = choices_plot(data, result)});
    }
    return plots;
}

}  // namespace chironomia::study::analysis
