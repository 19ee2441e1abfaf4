// How well learned models predict what people did: every metric of their papers, with intervals.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/analysis/table.h"
#include "study/measure/bootstrap.h"
#include "study/measure/lagged_correlation.h"
#include "study/models/evaluation_style.h"
#include "synth/predictions.h"

namespace chironomia::study {

// On which scale an action unit must be above 0.5 to be active; the papers leave it open.
enum class ActivationScale { raw, normalised };

struct EvaluationOptions {
    ActivationScale activation = ActivationScale::raw;
    LagSummary lag_summary = LagSummary::signed_most;
    StylePoints style_points = StylePoints::raw;
    Resampling resampling = kUtterances;
};

struct MetricScore {
    std::string metric;  // "rmse"
    Bootstrapped result;
};

struct FeatureScores {
    std::string feature;  // "AU1"
    // On the normalised scale: rmse, mae, pcc over all frames, pcc_utterance (the mean of those of each
    // utterance), ks; in the feature's own unit: rmse_raw; of action units: ahr, nahr, precision, recall.
    std::vector<MetricScore> scores;
    std::size_t utterances_without_pcc = 0;  // nothing varies there
    double ks_p = 1;
};

// Of two people: tlcc, dtw, and those of adaptation_measures(), of the smiles of a person and the partner.
struct PairScores {
    std::vector<MetricScore> scores;
    std::vector<MetricScore> gaps;  // of a model: how far from what people did, signed
};

struct SystemScores {
    std::string model;  // "amii"; "people" for what was recorded, which has a pair alone
    std::size_t items = 0;
    std::size_t records = 0;  // that the items are of; a dyad is one of two items
    std::size_t frames = 0;
    // Means over features of mae, rmse and ks, and of pcc over those of which all systems have one.
    std::vector<MetricScore> overall;
    std::vector<FeatureScores> features;
    std::optional<PairScores> pair;    // of dyads with AU12
    std::optional<PoseScores> poses;   // of models of a body
    std::optional<StyleScores> style;  // of models of style: of clips in the style of other speakers
};

struct Evaluation {
    std::string corpus;
    std::string split;
    double fps = 25;
    EvaluationOptions options;
    std::vector<SystemScores> systems;  // people first, where there is something to say of them
    std::vector<analysis::Table> more;  // what else was found, behind the tables of the systems
    std::vector<std::string> notes;     // what could not be computed, and why
};

// Of at least one model. Features are scored on what is in the speakers' own styles. Throws Error if the models were
// not asked about the same records.
Evaluation evaluate(const std::vector<Predictions>& models, const EvaluationOptions& options = {});

}  // namespace chironomia::study
