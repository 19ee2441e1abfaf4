// What can be chosen about AMII: Woo, Fares, Pelachaud, Achard, "AMII: Adaptive Multimodal Inter-personal and
// Intra-personal Model for Adapted Behavior Synthesis", 2023. The names of what the paper leaves open are
// those of docs/learned_dyads.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json_value.h"

namespace chironomia {

// The modules of AMII.
struct AmiiParts {
    static constexpr std::size_t kWindow = 100;  // frames of the past that it sees
    static constexpr std::size_t kWidth = 16;    // c
    static constexpr std::size_t kHeads = 2;     // h

    std::string ablation = "none";  // or "noE_m", "noE_dual", "noE_inter": without that encoder
    bool shared = true;             // A08: one intra-personal encoder for both people
    bool joint = true;              // A25: one dense layer for both faces; or one per person
    bool tanh = true;               // A26: dense layers of encoders have tanh; or are linear
    bool residual = false;          // A26: residual connections about attentions
    bool sequence = true;           // A27: the memory gives all its states; or the last alone

    bool has_memory() const { return ablation != "noE_m"; }
    bool has_dual() const { return ablation != "noE_dual"; }
    bool has_inter() const { return ablation != "noE_inter"; }
};
inline constexpr std::size_t kWindowFrames = AmiiParts::kWindow;

// How a model of dyads is trained.
struct DyadTraining {
    std::size_t stride = 1;  // frames from one window to the next
    std::size_t batch = 32;  // windows, those of both orders counted
    std::size_t epochs = 300;
    double peak = 1e-3;        // of the cyclical learning rate
    double base = 1e-7;        // alike
    std::size_t cycle = 10;    // epochs from base to peak
    std::size_t patience = 0;  // epochs without a better validation loss; 0: no early end
    double clip = 0;           // longest gradient; 0: any
    double own_past = 0;       // share of windows whose A has the face that the model predicted; 0..1
    double own_seconds = 8;    // that the model runs freely for them; > 0
    std::size_t own_from = 0;  // the first epoch, counted from 0, that has such windows
};

// Of "paper" or "small" with what `options` replaces; "small" has residual connections, because without them it
// does not learn in so few steps to keep the last face. Throws Error for a value that is none of the choices.
AmiiParts amii_parts(const std::string& preset, const JsonValue& options);
Json to_json(const AmiiParts& parts);

// Of "paper" or "small", with what `options` replaces. Throws Error for another preset or a wrong value.
DyadTraining dyad_training(const std::string& preset, const JsonValue& options);
Json to_json(const DyadTraining& training);

}  // namespace chironomia
