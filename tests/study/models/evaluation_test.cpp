#include "study/models/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/writer.h"
#include "core/random.h"
#include "core/text.h"
#include "study/models/evaluation_baselines.h"
#include "study/models/evaluation_tables.h"
#include "study/models/recorded_rows.h"
#include "study/models/style_maps.h"
#include "study/published/published.h"
#include "tests/study/sample_predictions.h"
#include "tests/support/support.h"
#include "tests/synth/corpus/sample_records.h"

namespace chironomia::study {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::refusal_of;
using testing::sample_dyad;
using testing::sample_faces;

const Bootstrapped& score(const std::vector<MetricScore>& scores, const std::string& metric) {
    return std::find_if(scores.begin(), scores.end(),
                        [&](const MetricScore& s) { return s.metric == metric; })
        ->result;
}

TEST(Evaluate, KnowsTheErrorsOfShiftedSeries) {
    const Evaluation found = evaluate({sample_faces()});
    ASSERT_EQ(found.systems.size(), 1u);
    const SystemScores& system = found.systems[0];
    EXPECT_EQ(system.items, 3u);
    EXPECT_EQ(system.frames, 144u);
    EXPECT_NEAR(*score(system.overall, "rmse").value, 0.15, 1e-6);
    EXPECT_NEAR(*score(system.overall, "mae").value, 0.15, 1e-6);
    EXPECT_NEAR(*score(system.overall, "pcc").value, 1, 1e-6);
    const FeatureScores &brow = system.features[0], &turn = system.features[1];
    EXPECT_NEAR(*score(brow.scores, "rmse").value, 0.1, 1e-6);
    EXPECT_NEAR(*score(brow.scores, "rmse_raw").value, 0.5, 1e-6);
    EXPECT_NEAR(*score(turn.scores, "rmse_raw").value, 0.4, 1e-6);
    EXPECT_NEAR(*score(turn.scores, "pcc_utterance").value, 1, 1e-6);
}

// Every utterance has the same errors, so resamples cannot differ.
TEST(Evaluate, GivesIntervalsOverUtterances) {
    const Evaluation found = evaluate({sample_faces()});
    const Bootstrapped& rmse = score(found.systems[0].overall, "rmse");
    EXPECT_NEAR(rmse.ci_95->low, *rmse.value, 1e-9);
    EXPECT_NEAR(rmse.ci_95->high, *rmse.value, 1e-9);
    const Evaluation one = evaluate({sample_faces("model2", 1)});
    EXPECT_FALSE(score(one.systems[0].overall, "rmse").ci_95);
    EXPECT_THAT(one.notes, ElementsAre("one record alone: there are no intervals"));
}

// 0.1 above rest is an intensity of 0.5 and a little: on the raw scale every frame of AU1 is active.
TEST(Evaluate, CountsActivationsOnTheScaleThatIsAskedFor) {
    Predictions high = sample_faces();
    for (PredictedItem& item : high.items) {
        for (std::size_t i = 0; i < item.prediction.size(); i += 2) item.prediction[i] += 0.01f;
    }
    const FeatureScores raw = evaluate({high}).systems[0].features[0];
    EXPECT_NEAR(*score(raw.scores, "ahr").value, 200, 1e-9);
    EXPECT_NEAR(*score(raw.scores, "nahr").value, 0, 1e-9);
    EXPECT_NEAR(*score(raw.scores, "precision").value, 0.5, 1e-9);
    const FeatureScores normalised =
        evaluate({high}, {.activation = ActivationScale::normalised}).systems[0].features[0];
    EXPECT_NEAR(*score(normalised.scores, "ahr").value, 100, 1e-9);
    EXPECT_NEAR(*score(normalised.scores, "recall").value, 1, 1e-9);
    EXPECT_EQ(evaluate({high}).systems[0].features[1].scores.size(), 6u) << "head turns have no activation";
}

TEST(Evaluate, CountsUtterancesInWhichNothingVaries) {
    Predictions flat = sample_faces();
    for (std::size_t i = 0; i < flat.items[1].prediction.size(); i += 2) flat.items[1].prediction[i] = 0.3f;
    const FeatureScores brow = evaluate({flat}).systems[0].features[0];
    EXPECT_EQ(brow.utterances_without_pcc, 1u);
    EXPECT_NEAR(*score(brow.scores, "pcc_utterance").value, 1, 1e-6);
    EXPECT_LT(*score(brow.scores, "pcc").value, 0.99);
}

// One system holds Rx still, and another holds all: of AU1 alone two systems have a correlation.
TEST(Evaluate, AveragesCorrelationsOverFeaturesOfWhichAllSystemsHaveOne) {
    Predictions worse = sample_faces("worse"), still = sample_faces("still");
    for (PredictedItem& item : worse.items)
        for (std::size_t i = 1; i < item.prediction.size(); i += 4) item.prediction[i] = 0;
    Predictions flat = sample_faces("flat");
    for (PredictedItem& item : flat.items)
        for (std::size_t i = 1; i < item.prediction.size(); i += 2) item.prediction[i] = 0.3f;
    for (PredictedItem& item : still.items) std::ranges::fill(item.prediction, 0.3f);
    EXPECT_LT(*score(evaluate({worse, still}).systems[0].overall, "pcc").value, 0.9);
    const Evaluation found = evaluate({worse, flat, still});
    EXPECT_NEAR(*score(found.systems[0].overall, "pcc").value, 1, 1e-6);
    EXPECT_NEAR(*score(found.systems[1].overall, "pcc").value, 1, 1e-6);
    EXPECT_FALSE(score(found.systems[2].overall, "pcc").value);
    EXPECT_THAT(found.notes,
                Contains("PCC of all features together: over 1 of 2; those do not vary, or people's do "
                         "not: Rx (of flat)"));
}

TEST(Evaluate, ComparesAModelWithPeopleInTheSamePair) {
    Predictions still = sample_dyad("il-lstm", 0);
    for (PredictedItem& item : still.items) std::fill(item.prediction.begin(), item.prediction.end(), 0.0f);
    const Evaluation found = evaluate({sample_dyad("amii", 0), still});
    ASSERT_EQ(found.systems.size(), 3u);
    EXPECT_EQ(found.systems[0].model, "people");
    EXPECT_THAT(found.systems[0].overall, IsEmpty());
    const std::vector<MetricScore>& people = found.systems[0].pair->scores;
    EXPECT_NEAR(*score(people, "tlcc").value, 1, 0.01);
    const PairScores &same = *found.systems[1].pair, &none = *found.systems[2].pair;
    for (const char* metric : {"tlcc", "dtw", "sync", "el"})
        EXPECT_EQ(score(same.gaps, metric).value, 0) << metric;
    EXPECT_FALSE(score(none.scores, "tlcc").value) << "a still face correlates with nothing";
    for (const char* metric : {"sync", "el"}) {
        EXPECT_GT(*score(people, metric).value, 0);
        EXPECT_DOUBLE_EQ(*score(none.gaps, metric).value, -*score(people, metric).value);
    }
}

TEST(Evaluate, SaysWhatShortRecordsLeaveOut) {
    Predictions brief = sample_dyad("amii", 0);
    for (PredictedItem& item : brief.items) {
        for (auto* rows : {&item.truth, &item.prediction, &item.partner}) rows->resize(100);
    }
    EXPECT_THAT(evaluate({brief}).notes,
                ElementsAre("one record alone: there are no intervals", HasSubstr("TLCC: no record has 8 s"),
                            HasSubstr("DTW: no record is 60 s long")));
}

// The people of a dyad act on each other: both are drawn, or none. Here dyads are alike, and their people are not.
TEST(Evaluate, DrawsBothPeopleOfADyad) {
    Predictions all = sample_dyad("amii", 0);
    for (float& value : all.items[1].prediction) value += 0.2f;
    for (const std::size_t person : {0, 1}) {
        all.items.push_back(all.items[person]);
        all.items.back().id = format("d1:{}", person);
    }
    const Evaluation found = evaluate({all});
    const SystemScores& system = found.systems[1];
    EXPECT_EQ(system.items, 4u);
    EXPECT_EQ(system.records, 2u);
    const Bootstrapped& rmse = score(system.overall, "rmse");
    EXPECT_NEAR(*rmse.value, 0.2 / std::sqrt(2), 1e-6);
    EXPECT_NEAR(rmse.ci_95->low, *rmse.value, 1e-9);
    EXPECT_NEAR(rmse.ci_95->high, *rmse.value, 1e-9);
}

TEST(Evaluate, RefusesModelsThatWereAskedAboutOtherRecords) {
    const auto refusal = [](const std::function<void(Predictions&)>& change) {
        Predictions other = sample_faces("model1");
        change(other);
        return refusal_of([&] { evaluate({sample_faces(), other}); });
    };
    EXPECT_THAT(refusal([](Predictions& p) { p.split = "unseen"; }),
                HasSubstr("model2 and model1: they predict talks/test and talks/unseen; evaluate models "
                          "together that were asked about the same records"));
    EXPECT_THAT(refusal([](Predictions& p) { p.features[0] = "AU2"; }),
                HasSubstr("they predict AU1, Rx and AU2, Rx"));
    EXPECT_THAT(refusal([](Predictions& p) { p.items.pop_back(); }),
                HasSubstr("they predict 3 and 2 records"));
    EXPECT_THAT(refusal([](Predictions& p) { p.items[2].id = "s9"; }), HasSubstr("they predict s2 and s9"));
    EXPECT_THAT(refusal([](Predictions& p) { p.items[0].truth.resize(10); }),
                HasSubstr("they predict 48 and 5 frames of s0"));
    EXPECT_THAT(refusal([](Predictions& p) { p.fps = 30; }), HasSubstr("they have 24 and 30 frames/s"));
    EXPECT_THAT(refusal([](Predictions& p) {
                    p.scale[0] = {0, 1};
                }),
                HasSubstr("0 and 1 of AU1 are 0 and 5, and 0 and 1"));
    EXPECT_THAT(refusal([](Predictions& p) { p.items[1].truth[2 * 7] = 0.9f; }),
                HasSubstr("what the person did in frame 7 of s1 is AU1 1.0000 and 0.9000"));
}

// A corpus of talks in whose training records AU1 is 1 of 5 and Rx a quarter of its scale above 0.
CorpusIndex corpus_of_one_talk(const std::filesystem::path& folder) {
    constexpr std::size_t kFrames = 24;
    IpuRecord record{.id = "s0_0000", .speaker = "s0", .source = "made", .fps = 24};
    record.words = {{.text = "well", .start = 0, .end = 1}};
    record.vectors.assign(kWordVector, 0.5f);
    record.f0.assign(100, 120);
    record.f0_strength.assign(100, 1);
    record.voice.assign(100 * IpuRecord::kVoice, 0.1f);
    for (std::size_t t = 0; t < kFrames; ++t) {
        record.units.insert(record.units.end(), {1, 0, 0, 0, 0, 0});
        record.head.insert(record.head.end(), {0.5f, 0, 0});
    }
    record.success.assign(kFrames, 1);
    record.confidence.assign(kFrames, 1);
    CorpusIndex index{.folder = folder, .kind = CorpusKind::talks};
    index.entries = {{.id = record.id, .speaker = "s0", .split = Split::train, .seconds = 1}};
    write_ipu(folder, record);
    return index;
}

TEST(Baselines, HoldWhatWasHalfASecondBefore) {
    const Predictions held = baseline("hold", sample_faces(), {});
    EXPECT_EQ(held.model, "hold");
    const PredictedItem& item = held.items[0];
    EXPECT_EQ(item.prediction[0], item.truth[0]);
    EXPECT_EQ(item.prediction[2 * 11 + 1], item.truth[1]);
    EXPECT_EQ(item.prediction[2 * 40 + 1], item.truth[2 * 28 + 1]);
}

TEST(Baselines, SayAlwaysTheMeanOfTheTrainingRecords) {
    const testing::TemporaryFolder folder;
    const CorpusIndex corpus = corpus_of_one_talk(folder.path());
    const Predictions mean = baseline("mean", sample_faces(), corpus);
    EXPECT_EQ(mean.model, "mean");
    EXPECT_FLOAT_EQ(mean.items[1].prediction[20], 0.2f);
    EXPECT_FLOAT_EQ(mean.items[1].prediction[21], 0.5f);
    Predictions smiles = sample_faces();
    smiles.features[0] = "AU12";
    EXPECT_THAT(refusal_of([&] { baseline("mean", smiles, corpus); }),
                HasSubstr("its training records have no \"AU12\"; leave out --against mean"));
    EXPECT_THAT(
        refusal_of([&] { check_baseline("mean", {.folder = "poses", .kind = CorpusKind::intervals}); }),
        EndsWith("poses: --against mean is made of faces, in talks and dyads, and this corpus has intervals, "
                 "which are of bodies; leave it out"));
    check_baseline("hold", {.folder = "poses", .kind = CorpusKind::intervals});
}

// The people of a dyad from a frame on, AU12 alone.
Predictions smiles_of(const DyadRecord& record, std::size_t first) {
    Predictions all{
        .model = "m", .corpus = "dyads", .split = "test", .features = {"AU12"}, .scale = {{0, 5}}};
    for (const std::size_t person : {0, 1}) {
        PredictedItem item{.id = format("{}:{}", record.id, person),
                           .speaker = record.people[person].participant};
        for (std::size_t t = first; t < record.frames(); ++t) {
            const std::size_t i = t * DyadPerson::kFace + 9;
            item.truth.push_back(record.people[person].face[i] / 5);
            item.partner.push_back(record.people[1 - person].face[i] / 5);
        }
        item.prediction = item.truth;
        all.items.push_back(std::move(item));
    }
    return all;
}

TEST(CheckTruth, ComparesBothPeopleOfADyad) {
    const testing::TemporaryFolder folder;
    const DyadRecord record = testing::sample_dyad("d1", "anna", "ben");
    write_dyad(folder.path(), record);
    const CorpusIndex corpus{
        .folder = folder.path(),
        .kind = CorpusKind::dyads,
        .entries = {{.id = "d1", .speaker = "anna+ben", .split = Split::test, .seconds = 4}}};
    EXPECT_THAT(check_truth(smiles_of(record, 25), corpus, "p.h5"), IsEmpty());
    Predictions changed = smiles_of(record, 25);
    changed.items[1].partner[7] += 0.1f;
    EXPECT_THAT(refusal_of([&] { check_truth(changed, corpus, "p.h5"); }),
                HasSubstr("p.h5: /truth of d1:1: partner's AU12 of frame 7 is "));
    changed = smiles_of(record, 0);
    std::reverse(changed.items[0].truth.begin(), changed.items[0].truth.end());
    EXPECT_THAT(refusal_of([&] { check_truth(changed, corpus, "p.h5"); }),
                HasSubstr("p.h5: /truth of d1:0: "));
    changed = smiles_of(record, 50);
    for (auto* rows : {&changed.items[0].truth, &changed.items[0].partner}) rows->front() = rows->back();
    EXPECT_THAT(refusal_of([&] { check_truth(changed, corpus, "p.h5"); }),
                HasSubstr("/truth of d1:0 goes on behind the last frame of its record in " +
                          folder.path().string() + ", which has 100; give its frames in their order"));
    Predictions open = smiles_of(record, 0);
    open.features = {"AU25"};
    EXPECT_THAT(check_truth(open, corpus, "p.h5"),
                ElementsAre("p.h5: no record of " + folder.path().string() +
                            " has AU25, so what people did there was not compared"));
}

TEST(CheckTruth, ComparesPointsThatWereSeen) {
    const testing::TemporaryFolder folder;
    const IntervalRecord record = testing::sample_interval("a_1", "anna");
    write_interval(folder.path(), record);
    CorpusIndex corpus{.folder = folder.path(),
                       .kind = CorpusKind::intervals,
                       .entries = {{.id = "a_1", .speaker = "anna", .split = Split::train, .seconds = 2}}};
    write_corpus_index(corpus);
    Predictions points{.model = "m",
                       .corpus = "points",
                       .split = "test",
                       .fps = 15,
                       .features = {"RWrist x", "RHandRoot y"},
                       .scale = {{-100, 100}, {0, 50}}};
    PredictedItem item{.id = "a_1>ben", .speaker = "anna", .style = "ben"};
    for (std::size_t t = 0; t < record.frames(); ++t) {
        const float* places = &record.pose_normalized[t * 2 * IntervalRecord::kJoints];
        item.truth.insert(item.truth.end(), {(places[3] + 100) / 200, places[52 + 31] / 50});
    }
    item.prediction = item.truth;
    points.items = {item};
    EXPECT_THAT(check_truth(points, corpus, "p.h5"), IsEmpty());
    points.items[0].truth[2 * 4] += 0.3f;
    EXPECT_THAT(refusal_of([&] { check_truth(points, corpus, "p.h5"); }),
                HasSubstr("p.h5: /truth of a_1>ben: RWrist x of frame 4 is "));
}

// A wrist that goes round, and a tracker's noise on what is recorded.
std::vector<float> wrist_round(double turns_per_s, double noise, std::uint64_t seed) {
    std::vector<float> places;
    Random random(seed);
    for (int t = 0; t < 120; ++t) {
        const double angle = 2 * std::numbers::pi * turns_per_s * t / 15;
        for (const double place : {std::cos(angle), std::sin(angle)})
            places.push_back(static_cast<float>(0.3 * place + noise * random.normal()));
    }
    return places;
}

// Moved as ben moves, but for the noise that only a tracker has.
TEST(ScoreStyles, MayLeaveOutTheNoiseOfTrackers) {
    Predictions predictions{
        .model = "m", .fps = 15, .features = {"RWrist x", "RWrist y"}, .scale = {{0, 100}, {0, 100}}};
    for (const bool is_ben : {false, true}) {
        PredictedItem own{.id = is_ben ? "b" : "a", .speaker = is_ben ? "ben" : "anna"};
        own.truth = own.prediction = wrist_round(is_ben ? 0.8 : 0.4, 0.004, is_ben ? 1 : 2);
        predictions.items.push_back(own);
    }
    predictions.items.push_back({.id = "a>ben", .speaker = "anna", .style = "ben"});
    predictions.items[2].truth = predictions.items[0].truth;
    predictions.items[2].prediction = wrist_round(0.8, 0, 3);
    const auto far = [&](StyleMetric metric, StylePoints points) {
        return score_styles(predictions, kUtterances, points)
            ->distances[static_cast<std::size_t>(metric)]
            ->model;
    };
    EXPECT_LT(far(StyleMetric::wrist_velocity, StylePoints::raw), 10);
    EXPECT_GT(far(StyleMetric::wrist_jerk, StylePoints::raw), 60);
    EXPECT_LT(far(StyleMetric::wrist_jerk, StylePoints::smoothed), 40);
}

TEST(Published, HoldsWhatThePapersPrint) {
    EXPECT_EQ(published_value("amii", "", "dtw"), 1319.6);
    EXPECT_EQ(published_value("amii-noE_m", "", "mae"), 0.099);
    EXPECT_EQ(published_value("model2", "AU2", "pcc"), 0.92);
    EXPECT_EQ(published_value("model1", "Rz", "rmse"), 0.22);
    EXPECT_FALSE(published_value("model2", "Rx", "ahr"));
    EXPECT_FALSE(published_value("model9", "", "mae"));
}

TEST(Published, GivesEachTableASourceAndColumnsForItsValues) {
    EXPECT_GE(published_tables().size(), 7u);
    for (const PublishedTable& table : published_tables()) {
        EXPECT_THAT(table.source + table.place + table.corpus, Not(HasSubstr("?")));
        for (const PublishedRow& row : table.rows) {
            for (const auto& [key, value] : row.values)
                EXPECT_THAT(table.columns,
                            Contains(::testing::Field(&std::pair<std::string, std::string>::first, key)))
                    << table.id;
        }
    }
}

TEST(EvaluationTables, ShowPublishedNumbersInColumnsOfTheirOwn) {
    const Evaluation found = evaluate({sample_faces(), sample_faces("mine")});
    const std::vector<analysis::Table> tables = tables_of(found);
    ASSERT_EQ(tables.size(), 2u);
    const Json rows = to_json(tables[1]);
    EXPECT_EQ(rows[0]["rmse_published"], 0.193);
    EXPECT_NEAR(rows[0]["rmse"].get<double>(), 0.1, 1e-6);
    EXPECT_TRUE(rows[2]["rmse_published"].is_null()) << "nobody published \"mine\"";
    for (const analysis::Column& column : tables[0].columns)
        EXPECT_THAT(column.key, Not(HasSubstr("published")));
    const std::vector<analysis::Table> published = published_beside(found);
    ASSERT_EQ(published.size(), 1u);
    EXPECT_THAT(published[0].title, HasSubstr("Table 5.8"));
    EXPECT_THAT(published[0].note, HasSubstr("Measured on other data: TEDx"));
    EXPECT_THAT(published_beside(evaluate({sample_faces("mine")})), IsEmpty());
}

// Nobody else is there to be near.
TEST(EvaluationTables, HaveNoNeighboursOfASingleSpeaker) {
    StyleEncodings encodings{.model = "m",
                             .speakers = std::vector<std::string>(6, "anna"),
                             .intervals = {"a1", "a2", "a3", "a4", "a5", "b1"}};
    for (Vectors* vectors : {&encodings.style, &encodings.content})
        *vectors = {.width = 1, .values = {1, 2, 3, 4, 5, 6}};
    const Json alone = analysis::to_json(encodings_table({encodings}));
    EXPECT_TRUE(alone[0]["neighbours"].is_null());
    EXPECT_TRUE(alone[0]["silhouette"].is_null());
    encodings.speakers[5] = "ben";
    EXPECT_TRUE(analysis::to_json(encodings_table({encodings}))[0]["neighbours"].is_number());
}

TEST(ReadEncodings, RefusesIntervalsThatAreNotThoseOfTheSegments) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "encodings.h5";
    Hdf5Writer writer(file.string(), file.string());
    writer.write_texts("speakers", {"anna", "ben"});
    writer.write_texts("intervals", {"a1"});
    writer.close();
    EXPECT_EQ(testing::refusal_of([&] { read_encodings(file, "m"); }),
              file.string() + ": /intervals has 1 names, /speakers 2; encode the styles again");
}

