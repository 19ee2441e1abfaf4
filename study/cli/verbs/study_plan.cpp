// chironomia study plan
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "study/analysis/power.h"
#include "study/build/composition.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/design/balance.h"
#include "study/plan/from_folders.h"
#include "study/plan/presets.h"
#include "study/preregistration/preregistration.h"

namespace chironomia::study {
namespace {

std::string range_of_pages(const std::vector<Sheet>& sheets) {
    const auto shorter = [](const Sheet& a, const Sheet& b) { return a.pages.size() < b.pages.size(); };
    const auto [least, most] = std::minmax_element(sheets.begin(), sheets.end(), shorter);
    if (least->pages.size() == most->pages.size()) return format("{}", least->pages.size());
    return format("{} to {}", least->pages.size(), most->pages.size());
}

const Preset* find_preset(const std::string& name) {
    const auto& all = presets();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Preset& each) { return each.name == name; });
    return found == all.end() ? nullptr : &*found;
}

std::string description_of(const Plan& plan, const Composition& all) {
    std::vector<std::string> questions;
    for (const Question& question : plan.questions) questions.push_back(question.id);
    std::vector<std::string> scales;
    for (const Scale& scale : plan.scales) scales.push_back(scale.id);
    const Json used = plan_as_used(plan);
    std::string text =
        labelled_list("layout", {used.at("layout").get<std::string>()}) +
        labelled_list("conditions", condition_names(plan)) + labelled_list("questions", questions) +
        (scales.empty() ? "" : labelled_list("scales", scales)) +
        labelled_list("clips", {format("{}, and {} for practice", all.judged.size(), all.practice.size())}) +
        labelled_list(
            "pages", {format("{} trials, {} attention checks", all.design.pages.size(), plan.checks.count)}) +
        labelled_list("participants", {plan.participants.wanted ? format("{}", *plan.participants.wanted)
                                                                : std::string("as many as come")}) +
        labelled_list("each sees", {range_of_pages(all.sheets) + " pages with checks"});
    if (const Preset* preset = find_preset(plan.preset)) {
        text += labelled_list("protocol", {preset->name}) + labelled_list("it had", {numbers_of(*preset)});
    }
    return text;
}

ConditionFolder parse_condition_folder(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == text.npos || equals + 1 == text.size())
        throw Error(
            format("\"{}\" is no folder of a condition; write NAME=DIR such as ours=motions/ours", text));
    return {.name = text.substr(0, equals), .folder = text.substr(equals + 1)};
}

// A plan that is made of folders, in place of one that is there.
void add_folders(CLI::App& verb, CLI::Option& plan, StudyPlanCommand& command) {
    const std::string group = "A new plan from folders (docs/plans.md)";
    FoldersJob& folders = command.folders;
    const auto read = [&folders](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) folders.conditions.push_back(parse_condition_folder(text));
    };
    CLI::Option* from = verb.add_option_function<std::vector<std::string>>(
                                "--from-folders",
                                [read](const std::vector<std::string>& texts) {
                                    try {
                                        read(texts);
                                    } catch (const Error& error) {
                                        throw CLI::ValidationError("--from-folders", error.what());
                                    }
                                },
                                "Make a plan: the conditions, each with the folder of its motions")
                            ->type_name("NAME=DIR")
                            ->excludes(&plan);
    CLI::Option* segments =
        verb.add_option("--segments", folders.segments,
                        "Which parts of them are clips: file_name, start_seconds, end_seconds")
            ->type_name("F.csv");
    CLI::Option* preset =
        verb.add_option("--preset", folders.preset, "The protocol, as study presets lists them")
            ->type_name("NAME");
    CLI::Option* audio = verb.add_option("--audio", folders.audio, "Folder of the sounds")->type_name("DIR");
    CLI::Option* partner =
        verb.add_option("--partner", folders.partner, "Folder of the motions of those who are spoken to")
            ->type_name("DIR");
    CLI::Option* partner_audio =
        verb.add_option("--partner-audio", folders.partner_audio, "Folder of their sounds")
            ->type_name("DIR")
            ->needs(partner)
            ->needs(audio);
    CLI::Option* fps =
        verb.add_option("--motion-fps", folders.fps, "Frames per second of motions that carry no rate")
            ->type_name("R")
            ->check(CLI::PositiveNumber);
    CLI::Option* out = verb.add_option("--out", command.out, "The new plan [stdout]")->type_name("PLAN.json");
    from->needs(segments)->needs(preset);
    for (CLI::Option* option : {from, segments, preset, audio, partner, partner_audio, fps, out}) {
        option->group(group);
        if (option != from) option->needs(from);
    }
}

