// chironomia study presets
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/plan/presets.h"

namespace chironomia::study {

void add_study_presets(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyPresetsCommand>();
    CLI::App* verb = add_verb(study, "presets", "List the protocols that a plan can take its values from",
                              "  $ chironomia study presets\n  $ chironomia study presets --json");
    verb->add_flag("--json", command->json, "All that each of them says");
    verb->callback([&result, command] { result = *command; });
}

int run(const StudyPresetsCommand& command) {
    Json list = Json::array();
    std::string table;
    for (const Preset& preset : presets()) {
        list.push_back({{"name", preset.name},
                        {"source", preset.source},
                        {"protocol", preset.protocol},
                        {"plan", preset.plan}});
        table += format("{}\n    {}\n    {}\n", preset.name, preset.source, numbers_of(preset));
    }
    print(command.json ? list.dump(2) + "\n" : table);
    return kExitYes;
}

}  // namespace chironomia::study
