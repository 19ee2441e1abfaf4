// The loss of AMII and of its baselines: the mean squared error of faces, normalised to [0, 1]. Woo, Fares,
// Pelachaud, Achard, "AMII: Adaptive Multimodal Inter-personal and Intra-personal Model for Adapted Behavior
// Synthesis", 2023, section 4, which names it without an equation. We differ: some windows may have a past
// that the model predicted itself (dyad_pasts.h).
#pragma once

#include <span>
#include <vector>

#include "synth/learned/dyads/dyad_pasts.h"

namespace chironomia {

// The mean squared error over `windows` (B > 0) in both orders: a scalar with gradients. What `model`
// predicts, (2 B, 10 or 20), is compared with as many columns of the recorded faces a frame later, (2 B, 20).
torch::Tensor loss_of(const DyadModel& model, const std::vector<DyadFrames>& dyads,
                      const DyadExamples& examples, std::span<const PastWindow> windows);

// The mean over all windows of `examples`; without gradients.
double mean_loss(const DyadModel& model, const std::vector<DyadFrames>& dyads, const DyadExamples& examples);

}  // namespace chironomia
