// chironomia train
#include <cstdio>

#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "synth/learning.h"

namespace chironomia {
namespace {

Json job_of(const TrainCommand& command) {
    Json job = {{"verb", "train"},
                {"model", command.model},
                {"preset", command.preset},
                {"corpus", std::filesystem::absolute(command.corpus).lexically_normal().string()},
                {"out", std::filesystem::absolute(command.out).lexically_normal().string()},
                {"seed", command.seed},
                {"threads", command.threads},
                {"quiet", command.quiet},
                {"options", Json::object()}};
    for (const auto& [name, value] : command.options) job["options"][name] = value;
    if (command.epochs) job["epochs"] = *command.epochs;
    if (command.steps) job["steps"] = *command.steps;
    return job;
}

}  // namespace

int run(const TrainCommand& command) {
    const Json answer = ask_to_learn(job_of(command));
    if (command.json) {
        std::fputs((answer.dump(2) + "\n").c_str(), stdout);
        return kExitYes;
    }
    std::fputs(format("{}\n{} steps, loss {:.4f} in training and {:.4f} in validation\n",
                      answer.at("checkpoint").get<std::string>(), answer.at("steps").get<long long>(),
                      answer.at("train_loss").get<double>(), answer.at("validation_loss").get<double>())
                   .c_str(),
               stdout);
    return kExitYes;
}

}  // namespace chironomia
