#include "study/analysis/result_tables.h"

#include <algorithm>

#include "core/text.h"
#include "study/analysis/agreement_tables.h"
#include "study/analysis/published_table.h"
#include "study/measure/proportions.h"
#include "study/published/published.h"

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

// Filled by append_share().
std::vector<Column> columns_of_share(std::vector<Column> columns, const char* counted) {
    columns.insert(columns.end(), {{counted, counted, Show::whole},
                                   {"of", "of", Show::whole},
                                   {"share", "share", Show::percent},
                                   {"share_low", "95 %", Show::percent},
                                   {"share_high", "", Show::percent}});
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

Table paired_table(const TableSource& of) {
    Table table{
        .id = "paired_t",
        .title = "Paired t",
        .note =
            "Of the scores of participants who rated both; d is the mean difference in its standard "
            "deviations. Holm's p is adjusted for all pairs of the question. Takes participants as "
            "independent and the mean of their differences as normal, as it is of many participants. A pair "
            "about which all participants differ by the same has no t",
        .columns = columns_of_t(
            {{"question", "question"}, {"first", "first"}, {"second", "second"}, {"n", "n", Show::whole}})};
    table.columns.push_back({"p_holm", "p (Holm)", Show::p});
    for (const ScoreResult& result : of.results.scores) {
        for (const CellPair& pair : result.pairs) {
            if (!pair.paired) continue;
            Row row = {of.question(result.question), of.cell(pair.first), of.cell(pair.second),
                       pair.paired->n_first};
            append(row, *pair.paired);
            row.push_back(pair.paired_holm_p);
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
            "the mean variance. Holm's p is adjusted for all such pairs of the question",
        .columns = columns_of_t({{"question", "question"},
                                 {"first", "first"},
                                 {"second", "second"},
                                 {"n_first", "n first", Show::whole},
                                 {"n_second", "n second", Show::whole}})};
    table.columns.push_back({"p_holm", "p (Holm)", Show::p});
    for (const ScoreResult& result : of.results.scores) {
        for (const CellPair& pair : result.pairs) {
            if (!pair.welch) continue;
            Row row = {of.question(result.question), of.cell(pair.first), of.cell(pair.second),
                       pair.welch->n_first, pair.welch->n_second};
            append(row, *pair.welch);
            row.push_back(pair.welch_holm_p);
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
            table.rows.push_back({of.question(result.question), of.cell(pair.first), of.cell(pair.second),
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
            "One way, of the scores of participants, each of whom rated one condition. Takes participants as "
            "independent and their scores as normal and as varying alike in all groups",
        .columns = {{"question", "question"},
                    {"groups", "groups", Show::whole},
                    {"n", "n", Show::whole},
                    {"f", "F", Show::two},
                    {"df_between", "df between", Show::whole},
                    {"df_within", "df within", Show::whole},
                    {"p", "p", Show::p},
                    {"eta_squared", "eta squared", Show::two},
                    {"mean_square_within", "MS within", Show::three}}};
    for (const ScoreResult& result : of.results.scores) {
        if (!result.anova) continue;
        const Anova& anova = *result.anova;
        table.rows.push_back({of.question(result.question), result.cells.size(), anova.n, anova.f,
                              anova.df_between, anova.df_within, anova.p, anova.eta_squared,
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

std::string relation_of(const TableSource& of, const VotePair& pair) {
    return pair.made_of_it ? of.data.conditions[pair.second].made : "two conditions";
}

Table rater_votes_table(const TableSource& of) {
    Table table{
        .id = "preferences_of_participants",
        .title = "Preferences of participants",
        .note =
            "The first test of preferences: one number for each participant. The share is the mean over "
            "participants of how often they preferred the first, ties half, with Student's interval; the score "
            "is that of how strongly, from -2 (clearly the second) to 2 (clearly the first), as the mean "
            "appropriateness score of GENEA 2023; p is "
            "of Fisher's randomization test of each participant's wins less losses, exact, and Holm's is "
            "adjusted for all pairs of the question. Participants are taken as independent, and as likely "
            "to lean either way if the conditions are equal; votes of one participant need not be "
            "independent, and the clips are taken as given",
        .columns = {{"question", "question"},
                    {"first", "first"},
                    {"second", "second"},
                    {"relation", "relation"},
                    {"participants", "n", Show::whole},
                    {"for_first", "for first", Show::whole},
                    {"even", "even", Show::whole},
                    {"for_second", "for second", Show::whole},
                    {"share", "mean share", Show::percent},
                    {"share_low", "95 %", Show::percent},
                    {"share_high", "", Show::percent},
                    {"score", "mean score", Show::two},
                    {"score_low", "95 %", Show::two},
                    {"score_high", "", Show::two},
                    {"p", "p", Show::p},
                    {"p_holm", "p (Holm)", Show::p}}};
    for (const VoteResult& result : of.results.votes) {
        for (const VotePair& pair : result.pairs) {
            const RaterVotes& raters = pair.raters;
            Row row = {of.question(result.question),
                       of.condition(pair.first),
                       of.condition(pair.second),
                       relation_of(of, pair),
                       pair.participants,
                       raters.for_first,
                       raters.even,
                       raters.for_second,
                       raters.share};
            append(row, raters.share_95);
            row.push_back(raters.score);
            append(row, raters.score_95);
            row.insert(row.end(), {Cell(raters.p), Cell(raters.holm_p)});
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Row row_of_votes(const TableSource& of, std::size_t question, const VotePair& pair) {
    Row row = {of.question(question),
               of.condition(pair.first),
               of.condition(pair.second),
               relation_of(of, pair),
               pair.participants,
               pair.votes(),
               pair.wins,
               pair.clear_wins,
               pair.ties,
               pair.losses,
               pair.clear_losses};
    const std::size_t decided = pair.wins + pair.losses;
    if (decided > 0) {
        row.push_back(static_cast<double>(pair.wins) / static_cast<double>(decided));
        append(row, exact_share_95(pair.wins, decided));
    } else {
        row.insert(row.end(), 3, Cell(std::optional<double>()));
    }
    row.insert(row.end(), {Cell(pair.p), Cell(pair.holm_p), Cell(pair.share.share)});
    append(row, pair.share.share_95);
    return row;
}

Table votes_table(const TableSource& of) {
    Table table{
        .id = "preferences",
        .title = "Wins, ties and losses",
        .note =
            "The share is of votes that were decided, with the exact interval of Clopper and "
            "Pearson; p is that of the exact test of one half, Holm's is adjusted for all pairs of the "
            "question. Both take votes as independent, so that they find too much where participants differ "
            "and vote more than once: prefer the test of participants; the interval of the weighted share "
            "(ties half, clear answers double) is from resampled participants",
        .columns = {{"question", "question"},
                    {"first", "first"},
                    {"second", "second"},
                    {"relation", "relation"},
                    {"participants", "n", Show::whole},
                    {"votes", "votes", Show::whole},
                    {"wins", "wins", Show::whole},
                    {"clear_wins", "of these clear", Show::whole},
                    {"ties", "ties", Show::whole},
                    {"losses", "losses", Show::whole},
                    {"clear_losses", "of these clear", Show::whole},
                    {"share", "wins of decided", Show::percent},
                    {"share_low", "95 %", Show::percent},
                    {"share_high", "", Show::percent},
                    {"p", "p", Show::p},
                    {"p_holm", "p (Holm)", Show::p},
                    {"weighted_share", "weighted share", Show::percent},
                    {"weighted_share_low", "95 %", Show::percent},
                    {"weighted_share_high", "", Show::percent}}};
    for (const VoteResult& result : of.results.votes) {
        for (const VotePair& pair : result.pairs)
            table.rows.push_back(row_of_votes(of, result.question, pair));
    }
    return table;
}

Table contrasts_table(const TableSource& of) {
    Table table{
        .id = "barnard",
        .title = "Barnard's exact test",
        .note =
            "Whether the share of wins among decided votes differs between two pairs. Takes votes as "
            "independent, so that it finds too much where participants differ and vote more than once",
        .columns = {{"question", "question"},
                    {"first", "first pair"},
                    {"first_wins", "wins", Show::whole},
                    {"first_decided", "of", Show::whole},
                    {"second", "second pair"},
                    {"second_wins", "wins", Show::whole},
                    {"second_decided", "of", Show::whole},
                    {"p", "p", Show::p},
                    {"p_holm", "p (Holm)", Show::p}}};
    for (const VoteResult& result : of.results.votes) {
        const auto label = [&](const VotePair& pair) {
            return format("{} over {}", of.condition(pair.first), of.condition(pair.second));
        };
        for (const VoteContrast& contrast : result.contrasts) {
            const VotePair &a = result.pairs[contrast.first], &b = result.pairs[contrast.second];
            table.rows.push_back({of.question(result.question), label(a), a.wins, a.wins + a.losses, label(b),
                                  b.wins, b.wins + b.losses, contrast.p, contrast.holm_p});
        }
    }
    return table;
}

// One part of a group without bounds won all against the rest; often that is one condition.
const char* bounded_text(const EloTable& elo, const EloRow& row) {
    if (elo.finite) return "yes";
    if (row.won_all) return "no: won all";
    if (row.lost_all) return "no: lost all";
    return "no: some won all against the rest";
}

Table elo_table(const TableSource& of) {
    Table table{
        .id = "elo",
        .title = "Strengths on the scale of Elo",
        .note =
            "Bradley-Terry by weighted logistic regression, 4 for a clear answer, 2 for a slight one, 1 to "
            "either for a tie; all votes of a group count, also those between a condition and what is made of it, "
            "but a group of two such has a share instead; 1000 is the mean of a group, 200 more are preferred in "
            "76 % of decided votes; intervals of 95 % from resampled participants, who are taken as independent; the clips "
            "are taken as given",
        .columns = {{"question", "question"},
                    {"group", "group", Show::whole},
                    {"condition", "condition"},
                    {"participants", "n", Show::whole},
                    {"votes", "votes", Show::whole},
                    {"elo", "Elo", Show::whole},
                    {"median", "median", Show::whole},
                    {"elo_low", "95 %", Show::whole},
                    {"elo_high", "", Show::whole},
                    {"bounded", "bounded"},
                    {"samples", "samples", Show::whole},
                    {"unbounded_samples", "of these without bound", Show::whole}}};
    for (const VoteResult& result : of.results.votes) {
        for (std::size_t group = 0; group < result.elo.size(); ++group) {
            const EloTable& elo = result.elo[group].table;
            for (const EloRow& each : elo.rows) {
                Row row = {of.question(result.question),
                           group + 1,
                           of.condition(result.elo[group].conditions[each.condition]),
                           elo.participants,
                           each.votes,
                           each.elo,
                           each.median};
                append(row, each.elo_95);
                row.insert(row.end(), {Cell(bounded_text(elo, each)), Cell(elo.samples.size()),
                                       Cell(elo.unbounded_samples)});
                table.rows.push_back(std::move(row));
            }
        }
    }
    return table;
}

Table sides_table(const TableSource& of) {
    Table table{
        .id = "side_bias",
        .title = "Left and right",
        .note =
            "How often the video on the left was preferred, of decided votes, whatever it showed; exact "
            "interval, and exact test of one half. Both take votes as independent, though a participant "
            "may have a favourite side",
        .columns = {{"question", "question"},
                    {"left", "left", Show::whole},
                    {"right", "right", Show::whole},
                    {"share", "share of left", Show::percent},
                    {"share_low", "95 %", Show::percent},
                    {"share_high", "", Show::percent},
                    {"p", "p", Show::p}}};
    for (const VoteResult& result : of.results.votes) {
        const std::size_t decided = result.side.left + result.side.right;
        if (decided == 0) continue;
        Row row = {of.question(result.question), result.side.left, result.side.right,
                   static_cast<double>(result.side.left) / static_cast<double>(decided)};
        append(row, exact_share_95(result.side.left, decided));
        row.push_back(result.side.p);
        table.rows.push_back(std::move(row));
    }
    return table;
}

void append_share(Row& row, std::size_t chosen, std::size_t of) {
    row.insert(row.end(), {Cell(chosen), Cell(of)});
    row.push_back(of > 0 ? std::optional(static_cast<double>(chosen) / static_cast<double>(of))
                         : std::nullopt);
    append(row, of > 0 ? std::optional(exact_share_95(chosen, of)) : std::nullopt);
}

Table reasons_table(const TableSource& of) {
    Table table{
        .id = "reasons",
        .title = "Reasons",
        .note =
            "How often each reason was chosen, of the answers that gave any; exact intervals, which take "
            "answers as independent",
        .columns =
            columns_of_share({{"question", "question"}, {"reason", "reason"}, {"text", "text"}}, "chosen")};
    for (const VoteResult& result : of.results.votes) {
        for (const ReasonCount& reason : result.reasons) {
            Row row = {of.question(result.question), reason.reason, reason.text};
            append_share(row, reason.chosen, reason.of);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table choices_table(const TableSource& of) {
    Table table{.id = "choices",
                .title = "Choices",
                .note =
                    "How often each option was chosen, of the answers on pages that showed the same; exact "
                    "intervals, which take answers as independent",
                .columns = columns_of_share(
                    {{"question", "question"}, {"shown", "shown"}, {"option", "option"}}, "chosen")};
    for (const ChoiceResult& result : of.results.choices) {
        for (const OptionCount& option : result.options) {
            Row row = {of.question(result.question), result.shown, option.text};
            append_share(row, option.chosen, option.of);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table right_table(const TableSource& of) {
    Table table{
        .id = "right_answers",
        .title = "Right answers",
        .note =
            "How often the answer is the one that is right by the design, of a ranking which video is "
            "put first; exact intervals, which take answers as independent; guesses are right as "
            "often as chance says",
        .columns = columns_of_share({{"question", "question"}, {"answer", "right answer"}}, "right")};
    table.columns.push_back({"chance", "chance", Show::percent});
    for (const RightResult& result : of.results.right) {
        Row row = {of.question(result.question), result.answer};
        append_share(row, result.right, result.of);
        row.push_back(result.chance);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table published_table(const TableSource& of) {
    Table table{
        .id = "right_published",
        .title = "Right answers beside the published ones",
        .note = "",
        .columns = columns_of_share({{"question", "question"}, {"answer", "what is right"}}, "right")};
    table.columns.insert(table.columns.end(),
                         {{"chance", "chance", Show::percent}, {"published", "published", Show::percent}});
    for (const RightResult& result : of.results.published) {
        const PublishedTable& source =
            *published_answers(of.data.preset, of.data.questions[result.question].id);
        table.note = format("Published: {}, {}. {}. {} Exact intervals, which take answers as independent",
                            source.source, source.place, source.corpus, source.note);
        Row row = {of.question(result.question), result.answer};
        append_share(row, result.right, result.of);
        row.insert(row.end(), {Cell(result.chance), Cell(result.published)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::vector<Table> tables_of(const Dataset& data, const Results& results) {
    const TableSource of{data, results};
    std::vector<Table> tables = {scores_table(of),      cronbach_table(of),
                                 friedman_table(of),    repeated_anova_table(of),
                                 anova_table(of),       paired_table(of),
                                 wilcoxon_table(of),    welch_table(of),
                                 lsd_table(of),         factors_table(of),
                                 rater_votes_table(of), votes_table(of),
                                 elo_table(of),         contrasts_table(of),
                                 reasons_table(of),     right_table(of),
                                 published_table(of),   published_results_table(of),
                                 choices_table(of),     sides_table(of),
                                 alpha_table(of),       icc_table(of)};
    std::erase_if(tables, [](const Table& table) { return table.rows.empty(); });
    return tables;
}

}  // namespace chironomia::study::analysis
