// Predictions whose scores are known by thought.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/text.h"
#include "synth/predictions.h"

namespace chironomia::testing {

// Utterances of AU1 and Rx. AU1 is 1 in every other frame and 0 between; AU1 is predicted too high by 0.1 and
// Rx, a wave, too low by 0.2 throughout.
inline Predictions sample_faces(const std::string& model = "model2", std::size_t items = 3) {
    Predictions predictions{.model = model,
                            .corpus = "talks",
                            .split = "test",
                            .fps = 24,
                            .features = {"AU1", "Rx"},
                            .scale = {{0, 5}, {-0.5, 1.5}}};
    for (std::size_t i = 0; i < items; ++i) {
        PredictedItem item{.id = format("s{}", i), .speaker = "s"};
        for (int t = 0; t < 48; ++t) {
            const auto turn = static_cast<float>(0.5 + 0.2 * std::sin(t));
            const auto raised = static_cast<float>(t % 2);
            item.truth.insert(item.truth.end(), {raised, turn});
            item.prediction.insert(item.prediction.end(), {raised + 0.1f, turn - 0.2f});
        }
        predictions.items.push_back(std::move(item));
    }
    return predictions;
}

// Two minutes of smiles, [0, 1] for [0, 5]; the partner's come 20 frames after the person's, and the model's
// `late` frames after the person's.
inline Predictions sample_dyad(const std::string& model, int late) {
    Predictions predictions{.model = model,
                            .corpus = "dyads",
                            .split = "test",
                            .fps = 25,
                            .features = {"AU12"},
                            .scale = {{0, 5}}};
    const auto smile = [](int t) {
        return static_cast<float>(std::max(0.0, 0.4 * std::sin(2 * std::numbers::pi * t / 60)));
    };
    for (const char* id : {"d0:0", "d0:1"}) {
        PredictedItem item{.id = id, .speaker = id};
        for (int t = 0; t < 3000; ++t) {
            item.truth.push_back(smile(t));
            item.prediction.push_back(smile(t - late));
            item.partner.push_back(smile(t - 20));
        }
        predictions.items.push_back(std::move(item));
    }
    return predictions;
}

}  // namespace chironomia::testing
