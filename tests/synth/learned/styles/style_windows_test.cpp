#include "synth/learned/styles/style_windows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/utils.h>

#include <map>
#include <set>

#include "synth/learned/styles/style_jobs.h"
#include "tests/support/support.h"
#include "tests/synth/learned/styles/style_corpus.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;
using torch::Tensor;

// Of one speaker; frame t of every feature is t.
StyleRecord counting_record(std::int64_t frames, const std::string& speaker = "anna") {
    const Tensor t = torch::arange(frames, torch::kFloat32).unsqueeze(1);
    return {.id = speaker,
            .speaker = speaker,
            .mel = t.expand({-1, kStyleMel}).to(torch::kHalf),
            .text = t.expand({-1, kStyleText}).to(torch::kHalf),
            .pose = t.expand({-1, kStylePose}).contiguous()};
}

StyleRecords counting_records(const std::vector<std::int64_t>& lengths) {
    std::vector<StyleRecord> records;
    for (std::size_t i = 0; i < lengths.size(); ++i)
        records.push_back(counting_record(lengths[i], i % 2 == 0 ? "anna" : "ben"));
    return StyleRecords(std::move(records));
}

std::vector<std::int64_t> beginnings(std::int64_t frames, std::int64_t segment, std::int64_t hop) {
    std::vector<std::int64_t> firsts;
    for (const StyleWindow& window : style_windows(counting_records({frames}), segment, hop))
        firsts.push_back(window.first);
    return firsts;
}

// PATS's loader: while the start is less than the length less 64.
TEST(StyleWindows, BeginWherePatsCutsThem) {
    EXPECT_THAT(beginnings(200, 64, 64), ElementsAre(0, 64, 128));
    EXPECT_THAT(beginnings(192, 64, 64), ElementsAre(0, 64));
    EXPECT_THAT(beginnings(193, 64, 64), ElementsAre(0, 64, 128));
    EXPECT_THAT(beginnings(90, 64, 8), ElementsAre(0, 8, 16, 24));
    EXPECT_THAT(beginnings(20, 64, 64), ElementsAre(0));
}

// What a model learns from is not filled up.
TEST(StyleWindows, AreWholeInLessons) {
    const StyleRecords records = counting_records({20, 64, 130});
    std::vector<StyleWindow> windows = whole_windows(records, 64, 64, "people, train");
    ASSERT_EQ(windows.size(), 2u);
    EXPECT_EQ(windows[0].entry, 2u);
    EXPECT_EQ(windows[1].first, 64);
    EXPECT_EQ(refusal_of([] {
                  whole_windows(counting_records({20, 64}), 64, 8, "people, train");
              }),
              "people, train: no interval is longer than a segment of 64 frames (4.3 s); give longer ones");
}

TEST(Gather, GoesOnWithTheLastFrame) {
    StyleRecords records = counting_records({5});
    const StyleWindow window{0, 2};
    const StyleSegments segments = gather(records, {&window, 1}, 6);
    const Tensor first = segments.pose[0].select(1, 0);
    EXPECT_TRUE(first.equal(torch::tensor({2.F, 3.F, 4.F, 4.F, 4.F, 4.F})));
    EXPECT_EQ(segments.mel.scalar_type(), torch::kFloat32);
}

TEST(DrawEqually, TakesSpeakersByTurns) {
    const StyleRecords records = counting_records({200, 90, 300});  // anna has more to give than ben
    const auto windows = style_windows(records, 64, 8);
    Random random(1);
    const auto batches = draw_equally(records, windows, {.batch = 5, .batches = 8}, random);
    ASSERT_EQ(batches.size(), 8u);
    std::map<std::string, int> counts;
    std::set<std::size_t> seen;
    for (const Batch& batch : batches) {
        EXPECT_EQ(batch.size(), 5u);
        for (const std::size_t i : batch) ++counts[records.entries()[windows[i].entry].speaker];
        seen.insert(batch.begin(), batch.end());
    }
    EXPECT_EQ(counts["anna"], 20);
    EXPECT_EQ(counts["ben"], 20);
    EXPECT_GT(seen.size(), 10u);
}

TEST(DrawEpoch, HasEverySegmentOnceAndStylesOfTheSameSpeaker) {
    const StyleRecords records = counting_records({200, 150, 300, 90});
    const auto windows = style_windows(records, 64, 8);
    Random random(1);
    const StyleEpoch epoch = draw_epoch(records, windows, {.batch = 24}, random);
    std::multiset<std::size_t> seen;
    std::size_t themselves = 0;
    for (const Batch& batch : epoch.batches) {
        EXPECT_LE(batch.size(), 24u);
        seen.insert(batch.begin(), batch.end());
    }
    EXPECT_EQ(seen.size(), windows.size());
    for (std::size_t i = 0; i < windows.size(); ++i) {
        EXPECT_EQ(seen.count(i), 1u);
        const auto& own = records.entries()[windows[i].entry].speaker;
        EXPECT_EQ(records.entries()[windows[epoch.style_of[i]].entry].speaker, own);
        themselves += epoch.style_of[i] == i ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(themselves) / static_cast<double>(windows.size()), 0.5, 0.2);
}

