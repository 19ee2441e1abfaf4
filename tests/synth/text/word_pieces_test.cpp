#include "synth/text/word_pieces.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::refusal_of;

// 0 to 3, then the pieces by their line.
const std::string kVocabulary =
    "[PAD]\n[UNK]\n[CLS]\n[SEP]\n"
    "un\n##aff\n##able\nunaff\ncafe\n,\n'\n"          // 4 to 10
    "don\nt\n\xE6\x97\xA5\n\xE6\x9C\xAC\n$\n##un\n";  // 11 to 16

WordPieces tiny() {
    return WordPieces(kVocabulary, "vocab.txt");
}

TEST(WordPieces, KnowsTheNumbersOfItsMarks) {
    const WordPieces pieces = tiny();
    EXPECT_EQ(pieces.size(), 17u);
    EXPECT_EQ(pieces.pad(), 0);
    EXPECT_EQ(pieces.unknown(), 1);
    EXPECT_EQ(pieces.begin(), 2);
    EXPECT_EQ(pieces.end(), 3);
}

TEST(WordPieces, TakesTheLongestPieceFirst) {
    EXPECT_THAT(tiny().ids_of("unaffable"), ElementsAre(7, 6));
    EXPECT_THAT(tiny().ids_of("unun"), ElementsAre(4, 16));
}

TEST(WordPieces, DoesNotSeeCaseAndAccents) {
    EXPECT_THAT(tiny().ids_of("CAFÉ"), ElementsAre(8));
    EXPECT_THAT(tiny().ids_of("cafe\xCC\x81"), ElementsAre(8));  // a letter and an accent of its own
}

TEST(WordPieces, PartsPunctuationAndSymbols) {
    EXPECT_THAT(tiny().ids_of("un,don't$cafe"), ElementsAre(4, 9, 11, 10, 12, 15, 8));
}

TEST(WordPieces, PartsChineseCharacters) {
    EXPECT_THAT(tiny().ids_of("un日本cafe"), ElementsAre(4, 13, 14, 8));
}

TEST(WordPieces, GivesUpAWordOfWhichAPartIsUnknown) {
    EXPECT_THAT(tiny().ids_of("unzz cafe"), ElementsAre(1, 8));
    // "able" is known only within a word.
    EXPECT_THAT(tiny().ids_of("able"), ElementsAre(1));
}

TEST(WordPieces, GivesUpAWordOfOverAHundredCharacters) {
    std::string fifty;
    for (int i = 0; i < 50; ++i) fifty += "un";
    EXPECT_EQ(tiny().ids_of(fifty).size(), 50u);
    EXPECT_THAT(tiny().ids_of(fifty + "un"), ElementsAre(1));
}

TEST(WordPieces, SeesNothingInBlanksAndControlCharacters) {
    EXPECT_THAT(tiny().ids_of(" \t\n\xC2\xA0\x01\xE2\x80\x8B"), IsEmpty());
    EXPECT_THAT(tiny().ids_of("ca\x01"
                              "fe"),
                ElementsAre(8));
}

TEST(PiecesOf, GiveTheWordOfEach) {
    const std::vector<std::string> words{"Unaffable", ",", " ", "don't"};
    const PiecedWords pieced = pieces_of(tiny(), words);
    EXPECT_THAT(pieced.ids, ElementsAre(7, 6, 9, 1, 11, 10, 12));
    EXPECT_THAT(pieced.word, ElementsAre(0, 0, 1, 2, 3, 3, 3));
}

TEST(WordPieces, ReadsAFile) {
    const testing::TemporaryFolder folder;
    write_text(folder / "vocab.txt", "[PAD]\r\n[UNK]\r\n[CLS]\r\n[SEP]\r\ncafe\r\n");
    EXPECT_THAT(WordPieces(folder / "vocab.txt").ids_of("cafe"), ElementsAre(4));
    EXPECT_THAT(refusal_of([&] { WordPieces(folder / "none.txt"); }), HasSubstr("none.txt"));
}

TEST(WordPieces, RefusesAVocabularyThatIsNone) {
    const auto refusal = [](const std::string& text) {
        return refusal_of([&] { WordPieces(text, "vocab.txt"); });
    };
    EXPECT_EQ(refusal("[PAD]\n[UNK]\n[CLS]\n"),
              "vocab.txt: [SEP] is missing among 3 pieces; use the vocab.txt of the model");
    EXPECT_EQ(refusal("[PAD]\n[UNK]\n[CLS]\n[SEP]\nthe\n[UNK]\n"),
              "vocab.txt:6: \"[UNK]\" is on line 2 too; every piece stands on one line");
    EXPECT_EQ(refusal("[PAD]\n\xff\n"), "vocab.txt: byte 6 is not UTF-8; use the vocab.txt of the model");
}

TEST(HashedToken, IsAPieceOfBertThatAWordAlwaysHas) {
    for (const char* word : {"the", "machine", ",", "日本", ""}) {
        EXPECT_GE(hashed_token(word), 1000);
        EXPECT_LT(hashed_token(word), 30522);
    }
    EXPECT_EQ(hashed_token("Café"), hashed_token("cafe"));
    EXPECT_NE(hashed_token("cafe"), hashed_token("the"));
    // FNV-1a of no byte is its offset, 14695981039346656037.
    EXPECT_EQ(hashed_token(""), 1000 + static_cast<int>(14695981039346656037ull % 29522));
}

}  // namespace
}  // namespace chironomia
