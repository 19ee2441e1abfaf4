#include "synth/learned/dyads/lstm_states.h"

#include <torch/csrc/autograd/custom_function.h>

#include "synth/learned/dyads/amii_kernels.h"
#include "synth/learned/dyads/sequences.h"

namespace chironomia {
namespace {

using torch::Tensor;
using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

constexpr int64_t kStateWidth = AmiiParts::kWidth, kGates = 4 * kStateWidth;

// From what the gates get of the input, (B, T, 64), to the states.
class Recurrence : public torch::autograd::Function<Recurrence> {
  public:
    static Tensor forward(AutogradContext* context, const Tensor& inputs, const Tensor& recurrent) {
        const Tensor gates = inputs.contiguous().clone(), transposed = recurrent.t().contiguous();
        const int64_t sequences = gates.size(0), frames = gates.size(1);
        const Tensor cells = torch::empty({sequences, frames, kStateWidth}),
                     states = torch::empty_like(cells);
        over_sequences(sequences, [&](int64_t i) {
            run_lstm(transposed.data_ptr<float>(),
                     {.frames = static_cast<std::size_t>(frames),
                      .gates = gates.data_ptr<float>() + i * frames * kGates,
                      .cells = cells.data_ptr<float>() + i * frames * kStateWidth,
                      .states = states.data_ptr<float>() + i * frames * kStateWidth});
        });
        context->save_for_backward({gates, cells, states, recurrent});
        return states;
    }

    static variable_list backward(AutogradContext* context, const variable_list& upstream) {
        const variable_list saved = context->get_saved_variables();
        const Tensor &gates = saved[0], &cells = saved[1], &states = saved[2];
        const Tensor recurrent = saved[3].contiguous(), from_states = upstream[0].contiguous();
        const int64_t sequences = gates.size(0), frames = gates.size(1);
        const Tensor slopes = torch::empty_like(gates);
        over_sequences(sequences, [&](int64_t i) {
            slope_of_lstm(recurrent.data_ptr<float>(),
                          {.frames = static_cast<std::size_t>(frames),
                           .gates = gates.data_ptr<float>() + i * frames * kGates,
                           .cells = cells.data_ptr<float>() + i * frames * kStateWidth,
                           .states = states.data_ptr<float>() + i * frames * kStateWidth},
                          from_states.data_ptr<float>() + i * frames * kStateWidth,
                          slopes.data_ptr<float>() + i * frames * kGates);
        });
        const Tensor later = slopes.narrow(1, 1, frames - 1).reshape({-1, kGates});
        const Tensor before = states.narrow(1, 0, frames - 1).reshape({-1, kStateWidth});
        return {slopes, torch::matmul(later.t(), before)};
    }
};

}  // namespace

Tensor lstm_states(const Tensor& x, const LstmWeights& weights) {
    const Tensor inputs = torch::linear(x, weights.input, weights.input_bias + weights.recurrent_bias);
    return Recurrence::apply(inputs, weights.recurrent);
}

}  // namespace chironomia
