#include "study/analysis/analysis_page.h"

#include <algorithm>
#include <set>

#include "core/files/files.h"
#include "core/text.h"
#include "core/version.h"
#include "study/analysis/dataset_tables.h"
#include "study/analysis/plots.h"
#include "study/analysis/questionnaire_tables.h"
#include "study/analysis/result_tables.h"
#include "study/analysis/simulated_rater.h"
#include "study/html/html.h"

namespace chironomia::study::analysis {
namespace {

// Shown only when they are asked for: a second way to say the same, or what is looked up.
bool is_detail(const Table& table) {
    static const std::set<std::string> kDetails = {"fisher_lsd", "questions", "barnard", "intraclass"};
    return kDetails.contains(table.id);
}

std::string counted(std::size_t count, const std::string& what) {
    return format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string table_html(const Table& table) {
    const std::string body = format("{}<p class=\"note\">{}.</p>\n", to_html(table), escape_html(table.note));
    if (!is_detail(table)) return format("<h3>{}</h3>\n{}", escape_html(table.title), body);
    return format("<details><summary>{}</summary>\n{}</details>\n", escape_html(table.title), body);
}

std::string figures_html(const std::vector<Plot>& plots, std::size_t question) {
    std::string html;
    for (const Plot& plot : plots) {
        if (plot.question != question) continue;
        html +=
            format("<figure>{}<figcaption>{}</figcaption></figure>\n", plot.svg, escape_html(plot.caption));
    }
    return html.empty() ? "" : format("<div class=\"figures\">\n{}</div>\n", html);
}

std::string results_html(const Analysis& analysis, const Results& results, std::size_t question) {
    std::string html = figures_html(plots_of(analysis.data, results), question);
    for (const Table& table : tables_of(analysis.data, results)) {
        const Table part = part_of(table, analysis.data.questions[question].id);
        if (!part.rows.empty()) html += table_html(part);
    }
    return html.empty() ? "<p class=\"quiet\">No answers that count.</p>\n" : html;
}

bool has_results(const Analysis& analysis, std::size_t question) {
    const QuestionKind kind = analysis.data.questions[question].kind;
    return kind != QuestionKind::text;
}

std::string question_html(const Analysis& analysis, std::size_t number) {
    const Question& question = analysis.data.questions[number];
    std::string html = format("<section id=\"{0}\">\n<h2>{0}</h2>\n<p class=\"asked\">{1}</p>\n",
                              escape_html(question.id), escape_html(question.text));
    if (question.kind == QuestionKind::rank)
        html += "<p class=\"quiet\">Scores are ranks: 1 is the best.</p>\n";
    html += results_html(analysis, analysis.strict, number);
    if (!analysis.rules_agree()) {
        html +=
            format("<details class=\"lenient\"><summary>By the lenient rule: {}</summary>\n{}</details>\n",
                   counted(analysis.lenient.counted, "participant"),
                   results_html(analysis, analysis.lenient, number));
    }
    return html + "</section>\n";
}

std::string questions_html(const Analysis& analysis) {
    std::string html;
    for (std::size_t i = 0; i < analysis.data.questions.size(); ++i) {
        if (has_results(analysis, i)) html += question_html(analysis, i);
    }
    return html;
}

std::string contents_html(const Analysis& analysis) {
    std::string html;
    for (std::size_t i = 0; i < analysis.data.questions.size(); ++i) {
        if (has_results(analysis, i))
            html += format("<a href=\"#{0}\">{0}</a>\n", escape_html(analysis.data.questions[i].id));
    }
    return html;
}

std::string card(const std::string& number, const std::string& what) {
    return format("<div><b>{}</b><span>{}</span></div>\n", number, what);
}

std::string cards_html(const Analysis& analysis) {
    const Dataset& data = analysis.data;
    const std::size_t asked = data.questions.size() - data.scales.size();
    std::size_t passes = 0;
    for (const Rater& rater : data.raters) passes += rater.answered;
    return card(std::to_string(data.raters.size()), "took part") +
           card(std::to_string(analysis.strict.counted), "counted by the strict rule") +
           card(std::to_string(analysis.lenient.counted), "counted by the lenient rule") +
           card(std::to_string(passes), "pages answered") +
           card(std::to_string(data.conditions.size()), "conditions") +
           card(std::to_string(asked), asked == 1 ? "question" : "questions");
}

std::string rules_html(const Analysis& analysis) {
    const ExclusionRules& rules = analysis.data.rules;
    std::string html = format(
        "<p>Strict: participants who failed {} or more attention checks, or did not finish, do not count. "
        "Lenient: those who failed {} or more do not.",
        rules.failed_checks, rules.lenient_failed_checks);
    if (rules.fastest_seconds)
        html += format(" A page that was answered in less than {:g} s is a failed check.",
                       *rules.fastest_seconds);
    html += analysis.rules_agree()
                ? " Both rules count the same participants.</p>\n"
                : " All that follows is by the strict rule; the same by the lenient rule is at the "
                  "end of each part.</p>\n";
    for (const std::string& note : analysis.data.notes) html += format("<p>{}</p>\n", escape_html(note));
    return html;
}

std::string participants_html(const Analysis& analysis) {
    const Table all =
        table_of_participants(analysis.data, analysis.strict.excluded, analysis.lenient.excluded);
    Table excluded = all;
    std::erase_if(excluded.rows,
                  [](const std::vector<Cell>& row) { return row[row.size() - 2].text == "counted"; });
    for (std::vector<Cell>& row : excluded.rows) {
        if (row.back().text == row[row.size() - 2].text) row.back().text = "the same";
    }
    std::string html;
    if (excluded.rows.empty()) {
        html += "<p>Nobody is excluded.</p>\n";
    } else {
        html += format("<h3>Excluded by the strict rule</h3>\n{}", to_html(excluded));
    }
    for (const Table& table : tables_of_questionnaire(analysis.data, analysis.strict.excluded))
        html += table_html(table);
    return html + format("<details><summary>All {}</summary>\n{}</details>\n",
                         counted(all.rows.size(), "participant"), to_html(all));
}

std::string inputs_html(const Analysis& analysis) {
    std::string html = "<ul>\n";
    for (const InputOfAnalysis& input : analysis.inputs)
        html += format("<li>{} <code>{}</code></li>\n", escape_html(input.name), input.sha256);
    return html + "</ul>\n";
}

}  // namespace

std::string make_analysis_page(const Analysis& analysis) {
    std::string page = read_text(find_asset("study/web/analysis.html"));
    const std::string simulated =
        analysis.data.simulated
            ? format(
                  "<p class=\"simulated\" role=\"note\"><b>{}</b> No person gave any of these "
                  "answers. They rehearse the study and prove nothing about its conditions.</p>\n",
                  kSimulatedRaters)
            : "";
    replace_mark(page, "<!--page-title-->",
                 escape_html(analysis.data.simulated ? format("{}: {}", kSimulatedRaters, analysis.title)
                                                     : analysis.title));
    replace_mark(page, "<!--simulated-->", simulated);
    replace_mark(page, "<!--title-->", escape_html(analysis.title));
    replace_mark(page, "<!--study-->", escape_html(analysis.data.study));
    replace_mark(page, "<!--contents-->", contents_html(analysis));
    replace_mark(page, "<!--cards-->", cards_html(analysis));
    replace_mark(page, "<!--rules-->", rules_html(analysis));
    replace_mark(page, "<!--participants-->", participants_html(analysis));
    replace_mark(page, "<!--questions-->", questions_html(analysis));
    replace_mark(page, "<!--resamples-->", std::to_string(analysis.resampling.samples));
    replace_mark(page, "<!--seed-->", std::to_string(analysis.resampling.seed));
    replace_mark(page, "<!--program-->", format("chironomia {}", program_version()));
    replace_mark(page, "<!--inputs-->", inputs_html(analysis));
    return page;
}

}  // namespace chironomia::study::analysis
