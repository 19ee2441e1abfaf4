#include "synth/corpus/statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::refusal_of;
using testing::sample_dyad;
using testing::sample_index;
using testing::sample_interval;
using testing::sample_talks;
using testing::TemporaryFolder;

TEST(FeatureScale, GoesThereAndBack) {
    const FeatureScale scale{.zero = 50, .one = 550, .is_clamped = true};
    EXPECT_EQ(scale.normalised(50), 0);
    EXPECT_EQ(scale.normalised(300), 0.5);
    EXPECT_EQ(scale.normalised(900), 1);
    EXPECT_EQ(scale.restored(0.5), 300);
}

TEST(Statistics, OfTalksAreFixed) {
    const TemporaryFolder folder;
    const CorpusStatistics found = measure_statistics(sample_talks(folder.path()));
    EXPECT_EQ(found.records, 2u);
    EXPECT_EQ(found.seconds, 4);
    EXPECT_EQ(found.of("au").size(), IpuRecord::kUnits);
    EXPECT_EQ(found.of("au")[0].normalised(2.5), 0.5);
    EXPECT_EQ(found.of("head")[2].normalised(0.5), 0.75);
    EXPECT_EQ(found.of("f0")[0].normalised(50), 0);
}

// One dyad to learn from and one to be judged by.
CorpusIndex dyads(const std::filesystem::path& folder, double phase_of_test) {
    DyadRecord train = sample_dyad("d1", "p1", "p2"), test = sample_dyad("d2", "p3", "p4", phase_of_test);
    // The first number of a face is 0, 1, ... 99 and that of its partner 100 ... 199, out of order.
    for (std::size_t t = 0; t < 100; ++t) {
        train.people[0].face[t * DyadPerson::kFace] = static_cast<float>(t * 37 % 100) / 100;
        train.people[1].face[t * DyadPerson::kFace] = static_cast<float>(100 + t * 37 % 100) / 100;
        for (DyadPerson& person : train.people) person.face[t * DyadPerson::kFace + 1] = 0.25f;
    }
    write_dyad(folder, train);
    write_dyad(folder, test);
    CorpusIndex index = sample_index(folder, CorpusKind::dyads,
                                     {{.id = "d1", .speaker = "p1+p2", .split = Split::train, .seconds = 4},
                                      {.id = "d2", .speaker = "p3+p4", .split = Split::test, .seconds = 4}});
    write_corpus_index(index);
    return index;
}

TEST(Statistics, OfDyadsArePercentiles) {
    const TemporaryFolder folder;
    const CorpusStatistics found = measure_statistics(dyads(folder.path(), 0));
    // Of 0, 1, ... 199: the places 1.99 and 197.01.
    EXPECT_NEAR(found.of("face")[0].zero, 0.0199, 1e-7);
    EXPECT_NEAR(found.of("face")[0].one, 1.9701, 1e-7);
    EXPECT_TRUE(found.of("face")[0].is_clamped);
    // What does not vary becomes 0.
    EXPECT_EQ(found.of("face")[1].normalised(0.25), 0);
    EXPECT_EQ(found.of("speech").size(), DyadPerson::kSpeech);
}

CorpusIndex intervals(const std::filesystem::path& folder, double phase_of_others) {
    IntervalRecord train = sample_interval("i1", "a");
    // A coordinate that is 3 in half of the frames and 7 in the others: mean 5, standard deviation 2.
    for (std::size_t t = 0; t < train.frames(); ++t)
        train.pose[t * 2 * IntervalRecord::kJoints + 5] = t % 2 == 0 ? 3.0f : 7.0f;
    write_interval(folder, train);
    write_interval(folder, sample_interval("i2", "a", phase_of_others));
    write_interval(folder, sample_interval("i3", "b", phase_of_others));
    CorpusIndex index = sample_index(folder, CorpusKind::intervals,
                                     {{.id = "i1", .speaker = "a", .split = Split::train, .seconds = 2},
                                      {.id = "i2", .speaker = "a", .split = Split::test, .seconds = 2},
                                      {.id = "i3", .speaker = "b", .split = Split::unseen, .seconds = 2}});
    write_corpus_index(index);
    return index;
}

TEST(Statistics, OfIntervalsAreMeanAndTwoDeviations) {
    const TemporaryFolder folder;
    const CorpusStatistics found = measure_statistics(intervals(folder.path(), 1));
    EXPECT_NEAR(found.of("pose/data")[5].zero, 5, 1e-9);
    EXPECT_NEAR(found.of("pose/data")[5].one, 9, 1e-9);
    EXPECT_NEAR(found.of("pose/data")[5].normalised(7), 0.5, 1e-9);
    EXPECT_EQ(found.of("audio/log_mel_512").size(), 1u);
    EXPECT_EQ(found.of("text/bert").size(), kWordVector);
    EXPECT_EQ(found.of("face/data").size(), 2 * IntervalRecord::kFacePoints);
}

