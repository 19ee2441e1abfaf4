// Words cut into the pieces that BERT knows.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace chironomia {

// Of "bert-base-uncased": lower case, no accents, punctuation and CJK characters on their own, then the
// longest piece that is known, and again, "##" before pieces within a word. A word of over 100 characters or
// with a part that no piece covers is [UNK]. Devlin et al., "BERT", 2019; Wu et al., "Google's Neural Machine
// Translation System", 2016.
class WordPieces {
  public:
    // vocab.txt: one piece a line, its number the line's from 0. Throws Error if the file cannot be read, is
    // not UTF-8, has a piece twice, or lacks [PAD], [UNK], [CLS] or [SEP].
    explicit WordPieces(const std::filesystem::path& vocabulary);
    WordPieces(std::string_view vocabulary, const std::string& where);

    std::size_t size() const { return ids_.size(); }
    int pad() const { return pad_; }
    int unknown() const { return unknown_; }
    int begin() const { return begin_; }  // [CLS]
    int end() const { return end_; }      // [SEP]

    // Of a text in UTF-8; none of white space and control characters alone.
    std::vector<int> ids_of(std::string_view text) const;

  private:
    void append_pieces(std::u32string_view word, std::vector<int>& ids) const;
    int required(std::string_view piece, const std::string& where) const;

    std::unordered_map<std::string, int> ids_;
    int pad_ = 0, unknown_ = 0, begin_ = 0, end_ = 0;
};

// The pieces of an utterance, and which word each belongs to: a word's vector is the mean of its pieces'
// (A07).
struct PiecedWords {
    std::vector<int> ids;           // (P) without [CLS] and [SEP]
    std::vector<std::size_t> word;  // (P) ascending, of `words`
};

// Every word has at least one piece: [UNK] if nothing of it is left.
PiecedWords pieces_of(const WordPieces& pieces, std::span<const std::string> words);

// Stands for a piece of BERT's vocabulary where the user gave none: a number in [1000, 30521] that a word of
// any case and accents always has; different words may share it. For /text/tokens of synthetic corpora.
int hashed_token(std::string_view word);

}  // namespace chironomia
