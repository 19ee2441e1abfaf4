// chironomia measure
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/option_values.h"
#include "study/cli/verbs/verbs.h"
#include "study/models/evaluation_baselines.h"
#include "study/models/evaluation_motion.h"

namespace chironomia::study {

void add_measure(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<MeasureCommand>();
    CLI::App* verb =
        add_verb(app, "measure", "Measure how bodies and faces move, and how near they are to a reference",
                 ""
                 "  $ chironomia measure ours.bvh baseline.bvh --json\n"
                 "  $ chironomia measure predicted.h5 --against recorded.csv --partner listener.csv\n"
                 "  $ chironomia measure styled.bvh --against target.bvh --source talk.bvh");
    verb->add_option("motions,--motion", command->motions, "Motion files of any kind that is read")
        ->type_name("M...")
        ->required();
    CLI::Option* against =
        verb->add_option("--against", command->against,
                         "The reference motion, for RMSE, PCC, AHR, PCK, L1, Frechet distance ...")
            ->type_name("REF");
    verb->add_option("--source", command->source,
                     "The motion whose style was changed to that of --against, for Dist_avg")
        ->type_name("S")
        ->needs(against);
    verb->add_option("--partner", command->partner,
                     "The motion of the partner, for TLCC, DTW, Sync, EL of smiles")
        ->type_name("U");
    add_read_option(
        *verb, "--motion-fps",
        [command](const std::string& text) {
            command->hints.fps = parse_motion_rate(text);
            command->hints.fps_where_missing = true;
        },
        "Frames per second of motions that do not carry a rate")
        ->type_name("R");
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] { result = *command; });
}

int run(const MeasureCommand& command) {
    std::optional<Motion> reference, source, partner;
    if (command.against) reference = read_motion(*command.against, command.hints);
    if (command.source) source = read_motion(*command.source, command.hints);
    if (command.partner) partner = read_motion(*command.partner, command.hints);
    std::vector<Motion> motions;
    for (const std::filesystem::path& file : command.motions)
        motions.push_back(read_motion(file, command.hints));
    std::vector<MotionMeasures> all = measure_motions(motions);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        if (reference) measure_against(motions[i], *reference, all[i]);
        if (source) measure_style(motions[i], *source, *reference, all[i]);
        if (partner) measure_pair(motions[i], *partner, all[i]);
    }
    Json json = Json::array();
    for (const MotionMeasures& measures : all) {
        json.push_back(to_json(measures));
        warn(measures.notes);
    }
    std::string text;
    for (const analysis::Table& table : tables_of(all))
        text += format("{}\n{}\n", table.title, to_text(table));
    print(command.json ? json.dump(2) + "\n" : text);
    return kExitYes;
}

}  // namespace chironomia::study
