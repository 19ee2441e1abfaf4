// chironomia measure
#include <cstdio>

#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/models/evaluation_motion.h"

namespace chironomia {

int run(const MeasureCommand& command) {
    std::optional<Motion> reference, partner;
    if (command.against) reference = read_motion(*command.against, command.hints);
    if (command.partner) partner = read_motion(*command.partner, command.hints);
    std::vector<MotionMeasures> all;
    for (const std::filesystem::path& file : command.motions) {
        const Motion motion = read_motion(file, command.hints);
        all.push_back(measure_motion(motion));
        if (reference) measure_against(motion, *reference, all.back());
        if (partner) measure_pair(motion, *partner, all.back());
    }
    Json json = Json::array();
    for (const MotionMeasures& measures : all) {
        json.push_back(to_json(measures));
        for (const std::string& note : measures.notes) std::fputs((note + "\n").c_str(), stderr);
    }
    std::string text;
    for (const Table& table : tables_of(all)) text += format("{}\n{}\n", table.title, to_text(table));
    std::fputs((command.json ? json.dump(2) + "\n" : text).c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
