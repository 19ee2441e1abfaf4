#include "study/analysis/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace chironomia::study::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Table sample() {
    return {.id = "t",
            .title = "A & B",
            .note = "50 % of all",
            .columns = {{"question", "question"},
                        {"name", "name"},
                        {"n", "n", Show::whole},
                        {"mean", "mean", Show::two},
                        {"mean_low", "95 %", Show::two},
                        {"mean_high", "", Show::two},
                        {"p", "p", Show::p}},
            .rows = {{"q1", "a, \"b\"", std::size_t{12}, 1.23456, 1.0, 2.0, 0.0004},
                     {"q2", "c<d_e", std::size_t{1}, 2.0, std::optional<double>(), std::optional<double>(),
                      0.25}}};
}

TEST(Table, CsvHasAllDigitsAndQuotesWhatItMust) {
    EXPECT_EQ(csv_header(sample(), {"rule"}), "rule,question,name,n,mean,mean_low,mean_high,p\n");
    EXPECT_EQ(csv_rows(sample(), {"strict"}),
              "strict,q1,\"a, \"\"b\"\"\",12,1.23456,1,2,0.0004\nstrict,q2,c<d_e,1,2,,,0.25\n");
}

// A spreadsheet would run them.
TEST(Table, CsvHasNoFormulasButNumbers) {
    EXPECT_EQ(csv_line({"=1+1", "+x", "-x", "@x", "\tx"}), "'=1+1,'+x,'-x,'@x,'\tx\n");
    EXPECT_EQ(csv_line({"=HYPERLINK(\"a\",\"b\")"}), "\"'=HYPERLINK(\"\"a\"\",\"\"b\"\")\"\n");
    EXPECT_EQ(csv_line({"-1.5", "-2e-05", "a=b", "–", ""}), "-1.5,-2e-05,a=b,–,\n");
}

TEST(Table, PeopleSeeAnIntervalAsOne) {
    const ShownTable shown = show(sample());
    EXPECT_THAT(shown.titles, ElementsAre("question", "name", "n", "mean", "95 %", "p"));
    EXPECT_THAT(shown.rows[0], ElementsAre("q1", "a, \"b\"", "12", "1.23", "[1.00, 2.00]", "< .001"));
    EXPECT_THAT(shown.rows[1], ElementsAre("q2", "c<d_e", "1", "2.00", "–", ".250"));
    EXPECT_EQ(to_text(part_of(sample(), "q2")), "name   n  mean  95 %     p\nc<d_e  1  2.00     –  .250\n");
}

// What rounds to nothing has no sign.
TEST(Table, PeopleSeeNoMinusBeforeNothing) {
    Table table = sample();
    for (std::size_t c = 3; c < 6; ++c) table.rows[0][c] = Cell(c == 5 ? -0.005001 : -0.003);
    EXPECT_THAT(show(table).rows[0], ElementsAre("q1", "a, \"b\"", "12", "0.00", "[0.00, -0.01]", "< .001"));
}

TEST(Table, HtmlAndLatexEscapeTexts) {
    EXPECT_THAT(to_html(sample()), HasSubstr("<td>c&lt;d_e</td><td class=\"n\">1</td>"));
    const std::string latex = to_latex(sample(), "t-strict");
    EXPECT_THAT(latex, HasSubstr("\\caption{A \\& B. 50 \\% of all}\n\\label{tab:t-strict}\n"));
    EXPECT_THAT(latex, HasSubstr("\\begin{tabular}{llrrrr}\n\\toprule\n"));
    EXPECT_THAT(latex, HasSubstr("q2 & c$<$d\\_e & 1 & 2.00 & -- & .250 \\\\\n"));
    EXPECT_EQ(escape_latex("{~^\\|>"), "\\{\\textasciitilde{}\\textasciicircum{}\\textbackslash{}$|$$>$");
}

TEST(Table, JsonHasNullWhereThereIsNoNumber) {
    const Json json = to_json(sample());
    EXPECT_EQ(json[0]["mean"], 1.23456);
    EXPECT_EQ(json[1]["mean_low"], nullptr);
    EXPECT_EQ(json[1]["name"], "c<d_e");
}

TEST(ShowP, LeavesOutTheNoughtAndWhatIsTooSmall) {
    EXPECT_EQ(show_p(0.0421), ".042");
    EXPECT_EQ(show_p(0.0009), "< .001");
    EXPECT_EQ(show_p(1), "1.000");
}

}  // namespace
}  // namespace chironomia::study::analysis