// What a point that stands still varies by is its tracker's noise, in whatever unit the shoulders are 100 apart.
TEST(Statistics, OfNormalisedPointsDeviateByTwoPercentOfTheShouldersAtLeast) {
    constexpr std::size_t kJoints = IntervalRecord::kJoints;
    for (const float unit : {1.0f, 0.01f, 3.0f}) {
        const TemporaryFolder folder;
        IntervalRecord train = sample_interval("i1", "a");
        for (std::size_t t = 0; t < train.frames(); ++t) {
            const float side = t % 2 == 0 ? 1.0f : -1.0f;
            const std::pair<std::size_t, float> numbers[] = {
                {1, -50},          {4, 50}, {1 + kJoints, 0}, {4 + kJoints, 0}, {6, 5 + 0.5f * side},
                {7, 5 + 10 * side}};
            for (const auto& [column, value] : numbers) {
                for (std::vector<float>* pose : {&train.pose, &train.pose_normalized})
                    (*pose)[t * 2 * kJoints + column] = unit * value;
                train.pose_confidence[t * 2 * kJoints + column] = 1;
            }
        }
        write_interval(folder.path(), train);
        const CorpusIndex index =
            sample_index(folder.path(), CorpusKind::intervals,
                         {{.id = "i1", .speaker = "a", .split = Split::train, .seconds = 2}});
        write_corpus_index(index);
        const CorpusStatistics found = measure_statistics(index);
        EXPECT_NEAR(found.of("pose/data")[6].one, 6 * unit, 1e-4 * unit);
        EXPECT_NEAR(found.of("pose/normalize")[6].zero, 5 * unit, 1e-4 * unit);
        EXPECT_NEAR(found.of("pose/normalize")[6].one, 9 * unit, 1e-4 * unit);
        EXPECT_NEAR(found.of("pose/normalize")[7].one, 25 * unit, 1e-4 * unit);
    }
}

std::string bytes_of(const CorpusIndex& corpus) {
    write_statistics(corpus.folder, measure_statistics(corpus));
    return read_text(corpus.folder / "statistics.json");
}

// Where a tracker lost a point, its place is not its own.
TEST(Statistics, AreOfPointsThatAreSeen) {
    constexpr std::size_t kWidth = 2 * IntervalRecord::kJoints;
    const TemporaryFolder folder;
    IntervalRecord train = sample_interval("i1", "a");
    for (std::size_t t = 0; t < train.frames(); ++t) {
        const std::size_t at = t * kWidth + 5;
        train.pose[at] = train.pose_normalized[at] = t % 2 == 0 ? 3.0f : 7.0f;
        if (t % 4 > 1) continue;
        train.pose[at] = train.pose_normalized[at] = train.pose_confidence[at] = 0;
    }
    write_interval(folder.path(), train);
    const CorpusIndex index =
        sample_index(folder.path(), CorpusKind::intervals,
                     {{.id = "i1", .speaker = "a", .split = Split::train, .seconds = 2}});
    write_corpus_index(index);
    const CorpusStatistics found = measure_statistics(index);
    for (const char* array : {"pose/data", "pose/normalize"}) {
        EXPECT_NEAR(found.of(array)[5].zero, 5, 0.1) << array;
        EXPECT_NEAR(found.of(array)[5].one, 9, 0.1) << array;
    }
}

TEST(Statistics, DoNotChangeByAByteWithTheOtherSplits) {
    const TemporaryFolder one, other;
    EXPECT_EQ(bytes_of(dyads(one / "d", 0.1)), bytes_of(dyads(other / "d", 2.2)));
    EXPECT_EQ(bytes_of(intervals(one / "i", 0.1)), bytes_of(intervals(other / "i", 2.2)));
}

TEST(Statistics, AreReadAsTheyWereWritten) {
    const TemporaryFolder folder;
    const CorpusIndex corpus = dyads(folder.path(), 0);
    const CorpusStatistics measured = measure_statistics(corpus);
    write_statistics(folder.path(), measured);
    const CorpusStatistics read = read_statistics(corpus);
    EXPECT_EQ(read.records, 1u);
    EXPECT_EQ(read.seconds, 4);
    for (std::size_t i = 0; i < DyadPerson::kFace; ++i) {
        EXPECT_EQ(read.of("face")[i].zero, measured.of("face")[i].zero);
        EXPECT_EQ(read.of("face")[i].one, measured.of("face")[i].one);
    }
    EXPECT_TRUE(read.of("face")[0].is_clamped);
}

TEST(Statistics, AreRefusedWithTheirPlace) {
    const TemporaryFolder folder;
    const CorpusIndex corpus = dyads(folder.path(), 0);
    const auto refusal = [&](const std::string& text) {
        write_text(folder / "statistics.json", text);
        return refusal_of([&] { read_statistics(corpus); });
    };
    EXPECT_THAT(refusal(R"({"kind": "talks"})"), HasSubstr("statistics.json: kind: "));
    EXPECT_THAT(refusal(R"({"kind": "dyads", "records": 1, "seconds": 4, "scales": {"face": {}}})"),
                HasSubstr("scales.speech: is missing"));
    const std::string one = R"({"clamped": true, "zero": [0], "one": [1]})";
    EXPECT_THAT(refusal(R"({"kind": "dyads", "records": 1, "seconds": 4, "scales": {"face": )" + one +
                        R"(, "speech": )" + one + "}}"),
                HasSubstr("scales.face: it has 1 columns, 10 are expected"));
    const std::string flat = R"({"clamped": true, "zero": [1], "one": [1]})";
    EXPECT_THAT(refusal(R"({"kind": "dyads", "records": 1, "seconds": 4, "scales": {"face": )" + flat +
                        R"(, "speech": )" + one + "}}"),
                HasSubstr("one[0]: is 1, the same as its zero"));
    EXPECT_THAT(refusal(R"({"kind": "dyads", "records": 1, "seconds": 4, "scales": {"face": )"
                        R"({"clamped": true, "zero": [1], "one": [1, 2]}, "speech": {}}})"),
                HasSubstr("scales.face: there are 1 zeros and 2 ones"));
}

}  // namespace
}  // namespace chironomia
