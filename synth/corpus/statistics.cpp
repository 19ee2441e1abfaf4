#include "synth/corpus/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/files/json_value.h"
#include "core/text.h"
#include "synth/corpus/moments.h"

namespace chironomia {
namespace {

constexpr const char* kFile = "statistics.json";
constexpr double kLow = 0.01, kHigh = 0.99;

FeatureScale spread(double zero, double one, bool is_clamped) {
    constexpr double kLeastSpread = 1e-9;
    return {.zero = zero, .one = one - zero > kLeastSpread ? one : zero + 1, .is_clamped = is_clamped};
}

CorpusStatistics of_talks() {
    CorpusStatistics statistics{.kind = CorpusKind::talks};
    statistics.scales["au"].assign(IpuRecord::kUnits, {.zero = 0, .one = 5, .is_clamped = true});
    statistics.scales["head"].assign(IpuRecord::kAngles, {.zero = -1, .one = 1, .is_clamped = true});
    statistics.scales["f0"].assign(1, {.zero = 50, .one = 550, .is_clamped = true});
    return statistics;
}

// A quantile, linearly interpolated between the two nearest values.
double percentile(std::vector<float>& values, double part) {
    const double place = part * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), values.begin() + below, values.end());
    const double low = values[static_cast<std::size_t>(below)];
    if (below + 1 == static_cast<std::ptrdiff_t>(values.size())) return low;
    const double high = *std::min_element(values.begin() + below + 1, values.end());
    return low + (place - static_cast<double>(below)) * (high - low);
}

// All values of each column.
using Columns = std::vector<std::vector<float>>;

void append(Columns& columns, const std::vector<float>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) columns[i % columns.size()].push_back(rows[i]);
}

std::vector<FeatureScale> percentile_scales(Columns& columns) {
    std::vector<FeatureScale> scales;
    for (std::vector<float>& column : columns) {
        const double low = percentile(column, kLow);
        scales.push_back(spread(low, percentile(column, kHigh), true));
    }
    return scales;
}

CorpusStatistics of_dyads(const CorpusIndex& corpus) {
    CorpusStatistics statistics{.kind = CorpusKind::dyads};
    Columns face(DyadPerson::kFace), speech(DyadPerson::kSpeech);
    for (const CorpusEntry& entry : corpus.of(Split::train)) {
        for (const DyadPerson& person : read_dyad(corpus, entry).people) {
            append(face, person.face);
            append(speech, person.speech);
        }
    }
    statistics.scales["face"] = percentile_scales(face);
    statistics.scales["speech"] = percentile_scales(speech);
    return statistics;
}

using MomentsOf = std::map<std::string, std::vector<Moments>>;

// `columns` is 1 for an array that is scaled as a whole.
void add_rows(MomentsOf& moments, const std::string& array, std::size_t columns,
              const std::vector<float>& rows) {
    std::vector<Moments>& of_array = moments[array];
    of_array.resize(columns);
    for (std::size_t i = 0; i < rows.size(); ++i) of_array[i % columns].add(rows[i]);
}

// Of places in the picture, a column for each coordinate. A point that the tracker lost lies at (0, 0) there.
void add_seen(MomentsOf& moments, const std::string& array, const std::vector<float>& places,
              const std::vector<float>& confidence) {
    const std::size_t columns =
        2 * (array.starts_with("pose") ? IntervalRecord::kJoints : IntervalRecord::kFacePoints);
    std::vector<Moments>& of_array = moments[array];
    of_array.resize(columns);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (confidence[i] > 0) of_array[i % columns].add(places[i]);
}

// Of the width of the shoulders. What varies less is the tracker's noise, which models should not take for motion.
// Ours: in COCO annotators differ at an eye by 2.5 % of the root of the person's area.
constexpr double kLeastDeviation = 0.02;

// Of points whose shoulders have one width, in their unit. The width counts to two digits, so that the noise in it does
// not count.
double least_deviation(const std::vector<Moments>& pose) {
    constexpr std::size_t kRight = 1, kLeft = 4;  // shoulders among the joints of PATS
    const auto apart = [&](std::size_t first) {
        return pose[first + kLeft].mean - pose[first + kRight].mean;
    };
    const double width = std::hypot(apart(0), apart(IntervalRecord::kJoints));
    if (!(width > 0)) return 0;
    const double digit = std::pow(10, std::floor(std::log10(width)) - 1);
    return kLeastDeviation * std::round(width / digit) * digit;
}

