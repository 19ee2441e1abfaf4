#include "synth/learned/training/optimiser.h"

#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace fs = std::filesystem;

Optimiser::Optimiser(const OptimiserKind& kind, const torch::nn::Module& model) : kind_(kind) {
    for (const auto& item : model.named_parameters()) {
        if (!item.value().requires_grad()) continue;
        weights_.push_back({.name = item.key(),
                            .value = item.value(),
                            .first = torch::zeros_like(item.value()),
                            .second = torch::zeros_like(item.value())});
    }
}

void Optimiser::forget_gradients() {
    for (Weight& weight : weights_) weight.value.mutable_grad() = torch::Tensor();
}

double Optimiser::gradient_norm() const {
    const torch::NoGradGuard no_gradients;
    double sum = 0;
    for (const Weight& weight : weights_)
        if (weight.value.grad().defined())
            sum += weight.value.grad().square().sum(torch::kFloat64).item<double>();
    return std::sqrt(sum);
}

void Optimiser::scale_gradients(double factor) {
    const torch::NoGradGuard no_gradients;
    for (Weight& weight : weights_)
        if (weight.value.grad().defined()) weight.value.mutable_grad().mul_(factor);
}

void Optimiser::step(double rate) {
    const torch::NoGradGuard no_gradients;
    for (Weight& weight : weights_) {
        if (!weight.value.grad().defined()) continue;
        ++weight.steps;
        if (kind_.rule == OptimiserKind::Rule::adam) {
            adam(weight, rate);
        } else {
            rmsprop(weight, rate);
        }
    }
}

void Optimiser::adam(Weight& weight, double rate) {
    const torch::Tensor& gradient = weight.value.grad();
    const double count = static_cast<double>(weight.steps);
    weight.first.mul_(kind_.beta1).add_(gradient, 1 - kind_.beta1);
    weight.second.mul_(kind_.beta2).addcmul_(gradient, gradient, 1 - kind_.beta2);
    const double first_share = 1 - std::pow(kind_.beta1, count);
    const double second_share = 1 - std::pow(kind_.beta2, count);
    const torch::Tensor spread = weight.second.sqrt().div_(std::sqrt(second_share)).add_(kind_.epsilon);
    weight.value.addcdiv_(weight.first, spread, -rate / first_share);
}

void Optimiser::rmsprop(Weight& weight, double rate) {
    const torch::Tensor& gradient = weight.value.grad();
    weight.second.mul_(kind_.alpha).addcmul_(gradient, gradient, 1 - kind_.alpha);
    weight.value.addcdiv_(gradient, weight.second.sqrt().add_(kind_.epsilon), -rate);
}

Tensors Optimiser::state() const {
    Tensors state;
    std::vector<std::int64_t> steps;
    for (const Weight& weight : weights_) {
        steps.push_back(weight.steps);
        state[weight.name + "/first"] = weight.first.clone();
        state[weight.name + "/second"] = weight.second.clone();
    }
    state["steps"] = torch::tensor(steps, torch::kInt64);
    return state;
}

void Optimiser::restore(const Tensors& state, const fs::path& file) {
    const torch::NoGradGuard no_gradients;
    const auto count = static_cast<std::int64_t>(weights_.size());
    const torch::Tensor steps = find_tensor(state, "steps", {count}, file);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        Weight& weight = weights_[i];
        weight.steps = steps[static_cast<std::int64_t>(i)].item<std::int64_t>();
        weight.first.copy_(find_tensor(state, weight.name + "/first", weight.value.sizes(), file));
        weight.second.copy_(find_tensor(state, weight.name + "/second", weight.value.sizes(), file));
    }
}

Tensors weights_of(const torch::nn::Module& model) {
    const torch::NoGradGuard no_gradients;
    Tensors weights;
    for (const auto& item : model.named_parameters()) weights[item.key()] = item.value().detach().clone();
    for (const auto& item : model.named_buffers()) weights[item.key()] = item.value().detach().clone();
    return weights;
}

void check_weights(const torch::nn::Module& model, const TensorShapes& shapes, const fs::path& file) {
    std::size_t used = 0;
    const auto check = [&](const auto& items) {
        for (const auto& item : items) {
            check_shape(shapes, item.key(), item.value().sizes(), file);
            ++used;
        }
    };
    check(model.named_parameters());
    check(model.named_buffers());
    if (used == shapes.size()) return;
    for (const auto& [name, shape] : shapes) {
        if (model.named_parameters().contains(name) || model.named_buffers().contains(name)) continue;
        throw Error(
            format("{}: tensor \"{}\" is not of this model; give a file of the same model and options",
                   file.string(), name));
    }
}

void set_weights(torch::nn::Module& model, const Tensors& weights, const fs::path& file) {
    const torch::NoGradGuard no_gradients;
    TensorShapes shapes;
    for (const auto& [name, tensor] : weights) shapes[name] = tensor.sizes().vec();
    check_weights(model, shapes, file);
    const auto put = [&](const auto& items) {
        for (const auto& item : items) {
            torch::Tensor value = item.value();
            value.copy_(weights.at(item.key()));
        }
    };
    put(model.named_parameters());
    put(model.named_buffers());
}

}  // namespace chironomia
