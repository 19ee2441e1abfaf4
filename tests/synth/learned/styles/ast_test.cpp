#include "synth/learned/styles/ast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/utils.h>

#include "synth/learned/training/optimiser.h"
#include "tests/support/support.h"
#include "tests/synth/learned/parameters.h"

namespace chironomia {
namespace {

using ::testing::HasSubstr;
using testing::parameters_of;
using testing::refusal_of;
using testing::TemporaryFolder;
using torch::Tensor;

constexpr AstSize kTiny{.frames = 64, .width = 8, .heads = 2, .depth = 1, .hidden = 16};

TEST(Ast, HasTheParametersOfTheAuthorsModel) {
    EXPECT_EQ(parameters_of(*Ast(AstSize{.frames = 64})), 85'302'528);
    EXPECT_EQ(parameters_of(*Ast(AstSize{.frames = 1024})), 86'187'264);
}

// The weights of a longer spectrum, in the names of a prefix; the positions become those in its middle.
Tensors weights_for(std::int64_t frames, const std::string& prefix) {
    Tensors weights;
    AstSize size = kTiny;
    size.frames = frames;
    for (const auto& [name, value] : weights_of(*Ast(size))) weights[prefix + name] = value;
    return weights;
}

Tensor loaded(const Tensors& weights, const std::string& name) {
    const TemporaryFolder folder;
    write_safetensors(folder / "model.safetensors", weights);
    Ast ast(kTiny);
    load_ast(ast, kTiny, folder / "model.safetensors");
    return weights_of(*ast).at(name);
}

TEST(LoadAst, TakesTheAuthorsNames) {
    torch::manual_seed(1);
    const Tensors weights = weights_for(64, "module.v.");
    for (const char* name : {"cls_token", "pos_embed", "blocks.0.attn.qkv.weight", "blocks.0.mlp.fc2.bias"})
        EXPECT_TRUE(loaded(weights, name).equal(weights.at(std::string("module.v.") + name))) << name;
}

TEST(LoadAst, CutsThePositionsOfALongerSpectrumToTheMiddle) {
    torch::manual_seed(1);
    const Tensors weights = weights_for(1024, "");  // 12 x 101 patches; of 64 frames 12 x 5
    const Tensor positions = loaded(weights, "pos_embed");
    const Tensor grid = weights.at("pos_embed").slice(1, 2).view({12, 101, 8});
    const Tensor cut = positions.slice(1, 2).view({12, 5, 8});
    EXPECT_TRUE(cut.equal(grid.slice(1, 48, 53)));  // 50 - 5 / 2
    EXPECT_TRUE(positions.slice(1, 0, 2).equal(weights.at("pos_embed").slice(1, 0, 2)));
}

TEST(LoadAst, TakesTheNamesOfHuggingFace) {
    torch::manual_seed(1);
    const std::string prefix = "audio_spectrogram_transformer.";
    Tensors own = weights_for(64, ""), theirs;
    const std::string block = prefix + "encoder.layer.0.";
    const Tensor qkv = own.at("blocks.0.attn.qkv.weight"), bias = own.at("blocks.0.attn.qkv.bias");
    int part = 0;
    for (const char* name : {"query", "key", "value"}) {
        const std::string attention = block + "attention.attention." + name;
        theirs[attention + ".weight"] = qkv.slice(0, 8 * part, 8 * part + 8).contiguous();
        theirs[attention + ".bias"] = bias.slice(0, 8 * part, 8 * part + 8).contiguous();
        ++part;
    }
    const std::pair<const char*, std::string> names[] = {
        {"cls_token", prefix + "embeddings.cls_token"},
        {"dist_token", prefix + "embeddings.distillation_token"},
        {"pos_embed", prefix + "embeddings.position_embeddings"},
        {"patch_embed.proj.weight", prefix + "embeddings.patch_embeddings.projection.weight"},
        {"patch_embed.proj.bias", prefix + "embeddings.patch_embeddings.projection.bias"},
        {"blocks.0.norm1.weight", block + "layernorm_before.weight"},
        {"blocks.0.norm1.bias", block + "layernorm_before.bias"},
        {"blocks.0.attn.proj.weight", block + "attention.output.dense.weight"},
        {"blocks.0.attn.proj.bias", block + "attention.output.dense.bias"},
        {"blocks.0.norm2.weight", block + "layernorm_after.weight"},
        {"blocks.0.norm2.bias", block + "layernorm_after.bias"},
        {"blocks.0.mlp.fc1.weight", block + "intermediate.dense.weight"},
        {"blocks.0.mlp.fc1.bias", block + "intermediate.dense.bias"},
        {"blocks.0.mlp.fc2.weight", block + "output.dense.weight"},
        {"blocks.0.mlp.fc2.bias", block + "output.dense.bias"},
        {"norm.weight", prefix + "layernorm.weight"},
        {"norm.bias", prefix + "layernorm.bias"}};
    for (const auto& [ours, name] : names) theirs[name] = own.at(ours);
    for (const auto& [name, value] : own) EXPECT_TRUE(loaded(theirs, name).equal(value)) << name;
}

TEST(LoadAst, RefusesWeightsThatLackATensor) {
    Tensors weights = weights_for(64, "");
    weights.erase("blocks.0.mlp.fc1.bias");
    EXPECT_THAT(refusal_of([&] { loaded(weights, "norm.bias"); }), HasSubstr("blocks.0.mlp.fc1.bias"));
}

}  // namespace
}  // namespace chironomia
