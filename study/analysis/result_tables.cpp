#include "study/analysis/result_tables.h"

#include <algorithm>

#include "core/text.h"
#include "study/analysis/agreement_tables.h"
#include "study/analysis/published_table.h"
#include "study/analysis/score_tables.h"
#include "study/measure/proportions.h"
#include "study/published/published.h"

namespace chironomia::study::analysis {
namespace {

// Filled by append_share().
std::vector<Column> columns_of_share(std::vector<Column> columns, const char* counted) {
    columns.insert(columns.end(), {{counted, counted, Show::whole},
                                   {"of", "of", Show::whole},
                                   {"share", "share", Show::percent},
                                   {"share_low", "95 %", Show::percent},
                                   {"share_high", "", Show::percent}});
    return columns;
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
            "is that of how strongly, in steps of the question from equal (of five answers from -2, clearly the "
            "second, to 2, clearly the first, as the mean appropriateness score of GENEA 2023); p is "
            "of Fisher's randomization test of each participant's wins less losses as a share of their votes, and "
            "Holm's is adjusted for all pairs of the question. Participants are taken as independent, and as likely "
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
            "(ties half, others by their steps from equal, so that clear ones of five answers count double) is from "
            "resampled participants; clear answers are those that are further from equal than one step",
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
        const auto label = [&](std::size_t first, std::size_t second) {
            return format("{} over {}", of.condition(first), of.condition(second));
        };
        for (const VoteContrast& contrast : result.contrasts) {
            const VotePair &a = result.pairs[contrast.first], &b = result.pairs[contrast.second];
            const bool turned = contrast.turned;
            table.rows.push_back(
                {of.question(result.question), label(a.first, a.second), a.wins, a.wins + a.losses,
                 turned ? label(b.second, b.first) : label(b.first, b.second), turned ? b.losses : b.wins,
                 b.wins + b.losses, contrast.p, contrast.holm_p});
        }
    }
    return table;
}

// In a group without bounds some conditions won every comparison with the rest; often that is one condition.
const char* bounded_text(const EloTable& elo, const EloRow& row) {
    if (elo.finite) return "yes";
    if (row.won_all) return "no: won all";
    if (row.lost_all) return "no: lost all";
    return "no: some conditions won every comparison with the rest";
}

Table elo_table(const TableSource& of) {
    Table table{
        .id = "elo",
        .title = "Strengths on the scale of Elo",
        .note =
            "Bradley-Terry by weighted logistic regression, 4 for a clear answer, 2 for a slight one (2 for each "
            "step from equal), 1 to either for a tie; all votes of a group count, also those between a condition and "
            "what is made of it, but a group of two such has a share instead; 1000 is the mean of a group; 200 more "
            "are preferred in 76 % of votes where a question has two answers, and in another share where it has ties "
            "or clear answers; intervals of 95 % from resampled participants, who are taken as independent; an end "
            "that more than 2.5 % of the resamples leave without bound is a dash; the clips are taken as given",
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
    std::vector<Table> tables = score_tables(of);
    for (const auto table_of :
         {rater_votes_table, votes_table, elo_table, contrasts_table, reasons_table, right_table,
          published_table, published_results_table, choices_table, sides_table, alpha_table, icc_table})
        tables.push_back(table_of(of));
    std::erase_if(tables, [](const Table& table) { return table.rows.empty(); });
    return tables;
}

}  // namespace chironomia::study::analysis
