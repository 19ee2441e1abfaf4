#include "synth/learned/bert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "synth/learned/models.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using torch::Tensor;

// The size of tests/fixtures/learned/make_parity.py.
constexpr BertSize kTiny{.layers = 2, .width = 12, .heads = 3, .hidden = 20, .pieces = 11, .positions = 8};

Tensors tiny_weights() {
    Tensors weights;
    const auto file = testing::source_dir() / "tests/fixtures/learned/parity.safetensors";
    for (const auto& [name, tensor] : read_safetensors(file))
        if (name.starts_with("bert/")) weights[name.substr(5)] = tensor;
    return weights;
}

const std::vector<int> kIds{2, 7, 1, 9, 10, 4, 3};

TEST(Bert, HasTheParametersOfBertBase) {
    std::int64_t count = 0;
    for (const auto& [name, shape] : bert_shapes({})) {
        std::int64_t numbers = 1;
        for (const std::int64_t extent : shape) numbers *= extent;
        count += numbers;
    }
    EXPECT_EQ(count, 109'482'240);
}

TEST(Bert, SaysWhatAnIndependentImplementationSays) {
    const Tensors weights = tiny_weights();
    const Tensor states = bert_of(weights, kTiny, "tiny")(kIds);
    EXPECT_EQ(states.sizes(), torch::IntArrayRef({7, 12}));
    EXPECT_TRUE(torch::allclose(states, weights.at("states"), 1e-5, 1e-5));
}

TEST(Bert, ReadsTheNamesOfOldFiles) {
    const Tensors weights = tiny_weights();
    Tensors old_names;
    for (const auto& [name, tensor] : weights) {
        std::string old_name = "bert." + name;
        if (const auto place = old_name.find("LayerNorm.weight"); place != std::string::npos)
            old_name.replace(place, std::string::npos, "LayerNorm.gamma");
        if (const auto place = old_name.find("LayerNorm.bias"); place != std::string::npos)
            old_name.replace(place, std::string::npos, "LayerNorm.beta");
        old_names[old_name] = tensor;
    }
    EXPECT_TRUE(torch::equal(bert_of(old_names, kTiny, "old")(kIds), bert_of(weights, kTiny, "new")(kIds)));
}

TEST(Bert, RefusesWeightsThatAreNotItsOwn) {
    Tensors weights = tiny_weights();
    weights.erase("pooler.dense.weight");
    bert_of(weights, kTiny, "no pooler");
    weights.erase("encoder.layer.1.output.dense.bias");
    EXPECT_THAT(testing::refusal_of([&] { bert_of(weights, kTiny, "w"); }),
                HasSubstr("w: tensor \"encoder.layer.1.output.dense.bias\" is missing"));
    EXPECT_THAT(testing::refusal_of([&] { bert_of(tiny_weights(), {}, "w"); }),
                HasSubstr("has the shape [12], the model needs [768]"));
    const testing::TemporaryFolder folder;
    write_text(folder / "bert.pt", "no archive");
    EXPECT_THAT(testing::refusal_of([&] { read_bert(folder / "bert.pt"); }),
                HasSubstr("bert.pt: is neither a safetensors nor a TorchScript file"));
}

constexpr const char* kVocabulary = "[PAD]\n[UNK]\n[CLS]\n[SEP]\nab\n##c\n##d\nx\n";

TEST(Bert, EncodesTheWordsOfAJobWithTorchScript) {
    const testing::TemporaryFolder folder;
    write_text(folder / "vocab.txt", kVocabulary);
    const auto fixture = testing::source_dir() / "tests/fixtures/learned/script.pt";
    Json job{{"verb", "encode"},
             {"weights", fixture.string()},
             {"vocabulary", (folder / "vocab.txt").string()},
             {"utterances", {{"abcd", "x"}, {"ab"}}},
             {"out", (folder / "vectors.h5").string()}};
    EXPECT_EQ(answer(job)["words"], 3);
    const std::vector<std::byte> bytes = read_bytes(folder / "vectors.h5");
    const std::vector<double> vectors = Hdf5File(bytes, "vectors.h5").read_numbers("vectors", {3, 768});
    EXPECT_EQ(vectors[0], 5);
    EXPECT_EQ(vectors[768], 7);
    EXPECT_EQ(vectors[2 * 768 + 767], 4);
    job["utterances"] = {{""}};
    EXPECT_THAT(testing::refusal_of([&] { answer(job); }), HasSubstr("utterances[0][0]"));
}

// The vocabulary is one of letters. Each state is the number of its piece, so that the means are known.
TEST(Bert, GivesAWordTheMeanOfItsPieces) {
    const WordPieces pieces(kVocabulary, "vocab.txt");
    std::vector<std::size_t> lengths;
    const BertStates numbers = [&](const std::vector<int>& ids) {
        lengths.push_back(ids.size());
        const std::vector<float> values(ids.begin(), ids.end());
        return torch::tensor(values).unsqueeze(1).repeat({1, 768});
    };
    const std::vector<float> vectors = word_vectors(numbers, pieces, {"abcd", "x", "?"});
    ASSERT_EQ(vectors.size(), 3u * 768);
    EXPECT_FLOAT_EQ(vectors[0], 5);        // ab ##c ##d are 4, 5 and 6
    EXPECT_FLOAT_EQ(vectors[768 + 3], 7);  // x
    EXPECT_FLOAT_EQ(vectors[2 * 768], 1);  // [UNK]
    EXPECT_EQ(lengths, (std::vector<std::size_t>{7}));
    // 510 pieces and the two at the ends fit; words are not cut.
    lengths.clear();
    EXPECT_EQ(word_vectors(numbers, pieces, std::vector<std::string>(400, "abcd")).size(), 400u * 768);
    EXPECT_EQ(lengths, (std::vector<std::size_t>{512, 512, 182}));
}

}  // namespace
}  // namespace chironomia
