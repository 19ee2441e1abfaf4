#include "synth/learned/styles/zs_mstm.h"

#include <gtest/gtest.h>

#include "tests/synth/learned/overfit.h"
#include "tests/synth/learned/styles/reference.h"

namespace chironomia {
namespace {

using namespace testing;
using torch::Tensor;

ZsMstmSize size_of(const Json& sizes) {
    const auto width = [&](const char* key) {
        return sizes.at(key).is_null() ? std::int64_t{0} : sizes.at(key).get<std::int64_t>();
    };
    return {.ast = {.frames = width("frames"),
                    .width = width("ast"),
                    .heads = width("ast_heads"),
                    .depth = width("ast_depth"),
                    .hidden = width("ast_ffn")},
            .speech = width("speech"),
            .text = width("text"),
            .memory = width("lstm"),
            .width = width("d"),
            .hidden = width("ffn"),
            .has_face = sizes.at("face").get<bool>(),
            .adversary = width("hidden")};
}

StyleSegments segments_of(const ZsMstmSize& size) {
    const std::int64_t frames = size.ast.frames;
    return {.mel = formula("mel", {2, frames, kStyleMel}),
            .text = formula("text", {2, frames, kStyleText}),
            .pose = formula("pose", {2, frames, kStylePose}),
            .face = formula("face", {2, frames, kStyleFace}),
            .acts = (formula("tags", {2, kStyleActs}) > 0).to(torch::kFloat64)};
}

// What the motion is to become.
StyleSegments targets_of(const ZsMstmSize& size) {
    return {.pose = formula("target", {2, size.ast.frames, kStylePose}),
            .face = formula("target_face", {2, size.ast.frames, kStyleFace})};
}

class ZsMstmReference : public ::testing::TestWithParam<const char*> {};

TEST_P(ZsMstmReference, ComputesTheSame) {
    const Json expected = reference().at(GetParam());
    const ZsMstmSize size = size_of(expected.at("sizes"));
    ZsMstm model(size);
    fill(*model);
    const StyleSegments segments = segments_of(size), targets = targets_of(size);
    const Tensor content = model->content_of(segments), style = model->style_of(segments);
    const StyledMotion motion = model->generate(content, style);
    expect_summary(content, expected.at("h_content"), "h_content");
    expect_summary(motion.pose, expected.at("pose"), "pose");
    if (expected.contains("h_style")) expect_all_near(style, expected.at("h_style"), "h_style");
    if (size.has_face) expect_summary(motion.face, expected.at("face"), "face");
    if (expected.contains("discriminator"))
        expect_all_near(model->discriminator->forward(content), expected.at("discriminator"), "guess");
    const Json& losses = expected.at("losses");
    expect_near(reconstruction_loss(motion, targets).item<double>(), losses.at("reconstruction"), "L_rec");
    expect_near(guess_loss(model->discriminator, content, style).item<double>(), losses.at("discriminator"),
                "L_dis");
    expect_near(fader_loss(model->discriminator, content, style.detach()).item<double>(),
                losses.at("adversarial"), "L_adv");
}

INSTANTIATE_TEST_SUITE_P(Styles, ZsMstmReference, ::testing::Values("zs1", "zs2", "zs2_projected"));

class ZsMstmStep : public ::testing::TestWithParam<const char*> {};

// The discriminator's step, then the generator's against what it became.
TEST_P(ZsMstmStep, LearnsTheSame) {
    const Json expected = reference().at("step").at(GetParam());
    const ZsMstmSize size = size_of(reference().at(GetParam()).at("sizes"));
    ZsMstm model(size);
    fill(*model);
    Optimiser optimiser({.beta1 = 0.95, .beta2 = 0.999}, *model);
    const StyleSegments segments = segments_of(size), targets = targets_of(size);
    const Tensor content = model->content_of(segments), style = model->style_of(segments);
    optimiser.forget_gradients();
    guess_loss(model->discriminator, content, style).backward();
    expect_gradients(*model, expected.at("discriminator"), true);
    optimiser.step(1e-3);
    optimiser.forget_gradients();
    const Tensor loss = reconstruction_loss(model->generate(content, style), targets) +
                        0.5 * fader_loss(model->discriminator, content, style.detach());
    expect_near(loss.item<double>(), expected.at("losses").at("generator"), "loss");
    loss.backward();
    expect_gradients(*model, expected.at("generator"), false);
}

INSTANTIATE_TEST_SUITE_P(Styles, ZsMstmStep, ::testing::Values("zs1", "zs2", "zs2_projected"));

ZsMstmSize tiny_size() {
    ZsMstmSize size = size_of(reference().at("zs1").at("sizes"));
    size.dropout = 0;
    return size;
}

StyleSegments in_floats(StyleSegments segments) {
    for (Tensor* tensor : {&segments.mel, &segments.text, &segments.pose, &segments.face, &segments.acts})
        *tensor = tensor->to(torch::kFloat32);
    return segments;
}

TEST(ZsMstm, LearnsOneBatchByHeart) {
    torch::manual_seed(1);
    ZsMstmSize size = tiny_size();
    size.width = 64;
    size.hidden = 128;
    ZsMstm model(size);
    const StyleSegments segments = in_floats(segments_of(size));
    const double left = loss_left(*model, {.steps = 450, .rate = 3e-3}, [&] {
        return reconstruction_loss(model->generate(model->content_of(segments), model->style_of(segments)),
                                   segments);
    });
    EXPECT_LT(left, 0.05);
}

// What is said is in the content alone, and how somebody moves in the style alone.
TEST(ZsMstm, TakesContentAndStyleFromTheirOwnSegments) {
    torch::manual_seed(1);
    ZsMstm model(tiny_size());
    model->eval();
    const StyleSegments segments = in_floats(segments_of(model->size()));
    StyleSegments other = segments;
    other.pose = -segments.pose;
    EXPECT_TRUE(model->content_of(segments).equal(model->content_of(other)));
    EXPECT_FALSE(model->style_of(segments).equal(model->style_of(other)));
}

TEST(ZsMstm, DecoderSeesNoLaterFrame) {
    torch::manual_seed(1);
    ZsMstm model(tiny_size());
    model->eval();
    const std::int64_t frames = model->size().ast.frames;
    Tensor content = torch::randn({1, frames, model->size().content_width()});
    const Tensor style = torch::randn({1, model->size().style_width()});
    const Tensor before = model->generate(content, style).pose.clone();
    content.slice(1, 40) += 1;
    const Tensor after = model->generate(content, style).pose;
    EXPECT_TRUE(before.slice(1, 0, 40).equal(after.slice(1, 0, 40)));
    EXPECT_FALSE(before.slice(1, 40).equal(after.slice(1, 40)));
}

TEST(ZsMstm, TakesStyleFromWhatAnAblationLeaves) {
    torch::manual_seed(1);
    ZsMstmSize size = tiny_size();
    size.sources = {.speech = false, .text = false};
    ZsMstm model(size);
    model->eval();
    const StyleSegments segments = in_floats(segments_of(size));
    StyleSegments other = segments;
    other.mel = -segments.mel;
    other.text = -segments.text;
    EXPECT_TRUE(model->style_of(segments).equal(model->style_of(other)));
}

TEST(ZsMstm, EncodesEachModalityOfTheStyleByItself) {
    ZsMstmSize size = tiny_size();
    size.has_face = true;
    const auto encode = [](ZsMstmSize of, const StyleSegments& segments) {
        torch::manual_seed(1);
        ZsMstm model(of);
        model->eval();
        return model->modalities_of(segments);
    };
    const StyleSegments segments = in_floats(segments_of(size));
    StyleSegments other = segments;
    other.pose = -segments.pose;
    const auto before = encode(size, segments), after = encode(size, other);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < before.size(); ++i) {
        names.push_back(before[i].name);
        EXPECT_EQ(before[i].encoded.equal(after[i].encoded), names.back() != "pose") << names.back();
    }
    EXPECT_EQ(names, (std::vector<std::string>{"speech", "text", "pose", "face"}));
    size.sources = {.speech = false, .text = false};
    EXPECT_EQ(encode(size, segments).size(), 2u) << "pose and face alone";
}

// The discriminator is frozen: what hides style from it does not teach it.
TEST(ZsMstm, FaderLossTeachesTheContentEncoderAlone) {
    torch::manual_seed(1);
    ZsMstm model(tiny_size());
    const StyleSegments segments = in_floats(segments_of(model->size()));
    const Tensor style = model->style_of(segments).detach();
    fader_loss(model->discriminator, model->content_of(segments), style).backward();
    for (const auto& item : model->named_parameters()) {
        const bool learns = item.value().grad().defined();
        EXPECT_EQ(learns, item.key().starts_with("content_")) << item.key();
    }
}

}  // namespace
}  // namespace chironomia
