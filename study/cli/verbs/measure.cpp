// chironomia measure
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/option_values.h"
#include "study/cli/verbs/verbs.h"
#include "study/models/evaluation_baselines.h"
#include "study/models/evaluation_folder.h"
#include "study/models/evaluation_motion.h"
#include "study/models/motion_folder.h"

namespace chironomia::study {

void add_measure(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<MeasureCommand>();
    CLI::App* verb =
        add_verb(app, "measure", "Measure how bodies and faces move, and how near they are to a reference",
                 ""
                 "  $ chironomia measure ours.bvh baseline.bvh --json\n"
                 "  $ chironomia measure predicted.h5 --against recorded.csv --partner listener.csv\n"
                 "  $ chironomia measure styled.bvh --against target.bvh --source talk.bvh\n"
                 "  $ chironomia measure made/ --against recorded/ --audio wav/");
    verb->add_option("motions,--motion", command->motions,
                     "Motion files of any kind that is read, or folders of them")
        ->type_name("M...")
        ->required();
    CLI::Option* against =
        verb->add_option(
                "--against", command->against,
                "The reference motion, for RMSE, PCC, AHR, PCK, L1, Frechet distance ..., or a folder in which "
                "each motion has the one of its name")
            ->type_name("REF");
    verb->add_option("--source", command->source,
                     "The motion whose style was changed to that of --against, for Dist_avg")
        ->type_name("S")
        ->needs(against);
    verb->add_option("--partner", command->partner,
                     "The motion of the partner, for TLCC, DTW, Sync, EL of smiles")
        ->type_name("U");
    verb->add_option(
            "--audio", command->audio,
            "Their sound, or a folder in which each motion has the one of its name, for beat alignment")
        ->type_name("WAV");
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

namespace {

namespace fs = std::filesystem;

// What belongs to each motion by its name: of a file all motions have the same.
using Partners = std::map<std::string, fs::path>;

struct NamedMotion {
    std::string name;  // that pairs it
    fs::path file;
    std::size_t given = 0;  // the path of the command that it came by: a folder for each system
};

std::vector<NamedMotion> motions_of(const MeasureCommand& command) {
    std::vector<NamedMotion> motions;
    for (std::size_t i = 0; i < command.motions.size(); ++i)
        for (const auto& [name, file] : files_by_name(command.motions[i], FolderOf::made))
            motions.push_back({name, file, i});
    return motions;
}

const fs::path& partner_of(const Partners& partners, const fs::path& given, const NamedMotion& motion) {
    if (!is_folder_of_motions(given)) return given;
    const auto found = partners.find(motion.name);
    if (found != partners.end()) return found->second;
    throw Error(format("{}: nothing in {} is called {}; files belong together by their names",
                       motion.file.string(), given.string(), motion.name));
}

// References that nothing in the folder is compared with: systems may have been compared over other files.
std::vector<std::string> without_motion(const Partners& references, const std::vector<NamedMotion>& motions,
                                        std::size_t given) {
    std::vector<std::string> names;
    for (const auto& reference : references) {
        const bool is_paired = std::ranges::any_of(motions, [&](const NamedMotion& motion) {
            return motion.name == reference.first && motion.given == given;
        });
        if (!is_paired) names.push_back(reference.first);
    }
    return names;
}

void warn_of_unpaired(const fs::path& folder, const fs::path& reference,
                      const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 10;
    if (names.empty()) return;
    std::vector<std::string> shown(names.begin(),
                                   names.begin() + static_cast<int>(std::min(names.size(), kShown)));
    if (names.size() > kShown) shown.emplace_back("...");
    warn({format("{}: lacks {} of the files of {}, which do not count: {}", folder.string(), names.size(),
                 reference.string(), join(shown))});
}

void measure_beats_of(const fs::path& sound, const Motion& motion, MotionMeasures& measures) {
    const Audio audio = read_audio(sound);
    try {
        measure_beats(motion, audio, measures);
    } catch (const Error& fault) {
        throw Error(format("{}: {}", sound.string(), fault.what()));
    }
}

// Of each folder the means over its motions, and all their poses together.
std::vector<MotionMeasures> totals_of(const MeasureCommand& command, const std::vector<NamedMotion>& files,
                                      const std::vector<MotionMeasures>& all,
                                      const std::vector<PoseClouds>& clouds) {
    std::vector<MotionMeasures> totals;
    for (std::size_t given = 0; given < command.motions.size(); ++given) {
        const fs::path& folder = command.motions[given];
        if (!is_folder_of_motions(folder)) continue;
        std::vector<MotionMeasures> own;
        for (std::size_t i = 0; i < files.size(); ++i)
            if (files[i].given == given) own.push_back(all[i]);
        totals.push_back(mean_of(folder.string(), own));
        if (auto row = clouds[given].row()) {
            totals.push_back({.source = format("{}: all {} together", folder.string(), own.size())});
            totals.back().near.push_back(std::move(*row));
        }
    }
    return totals;
}

}  // namespace

int run(const MeasureCommand& command) {
    const std::vector<NamedMotion> files = motions_of(command);
    Partners references, sounds;
    if (command.against) references = files_by_name(*command.against, FolderOf::reference);
    if (command.audio) sounds = files_by_name(*command.audio, FolderOf::sounds);
    for (std::size_t given = 0; given < command.motions.size(); ++given) {
        const fs::path& folder = command.motions[given];
        if (command.against && is_folder_of_motions(*command.against) && is_folder_of_motions(folder))
            warn_of_unpaired(folder, *command.against, without_motion(references, files, given));
    }
    std::optional<Motion> source, partner;
    if (command.source) source = read_motion(*command.source, command.hints);
    if (command.partner) partner = read_motion(*command.partner, command.hints);
    std::vector<Motion> motions;
    for (const NamedMotion& each : files) motions.push_back(read_motion(each.file, command.hints));
    std::vector<MotionMeasures> all = measure_motions(motions);
    std::vector<PoseClouds> clouds(command.motions.size());
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const NamedMotion& each = files[i];
        if (command.against) {
            const Motion reference =
                read_motion(partner_of(references, *command.against, each), command.hints);
            measure_against(motions[i], reference, all[i]);
            if (source) measure_style(motions[i], *source, reference, all[i]);
            if (is_folder_of_motions(command.motions[each.given]))
                clouds[each.given].add(motions[i], reference);
        }
        if (partner) measure_pair(motions[i], *partner, all[i]);
        if (command.audio) measure_beats_of(partner_of(sounds, *command.audio, each), motions[i], all[i]);
    }
    const std::vector<MotionMeasures> totals = totals_of(command, files, all, clouds);
    all.insert(all.end(), totals.begin(), totals.end());
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
