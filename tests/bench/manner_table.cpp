// How the six parameters change the movement, and each hardly what the others are for: a table for
// docs/expressivity.md, and how fast the engine is. `build/release/bin/manner_table`.
#include <array>
#include <chrono>
#include <cstdio>
#include <vector>

#include "core/text.h"
#include "synth/expressive.h"
#include "synth/gestures/lexicon.h"
#include "synth/markup/markup.h"
#include "synth/planner/plan_behaviours.h"
#include "synth/speech/speak.h"
#include "tests/synth/motor/manner_metrics.h"
#include "tests/synth/talks.h"

namespace chironomia {
namespace {

constexpr double kFps = 60;

struct Metric {
    Expressivity of;  // whose signature it is
    const char* name;
    double MannerMetrics::*value;
    bool by_minute = false;
};

constexpr Metric kMetrics[] = {
    {Expressivity::spatial_extent, "box (m)", &MannerMetrics::box},
    {Expressivity::spatial_extent, "swivel (rad)", &MannerMetrics::swivel},
    {Expressivity::temporal_extent, "stroke speed (m/s)", &MannerMetrics::stroke_speed},
    {Expressivity::temporal_extent, "pace", &MannerMetrics::pace},
    {Expressivity::fluidity, "jerk", &MannerMetrics::jerk},
    {Expressivity::fluidity, "peak jerk (m/s3)", &MannerMetrics::peak_jerk},
    {Expressivity::fluidity, "retractions/min", &MannerMetrics::retractions_per_minute, true},
    {Expressivity::power, "peak acceleration", &MannerMetrics::peak_acceleration},
    {Expressivity::power, "fist", &MannerMetrics::fist},
    {Expressivity::repetition, "strokes/rheme", &MannerMetrics::strokes_per_rheme},
    {Expressivity::overall_activation, "gestures/min", &MannerMetrics::gestures_per_minute, true}};

std::vector<Speech> speeches() {
    std::vector<Speech> all;
    for (std::size_t i = 0; i < testing::kTalks.size(); ++i) {
        const MarkupSource source{.text = testing::talk(i, 1)};
        all.push_back(speak(parse_marked_text(source, MarkupLanguage::plain), Voice{}));
    }
    return all;
}

// Means over all talks: of what is measured of gestures by their number, of what is counted by the minute by length.
MannerMetrics measure(const std::vector<Speech>& all, const Lexicon& lexicon, const Manner& manner,
                      const Variants& variants) {
    MannerMetrics sum;
    double gestures = 0, seconds = 0;
    for (const Speech& speech : all) {
        Speaker speaker;
        speaker.manner = manner;
        const double length = speech.audio.duration();
        const Clock clock{.frames = static_cast<std::size_t>(length * kFps), .fps = kFps};
        const GestureStyle style{.lexicon = lexicon, .speaker = speaker, .variants = variants};
        const Behaviours behaviours = plan_behaviours(speech, style, 1);
        const ArmMotion arms = move_arms(behaviours.gestures, style, clock, 1);
        const MannerMetrics one = measure_manner(arms, lexicon, clock);
        const auto count = static_cast<double>(arms.placed.size());
        for (const Metric& metric : kMetrics)
            sum.*metric.value += (metric.by_minute ? length : count) * one.*metric.value;
        gestures += count;
        seconds += length;
    }
    for (const Metric& metric : kMetrics) {
        const double whole = metric.by_minute ? seconds : gestures;
        if (whole > 0) sum.*metric.value /= whole;
    }
    return sum;
}

void print_row(const std::string& first, const std::vector<std::string>& cells) {
    std::printf("| %s | %s |\n", first.c_str(), join(cells, " | ").c_str());
}

constexpr std::array<double, 5> kShares = {0, 0.25, 0.5, 0.75, 1};  // of the range of a dimension

// Of one dimension, the others at rest.
using Sweep = std::array<MannerMetrics, kShares.size()>;

Sweep sweep(Expressivity dimension, const std::vector<Speech>& all, const Lexicon& lexicon,
            const Variants& variants) {
    Sweep found;
    for (std::size_t i = 0; i < kShares.size(); ++i) {
        Manner manner;
        manner[dimension] = least_of(dimension) + kShares[i] * (1 - least_of(dimension));
        found[i] = measure(all, lexicon, manner, variants);
    }
    return found;
}

// From the lowest to the highest value of each dimension; of the overall activation from 0.25, as nobody
// moves at 0.
void print_matrix(const std::array<Sweep, kExpressivities>& sweeps) {
    std::vector<std::string> names, lines;
    for (const Metric& metric : kMetrics) {
        names.emplace_back(metric.name);
        lines.emplace_back("---");
    }
    print_row("", names);
    print_row("---", lines);
    for (std::size_t d = 0; d < kExpressivities; ++d) {
        std::vector<std::string> cells;
        for (const Metric& metric : kMetrics) {
            const std::string change = format("{:.2f} to {:.2f}", sweeps[d][d == 0 ? 1 : 0].*metric.value,
                                              sweeps[d].back().*metric.value);
            cells.push_back(metric.of == static_cast<Expressivity>(d) ? "**" + change + "**" : change);
        }
        print_row(std::string(symbol_of(static_cast<Expressivity>(d))), cells);
    }
}

void print_signature(const std::string& name, const Metric& metric, const Sweep& sweep) {
    std::vector<std::string> cells = {metric.name};
    for (const MannerMetrics& found : sweep) cells.push_back(format("{:.2f}", found.*metric.value));
    print_row(name, cells);
}

// Each dimension's own metrics over its whole range, and those of the fluidity as it is printed too.
void print_signatures(const std::array<Sweep, kExpressivities>& sweeps, const Sweep& printed_fluidity) {
    std::printf("\n| | metric | lowest | | middle | | highest |\n|---|---|---|---|---|---|---|\n");
    for (const Metric& metric : kMetrics)
        print_signature(std::string(symbol_of(metric.of)), metric,
                        sweeps[static_cast<std::size_t>(metric.of)]);
    for (const Metric& metric : kMetrics) {
        if (metric.of == Expressivity::fluidity && !metric.by_minute)
            print_signature("flt, printed", metric, printed_fluidity);
    }
}

void print_speed(const std::vector<Speech>& all, const Lexicon& lexicon) {
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    double seconds = 0;
    const auto start = Clock::now();
    for (const Speech& speech : all) {
        perform(speech, {.speaker = {}, .lexicon = lexicon, .variants = {}, .fps = 30, .seed = 1});
        seconds += speech.audio.duration();
    }
    const double alone = since(start);
    const auto again = Clock::now();
    speeches();
    const double voice = since(again);
    std::printf("\n%.0f s of speech at 30 frames/s: %.0f times faster than real time, %.0f with the voice\n",
                seconds, seconds / alone, seconds / (alone + voice));
}

int run() {
    const Lexicon lexicon = read_lexicon(bundled_lexicon_files());
    const std::vector<Speech> all = speeches();
    std::array<Sweep, kExpressivities> sweeps;
    for (std::size_t d = 0; d < kExpressivities; ++d)
        sweeps[d] = sweep(static_cast<Expressivity>(d), all, lexicon, {});
    print_matrix(sweeps);
    print_signatures(sweeps,
                     sweep(Expressivity::fluidity, all, lexicon, {.fluidity_map = FluidityMap::printed}));
    print_speed(all, lexicon);
    return 0;
}

}  // namespace
}  // namespace chironomia

int main() {
    return chironomia::run();
}
