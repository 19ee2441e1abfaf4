#include "study/analysis/analysis.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "study/analysis/analysis_page.h"
#include "study/analysis/dataset_tables.h"
#include "study/analysis/exclusion.h"
#include "study/analysis/foreign.h"
#include "study/analysis/hemvip_answers.h"
#include "study/analysis/plots.h"
#include "study/analysis/questionnaire_tables.h"
#include "study/analysis/result_tables.h"
#include "study/analysis/simulated_rater.h"
#include "study/record/study_folder.h"

namespace chironomia::study::analysis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAnalysisFormat = "chironomia analysis 1";

std::string title_of(const StudyFolder& study) {
    const fs::path pages = study.open() / "pages.json";
    if (!fs::exists(pages)) return "";
    const Json json = read_json(pages);
    const Json title = json.is_object() ? json.value("title", Json()) : Json();
    return title.is_string() ? title.get<std::string>() : "";
}

Results results_by(const Dataset& data, Strictness strictness, const Resampling& resampling) {
    std::vector<std::string> reasons = reasons_to_exclude(data, strictness);
    const Dataset counted = without_excluded(data, reasons);
    return compute_results(counted, std::move(reasons), resampling);
}

std::vector<Table> all_tables(const Analysis& analysis, const Results& results) {
    std::vector<Table> tables = tables_of_questionnaire(analysis.data, results.excluded);
    for (Table& table : tables_of(analysis.data, results)) tables.push_back(std::move(table));
    return tables;
}

// Columns before those of every table: which rule, and that nobody was there.
std::vector<std::string> columns_before(const Analysis& analysis, bool with_rule) {
    std::vector<std::string> columns;
    if (analysis.data.simulated) columns.push_back("raters");
    if (with_rule) columns.push_back("rule");
    return columns;
}

std::vector<std::string> values_before(const Analysis& analysis, const std::string& rule) {
    std::vector<std::string> values;
    if (analysis.data.simulated) values.push_back(kSimulatedRaters);
    if (!rule.empty()) values.push_back(rule);
    return values;
}

// What is written, by its path in the folder of the results.
using Files = std::map<fs::path, std::string>;

void add_results(const Analysis& analysis, Files& files) {
    const std::vector<std::string> columns = columns_before(analysis, true);
    const auto add = [&](const Results& results, const std::string& rule) {
        for (const Table& table : all_tables(analysis, results)) {
            std::string& csv = files[table.id + ".csv"];
            if (csv.empty()) csv = csv_header(table, columns);
            csv += csv_rows(table, values_before(analysis, rule));
        }
    };
    add(analysis.strict, to_text(Strictness::strict));
    add(analysis.lenient, to_text(Strictness::lenient));
}

void add_single(const Analysis& analysis, const Table& table, Files& files) {
    files[table.id + ".csv"] =
        csv_header(table, columns_before(analysis, false)) + csv_rows(table, values_before(analysis, ""));
}

// A row for each resample and group: the bootstrap of the strengths by the strict rule.
std::string elo_samples(const Analysis& analysis) {
    std::vector<std::string> columns = columns_before(analysis, false);
    columns.insert(columns.end(), {"question", "group", "sample", "condition", "elo"});
    std::string csv = csv_line(columns);
    for (const VoteResult& result : analysis.strict.votes) {
        for (std::size_t group = 0; group < result.elo.size(); ++group) {
            const EloResult& elo = result.elo[group];
            for (std::size_t sample = 0; sample < elo.table.samples.size(); ++sample) {
                for (std::size_t i = 0; i < elo.conditions.size(); ++i) {
                    std::vector<std::string> fields = values_before(analysis, "");
                    fields.insert(fields.end(),
                                  {analysis.data.questions[result.question].id, std::to_string(group + 1),
                                   std::to_string(sample), analysis.data.conditions[elo.conditions[i]].name,
                                   format("{:.3f}", elo.table.samples[sample][i])});
                    csv += csv_line(fields);
                }
            }
        }
    }
    return csv;
}

std::string latex_of(const Analysis& analysis) {
    std::string latex = format("% chironomia {}: {}. Needs \\usepackage{{booktabs}}.\n", program_version(),
                               escape_latex(analysis.title));
    const std::string simulated = analysis.data.simulated ? format("{}: ", kSimulatedRaters) : "";
    const auto add = [&](const Results& results, const std::string& rule) {
        for (Table table : all_tables(analysis, results)) {
            table.title =
                format("{}{} ({} exclusion, {} participants)", simulated, table.title, rule, results.counted);
            latex += "\n" + to_latex(table, format("{}-{}", table.id, rule));
        }
    };
    add(analysis.strict, to_text(Strictness::strict));
    if (!analysis.rules_agree()) add(analysis.lenient, to_text(Strictness::lenient));
    return latex;
}

