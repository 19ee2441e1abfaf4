#include "study/cli/corpus_verbs.h"

#include <memory>

#include "study/cli/option_kinds.h"

namespace chironomia {
namespace {

// What makes the vectors of words.
void add_text_encoder(CLI::App& verb, std::string& name) {
    verb.add_option("--text-encoder", name,
                    "What makes the vectors of words: hashbert, the built-in stand-in for BERT [hashbert]")
        ->type_name("NAME")
        ->check(CLI::IsMember({"hashbert"}));
}

void add_make(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusMakeCommand>();
    CorpusOrder& order = command->order;
    CLI::App* verb = corpus.add_subcommand(
        "make", "Let speakers of known style say sentences and gesture, and keep what trackers would see");
    verb->footer(
        "Examples:\n  chironomia corpus make --kind talks --size ci --out talks\n"
        "  chironomia corpus make --kind dyads --size mini --seed 7 --out dyads");
    add_choice<CorpusKind>(
        *verb, "--kind", order.kind,
        {{"dyads", CorpusKind::dyads}, {"intervals", CorpusKind::intervals}, {"talks", CorpusKind::talks}},
        "talks as TEDx, dyads as NoXi, or intervals as PATS has them")
        ->required();
    add_choice<CorpusSize>(*verb, "--size", order.size,
                           {{"ci", CorpusSize::ci}, {"full", CorpusSize::full}, {"mini", CorpusSize::mini}},
                           "seconds, hours or minutes of work [mini]");
    verb->add_option("--out", order.folder, "A new folder")->type_name("DIR")->required();
    verb->add_option("--seed", order.seed, "Whatever is drawn by chance follows from it [1]")->type_name("N");
    verb->add_flag_callback(
        "--no-noise", [&order] { order.noise = false; },
        "What the engine did, without what trackers add and lose");
    add_text_encoder(*verb, order.text_encoder);
    verb->add_option("--threads", order.threads, "At most so many at once; the bytes stay the same [all]")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
    verb->add_flag("--quiet", order.quiet, "No progress on stderr");
    verb->callback([&result, command] { result = *command; });
}

void add_import(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusImportCommand>();
    ImportJob& job = command->job;
    CLI::App* verb =
        corpus.add_subcommand("import", "Make a corpus of recordings: OpenFace, sound or openSMILE, words");
    verb->footer(
        "Examples:\n  chironomia corpus import recordings.json --out talks\n"
        "  chironomia corpus import noxi.json --seed 7 --out dyads");
    verb->add_option("manifest", job.manifest, "Which files belong to whom, JSON (docs/corpora.md)")
        ->type_name("JSON")
        ->required();
    verb->add_option("--out", job.out, "A new folder")->type_name("DIR")->required();
    verb->add_option("--seed", job.seed, "Of the splits, where the manifest tells none [1]")->type_name("N");
    add_text_encoder(*verb, job.text_encoder);
    verb->add_flag("--quiet", job.quiet, "No progress on stderr");
    verb->callback([&result, command] { result = *command; });
}

void add_info(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusInfoCommand>();
    CLI::App* verb =
        corpus.add_subcommand("info", "Read all of a corpus and say what it holds and how its speakers are");
    verb->footer("Examples:\n  chironomia corpus info talks\n  chironomia corpus info pats --json");
    verb->add_option("corpus", command->folder, "Folder of the corpus, or of PATS")
        ->type_name("DIR")
        ->required();
    verb->add_flag("--json", command->json, "For programs");
    verb->callback([&result, command] { result = *command; });
}

}  // namespace

void add_corpus(CLI::App& app, std::optional<Command>& result) {
    CLI::App* corpus = app.add_subcommand("corpus", "Make, import and describe what models learn from");
    corpus->require_subcommand(1);
    add_make(*corpus, result);
    add_import(*corpus, result);
    add_info(*corpus, result);
}

}  // namespace chironomia