// Segments of an interval are alike, and those of a speaker are not: a probe that learned from segments of the interval
// that judges it would find all of them.
TEST(EvaluationTables, JudgeAProbeByIntervalsThatItHasNotSeen) {
    StyleEncodings encodings{.model = "m"};
    for (std::size_t speaker = 0; speaker < 2; ++speaker) {
        for (std::size_t interval = 0; interval < 6; ++interval) {
            for (std::size_t segment = 0; segment < 6; ++segment) {
                encodings.speakers.push_back(speaker == 0 ? "anna" : "ben");
                encodings.intervals.push_back(format("{}{}", encodings.speakers.back(), interval));
                // A place of its own for each interval, on its own axis.
                for (std::size_t axis = 0; axis < 12; ++axis)
                    encodings.style.values.push_back(axis == 6 * speaker + interval ? 1 : 0);
            }
        }
    }
    encodings.style.width = 12;
    encodings.content = encodings.style;
    const Json row = analysis::to_json(encodings_table({encodings}))[0];
    EXPECT_EQ(row["n"], 72);
    EXPECT_LE(row["probe"].get<double>(), 0.5) << "no better than chance";
    EXPECT_LE(row["neighbours"].get<double>(), 0.5) << "all others are equally far";
}

TEST(EvaluationTables, ShowPeopleAboveModels) {
    const Evaluation found = evaluate({sample_dyad("amii", 0)});
    const std::vector<analysis::Table> tables = tables_of(found);
    ASSERT_EQ(tables.size(), 3u);
    const Json rows = to_json(tables[2]);
    EXPECT_EQ(rows[0]["model"], "people");
    EXPECT_EQ(rows[0]["tlcc_published"], 0.334);
    EXPECT_EQ(rows[1]["dtw_gap"], 0);
    EXPECT_THAT(analysis::to_text(tables[2]), HasSubstr("Sync [s/min] (proposed)"));
    EXPECT_EQ(to_json(tables[0]).size(), 1u) << "people make no errors";
}

TEST(EvaluationTables, AreWrittenInEveryForm) {
    const testing::TemporaryFolder folder;
    const Evaluation found = evaluate({sample_dyad("amii", 10)});
    write_evaluation(folder.path(), found);
    const std::string csv = read_text(folder / "summary.csv");
    EXPECT_THAT(csv, HasSubstr("model,n,frames,mae,mae_low,mae_high,mae_published,rmse"));
    EXPECT_THAT(csv, HasSubstr("amii,2,6000,"));
    EXPECT_THAT(read_text(folder / "published/amii.csv"), HasSubstr("AMII-noE_m,,0.099"));
    EXPECT_THAT(read_text(folder / "tables.tex"), HasSubstr("\\label{tab:published-amii}"));
    const Json json = read_json(folder / "evaluation.json");
    EXPECT_EQ(json["tables"]["pairs"].size(), 2u);
    EXPECT_EQ(json["published"]["amii"]["rows"].size(), 8u);
    write_evaluation(folder.path(), evaluate({sample_dyad("amii", 10)}));
    EXPECT_EQ(read_json(folder / "evaluation.json"), json) << "the same predictions, the same numbers";
}

}  // namespace
}  // namespace chironomia::study
