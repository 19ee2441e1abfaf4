// The numbers of every preset and ablation of the models of style, as papers print them and as an independent
// implementation counts them.
#include <gtest/gtest.h>

#include "synth/learned/models.h"
#include "synth/learned/styles/mix_stage.h"
#include "synth/learned/styles/zs_mstm_presets.h"
#include "tests/synth/learned/parameters.h"
#include "tests/synth/learned/styles/reference.h"

namespace chironomia {
namespace {

using namespace testing;

std::int64_t counted(const std::string& name) {
    return reference().at("counts").at(name).at("count");
}

struct PresetCounts {
    const char* model;
    const char* preset;
    Json options;
    const char* counts;                                            // in the reference
    std::int64_t printed = 0, without_ast = 0, discriminator = 0;  // in MODELS; 0: not there
};

class StyleCounts : public ::testing::TestWithParam<PresetCounts> {};

// What the style is taken from, and whether an adversary learns, changes none of them; of the small ones alone, as a large
// one takes seconds to make.
TEST_P(StyleCounts, AreThoseOfTheReference) {
    const PresetCounts& expected = GetParam();
    const std::string name = expected.counts;
    std::vector<std::string> ablations{"none"};
    if (std::string(expected.model).starts_with("zs-mstm") && std::string(expected.preset) == "small")
        ablations = {"none", "fader", "pose_only", "speech_only", "text_only"};
    for (const std::string& ablation : ablations) {
        Json options = expected.options;
        if (ablation != "none") options["ablation"] = ablation;
        const Json described = answer({{"verb", "describe"},
                                       {"model", expected.model},
                                       {"preset", expected.preset},
                                       {"options", options}});
        EXPECT_EQ(described.at("parameters"), counted(name)) << ablation;
        if (expected.printed > 0) {
            EXPECT_EQ(described.at("parameters"), expected.printed);
        }
        if (expected.discriminator > 0) {
            EXPECT_EQ(described.at("discriminator_parameters"), expected.discriminator);
        }
        if (described.contains("discriminator_parameters")) {
            EXPECT_EQ(described.at("discriminator_parameters"), counted(name + "_discriminator"));
        }
        if (!described.contains("parameters_without_ast")) continue;
        EXPECT_EQ(described.at("parameters_without_ast"), counted(name) - counted(name + "_ast"));
        if (expected.without_ast > 0) {
            EXPECT_EQ(described.at("parameters_without_ast"), expected.without_ast);
        }
    }
}

const Json kNoOptions = Json::object();
const Json kPair{{"source", "a"}, {"target", "b"}};

INSTANTIATE_TEST_SUITE_P(
    Styles, StyleCounts,
    ::testing::Values(
        PresetCounts{"zs-mstm-1", "paper", kNoOptions, "zs1_paper", 212'218'902, 41'613'846, 2'231'552},
        PresetCounts{"zs-mstm-1", "paper", {{"A48", "shared"}}, "zs1_shared", 126'916'374},
        PresetCounts{"zs-mstm-1", "small", kNoOptions, "zs1_small", 849'558, 0, 57'792},
        PresetCounts{"zs-mstm-2", "paper", kNoOptions, "zs2_paper", 7'793'076, 6'558'260, 535'526},
        PresetCounts{"zs-mstm-2", "literal", kNoOptions, "zs2_paper", 7'793'076, 6'558'260, 535'526},
        PresetCounts{"zs-mstm-2", "paper", {{"ast", "pretrained"}}, "zs2_pretrained", 177'188'020},
        PresetCounts{"zs-mstm-2", "small", kNoOptions, "zs2_small"},
        PresetCounts{"mix-stage", "paper", kNoOptions, "mix_stage_paper", 15'144'520, 0, 171'713},
        PresetCounts{"mix-stage", "small", kNoOptions, "mix_stage_small"},
        PresetCounts{"style-classifier", "paper", kPair, "classifier_paper", 12'890'401},
        PresetCounts{"style-classifier",
                     "paper",
                     {{"source", "a"}, {"target", "b"}, {"face", "with"}},
                     "classifier_pose_and_face",
                     12'986'401},
        PresetCounts{"style-classifier", "small", kPair, "classifier_small", 89'153}),
    [](const auto& test) { return std::string(test.param.counts) + "_" + std::to_string(test.index); });

// The paper's own Mix-StAGE has 48 joints.
TEST(StyleCounts, AreThoseOfMixStageWithAllJoints) {
    const MixStage model(MixStageSize{.pose = 96});
    const std::int64_t discriminator = parameters_of(*model->discriminator);
    EXPECT_EQ(discriminator, counted("mix_stage_joints_discriminator"));
    EXPECT_EQ(parameters_of(*model) - discriminator, counted("mix_stage_joints"));
    EXPECT_EQ(parameters_of(*model) - discriminator, 15'325'080);
}

TEST(StyleCounts, AreThoseOfEachPart) {
    for (const auto& [version, name] :
         {std::pair{ZsMstmVersion::one, "zs1_paper_"}, {ZsMstmVersion::two, "zs2_paper_"}}) {
        const Json choices = zs_mstm_choices("paper", JsonValue(kNoOptions, "options"));
        const ZsMstm model(zs_mstm_size(version, "paper", choices));
        for (const char* part : {"attention", "pose_lstm", "lstm", "pose_in", "in", "pose_decoder", "decoder",
                                 "pose_out", "out"}) {
            if (!reference().at("counts").contains(name + std::string(part))) continue;
            std::int64_t sum = 0;
            for (const auto& item : model->named_parameters()) {
                const std::string theirs = reference_name(item.key());
                if (!item.key().starts_with("discriminator.") &&
                    theirs.substr(0, theirs.find('.')).ends_with(part))
                    sum += item.value().numel();
            }
            EXPECT_EQ(sum, counted(name + std::string(part))) << part;
        }
    }
}

}  // namespace
}  // namespace chironomia
