#include "synth/learned/amii_kernels.h"

#include <algorithm>

#include "synth/learned/fast_math.h"

namespace chironomia {
namespace {

constexpr std::size_t kWidth = kAmiiWidth, kWindow = kAmiiWindow;
constexpr std::size_t kHeads = AmiiParts::kHeads, kDepth = kWidth / kHeads;
constexpr std::size_t kGates = 4 * kWidth;
constexpr std::size_t kLanes = 4;  // sums side by side, which a vector holds

static_assert(kWindow % kLanes == 0);

using Weights = std::array<float, kWindow>;

template <std::size_t Outputs>
void add_products(const float* x, std::size_t inputs, const float* weight, float* y) {
    std::array<float, Outputs> sums;
    std::copy_n(y, Outputs, sums.begin());
    for (std::size_t i = 0; i < inputs; ++i)
        for (std::size_t j = 0; j < Outputs; ++j) sums[j] += x[i] * weight[i * Outputs + j];
    std::copy_n(sums.begin(), Outputs, y);
}

float largest(const Weights& numbers) {
    std::array<float, kLanes> lanes;
    std::copy_n(numbers.begin(), kLanes, lanes.begin());
    for (std::size_t j = kLanes; j < kWindow; j += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            lanes[lane] = lanes[lane] > numbers[j + lane] ? lanes[lane] : numbers[j + lane];
    return *std::max_element(lanes.begin(), lanes.end());
}

float sum_of(const Weights& numbers) {
    std::array<float, kLanes> lanes{};
    for (std::size_t j = 0; j < kWindow; j += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += numbers[j + lane];
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

// Of one head, up to their sum.
Weights weights_of(const float* query, const std::array<float, kWindow>* keys) {
    Weights weights{};
    for (std::size_t d = 0; d < kDepth; ++d)
        for (std::size_t j = 0; j < kWindow; ++j) weights[j] += query[d] * keys[d][j];
    const float most = largest(weights);
    for (float& weight : weights) weight = fast_exp(weight - most);
    return weights;
}

}  // namespace

void DenseLayer::apply(const float* x, float* y) const {
    std::copy(bias.begin(), bias.end(), y);
    if (outputs == kWidth) return add_products<kWidth>(x, inputs, weight.data(), y);
    if (outputs == kGates) return add_products<kGates>(x, inputs, weight.data(), y);
    for (std::size_t i = 0; i < inputs; ++i)
        for (std::size_t j = 0; j < outputs; ++j) y[j] += x[i] * weight[i * outputs + j];
}

void bend(AmiiState& state) {
    for (float& number : state) number = fast_tanh(number);
}

void forget_oldest(AmiiRows& rows, const AmiiState& newest) {
    std::copy(rows.begin() + 1, rows.end(), rows.begin());
    rows.back() = newest;
}

void forget_oldest(AmiiColumns& columns, const AmiiState& newest) {
    for (std::size_t d = 0; d < kWidth; ++d) {
        std::copy(columns[d].begin() + 1, columns[d].end(), columns[d].begin());
        columns[d].back() = newest[d];
    }
}

AmiiColumns turned(const AmiiRows& rows) {
    AmiiColumns columns;
    for (std::size_t d = 0; d < kWidth; ++d)
        for (std::size_t j = 0; j < kWindow; ++j) columns[d][j] = rows[j][d];
    return columns;
}

AmiiState attend(const AmiiState& query, const AmiiKeys& to) {
    AmiiState seen;
    for (std::size_t head = 0; head < kWidth; head += kDepth) {
        const Weights weights = weights_of(query.data() + head, to.keys.data() + head);
        std::array<float, kDepth> sums{};
        for (std::size_t j = 0; j < kWindow; ++j)
            for (std::size_t d = 0; d < kDepth; ++d) sums[d] += weights[j] * to.values[j][head + d];
        const float share = 1 / sum_of(weights);
        for (std::size_t d = 0; d < kDepth; ++d) seen[head + d] = sums[d] * share;
    }
    return seen;
}

void run_lstm(const float* recurrent, const LstmCourse& course) {
    AmiiState state{}, cell{};
    for (std::size_t t = 0; t < course.frames; ++t) {
        float* gates = course.gates + t * kGates;
        add_products<kGates>(state.data(), kWidth, recurrent, gates);
        for (std::size_t j = 0; j < 2 * kWidth; ++j) gates[j] = fast_sigmoid(gates[j]);
        for (std::size_t j = 2 * kWidth; j < 3 * kWidth; ++j) gates[j] = fast_tanh(gates[j]);
        for (std::size_t j = 3 * kWidth; j < kGates; ++j) gates[j] = fast_sigmoid(gates[j]);
        for (std::size_t d = 0; d < kWidth; ++d) {
            cell[d] = gates[kWidth + d] * cell[d] + gates[d] * gates[2 * kWidth + d];
            state[d] = gates[3 * kWidth + d] * fast_tanh(cell[d]);
        }
        std::copy(cell.begin(), cell.end(), course.cells + t * kWidth);
        std::copy(state.begin(), state.end(), course.states + t * kWidth);
    }
}

void slope_of_lstm(const float* recurrent, const LstmCourse& course, const float* from_states,
                   float* slopes) {
    AmiiState of_state{}, of_cell{};
    for (std::size_t t = course.frames; t-- > 0;) {
        const float *gates = course.gates + t * kGates, *cell = course.cells + t * kWidth;
        const AmiiState none{};
        const float* cell_before = t > 0 ? cell - kWidth : none.data();
        float* slope = slopes + t * kGates;
        for (std::size_t d = 0; d < kWidth; ++d) {
            const float in = gates[d], keep = gates[kWidth + d];
            const float candidate = gates[2 * kWidth + d], out = gates[3 * kWidth + d];
            const float bent = fast_tanh(cell[d]);
            const float state = from_states[t * kWidth + d] + of_state[d];
            const float inner = of_cell[d] + state * out * (1 - bent * bent);
            slope[d] = inner * candidate * in * (1 - in);
            slope[kWidth + d] = inner * cell_before[d] * keep * (1 - keep);
            slope[2 * kWidth + d] = inner * in * (1 - candidate * candidate);
            slope[3 * kWidth + d] = state * bent * out * (1 - out);
            of_cell[d] = inner * keep;
        }
        of_state.fill(0);
        add_products<kWidth>(slope, kGates, recurrent, of_state.data());
    }
}

void LstmLayer::apply(AmiiRows& rows) const {
    std::array<std::array<float, kGates>, kWindow> gates;
    AmiiRows cells;
    for (std::size_t t = 0; t < kWindow; ++t) input.apply(rows[t].data(), gates[t].data());
    run_lstm(
        recurrent.data(),
        {.frames = kWindow, .gates = gates[0].data(), .cells = cells[0].data(), .states = rows[0].data()});
}

}  // namespace chironomia
