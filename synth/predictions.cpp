#include "synth/predictions.h"

#include <cassert>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hdf5/file.h"
#include "core/hdf5/writer.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr auto kFormat = "chironomia predictions";

// [frames/s] As of the motions that are read: slower, half a second has no frame.
constexpr double kSlowest = 1, kFastest = 1000;

// An array of the file: the rows of one item after another.
struct ItemArray {
    const char* path;
    std::vector<float> PredictedItem::*rows;
};
constexpr ItemArray kTruth{"truth", &PredictedItem::truth};
constexpr ItemArray kPrediction{"prediction", &PredictedItem::prediction};
constexpr ItemArray kPartner{"partner", &PredictedItem::partner};

void write_rows(Hdf5Writer& writer, const Predictions& predictions, const ItemArray& array) {
    std::vector<float> all;
    for (const PredictedItem& item : predictions.items) {
        const std::vector<float>& rows = item.*array.rows;
        assert(rows.size() == item.truth.size());
        all.insert(all.end(), rows.begin(), rows.end());
    }
    const std::size_t width = predictions.features.size();
    writer.write_floats(array.path, {all.size() / width, width}, all, Hdf5Writer::Packing::deflated);
}

void write_items(Hdf5Writer& writer, const Predictions& predictions) {
    std::vector<std::string> ids, speakers, styles;
    std::vector<int> frames;
    for (const PredictedItem& item : predictions.items) {
        assert(item.truth.size() % predictions.features.size() == 0);
        ids.push_back(item.id);
        speakers.push_back(item.speaker);
        styles.push_back(item.style);
        frames.push_back(static_cast<int>(item.truth.size() / predictions.features.size()));
    }
    writer.write_texts("ids", ids);
    writer.write_texts("speakers", speakers);
    if (!styles.front().empty()) writer.write_texts("styles", styles);
    writer.write_ints("frames", {frames.size()}, frames);
    write_rows(writer, predictions, kTruth);
    write_rows(writer, predictions, kPrediction);
    if (!predictions.items.front().partner.empty()) write_rows(writer, predictions, kPartner);
}

std::string read_one(const Hdf5File& file, const std::string& path) {
    const std::vector<std::string> texts = file.read_texts(path);
    if (texts.size() != 1) file.refuse(format("/{} holds {} texts; it must hold one", path, texts.size()));
    return texts[0];
}

void read_features(const Hdf5File& file, Predictions& predictions) {
    predictions.features = file.read_texts("features");
    if (predictions.features.empty()) file.refuse("/features is empty; at least one must be predicted");
    const std::vector<double> scale = file.read_numbers("scale", {predictions.features.size(), 2});
    for (std::size_t f = 0; f < predictions.features.size(); ++f) {
        const double low = scale[2 * f], high = scale[2 * f + 1];
        if (!(low < high)) {
            file.refuse(format("/scale of {} goes from {} to {}; the second must be larger",
                               predictions.features[f], low, high));
        }
        predictions.scale.push_back({low, high});
    }
}

// How many frames each item has.
std::vector<std::size_t> read_items(const Hdf5File& file, Predictions& predictions) {
    constexpr double kMostFrames = 1e8;
    const std::vector<std::string> ids = file.read_texts("ids");
    if (ids.empty()) file.refuse("/ids is empty; at least one record must be predicted");
    const std::vector<std::string> speakers = file.read_texts("speakers");
    if (speakers.size() != ids.size())
        file.refuse(format("/speakers has {} entries but /ids has {}", speakers.size(), ids.size()));
    const std::vector<std::string> styles =
        file.has("styles") ? file.read_texts("styles") : std::vector<std::string>(ids.size());
    if (styles.size() != ids.size())
        file.refuse(format("/styles has {} entries but /ids has {}", styles.size(), ids.size()));
    const std::vector<double> frames = file.read_numbers("frames", {ids.size()});
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (i > 0 && ids[i] <= ids[i - 1]) {
            file.refuse(format("/ids: \"{}\" stands behind \"{}\"; they must be ascending, no two the same",
                               ids[i], ids[i - 1]));
        }
        if (!(frames[i] >= 1 && frames[i] <= kMostFrames))
            file.refuse(format("/frames of {} is {}; it must be at least 1", ids[i], frames[i]));
        counts.push_back(static_cast<std::size_t>(frames[i]));
        predictions.items.push_back({.id = ids[i], .speaker = speakers[i], .style = styles[i]});
    }
    return counts;
}

void read_rows(const Hdf5File& file, const ItemArray& array, const std::vector<std::size_t>& frames,
               Predictions& predictions) {
    const std::size_t width = predictions.features.size();
    const std::size_t total = std::accumulate(frames.begin(), frames.end(), std::size_t{0});
    const std::vector<double> numbers = file.read_numbers(array.path, {total, width});
    auto next = numbers.begin();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto end = next + static_cast<std::ptrdiff_t>(frames[i] * width);
        (predictions.items[i].*array.rows).assign(next, end);
        next = end;
    }
}

}  // namespace

void write_predictions(const std::filesystem::path& file, const Predictions& predictions) {
    assert(!predictions.items.empty() && !predictions.features.empty());
    assert(predictions.scale.size() == predictions.features.size());
    PendingOutput output(file, PendingOutput::Kind::file);
    Hdf5Writer writer(output.path(), file.string());
    writer.write_attribute("format", kFormat);
    writer.write_attribute("version", 1);
    writer.write_texts("model", {predictions.model});
    writer.write_texts("corpus", {predictions.corpus});
    writer.write_texts("split", {predictions.split});
    writer.write_number("fps", predictions.fps);
    writer.write_texts("features", predictions.features);
    std::vector<double> scale;
    for (const auto& [low, high] : predictions.scale) {
        scale.push_back(low);
        scale.push_back(high);
    }
    writer.write_doubles("scale", {predictions.scale.size(), 2}, scale);
    write_items(writer, predictions);
    writer.close();
    output.commit();
}

Predictions read_predictions(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    const Hdf5File reader(bytes, file.string());
    Predictions predictions{.model = read_one(reader, "model"),
                            .corpus = read_one(reader, "corpus"),
                            .split = read_one(reader, "split"),
                            .fps = reader.read_numbers("fps", {})[0]};
    if (!(predictions.fps >= kSlowest && predictions.fps <= kFastest)) {
        reader.refuse(format("/fps is {}; it must be the rate of a motion, {} to {}", predictions.fps,
                             kSlowest, kFastest));
    }
    read_features(reader, predictions);
    const std::vector<std::size_t> frames = read_items(reader, predictions);
    read_rows(reader, kTruth, frames, predictions);
    read_rows(reader, kPrediction, frames, predictions);
    if (reader.has(kPartner.path)) read_rows(reader, kPartner, frames, predictions);
    return predictions;
}

}  // namespace chironomia
