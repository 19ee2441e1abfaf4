#include "study/published/published.h"

#include <algorithm>
#include <filesystem>

#include "core/files/files.h"
#include "core/files/json_value.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

constexpr double kMost = 1e9;  // nobody published a larger number

PublishedTable read_table(const fs::path& file) {
    const Json json = read_json(file);
    const JsonValue whole(json, file.string());
    PublishedTable table{.id = file.stem().string(),
                         .source = whole.at("source").text(),
                         .place = whole.at("place").text(),
                         .corpus = whole.at("corpus").text(),
                         .note = whole.at("note").text()};
    if (const auto preset = whole.find("preset")) {
        table.preset = preset->text();
        table.question = whole.at("question").text();
    }
    const JsonValue columns = whole.at("columns");
    for (const auto& [key, title] : columns.json().items())
        table.columns.emplace_back(key, columns.at(key).text());
    for (const JsonValue& row : whole.at("rows").items(1)) {
        PublishedRow read{.name = row.at("name").text()};
        if (const auto model = row.find("model")) read.model = model->text();
        if (const auto feature = row.find("feature")) read.feature = feature->text();
        if (const auto answers = row.find("answers")) read.answers = answers->texts(1);
        if (const auto preset = row.find("preset")) {
            read.preset = preset->text();
            read.statistic = row.at("statistic").choice(kPublishedStatistics);
        }
        const JsonValue values = row.at("values");
        for (const auto& [key, value] : values.json().items())
            read.values[key] = values.at(key).number(-kMost, kMost);
        table.rows.push_back(std::move(read));
    }
    return table;
}

std::vector<PublishedTable> read_tables() {
    std::vector<PublishedTable> tables;
    const fs::path folder = find_asset("study/published/README.md").parent_path();
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".json") tables.push_back(read_table(entry.path()));
    }
    std::sort(tables.begin(), tables.end(),
              [](const PublishedTable& a, const PublishedTable& b) { return a.id < b.id; });
    return tables;
}

}  // namespace

const std::vector<PublishedTable>& published_tables() {
    static const std::vector<PublishedTable> tables = read_tables();
    return tables;
}

const PublishedTable* published_answers(std::string_view preset, std::string_view question) {
    const auto& tables = published_tables();
    const auto found = std::find_if(tables.begin(), tables.end(), [&](const PublishedTable& table) {
        return !preset.empty() && table.preset == preset && table.question == question;
    });
    return found == tables.end() ? nullptr : &*found;
}

std::optional<double> published_value(std::string_view model, std::string_view feature,
                                      const std::string& metric) {
    for (const PublishedTable& table : published_tables()) {
        for (const PublishedRow& row : table.rows) {
            if (row.model != model || row.feature != feature) continue;
            const auto found = row.values.find(metric);
            if (found != row.values.end()) return found->second;
        }
    }
    return std::nullopt;
}

}  // namespace chironomia::study
