#include "study/cli/command_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "core/text.h"
#include "core/version.h"
#include "raster/embree/ray_renderer.h"
#include "raster/ffmpeg/clip_writer.h"
#include "raster/gl/gl_renderer.h"
#include "study/cli/verbs/verbs.h"

namespace chironomia::study {
namespace {

// A verb that has verbs of its own.
struct VerbGroup {
    const char* name;
    const char* what;
    const char* examples;
};
constexpr VerbGroup kCorpus = {"corpus", "Make, import and describe what models learn from", ""};
constexpr VerbGroup kStudy = {"study", "Build, check, run, rehearse and analyse blinded studies",
                              "Examples:\n"
                              "  $ chironomia study build plan.json --out study --seed 1\n"
                              "  $ chironomia study check study\n"
                              "  $ chironomia study serve study"};

// All verbs in the order of the help.
struct Verb {
    void (*add)(CLI::App& app, std::optional<Command>& result);
    const VerbGroup* group = nullptr;
};
constexpr Verb kVerbs[] = {
    {add_demo},
    {add_synth},
    {add_corpus_make, &kCorpus},
    {add_corpus_import, &kCorpus},
    {add_corpus_info, &kCorpus},
    {add_render},
    {add_convert},
    {add_measure},
    {add_fit},
    {add_compare},
    {add_info},
    {add_bench},
    {add_study_build, &kStudy},
    {add_study_check, &kStudy},
    {add_study_serve, &kStudy},
    {add_study_answers, &kStudy},
    {add_study_forget, &kStudy},
    {add_study_pack, &kStudy},
    {add_study_presets, &kStudy},
    {add_study_export, &kStudy},
    {add_study_plan, &kStudy},
    {add_study_analyse, &kStudy},
    {add_study_rehearse, &kStudy},
    {add_train},
    {add_evaluate},
};

CLI::App& home_of(const Verb& verb, CLI::App& app) {
    if (!verb.group) return app;
    const auto is_it = [&](const CLI::App* other) { return other->get_name() == verb.group->name; };
    for (CLI::App* there : app.get_subcommands(is_it)) return *there;
    CLI::App* group = app.add_subcommand(verb.group->name, verb.group->what);
    group->footer(verb.group->examples);
    group->require_subcommand(1);
    return *group;
}

// CLI11 would only say that a subcommand is required.
std::optional<std::string> unknown_verb(const CLI::App& app, int argc, const char* const* argv) {
    if (argc < 2 || std::string_view(argv[1]).starts_with('-')) return std::nullopt;
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    if (std::find(verbs.begin(), verbs.end(), argv[1]) != verbs.end()) return std::nullopt;
    const auto meant = nearest_name(argv[1], verbs);
    return format("\"{}\" is no verb{}; the verbs are {}", argv[1],
                  meant ? format(" (did you mean {}?)", *meant) : "", join(verbs));
}

// The option of `names` that somebody meant who wrote `typo`: one with a letter or two of difference, a longer or a
// shorter form ("--output", "--o"), or the only one that begins with a single letter ("-o").
std::optional<std::string> option_meant(const std::string& typo, const std::vector<std::string>& names) {
    if (const auto near = nearest_name(typo, names)) return near;
    const std::string_view bare = std::string_view(typo).substr(typo.find_first_not_of('-'));
    const auto is_form = [&](std::string_view name) {
        return name.substr(2).starts_with(bare) || bare.starts_with(name.substr(2));
    };
    const auto found = std::ranges::find_if(names, is_form);
    if (found == names.end() || std::any_of(found + 1, names.end(), is_form)) return std::nullopt;
    return *found;
}

// CLI11 complains of what is missing before it says what it does not know.
std::optional<std::string> unknown_option(const CLI::App& app, int argc, const char* const* argv) {
    const CLI::App* verb = &app;
    int first = 1;
    for (; first < argc; ++first) {
        const auto named =
            verb->get_subcommands([&](const CLI::App* it) { return it->get_name() == argv[first]; });
        if (named.empty()) break;
        verb = named.front();
    }
    bool is_value = false;
    for (int i = first; i < argc && argv[i] != std::string_view("--"); ++i) {
        const std::string_view word = argv[i];
        const std::string name(word.substr(0, word.find('=')));
        const bool is_option = !is_value && word.size() > 1 && word[0] == '-' && word[1] != '=' &&
                               (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
        is_value = false;
        if (!is_option) continue;
        if (const CLI::Option* option = verb->get_option_no_throw(name)) {
            is_value = name == word && option->get_items_expected_min() > 0;
            continue;
        }
        std::vector<std::string> names;
        for (const CLI::Option* option : verb->get_options()) {
            for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
        }
        const auto meant = option_meant(name, names);
        return format("there is no option {}{}", name, meant ? format("; did you mean {}?", *meant) : "");
    }
    return std::nullopt;
}

// "nan" is neither below nor above a bound, so that the ranges of CLI11 let it pass.
void refuse_nan(CLI::App& app) {
    const auto fault_of = [](const std::string& text) {
        const bool is_number = std::isfinite(std::strtod(text.c_str(), nullptr));
        return is_number ? "" : format("{} is no finite number", text);
    };
    for (CLI::App* verb : app.get_subcommands({})) {
        refuse_nan(*verb);
        for (CLI::Option* option : verb->get_options()) {
            const std::string type = option->get_type_name();
            if (std::ranges::any_of(std::array{":FLOAT in", ":POSITIVE", ":NUMBER"},
                                    [&](const char* kind) { return type.find(kind) != type.npos; }))
                option->check(fault_of);
        }
    }
}

// In place of "At Most 1 required but received 2".
std::string in_plain_words(std::string complaint) {
    const std::size_t at = complaint.find(": At Most 1 required but received ");
    if (at != complaint.npos)
        complaint.replace(at, complaint.find('\n', at) - at, " is given more than once; give it once");
    return complaint;
}

// The program, and what it finds on this machine.
std::string describe_program() {
    const std::string_view torch = torch_version();
    std::string text = format(
        "chironomia {}\nOSMesa  {}\nEGL     {}\nEmbree  {}\nFFmpeg  {}\nTorch   {}\nBuilt with",
        program_version(), describe_gl(GlBackend::osmesa), describe_gl(GlBackend::egl), embree_version(),
        ffmpeg_version(), torch.empty() ? "none: built with CHIRONOMIA_LEARNING=OFF" : torch);
    for (const std::string_view library : split(library_versions(), ','))
        text += format("\n  {}", trim(library));
    return text;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
    CLI::App app(
        "Evaluation videos of synthesized gestures: offline, headless, blinded, the same bytes every time.",
        "chironomia");
    app.footer("Each verb has its own --help with examples.");
    app.set_version_flag("--version", describe_program);
    app.require_subcommand(1);
    std::optional<Command> result;
    for (const Verb& verb : kVerbs) verb.add(home_of(verb, app), result);
    refuse_nan(app);
    if (argc < 2) return {.command = {}, .text = app.help(), .exit_code = kExitWrongCommandLine};
    auto typo = unknown_verb(app, argc, argv);
    if (!typo) typo = unknown_option(app, argc, argv);
    if (typo) {
        return {.command = {},
                .text = *typo + "\nRun with --help for more information.\n",
                .exit_code = kExitWrongCommandLine};
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        std::ostringstream said, complained;
        const int code = app.exit(problem, said, complained);
        return {.command = {},
                .text = said.str() + in_plain_words(complained.str()),
                .exit_code = code == 0 ? kExitYes : kExitWrongCommandLine};
    }
    return {.command = std::move(result), .text = {}, .exit_code = kExitYes};
}

}  // namespace chironomia::study
