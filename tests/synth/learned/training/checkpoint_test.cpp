#include "synth/learned/training/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/files.h"
#include "synth/learned/training/optimiser.h"
#include "tests/support/support.h"
#include "tests/synth/learned/toy_task.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::refusal_of;
using testing::TemporaryFolder;

StoredCheckpoint some_checkpoint(float weight) {
    Checkpoint checkpoint = testing::toy_description();
    checkpoint.text_encoder = "hashbert";
    checkpoint.seed = 7;
    checkpoint.step = 12;
    checkpoint.training = {{"state", {{"epoch", 3}}}};
    checkpoint.curve = {{.step = 4, .train = 0.1, .validation = 1.0 / 3}};
    return {.description = std::move(checkpoint),
            .weights = {{"w", torch::full({2, 2}, weight)}},
            .resume = {{"last/w", torch::full({2, 2}, weight + 1)}}};
}

float weight_in(const fs::path& file) {
    return read_checkpoint(file, CheckpointParts::all).weights.at("w")[0][0].item<float>();
}

TEST(Checkpoint, GivesBackWhatWasWritten) {
    const TemporaryFolder folder;
    const StoredCheckpoint stored = some_checkpoint(0.1f);
    const Checkpoint& written = stored.description;
    write_checkpoint(folder / "c.json", stored);
    for (const char* name : {"c", "c.json", "c.safetensors"}) {
        const auto [found, weights, resume] = read_checkpoint(folder / name, CheckpointParts::all);
        EXPECT_EQ(found.model, "toy");
        EXPECT_EQ(found.preset, "small");
        EXPECT_EQ(found.options, written.options);
        EXPECT_EQ(found.text_encoder, "hashbert");
        ASSERT_EQ(found.inputs.size(), 1u);
        EXPECT_EQ(found.inputs[0].high, 0.1);
        EXPECT_EQ(found.outputs[1].name, "z");
        EXPECT_EQ(found.seed, 7u);
        EXPECT_EQ(found.step, 12u);
        EXPECT_EQ(found.training, written.training);
        EXPECT_EQ(found.curve.at(0).validation, 1.0 / 3);
        EXPECT_TRUE(torch::equal(weights.at("w"), stored.weights.at("w")));
        EXPECT_TRUE(torch::equal(resume.at("last/w"), stored.resume.at("last/w")));
    }
}

// A writer that is killed leaves one of these states: the files of the old and of the new checkpoint, with
// the new tensors waiting before and after the new description stands.
TEST(Checkpoint, IsWholeWhereverTheWriterWasKilled) {
    const TemporaryFolder old_one, new_one, killed;
    write_checkpoint(old_one / "c", some_checkpoint(1));
    write_checkpoint(new_one / "c", some_checkpoint(2));
    const auto waiting = [&](const char* ending) { return killed / (std::string(".c") + ending + ".next"); };
    const auto put = [&](const TemporaryFolder& from, const char* ending, const fs::path& to) {
        fs::copy_file(from / (std::string("c") + ending), to, fs::copy_options::overwrite_existing);
    };
    for (const char* ending : {".json", ".safetensors", ".resume.safetensors"})
        put(old_one, ending, killed / (std::string("c") + ending));
    put(new_one, ".safetensors", waiting(".safetensors"));
    EXPECT_EQ(weight_in(killed / "c"), 1);
    put(new_one, ".resume.safetensors", waiting(".resume.safetensors"));
    EXPECT_EQ(weight_in(killed / "c"), 1);
    put(new_one, ".json", killed / "c.json");
    EXPECT_EQ(weight_in(killed / "c"), 2);
    fs::rename(waiting(".safetensors"), killed / "c.safetensors");
    EXPECT_EQ(weight_in(killed / "c"), 2);
    EXPECT_EQ(read_checkpoint(killed / "c", CheckpointParts::all).resume.at("last/w")[0][0].item<float>(), 3);
    // The next writer, killed at once, does not lose what waits.
    write_checkpoint(killed / "c", some_checkpoint(4));
    EXPECT_EQ(weight_in(killed / "c"), 4);
    EXPECT_FALSE(fs::exists(waiting(".resume.safetensors")));
}

