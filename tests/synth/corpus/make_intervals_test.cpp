// Intervals that are made, as their files tell of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "synth/gestures/gesture.h"
#include "tests/synth/corpus/made.h"
#include "tests/synth/lagged_correlation.h"

namespace chironomia {
namespace {

using testing::correlation;
using testing::ranks_of;

constexpr std::size_t kJoints = IntervalRecord::kJoints;
constexpr std::size_t kLeftWrist = 6;

// What the first of eight speakers say alike: 6 intervals each.
struct Intervals {
    explicit Intervals(std::size_t wanted) : speakers(wanted) {
        index = testing::made(parallel_plan(), order);
        for (const CorpusEntry& entry : index.entries) records.push_back(read_interval(index, entry));
    }

    std::size_t speakers;
    testing::TemporaryFolder folder;
    CorpusOrder order{.kind = CorpusKind::intervals, .folder = folder.path(), .seed = 2};
    CorpusIndex index;
    std::vector<IntervalRecord> records;

    CorpusPlan parallel_plan() const {
        CorpusPlan plan = plan_intervals({.order = order,
                                          .lexicon = testing::bundled_lexicon(),
                                          .counts = {.seen = 8, .unseen = 0, .of_seen = 30, .of_unseen = 0}});
        std::vector<CorpusJob> parallel;
        for (std::size_t first = 0; first < plan.jobs.size() && parallel.size() < speakers; first += 5)
            parallel.push_back(plan.jobs[first]);
        plan.jobs = std::move(parallel);
        return plan;
    }
};

Vec2 place(const IntervalRecord& record, std::size_t t, std::size_t joint) {
    const std::size_t at = t * 2 * kJoints + joint;
    return {record.pose_normalized[at], record.pose_normalized[at + kJoints]};
}

bool is_seen(const IntervalRecord& record, std::size_t t, std::size_t joint) {
    return record.pose_confidence[t * 2 * kJoints + joint] > 0;
}

// The perimeter of the box about shoulders, elbows and wrists.
double box_of(const IntervalRecord& record, std::size_t t) {
    Vec2 least(1e9f), most(-1e9f);
    for (std::size_t joint = 1; joint <= kLeftWrist; ++joint) {
        if (!is_seen(record, t, joint)) continue;
        least = min(least, place(record, t, joint));
        most = max(most, place(record, t, joint));
    }
    return 2 * (most.x - least.x + most.y - least.y);
}

// What one speaker's intervals show.
struct Manners {
    double box = 0;       // mean of the box while a hand strokes
    double gestures = 0;  // strokes a minute
};

Manners manners_of(const Intervals& intervals, const std::string& speaker) {
    constexpr int kStroke = static_cast<int>(GesturePhase::stroke);
    double box = 0, frames = 0, stroking = 0, strokes = 0;
    for (const IntervalRecord& record : intervals.records) {
        if (record.speaker != speaker) continue;
        frames += static_cast<double>(record.frames());
        for (std::size_t t = 1; t < record.frames(); ++t) {
            if (record.phase[t] != kStroke) continue;
            strokes += record.phase[t - 1] != kStroke ? 1 : 0;
            box += box_of(record, t);
            ++stroking;
        }
    }
    return {.box = box / std::max(stroking, 1.0), .gestures = strokes * 60 * IntervalRecord::kFps / frames};
}

TEST(MakeIntervals, ShowTheStyleOfTheirSpeakers) {
    const Intervals intervals(8);
    std::vector<double> boxes, gestures, spatial, active;
    for (const IntervalRecord& record : intervals.records) {
        if (!record.id.ends_with("_0000")) continue;
        const Manners manners = manners_of(intervals, record.speaker);
        const auto& style = *record.style;
        boxes.push_back(manners.box);
        gestures.push_back(manners.gestures);
        active.push_back(style[0]);
        spatial.push_back(style[1]);
    }
    ASSERT_EQ(boxes.size(), 8u);
    const double of_box = correlation(ranks_of(boxes), ranks_of(spatial));
    const double of_gestures = correlation(ranks_of(gestures), ranks_of(active));
    std::cout << "Spearman's rho: box and spc " << of_box << ", strokes a minute and oac " << of_gestures
              << "\n";
    EXPECT_GE(of_box, 0.8);
    EXPECT_GE(of_gestures, 0.8);
}

TEST(MakeIntervals, HaveTheShapeOfPats) {
    const Intervals intervals(1);
    ASSERT_EQ(intervals.records.size(), 6u);
    for (const IntervalRecord& record : intervals.records) {
        const std::size_t frames = record.frames();
        EXPECT_EQ(record.pose.size(), frames * 104) << record.id;
        EXPECT_EQ(record.face.size(), frames * 140) << record.id;
        EXPECT_EQ(record.phase.size(), frames) << record.id;
        const double seconds = static_cast<double>(frames) / IntervalRecord::kFps;
        EXPECT_GT(seconds, 5) << record.id;
        EXPECT_NEAR(static_cast<double>(record.mel_400.size()) / IntervalRecord::kMel400 / 100, seconds, 0.1);
        EXPECT_NEAR(static_cast<double>(record.mel_512.size()) / IntervalRecord::kMel512 / 86.13, seconds,
                    0.1);
    }
}

TEST(MakeIntervals, PlaceTheBodyAboutTheNeckWithTheHeadOnTop) {
    const Intervals intervals(1);
    for (const IntervalRecord& record : intervals.records) {
        double lost = 0, width = 0;
        for (std::size_t t = 0; t < record.frames(); ++t) {
            EXPECT_EQ(place(record, t, 0), Vec2(0));
            for (std::size_t joint = 1; joint < kJoints; ++joint) lost += is_seen(record, t, joint) ? 0 : 1;
            if (!is_seen(record, t, 1) || !is_seen(record, t, 4) || !is_seen(record, t, 7)) continue;
            EXPECT_LT(place(record, t, 1).x, 0) << "the right shoulder on the left of the picture";
            EXPECT_LT(place(record, t, 7).y, -20) << "the nose above the neck";
            width = distance(place(record, t, 1), place(record, t, 4));
            EXPECT_NEAR(width, 100, 15) << record.id << " frame " << t;
        }
        EXPECT_NEAR(lost / static_cast<double>(record.frames() * 51), 0.01, 0.006) << record.id;
    }
}

TEST(MakeIntervals, TellWhatIsSaidInEachFrame) {
    const Intervals intervals(1);
    for (const IntervalRecord& record : intervals.records) {
        for (std::size_t t = 0; t < record.frames(); ++t) {
            const auto acts =
                record.dialog_acts.begin() + static_cast<std::ptrdiff_t>(t * IntervalRecord::kDialogActs);
            ASSERT_EQ(std::count(acts, acts + IntervalRecord::kDialogActs, 1), 1) << record.id;
            const bool is_said = record.tokens[t] != 0;
            ASSERT_EQ(record.silence[t], is_said ? 0 : 1) << record.id;
            const auto vector = record.vectors.begin() + static_cast<std::ptrdiff_t>(t * kWordVector);
            ASSERT_EQ(std::any_of(vector, vector + kWordVector, [](float value) { return value != 0; }),
                      is_said);
        }
        const auto silent = std::count(record.silence.begin(), record.silence.end(), 1);
        EXPECT_LT(silent, static_cast<std::ptrdiff_t>(record.frames() / 2)) << record.id;
    }
}

}  // namespace
}  // namespace chironomia
