#include "synth/learned/styles/ast.h"

#include <torch/nn/init.h>
#include <torch/utils.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "synth/learned/training/optimiser.h"
#include "synth/learned/training/safetensors.h"

namespace chironomia {

namespace fs = std::filesystem;
using torch::Tensor;

namespace {

constexpr double kTokenDeviation = 0.02;  // of new tokens and positions, as the authors' library draws them
constexpr double kNormEpsilon = 1e-6;     // of the authors' library

torch::nn::LayerNorm ast_norm(std::int64_t width) {
    return torch::nn::LayerNorm(torch::nn::LayerNormOptions({width}).eps(kNormEpsilon));
}

// Modules below a name that is no module of its own: "attn.qkv".
std::shared_ptr<torch::nn::Module> folder_of_modules() {
    return std::make_shared<torch::nn::Module>();
}

}  // namespace

AstBlockImpl::AstBlockImpl(const AstSize& size) : heads_(size.heads) {
    const auto attention = register_module("attn", folder_of_modules());
    const auto network = register_module("mlp", folder_of_modules());
    norm1_ = register_module("norm1", ast_norm(size.width));
    norm2_ = register_module("norm2", ast_norm(size.width));
    qkv_ = attention->register_module("qkv", torch::nn::Linear(size.width, 3 * size.width));
    proj_ = attention->register_module("proj", torch::nn::Linear(size.width, size.width));
    fc1_ = network->register_module("fc1", torch::nn::Linear(size.width, size.hidden));
    fc2_ = network->register_module("fc2", torch::nn::Linear(size.hidden, size.width));
}

Tensor AstBlockImpl::attend(const Tensor& x) {
    const std::int64_t width = x.size(2);
    // (3, B, heads, N, width / heads)
    const Tensor split =
        qkv_->forward(x).view({x.size(0), x.size(1), 3, heads_, width / heads_}).permute({2, 0, 3, 1, 4});
    const double scale = 1 / std::sqrt(static_cast<double>(width / heads_));
    const Tensor weights = torch::softmax(split[0].matmul(split[1].transpose(-2, -1)) * scale, -1);
    return proj_->forward(weights.matmul(split[2]).transpose(1, 2).reshape(x.sizes()));
}

Tensor AstBlockImpl::forward(const Tensor& x) {
    const Tensor attended = x + attend(norm1_->forward(x));
    return attended + fc2_->forward(torch::gelu(fc1_->forward(norm2_->forward(attended))));
}

AstImpl::AstImpl(const AstSize& size) {
    const std::int64_t tokens = 2 + size.patches_up() * size.patches_along();
    class_token_ = register_parameter("cls_token", torch::empty({1, 1, size.width}));
    distillation_token_ = register_parameter("dist_token", torch::empty({1, 1, size.width}));
    positions_ = register_parameter("pos_embed", torch::empty({1, tokens, size.width}));
    for (Tensor* drawn : {&class_token_, &distillation_token_, &positions_})
        torch::nn::init::normal_(*drawn, 0, kTokenDeviation);
    const auto embedding = register_module("patch_embed", folder_of_modules());
    patches_ = embedding->register_module(
        "proj", torch::nn::Conv2d(torch::nn::Conv2dOptions(1, size.width, 16).stride(10)));
    blocks_ = register_module("blocks", torch::nn::ModuleList());
    for (std::int64_t i = 0; i < size.depth; ++i) blocks_->push_back(AstBlock(size));
    norm_ = register_module("norm", ast_norm(size.width));
}

Tensor AstImpl::forward(const Tensor& mel, bool average_tokens) {
    const std::int64_t batch = mel.size(0);
    // Bands go down, frames to the right; patches are listed row by row.
    const Tensor patches = patches_->forward(mel.transpose(1, 2).unsqueeze(1)).flatten(2).transpose(1, 2);
    Tensor x = torch::cat(
        {class_token_.expand({batch, 1, -1}), distillation_token_.expand({batch, 1, -1}), patches}, 1);
    x = x + positions_;
    for (std::size_t i = 0; i < blocks_->size(); ++i) x = blocks_->at<AstBlockImpl>(i).forward(x);
    const Tensor tokens = norm_->forward(x.narrow(1, 0, 2));
    return average_tokens ? tokens.mean(1) : tokens.select(1, 0);
}

namespace {

// The authors' name of a tensor, from a part of Hugging Face's.
constexpr std::array<std::pair<const char*, const char*>, 12> kHuggingFaceNames{
    {{"embeddings.cls_token", "cls_token"},
     {"embeddings.distillation_token", "dist_token"},
     {"embeddings.position_embeddings", "pos_embed"},
     {"embeddings.patch_embeddings.projection", "patch_embed.proj"},
     {"encoder.layer.", "blocks."},
     {"attention.output.dense", "attn.proj"},
     {"intermediate.dense", "mlp.fc1"},
     {"output.dense", "mlp.fc2"},
     {"layernorm_before", "norm1"},
     {"layernorm_after", "norm2"},
     {"layernorm", "norm"},
     {"attention.attention.", "attn."}}};

std::string authors_name(std::string name) {
    for (const std::string_view prefix : {"module.", "v.", "audio_spectrogram_transformer."})
        if (name.starts_with(prefix)) name.erase(0, prefix.size());
    for (const auto& [theirs, authors] : kHuggingFaceNames) {
        const std::size_t at = name.find(theirs);
        if (at != std::string::npos) name.replace(at, std::string_view(theirs).size(), authors);
    }
    return name;
}

// Query, key and value apart, as Hugging Face has them, become one.
void join_attention(Tensors& weights, const AstSize& size) {
    for (std::int64_t i = 0; i < size.depth; ++i) {
        for (const char* kind : {"weight", "bias"}) {
            const auto name = [&](const char* part) { return format("blocks.{}.attn.{}.{}", i, part, kind); };
            std::vector<Tensor> parts;
            for (const char* part : {"query", "key", "value"}) {
                const auto found = weights.find(name(part));
                if (found != weights.end()) parts.push_back(found->second);
            }
            if (parts.size() == 3) weights[name("qkv")] = torch::cat(parts);
        }
    }
}

// (1, 2 + up * along, width) out of positions of more patches along the time.
Tensor cut_positions(const Tensor& positions, const AstSize& size) {
    const std::int64_t up = size.patches_up(), along = size.patches_along();
    const std::int64_t patches = positions.size(1) - 2;
    const std::int64_t given = patches / up;
    if (positions.dim() != 3 || patches % up != 0 || given < along) return positions;
    const Tensor grid = positions.narrow(1, 2, patches).view({1, up, given, positions.size(2)});
    const Tensor middle = grid.narrow(2, given / 2 - along / 2, along);
    return torch::cat({positions.narrow(1, 0, 2), middle.reshape({1, up * along, positions.size(2)})}, 1);
}

}  // namespace

void load_ast(Ast& ast, const AstSize& size, const fs::path& file) {
    Tensors given;
    for (const auto& [name, tensor] : read_safetensors(file)) given[authors_name(name)] = tensor;
    join_attention(given, size);
    if (const auto positions = given.find("pos_embed"); positions != given.end())
        positions->second = cut_positions(positions->second, size);
    Tensors needed;
    for (const auto& item : ast->named_parameters())
        needed[item.key()] = find_tensor(given, item.key(), item.value().sizes(), file);
    set_weights(*ast, needed, file);
}

}  // namespace chironomia
