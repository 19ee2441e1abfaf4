#include "study/models/evaluation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "study/measure/adaptation.h"
#include "study/measure/kolmogorov.h"
#include "study/measure/pointwise.h"
#include "study/measure/time_warping.h"

namespace chironomia::study {
namespace {

constexpr double kActive = 0.5;  // of intensities in [0, 5]
constexpr auto kSmile = "AU12";

using Rows = std::vector<float> PredictedItem::*;
using Statistic = std::function<std::optional<double>(const PairSums&)>;

bool is_unit(const std::string& feature) {
    return feature.starts_with("AU");
}

std::vector<float> column_of(const PredictedItem& item, Rows rows, std::size_t feature, std::size_t width) {
    std::vector<float> column;
    for (std::size_t i = feature; i < (item.*rows).size(); i += width) column.push_back((item.*rows)[i]);
    return column;
}

// What the metrics of one feature need, over all items.
struct FeatureData {
    std::vector<PairSums> sums;                  // by item, normalised
    std::vector<std::optional<double>> pearson;  // by item
    std::vector<float> truth, prediction;        // of all items
    std::vector<std::size_t> items;              // of each frame
    double range = 1;                            // what the normalised 1 is more than 0, in its own unit
};

FeatureData data_of(const Predictions& predictions, std::size_t feature, ActivationScale activation) {
    const std::size_t width = predictions.features.size();
    const auto [low, high] = predictions.scale[feature];
    const double threshold = activation == ActivationScale::raw ? (kActive - low) / (high - low) : kActive;
    FeatureData data{.range = high - low};
    for (std::size_t i = 0; i < predictions.items.size(); ++i) {
        const auto truth = column_of(predictions.items[i], &PredictedItem::truth, feature, width);
        const auto predicted = column_of(predictions.items[i], &PredictedItem::prediction, feature, width);
        data.sums.push_back(sums_of(truth, predicted, threshold, predictions.items[0].truth[feature]));
        data.pearson.push_back(pearson(truth, predicted));
        data.truth.insert(data.truth.end(), truth.begin(), truth.end());
        data.prediction.insert(data.prediction.end(), predicted.begin(), predicted.end());
        data.items.insert(data.items.end(), truth.size(), i);
    }
    return data;
}

PairSums weighed(const std::vector<PairSums>& sums, std::span<const double> weights) {
    PairSums all;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (weights[i] > 0) all.add(sums[i], weights[i]);
    }
    return all;
}

// A metric of one feature as a statistic of how often each item counts.
WeightedStatistic pooled(const FeatureData& data, Statistic statistic) {
    return [&data, statistic = std::move(statistic)](std::span<const double> weights) {
        return statistic(weighed(data.sums, weights));
    };
}

// The mean of a metric over features; none where it is not defined for one of them.
WeightedStatistic mean_over(std::vector<WeightedStatistic> features) {
    return [features = std::move(features)](std::span<const double> weights) -> std::optional<double> {
        ChunkScores mean;
        for (const WeightedStatistic& feature : features) {
            const auto value = feature(weights);
            if (!value) return std::nullopt;
            mean.sum += *value;
            ++mean.count;
        }
        return mean.mean();
    };
}

WeightedStatistic distance_of(const FeatureData& data) {
    return [distance = WeightedDistance({data.truth, data.items}, {data.prediction, data.items})](
               std::span<const double> weights) { return std::optional(distance.at(weights)); };
}

// By item: which record it is of. Both people of a dyad, "d03:0" and "d03:1", are of one, as they act on each other.
std::vector<std::size_t> records_of(const Predictions& predictions) {
    std::map<std::string, std::size_t> numbers;
    std::vector<std::size_t> records;
    for (const PredictedItem& item : predictions.items) {
        const std::string record = item.partner.empty() ? item.id : item.id.substr(0, item.id.rfind(':'));
        records.push_back(numbers.emplace(record, numbers.size()).first->second);
    }
    return records;
}

std::size_t number_of_records(const Predictions& predictions) {
    const std::vector<std::size_t> records = records_of(predictions);
    return *std::ranges::max_element(records) + 1;
}

// Whole records are drawn.
Bootstrapped bootstrap_records(const std::vector<std::size_t>& records, const WeightedStatistic& statistic,
                               const Resampling& resampling) {
    const auto of_items = [&](std::span<const double> weights) {
        std::vector<double> own(records.size());
        std::ranges::transform(records, own.begin(), [&](std::size_t record) { return weights[record]; });
        return statistic(own);
    };
    return bootstrap(*std::ranges::max_element(records) + 1, of_items, resampling);
}

struct NamedStatistic {
    const char* metric;
    WeightedStatistic of;
};

std::vector<NamedStatistic> statistics_of(const FeatureData& data, bool unit) {
    std::vector<NamedStatistic> all = {
        {"rmse", pooled(data, rmse)},
        {"rmse_raw", pooled(data,
                            [range = data.range](const PairSums& sums) {
                                const auto value = rmse(sums);
                                return value ? std::optional(*value * range) : std::nullopt;
                            })},
        {"mae", pooled(data, mean_absolute_error)},
        {"pcc", pooled(data, [](const PairSums& sums) { return pearson(sums); })},
        {"pcc_utterance",
         [&data](std::span<const double> weights) { return mean_of(data.pearson, weights); }},
        {"ks", distance_of(data)},
    };
    if (!unit) return all;
    const auto rate = [&](const char* metric, std::optional<double> HitRates::*which) {
        all.push_back(
            {metric, pooled(data, [which](const PairSums& sums) { return hit_rates(sums).*which; })});
    };
    rate("ahr", &HitRates::ahr);
    rate("nahr", &HitRates::nahr);
    rate("precision", &HitRates::precision);
    rate("recall", &HitRates::recall);
    return all;
}

// By feature: whether both what people did and what the model predicted vary.
std::vector<bool> correlated_features(const Predictions& predictions) {
    std::vector<bool> correlated;
    const std::size_t width = predictions.features.size();
    for (std::size_t f = 0; f < width; ++f) {
        PairSums all;
        for (const PredictedItem& item : predictions.items) {
            all.add(sums_of(column_of(item, &PredictedItem::truth, f, width),
                            column_of(item, &PredictedItem::prediction, f, width), kActive,
                            predictions.items[0].truth[f]));
        }
        correlated.push_back(pearson(all).has_value());
    }
    return correlated;
}

// The features over which all systems have a PCC, so that its means compare; a system that has none of any feature does
// not count. Says in `notes` which are left out, and why.
std::vector<bool> shared_correlations(const std::vector<Predictions>& models,
                                      std::vector<std::string>& notes) {
    const std::vector<std::string>& features = models.front().features;
    std::vector<bool> shared(features.size(), true);
    std::vector<std::vector<std::string>> without(features.size());
    for (const Predictions& model : models) {
        const std::vector<bool> own = correlated_features(model);
        if (std::ranges::find(own, true) == own.end()) continue;
        for (std::size_t f = 0; f < own.size(); ++f) {
            if (own[f]) continue;
            shared[f] = false;
            without[f].push_back(model.model);
        }
    }
    std::vector<std::string> left_out;
    for (std::size_t f = 0; f < features.size(); ++f)
        if (!shared[f]) left_out.push_back(format("{} (of {})", features[f], join(without[f])));
    if (!left_out.empty()) {
        notes.push_back(
            format("PCC of all features together: over {} of {}; those do not vary, or people's do not: {}",
                   std::ranges::count(shared, true), features.size(), join(left_out)));
    }
    return shared;
}

//   correlated   features whose PCC goes into the mean
void score_features(SystemScores& system, const Predictions& predictions, const std::vector<bool>& correlated,
                    const EvaluationOptions& options) {
    const std::vector<std::string> summed = {"mae", "rmse", "pcc", "ks"};
    const std::vector<std::size_t> records = records_of(predictions);
    std::vector<FeatureData> data;
    for (std::size_t f = 0; f < predictions.features.size(); ++f)
        data.push_back(data_of(predictions, f, options.activation));
    std::vector<std::vector<WeightedStatistic>> by_metric(summed.size());
    for (std::size_t f = 0; f < data.size(); ++f) {
        FeatureScores feature{.feature = predictions.features[f]};
        for (NamedStatistic& statistic : statistics_of(data[f], is_unit(feature.feature))) {
            feature.scores.push_back(
                {statistic.metric, bootstrap_records(records, statistic.of, options.resampling)});
            const auto found = std::find(summed.begin(), summed.end(), statistic.metric);
            const bool counts = correlated[f] || std::string_view(statistic.metric) != "pcc";
            if (found != summed.end() && counts)
                by_metric[static_cast<std::size_t>(found - summed.begin())].push_back(
                    std::move(statistic.of));
        }
        for (const auto& r : data[f].pearson) feature.utterances_without_pcc += r ? 0 : 1;
        feature.ks_p = kolmogorov_smirnov(data[f].truth, data[f].prediction).p;
        system.features.push_back(std::move(feature));
    }
    for (std::size_t m = 0; m < summed.size(); ++m) {
        system.overall.push_back(
            {summed[m], bootstrap_records(records, mean_over(std::move(by_metric[m])), options.resampling)});
    }
}

// A metric of pairs, by item: sums and what they are divided by.
struct PairMetric {
    std::string metric;
    std::vector<ChunkScores> items;

