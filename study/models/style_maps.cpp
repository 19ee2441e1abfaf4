#include "study/models/style_maps.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/text.h"
#include "study/analysis/scatter_plot.h"
#include "study/measure/proportions.h"
#include "study/measure/vectors/silhouette.h"
#include "study/measure/vectors/tsne.h"

namespace chironomia::study {

using analysis::Cell;
using analysis::ScatterPlot;
using analysis::Show;
using analysis::Table;

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kModalities{"pose", "face", "speech", "text"};
constexpr std::size_t kLeastMapped = 7;  // as tsne() needs

Vectors read_vectors(const Hdf5File& file, const std::string& path, std::size_t count) {
    const std::vector<std::size_t> shape = file.shape_of(path);
    const std::size_t width = shape.size() == 2 ? shape[1] : 0;
    return {.width = width, .values = file.read_numbers(path, {count, width})};
}

// The names of speakers or intervals, each once, and which of them each segment is of.
struct NamedLabels {
    std::vector<std::string> names;
    std::vector<std::size_t> labels;  // (N)
};

NamedLabels labels_of(const std::vector<std::string>& names) {
    NamedLabels found{.names = names};
    std::ranges::sort(found.names);
    found.names.erase(std::unique(found.names.begin(), found.names.end()), found.names.end());
    for (const std::string& name : names) {
        const auto at = std::ranges::lower_bound(found.names, name);
        found.labels.push_back(static_cast<std::size_t>(at - found.names.begin()));
    }
    return found;
}

// Every third interval of a speaker judges the probe, with all its segments: what an interval's segments share, such as
// its words' posture, is not the speaker's.
ProbeSplit probe_split(const NamedLabels& speakers, const std::vector<std::size_t>& intervals) {
    std::map<std::size_t, std::set<std::size_t>> of_speaker;
    for (std::size_t i = 0; i < intervals.size(); ++i) of_speaker[speakers.labels[i]].insert(intervals[i]);
    ProbeSplit split;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        const std::set<std::size_t>& own = of_speaker[speakers.labels[i]];
        const auto place = std::distance(own.begin(), own.find(intervals[i]));
        (place % 3 == 2 ? split.test : split.train).push_back(i);
    }
    return split;
}

// The vectors that no other one equals.
struct SingleVectors {
    Vectors vectors;
    std::vector<std::size_t> labels;
};

SingleVectors single_vectors(const Vectors& all, const std::vector<std::size_t>& labels) {
    std::map<std::vector<double>, std::size_t> copies;
    const auto row = [&](std::size_t i) { return std::vector<double>(all[i].begin(), all[i].end()); };
    for (std::size_t i = 0; i < all.count(); ++i) ++copies[row(i)];
    SingleVectors single{.vectors = {.width = all.width}, .labels = {}};
    for (std::size_t i = 0; i < all.count(); ++i) {
        if (copies[row(i)] > 1) continue;
        single.vectors.values.insert(single.vectors.values.end(), all[i].begin(), all[i].end());
        single.labels.push_back(labels[i]);
    }
    return single;
}

void write_map(const fs::path& stem, const std::string& title, const Vectors& vectors,
               const NamedLabels& speakers) {
    const TsneMap map = tsne(vectors);
    ScatterPlot plot{.title = title, .groups = speakers.names};
    std::string csv = "speaker,x,y\n";
    for (std::size_t i = 0; i < vectors.count(); ++i) {
        const auto point = map.points[i];
        plot.points.push_back({.x = point[0], .y = point[1], .group = speakers.labels[i]});
        csv += format("{},{:.6f},{:.6f}\n", speakers.names[speakers.labels[i]], point[0], point[1]);
    }
    write_text(fs::path(stem) += ".svg", draw_scatter_plot(plot));
    write_text(fs::path(stem) += ".csv", csv);
}

}  // namespace

StyleEncodings read_encodings(const fs::path& file, const std::string& model) {
    const auto bytes = read_bytes(file);
    const Hdf5File hdf5(bytes, file.string());
    StyleEncodings encodings{
        .model = model, .speakers = hdf5.read_texts("speakers"), .intervals = hdf5.read_texts("intervals")};
    if (encodings.intervals.size() != encodings.speakers.size()) {
        throw Error(format("{}: /intervals has {} names, /speakers {}; encode the styles again",
                           file.string(), encodings.intervals.size(), encodings.speakers.size()));
    }
    encodings.style = read_vectors(hdf5, "style", encodings.speakers.size());
    encodings.content = read_vectors(hdf5, "content", encodings.speakers.size());
    for (const char* name : kModalities)
        if (hdf5.has(name)) encodings.modalities[name] = read_vectors(hdf5, name, encodings.speakers.size());
    if (hdf5.has("guess")) {
        const std::size_t width = encodings.style.width;
        encodings.guess = {.width = width,
                           .values = hdf5.read_numbers("guess", {encodings.speakers.size(), width})};
    }
    return encodings;
}

