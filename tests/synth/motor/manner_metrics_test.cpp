#include "tests/synth/motor/manner_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "synth/body/agent_body.h"
#include "tests/synth/motor/gestures_for_tests.h"

namespace chironomia {
namespace {

using testing::planned_gesture;
using testing::test_lexicon;

constexpr std::array<double, 5> kSweep = {-1, -0.5, 0, 0.5, 1};

// All gestures of the test lexicon in turn, with accents for repeats, ever longer apart until it begins
// again.
MannerMetrics measure(const Manner& manner, double gap, std::size_t count, const Variants& variants = {}) {
    std::vector<PlannedGesture> planned_gestures;
    double time = 2;
    for (std::size_t n = 0; n < count; ++n) {
        PlannedGesture& planned = planned_gestures.emplace_back(planned_gesture(n % 6, time, manner));
        planned.rheme_start = time - 0.4;
        planned.rheme_end = time + 2.2;
        for (const double accent : {0.6, 1.1, 2.1, 3.2, 4.3, 5.5}) planned.accents.push_back(time + accent);
        time += gap + 0.3 * static_cast<double>(n % 7);
    }
    const Clock clock{.frames = static_cast<std::size_t>(30 * time), .fps = 30};
    return measure_manner(
        move_arms(planned_gestures, {.lexicon = test_lexicon(), .speaker = {}, .variants = variants}, clock,
                  1),
        test_lexicon(), clock);
}

using Metric = std::function<double(const MannerMetrics&)>;

// The metrics at each value of one dimension, the others at 0.
std::vector<MannerMetrics> measured(Expressivity dimension, double gap, std::size_t count) {
    std::vector<MannerMetrics> metrics;
    for (const double value : kSweep) {
        Manner manner;
        manner[dimension] = value;
        metrics.push_back(measure(manner, gap, count));
    }
    return metrics;
}

// With 8 s and more between the gestures.
std::vector<double> sweep(Expressivity dimension, const Metric& metric) {
    static std::map<Expressivity, std::vector<MannerMetrics>> known;
    if (!known.contains(dimension)) known[dimension] = measured(dimension, 8, 12);
    std::vector<double> values;
    for (const MannerMetrics& metrics : known[dimension]) values.push_back(metric(metrics));
    return values;
}

void expect_growing(const std::vector<double>& values) {
    for (std::size_t n = 1; n < values.size(); ++n) EXPECT_GT(values[n], values[n - 1]) << n;
}

void expect_growing(Expressivity dimension, const Metric& metric) {
    expect_growing(sweep(dimension, metric));
}

double box(const MannerMetrics& m) {
    return m.box;
}
double swivel(const MannerMetrics& m) {
    return m.swivel;
}
double pace(const MannerMetrics& m) {
    return m.pace;
}
double jerk(const MannerMetrics& m) {
    return m.jerk;
}
double peak_jerk(const MannerMetrics& m) {
    return m.peak_jerk;
}
double peak(const MannerMetrics& m) {
    return m.peak_acceleration;
}
double fist(const MannerMetrics& m) {
    return m.fist;
}
double strokes(const MannerMetrics& m) {
    return m.strokes_per_rheme;
}

TEST(MannerMetrics, AreNothingWithoutGestures) {
    const Clock clock{.frames = 60, .fps = 30};
    const MannerMetrics metrics =
        measure_manner(move_arms({}, {.lexicon = test_lexicon(), .speaker = {}, .variants = {}}, clock, 1),
                       test_lexicon(), clock);
    EXPECT_EQ(metrics.box, 0);
    EXPECT_EQ(metrics.stroke_speed, 0);
    EXPECT_EQ(metrics.gestures_per_minute, 0);
}

// The offer goes half an arm's length to each side, the palms up.
TEST(MannerMetrics, AreWhatIsKnownOfOneGesture) {
    const Clock clock{.frames = 1200, .fps = 120};
    const ArmMotion motion = move_arms({planned_gesture(testing::kOffer, 5)},
                                       {.lexicon = test_lexicon(), .speaker = {}, .variants = {}}, clock, 1);
    const MannerMetrics metrics = measure_manner(motion, test_lexicon(), clock);
    const PlacedStroke& stroke = motion.placed.at(0).strokes.at(0);
    const double way = 0.505 * agent_arm_length();
    EXPECT_NEAR(metrics.stroke_speed, way / (stroke.end - stroke.start), 0.05);
    EXPECT_NEAR(metrics.pace, 1, 0.06);
    EXPECT_EQ(metrics.strokes_per_rheme, 1);
    EXPECT_DOUBLE_EQ(metrics.gestures_per_minute, 6);
    EXPECT_DOUBLE_EQ(metrics.retractions_per_minute, 12);
    EXPECT_NEAR(metrics.swivel, 0.35, 0.03);
    EXPECT_EQ(metrics.fist, 0);
}

TEST(MannerMetrics, MeasureTheSpatialExtent) {
    expect_growing(Expressivity::spatial_extent, box);
    expect_growing(Expressivity::spatial_extent, swivel);
}

TEST(MannerMetrics, MeasureTheTemporalExtent) {
    expect_growing(Expressivity::temporal_extent, [](const MannerMetrics& m) { return m.stroke_speed; });
    expect_growing(Expressivity::temporal_extent, pace);
}

TEST(MannerMetrics, MeasureTheFluidity) {
    for (const Metric& metric : {Metric(jerk), Metric(peak_jerk)})
        expect_growing(Expressivity::fluidity, [&](const MannerMetrics& m) { return -metric(m); });
    std::vector<double> kept_up;
    for (const MannerMetrics& metrics : measured(Expressivity::fluidity, 3.5, 42))
        kept_up.push_back(-metrics.retractions_per_minute);
    expect_growing(kept_up);
}

// As printed the fluidity is the spline's continuity, and corners come back above 0.
TEST(MannerMetrics, FindTheFluidityAsItIsPrintedJerkierAtBothEnds) {
    const auto highest = [](double fluidity, FluidityMap map) {
        Manner manner;
        manner[Expressivity::fluidity] = fluidity;
        return measure(manner, 8, 12, {.fluidity_map = map}).peak_jerk;
    };
    const double middle = highest(0, FluidityMap::printed);
    EXPECT_GT(highest(-1, FluidityMap::printed), middle);
    EXPECT_GT(highest(1, FluidityMap::printed), middle);
    EXPECT_EQ(highest(0, FluidityMap::monotone), middle);
    EXPECT_EQ(highest(-1, FluidityMap::monotone), highest(-1, FluidityMap::printed));
}

TEST(MannerMetrics, MeasureThePower) {
    expect_growing(Expressivity::power, peak);
    expect_growing(Expressivity::power, fist);
}

TEST(MannerMetrics, MeasureTheRepetition) {
    expect_growing(Expressivity::repetition, strokes);
}

// The range of a metric over the sweep of another dimension, by that over its own. What is small or quick
// leaves time for repeats, and corners take from the speed with which a stroke begins.
TEST(MannerMetrics, ChangeLittleWithTheOthers) {
    struct Row {
        Expressivity own;
        Metric metric;
        double most;
    };
    const std::array<Row, 7> rows = {{{Expressivity::spatial_extent, box, 0.05},
                                      {Expressivity::spatial_extent, swivel, 0.05},
                                      {Expressivity::temporal_extent, pace, 0.25},
                                      {Expressivity::fluidity, jerk, 0.4},
                                      {Expressivity::power, peak, 1},
                                      {Expressivity::power, fist, 0.05},
                                      {Expressivity::repetition, strokes, 0.3}}};
    for (const Row& row : rows) {
        const auto range = [&](Expressivity dimension) {
            const auto values = sweep(dimension, row.metric);
            const auto [low, high] = std::minmax_element(values.begin(), values.end());
            return *high - *low;
        };
        for (std::size_t d = 1; d < kExpressivities; ++d) {
            const auto other = static_cast<Expressivity>(d);
            if (other == row.own) continue;
            EXPECT_LT(range(other), row.most * range(row.own))
                << symbol_of(other) << " in row " << &row - rows.data();
        }
    }
}

}  // namespace
}  // namespace chironomia
