// chironomia corpus make, import and info
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "core/text.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/verbs/verbs.h"
#include "study/corpus/info.h"
#include "synth/text/bert_encoder.h"

namespace chironomia::study {
namespace {

void add_bert(CLI::App& verb, std::optional<std::filesystem::path>& folder) {
    verb.add_option(
            "--bert", folder,
            "Vectors of words by BERT-base-uncased, whose weights (model.safetensors or model.pt) and "
            "vocab.txt lie in DIR [hashbert, the built-in encoder]")
        ->type_name("DIR");
}

// "talks/" is the folder talks.
std::filesystem::path without_slash(const std::filesystem::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

void print_made(const CorpusIndex& corpus) {
    double seconds = 0;
    for (const CorpusEntry& entry : corpus.entries) seconds += entry.seconds;
    print(format("{}\n{} {}, {:.1f} min: {} train, {} validation, {} test, {} unseen\n",
                 corpus.folder.string(), corpus.entries.size(), name_of(corpus.kind), seconds / 60,
                 corpus.of(Split::train).size(), corpus.of(Split::validation).size(),
                 corpus.of(Split::test).size(), corpus.of(Split::unseen).size()));
}

}  // namespace

void add_corpus_make(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusMakeCommand>();
    CorpusOrder& order = command->order;
    CLI::App* verb = add_verb(
        corpus, "make",
        "Make a corpus by the expressive engine: speakers of known style, as trackers would see them",
        "  $ chironomia corpus make --kind talks --size ci --out talks\n"
        "  $ chironomia corpus make --kind dyads --size mini --seed 7 --out dyads");
    add_choice<CorpusKind>(
        *verb, "--kind", order.kind,
        {{"dyads", CorpusKind::dyads}, {"intervals", CorpusKind::intervals}, {"talks", CorpusKind::talks}})
        ->description("talks as TEDx, dyads as NoXi, or intervals as PATS has them")
        ->required();
    add_choice<CorpusSize>(*verb, "--size", order.size,
                           {{"ci", CorpusSize::ci}, {"full", CorpusSize::full}, {"mini", CorpusSize::mini}})
        ->description("ci takes seconds, mini minutes, full hours [mini]");
    verb->add_option("--out", order.folder, "A new folder")->type_name("DIR")->required();
    add_seed(*verb, order.seed, "Random seed [1]");
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

void add_corpus_import(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusImportCommand>();
    ImportJob& job = command->job;
    CLI::App* verb = add_verb(corpus, "import",
                              "Make a corpus of recordings: OpenFace or OpenPose, sound or openSMILE, words",
                              "  $ chironomia corpus import recordings.json --out talks\n"
                              "  $ chironomia corpus import noxi.json --seed 7 --out dyads");
    verb->add_option("manifest", job.manifest, "Which files belong to whom, JSON (docs/corpora.md)")
        ->type_name("JSON")
        ->required();
    verb->add_option("--out", job.out, "A new folder")->type_name("DIR")->required();
    add_seed(*verb, job.seed, "Random seed of the splits, if the manifest gives none [1]");
    add_bert(*verb, command->bert);
    verb->add_flag("--quiet", job.quiet, "No progress on stderr");
    verb->callback([&result, command] { result = *command; });
}

void add_corpus_info(CLI::App& corpus, std::optional<Command>& result) {
    auto command = std::make_shared<CorpusInfoCommand>();
    CLI::App* verb = add_verb(corpus, "info", "Read all of a corpus, and describe it and its speakers",
                              "  $ chironomia corpus info talks\n  $ chironomia corpus info pats --json");
    verb->add_option("corpus", command->folder, "Folder of the corpus, or of PATS")
        ->type_name("DIR")
        ->required();
    verb->add_flag("--json", command->json, "For programs");
    verb->callback([&result, command] { result = *command; });
}

int run(const CorpusMakeCommand& command) {
    CorpusOrder order = command.order;
    order.folder = without_slash(order.folder);
    if (command.bert) order.encoder = bert_encoder(*command.bert);
    const CorpusIndex corpus = make_corpus(order);
    print_made(corpus);
    return kExitYes;
}

int run(const CorpusImportCommand& command) {
    ImportJob job = command.job;
    job.out = without_slash(job.out);
    if (command.bert) job.encoder = bert_encoder(*command.bert);
    const Imported imported = import_corpus(job);
    warn(imported.notes);
    print_made(imported.index);
    return kExitYes;
}

int run(const CorpusInfoCommand& command) {
    const Json description = describe_corpus(read_corpus_index(without_slash(command.folder)));
    print(command.json ? description.dump(2) + "\n" : corpus_text(description));
    return kExitYes;
}

}  // namespace chironomia::study