// Prints or writes the plan, and reports what fits nothing.
int make_plan(const StudyPlanCommand& command) {
    FoldersJob job = command.folders;
    const std::filesystem::path out = command.out.value_or("plan.json");
    job.plan_folder = std::filesystem::absolute(out).parent_path();
    const FoldersPlan made = plan_from_folders(job);
    warn(made.notes);
    warn(made.mismatches);
    const std::string summary = format(
        "{} of {} segments are clips; {}\n", made.clips, made.segments,
        made.mismatches.empty() ? "all match" : format("{} things do not match", made.mismatches.size()));
    if (command.out) {
        const std::string written = made.plan.dump(2) + "\n";
        if (std::filesystem::exists(out) && read_text(out) != written) {
            throw Error(
                format("{}: is there already, and is not the plan of these folders; name a new file, or "
                       "remove it",
                       out.string()));
        }
        const Plan plan = read_plan(made.plan, out);
        const Composition all = compose(plan, command.seed);
        write_text(out, written);
        warn(plan_warnings(plan));
        print(format("{}\n{}{}", out.string(), summary, description_of(plan, all)));
    } else {
        print(made.plan.dump(2) + "\n");
        std::fputs(summary.c_str(), stderr);
    }
    return made.mismatches.empty() ? kExitYes : kExitNo;
}

}  // namespace

void add_study_plan(CLI::App& study, std::optional<Command>& result) {
    auto command = std::make_shared<StudyPlanCommand>();
    CLI::App* verb = add_verb(
        study, "plan",
        "Say how balanced a plan is and how many participants it needs, or make one from folders",
        ""
        "  $ chironomia study plan plan.json\n"
        "  $ chironomia study plan plan.json --power --effect 50\n"
        "  $ chironomia study plan plan.json --preregister preregistration.html\n"
        "  $ chironomia study plan --from-folders ours=ours baseline=base --audio wav --segments s.csv "
        "--preset realism-2025 --out plan.json");
    CLI::Option* plan = verb->add_option("plan", command->plan, "The plan")->type_name("PLAN.json");
    add_folders(*verb, *plan, *command);
    add_seed(*verb, command->seed, "Decides sides, orders and the simulation [1]");
    verb->add_flag("--power", command->power, "Simulate answers: how many participants have 80 % power");
    verb->add_option(
            "--preregister", command->preregister,
            "Write a page in the order of OSF's preregistration form; what the plan leaves open is marked")
        ->type_name("OUT.html")
        ->needs(plan);
    verb->add_option("--effect", command->effect,
                     "The difference to find: Elo of preferences, sd of an answer of ratings [the plan's "
                     "smallest_effect, else 100, 0.3]")
        ->type_name("X")
        ->check(CLI::Number);
    verb->add_flag("--json", command->json, "Print the plan with everything filled in instead");
    verb->callback([&result, command] {
        if (command->plan.empty() && command->folders.conditions.empty())
            throw CLI::RequiredError("PLAN.json or --from-folders");
        if (command->effect && !command->power && command->preregister.empty())
            throw CLI::ValidationError("--effect", "is used by --power and --preregister; give one of them");
        result = *command;
    });
}

int run(const StudyPlanCommand& command) {
    if (command.plan.empty()) return make_plan(command);
    const Plan plan = read_plan(command.plan);
    const Composition all = compose(plan, command.seed);
    warn(plan_warnings(plan));
    if (command.json) {
        print(plan_as_used(plan).dump(2) + "\n");
        return kExitYes;
    }
    if (!command.preregister.empty()) {
        const Preregistration made = make_preregistration(plan, command.effect);
        write_text(command.preregister, preregistration_page(made));
        for (const PreregistrationItem& item : made.items) {
            if (!item.missing.empty())
                std::fputs(format("note: {}: {}\n", item.title, item.missing).c_str(), stderr);
        }
    }
    std::string text = description_of(plan, all) + "\n" + balance_table(all.design, condition_names(plan));
    if (command.power) {
        const analysis::PowerDesign design = power_design(plan, all, command.effect, command.seed);
        text += "\n" + to_text(design, plan_power(design));
    }
    print(text);
    return kExitYes;
}

}  // namespace chironomia::study
