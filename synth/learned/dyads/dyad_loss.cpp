#include "synth/learned/dyads/dyad_loss.h"

#include <torch/utils.h>

#include <algorithm>

namespace chironomia {

torch::Tensor loss_of(const DyadModel& model, const std::vector<DyadFrames>& dyads,
                      const DyadExamples& examples, std::span<const PastWindow> windows) {
    std::vector<DyadWindow> recorded;
    std::vector<PastWindow> own;
    for (const PastWindow& past : windows) {
        if (past.run) {
            own.push_back(past);
        } else {
            recorded.push_back(past.window);
        }
    }
    const auto error = [](const torch::Tensor& predicted, const torch::Tensor& next) {
        return torch::mse_loss(predicted, next.narrow(1, 0, predicted.size(1)));
    };
    const auto of_recorded = [&] {
        const WindowBatch batch = batch_of(dyads, recorded);
        return error(model.predict(batch.people), batch.next);
    };
    const auto of_own = [&] {
        const PastBatch batch = past_batch_of(dyads, examples, own);
        return error(model.predict_beside(batch.a, batch.u), batch.next);
    };
    if (own.empty()) return of_recorded();
    if (recorded.empty()) return of_own();
    const double share = static_cast<double>(own.size()) / static_cast<double>(windows.size());
    return (1 - share) * of_recorded() + share * of_own();
}

double mean_loss(const DyadModel& model, const std::vector<DyadFrames>& dyads, const DyadExamples& examples) {
    constexpr std::size_t kBatch = 128;
    const torch::NoGradGuard no_gradients;
    const std::span windows(examples.windows);
    double sum = 0;
    for (std::size_t begin = 0; begin < windows.size(); begin += kBatch) {
        const auto part = windows.subspan(begin, std::min(kBatch, windows.size() - begin));
        sum += loss_of(model, dyads, examples, part).item<double>() * static_cast<double>(part.size());
    }
    return sum / static_cast<double>(windows.size());
}

}  // namespace chironomia