TEST(Checkpoint, RefusesFilesThatAreNotAPair) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "a", some_checkpoint(1));
    write_checkpoint(folder / "b", some_checkpoint(2));
    fs::copy_file(folder / "b.safetensors", folder / "a.safetensors", fs::copy_options::overwrite_existing);
    EXPECT_THAT(refusal_of([&] { weight_in(folder / "a"); }),
                HasSubstr("a.safetensors: these are not the bytes that a.json names"));
    fs::resize_file(folder / "b.safetensors", 100);
    EXPECT_THAT(refusal_of([&] { weight_in(folder / "b"); }),
                AllOf(HasSubstr("b.safetensors"), HasSubstr("it is damaged, truncated or of another")));
    fs::remove(folder / "b.safetensors");
    EXPECT_THAT(refusal_of([&] { weight_in(folder / "b"); }),
                HasSubstr("b.json: b.safetensors is missing beside it; copy both files"));
    EXPECT_THAT(
        refusal_of([&] { weight_in(folder / "c"); }),
        HasSubstr("c.safetensors: there is no such checkpoint, and no c.json beside it; check the path"));
}

TEST(Checkpoint, WithoutTheStateOfItsTrainingIsOnlyUsed) {
    const TemporaryFolder folder;
    StoredCheckpoint checkpoint = some_checkpoint(1);
    checkpoint.resume.clear();
    write_checkpoint(folder / "c", checkpoint);
    EXPECT_EQ(read_checkpoint(folder / "c", CheckpointParts::weights).weights.size(), 1u);
    EXPECT_THAT(refusal_of([&] { weight_in(folder / "c"); }),
                HasSubstr("was written without the state of its training, which cannot go on; train anew"));
}

TEST(Checkpoint, RefusesADescriptionThatIsNone) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "c", some_checkpoint(1));
    const auto refusal_with = [&](const char* key, const Json& value) {
        Json json = read_json(folder / "c.json");
        json[key] = value;
        write_json(folder / "d.json", json);
        return refusal_of([&] { read_checkpoint(folder / "d", CheckpointParts::description); });
    };
    EXPECT_THAT(refusal_with("format", "other 2"),
                HasSubstr("format: is \"other 2\", this program reads \"chironomia checkpoint 1\""));
    EXPECT_THAT(refusal_with("inputs", Json::array({{{"name", "x"}, {"low", 1}, {"high", 1}}})),
                HasSubstr("inputs[0]: has the range 1 to 1, which is none; train again"));
    EXPECT_THAT(refusal_with("options", 3),
                HasSubstr("options: is 3, an object in curly brackets is needed"));
    EXPECT_THAT(refusal_with("text_encoder", 3), HasSubstr("text_encoder: is 3, a text is needed"));
    EXPECT_THAT(refusal_with("curve", Json::array({Json::array({1, 2})})), HasSubstr("curve[0]"));
}

TEST(Checkpoint, RefusesToStandForAnother) {
    const Checkpoint checkpoint = some_checkpoint(1).description;
    const auto refusal = [&](const CheckpointNeed& need) {
        return refusal_of([&] { check_fits("c.json", checkpoint, need); });
    };
    check_fits("c.json", checkpoint, {.model = "toy", .preset = "small", .outputs = {"y", "z"}});
    EXPECT_THAT(refusal({.model = "amii"}), HasSubstr("c.json: its model is toy, amii is needed"));
    EXPECT_THAT(refusal({.preset = "paper"}), HasSubstr("c.json: its preset is small, paper is needed"));
    EXPECT_THAT(refusal({.outputs = {"z", "y"}}), HasSubstr("c.json: its outputs are y, z, needed are z, y"));
    EXPECT_THAT(refusal({.inputs = {"x", "w"}}), HasSubstr("c.json: its inputs are x, needed are x, w"));
}

TEST(Checkpoint, PutsWeightsBackWhereTheyWere) {
    testing::ToyTask from, to;
    from.model->weight.data().fill_(2);
    set_weights(*to.model, weights_of(*from.model), "c");
    EXPECT_TRUE(torch::equal(to.model->weight, from.model->weight));
    Tensors weights = weights_of(*from.model);
    weights.erase("bias");
    EXPECT_THAT(refusal_of([&] { set_weights(*to.model, weights, "c"); }),
                HasSubstr("c: tensor \"bias\" is missing"));
    weights["bias"] = torch::zeros({3});
    EXPECT_THAT(refusal_of([&] { set_weights(*to.model, weights, "c"); }),
                HasSubstr("c: tensor \"bias\" has the shape [3], the model needs [2]"));
    weights = weights_of(*from.model);
    weights["more"] = torch::zeros({1});
    EXPECT_THAT(refusal_of([&] { set_weights(*to.model, weights, "c"); }),
                HasSubstr("c: tensor \"more\" is not of this model"));
}

}  // namespace
}  // namespace chironomia
