#include "synth/learned/models.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "synth/learned/dyads/dyad_jobs.h"
#include "synth/learned/encode.h"
#include "synth/learned/faces/face_jobs.h"
#include "synth/learned/styles/style_classifier.h"
#include "synth/learned/styles/style_jobs.h"
#include "synth/learned/training/checkpoint.h"

namespace chironomia {
namespace {

using Verb = LearnedModel::Answer LearnedModel::*;

constexpr std::pair<const char*, Verb> kVerbs[] = {{"train", &LearnedModel::train},
                                                   {"predict", &LearnedModel::predict},
                                                   {"animate", &LearnedModel::animate},
                                                   {"describe", &LearnedModel::describe},
                                                   {"encode_styles", &LearnedModel::encode_styles}};

std::vector<std::string> verb_names() {
    std::vector<std::string> names;
    for (const auto& [name, verb] : kVerbs) names.emplace_back(name);
    names.emplace_back("encode");
    return names;
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const LearnedModel& model : learned_models()) names.push_back(model.name);
    return names;
}

}  // namespace

std::span<const LearnedModel> learned_models() {
    static const std::vector<LearnedModel> models{dyad_learned_model("amii"),
                                                  dyad_learned_model("il-lstm"),
                                                  dyad_learned_model("sym-il-lstm"),
                                                  hold_model(),
                                                  model1_jobs(),
                                                  model2_jobs(),
                                                  zs_mstm_model("zs-mstm-1"),
                                                  zs_mstm_model("zs-mstm-2"),
                                                  mix_stage_model(),
                                                  style_classifier_model()};
    return models;
}

const LearnedModel& model_of(const JsonValue& job) {
    std::string name;
    if (const auto model = job.find("model")) {
        name = model->choice(model_names());
    } else {
        const std::string file = job.at("checkpoint").text();
        name = read_checkpoint(file, CheckpointParts::description).description.model;
    }
    const auto models = learned_models();
    const auto found =
        std::find_if(models.begin(), models.end(), [&](const LearnedModel& m) { return m.name == name; });
    if (found == models.end()) {
        throw Error(
            format("{}: holds the model \"{}\", this program knows {}; install the version that made it",
                   job.at("checkpoint").text(), name, join(model_names())));
    }
    return *found;
}

Json answer(const Json& job) {
    const JsonValue value(job, "job");
    const std::string verb = value.at("verb").choice(verb_names());
    if (verb == "encode") return encode_words(value);
    const auto* entry =
        std::find_if(std::begin(kVerbs), std::end(kVerbs), [&](const auto& v) { return verb == v.first; });
    const LearnedModel& model = model_of(value);
    const LearnedModel::Answer& known = model.*(entry->second);
    if (!known) throw Error(format("{}: it has no styles; ask a model of style", model.name));
    return known(value);
}

}  // namespace chironomia