void add_plots(const Analysis& analysis, Files& files) {
    for (const Plot& plot : plots_of(analysis.data, analysis.strict))
        files[fs::path("plots") / (plot.name + ".svg")] = plot.svg;
    if (analysis.rules_agree()) return;
    for (const Plot& plot : plots_of(analysis.data, analysis.lenient))
        files[fs::path("plots") / (plot.name + "-lenient.svg")] = plot.svg;
}

void remove_plots(const fs::path& folder) {
    if (!fs::is_directory(folder)) return;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".svg") fs::remove(entry.path());
    }
}

// Tables of the last analysis in this folder that this one has not would pass for its own.
void remove_old_tables(const Files& files, const fs::path& folder) {
    if (!fs::exists(folder / "analysis.json")) return;
    const Json last = Json::parse(read_text(folder / "analysis.json"), nullptr, false);
    if (!last.is_object() || last.value("format", Json()) != kAnalysisFormat) return;
    std::set<std::string> tables = {"battles", "elo_samples", "questionnaire", "scale_scores"};
    for (const char* rule : {"strict", "lenient"}) {
        const Json results = last.value(rule, Json::object());
        if (!results.is_object()) continue;
        for (const auto& [table, rows] : results.items()) tables.insert(table);
    }
    for (const std::string& table : tables) {
        const fs::path file = table + ".csv";
        // analysis.json may come from elsewhere: no file outside of the folder is removed.
        if (file == file.filename() && !files.contains(file) && fs::is_regular_file(folder / file))
            fs::remove(folder / file);
    }
}

// All are on the disk before the first takes its place, so that a full disk leaves what was there.
void write_files(const Files& files, const fs::path& folder) {
    for (const auto& [name, text] : files) {
        if (fs::is_directory(folder / name))
            throw Error(
                format("{}: is a folder, and a file is to be written there; remove it or name another --out",
                       (folder / name).string()));
    }
    const PendingOutput unfinished(folder / ".analysis", PendingOutput::Kind::folder);
    fs::create_directory(unfinished.path() / "plots");
    for (const auto& [name, text] : files) write_text(unfinished.path() / name, text);
    remove_plots(folder / "plots");
    remove_old_tables(files, folder);
    for (const auto& [name, text] : files) {
        std::error_code problem;
        fs::create_directories((folder / name).parent_path(), problem);
        fs::rename(unfinished.path() / name, folder / name, problem);
        if (problem)
            throw Error(format("{}: cannot be written ({}); check the permissions of the folder",
                               (folder / name).string(), problem.message()));
    }
}

Json json_of(const Analysis& analysis, const Results& results) {
    Json json = {{"participants", results.counted}};
    for (const Table& table : all_tables(analysis, results)) json[table.id] = to_json(table);
    return json;
}

// The files are all as the first one is: the readers refuse others.
Dataset dataset_of_study(const std::vector<fs::path>& files, const StudyKey& key, const StudyPages& pages) {
    if (!files.empty() && extension_of(files.front()) == ".csv") return read_battles(files, key, pages);
    if (files.empty() || !is_of_hemvip(files.front()))
        return join_answers(key, pages, read_answers(files, key));
    const HemvipAnswers read = read_hemvip_answers(files, key, pages);
    Dataset data = join_answers(key, pages, read.participants);
    data.notes.insert(data.notes.begin(), read.notes.begin(), read.notes.end());
    return data;
}

// A study that is served keeps answers in a database, which is there before the first participant.
std::string no_answers(const AnalysisJob& job) {
    if (job.study && fs::exists(StudyFolder{*job.study}.answers()))
        return "the answers: there are none, because nobody had taken part when they were written; write them again with "
               "`chironomia study answers` once somebody has";
    return "the answers: there are none; give files with participants";
}

}  // namespace

bool Analysis::rules_agree() const {
    const auto same = [](const std::string& a, const std::string& b) { return a.empty() == b.empty(); };
    return std::equal(strict.excluded.begin(), strict.excluded.end(), lenient.excluded.begin(), same);
}