// What does not fit in memory at once is not needed at once.
TEST(DrawEpoch, StaysWithinAGroupOfRecords) {
    const StyleRecords records = counting_records({100, 100, 100, 100, 100, 100});
    const auto windows = style_windows(records, 64, 4);
    Random random(1);
    const StyleEpoch epoch = draw_epoch(records, windows, {.batch = 3, .group_bytes = 1}, random);
    std::size_t changes = 0, last = records.entries().size();
    for (const Batch& batch : epoch.batches) {
        for (const std::size_t i : batch) {
            if (windows[i].entry != last) ++changes;
            last = windows[i].entry;
            EXPECT_EQ(windows[epoch.style_of[i]].entry, last);
        }
    }
    EXPECT_EQ(changes, 6u);
}

// (T, 104) with a joint at a place of its own in each frame.
IntervalRecord small_interval(std::size_t frames) {
    IntervalRecord record{.id = "a", .speaker = "anna"};
    for (std::size_t t = 0; t < frames; ++t)
        for (std::size_t i = 0; i < 2 * IntervalRecord::kJoints; ++i)
            record.pose_normalized.push_back(static_cast<float>(10 * t + i));
    record.pose = record.pose_normalized;
    record.pose_confidence.assign(record.pose.size(), 1);
    record.mel_512.assign(6 * frames * IntervalRecord::kMel512, -3);
    record.vectors.assign(frames * kWordVector, 0.5);
    return record;
}

StyleForm plain_form() {
    return {.scales = {.mel = {},
                       .text = std::vector<FeatureScale>(kStyleText),
                       .pose = std::vector<FeatureScale>(kStylePose, {.zero = 100, .one = 102})}};
}

TEST(StyleRecord, TakesElevenJointsInTheirScale) {
    const StyleRecord record = style_record(small_interval(4), plain_form());
    EXPECT_THAT(record.pose.sizes().vec(), ElementsAre(4, 22));
    EXPECT_FLOAT_EQ(record.pose[2][3].item<float>(), (20 + 4 - 100) / 2.F);         // x of the left shoulder
    EXPECT_FLOAT_EQ(record.pose[2][21].item<float>(), (20 + 52 + 31 - 100) / 2.F);  // y of the right hand
    EXPECT_THAT(record.mel.sizes().vec(), ElementsAre(4, 128));
}

TEST(StyleRecord, BridgesPointsThatWereLost) {
    IntervalRecord lost = small_interval(4);
    lost.pose_normalized[1 * 104 + 3] = 0;  // x of the right wrist in the second frame
    lost.pose_confidence[1 * 104 + 3] = 0;
    const StyleRecord record = style_record(lost, plain_form());
    EXPECT_FLOAT_EQ(record.pose[1][2].item<float>(), (10 + 3 - 100) / 2.F);
}

TEST(StyleRecord, RefusesAnIntervalWithoutTheFaceThatIsWanted) {
    StyleForm form = plain_form();
    form.scales.face.resize(kStyleFace);
    EXPECT_THAT(refusal_of([&] { style_record(small_interval(4), form); }),
                HasSubstr("a: the interval has no points of the face"));
}

// What was given up is read again.
TEST(StyleRecords, AreTheSameHoweverFewAreKept) {
    const CorpusIndex index = read_corpus_index(testing::style_corpus());
    const StyleForm form{.scales = style_scales(index, StyleMel::bands_128, true)};
    const std::vector<CorpusEntry> entries = index.of(Split::train);
    StyleRecords all(index, entries, form);
    StyleRecords few(index, entries, form, 2 * all.at(0).bytes());
    Random random(1);
    for (std::size_t draw = 0; draw < 3 * entries.size(); ++draw) {
        const std::size_t entry = random.below(entries.size());
        const StyleRecord &expected = all.at(entry), &found = few.at(entry);
        EXPECT_EQ(found.id, entries[entry].id);
        for (const auto part : {&StyleRecord::mel, &StyleRecord::text, &StyleRecord::pose, &StyleRecord::face,
                                &StyleRecord::acts})
            EXPECT_TRUE((found.*part).equal(expected.*part)) << found.id;
    }
}

TEST(RestoredRows, UndoNormalisedOnes) {
    const std::vector<FeatureScale> scales{{.zero = 1, .one = 5}, {.zero = -2, .one = 2}};
    const std::vector<float> rows{1, 2, 3, -7};
    const Tensor normalised = normalised_rows(rows, scales);
    EXPECT_FLOAT_EQ(normalised[1][0].item<float>(), 0.5F);
    EXPECT_EQ(restored_rows(normalised, scales), rows);
}

// A model that gives back what it hears: segments that agree where they overlap fade into what they are.
TEST(AnimateSegments, JoinsSegmentsWithoutASeam) {
    StyleModel model{.frames = 64, .generate = [](const StyleSegments& content, const Tensor&) {
                         return content.text.slice(2, 0, kStylePose);
                     }};
    for (const std::int64_t frames : {1, 63, 64, 65, 120, 121, 500}) {
        const StyleRecord content = counting_record(frames);
        const Tensor motion = animate_segments(model, content, torch::zeros({1}));
        ASSERT_EQ(motion.size(0), frames);
        EXPECT_TRUE(torch::allclose(motion, content.pose, 0, 1e-3)) << frames;
    }
}

}  // namespace
}  // namespace chironomia
