#include "synth/corpus/pats_words.h"

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "synth/corpus/csv_rows.h"

namespace chironomia {
namespace {

std::vector<CorpusWord> words_of_table(const std::filesystem::path& path) {
    std::vector<CorpusWord> words;
    const CsvRows table(path, {"word", "start_frame", "end_frame"});
    for (std::size_t row = 0; row < table.size(); ++row) {
        words.push_back({.text = table.at(row, "word"),
                         .start = table.number(row, "start_frame") / IntervalRecord::kFps,
                         .end = table.number(row, "end_frame") / IntervalRecord::kFps});
    }
    return words;
}

std::vector<CorpusWord> words_of_tokens(const std::vector<int>& tokens) {
    std::vector<CorpusWord> words;
    for (std::size_t t = 0; t < tokens.size(); ++t) {
        const double at = static_cast<double>(t) / IntervalRecord::kFps;
        if (t == 0 || tokens[t] != tokens[t - 1])
            words.push_back({.text = format("#{}", tokens[t]), .start = at});
        words.back().end = at + 1 / IntervalRecord::kFps;
    }
    return words;
}

}  // namespace

std::vector<CorpusWord> pats_words(const RecordFile& file, const std::filesystem::path& path,
                                   const std::vector<int>& tokens) {
    if (file.has("text/words")) return file.words("text/words", "text/word_times");
    std::filesystem::path table = path;
    table.replace_extension(".words.csv");
    if (std::filesystem::exists(table)) return words_of_table(table);
    return words_of_tokens(tokens);
}

}  // namespace chironomia
