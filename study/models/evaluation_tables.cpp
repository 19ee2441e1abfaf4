#include "study/models/evaluation_tables.h"

#include <algorithm>
#include <utility>

#include "core/files/files.h"
#include "core/text.h"
#include "study/measure/adaptation.h"
#include "study/published/published.h"

namespace chironomia::study {

using analysis::Cell;
using analysis::Column;
using analysis::Show;
using analysis::Table;

namespace {

struct ShownMetric {
    std::string key;
    std::string title;
    Show show = Show::three;
};

const std::vector<ShownMetric> kOverall = {{"mae", "MAE"}, {"rmse", "RMSE"}, {"pcc", "PCC"}, {"ks", "KS"}};
const std::vector<ShownMetric> kOfFeatures = {
    {"rmse", "RMSE"},
    {"rmse_raw", "RMSE raw"},
    {"mae", "MAE"},
    {"pcc", "PCC"},
    {"pcc_utterance", "PCC/utterance"},
    {"ahr", "AHR", Show::one},
    {"nahr", "NAHR", Show::one},
    {"precision", "Precision", Show::two},
    {"recall", "Recall", Show::two},
    {"ks", "KS"},
};

std::vector<ShownMetric> pair_metrics() {
    std::vector<ShownMetric> metrics = {{"tlcc", "TLCC"}, {"dtw", "DTW", Show::one}};
    for (const AdaptationMeasure& measure : adaptation_measures())
        metrics.push_back(
            {measure.key, format("{} [{}] ({})", measure.title, measure.unit, measure.origin), Show::one});
    return metrics;
}

// By a definition of ours: what is published is another number.
bool is_proposed(const ShownMetric& metric) {
    const std::vector<AdaptationMeasure>& measures = adaptation_measures();
    return std::any_of(measures.begin(), measures.end(), [&](const AdaptationMeasure& measure) {
        return measure.key == metric.key && measure.origin == "proposed";
    });
}

// Rows that are made metric by metric: value, interval, what is published.
class MetricTable {
  public:
    explicit MetricTable(Table table) : table_(std::move(table)) {}

    void begin_row(std::vector<Cell> cells) {
        table_.rows.push_back(std::move(cells));
        is_first_ = table_.rows.size() == 1;
    }
    void add_cell(const Column& column, Cell cell) {
        if (is_first_) table_.columns.push_back(column);
        table_.rows.back().push_back(std::move(cell));
    }
    void add_score(const ShownMetric& metric, const Bootstrapped* result) {
        std::optional<double> low, high;
        if (result && result->ci_95) {
            low = result->ci_95->low;
            high = result->ci_95->high;
        }
        add_cell({metric.key, metric.title, metric.show}, result ? result->value : std::nullopt);
        add_cell({metric.key + "_low", "95 %", metric.show}, low);
        add_cell({metric.key + "_high", "95 %", metric.show}, high);
    }
    void add_published(const ShownMetric& metric, const std::string& model, const std::string& feature) {
        add_cell({metric.key + "_published", metric.title + " published", metric.show},
                 published_value(model, feature, metric.key));
    }

    // Without columns of published values that no row has.
    Table finish() {
        for (std::size_t c = table_.columns.size(); c-- > 0;) {
            if (!table_.columns[c].key.ends_with("_published")) continue;
            if (std::any_of(table_.rows.begin(), table_.rows.end(),
                            [&](const std::vector<Cell>& row) { return row[c].number.has_value(); }))
                continue;
            const auto at = static_cast<std::ptrdiff_t>(c);
            table_.columns.erase(table_.columns.begin() + at);
            for (auto& row : table_.rows) row.erase(row.begin() + at);
        }
        return std::move(table_);
    }

