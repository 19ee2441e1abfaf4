// chironomia study presets
#include <cstdio>

#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/plan/presets.h"

namespace chironomia {

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
    std::fputs((command.json ? list.dump(2) + "\n" : table).c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
