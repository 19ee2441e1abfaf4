#include "synth/learned/bert.h"

#include <torch/script.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/records.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

using torch::Tensor;

constexpr double kNormEpsilon = 1e-12;
constexpr std::size_t kMostPieces = 510;  // besides [CLS] and [SEP]

// "bert.encoder.layer.0.output.LayerNorm.gamma" -> "encoder.layer.0.output.LayerNorm.weight"
std::string present_name(std::string name) {
    if (name.starts_with("bert.")) name.erase(0, 5);
    for (const auto& [old_end, new_end] : {std::pair{".gamma", ".weight"}, {".beta", ".bias"}})
        if (name.ends_with(old_end)) name.replace(name.rfind('.'), std::string::npos, new_end);
    return name;
}

class Bert {
  public:
    Bert(Tensors weights, const BertSize& size) : weights_(std::move(weights)), size_(size) {}

    Tensor states(const std::vector<int>& pieces) const {
        const torch::NoGradGuard no_gradients;
        const auto count = static_cast<std::int64_t>(pieces.size());
        const Tensor ids = torch::tensor(std::vector<std::int64_t>(pieces.begin(), pieces.end()));
        Tensor x = at("embeddings.word_embeddings.weight").index_select(0, ids) +
                   at("embeddings.position_embeddings.weight").narrow(0, 0, count) +
                   at("embeddings.token_type_embeddings.weight")[0];
        x = normed(x, "embeddings.LayerNorm");
        for (std::int64_t i = 0; i < size_.layers; ++i) x = layer(x, format("encoder.layer.{}.", i));
        return x;
    }

  private:
    const Tensor& at(const std::string& name) const { return weights_.at(name); }

    Tensor dense(const Tensor& x, const std::string& name) const {
        return torch::linear(x, at(name + ".weight"), at(name + ".bias"));
    }

    Tensor normed(const Tensor& x, const std::string& name) const {
        return torch::layer_norm(x, {size_.width}, at(name + ".weight"), at(name + ".bias"), kNormEpsilon);
    }

    // (P, width) -> (heads, P, width / heads)
    Tensor heads_of(const Tensor& x, const std::string& name) const {
        return dense(x, name).view({x.size(0), size_.heads, size_.width / size_.heads}).transpose(0, 1);
    }

    Tensor layer(const Tensor& x, const std::string& name) const {
        const Tensor query = heads_of(x, name + "attention.self.query");
        const Tensor key = heads_of(x, name + "attention.self.key");
        const Tensor value = heads_of(x, name + "attention.self.value");
        const double scale = 1 / std::sqrt(static_cast<double>(size_.width / size_.heads));
        const Tensor weights = torch::softmax(torch::bmm(query, key.transpose(1, 2)) * scale, -1);
        const Tensor seen = torch::bmm(weights, value).transpose(0, 1).reshape(x.sizes());
        const Tensor attended =
            normed(x + dense(seen, name + "attention.output.dense"), name + "attention.output.LayerNorm");
        const Tensor hidden = torch::gelu(dense(attended, name + "intermediate.dense"));
        return normed(attended + dense(hidden, name + "output.dense"), name + "output.LayerNorm");
    }

    Tensors weights_;
    BertSize size_;
};

BertStates read_torch_script(const fs::path& file) {
    torch::jit::Module module;
    try {
        module = torch::jit::load(file.string());
    } catch (const c10::Error& problem) {
        throw Error(
            format("{}: is neither a safetensors nor a TorchScript file ({}); give BERT's weights as one "
                   "of them",
                   file.string(), split(problem.what_without_backtrace(), '\n').front()));
    }
    module.eval();
    return [module, file](const std::vector<int>& pieces) mutable {
        const torch::NoGradGuard no_gradients;
        const Tensor ids =
            torch::tensor(std::vector<std::int64_t>(pieces.begin(), pieces.end())).unsqueeze(0);
        const c10::IValue answer = module.forward({ids, torch::ones_like(ids)});
        const std::vector<std::int64_t> shape{1, ids.size(1), static_cast<std::int64_t>(kWordVector)};
        if (!answer.isTensor() || answer.toTensor().sizes() != torch::IntArrayRef(shape)) {
            throw Error(
                format("{}: does not answer (1, {}) ids and their mask with states of the shape "
                       "[{}]; trace BERT so that it gives its last hidden states alone",
                       file.string(), pieces.size(), fmt::join(shape, ", ")));
        }
        return answer.toTensor()[0].to(torch::kFloat32).contiguous();
    };
}

