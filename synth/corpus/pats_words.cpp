#include "synth/corpus/pats_words.h"

#include <algorithm>

#include "core/files/csv_table.h"
#include "core/text.h"
#include "synth/corpus/pats_table.h"
#include "synth/corpus/pickled_texts.h"

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

// A table of pandas keeps the columns of one type together: block0_items are their names, block0_values their
// rows. Texts are pickled.
class PandasTable {
  public:
    explicit PandasTable(const RecordFile& file) : file_(file.hdf5()) {
        for (const std::string& name : file_.names_in(kGroup)) {
            if (name.starts_with("block") && name.ends_with("_items"))
                blocks_.push_back(name.substr(0, name.size() - std::string_view("_items").size()));
        }
    }

    std::vector<double> numbers(const std::string& column) const {
        const auto [block, place, width] = find(column);
        const std::vector<double> rows = file_.read_numbers(path(block, "values"), {Hdf5File::kAny, width});
        std::vector<double> values;
        for (std::size_t i = place; i < rows.size(); i += width) values.push_back(rows[i]);
        return values;
    }

    std::vector<std::string> texts(const std::string& column) const {
        const auto [block, place, width] = find(column);
        const std::vector<std::string> pickles = file_.read_texts(path(block, "values"));
        const auto cells = pickled_texts(pickles.empty() ? "" : pickles.front());
        if (!cells) {
            file_.refuse(format("/{} is no pickled list of texts; write <id>.words.csv beside the file",
                                path(block, "values")));
        }
        std::vector<std::string> values;
        for (std::size_t i = place; i < cells->size(); i += width) values.push_back((*cells)[i]);
        return values;
    }

  private:
    static constexpr const char* kGroup = "text/meta";

    struct Column {
        std::string block;
        std::size_t place = 0;  // among the block's columns
        std::size_t width = 1;  // how many these are
    };

    static std::string path(const std::string& block, std::string_view part) {
        return format("{}/{}_{}", kGroup, block, part);
    }

    Column find(const std::string& column) const {
        for (const std::string& block : blocks_) {
            const std::vector<std::string> items = file_.read_texts(path(block, "items"));
            const auto found = std::find(items.begin(), items.end(), column);
            if (found != items.end())
                return {block, static_cast<std::size_t>(found - items.begin()), items.size()};
        }
        file_.refuse(format("/{} has no column {}", kGroup, column));
    }

    const Hdf5File& file_;
    std::vector<std::string> blocks_;
};

std::vector<CorpusWord> words_of_pandas(const RecordFile& file) {
    const PandasTable table(file);
    const std::vector<std::string> texts = table.texts("Word");
    const std::vector<double> starts = table.numbers("start_frame"), ends = table.numbers("end_frame");
    if (starts.size() != texts.size() || ends.size() != texts.size()) {
        file.hdf5().refuse(format("/text/meta has {} words, {} starts and {} ends", texts.size(),
                                  starts.size(), ends.size()));
    }
    std::vector<CorpusWord> words;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        words.push_back({.text = texts[i],
                         .start = starts[i] / IntervalRecord::kFps,
                         .end = ends[i] / IntervalRecord::kFps});
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
    if (file.has("text/meta")) return words_of_pandas(file);
    std::filesystem::path table = path;
    table.replace_extension(".words.csv");
    if (std::filesystem::exists(table)) return words_of_table(table);
    return words_of_tokens(tokens);
}

}  // namespace chironomia
