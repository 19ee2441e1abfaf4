// chironomia compare
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <memory>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/text.h"
#include "raster/images/compare_sets.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/html/compare_page.h"
#include "study/html/junit.h"

namespace chironomia::study {
namespace {

// How much two frames may differ.
void add_limits(CLI::App& verb, CompareOptions& options) {
    CompareLimits& limits = options.limits;
    verb.add_option("--step", limits.large_step, "No colour may differ by more, of 255 [3]")
        ->type_name("N")
        ->check(CLI::Range(0, 255));
    verb.add_option("--small-step", limits.small_step, "Pixels that differ by more are counted, of 255 [1]")
        ->type_name("N")
        ->check(CLI::Range(0, 255));
    verb.add_option("--share", limits.share_above_small, "Share of the pixels that may be counted [0.0002]")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0));
    verb.add_option(
            "--perceptual", options.seen_share,
            "Pass a frame beyond these limits if a viewer sees at most this share of its pixels differ")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1.0));
}

// JSON has no infinity: equal frames have no PSNR there.
Json or_null(double psnr) {
    return std::isinf(psnr) ? Json() : Json(psnr);
}

Json to_json(const CompareCase& one) {
    Json json;
    json["name"] = one.name;
    json["outcome"] = to_text(one.outcome);
    json["within_limits"] = one.outcome == CaseOutcome::same;
    if (!one.message.empty()) json["message"] = one.message;
    if (const auto& frame = one.frame) {
        json["mean_error"] = frame->mean_error;
        json["rms_error"] = frame->rms_error;
        json["psnr_db"] = or_null(frame->psnr);
        json["max_error"] = frame->max_error;
        json["max_at"] = {frame->max_x, frame->max_y};
        json["pixels"] = frame->pixels;
        json["pixels_above_small"] = frame->pixels_above_small;
        json["pixels_above_large"] = frame->pixels_above_large;
        if (frame->visible_differences) json["pixels_seen"] = *frame->visible_differences;
    }
    if (!one.difference.empty()) json["difference"] = one.difference.string();
    return json;
}

Json to_json(const CompareSet& set) {
    Json json;
    json["within_limits"] = set.all_same();
    for (const CaseOutcome outcome : {CaseOutcome::same, CaseOutcome::different, CaseOutcome::missing,
                                      CaseOutcome::extra, CaseOutcome::unreadable})
        json[to_text(outcome)] = set.count(outcome);
    json["frames"] = json["others"] = json["difference_images"] = Json::array();
    for (const CompareCase& one : set.cases) {
        json[one.frame ? "frames" : "others"].push_back(to_json(one));
        if (!one.difference.empty()) json["difference_images"].push_back(one.difference.string());
    }
    return json;
}

const CompareCase* worst_of(const CompareSet& set) {
    const CompareCase* worst = nullptr;
    for (const CompareCase& one : set.cases) {
        if (one.frame && one.frame->rms_error > (worst ? worst->frame->rms_error : 0)) worst = &one;
    }
    return worst;
}

// What is not the same, at most a screenful, then the verdict.
std::string to_text(const CompareSet& set) {
    constexpr std::size_t kMostRows = 20;
    std::string text;
    std::size_t rows = 0, frames = 0, same_frames = 0, others = 0;  // others: sounds and forms that differ
    for (const CompareCase& one : set.cases) {
        frames += one.frame ? 1 : 0;
        same_frames += one.frame && one.outcome == CaseOutcome::same ? 1 : 0;
        others += !one.frame && one.outcome == CaseOutcome::different ? 1 : 0;
        if (one.outcome == CaseOutcome::same || ++rows > kMostRows) continue;
        text += format("{}: {}: {}\n", to_text(one.outcome), one.name, one.message);
        if (!one.difference.empty()) text += format("    {}\n", one.difference.string());
    }
    if (rows > kMostRows) text += format("... and {} more\n", rows - kMostRows);
    text += format("{}: {} of {} frames within the limits", set.all_same() ? "the same" : "different",
                   same_frames, frames);
    if (others > 0) text += format(", {} of another form or sound", others);
    for (const CaseOutcome outcome : {CaseOutcome::missing, CaseOutcome::extra, CaseOutcome::unreadable}) {
        if (const std::size_t count = set.count(outcome)) text += format(", {} {}", count, to_text(outcome));
    }
    const CompareCase* worst = worst_of(set);
    return text + (worst ? format("; the worst is {}\n", worst->name) : "\n");
}

// What cannot be read is wrong input, and says so where messages go.
int exit_code_of(const CompareSet& set) {
    for (const CompareCase& one : set.cases) {
        if (one.outcome == CaseOutcome::unreadable)
            std::fputs(format("chironomia: {}\n", one.message).c_str(), stderr);
    }
    if (set.count(CaseOutcome::unreadable) > 0) return kExitWrongInput;
    return set.all_same() ? kExitYes : kExitNo;
}

int update(const CompareCommand& command) {
    const SetUpdate update = update_references(command.a, command.b);
    if (command.json) {
        const Json json = {{"changed", update.changed},
                           {"added", update.added},
                           {"removed", update.removed},
                           {"kept", update.kept}};
        print(json.dump(2) + "\n");
    } else {
        print(format("{}: {} changed, {} added, {} removed, {} kept\n", command.a.string(), update.changed,
                     update.added, update.removed, update.kept));
    }
    return kExitYes;
}

}  // namespace

void add_compare(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<CompareCommand>();
    CLI::App* verb = add_verb(
        app, "compare", "Compare frames, stacks, clips or folders of them; exit 1 if they differ",
        "  $ chironomia compare expected.png actual.png\n"
        "  $ chironomia compare references/ results/ --diff differences --junit r.xml --html r.html\n"
        "  $ chironomia compare references/ results/ --update");
    verb->add_option("a", command->a, "What is expected: a frame, a clip, or a folder of them")
        ->type_name("A")
        ->required();
    verb->add_option("b", command->b, "What is compared with it")->type_name("B")->required();
    SetOptions& options = command->options;
    add_limits(*verb, options.compare);
    const std::vector<CLI::Option*> reports = {
        verb->add_option("--diff", options.difference_folder, "Write pictures of the differences here")
            ->type_name("DIR"),
        verb->add_option("--junit", command->junit, "Write JUnit XML, a case for each frame")
            ->type_name("F.xml"),
        verb->add_option("--html", command->html, "Write one page that shows what differs, side by side")
            ->type_name("F.html")};
    CLI::Option* shard = add_shard(
        *verb, [&options](const Shard& part) { options.shard = part; },
        "Only one part of the files of two folders, such as 2/8: the second of eight [all]");
    CLI::Option* update = verb->add_flag("--update", command->update, "Make B the new reference A instead");
    for (CLI::Option* report : reports) report->excludes(update);
    shard->excludes(update);
    verb->add_flag("--json", command->json, "Print JSON");
    verb->add_flag("--quiet", options.quiet, "No progress");
    verb->callback([&result, command] { result = *command; });
}

int run(const CompareCommand& command) {
    if (command.update) return update(command);
    SetOptions options = command.options;
    if (command.html) options.most_pictures = kMostPagePictures;
    const CompareSet set = compare_sets(command.a, command.b, options);
    if (command.junit) write_text(*command.junit, make_junit(command.a.string(), set));
    if (command.html)
        write_text(*command.html, make_compare_page(command.a.string(), command.b.string(), set));
    print(command.json ? to_json(set).dump(2) + "\n" : to_text(set));
    return exit_code_of(set);
}

}  // namespace chironomia::study