// One word's pieces stay together; one of more pieces than fit is cut off.
std::vector<PiecedWords> parts_of(const PiecedWords& all) {
    std::vector<PiecedWords> parts(1);
    for (std::size_t begin = 0; begin < all.ids.size();) {
        std::size_t end = begin;
        while (end < all.ids.size() && all.word[end] == all.word[begin]) ++end;
        const std::size_t count = std::min(end - begin, kMostPieces);
        if (parts.back().ids.size() + count > kMostPieces) parts.emplace_back();
        for (std::size_t i = begin; i < begin + count; ++i) {
            parts.back().ids.push_back(all.ids[i]);
            parts.back().word.push_back(all.word[i]);
        }
        begin = end;
    }
    return parts;
}

}  // namespace

std::map<std::string, std::vector<std::int64_t>> bert_shapes(const BertSize& size) {
    std::map<std::string, std::vector<std::int64_t>> shapes{
        {"embeddings.word_embeddings.weight", {size.pieces, size.width}},
        {"embeddings.position_embeddings.weight", {size.positions, size.width}},
        {"embeddings.token_type_embeddings.weight", {size.segments, size.width}}};
    const auto dense = [&](const std::string& name, std::int64_t outputs, std::int64_t inputs) {
        shapes[name + ".weight"] = {outputs, inputs};
        shapes[name + ".bias"] = {outputs};
    };
    const auto norm = [&](const std::string& name) {
        shapes[name + ".weight"] = shapes[name + ".bias"] = {size.width};
    };
    norm("embeddings.LayerNorm");
    for (std::int64_t i = 0; i < size.layers; ++i) {
        const std::string at = format("encoder.layer.{}.", i);
        for (const char* part : {"query", "key", "value"})
            dense(at + "attention.self." + part, size.width, size.width);
        dense(at + "attention.output.dense", size.width, size.width);
        norm(at + "attention.output.LayerNorm");
        dense(at + "intermediate.dense", size.hidden, size.width);
        dense(at + "output.dense", size.width, size.hidden);
        norm(at + "output.LayerNorm");
    }
    dense("pooler.dense", size.width, size.width);
    return shapes;
}

BertStates bert_of(Tensors weights, const BertSize& size, const fs::path& file) {
    Tensors present;
    for (auto& [name, tensor] : weights) present[present_name(name)] = std::move(tensor);
    for (const auto& [name, shape] : bert_shapes(size))
        if (!name.starts_with("pooler.")) find_tensor(present, name, shape, file);
    return [bert = Bert(std::move(present), size)](const std::vector<int>& pieces) {
        return bert.states(pieces);
    };
}

BertStates read_bert(const fs::path& file) {
    if (file.extension() != ".safetensors") return read_torch_script(file);
    return bert_of(read_safetensors(file), {}, file);
}

std::vector<float> word_vectors(const BertStates& bert, const WordPieces& pieces,
                                const std::vector<std::string>& words) {
    constexpr auto kWidth = static_cast<std::int64_t>(kWordVector);
    const Tensor sums = torch::zeros({static_cast<std::int64_t>(words.size()), kWidth});
    const Tensor counts = torch::zeros({static_cast<std::int64_t>(words.size()), 1});
    for (const PiecedWords& part : parts_of(pieces_of(pieces, words))) {
        std::vector<int> ids{pieces.begin()};
        ids.insert(ids.end(), part.ids.begin(), part.ids.end());
        ids.push_back(pieces.end());
        const Tensor states = bert(ids);
        for (std::size_t i = 0; i < part.word.size(); ++i) {
            const auto word = static_cast<std::int64_t>(part.word[i]);
            sums[word] += states[static_cast<std::int64_t>(i) + 1];
            counts[word] += 1;
        }
    }
    const Tensor means = sums / counts;
    return {means.data_ptr<float>(), means.data_ptr<float>() + means.numel()};
}

}  // namespace chironomia