CorpusStatistics of_intervals(const CorpusIndex& corpus) {
    MomentsOf moments;
    for (const CorpusEntry& entry : corpus.of(Split::train)) {
        const IntervalRecord record = read_interval(corpus, entry);
        add_rows(moments, "audio/log_mel_400", 1, record.mel_400);
        add_rows(moments, "audio/log_mel_512", 1, record.mel_512);
        add_seen(moments, "pose/data", record.pose, record.pose_confidence);
        add_seen(moments, "pose/normalize", record.pose_normalized, record.pose_confidence);
        add_rows(moments, "text/bert", kWordVector, record.vectors);
        if (record.face.empty()) continue;
        add_seen(moments, "face/data", record.face, record.face_confidence);
        add_seen(moments, "face/normalize", record.face_normalized, record.face_confidence);
    }
    CorpusStatistics statistics{.kind = CorpusKind::intervals};
    for (const auto& [array, columns] : moments) {
        const double least =
            array.ends_with("/normalize") ? least_deviation(moments.at("pose/normalize")) : 0;
        for (const Moments& column : columns)
            statistics.scales[array].push_back(
                spread(column.mean, column.mean + 2 * std::max(column.deviation(), least), false));
    }
    return statistics;
}

// The arrays that the statistics of a kind always have, and their columns.
std::map<std::string, std::size_t> needed_columns(CorpusKind kind) {
    constexpr std::size_t kPose = 2 * IntervalRecord::kJoints;
    switch (kind) {
        case CorpusKind::talks:
            return {{"au", IpuRecord::kUnits}, {"head", IpuRecord::kAngles}, {"f0", 1}};
        case CorpusKind::dyads:
            return {{"face", DyadPerson::kFace}, {"speech", DyadPerson::kSpeech}};
        case CorpusKind::intervals:
            return {{"audio/log_mel_400", 1},
                    {"audio/log_mel_512", 1},
                    {"pose/data", kPose},
                    {"pose/normalize", kPose},
                    {"text/bert", kWordVector}};
    }
    return {};
}

Json json_of(const std::vector<FeatureScale>& scales) {
    Json json = {{"zero", Json::array()}, {"one", Json::array()}, {"clamped", scales.at(0).is_clamped}};
    for (const FeatureScale& scale : scales) {
        json["zero"].push_back(scale.zero);
        json["one"].push_back(scale.one);
    }
    return json;
}

std::vector<FeatureScale> scales_of(const JsonValue& value) {
    constexpr double kMost = 1e9;
    const bool is_clamped = value.at("clamped").json() == Json(true);
    const auto zeros = value.at("zero").items(1), ones = value.at("one").items(1);
    if (zeros.size() != ones.size())
        value.refuse(format("there are {} zeros and {} ones", zeros.size(), ones.size()));
    std::vector<FeatureScale> scales;
    for (std::size_t i = 0; i < zeros.size(); ++i) {
        scales.push_back({.zero = zeros[i].number(-kMost, kMost),
                          .one = ones[i].number(-kMost, kMost),
                          .is_clamped = is_clamped});
        if (scales.back().zero == scales.back().one)
            ones[i].refuse(format("is {}, the same as its zero", ones[i].shown()));
    }
    return scales;
}

}  // namespace

double FeatureScale::normalised(double value) const {
    const double found = (value - zero) / (one - zero);
    return is_clamped ? std::clamp(found, 0.0, 1.0) : found;
}

double FeatureScale::restored(double normalised) const {
    return zero + normalised * (one - zero);
}

CorpusStatistics measure_statistics(const CorpusIndex& corpus) {
    CorpusStatistics statistics = corpus.kind == CorpusKind::talks   ? of_talks()
                                  : corpus.kind == CorpusKind::dyads ? of_dyads(corpus)
                                                                     : of_intervals(corpus);
    for (const CorpusEntry& entry : corpus.of(Split::train)) {
        ++statistics.records;
        statistics.seconds += entry.seconds;
    }
    return statistics;
}

void write_statistics(const std::filesystem::path& folder, const CorpusStatistics& statistics) {
    Json json = {{"format", "chironomia corpus statistics"},
                 {"kind", name_of(statistics.kind)},
                 {"records", statistics.records},
                 {"seconds", statistics.seconds}};
    for (const auto& [array, scales] : statistics.scales) json["scales"][array] = json_of(scales);
    write_json(folder / kFile, json);
}

CorpusStatistics read_statistics(const CorpusIndex& corpus) {
    const std::filesystem::path path = corpus.folder / kFile;
    if (!std::filesystem::exists(path)) return measure_statistics(corpus);
    const Json json = read_json(path);
    const JsonValue value(json, path.string());
    value.at("kind").choice({std::string(name_of(corpus.kind))});
    CorpusStatistics statistics{.kind = corpus.kind};
    statistics.records = static_cast<std::size_t>(value.at("records").integer(1, 1'000'000'000));
    statistics.seconds = value.at("seconds").number(0, 1e12);
    const JsonValue scales = value.at("scales");
    for (const auto& [array, columns] : needed_columns(corpus.kind)) scales.at(array);
    for (const auto& [array, unread] : scales.json().items())
        statistics.scales[array] = scales_of(scales.at(array));
    for (const auto& [array, columns] : needed_columns(corpus.kind)) {
        if (const std::size_t found = statistics.of(array).size(); found != columns)
            scales.at(array).refuse(format("it has {} columns, {} are expected", found, columns));
    }
    return statistics;
}

}  // namespace chironomia