  private:
    Table table_;
    bool is_first_ = true;
};

const Bootstrapped* find_score(const std::vector<MetricScore>& scores, const std::string& metric) {
    const auto found =
        std::find_if(scores.begin(), scores.end(), [&](const MetricScore& s) { return s.metric == metric; });
    return found == scores.end() ? nullptr : &found->result;
}

std::string where(const Evaluation& evaluation) {
    return format("{}, {}", evaluation.corpus, evaluation.split);
}

Table summary_of(const Evaluation& evaluation) {
    MetricTable table(
        {.id = "summary",
         .title = format("All features together ({})", where(evaluation)),
         .note = format(
             "Means over features on the normalised scale, PCC over those of which all systems have one, "
             "with 95 % intervals from {} resamples of the records.",
             evaluation.options.resampling.samples),
         .columns = {{"model", "Model"}, {"n", "n", Show::whole}, {"frames", "Frames", Show::whole}}});
    for (const SystemScores& system : evaluation.systems) {
        if (system.overall.empty()) continue;
        table.begin_row({system.model, system.items, system.frames});
        for (const ShownMetric& metric : kOverall) {
            table.add_score(metric, find_score(system.overall, metric.key));
            table.add_published(metric, system.model, "");
        }
    }
    return table.finish();
}

Table features_of(const Evaluation& evaluation) {
    MetricTable table(
        {.id = "features",
         .title = format("Feature by feature ({})", where(evaluation)),
         .note = "RMSE, MAE and KS on the normalised scale; PCC over all frames, and its mean over the "
                 "utterances in which both vary; AHR and NAHR of action units [%]. The p of KS takes frames "
                 "for independent, which they are not.",
         .columns = {{"model", "Model"},
                     {"feature", "Feature"},
                     {"n", "n", Show::whole},
                     {"frames", "Frames", Show::whole}}});
    for (const SystemScores& system : evaluation.systems) {
        for (const FeatureScores& feature : system.features) {
            table.begin_row({system.model, feature.feature, system.items, system.frames});
            for (const ShownMetric& metric : kOfFeatures) {
                table.add_score(metric, find_score(feature.scores, metric.key));
                table.add_published(metric, system.model, feature.feature);
            }
            table.add_cell({"utterances_without_pcc", "no PCC", Show::whole}, feature.utterances_without_pcc);
            table.add_cell({"ks_p", "p of KS", Show::p}, feature.ks_p);
        }
    }
    return table.finish();
}

Table pairs_of(const Evaluation& evaluation) {
    MetricTable table(
        {.id = "pairs",
         .title = format("Smiles of two people (AU12; {})", where(evaluation)),
         .note = "Of a person, or of the model in the person's place, with the partner; nearer to people is "
                 "better. Gap: model less people, over the same resamples. DTW in intensities summed over "
                 "60 s; Sync and EL [s/min] by our own definitions, not those of the published numbers.",
         .columns = {{"model", "Model"}, {"n", "n", Show::whole}, {"frames", "Frames", Show::whole}}});
    for (const SystemScores& system : evaluation.systems) {
        if (!system.pair) continue;
        table.begin_row({system.model, system.items, system.frames});
        for (const ShownMetric& metric : pair_metrics()) {
            table.add_score(metric, find_score(system.pair->scores, metric.key));
            const ShownMetric gap{metric.key + "_gap", "Gap", metric.show};
            table.add_score(gap, find_score(system.pair->gaps, metric.key));
            if (!is_proposed(metric)) table.add_published(metric, system.model, "");
        }
    }
    return table.finish();
}

Table poses_of_systems(const Evaluation& evaluation) {
    MetricTable table(
        {.id = "poses",
         .title = format("Poses in the speakers' own style ({})", where(evaluation)),
         .note =
             "L1 of the points [px] and of their change [px/frame]; PCK, the share of points that lie nearer than 0.1, "
             "or 0.2, of the larger side of the body's box; Frechet's distance of all poses [px^2].",
         .columns = {{"model", "Model"}, {"n", "Clips", Show::whole}}});
    for (const SystemScores& system : evaluation.systems) {
        if (!system.poses) continue;
        table.begin_row({system.model, system.poses->clips});
        table.add_score({"l1", "L1", Show::two}, &system.poses->l1);
        table.add_score({"velocity_l1", "Velocity L1", Show::two}, &system.poses->velocity_l1);
        table.add_score({"pck_01", "PCK .1"}, &system.poses->pck_01);
        table.add_score({"pck_02", "PCK .2"}, &system.poses->pck_02);
        table.add_cell({"frechet", "Frechet", Show::one}, system.poses->frechet);
    }
    return table.finish();
}

// Dist_avg of each metric: the source less the target, and the model less the target, in parts of both.
Table style_distances_of(const Evaluation& evaluation) {
    Table table{
        .id = "styles",
        .title = format("Nearness to the target style ({})", where(evaluation)),
        .note =
            "Dist_avg [%]: how far the source, and the model, are from the target; they sum to 100. p of "
            "Fisher's least significant difference, which takes clips for independent.",
        .columns = {{"model", "Model"},
                    {"metric", "Metric"},
                    {"n", "Clips", Show::whole},
                    {"source", "Source", Show::one},
                    {"ours", "Model [%]", Show::one},
                    {"ours_low", "95 %", Show::one},
                    {"ours_high", "95 %", Show::one},
                    {"p", "p", Show::p}}};
    for (const SystemScores& system : evaluation.systems) {
        if (!system.style) continue;
        for (std::size_t m = 0; m < kStyleMetricNames.size(); ++m) {
            const auto& distance = system.style->distances[m];
            if (!distance) continue;
            const auto low = distance->model_95 ? std::optional(distance->model_95->low) : std::nullopt;
            const auto high = distance->model_95 ? std::optional(distance->model_95->high) : std::nullopt;
            const auto p = distance->difference ? std::optional(distance->difference->p) : std::nullopt;
            table.rows.push_back({system.model, std::string(kStyleMetricNames[m]), distance->clips,
                                  distance->source, distance->model, low, high, p});
        }
    }
    return table;
}

Table transfers_of(const Evaluation& evaluation) {
    MetricTable table(
        {.id = "transfers",
         .title = format("Clips in the style of other speakers ({})", where(evaluation)),
         .note =
             "Content: likeness to the source, as printed and with means taken off [%]. Minkowski's distance of "
             "order 3 [px] to the source and to a clip of the target. Timing: correlation of the wrists' speeds with "
             "the source's; by chance: with shuffled sources.",
         .columns = {{"model", "Model"}, {"n", "Clips", Show::whole}}});
    for (const SystemScores& system : evaluation.systems) {
        if (!system.style) continue;
        const StyleScores& style = *system.style;
        table.begin_row({system.model, style.clips});
        table.add_score({"content", "Content", Show::one}, &style.content);
        table.add_score({"content_centred", "Content, centred", Show::one}, &style.content_centred);
        table.add_score({"minkowski_source", "Minkowski to source", Show::one}, &style.minkowski_source);
        table.add_score({"minkowski_target", "Minkowski to target", Show::one}, &style.minkowski_target);
        table.add_score({"timing", "Timing"}, &style.timing.correlation);
        table.add_cell({"timing_chance", "by chance", Show::three}, style.timing.chance);
        table.add_cell({"timing_p", "p", Show::p}, style.timing.p);
    }
    return table.finish();
}

Table to_table(const PublishedTable& published) {
    Table table{.id = published.id,
                .title = format("Published: {}, {}", published.source, published.place),
                .note = format("Measured on other data: {}. {}", published.corpus, published.note),
                .columns = {{"name", "System"}, {"feature", "Feature"}}};
    for (const auto& [key, title] : published.columns) table.columns.push_back({key, title, Show::three});
    for (const PublishedRow& row : published.rows) {
        std::vector<Cell> cells = {row.name, row.feature};
        for (const auto& [key, title] : published.columns) {
            const auto found = row.values.find(key);
            cells.emplace_back(found == row.values.end() ? std::nullopt : std::optional(found->second));
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

}  // namespace

std::vector<Table> tables_of(const Evaluation& evaluation) {
    std::vector<Table> tables = {summary_of(evaluation), features_of(evaluation)};
    if (evaluation.systems.front().pair) tables.push_back(pairs_of(evaluation));
    if (std::ranges::any_of(evaluation.systems, [](const SystemScores& s) { return s.poses.has_value(); }))
        tables.push_back(poses_of_systems(evaluation));
    if (std::ranges::any_of(evaluation.systems, [](const SystemScores& s) { return s.style.has_value(); })) {
        tables.push_back(style_distances_of(evaluation));
        tables.push_back(transfers_of(evaluation));
    }
    tables.insert(tables.end(), evaluation.more.begin(), evaluation.more.end());
    return tables;
}

std::vector<Table> published_beside(const Evaluation& evaluation) {
    std::vector<Table> tables;
    for (const PublishedTable& published : published_tables()) {
        const auto is_evaluated = [&](const PublishedRow& row) {
            return std::any_of(evaluation.systems.begin(), evaluation.systems.end(),
                               [&](const SystemScores& system) {
                                   return system.model == row.model && system.model != "people";
                               });
        };
        if (std::any_of(published.rows.begin(), published.rows.end(), is_evaluated))
            tables.push_back(to_table(published));
    }
    return tables;
}

Json to_json(const Evaluation& evaluation) {
    Json json = {{"format", "chironomia evaluation 1"},
                 {"corpus", evaluation.corpus},
                 {"split", evaluation.split},
                 {"fps", evaluation.fps},
                 {"resamples", evaluation.options.resampling.samples},
                 {"seed", evaluation.options.resampling.seed},
                 {"notes", evaluation.notes},
                 {"tables", Json::object()},
                 {"published", Json::object()}};
    for (const Table& table : tables_of(evaluation)) json["tables"][table.id] = to_json(table);
    for (const Table& table : published_beside(evaluation)) {
        json["published"][table.id] = {
            {"title", table.title}, {"note", table.note}, {"rows", to_json(table)}};
    }
    return json;
}

void write_evaluation(const std::filesystem::path& folder, const Evaluation& evaluation) {
    std::string latex = "% \\usepackage{booktabs}\n";
    for (const Table& table : tables_of(evaluation)) {
        write_text(folder / (table.id + ".csv"), csv_header(table, {}) + csv_rows(table, {}));
        latex += to_latex(table, table.id) + "\n";
    }
    for (const Table& table : published_beside(evaluation)) {
        write_text(folder / "published" / (table.id + ".csv"), csv_header(table, {}) + csv_rows(table, {}));
        latex += to_latex(table, "published-" + table.id) + "\n";
    }
    write_text(folder / "tables.tex", latex);
    write_json(folder / "evaluation.json", to_json(evaluation));
}

}  // namespace chironomia::study
