// Checks generated intervals by what their files hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "synth/corpus/make/pose.h"
#include "synth/corpus/make/speech.h"
#include "synth/expressive.h"
#include "synth/gestures/gesture.h"
#include "synth/text/dialog_acts.h"
#include "tests/synth/corpus/made.h"
#include "tests/synth/lagged_correlation.h"

namespace chironomia {
namespace {

using testing::correlation;
using testing::ranks_of;

constexpr std::size_t kJoints = IntervalRecord::kJoints;
constexpr std::size_t kLeftWrist = 6;

// Of the first of eight speakers 6 intervals that all say alike, and 6 of their own for each further stretch.
struct Intervals {
    Intervals(std::size_t wanted, std::size_t each) : speakers(wanted), stretches(each) {
        index = testing::made(first_plan(), order);
        for (const CorpusEntry& entry : index.entries) records.push_back(read_interval(index, entry));
        EXPECT_EQ(records.size(), 6 * wanted * each);
    }

    std::size_t speakers, stretches;
    testing::TemporaryFolder folder;
    CorpusOrder order{.kind = CorpusKind::intervals, .folder = folder.path(), .seed = 2};
    CorpusIndex index;
    std::vector<IntervalRecord> records;

    // Of all tests, as making them takes longer than looking at them.
    static const Intervals& of_all() {
        static const Intervals all(8, 2);
        return all;
    }
    // The 6 that all say alike, of the first speaker.
    static std::vector<IntervalRecord> of_one() {
        return {of_all().records.begin(), of_all().records.begin() + 6};
    }

