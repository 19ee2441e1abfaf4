#include "study/cli/corpus_verbs.h"

#include <memory>

#include "study/cli/option_kinds.h"

namespace chironomia {
namespace {

void add_bert(CLI::App& verb, std::optional<std::filesystem::path>& folder) {
    verb.add_option(
            "--bert", folder,
            "Vectors of words by BERT-base-uncased, whose weights (model.safetensors or model.pt) and "
            "vocab.txt lie in DIR [hashbert, the built-in stand-in]")
        ->type_name("DIR");
}

void add_make(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusMakeCommand>();
    CorpusOrder& order = command->order;
    CLI::App* verb = corpus.add_subcommand(
        "make", "Let speakers of known style say sentences and gesture, and keep what trackers would see");
    verb->footer(
        "Examples:\n  $ chironomia corpus make --kind talks --size ci --out talks\n"
        "  $ chironomia corpus make --kind dyads --size mini --seed 7 --out dyads");
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
    add_bert(*verb, command->bert);
    const CLI::Option* speakers =
        add_read_option(
            *verb, "--speakers",
            [&order](const std::string& text) { order.speakers = speaker_choice_of(text); },
            "Of talks and intervals: how many in training + unseen (6+2), or names out of those of the "
            "size [as many as the size has]")
            ->type_name("N|N+M|NAMES");
    const CLI::Option* tables = verb->add_flag(
        "--tables", order.tables,
        "Of talks and dyads: also the tables of OpenFace and openSMILE, words and sounds that corpus "
        "import reads");
    verb->add_option("--threads", order.threads, "At most so many at once; the bytes stay the same [all]")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
    verb->add_flag("--quiet", order.quiet, "No progress on stderr");
    verb->callback([&result, command, speakers, tables] {
        const CorpusKind kind = command->order.kind;
        if (*speakers && kind == CorpusKind::dyads)
            throw CLI::ValidationError(
                "--speakers", "is of talks and intervals; who meets whom in dyads comes with --size");
        if (*tables && kind == CorpusKind::intervals)
            throw CLI::ValidationError(
                "--tables", "is of talks and dyads; intervals are PATS's own files, which need no import");
        result = *command;
    });
}

void add_import(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusImportCommand>();
    ImportJob& job = command->job;
    CLI::App* verb =
        corpus.add_subcommand("import", "Make a corpus of recordings: OpenFace, sound or openSMILE, words");
    verb->footer(
        "Examples:\n  $ chironomia corpus import recordings.json --out talks\n"
        "  $ chironomia corpus import noxi.json --seed 7 --out dyads");
    verb->add_option("manifest", job.manifest, "Which files belong to whom, JSON (docs/corpora.md)")
        ->type_name("JSON")
        ->required();
    verb->add_option("--out", job.out, "A new folder")->type_name("DIR")->required();
    verb->add_option("--seed", job.seed, "Of the splits, if the manifest gives none [1]")->type_name("N");
    add_bert(*verb, command->bert);
    verb->add_flag("--quiet", job.quiet, "No progress on stderr");
    verb->callback([&result, command] { result = *command; });
}

void add_corpus_info(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusInfoCommand>();
    CLI::App* verb =
        corpus.add_subcommand("info", "Read all of a corpus and say what it holds and how its speakers are");
    verb->footer("Examples:\n  $ chironomia corpus info talks\n  $ chironomia corpus info pats --json");
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
    add_corpus_info(*corpus, result);
}

}  // namespace chironomia
