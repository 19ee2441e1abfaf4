#include "study/analysis/table.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "core/utf8.h"
#include "study/html/html.h"

namespace chironomia::study::analysis {
namespace {

std::string show_number(double number, Show show) {
    switch (show) {
        case Show::text:
        case Show::whole:
            return format("{:.0f}", number);
        case Show::one:
            return number == std::round(number) ? format("{:.0f}", number) : format("{:.1f}", number);
        case Show::two:
            return format("{:.2f}", number);
        case Show::three:
            return format("{:.3f}", number);
        case Show::percent:
            return format("{:.1f} %", 100 * number);
        case Show::p:
            return show_p(number);
    }
    return "";
}

std::string show_cell(const Cell& cell, Show show) {
    if (!cell.number) return cell.text.empty() ? "–" : cell.text;
    const std::string shown = show_number(*cell.number, show);
    const bool is_nothing = shown.starts_with('-') && shown.find_first_of("123456789") == std::string::npos;
    return is_nothing ? shown.substr(1) : shown;
}

bool is_low(const Column& column) {
    return column.key.ends_with("_low");
}

std::string exact(const Cell& cell) {
    return cell.number ? format("{}", *cell.number) : cell.text;
}

bool is_formula(const std::string& field) {
    return !field.empty() && std::string_view("=+-@\t\r").find(field.front()) != std::string_view::npos &&
           !parse_number(field);
}

// The width of a text on a terminal: code points, not bytes.
std::size_t width_of(std::string_view text) {
    return count_characters(text);
}

}  // namespace

std::string show_p(double p) {
    if (p < 0.001) return "< .001";
    const std::string digits = format("{:.3f}", p);
    return digits[0] == '0' ? digits.substr(1) : digits;
}

Table part_of(const Table& table, std::string_view first) {
    Table part{.id = table.id,
               .title = table.title,
               .note = table.note,
               .columns = {table.columns.begin() + 1, table.columns.end()}};
    for (const auto& row : table.rows) {
        if (row.front().text == first) part.rows.emplace_back(row.begin() + 1, row.end());
    }
    return part;
}

ShownTable show(const Table& table) {
    ShownTable shown;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        shown.titles.push_back(table.columns[c].title);
        shown.is_text.push_back(table.columns[c].show == Show::text);
        if (is_low(table.columns[c])) ++c;
    }
    for (const auto& row : table.rows) {
        shown.rows.emplace_back();
        for (std::size_t c = 0; c < row.size(); ++c) {
            const Show how = table.columns[c].show;
            if (!is_low(table.columns[c])) {
                shown.rows.back().push_back(show_cell(row[c], how));
                continue;
            }
            shown.rows.back().push_back(
                row[c].number || row[c + 1].number
                    ? format("[{}, {}]", show_cell(row[c], how), show_cell(row[c + 1], how))
                    : "–");
            ++c;
        }
    }
    return shown;
}

std::string csv_line(const std::vector<std::string>& fields) {
    std::vector<std::string> quoted;
    for (const std::string& given : fields) {
        const std::string field = is_formula(given) ? "'" + given : given;
        if (field.find_first_of(",\"\r\n") == std::string::npos) {
            quoted.push_back(field);
            continue;
        }
        std::string doubled;
        for (const char c : field) doubled += c == '"' ? std::string("\"\"") : std::string(1, c);
        quoted.push_back('"' + doubled + '"');
    }
    return join(quoted, ",") + "\n";
}

std::string csv_header(const Table& table, const std::vector<std::string>& before) {
    std::vector<std::string> fields = before;
    for (const Column& column : table.columns) fields.push_back(column.key);
    return csv_line(fields);
}

std::string csv_rows(const Table& table, const std::vector<std::string>& before) {
    std::string csv;
    for (const auto& row : table.rows) {
        std::vector<std::string> fields = before;
        for (const Cell& cell : row) fields.push_back(exact(cell));
        csv += csv_line(fields);
    }
    return csv;
}

Json to_json(const Table& table) {
    Json list = Json::array();
    for (const auto& row : table.rows) {
        Json json = Json::object();
        for (std::size_t c = 0; c < row.size(); ++c) {
            Json& value = json[table.columns[c].key];
            if (row[c].number) {
                value = *row[c].number;
            } else if (table.columns[c].show == Show::text) {
                value = row[c].text;
            }
        }
        list.push_back(std::move(json));
    }
    return list;
}

std::string to_text(const Table& table) {
    const ShownTable shown = show(table);
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < shown.titles.size(); ++c) {
        std::size_t width = width_of(shown.titles[c]);
        for (const auto& row : shown.rows) width = std::max(width, width_of(row[c]));
        widths.push_back(width);
    }
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::string space(widths[c] - width_of(cells[c]), ' ');
            text += (c == 0 ? "" : "  ") + (shown.is_text[c] ? cells[c] + space : space + cells[c]);
        }
        return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
    };
    std::string text = line(shown.titles);
    for (const auto& row : shown.rows) text += line(row);
    return text;
}

std::string to_html(const Table& table) {
    const ShownTable shown = show(table);
    const auto cell = [&](std::string_view tag, std::size_t column, const std::string& text) {
        return format("<{0}{1}>{2}</{0}>", tag, shown.is_text[column] ? "" : " class=\"n\"",
                      escape_html(text));
    };
    std::string html = "<div class=\"wide\"><table>\n<thead><tr>";
    for (std::size_t c = 0; c < shown.titles.size(); ++c) html += cell("th", c, shown.titles[c]);
    html += "</tr></thead>\n<tbody>\n";
    for (const auto& row : shown.rows) {
        html += "<tr>";
        for (std::size_t c = 0; c < row.size(); ++c) html += cell("td", c, row[c]);
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table></div>\n";
}

std::string escape_latex(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '\\':
                escaped += "\\textbackslash{}";
                break;
            case '~':
                escaped += "\\textasciitilde{}";
                break;
            case '^':
                escaped += "\\textasciicircum{}";
                break;
            case '<':
                escaped += "$<$";
                break;
            case '>':
                escaped += "$>$";
                break;
            case '|':
                escaped += "$|$";
                break;
            default:
                if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) escaped += '\\';
                escaped += c;
        }
    }
    return escaped;
}

std::string to_latex(const Table& table, std::string_view label) {
    const ShownTable shown = show(table);
    std::string columns;
    for (const bool is_text : shown.is_text) columns += is_text ? 'l' : 'r';
    const auto line = [](const std::vector<std::string>& cells) {
        std::vector<std::string> escaped;
        for (const std::string& cell : cells) escaped.push_back(cell == "–" ? "--" : escape_latex(cell));
        return join(escaped, " & ") + " \\\\\n";
    };
    std::string latex = format(
        "\\begin{{table}}\n\\centering\n\\caption{{{}. "
        "{}}}\n\\label{{tab:{}}}\n\\begin{{tabular}}{{{}}}\n\\toprule\n",
        escape_latex(table.title), escape_latex(table.note), label, columns);
    latex += line(shown.titles) + "\\midrule\n";
    for (const auto& row : shown.rows) latex += line(row);
    return latex + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

}  // namespace chironomia::study::analysis
