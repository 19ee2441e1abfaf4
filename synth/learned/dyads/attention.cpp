#include "synth/learned/dyads/attention.h"

#include <torch/csrc/autograd/custom_function.h>

#include "synth/learned/dyads/amii_kernels.h"
#include "synth/learned/dyads/sequences.h"

namespace chironomia {
namespace {

using torch::Tensor;
using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

float* numbers_of(const Tensor& rows, int64_t sequence) {
    return rows.data_ptr<float>() + sequence * rows.size(1) * rows.size(2);
}

AttentionCourse course_of(const Tensor& query, const Tensor& key, const Tensor& value, int64_t sequence) {
    return {.queries = static_cast<std::size_t>(query.size(1)),
            .keys = static_cast<std::size_t>(key.size(1)),
            .query = numbers_of(query, sequence),
            .key = numbers_of(key, sequence),
            .value = numbers_of(value, sequence)};
}

class Attended : public torch::autograd::Function<Attended> {
  public:
    static Tensor forward(AutogradContext* context, const Tensor& queries, const Tensor& keys,
                          const Tensor& values) {
        const Tensor query = queries.contiguous(), key = keys.contiguous(), value = values.contiguous();
        const Tensor seen = torch::empty_like(query);
        over_sequences(query.size(0), [&](int64_t i) {
            run_attention(course_of(query, key, value, i), numbers_of(seen, i));
        });
        context->save_for_backward({query, key, value});
        return seen;
    }

    static variable_list backward(AutogradContext* context, const variable_list& upstream) {
        const variable_list saved = context->get_saved_variables();
        const Tensor &query = saved[0], &key = saved[1], &value = saved[2];
        const Tensor from_seen = upstream[0].contiguous();
        variable_list slopes;
        for (const Tensor& input : saved) slopes.push_back(torch::zeros_like(input));
        over_sequences(query.size(0), [&](int64_t i) {
            slopes_of_attention(course_of(query, key, value, i), numbers_of(from_seen, i),
                                {.query = numbers_of(slopes[0], i),
                                 .key = numbers_of(slopes[1], i),
                                 .value = numbers_of(slopes[2], i)});
        });
        return slopes;
    }
};

}  // namespace

Tensor attended(const Tensor& query, const Tensor& key, const Tensor& value) {
    return Attended::apply(query, key, value);
}

}  // namespace chironomia
