#include "synth/text/word_pieces.h"

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "core/utf8.h"
#include "synth/markup/letters.h"
#include "synth/text/stable_hash.h"

namespace chironomia {
namespace {

constexpr std::size_t kLongestWord = 100;  // that is cut into pieces [characters]
constexpr int kFirstHashed = 1000, kBertPieces = 30522;

// What stands between white space and punctuation, in bare letters; punctuation and Chinese characters each
// on their own.
std::vector<std::u32string> basic_words(std::string_view text) {
    std::vector<std::u32string> words(1);
    for (const char32_t character : bare_letters(text)) {
        if (is_unprintable(character)) continue;
        const bool is_alone = is_punctuation(character) || is_cjk(character);
        const bool is_apart = is_alone || is_blank(character);
        if (is_apart && !words.back().empty()) words.emplace_back();
        if (!is_blank(character)) words.back() += character;
        if (is_alone) words.emplace_back();
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

}  // namespace

WordPieces::WordPieces(const std::filesystem::path& vocabulary)
    : WordPieces(read_text(vocabulary), vocabulary.string()) {}

WordPieces::WordPieces(std::string_view vocabulary, const std::string& where) {
    if (const auto fault = fault_in_utf8(vocabulary))
        throw Error(format("{}: byte {} is not UTF-8; use the vocab.txt of the model", where, *fault));
    if (vocabulary.ends_with('\n')) vocabulary.remove_suffix(1);
    for (std::string_view line : split(vocabulary, '\n')) {
        if (line.ends_with('\r')) line.remove_suffix(1);
        const auto number = static_cast<int>(ids_.size());
        const auto [known, is_new] = ids_.emplace(line, number);
        if (!is_new) {
            throw Error(format("{}:{}: \"{}\" is on line {} too; every piece stands on one line", where,
                               number + 1, line, known->second + 1));
        }
    }
    pad_ = required("[PAD]", where);
    unknown_ = required("[UNK]", where);
    begin_ = required("[CLS]", where);
    end_ = required("[SEP]", where);
}

int WordPieces::required(std::string_view piece, const std::string& where) const {
    const auto found = ids_.find(std::string(piece));
    if (found != ids_.end()) return found->second;
    throw Error(format("{}: {} is missing among {} pieces; use the vocab.txt of the model", where, piece,
                       ids_.size()));
}

std::vector<int> WordPieces::ids_of(std::string_view text) const {
    std::vector<int> ids;
    for (const std::u32string& word : basic_words(text)) append_pieces(word, ids);
    return ids;
}

// The longest piece first, then again from where it ends.
void WordPieces::append_pieces(std::u32string_view word, std::vector<int>& ids) const {
    std::vector<int> found;
    for (std::size_t begin = 0; begin < word.size() && word.size() <= kLongestWord;) {
        std::size_t end = word.size();
        auto piece = ids_.end();
        for (; end > begin; --end) {
            const std::string letters = to_utf8(word.substr(begin, end - begin));
            piece = ids_.find(begin > 0 ? "##" + letters : letters);
            if (piece != ids_.end()) break;
        }
        if (piece == ids_.end()) {
            found.clear();
            break;
        }
        found.push_back(piece->second);
        begin = end;
    }
    if (found.empty()) found.push_back(unknown_);
    ids.insert(ids.end(), found.begin(), found.end());
}

PiecedWords pieces_of(const WordPieces& pieces, std::span<const std::string> words) {
    PiecedWords pieced;
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::vector<int> ids = pieces.ids_of(words[i]);
        if (ids.empty()) ids.push_back(pieces.unknown());
        pieced.ids.insert(pieced.ids.end(), ids.begin(), ids.end());
        pieced.word.insert(pieced.word.end(), ids.size(), i);
    }
    return pieced;
}

int hashed_token(std::string_view word) {
    const std::uint64_t hash = stable_hash(to_utf8(bare_letters(word)));
    return kFirstHashed + static_cast<int>(hash % static_cast<std::uint64_t>(kBertPieces - kFirstHashed));
}

}  // namespace chironomia
