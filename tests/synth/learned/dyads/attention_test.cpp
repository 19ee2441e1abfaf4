#include "synth/learned/dyads/attention.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using torch::Tensor;

struct Seen {
    Tensor seen, of_query, of_key, of_value;
};

Seen with_gradients(const std::function<Tensor(const Tensor&, const Tensor&, const Tensor&)>& attend,
                    const Tensor& query, const Tensor& key, const Tensor& value, const Tensor& upstream) {
    const auto leaf = [](const Tensor& x) { return x.detach().clone().set_requires_grad(true); };
    const Tensor q = leaf(query), k = leaf(key), v = leaf(value);
    const Tensor seen = attend(q, k, v);
    (seen * upstream).sum().backward();
    return {.seen = seen.detach(), .of_query = q.grad(), .of_key = k.grad(), .of_value = v.grad()};
}

// The same, as torch computes it from the formula, head by head.
Tensor attended_by_torch(const Tensor& query, const Tensor& key, const Tensor& value) {
    std::vector<Tensor> heads;
    for (const std::int64_t first : {0, 8}) {
        const Tensor scores =
            torch::matmul(query.narrow(2, first, 8), key.narrow(2, first, 8).transpose(1, 2));
        heads.push_back(torch::matmul(torch::softmax(scores, -1), value.narrow(2, first, 8)));
    }
    return torch::cat(heads, -1);
}

TEST(Attention, SeesAndLearnsAsTorchDoesForAnyNumberOfKeys) {
    torch::manual_seed(5);
    for (const std::int64_t keys : {1, 7, 8, 100}) {
        const Tensor query = 2 * torch::randn({3, 5, 16}), upstream = torch::randn({3, 5, 16});
        const Tensor key = 2 * torch::randn({3, keys, 16}), value = torch::randn({3, keys, 16});
        const Seen ours = with_gradients(attended, query, key, value, upstream);
        const Seen theirs = with_gradients(attended_by_torch, query, key, value, upstream);
        EXPECT_TRUE(torch::allclose(ours.seen, theirs.seen, 1e-5, 1e-5)) << keys;
        EXPECT_TRUE(torch::allclose(ours.of_query, theirs.of_query, 1e-4, 1e-5)) << keys;
        EXPECT_TRUE(torch::allclose(ours.of_key, theirs.of_key, 1e-4, 1e-5)) << keys;
        EXPECT_TRUE(torch::allclose(ours.of_value, theirs.of_value, 1e-4, 1e-5)) << keys;
    }
}

// All keys alike: every value has the same share, and no query or key changes that.
TEST(Attention, GivesTheMeanOfValuesWithEqualKeys) {
    const Tensor value = torch::arange(2 * 6 * 16, torch::kFloat).view({2, 6, 16});
    const Seen found = with_gradients(attended, torch::ones({2, 3, 16}), torch::ones({2, 6, 16}), value,
                                      torch::ones({2, 3, 16}));
    EXPECT_TRUE(torch::allclose(found.seen, value.mean(1, true).expand({2, 3, 16})));
    EXPECT_TRUE(torch::allclose(found.of_value, torch::full({2, 6, 16}, 0.5f)));
    EXPECT_LT(found.of_query.abs().max().item<float>(), 1e-3);
}

}  // namespace
}  // namespace chironomia