Analysis analyse(const AnalysisJob& job) {
    const auto [files, unread] = files_of_answers(job.answers);
    Analysis analysis{.resampling = job.resampling};
    if (job.study) {
        const StudyFolder folder{*job.study};
        const StudyKey key = read_study_key(folder.key());
        const StudyPages pages = read_study_pages(folder.open() / "pages.json");
        require_same_study(folder.key(), key, pages);
        analysis.data = dataset_of_study(files, key, pages);
        analysis.title = title_of(folder);
    } else {
        analysis.data = read_foreign_answers(files);
    }
    if (analysis.title.empty()) analysis.title = analysis.data.study;
    if (analysis.data.raters.empty()) throw Error(no_answers(job));
    analysis.data.notes.insert(analysis.data.notes.end(), unread.begin(), unread.end());
    for (const fs::path& file : files)
        analysis.inputs.push_back({file.filename().string(), sha256_of_file(file)});
    analysis.strict = results_by(analysis.data, Strictness::strict, job.resampling);
    analysis.lenient = results_by(analysis.data, Strictness::lenient, job.resampling);
    return analysis;
}

Json to_json(const Analysis& analysis) {
    Json json = {{"format", kAnalysisFormat},
                 {"program", format("chironomia {}", program_version())},
                 {"study", analysis.data.study},
                 {"title", analysis.title},
                 {"raters", analysis.data.simulated ? kSimulatedRaters : "people"},
                 {"resamples", analysis.resampling.samples},
                 {"seed", analysis.resampling.seed}};
    for (const InputOfAnalysis& input : analysis.inputs)
        json["inputs"].push_back({{"file", input.name}, {"sha256", input.sha256}});
    json["notes"] = analysis.data.notes;
    json["participants"] =
        to_json(table_of_participants(analysis.data, analysis.strict.excluded, analysis.lenient.excluded));
    json["strict"] = json_of(analysis, analysis.strict);
    json["lenient"] = json_of(analysis, analysis.lenient);
    return json;
}

std::string to_text(const Analysis& analysis) {
    std::string text = analysis.data.simulated ? format("{}\n\n", kSimulatedRaters) : "";
    text += format("{}: {} counted by the strict rule, {} by the lenient one\n",
                   analysis.data.raters.size() == 1 ? "1 participant"
                                                    : format("{} participants", analysis.data.raters.size()),
                   analysis.strict.counted, analysis.lenient.counted);
    for (const std::string& note : analysis.data.notes) text += note + "\n";
    for (std::size_t i = 0; i < analysis.data.raters.size(); ++i) {
        if (!analysis.strict.excluded[i].empty())
            text += format("  {}: {}\n", analysis.data.raters[i].name, analysis.strict.excluded[i]);
    }
    for (const Table& table : all_tables(analysis, analysis.strict)) {
        static const std::set<std::string> kMain = {"scores",
                                                    "cronbach",
                                                    "middle_t",
                                                    "friedman",
                                                    "repeated_anova",
                                                    "anova",
                                                    "paired_t",
                                                    "welch_t",
                                                    "preferences_of_participants",
                                                    "preferences",
                                                    "elo",
                                                    "choices",
                                                    "right_answers",
                                                    "right_published",
                                                    "questionnaire_numbers",
                                                    "questionnaire_choices"};
        if (kMain.contains(table.id)) text += format("\n{} (strict rule)\n{}", table.title, to_text(table));
    }
    return text;
}

void write_analysis(const Analysis& analysis, const fs::path& folder) {
    Files files;
    add_results(analysis, files);
    add_single(analysis,
               table_of_participants(analysis.data, analysis.strict.excluded, analysis.lenient.excluded),
               files);
    add_single(analysis, table_of_answers(analysis.data, analysis.strict.excluded, analysis.lenient.excluded),
               files);
    if (!analysis.data.scale_answers.empty())
        add_single(analysis,
                   table_of_scale_scores(analysis.data, analysis.strict.excluded, analysis.lenient.excluded),
                   files);
    const Table at_end =
        table_of_questionnaire(analysis.data, analysis.strict.excluded, analysis.lenient.excluded);
    if (!at_end.rows.empty()) add_single(analysis, at_end, files);
    if (!analysis.strict.votes.empty()) {
        const Dataset counted = without_excluded(analysis.data, analysis.strict.excluded);
        for (const VoteResult& votes : analysis.strict.votes) {
            const Table battles = table_of_battles(counted, votes.question);
            const std::string& id = analysis.data.questions[votes.question].id;
            files[analysis.strict.votes.size() == 1 ? "battles.csv" : format("battles-{}.csv", id)] =
                csv_header(battles, {}) + csv_rows(battles, {});
        }
        files["elo_samples.csv"] = elo_samples(analysis);
    }
    files["tables.tex"] = latex_of(analysis);
    add_plots(analysis, files);
    files["analysis.json"] = to_json(analysis).dump(2) + "\n";
    files["report.html"] = make_analysis_page(analysis);
    write_files(files, folder);
}

}  // namespace chironomia::study::analysis
