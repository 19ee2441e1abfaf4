#include "core/files/csv_table.h"

#include <gmock/gmock.h>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using testing::refusal_of;

TEST(CsvTable, ReadsAnySeparatorQuotesAndComments) {
    const CsvTable table = parse_csv_table("# made today\n\"time\"; value\n0;1.5\n\n0.1; \"2\"\n", "a.csv");
    EXPECT_THAT(table.columns, ElementsAre("time", "value"));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[1].line, 5u);
    EXPECT_EQ(number_in(table, table.rows[1], 1), 2);
    EXPECT_EQ(find_column(table, {"value"}), 1u);
    EXPECT_EQ(find_column(table, {"speed"}), std::nullopt);
}

TEST(CsvTable, KeepsSeparatorsLineEndsAndQuotesOfQuotedCells) {
    const CsvTable table = parse_csv_table(
        "\"last; first\";said\r\n\"Doe; Jane\"; \"she said \"\"no\"\",\nand left\" \r\n5\" tall;\"\"\r\n",
        "a.csv");
    EXPECT_THAT(table.columns, ElementsAre("last; first", "said"));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_THAT(table.rows[0].cells, ElementsAre("Doe; Jane", "she said \"no\",\nand left"));
    EXPECT_THAT(table.rows[1].cells, ElementsAre("5\" tall", ""));
    EXPECT_EQ(table.rows[0].line, 2u);
    EXPECT_EQ(table.rows[1].line, 4u);
    EXPECT_THAT(csv_columns("\"a,b\",c\n", "a.csv"), ElementsAre("a,b", "c"));
}

TEST(CsvTable, SkipsTheLineInWhichExcelNamesTheSeparator) {
    const CsvTable table = parse_csv_table("sep=;\r\na,b;c\r\n1;2\r\n", "a.csv");
    EXPECT_THAT(table.columns, ElementsAre("a,b", "c"));
    EXPECT_EQ(table.rows[0].line, 3u);
}

TEST(CsvTable, EndsLinesAsClassicMacOsDid) {
    const CsvTable table = parse_csv_table("a;b\r1;\"2\"\r3;4\r", "a.csv");
    EXPECT_THAT(table.columns, ElementsAre("a", "b"));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "4"));
    EXPECT_EQ(table.rows[1].line, 3u);
}

TEST(CsvTable, RefusesQuotesThatDoNotMatch) {
    EXPECT_EQ(refusal_of([] { parse_csv_table("a,b\n1,\"2\n3,4\n", "a.csv"); }),
              "a.csv:2: a quote is opened and never closed; close it");
    EXPECT_EQ(refusal_of([] { parse_csv_table("a,b\n1,\"2\" m\n", "a.csv"); }),
              "a.csv:2: text stands behind the quote that closes \"2\" m; double each quote within a cell");
    EXPECT_EQ(refusal_of([] { parse_csv_table("a,b\n1,\"\"\"\n", "a.csv"); }),
              "a.csv:2: a quote is opened and never closed; close it");
}

TEST(CsvTable, ReadsTablesWithoutHeaderAndComments) {
    const CsvTable table =
        parse_csv_table("#a,1\n\n#b,2\n", "a.csv", {.has_header = false, .has_comments = false});
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_THAT(table.rows[0].cells, ElementsAre("#a", "1"));
    EXPECT_THAT(table.rows[1].cells, ElementsAre("#b", "2"));
    EXPECT_EQ(table.rows[1].line, 3u);
}

TEST(CsvTable, KeepsTheColumnsThatAreAskedFor) {
    const CsvTable table = parse_csv_table("a,b,c\n1,2,3\n", "a.csv",
                                           {.keeps = [](std::string_view name) { return name != "b"; }});
    EXPECT_THAT(table.columns, ElementsAre("a", "c"));
    EXPECT_THAT(table.rows[0].cells, ElementsAre("1", "3"));
    EXPECT_EQ(table.width, 3u);
}

TEST(CsvTable, RefusesWhatIsNoTable) {
    EXPECT_EQ(refusal_of([] { parse_csv_table("a,b\n", "a.csv"); }), "a.csv: no rows follow the header");
    EXPECT_EQ(refusal_of([] { parse_csv_table("a;b\n1\n", "a.csv"); }),
              "a.csv:2: 1 values, the header has 2 columns");
    EXPECT_EQ(
        refusal_of([] { parse_csv_table("a\n1,5\n", "a.csv"); }),
        "a.csv:2: 2 values, the header has 1 columns; if numbers are written with a comma, export them with a "
        "decimal point");
    const CsvTable table = parse_csv_table("a;b\n1;2,5\n", "a.csv");
    EXPECT_EQ(refusal_of([&] { number_in(table, table.rows[0], 1); }),
              "a.csv:2: column \"b\": \"2,5\" is no number; it is written with a comma, export it with a "
              "decimal point");
}

}  // namespace
}  // namespace chironomia
