#include "synth/learned/faces/face_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "synth/features/contour.h"
#include "tests/synth/learned/face_support.h"

namespace chironomia {
namespace {

using testing::batch_of;
using testing::distance;
using ::testing::ElementsAre;
using testing::small_talk;
using testing::small_units;

TEST(FaceUnits, EverySampleAndFrameBelongsToOneWord) {
    const IpuRecord talk = small_talk(20, 1);
    const FaceUnit unit = face_units(talk).front();
    std::size_t samples = 0, frames = 0;
    for (const FaceWord& word : unit.words) {
        EXPECT_EQ(word.samples.first, samples);
        EXPECT_EQ(word.frames.first, frames);
        EXPECT_EQ(word.contours.size(), word.frames.count * kFaceChannels);
        samples += word.samples.count;
        frames += word.frames.count;
    }
    EXPECT_EQ(samples, talk.f0.size());
    EXPECT_EQ(frames, talk.frames());
}

TEST(FaceUnits, NormalisesIntensitiesByFiveAndTurnsByTwoRadians) {
    IpuRecord talk = small_talk(2, 1);
    talk.units[0] = 2.5F;
    talk.units[1] = 7;
    talk.head[0] = 0.5F;
    talk.head[1] = -3;
    const std::vector<float> face = normalised_face(talk);
    EXPECT_FLOAT_EQ(face[0], 0.5F);
    EXPECT_FLOAT_EQ(face[1], 1);
    EXPECT_FLOAT_EQ(face[6], 0.75F);
    EXPECT_FLOAT_EQ(face[7], 0);
}

TEST(FaceUnits, SplitsUnitsOfMoreThan128Words) {
    const std::vector<FaceUnit> units = face_units(small_talk(300, 1));
    ASSERT_EQ(units.size(), 3u);
    EXPECT_EQ(units[0].words.size(), 128u);
    EXPECT_EQ(units[2].words.size(), 44u);
    EXPECT_EQ(units[2].vectors.size(), 44 * kWordVector);
    EXPECT_EQ(units[1].words[0].frames.first,
              units[0].words.back().frames.first + units[0].words.back().frames.count);
}

// A45: as many elements as frames, each with its own face and pitch and with its word's vector.
TEST(FaceUnits, CutIntoFramesIfAsked) {
    const IpuRecord talk = small_talk(20, 1);
    const FaceUnit words = face_units(talk).front();
    const std::vector<FaceUnit> units = face_units(talk, {.by_frames = true});
    std::size_t frame = 0, samples = 0, word = 0;
    for (const FaceUnit& unit : units) {
        EXPECT_EQ(unit.words.size(), std::min(kMostFrames, talk.frames() - frame));
        for (std::size_t i = 0; i < unit.words.size(); ++i, ++frame) {
            const FaceWord& element = unit.words[i];
            const Stretch& of_word = words.words[word].frames;
            if (frame == of_word.first + of_word.count) ++word;
            EXPECT_EQ(element.frames.first, frame);
            EXPECT_EQ(element.length, 1u);
            EXPECT_EQ(element.contours[0], talk.units[frame * IpuRecord::kUnits] / 5);
            EXPECT_EQ(element.samples.first, samples);
            samples += element.f0.size();
            EXPECT_EQ(unit.vectors[i * kWordVector + 5], words.vectors[word * kWordVector + 5]);
        }
    }
    EXPECT_EQ(frame, talk.frames());
    EXPECT_EQ(samples, talk.f0.size());
}

TEST(FaceUnits, ThinsAWordThatIsTooLong) {
    IpuRecord talk = small_talk(1, 1);
    talk.words[0].end = 8;
    talk.f0.assign(800, 0);
    for (std::size_t s = 0; s < 800; ++s) talk.f0[s] = 100 + static_cast<float>(s) / 4;
    talk.units.assign(192 * IpuRecord::kUnits, 1);
    talk.head.assign(192 * IpuRecord::kAngles, 0);
    talk.success.assign(192, 1);
    const FaceWord word = face_units(talk).front().words.front();
    EXPECT_EQ(word.f0.size(), kMostSamples);
    EXPECT_FLOAT_EQ(word.f0.front(), 100);
    EXPECT_FLOAT_EQ(word.f0.back(), 100 + 799.0F / 4);
    EXPECT_EQ(word.length, kMostFrames);
    EXPECT_EQ(word.contours.size(), kMostFrames * kFaceChannels);
    EXPECT_EQ(word.frames.count, 192u);
}

TEST(FaceUnits, AWordBetweenTwoFramesHasNone) {
    IpuRecord talk = small_talk(2, 1);
    talk.words[0].end = talk.words[1].start = 0.3 / 24;
    talk.words[0].start = 0.1 / 24;
    const FaceUnit unit = face_units(talk).front();
    EXPECT_EQ(unit.words[0].length, 0u);
    EXPECT_TRUE(unit.words[0].contours.empty());
    EXPECT_GT(unit.words[1].length, 0u);
}

TEST(ResampledRows, KeepsBothEndsAndLinesBetween) {
    const std::vector<float> rows{0, 10, 2, 30, 4, 50};
    EXPECT_THAT(resampled_rows(rows, 2, 5), ElementsAre(0, 10, 1, 20, 2, 30, 3, 40, 4, 50));
    EXPECT_THAT(resampled_rows(rows, 2, 1), ElementsAre(0, 10));
}

TEST(FaceBatch, HasTheShapesThatItDocuments) {
    const std::vector<FaceUnit> units = small_units(2, 7);  // of 7 and 8 words
    const FaceBatch batch = batch_of(units);
    const int64_t samples = batch.f0_tokens.size(0), frames = batch.contours.size(1);
    EXPECT_EQ(batch.slots.sizes(), (std::vector<int64_t>{2, 8}));
    EXPECT_EQ(batch.present.sum().item<int64_t>(), 15);
    EXPECT_FALSE(batch.present[0][7].item<bool>());
    EXPECT_EQ(batch.vectors.sizes(), (std::vector<int64_t>{15, 768}));
    EXPECT_EQ(batch.samples.elements.size(0), samples);
    EXPECT_EQ(batch.samples.word.size(0), samples + 15);
    EXPECT_EQ(batch.contours.size(0), 9);
    EXPECT_EQ(batch.frames.elements.size(0), frames);
    EXPECT_THAT(batch.words_of_units(), ElementsAre(7, 8));
}

TEST(FaceBatch, QuantisesToHundredStepsOfEachRange) {
    const IpuRecord talk = small_talk(5, 3);
    const FaceBatch batch = batch_of(face_units(talk));
    for (std::size_t t = 0; t < talk.frames(); ++t) {
        EXPECT_EQ(batch.contours[0][static_cast<int64_t>(t)].item<int>(),
                  std::lround(talk.units[t * IpuRecord::kUnits] / 5 * 100));
        EXPECT_EQ(batch.contours[6][static_cast<int64_t>(t)].item<int>(),
                  std::lround((talk.head[t * IpuRecord::kAngles] + 1) / 2 * 100));
    }
    EXPECT_EQ(batch.f0_tokens[0].item<int>(), token_of_pitch(talk.f0[0]));
}

TEST(FaceBatch, LaysWordsOutByUnitAndBack) {
    const FaceBatch batch = batch_of(small_units(3, 4));
    const torch::Tensor of_words = torch::rand({9, batch.words(), 5});
    const torch::Tensor of_units = batch.by_unit(of_words);
    EXPECT_EQ(of_units.sizes(), (std::vector<int64_t>{9, 3, 6, 5}));
    EXPECT_EQ(of_units[0][0][5].abs().sum().item<double>(), 0);
    EXPECT_EQ(distance(batch.by_word(of_units), of_words), 0);
}

TEST(FaceBatch, AveragesTheElementsOfEachWord) {
    const Rows rows = make_rows({2, 0, 3});
    const torch::Tensor values = torch::tensor({1.0F, 3.0F, 2.0F, 4.0F, 9.0F}).unsqueeze(1);
    EXPECT_LT(distance(rows.means(values).squeeze(1), torch::tensor({2.0F, 0.0F, 5.0F})), 1e-6);
    EXPECT_EQ(distance(rows.gathered(rows.spread(values)), values), 0);
    const torch::Tensor shares = shares_of_levels(torch::tensor({{0, 1, 1, 1, 0}}), rows, 2);
    EXPECT_LT(distance(shares[0], torch::tensor({{0.5F, 0.5F}, {0.0F, 0.0F}, {1 / 3.0F, 2 / 3.0F}})), 1e-6);
}

TEST(FaceBatch, GathersUnitsUntilTheirWordsSuffice) {
    const std::vector<FaceUnit> units = small_units(5, 10);  // of 10 to 14 words
    EXPECT_THAT(batches_of_words(units, {4, 3, 2, 1, 0}, 27),
                ElementsAre(ElementsAre(4u, 3u), ElementsAre(2u, 1u, 0u)));
}

TEST(DecodedFace, TakesTheLikeliestLevelOrTheMean) {
    // Half the frames' likelihood at level 0, the rest shared by levels 100 and 50.
    torch::Tensor logits = torch::full({1, 101}, -1e9F);
    logits[0][0] = std::log(0.5F);
    logits[0][50] = logits[0][100] = std::log(0.25F);
    const FaceLogits channels(kFaceChannels, logits);
    EXPECT_LT(distance(decoded_face(channels, FaceDecoding::argmax), torch::zeros({1, 9})), 1e-6);
    EXPECT_LT(distance(decoded_face(channels, FaceDecoding::expectation), torch::full({1, 9}, 0.375F)), 1e-6);
}

TEST(FaceLoss, IsTheLogarithmOfTheLevelsForEachChannelThatKnowsNothing) {
    const FaceLogits logits(kFaceChannels, torch::zeros({4, 101}));
    const torch::Tensor contours = torch::randint(0, 101, {9, 4}, torch::kInt64);
    EXPECT_NEAR(face_loss(logits, contours).item<double>(), 9 * std::log(101.0), 1e-4);
}

// A voice a fifth higher runs alike: its distances from its mean stay, its mean is log2(1.5) higher.
TEST(FaceBatch, RelativePitchIsOfTheUnitsOwnLevelAndRange) {
    FaceUnit unit;
    unit.words = {{.f0 = {100, 200}}, {.f0 = {}}, {.f0 = {200, 400}}};
    const RelativePitch low(unit);
    EXPECT_NEAR(low.mean, std::log2(200.0), 1e-9);
    EXPECT_NEAR(low.deviation, std::sqrt(0.5), 1e-9);
    for (FaceWord& word : unit.words) {
        for (float& f0 : word.f0) f0 *= 1.5F;
    }
    const RelativePitch high(unit);
    const auto one = low.of(400), other = high.of(600);
    EXPECT_NEAR(one[0], std::sqrt(2.0), 1e-5);
    EXPECT_NEAR(other[0], one[0], 1e-5);
    EXPECT_NEAR(other[1] - one[1], std::log2(1.5), 1e-5);
    EXPECT_NEAR(one[2], 4 * std::sqrt(0.5), 1e-5);
    EXPECT_NEAR(other[2], one[2], 1e-5);
}

TEST(FaceBatch, RelativePitchOfOneToneIsFinite) {
    FaceUnit unit;
    unit.words = {{.f0 = {120, 120}}};
    EXPECT_NEAR(RelativePitch(unit).of(120)[0], 0, 1e-6);
    unit.words = {{.f0 = {}}};
    EXPECT_EQ(RelativePitch(unit).deviation, 1);
}

}  // namespace
}  // namespace chironomia
