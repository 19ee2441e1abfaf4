#include "study/analysis/questionnaire_tables.h"

#include <algorithm>

#include "study/measure/descriptive.h"

namespace chironomia::study::analysis {
namespace {

// The answers to a question; open ones are left out.
std::vector<Json> answers_to(const Dataset& data, const std::vector<std::string>& excluded,
                             const Question& question) {
    std::vector<Json> answers;
    for (std::size_t i = 0; i < data.raters.size(); ++i) {
        const Json value = data.raters[i].questionnaire.value(question.id, Json());
        if (excluded[i].empty() && !value.is_null()) answers.push_back(value);
    }
    return answers;
}

Table table_of_numbers(const Dataset& data, const std::vector<std::string>& excluded) {
    Table table{.id = "questionnaire_numbers",
                .title = "Questions at the end: numbers",
                .note = "Of the participants who answered",
                .columns = {{"question", "question"},
                            {"n", "n", Show::whole},
                            {"mean", "mean", Show::two},
                            {"sd", "sd", Show::two},
                            {"median", "median", Show::two},
                            {"least", "min", Show::two},
                            {"most", "max", Show::two}}};
    for (const Question& question : data.questionnaire) {
        std::vector<double> numbers;
        for (const Json& value : answers_to(data, excluded, question)) {
            if (value.is_number()) numbers.push_back(value.get<double>());
        }
        if (numbers.empty()) continue;
        const Summary summary = summarize(numbers);
        table.rows.push_back({question.id, summary.n, summary.mean, Cell(summary.sd), summary.median,
                              summary.least, summary.most});
    }
    return table;
}

Table table_of_choices(const Dataset& data, const std::vector<std::string>& excluded) {
    Table table{.id = "questionnaire_choices",
                .title = "Questions at the end: choices",
                .note = "Of the participants who answered",
                .columns = {{"question", "question"},
                            {"option", "option"},
                            {"text", "text"},
                            {"chosen", "chosen", Show::whole},
                            {"of", "of", Show::whole},
                            {"share", "share", Show::percent}}};
    for (const Question& question : data.questionnaire) {
        if (question.kind != QuestionKind::choice) continue;
        const std::vector<Json> answers = answers_to(data, excluded, question);
        if (answers.empty()) continue;
        for (const QuestionOption& option : question.options) {
            const auto chosen =
                static_cast<std::size_t>(std::count(answers.begin(), answers.end(), Json(option.id)));
            table.rows.push_back({question.id, option.id, option.text, chosen, answers.size(),
                                  static_cast<double>(chosen) / static_cast<double>(answers.size())});
        }
    }
    return table;
}

}  // namespace

std::vector<Table> tables_of_questionnaire(const Dataset& data, const std::vector<std::string>& excluded) {
    std::vector<Table> tables = {table_of_numbers(data, excluded), table_of_choices(data, excluded)};
    std::erase_if(tables, [](const Table& table) { return table.rows.empty(); });
    return tables;
}

Table table_of_questionnaire(const Dataset& data, const std::vector<std::string>& strict,
                             const std::vector<std::string>& lenient) {
    Table table{
        .id = "questionnaire",
        .title = "Answers at the end",
        .note = "",
        .columns = {{"participant", ""}, {"question", ""}, {"value", ""}, {"strict", ""}, {"lenient", ""}}};
    const auto counted = [](const std::string& reason) { return reason.empty() ? "counted" : "excluded"; };
    for (std::size_t i = 0; i < data.raters.size(); ++i) {
        for (const Question& question : data.questionnaire) {
            const Json value = data.raters[i].questionnaire.value(question.id, Json());
            if (value.is_null()) continue;
            table.rows.push_back({data.raters[i].name, question.id,
                                  value.is_string() ? value.get<std::string>() : value.dump(),
                                  counted(strict[i]), counted(lenient[i])});
        }
    }
    return table;
}

}  // namespace chironomia::study::analysis
