#include "study/analysis/published_table.h"

#include <functional>
#include <map>
#include <utility>

#include "core/text.h"
#include "study/published/published.h"

namespace chironomia::study::analysis {
namespace {

// Of whom a number is, and the number.
using Found = std::pair<std::string, double>;

std::vector<Found> of_cells(const TableSource& of, std::size_t question,
                            const std::function<double(const Summary&)>& statistic) {
    std::vector<Found> found;
    for (const ScoreResult& result : of.results.scores) {
        if (result.question != question) continue;
        for (const CellResult& cell : result.cells)
            found.emplace_back(of.cell(cell.cell), statistic(cell.participants));
    }
    return found;
}

std::vector<Found> differences(const TableSource& of, std::size_t question) {
    std::vector<Found> found;
    for (const ScoreResult& result : of.results.scores) {
        if (result.question != question) continue;
        for (const CellPair& pair : result.pairs)
            if (pair.paired)
                found.emplace_back(format("{} less {}", of.cell(pair.first), of.cell(pair.second)),
                                   pair.paired->difference);
    }
    return found;
}

std::vector<Found> shares(const TableSource& of, std::size_t question) {
    std::vector<Found> found;
    for (const VoteResult& result : of.results.votes) {
        if (result.question != question) continue;
        for (const VotePair& pair : result.pairs)
            found.emplace_back(format("{} over {}", of.condition(pair.first), of.condition(pair.second)),
                               pair.raters.share);
    }
    return found;
}

// Ours by the name that published rows have for it.
std::map<std::string, std::vector<Found>> statistics_of(const TableSource& of, std::size_t question) {
    return {{"mean", of_cells(of, question, [](const Summary& s) { return s.mean; })},
            {"median", of_cells(of, question, [](const Summary& s) { return s.median; })},
            {"sd", of_cells(of, question, [](const Summary& s) { return s.sd.value_or(0); })},
            {"least", of_cells(of, question, [](const Summary& s) { return s.least; })},
            {"most", of_cells(of, question, [](const Summary& s) { return s.most; })},
            {"difference", differences(of, question)},
            {"share", shares(of, question)}};
}

}  // namespace

Table published_results_table(const TableSource& of) {
    Table table{.id = "published",
                .title = "Beside the published results",
                .note = "",
                .columns = {{"question", "question"},
                            {"of", "of"},
                            {"statistic", "statistic"},
                            {"ours", "ours", Show::two},
                            {"published", "published", Show::two},
                            {"published_of", "published of"}}};
    for (std::size_t question = 0; question < of.data.questions.size(); ++question) {
        const auto ours = statistics_of(of, question);
        for (const PublishedTable& source : published_tables()) {
            for (const PublishedRow& row : source.rows) {
                const auto printed = row.values.find(of.question(question));
                if (row.preset.empty() || row.preset != of.data.preset || printed == row.values.end())
                    continue;
                for (const auto& [whose, value] : ours.at(row.statistic))
                    table.rows.push_back(
                        {of.question(question), whose, row.statistic, value, printed->second, row.name});
                table.note = format(
                    "Ours over participants, of two conditions for the first in the order of the plan, of a "
                    "triplet how alike it is to the reference. Published: {}, {}. Measured on other people and "
                    "motions. {}",
                    source.source, source.place, source.note);
            }
        }
    }
    return table;
}

}  // namespace chironomia::study::analysis
