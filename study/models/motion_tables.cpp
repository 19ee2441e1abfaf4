// The tables of what was measured of motions.
#include <algorithm>
#include <optional>
#include <utility>

#include "study/models/evaluation_motion.h"

namespace chironomia::study {
namespace {

struct MeasureColumn {
    const char* key;
    const char* title;
    analysis::Show show = analysis::Show::three;
};

struct MeasureTable {
    std::string id;
    std::string title;
    const std::vector<Json> MotionMeasures::*rows;
    const std::vector<MeasureColumn>& columns;
};

// A row for each object; columns that no row has are left out.
std::optional<analysis::Table> table_of(const MeasureTable& wanted, const std::vector<MotionMeasures>& all) {
    const auto rows = wanted.rows;
    analysis::Table table{
        .id = wanted.id, .title = wanted.title, .note = "", .columns = {{"motion", "Motion"}}};
    std::vector<MeasureColumn> used;
    for (const MeasureColumn& column : wanted.columns) {
        const bool has = std::any_of(all.begin(), all.end(), [&](const MotionMeasures& one) {
            return std::any_of((one.*rows).begin(), (one.*rows).end(),
                               [&](const Json& row) { return row.contains(column.key); });
        });
        if (!has) continue;
        used.push_back(column);
        table.columns.push_back({column.key, column.title, column.show});
    }
    for (const MotionMeasures& one : all) {
        for (const Json& row : one.*rows) {
            std::vector<analysis::Cell> cells = {one.source};
            for (const MeasureColumn& column : used) {
                const Json value = row.value(column.key, Json());
                if (value.is_string()) {
                    cells.emplace_back(value.get<std::string>());
                } else {
                    cells.emplace_back(value.is_number() ? std::optional(value.get<double>()) : std::nullopt);
                }
            }
            table.rows.push_back(std::move(cells));
        }
    }
    return table.rows.empty() ? std::nullopt : std::optional(std::move(table));
}

const std::vector<MeasureColumn> kBodyColumns = {
    {"points", "Points", analysis::Show::whole},
    {"unit", "Unit", analysis::Show::text},
    {"missing", "Missing", analysis::Show::percent},
    {"velocity", "Velocity"},
    {"acceleration", "Acceleration"},
    {"jerk", "Jerk", analysis::Show::one},
    {"wrist_velocity", "Wrist velocity"},
    {"wrist_acceleration", "Wrist acceleration"},
    {"wrist_jerk", "Wrist jerk", analysis::Show::one},
    {"box", "Box"},
    {"extent", "Extent"},
};
const std::vector<MeasureColumn> kFaceColumns = {{"feature", "Feature", analysis::Show::text},
                                                 {"missing", "Missing", analysis::Show::percent},
                                                 {"mean", "Mean"},
                                                 {"sd", "SD"},
                                                 {"per_second", "Change/s"},
                                                 {"active", "Active", analysis::Show::percent}};
const std::vector<MeasureColumn> kNearColumns = {
    {"feature", "Feature", analysis::Show::text},
    {"frames", "Frames", analysis::Show::whole},
    {"rmse", "RMSE"},
    {"mae", "MAE"},
    {"pcc", "PCC"},
    {"ahr", "AHR", analysis::Show::one},
    {"nahr", "NAHR", analysis::Show::one},
    {"precision", "Precision", analysis::Show::two},
    {"recall", "Recall", analysis::Show::two},
    {"ks", "KS"},
    {"ks_p", "p of KS", analysis::Show::p},
    {"minkowski_1", "Minkowski 1"},
    {"minkowski_2", "Minkowski 2"},
    {"minkowski_3", "Minkowski 3"},
    {"content", "Content preservation [%]", analysis::Show::one},
    {"content_centred", "centred [%]", analysis::Show::one},
    {"l1", "L1"},
    {"velocity_l1", "Velocity L1", analysis::Show::three},
    {"pck_01", "PCK .1"},
    {"pck_02", "PCK .2"},
    {"frechet", "Frechet"},
    {"velocity_frechet", "of velocities"},
};
const std::vector<MeasureColumn> kStyleColumns = {
    {"metric", "Metric", analysis::Show::text},
    {"source", "Source"},
    {"target", "Target"},
    {"model", "Model"},
    {"dist_avg_source", "Dist_avg of source [%]", analysis::Show::one},
    {"dist_avg_model", "of model [%]", analysis::Show::one}};
const std::vector<MeasureColumn> kPairColumns = {{"tlcc", "TLCC"},
                                                 {"lag", "Lag [s]", analysis::Show::two},
                                                 {"dtw", "DTW", analysis::Show::one},
                                                 {"sync", "Sync [s/min] (proposed)", analysis::Show::one},
                                                 {"el", "EL [s/min] (proposed)", analysis::Show::one}};
const std::vector<MeasureColumn> kBeatColumns = {{"beats", "Beats of the motion", analysis::Show::whole},
                                                 {"onsets", "Onsets of the sound", analysis::Show::whole},
                                                 {"alignment", "Beat alignment (BC)"},
                                                 {"chance", "by chance"}};

}  // namespace

std::vector<analysis::Table> tables_of(const std::vector<MotionMeasures>& all) {
    std::vector<analysis::Table> tables;
    const auto add = [&](std::optional<analysis::Table> table) {
        if (table) tables.push_back(std::move(*table));
    };
    add(table_of(
        {.id = "body",
         .title = "How bodies move, relative to the neck or the middle of the shoulders [shoulder widths, s]",
         .rows = &MotionMeasures::body,
         .columns = kBodyColumns},
        all));
    add(table_of({.id = "face",
                  .title = "How faces move [intensities, rad]",
                  .rows = &MotionMeasures::face,
                  .columns = kFaceColumns},
                 all));
    add(table_of({.id = "near",
                  .title = "Against the reference [intensities, rad, shoulder widths]",
                  .rows = &MotionMeasures::near,
                  .columns = kNearColumns},
                 all));
    add(table_of({.id = "style",
                  .title = "How near the style comes to the reference's [shoulder widths, s]",
                  .rows = &MotionMeasures::style,
                  .columns = kStyleColumns},
                 all));
    add(table_of({.id = "pair",
                  .title = "Smiles (AU12) of both people",
                  .rows = &MotionMeasures::pair,
                  .columns = kPairColumns},
                 all));
    add(table_of({.id = "beats",
                  .title = "Beats of motion and sound (sigma 0.05 s)",
                  .rows = &MotionMeasures::beats,
                  .columns = kBeatColumns},
                 all));
    return tables;
}

Json to_json(const MotionMeasures& measures) {
    return {{"motion", measures.source}, {"body", measures.body},   {"face", measures.face},
            {"near", measures.near},     {"style", measures.style}, {"pair", measures.pair},
            {"beats", measures.beats},   {"notes", measures.notes}};
}

}  // namespace chironomia::study
