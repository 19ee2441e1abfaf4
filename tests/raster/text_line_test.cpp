#include "raster/images/text_line.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "raster/images/image_module.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::refusal_of;

// How much ink there is between two rows.
double ink(const Frame& line, int first_row, int last_row) {
    double sum = 0;
    for (int y = first_row; y < last_row; ++y)
        for (int x = 0; x < line.width; ++x)
            sum += line.rgba[static_cast<std::size_t>(y * line.width + x) * 4 + 3] / 255.0;
    return sum;
}

TEST(TextWidth, GrowsWithTextAndSize) {
    EXPECT_GT(text_width("Choose left", 40), text_width("Choose", 40));
    EXPECT_NEAR(text_width("Choose left", 80), 2 * text_width("Choose left", 40), 6);
}

// An underscore lies below the line of writing, a quote above the small letters, "x" between.
TEST(DrawTextLine, PutsLettersWhereTheyBelong) {
    const Frame low = draw_text_line("____", 40), high = draw_text_line("''''", 40),
                middle = draw_text_line("xxxx", 40);
    EXPECT_EQ(low.height, 60);
    EXPECT_EQ(ink(low, 0, 45), 0);
    EXPECT_GT(ink(low, 45, 60), 50);
    EXPECT_GT(ink(high, 10, 30), 20);
    EXPECT_EQ(ink(high, 30, 60), 0);
    EXPECT_GT(ink(middle, 20, 46), 100);
    EXPECT_EQ(ink(middle, 0, 18) + ink(middle, 47, 60), 0);
}

TEST(DrawTextLine, DrawsAccentsAboveTheirLetters) {
    const Frame plain = draw_text_line("EAEA", 40), accents = draw_text_line("ÉÀÊÄ", 40);
    EXPECT_EQ(plain.width, accents.width);
    EXPECT_EQ(ink(plain, 0, 14), 0);
    EXPECT_GT(ink(accents, 0, 14), 20);
    EXPECT_NEAR(ink(plain, 18, 60), ink(accents, 18, 60), 0.05 * ink(plain, 18, 60));
}

TEST(DrawTextLine, IsTheSameEveryTime) {
    EXPECT_EQ(draw_text_line("Où est-ce ? Ça va œuvre ß ñ ő ł", 33),
              draw_text_line("Où est-ce ? Ça va œuvre ß ñ ő ł", 33));
}

TEST(DrawTextLine, RefusesAFileThatIsNoFont) {
    const testing::TemporaryFolder folder;
    write_text(folder / "a.ttf", "no font");
    EXPECT_EQ(refusal_of([&] { image_module().draw_text(U"a", {.font = folder / "a.ttf", .size = 20}); }),
              (folder / "a.ttf").string() + ": is no font that can be used; install it again");
}

TEST(DrawTextLine, RefusesLettersThatItCannotSet) {
    EXPECT_EQ(
        refusal_of([] { draw_text_line("a\u0645", 40); }),
        "text \"a\u0645\": the character \"\u0645\" (U+0645) cannot be burnt in; write it in Latin, Greek or "
        "Cyrillic letters");
    EXPECT_EQ(refusal_of([] { text_width("ab\xff", 40); }),
              "text \"ab\xff\": byte 2 is not UTF-8; save it as UTF-8");
    EXPECT_EQ(refusal_of([] { text_width("a\xc3", 40); }),
              "text \"a\xc3\": byte 1 is not UTF-8; save it as UTF-8");
}

}  // namespace
}  // namespace chironomia
