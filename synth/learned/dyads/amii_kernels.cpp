#include "synth/learned/dyads/amii_kernels.h"

#include <algorithm>

#include "synth/learned/dyads/fast_math.h"

namespace chironomia {
namespace {

// Several versions in one binary, as wide as the machine can; all add up in the same order. Sanitizers cannot
// instrument the pick, and need no speed.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define CHIRONOMIA_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define CHIRONOMIA_VECTORISED
#endif

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

// One head of an attention over transposed keys, (8, width), where `width` is their count, filled up to
// whole vectors.
constexpr std::size_t kVector = 8;

struct HeadColumns {
    HeadColumns(const float* rows, std::size_t rows_count, std::size_t head)
        : count(rows_count), width((count + kVector - 1) / kVector * kVector), numbers(kDepth * width) {
        for (std::size_t d = 0; d < kDepth; ++d)
            for (std::size_t j = 0; j < count; ++j) numbers[d * width + j] = rows[j * kWidth + head + d];
    }
    explicit HeadColumns(const HeadColumns& like, float number)
        : count(like.count), width(like.width), numbers(like.numbers.size(), number) {}

    float* operator[](std::size_t d) { return numbers.data() + d * width; }
    const float* operator[](std::size_t d) const { return numbers.data() + d * width; }
    void add_to(float* rows, std::size_t head) const {
        for (std::size_t d = 0; d < kDepth; ++d)
            for (std::size_t j = 0; j < count; ++j) rows[j * kWidth + head + d] += numbers[d * width + j];
    }

    std::size_t count, width;
    std::vector<float> numbers;
};

// Eight numbers side by side, wherever they lie.
using Lanes [[gnu::vector_size(kVector * sizeof(float)), gnu::aligned(alignof(float)), gnu::may_alias]] =
    float;

inline Lanes& lanes_at(float* numbers) {
    return *reinterpret_cast<Lanes*>(numbers);
}

inline const Lanes& lanes_at(const float* numbers) {
    return *reinterpret_cast<const Lanes*>(numbers);
}

inline float total(const Lanes& lanes) {
    return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

inline float product(const float* a, const float* b, std::size_t width) {
    Lanes sums{};
    for (std::size_t j = 0; j < width; j += kVector) sums += lanes_at(a + j) * lanes_at(b + j);
    return total(sums);
}

// sums[j] = query . column j
inline void multiply(const float* query, const HeadColumns& columns, float* sums) {
    const float* first = columns[0];
    for (std::size_t j = 0; j < columns.width; j += kVector) {
        Lanes sum = query[0] * lanes_at(first + j);
        for (std::size_t d = 1; d < kDepth; ++d) sum += query[d] * lanes_at(first + d * columns.width + j);
        lanes_at(sums + j) = sum;
    }
}

// rows[d][j] += x[d] * weights[j]
inline void add_outer(const float* x, const float* weights, HeadColumns& rows) {
    float* first = rows[0];
    for (std::size_t j = 0; j < rows.width; j += kVector) {
        const Lanes weight = lanes_at(weights + j);
        for (std::size_t d = 0; d < kDepth; ++d) lanes_at(first + d * rows.width + j) += x[d] * weight;
    }
}

// The shares of all keys in what a query sees; those that only fill up have none.
inline void soften(const HeadColumns& keys, float* scores) {
    std::fill(scores + keys.count, scores + keys.width, scores[0]);
    Lanes most = lanes_at(scores);
    for (std::size_t j = kVector; j < keys.width; j += kVector)
        most = most > lanes_at(scores + j) ? most : lanes_at(scores + j);
    float highest = most[0];
    for (std::size_t lane = 1; lane < kVector; ++lane) highest = std::max(highest, most[lane]);
    for (std::size_t j = 0; j < keys.width; j += kVector)
        for (std::size_t lane = j; lane < j + kVector; ++lane)
            scores[lane] = fast_exp(scores[lane] - highest);
    std::fill(scores + keys.count, scores + keys.width, 0.0f);
    Lanes sums{};
    for (std::size_t j = 0; j < keys.width; j += kVector) sums += lanes_at(scores + j);
    const float share = 1 / total(sums);
    for (std::size_t j = 0; j < keys.width; j += kVector) lanes_at(scores + j) *= share;
}

}  // namespace

CHIRONOMIA_VECTORISED
void run_attention(const AttentionCourse& course, float* seen) {
    for (std::size_t head = 0; head < kWidth; head += kDepth) {
        const HeadColumns keys(course.key, course.keys, head), values(course.value, course.keys, head);
        std::vector<float> weights(keys.width);
        for (std::size_t t = 0; t < course.queries; ++t) {
            multiply(course.query + t * kWidth + head, keys, weights.data());
            soften(keys, weights.data());
            for (std::size_t d = 0; d < kDepth; ++d)
                seen[t * kWidth + head + d] = product(weights.data(), values[d], values.width);
        }
    }
}

CHIRONOMIA_VECTORISED
void slopes_of_attention(const AttentionCourse& course, const float* from_seen,
                         const AttentionSlopes& slopes) {
    for (std::size_t head = 0; head < kWidth; head += kDepth) {
        const HeadColumns keys(course.key, course.keys, head), values(course.value, course.keys, head);
        HeadColumns of_keys(keys, 0), of_values(values, 0);
        std::vector<float> weights(keys.width), scores(keys.width);
        for (std::size_t t = 0; t < course.queries; ++t) {
            const float *query = course.query + t * kWidth + head, *from = from_seen + t * kWidth + head;
            multiply(query, keys, weights.data());
            soften(keys, weights.data());
            add_outer(from, weights.data(), of_values);
            multiply(from, values, scores.data());
            const float mean = product(weights.data(), scores.data(), keys.width);
            for (std::size_t j = 0; j < keys.width; ++j) scores[j] = weights[j] * (scores[j] - mean);
            add_outer(query, scores.data(), of_keys);
            for (std::size_t d = 0; d < kDepth; ++d)
                slopes.query[t * kWidth + head + d] = product(scores.data(), keys[d], keys.width);
        }
        of_keys.add_to(slopes.key, head);
        of_values.add_to(slopes.value, head);
    }
}

void DenseLayer::apply(const float* x, float* y) const {
    std::copy(bias.begin(), bias.end(), y);
    if (outputs == kWidth) return add_products<kWidth>(x, inputs, weight.data(), y);
    if (outputs == kGates) return add_products<kGates>(x, inputs, weight.data(), y);
    for (std::size_t i = 0; i < inputs; ++i)
        for (std::size_t j = 0; j < outputs; ++j) y[j] += x[i] * weight[i * outputs + j];
}

void apply_tanh(AmiiState& state) {
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

AmiiColumns transposed(const AmiiRows& rows) {
    AmiiColumns columns;
    for (std::size_t d = 0; d < kWidth; ++d)
        for (std::size_t j = 0; j < kWindow; ++j) columns[d][j] = rows[j][d];
    return columns;
}

CHIRONOMIA_VECTORISED
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

CHIRONOMIA_VECTORISED
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

CHIRONOMIA_VECTORISED
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
