#include "study/analysis/dataset_tables.h"

#include <cmath>

#include "core/files/json.h"
#include "core/text.h"
#include "study/analysis/simulated_rater.h"
#include "study/measure/descriptive.h"

namespace chironomia::study::analysis {
namespace {

std::string counted_or(const std::string& reason) {
    return reason.empty() ? "counted" : reason;
}

const char* counted_or_excluded(const std::string& reason) {
    return reason.empty() ? "counted" : "excluded";
}

}  // namespace

Table table_of_participants(const Dataset& data, const std::vector<std::string>& strict,
                            const std::vector<std::string>& lenient) {
    Table table{
        .id = "participants",
        .title = "Participants",
        .note = "Whether their answers count under the strict and the lenient rule, or why they are excluded",
        .columns = {{"participant", "participant"},
                    {"finished", "finished"},
                    {"answered", "pages", Show::whole},
                    {"skipped", "skipped", Show::whole},
                    {"failed_checks", "failed checks", Show::whole},
                    {"median_seconds", "median seconds", Show::two},
                    {"strict", "strict"},
                    {"lenient", "lenient"}}};
    for (std::size_t i = 0; i < data.raters.size(); ++i) {
        const Rater& rater = data.raters[i];
        table.rows.push_back({rater.name, rater.finished ? "yes" : "no", rater.answered, rater.skipped,
                              rater.failed.size(), rater.median_seconds, counted_or(strict[i]),
                              counted_or(lenient[i])});
    }
    return table;
}

Table table_of_answers(const Dataset& data, const std::vector<std::string>& strict,
                       const std::vector<std::string>& lenient) {
    Table table{.id = "answers",
                .title = "Answers",
                .note = "",
                .columns = {{"participant", ""},
                            {"block", "", Show::whole},
                            {"trial", "", Show::whole},
                            {"kind", ""},
                            {"clip", ""},
                            {"conditions_left_to_right", ""},
                            {"question", ""},
                            {"value", ""},
                            {"value_in_order_of_key", ""},
                            {"seconds", "", Show::two},
                            {"strict", ""},
                            {"lenient", ""}}};
    for (const AnswerRow& row : data.rows) {
        table.rows.push_back({data.raters[row.participant].name, row.block, row.trial, to_text(row.kind),
                              row.clip, row.conditions, data.questions[row.question].id, row.value,
                              row.value_of_places, row.seconds, counted_or_excluded(strict[row.participant]),
                              counted_or_excluded(lenient[row.participant])});
    }
    return table;
}

Table table_of_scale_scores(const Dataset& data, const std::vector<std::string>& strict,
                            const std::vector<std::string>& lenient) {
    Table table{.id = "scale_scores",
                .title = "Scores of scales",
                .note = "",
                .columns = {{"participant", ""},
                            {"clip", ""},
                            {"condition", ""},
                            {"scale", ""},
                            {"score", "", Show::two},
                            {"strict", ""},
                            {"lenient", ""}}};
    for (const ScaleAnswer& answer : data.scale_answers) {
        table.rows.push_back({data.raters[answer.participant].name, answer.clip, data.cells[answer.cell],
                              data.questions[answer.question].id, mean_of(answer.items),
                              counted_or_excluded(strict[answer.participant]),
                              counted_or_excluded(lenient[answer.participant])});
    }
    return table;
}

Table table_of_battles(const Dataset& data, std::size_t question) {
    Table table{.id = "battles",
                .title = "Battles",
                .note = "",
                .columns = {{"user", ""},
                            {"input_code", ""},
                            {"model_a", ""},
                            {"model_b", ""},
                            {"winner", ""},
                            {"is_strong", ""},
                            {"juiceOptions", ""},
                            {"juiceOtherReason", ""}}};
    for (const Preference& each : data.preferences) {
        if (each.question != question) continue;
        const std::size_t right = each.left == each.first ? each.second : each.first;
        const std::size_t winner = each.strength > 0 ? each.first : each.second;
        const std::string user = data.raters[each.participant].name;
        table.rows.push_back({data.simulated ? format("{} {}", kSimulatedRaters, user) : user, each.clip,
                              data.conditions[each.left].name, data.conditions[right].name,
                              each.strength == 0    ? "tie"
                              : winner == each.left ? "model_a"
                                                    : "model_b",
                              each.strength == 0            ? ""
                              : std::abs(each.strength) > 1 ? "True"
                                                            : "False",
                              Json(each.reasons).dump(), each.other_reason});
    }
    return table;
}

}  // namespace chironomia::study::analysis
