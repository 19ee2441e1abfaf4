#include "synth/features/opensmile_csv.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/features/speech_features.h"

namespace chironomia {
namespace {

// A column of ours and the names that openSMILE's configurations give it, the better one first.
struct NamedColumn {
    std::string name;
    std::vector<std::string> known_as;
};

std::vector<NamedColumn> speech_set() {
    std::vector<NamedColumn> set{
        {"f0", {"F0final_sma", "F0_sma", "F0env_sma", "F0final", "F0env"}},
        {"loudness", {"pcm_loudness_sma", "audspec_lengthL1norm_sma", "Loudness_sma3", "pcm_loudness"}},
        {"voicing", {"voicingFinalUnclipped_sma", "voiceProb_sma", "voicingFinalUnclipped", "voiceProb"}}};
    const std::vector<std::string> columns = speech_columns();
    for (std::size_t c = set.size(); c < columns.size(); ++c) {
        const std::size_t number = c - 3;
        set.push_back({columns[c],
                       {format("pcm_fftMag_mfcc[{}]", number), format("pcm_fftMag_mfcc_sma[{}]", number),
                        format("mfcc_sma[{}]", number), format("mfcc[{}]", number)}});
    }
    return set;
}

std::vector<NamedColumn> voice_set() {
    return {{"jitter", {"jitterLocal_sma3nz"}},
            {"shimmer", {"shimmerLocaldB_sma3nz"}},
            {"hnr", {"HNRdBACF_sma3nz"}},
            {"hammarberg", {"hammarbergIndex_sma3"}}};
}

// Where the first of the names that the table has stands in it; nothing if it has none.
std::optional<std::size_t> place_of(const CsvTable& table, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        const auto found = std::find(table.columns.begin(), table.columns.end(), name);
        if (found == table.columns.end()) continue;
        if (std::find(found + 1, table.columns.end(), name) != table.columns.end()) {
            throw Error(format("{}: column \"{}\" is there twice; export it once", table.where, name));
        }
        return static_cast<std::size_t>(found - table.columns.begin());
    }
    return std::nullopt;
}

std::size_t required_column(const CsvTable& table, const NamedColumn& column) {
    if (const auto place = place_of(table, column.known_as)) return *place;
    throw Error(format("{}: none of the columns is {} ({}); choose a configuration that writes it",
                       table.where, column.name, join(column.known_as, " or ")));
}

double finite_number(const CsvTable& table, const CsvRow& row, std::size_t column) {
    const double number = number_in(table, row, column);
    if (std::isfinite(number)) return number;
    throw Error(format("{}column \"{}\": \"{}\" is not finite; extract the features again", table.at(row),
                       table.columns[column], row.cells[column]));
}

// The rate of rows whose times rise evenly from 0 on.
double rate_of(const CsvTable& table) {
    const std::size_t time = required_column(table, {"the time", {"frameTime", "timestamp"}});
    if (table.rows.size() < 2) {
        throw Error(format("{}: 1 row gives no rate; at least 2 are needed", table.where));
    }
    const double first = finite_number(table, table.rows.front(), time);
    const double last = finite_number(table, table.rows.back(), time);
    const double step = (last - first) / static_cast<double>(table.rows.size() - 1);
    if (!(step > 0)) {
        throw Error(format("{}: the first row is at {} s, the last at {} s; times must rise", table.where,
                           first, last));
    }
    if (std::abs(first) > 0.5 * step) {
        throw Error(format("{}the first row is at {} s; it must be at 0, within half a step of {:.6g} s",
                           table.at(table.rows.front()), first, step));
    }
    constexpr double kUneven = 0.25;  // of a step; openSMILE writes times to a few digits
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const double found = finite_number(table, table.rows[i], time);
        const double expected = first + static_cast<double>(i) * step;
        if (std::abs(found - expected) > kUneven * step) {
            throw Error(format("{}the time is {} s, even steps would have {:.6g} s; export every frame",
                               table.at(table.rows[i]), found, expected));
        }
    }
    // Times have a few digits: 0.29 / 29 is a hundredth.
    return std::round(1e6 / step) / 1e6;
}

}  // namespace

FeatureTrack parse_opensmile(std::string_view text, const std::string& where, OpenSmileSet set) {
    const CsvTable table = parse_csv_table(text, where);
    FeatureTrack track{.rate = rate_of(table), .columns = {}, .values = {}};
    std::vector<std::size_t> places;
    for (const NamedColumn& column : set == OpenSmileSet::speech ? speech_set() : voice_set()) {
        track.columns.push_back(column.name);
        places.push_back(required_column(table, column));
    }
    for (const CsvRow& row : table.rows)
        for (const std::size_t place : places)
            track.values.push_back(static_cast<float>(finite_number(table, row, place)));
    return track;
}

FeatureTrack read_opensmile(const std::filesystem::path& file, OpenSmileSet set) {
    return parse_opensmile(read_text(file), file.string(), set);
}

}  // namespace chironomia
