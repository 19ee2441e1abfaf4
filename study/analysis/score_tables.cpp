#include "study/analysis/score_tables.h"

#include "core/text.h"
#include "study/analysis/agreement_tables.h"

namespace chironomia::study::analysis {
namespace {

Table scores_table(const TableSource& of) {
    Table table{
        .id = "scores",
        .title = "Scores",
        .note =
            "Of participants: the score of each is the mean over what they rated. Intervals of 95 %: of "
            "the mean by Student's t, of the median between order statistics. Participants are taken as "
            "independent, answers of one participant need not be; the clips are taken as given",
        .columns = {{"question", "question"},
                    {"condition", "condition"},
                    {"participants", "n", Show::whole},
                    {"answers", "answers", Show::whole},
                    {"mean", "mean", Show::two},
                    {"mean_low", "95 % of mean", Show::two},
                    {"mean_high", "", Show::two},
                    {"sd", "sd", Show::two},
                    {"median", "median", Show::two},
                    {"median_low", "95 % of median", Show::two},
                    {"median_high", "", Show::two},
                    {"least", "min", Show::two},
                    {"most", "max", Show::two},
                    {"mean_of_answers", "mean of answers", Show::two},
                    {"sd_of_answers", "sd of answers", Show::two}}};
    for (const ScoreResult& result : of.results.scores) {
        for (const CellResult& cell : result.cells) {
            const Summary& s = cell.participants;
            Row row = {of.question(result.question), of.cell(cell.cell), s.n, cell.answers.n, s.mean};
            append(row, s.mean_95);
            row.insert(row.end(), {Cell(s.sd), Cell(s.median)});
            append(row, s.median_95);
            row.insert(row.end(),
                       {Cell(s.least), Cell(s.most), Cell(cell.answers.mean), Cell(cell.answers.sd)});
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

std::vector<Column> columns_of_t(std::vector<Column> columns) {
    columns.insert(columns.end(), {{"difference", "difference", Show::two},
                                   {"difference_low", "95 %", Show::two},
                                   {"difference_high", "", Show::two},
                                   {"t", "t", Show::two},
                                   {"df", "df", Show::one},
                                   {"p", "p", Show::p},
                                   {"effect", "d", Show::two}});
    return columns;
}

void append(Row& row, const MeanTest& test) {
    row.push_back(test.difference);
    append(row, test.difference_95);
    row.insert(row.end(), {Cell(test.t), Cell(test.df), Cell(test.p), Cell(test.effect)});
}

// A number of a test; an empty cell if the test could not be made.
template <typename Test>
Cell number(const std::optional<Test>& test, double Test::*member) {
    return test ? std::optional((*test).*member) : std::nullopt;
}

Table middle_t_table(const TableSource& of) {
    Table table{
        .id = "middle_t",
        .title = "t against the middle of the scale",
        .note =
            "One sample, of the scores of participants; the middle means that the two conditions are equal, and the "
            "difference is the mean less the middle: above 0 the first is ahead. d is the difference in standard "
            "deviations of the scores. Holm's p is adjusted for all such rows of the question. Takes participants as "
            "independent and their mean as normal, as it is of many participants. Where all scores are the same there "
            "is no t",
        .columns = columns_of_t({{"question", "question"},
                                 {"condition", "condition"},
                                 {"n", "n", Show::whole},
                                 {"middle", "middle", Show::two}})};
    table.columns.push_back({"p_holm", "p (Holm)", Show::p});
    for (const ScoreResult& result : of.results.scores) {
        for (const CellResult& cell : result.cells) {
            if (!cell.middle || !cell.middle->t) continue;
            Row row = {of.question(result.question), of.cell(cell.cell), cell.middle->t->n_first,
                       cell.middle->middle};
            append(row, *cell.middle->t);
            row.push_back(cell.middle->t_holm_p);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table middle_wilcoxon_table(const TableSource& of) {
    Table table{
        .id = "middle_wilcoxon",
        .title = "Wilcoxon's signed ranks against the middle of the scale",
        .note =
            "One sample, of the scores of participants; n differ from the middle by more than 1e-9. Holm's p is "
            "adjusted for all such rows of the question. Takes participants as independent and their scores as "
            "symmetric about the middle if the conditions are equal",
        .columns = {{"question", "question"},
                    {"condition", "condition"},
                    {"n", "n", Show::whole},
                    {"same", "same", Show::whole},
                    {"middle", "middle", Show::two},
                    {"statistic", "T", Show::two},
                    {"method", "method"},
                    {"p", "p", Show::p},
                    {"p_holm", "p (Holm)", Show::p}}};
    for (const ScoreResult& result : of.results.scores) {
        for (const CellResult& cell : result.cells) {
            if (!cell.middle || !cell.middle->ranks) continue;
            const RankTest& ranks = *cell.middle->ranks;
            table.rows.push_back({of.question(result.question), of.cell(cell.cell), ranks.n, ranks.same,
                                  cell.middle->middle, ranks.statistic, ranks.exact ? "exact" : "normal",
                                  ranks.p, cell.middle->ranks_holm_p});
        }
    }
    return table;
}

// Turned round, so that both scores are over the condition that they share, or under it.
std::string second_of(const CellPair& pair, const TableSource& of) {
    return of.cell(pair.second) + (pair.turned ? " (turned round)" : "");
}

Table paired_table(const TableSource& of) {
    Table table{
        .id = "paired_t",
        .title = "Paired t",
        .note =
            "Of the scores of participants who rated both; d is the mean difference in its standard "
            "deviations. Holm's p is adjusted for all pairs of the question, those of Welch's t too. Takes "
            "participants as independent and the mean of their differences as normal, as it is of many participants. A "
            "pair about which all participants differ by the same has no t",
        .columns = columns_of_t(
            {{"question", "question"}, {"first", "first"}, {"second", "second"}, {"n", "n", Show::whole}})};
    table.columns.push_back({"p_holm", "p (Holm)", Show::p});
    for (const ScoreResult& result : of.results.scores) {
        for (const CellPair& pair : result.pairs) {
            if (!pair.paired) continue;
            Row row = {of.question(result.question), of.cell(pair.first), second_of(pair, of),
                       pair.paired->n_first};
            append(row, *pair.paired);
            row.push_back(pair.t_holm_p);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table welch_table(const TableSource& of) {
    Table table{
        .id = "welch_t",
        .title = "Welch's t",
        .note =
            "Of pairs that no participant rated both of: the groups are different people; d is over the root of "
            "the mean variance. Holm's p is adjusted for all pairs of the question, those of the paired t too",
        .columns = columns_of_t({{"question", "question"},
                                 {"first", "first"},
                                 {"second", "second"},
                                 {"n_first", "n first", Show::whole},
                                 {"n_second", "n second", Show::whole}})};
    table.columns.push_back({"p_holm", "p (Holm)", Show::p});
    for (const ScoreResult& result : of.results.scores) {
        for (const CellPair& pair : result.pairs) {
            if (!pair.welch) continue;
            Row row = {of.question(result.question), of.cell(pair.first), second_of(pair, of),
                       pair.welch->n_first, pair.welch->n_second};
            append(row, *pair.welch);
            row.push_back(pair.t_holm_p);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table wilcoxon_table(const TableSource& of) {
    Table table{.id = "wilcoxon",
                .title = "Wilcoxon's signed ranks",
                .note =
                    "Of the scores of participants who rated both; n differ by more than 1e-9. Holm's p is "
                    "adjusted for all pairs of the question. Takes participants as independent and their "
                    "differences as symmetric if the conditions are equal",
                .columns = {{"question", "question"},
                            {"first", "first"},
                            {"second", "second"},
                            {"n", "n", Show::whole},
                            {"same", "same", Show::whole},
                            {"statistic", "T", Show::two},
                            {"method", "method"},
                            {"p", "p", Show::p},
                            {"p_holm", "p (Holm)", Show::p}}};
    for (const ScoreResult& result : of.results.scores) {
        for (const CellPair& pair : result.pairs) {
            if (!pair.ranks) continue;
            table.rows.push_back({of.question(result.question), of.cell(pair.first), second_of(pair, of),
                                  pair.ranks->n, pair.ranks->same, pair.ranks->statistic,
                                  pair.ranks->exact ? "exact" : "normal", pair.ranks->p, pair.ranks_holm_p});
        }
    }
    return table;
}

Table friedman_table(const TableSource& of) {
    Table table{
        .id = "friedman",
        .title = "Friedman's test of all conditions",
        .note =
            "Of the scores of participants who rated all conditions; the others are left out. W is Kendall's, 1 if all "
            "of them order the conditions alike. Takes participants as independent and no more of scores than their "
            "order; p is by the distribution of chi squared, which holds for more than 10 participants or so",
        .columns = {{"question", "question"},
                    {"conditions", "conditions", Show::whole},
                    {"n", "n", Show::whole},
                    {"left_out", "left out", Show::whole},
                    {"chi_squared", "chi squared", Show::two},
                    {"df", "df", Show::whole},
                    {"p", "p", Show::p},
                    {"w", "W", Show::two}}};
    for (const ScoreResult& result : of.results.scores) {
        if (!result.within) continue;
        Row row = {of.question(result.question), result.cells.size(), result.within->complete,
                   result.within->incomplete};
        const std::optional<FriedmanTest>& test = result.within->friedman;
        row.insert(row.end(), {number(test, &FriedmanTest::chi_squared), number(test, &FriedmanTest::df),
                               number(test, &FriedmanTest::p), number(test, &FriedmanTest::w)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table repeated_anova_table(const TableSource& of) {
    Table table{
        .id = "repeated_anova",
        .title = "Analysis of variance of repeated measures",
        .note =
            "One way, of the scores of participants who rated all conditions; the others are left out. p is corrected "
            "by Greenhouse and Geisser: of F with both degrees of freedom times epsilon, so that the differences of "
            "two conditions need not vary alike. Takes participants as independent and their scores as normal, as "
            "means of many answers are",
        .columns = {{"question", "question"},
                    {"conditions", "conditions", Show::whole},
                    {"n", "n", Show::whole},
                    {"left_out", "left out", Show::whole},
                    {"f", "F", Show::two},
                    {"df", "df", Show::whole},
                    {"df_error", "df error", Show::whole},
                    {"epsilon", "epsilon", Show::two},
                    {"p", "p", Show::p},
                    {"partial_eta_squared", "partial eta squared", Show::two},
                    {"generalized_eta_squared", "generalized eta squared", Show::two}}};
    for (const ScoreResult& result : of.results.scores) {
        if (!result.within) continue;
        Row row = {of.question(result.question), result.cells.size(), result.within->complete,
                   result.within->incomplete};
        const std::optional<RepeatedAnova>& test = result.within->anova;
        for (const auto member :
             {&RepeatedAnova::f, &RepeatedAnova::df, &RepeatedAnova::df_error, &RepeatedAnova::epsilon,
              &RepeatedAnova::p, &RepeatedAnova::partial_eta_squared,
              &RepeatedAnova::generalized_eta_squared})
            row.push_back(number(test, member));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table anova_table(const TableSource& of) {
    Table table{
        .id = "anova",
        .title = "Analysis of variance of independent groups",
        .note =
            "One way, of the scores of participants who rated one condition; those who rated several, where most rated "
            "one, are left out of all tests of the question. Takes participants as independent and their scores as "
            "normal and as varying alike in all groups",
        .columns = {{"question", "question"},
                    {"groups", "groups", Show::whole},
                    {"n", "n", Show::whole},
                    {"left_out", "left out", Show::whole},
                    {"f", "F", Show::two},
                    {"df_between", "df between", Show::whole},
                    {"df_within", "df within", Show::whole},
                    {"p", "p", Show::p},
                    {"eta_squared", "eta squared", Show::two},
                    {"mean_square_within", "MS within", Show::three}}};
    for (const ScoreResult& result : of.results.scores) {
        if (!result.anova) continue;
        const Anova& anova = *result.anova;
        table.rows.push_back({of.question(result.question), result.cells.size(), anova.n, result.left_out,
                              anova.f, anova.df_between, anova.df_within, anova.p, anova.eta_squared,
                              anova.mean_square_within});
    }
    return table;
}

Table lsd_table(const TableSource& of) {
    Table table{.id = "fisher_lsd",
                .title = "Fisher's least significant differences",
                .note = "After the analysis of variance of independent groups; p not adjusted",
                .columns = {{"question", "question"},
                            {"first", "first"},
                            {"second", "second"},
                            {"n", "n", Show::whole},
                            {"difference", "difference", Show::two},
                            {"difference_low", "95 %", Show::two},
                            {"difference_high", "", Show::two},
                            {"t", "t", Show::two},
                            {"df", "df", Show::whole},
                            {"p", "p", Show::p}}};
    for (const ScoreResult& result : of.results.scores) {
        if (!result.anova) continue;
        for (const LeastSignificantDifference& pair : result.anova->pairs) {
            Row row = {of.question(result.question), of.cell(result.cells[pair.first].cell),
                       of.cell(result.cells[pair.second].cell),
                       result.cells[pair.first].participants.n + result.cells[pair.second].participants.n,
                       pair.difference};
            append(row, pair.difference_95);
            row.insert(row.end(), {Cell(pair.t), Cell(result.anova->df_within), Cell(pair.p)});
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table factors_table(const TableSource& of) {
    Table table{
        .id = "questions",
        .title = "Between questions",
        .note =
            "Paired t of the scores that the same participants gave to one condition; d is the mean "
            "difference in its standard deviations. Takes participants as independent; p not adjusted",
        .columns = columns_of_t({{"question", "question"},
                                 {"other_question", "other question"},
                                 {"condition", "condition"},
                                 {"n", "n", Show::whole}})};
    for (const QuestionPair& pair : of.results.factors) {
        if (!pair.paired) continue;
        Row row = {of.question(pair.first), of.question(pair.second), of.cell(pair.cell),
                   pair.paired->n_first};
        append(row, *pair.paired);
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::vector<Table> score_tables(const TableSource& of) {
    return {scores_table(of),   cronbach_table(of),       middle_t_table(of), middle_wilcoxon_table(of),
            friedman_table(of), repeated_anova_table(of), anova_table(of),    paired_table(of),
            wilcoxon_table(of), welch_table(of),          lsd_table(of),      factors_table(of)};
}

}  // namespace chironomia::study::analysis
