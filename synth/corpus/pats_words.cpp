#include "synth/corpus/pats_words.h"

#include "core/csv_table.h"
#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "synth/corpus/pats_table.h"

namespace chironomia {
namespace {

std::vector<CorpusWord> words_of_table(const std::filesystem::path& path) {
    std::vector<CorpusWord> words;
    const PatsTable table(path, {"word", "start_frame", "end_frame"});
    for (const CsvRow& row : table.rows()) {
        words.push_back({.text = table.text(row, 0),
                         .start = table.number(row, 1) / IntervalRecord::kFps,
                         .end = table.number(row, 2) / IntervalRecord::kFps});
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