Table encodings_table(const std::vector<StyleEncodings>& all) {
    Table table{
        .id = "encodings",
        .title = "Speakers in what a model encodes",
        .note =
            "Silhouette of the speakers; the share of segments that most of their five nearest of other "
            "intervals give the right speaker; a linear probe that learns from two of three intervals of each "
            "speaker. Style should show the speaker, content should "
            "not. Adversary R2: the share of the variance of the style that the adversary guesses from the content.",
        .columns = {{"model", "Model"},
                    {"encoding", "Encoding"},
                    {"n", "Segments", Show::whole},
                    {"silhouette", "Silhouette", Show::three},
                    {"neighbours", "5 nearest", Show::three},
                    {"probe", "Probe", Show::three},
                    {"probe_low", "95 %", Show::three},
                    {"probe_high", "95 %", Show::three},
                    {"chance", "by chance", Show::three},
                    {"adversary_r2", "Adversary R2", Show::three}}};
    for (const StyleEncodings& encodings : all) {
        const NamedLabels speakers = labels_of(encodings.speakers);
        const std::vector<std::size_t> intervals = labels_of(encodings.intervals).labels;
        const ProbeSplit split = probe_split(speakers, intervals);
        const bool has_others = std::ranges::any_of(
            speakers.labels, [&](std::size_t label) { return label != speakers.labels.front(); });
        const bool has_probe = !split.test.empty() && std::ranges::any_of(split.train, [&](std::size_t i) {
            return speakers.labels[i] != speakers.labels[split.train.front()];
        });
        std::vector<std::pair<const char*, const Vectors*>> kinds{{"style", &encodings.style},
                                                                  {"content", &encodings.content}};
        for (const char* name : kModalities)
            if (encodings.modalities.contains(name)) kinds.emplace_back(name, &encodings.modalities.at(name));
        for (const auto& [name, vectors] : kinds) {
            std::vector<Cell> row{
                encodings.model, name, vectors->count(), mean_silhouette(*vectors, speakers.labels),
                has_others ? neighbour_accuracy(*vectors, speakers.labels, intervals) : std::nullopt};
            if (has_probe) {
                const LabelProbe probe = probe_labels(*vectors, speakers.labels, split);
                row.insert(row.end(),
                           {probe.accuracy, probe.accuracy_95.low, probe.accuracy_95.high, probe.chance});
            } else {
                row.insert(row.end(), 4, std::optional<double>());
            }
            row.emplace_back(vectors == &encodings.content && encodings.guess
                                 ? explained_variance(encodings.style, *encodings.guess)
                                 : std::nullopt);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

Table strength_table(const std::vector<StyleJudgement>& all, double own_accuracy) {
    Table table{
        .id = "strength",
        .title = "Whose style clips are taken for",
        .note = format(
            "Of clips in the style of another speaker, those that a classifier takes for that speaker's "
            "[%]; of people's own clips it is right about {:.1f} %.",
            own_accuracy),
        .columns = {{"model", "Model"},
                    {"n", "Clips", Show::whole},
                    {"tsa", "Target [%]", Show::one},
                    {"tsa_low", "95 %", Show::one},
                    {"tsa_high", "95 %", Show::one},
                    {"source", "Source [%]", Show::one}}};
    for (const StyleJudgement& judged : all) {
        const auto share = [&](std::size_t count) {
            return 100 * static_cast<double>(count) / static_cast<double>(judged.clips);
        };
        const Interval interval = exact_share_95(judged.as_style, judged.clips);
        table.rows.push_back({judged.model, judged.clips, share(judged.as_style), 100 * interval.low,
                              100 * interval.high, share(judged.as_source)});
    }
    return table;
}

void write_style_maps(const fs::path& folder, const StyleEncodings& encodings) {
    const NamedLabels speakers = labels_of(encodings.speakers);
    write_map(folder / (encodings.model + "-style"), encodings.model + ": style by speaker", encodings.style,
              speakers);
    write_map(folder / (encodings.model + "-content"), encodings.model + ": content by speaker",
              encodings.content, speakers);
    for (const auto& [name, vectors] : encodings.modalities) {
        const SingleVectors single = single_vectors(vectors, speakers.labels);
        if (single.labels.size() < kLeastMapped) continue;
        write_map(folder / format("{}-{}", encodings.model, name),
                  format("{}: {} by speaker", encodings.model, name), single.vectors,
                  {.names = speakers.names, .labels = single.labels});
    }
}

}  // namespace chironomia::study
