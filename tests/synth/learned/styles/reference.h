// What an independent implementation computes (reference.py, printed in reference.json), and the weights and inputs
// that both are filled with.
#pragma once

#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/files/json.h"
#include "tests/support/support.h"

namespace chironomia::testing {

inline Json reference() {
    return Json::parse(read_text(source_dir() / "tests/synth/learned/styles/reference.json"));
}

// sin(0.37 i + the sum of the bytes of the name), as 32-bit floats hold it.
inline torch::Tensor formula(const std::string& name, torch::IntArrayRef shape, double scale = 1,
                             double offset = 0) {
    const double sum = std::accumulate(name.begin(), name.end(), 0.0, [](double all, char c) {
        return all + static_cast<unsigned char>(c);
    });
    std::int64_t count = 1;
    for (const std::int64_t side : shape) count *= side;
    const torch::Tensor i = torch::arange(count, torch::kFloat64);
    return (offset + scale * torch::sin(0.37 * i + sum)).to(torch::kFloat32).to(torch::kFloat64).view(shape);
}

// The name of a tensor in the reference, where ours is another.
inline std::string reference_name(std::string name) {
    const std::pair<const char*, const char*> renamed[] = {
        {"pose.in.", "pose_in."}, {"pose.layer.", "pose_decoder."}, {"pose.out.", "pose_out."},
        {"face.in.", "face_in."}, {"face.layer.", "face_decoder."}, {"face.out.", "face_out."},
        {"discriminator.", ""}};
    for (const auto& [ours, theirs] : renamed)
        if (name.starts_with(ours)) return theirs + name.substr(std::string(ours).size());
    return name;
}

inline bool is_norm_weight(const std::string& name) {
    for (const char* end : {"norm.weight", "norm1.weight", "norm2.weight", "norm3.weight", "running_var"})
        if (name.ends_with(end)) return true;
    return false;
}

// In 64-bit floats and evaluation mode, as the reference is.
inline void fill(torch::nn::Module& model) {
    const torch::NoGradGuard no_gradients;
    model.to(torch::kFloat64);
    model.eval();
    const auto put = [](const auto& items) {
        for (const auto& item : items) {
            const std::string name = reference_name(item.key());
            if (name.ends_with("num_batches_tracked")) continue;
            torch::Tensor value = item.value();
            value.copy_(formula(name, value.sizes(), 0.1, is_norm_weight(name) ? 1 : 0));
        }
    };
    put(model.named_parameters());
    put(model.named_buffers());
}

inline void expect_near(double found, double expected, const std::string& what) {
    EXPECT_NEAR(found, expected, 1e-6 * std::max(1.0, std::abs(expected))) << what;
}

inline void expect_all_near(const torch::Tensor& found, const Json& expected, const std::string& what) {
    std::vector<double> values;
    for (const Json& row : expected)
        for (const Json& value : row.is_array() ? row : Json::array({row}))
            values.push_back(value.get<double>());
    const torch::Tensor flat = found.detach().reshape({-1});
    ASSERT_EQ(flat.numel(), static_cast<std::int64_t>(values.size())) << what;
    for (std::size_t i = 0; i < values.size(); ++i)
        expect_near(flat[static_cast<std::int64_t>(i)].item<double>(), values[i], what);
}

// Shape, first and last values, sum and sum of squares.
inline void expect_summary(const torch::Tensor& found, const Json& expected, const std::string& what) {
    ASSERT_EQ(found.sizes().vec(), expected.at("shape").get<std::vector<std::int64_t>>()) << what;
    const torch::Tensor flat = found.detach().reshape({-1});
    const auto shown = static_cast<std::int64_t>(expected.at("first").size());
    expect_all_near(flat.slice(0, 0, shown), expected.at("first"), what + " first");
    expect_all_near(flat.slice(0, flat.numel() - static_cast<std::int64_t>(expected.at("last").size())),
                    expected.at("last"), what + " last");
    expect_near(flat.sum().item<double>(), expected.at("sum").get<double>(), what + " sum");
    expect_near(flat.square().sum().item<double>(), expected.at("sum_of_squares").get<double>(),
                what + " sum of squares");
}

// The gradients of every parameter that has one, by their sums; how far they are apart is a part of their length, or,
// where it is nothing but rounding, of all gradients' length.
//   expected  {name: [sum, sum of squares]}
inline void expect_gradients(const torch::nn::Module& model, const Json& expected, bool of_discriminator) {
    double all = 0;
    for (const Json& sums : expected) all += sums[1].get<double>();
    const double least = 1e-5 * std::sqrt(all);
    double largest = 0;
    std::size_t compared = 0;
    for (const auto& item : model.named_parameters()) {
        if (item.key().starts_with("discriminator.") != of_discriminator || !item.value().grad().defined())
            continue;
        const std::string name = reference_name(item.key());
        ASSERT_TRUE(expected.contains(name)) << name;
        const torch::Tensor gradient = item.value().grad();
        const double length = std::sqrt(expected[name][1].get<double>());
        const double differences[] = {gradient.sum().item<double>() - expected[name][0].get<double>(),
                                      gradient.norm().item<double>() - length};
        for (const double difference : differences) {
            const double part = std::abs(difference) / std::max(length, least);
            // The largest, of a norm in the transformer of zs1, is 9.0e-6; other processors round otherwise.
            EXPECT_LT(part, 2e-5) << name;
            largest = std::max(largest, part);
        }
        ++compared;
    }
    EXPECT_EQ(compared, expected.size());
    ::testing::Test::RecordProperty("largest_difference", std::to_string(1e6 * largest) + "e-6");
}

}  // namespace chironomia::testing