    std::optional<double> at(std::span<const double> weights) const {
        ChunkScores all;
        for (std::size_t i = 0; i < items.size(); ++i) {
            all.sum += weights[i] * items[i].sum;
            all.count += weights[i] * items[i].count;
        }
        return all.mean();
    }
};

// The smile of a person, as it is or as it was predicted, in intensities.
std::vector<float> smile_of(const Predictions& predictions, const PredictedItem& item, Rows rows) {
    const auto found = std::find(predictions.features.begin(), predictions.features.end(), kSmile);
    const auto feature = static_cast<std::size_t>(found - predictions.features.begin());
    const auto [low, high] = predictions.scale[feature];
    std::vector<float> smile = column_of(item, rows, feature, predictions.features.size());
    for (float& value : smile) value = static_cast<float>(low + (high - low) * value);
    return smile;
}

std::vector<PairMetric> pair_metrics(const Predictions& predictions, Rows rows,
                                     const EvaluationOptions& options) {
    std::vector<PairMetric> metrics = {{"tlcc", {}}, {"dtw", {}}};
    for (const AdaptationMeasure& measure : adaptation_measures()) metrics.push_back({measure.key, {}});
    const double fps = predictions.fps;
    for (const PredictedItem& item : predictions.items) {
        const auto a = smile_of(predictions, item, rows);
        const auto u = smile_of(predictions, item, &PredictedItem::partner);
        metrics[0].items.push_back(lagged_correlation(a, u, fps, {.summary = options.lag_summary}).scores);
        metrics[1].items.push_back(warping_costs(a, u, fps));
        const PairedRuns runs{
            .a = active_runs(a, fps), .u = active_runs(u, fps), .frames = a.size(), .fps = fps};
        const double minutes = static_cast<double>(a.size()) / fps / 60;
        for (std::size_t m = 2; m < metrics.size(); ++m)
            metrics[m].items.push_back(
                {.sum = minutes * adaptation_measures()[m - 2].measure(runs), .count = minutes});
    }
    return metrics;
}

//   records   of each item
PairScores score_pairs(const std::vector<PairMetric>& metrics, const std::vector<PairMetric>* people,
                       const std::vector<std::size_t>& records, const Resampling& resampling) {
    PairScores scores;
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        const PairMetric& metric = metrics[m];
        const auto of = [&](std::span<const double> weights) { return metric.at(weights); };
        scores.scores.push_back({metric.metric, bootstrap_records(records, of, resampling)});
        if (!people) continue;
        const PairMetric& theirs = (*people)[m];
        const auto gap = [&](std::span<const double> weights) -> std::optional<double> {
            const auto ours = metric.at(weights), real = theirs.at(weights);
            return ours && real ? std::optional(*ours - *real) : std::nullopt;
        };
        scores.gaps.push_back({metric.metric, bootstrap_records(records, gap, resampling)});
    }
    return scores;
}

