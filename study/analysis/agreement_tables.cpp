#include "study/analysis/agreement_tables.h"

namespace chironomia::study::analysis {
namespace {

const char* name_of(ValueScale scale) {
    return scale == ValueScale::nominal ? "nominal" : scale == ValueScale::ordinal ? "ordinal" : "interval";
}

}  // namespace

Table cronbach_table(const TableSource& of) {
    Table table{
        .id = "cronbach",
        .title = "Cronbach's alpha",
        .note =
            "Of the answers that have all items of the scale, also several of one participant; reversed items "
            "are turned round. Over all conditions it counts their differences, too: where they differ, it is "
            "greater than within them",
        .columns = {{"question", "scale"},
                    {"condition", "condition"},
                    {"items", "items", Show::whole},
                    {"answers", "answers", Show::whole},
                    {"alpha", "alpha", Show::three}}};
    for (const ReliabilityResult& result : of.results.reliability)
        table.rows.push_back({of.question(result.question), result.cell ? of.cell(*result.cell) : "all",
                              result.items, result.answers, result.alpha});
    return table;
}

Table alpha_table(const TableSource& of) {
    Table table{.id = "agreement",
                .title = "Agreement",
                .note =
                    "Krippendorff's alpha over the pages that at least two participants answered; 1 is full "
                    "agreement, 0 is chance; the interval is from pages and participants that are resampled "
                    "together, both taken as independent",
                .columns = {{"question", "question"},
                            {"scale", "scale"},
                            {"units", "pages or videos", Show::whole},
                            {"ratings", "answers", Show::whole},
                            {"alpha", "alpha", Show::three},
                            {"alpha_low", "95 %", Show::three},
                            {"alpha_high", "", Show::three}}};
    for (const AgreementResult& result : of.results.agreement) {
        if (!result.alpha) continue;
        Row row = {of.question(result.question), name_of(result.scale), result.alpha->units,
                   result.alpha->ratings, result.alpha->alpha};
        append(row, result.alpha->alpha_95);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table icc_table(const TableSource& of) {
    Table table{
        .id = "intraclass",
        .title = "Intraclass correlations",
        .note =
            "Of each group of participants who rated the same: ICC(2,1) of one of many raters, ICC(2,k) of "
            "their mean, ICC(3,1) of these raters alone. Intervals take answers less the means of pages "
            "and raters as normal",
        .columns = {{"question", "question"},
                    {"group", "group", Show::whole},
                    {"targets", "pages or videos", Show::whole},
                    {"raters", "raters", Show::whole},
                    {"icc_2_1", "ICC(2,1)", Show::three},
                    {"icc_2_1_low", "95 %", Show::three},
                    {"icc_2_1_high", "", Show::three},
                    {"icc_2_k", "ICC(2,k)", Show::three},
                    {"icc_2_k_low", "95 %", Show::three},
                    {"icc_2_k_high", "", Show::three},
                    {"icc_3_1", "ICC(3,1)", Show::three},
                    {"icc_3_1_low", "95 %", Show::three},
                    {"icc_3_1_high", "", Show::three}}};
    for (const AgreementResult& result : of.results.agreement) {
        for (std::size_t group = 0; group < result.intraclass.size(); ++group) {
            const IntraclassCorrelations& icc = result.intraclass[group];
            Row row = {of.question(result.question), group + 1, icc.targets, icc.raters};
            for (const Correlation* each : {&icc.one_rater, &icc.mean_rating, &icc.fixed_rater}) {
                row.push_back(each->value);
                append(row, each->value_95);
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

}  // namespace chironomia::study::analysis