    CorpusPlan first_plan() const {
        CorpusPlan plan = plan_intervals({.order = order,
                                          .lexicon = testing::corpus_lexicon(),
                                          .counts = {.seen = 8, .unseen = 0, .of_seen = 30, .of_unseen = 0}});
        std::vector<CorpusJob> chosen;
        for (std::size_t job = 0; job < 5 * speakers; ++job)
            if (job % 5 < stretches) chosen.push_back(plan.jobs[job]);
        plan.jobs = std::move(chosen);
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

// Some gesture so rarely that 6 intervals hold three seconds of strokes.
TEST(MakeIntervals, ShowTheStyleOfTheirSpeakers) {
    const Intervals& intervals = Intervals::of_all();
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

// The mean place of each joint that was seen.
std::vector<double> mean_pose(const IntervalRecord& record) {
    std::vector<double> mean;
    for (std::size_t joint = 1; joint < 10; ++joint) {
        Vec2 sum(0);
        float count = 0;
        for (std::size_t t = 0; t < record.frames(); ++t) {
            if (!is_seen(record, t, joint)) continue;
            sum += place(record, t, joint);
            ++count;
        }
        mean.push_back(sum.x / count);
        mean.push_back(sum.y / count);
    }
    return mean;
}

using Rows = std::map<std::string, std::vector<std::vector<double>>>;  // by speaker

std::vector<double> column_means(const std::vector<std::vector<double>>& rows) {
    std::vector<double> means(rows[0].size());
    for (const std::vector<double>& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) means[c] += row[c] / static_cast<double>(rows.size());
    return means;
}

// The mean variance of each column within a speaker.
std::vector<double> variances_within(const Rows& rows) {
    std::vector<double> variances(rows.begin()->second[0].size());
    for (const auto& [speaker, own] : rows) {
        const std::vector<double> mean = column_means(own);
        for (const std::vector<double>& row : own)
            for (std::size_t c = 0; c < row.size(); ++c) variances[c] += std::pow(row[c] - mean[c], 2);
    }
    return variances;
}

// Whose mean of the other intervals is nearest, in standard deviations within a speaker.
std::string recognized(Rows others, const std::string& speaker, std::size_t interval) {
    const std::vector<double> unknown = others.at(speaker)[interval];
    others.at(speaker).erase(others.at(speaker).begin() + static_cast<std::ptrdiff_t>(interval));
    const std::vector<double> variances = variances_within(others);
    std::map<double, std::string> distances;
    for (const auto& [name, own] : others) {
        const std::vector<double> mean = column_means(own);
        double distance = 0;
        for (std::size_t c = 0; c < mean.size(); ++c)
            distance += std::pow(unknown[c] - mean[c], 2) / variances[c];
        distances.emplace(distance, name);
    }
    return distances.begin()->second;
}

// Chance recognizes one in eight.
TEST(MakeIntervals, AllowToRecognizeTheirSpeakers) {
    const Intervals& intervals = Intervals::of_all();
    Rows rows;
    for (const IntervalRecord& record : intervals.records) rows[record.speaker].push_back(mean_pose(record));
    ASSERT_EQ(rows.size(), 8u);
    double right = 0;
    for (const auto& [speaker, own] : rows)
        for (std::size_t i = 0; i < own.size(); ++i) right += recognized(rows, speaker, i) == speaker ? 1 : 0;
    const double share = right / static_cast<double>(intervals.records.size());
    std::cout << "nearest mean pose: " << share << " of " << intervals.records.size() << " intervals\n";
    EXPECT_GE(share, 0.9);
}

// Mean speed of both wrists in a picture [shoulder widths / 100 / s].
double wrist_speed(const Motion& motion) {
    const PicturedPerson seen = picture_person(motion, {.yaw = 0, .scale = 500}, false, Random(1));
    IntervalRecord record;
    record.pose_normalized = seen.pose.normalized;
    double sum = 0;
    for (std::size_t t = 1; t < motion.frames; ++t)
        for (const std::size_t wrist : {kLeftWrist, kLeftWrist - 3})
            sum += distance(place(record, t, wrist), place(record, t - 1, wrist)) * IntervalRecord::kFps;
    return sum / static_cast<double>(2 * (motion.frames - 1));
}

// What speakers who differ in all do cannot show it: speed goes with how often and how wide they gesture.
TEST(MakeIntervals, ShowQuickerWristsTheQuickerASpeakerIsOtherwiseAlike) {
    const CorpusOrder order{.kind = CorpusKind::intervals, .seed = 1};
    const UnitOrder units{.order = order,
                          .lexicon = testing::corpus_lexicon(),
                          .counts = {.seen = 1, .unseen = 0, .of_seen = 30, .of_unseen = 0}};
    const UnitPlan plan = plan_units(units, unit_speakers(units)).front();
    std::vector<Speech> speeches;
    for (const std::vector<Sentence>& text : texts_of(plan, {.fewest = 20, .most = 48}))
        speeches.push_back(say_aloud(text, plan.speaker.speaker.voice));
    std::vector<double> speeds;
    for (const double tempo : {-0.9, 0.0, 0.9}) {
        Speaker speaker = plan.speaker.speaker;
        speaker.manner[Expressivity::overall_activation] = 0.8;
        speaker.manner[Expressivity::temporal_extent] = tempo;
        double speed = 0;
        for (std::size_t i = 0; i < speeches.size(); ++i) {
            speed += wrist_speed(perform(speeches[i], {.speaker = speaker,
                                                       .lexicon = testing::corpus_lexicon(),
                                                       .variants = kCorpusVariants,
                                                       .fps = IntervalRecord::kFps,
                                                       .seed = i})
                                     .motion);
        }
        speeds.push_back(speed / static_cast<double>(speeches.size()));
    }
    std::cout << "wrist speed at tmp -0.9, 0, 0.9: " << speeds[0] << ", " << speeds[1] << ", " << speeds[2]
              << "\n";
    EXPECT_LT(speeds[0], speeds[1]);
    EXPECT_LT(speeds[1], speeds[2]);
}

TEST(MakeIntervals, HaveTheShapeOfPats) {
    for (const IntervalRecord& record : Intervals::of_one()) {
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
    for (const IntervalRecord& record : Intervals::of_one()) {
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

// Sixteen speakers, four of each genre, in a hundred intervals each.
TEST(MakeIntervals, DoEverythingThatCanBeDoneWithASentence) {
    CorpusOrder order{.kind = CorpusKind::intervals, .seed = 1};
    const UnitOrder units{.order = order,
                          .lexicon = testing::corpus_lexicon(),
                          .counts = {.seen = 16, .unseen = 0, .of_seen = 100, .of_unseen = 0}};
    const auto acts_of = [&] {
        std::set<std::string> acts;
        for (const UnitPlan& plan : plan_units(units, unit_speakers(units)))
            for (const std::vector<Sentence>& text : texts_of(plan, {.fewest = 20, .most = 48}))
                for (const Sentence& sentence : text) acts.insert(sentence.dialog_act);
        return acts;
    };
    EXPECT_EQ(acts_of(), std::set<std::string>(kDialogActNames.begin(), kDialogActNames.end()));
    order.kind = CorpusKind::talks;
    EXPECT_EQ(acts_of().size(), kDialogActNames.size() - 8) << "nobody answers in a talk";
}

TEST(MakeIntervals, GiveTheWordsOfEachFrame) {
    for (const IntervalRecord& record : Intervals::of_one()) {
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