bool has_pairs(const Predictions& predictions) {
    return !predictions.items.front().partner.empty() &&
           std::find(predictions.features.begin(), predictions.features.end(), kSmile) !=
               predictions.features.end();
}

// Of normalised numbers, what other programs may round.
constexpr double kRounded = 1e-3;

// The first frame and feature in which two items differ in what the person did; both have equally many.
std::optional<std::size_t> first_difference(const PredictedItem& a, const PredictedItem& b) {
    const auto [at_a, at_b] = std::ranges::mismatch(
        a.truth, b.truth, [](float x, float y) { return std::abs(double(x) - y) <= kRounded; });
    if (at_a == a.truth.end()) return std::nullopt;
    return static_cast<std::size_t>(at_a - a.truth.begin());
}

void check_same_records(const Predictions& first, const Predictions& other) {
    const auto refuse = [&](const std::string& what) {
        throw Error(format("{} and {}: {}; evaluate models together that were asked about the same records",
                           first.model, other.model, what));
    };
    if (first.corpus != other.corpus || first.split != other.split) {
        refuse(format("they predict {}/{} and {}/{}", first.corpus, first.split, other.corpus, other.split));
    }
    if (first.features != other.features)
        refuse(format("they predict {} and {}", join(first.features), join(other.features)));
    if (std::abs(first.fps - other.fps) > kRounded)
        refuse(format("they have {:g} and {:g} frames/s", first.fps, other.fps));
    for (std::size_t f = 0; f < first.features.size(); ++f) {
        const auto [low, high] = first.scale[f];
        const auto [other_low, other_high] = other.scale[f];
        if (std::max(std::abs(low - other_low), std::abs(high - other_high)) > kRounded * (high - low)) {
            refuse(format("0 and 1 of {} are {:g} and {:g}, and {:g} and {:g}", first.features[f], low, high,
                          other_low, other_high));
        }
    }
    if (first.items.size() != other.items.size())
        refuse(format("they predict {} and {} records", first.items.size(), other.items.size()));
    if (has_pairs(first) && other.items.front().partner.empty())
        refuse(format("only {} says what the partner of each person did", first.model));
    for (std::size_t i = 0; i < first.items.size(); ++i) {
        const PredictedItem &a = first.items[i], &b = other.items[i];
        const std::size_t width = first.features.size();
        if (a.id != b.id) refuse(format("they predict {} and {}", a.id, b.id));
        if (a.truth.size() != b.truth.size()) {
            refuse(format("they predict {} and {} frames of {}", a.truth.size() / width,
                          b.truth.size() / width, a.id));
        }
        if (const auto place = first_difference(a, b)) {
            refuse(format("what the person did in frame {} of {} is {} {:.4f} and {:.4f}", *place / width,
                          a.id, first.features[*place % width], a.truth[*place], b.truth[*place]));
        }
    }
}

