#include "synth/text/bert_encoder.h"

#include <mutex>
#include <span>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/text.h"
#include "synth/corpus/records.h"
#include "synth/learning.h"
#include "synth/text/word_pieces.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

fs::path weights_in(const fs::path& folder) {
    for (const char* name : {"model.safetensors", "model.pt"})
        if (fs::is_regular_file(folder / name)) return folder / name;
    throw Error(
        format("{}: there is neither model.safetensors nor model.pt; give the folder of BERT-base-uncased, "
               "with its weights and its vocab.txt",
               folder.string()));
}

// One helper at a time, because each holds all weights in memory.
std::mutex& turn_of_helper() {
    static std::mutex turn;
    return turn;
}

// (N, kWordVector) of all words in order.
std::vector<double> rows_of(const Utterances& utterances, const fs::path& weights,
                            const fs::path& vocabulary) {
    const std::lock_guard lock(turn_of_helper());
    const JobFolder folder;
    const Json done = ask_to_learn({{"verb", "encode"},
                                    {"weights", weights.string()},
                                    {"vocabulary", vocabulary.string()},
                                    {"utterances", utterances},
                                    {"out", folder.result().string()},
                                    {"threads", 1}});
    const std::vector<std::byte> bytes = read_bytes(folder.result());
    return Hdf5File(bytes, "the answer of BERT")
        .read_numbers("vectors", {done.at("words").get<std::size_t>(), kWordVector});
}

std::vector<std::vector<float>> vectors_by_bert(const Utterances& utterances, const fs::path& weights,
                                                const fs::path& vocabulary) {
    std::vector<std::vector<float>> vectors;
    if (utterances.empty()) return vectors;
    const std::vector<double> rows = rows_of(utterances, weights, vocabulary);
    auto next = rows.begin();
    for (const std::vector<std::string>& utterance : utterances) {
        const auto end = next + static_cast<std::ptrdiff_t>(utterance.size() * kWordVector);
        vectors.emplace_back(next, end);
        next = end;
    }
    return vectors;
}

}  // namespace

TextEncoder bert_encoder(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    const fs::path weights = weights_in(whole), vocabulary = whole / "vocab.txt";
    return {
        .name = "bert-base-uncased",
        .weights = weights,
        .vectors =
            [weights, vocabulary](const Utterances& utterances) {
                return vectors_by_bert(utterances, weights, vocabulary);
            },
        .token = [pieces = WordPieces(vocabulary)](
                     const std::string& word) { return pieces_of(pieces, std::span(&word, 1)).ids.front(); }};
}

}  // namespace chironomia
