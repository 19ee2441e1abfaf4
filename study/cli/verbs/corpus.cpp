// chironomia corpus make, import and info
#include <cstdio>

#include "core/text.h"
#include "study/cli/verbs/commands.h"
#include "study/corpus/info.h"
#include "synth/text/bert_encoder.h"

namespace chironomia {
namespace {

// "talks/" is the folder talks.
std::filesystem::path without_slash(const std::filesystem::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

void print_made(const CorpusIndex& corpus) {
    double seconds = 0;
    for (const CorpusEntry& entry : corpus.entries) seconds += entry.seconds;
    std::fputs(format("{}\n{} {}, {:.1f} min: {} train, {} validation, {} test, {} unseen\n",
                      corpus.folder.string(), corpus.entries.size(), name_of(corpus.kind), seconds / 60,
                      corpus.of(Split::train).size(), corpus.of(Split::validation).size(),
                      corpus.of(Split::test).size(), corpus.of(Split::unseen).size())
                   .c_str(),
               stdout);
}

}  // namespace

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
    for (const std::string& note : imported.notes) std::fputs((note + "\n").c_str(), stderr);
    print_made(imported.index);
    return kExitYes;
}

int run(const CorpusInfoCommand& command) {
    const Json description = describe_corpus(read_corpus_index(without_slash(command.folder)));
    std::fputs((command.json ? description.dump(2) + "\n" : corpus_text(description)).c_str(), stdout);
    return kExitYes;
}

}  // namespace chironomia