// What nobody could compute, said once.
std::vector<std::string> notes_on(const Evaluation& evaluation) {
    std::vector<std::string> notes;
    const SystemScores& first = evaluation.systems.front();
    if (first.records < 2) notes.push_back("one record alone: there are no intervals");
    if (first.pair && !first.pair->scores[0].result.value)
        notes.push_back("TLCC: no record has 8 s in which both people's smiles vary");
    if (first.pair && !first.pair->scores[1].result.value) notes.push_back("DTW: no record is 60 s long");
    return notes;
}

}  // namespace

Evaluation evaluate(const std::vector<Predictions>& models, const EvaluationOptions& options) {
    assert(!models.empty());
    for (const Predictions& model : models) check_same_records(models.front(), model);
    const Predictions first = own_styles(models.front());
    if (first.items.empty()) {
        throw Error(format(
            "{}: no clip is in its speaker's own style, by which the others are judged; predict those too",
            first.model));
    }
    Evaluation evaluation{.corpus = first.corpus, .split = first.split, .fps = first.fps, .options = options};
    const std::size_t frames = [&] {
        std::size_t count = 0;
        for (const PredictedItem& item : first.items) count += item.truth.size() / first.features.size();
        return count;
    }();
    std::vector<Predictions> owns;
    for (const Predictions& model : models) owns.push_back(own_styles(model));
    const std::vector<bool> correlated = shared_correlations(owns, evaluation.notes);
    const bool pairs = has_pairs(first);
    std::vector<PairMetric> people;
    if (pairs) {
        people = pair_metrics(first, &PredictedItem::truth, options);
        evaluation.systems.push_back({.model = "people",
                                      .items = first.items.size(),
                                      .records = number_of_records(first),
                                      .frames = frames});
        evaluation.systems.back().pair = score_pairs(people, nullptr, records_of(first), options.resampling);
    }
    for (std::size_t m = 0; m < models.size(); ++m) {
        const Predictions &model = models[m], &own = owns[m];
        SystemScores system{.model = model.model,
                            .items = own.items.size(),
                            .records = number_of_records(own),
                            .frames = frames};
        score_features(system, own, correlated, options);
        if (pairs) {
            system.pair = score_pairs(pair_metrics(own, &PredictedItem::prediction, options), &people,
                                      records_of(own), options.resampling);
        }
        system.poses = score_poses(own, options.resampling);
        if (has_transfers(model))
            system.style = score_styles(model, options.resampling, options.style_points);
        evaluation.systems.push_back(std::move(system));
    }
    for (std::string& note : notes_on(evaluation)) evaluation.notes.push_back(std::move(note));
    return evaluation;
}

}  // namespace chironomia::study
