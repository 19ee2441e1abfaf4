#include "study/models/recorded_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace chironomia::study {
namespace {

const std::vector<std::string> kTalkFace = {"AU1", "AU2", "AU4", "AU5", "AU6", "AU7", "Rx", "Ry", "Rz"};
const std::vector<std::string> kDyadFace = {"gaze_angle_x", "gaze_angle_y", "Rx",  "Ry",  "Rz",
                                            "AU1",          "AU2",          "AU4", "AU6", "AU12"};

// PATS's joints that models of style predict.
constexpr std::array<std::pair<const char*, std::size_t>, 11> kJointsOfStyle{{{"RShoulder", 1},
                                                                              {"RElbow", 2},
                                                                              {"RWrist", 3},
                                                                              {"LShoulder", 4},
                                                                              {"LElbow", 5},
                                                                              {"LWrist", 6},
                                                                              {"Nose", 7},
                                                                              {"REye", 8},
                                                                              {"LEye", 9},
                                                                              {"LHandRoot", 10},
                                                                              {"RHandRoot", 31}}};

RecordedRows rows_of_talk(const IpuRecord& record) {
    RecordedRows rows{.fps = record.fps, .features = kTalkFace, .values = {}};
    for (std::size_t t = 0; t < record.frames(); ++t) {
        const auto units = record.units.begin() + static_cast<std::ptrdiff_t>(t * IpuRecord::kUnits);
        const auto head = record.head.begin() + static_cast<std::ptrdiff_t>(t * IpuRecord::kAngles);
        rows.values.insert(rows.values.end(), units, units + IpuRecord::kUnits);
        rows.values.insert(rows.values.end(), head, head + IpuRecord::kAngles);
    }
    return rows;
}

// A column of an interval's points.
struct PointColumn {
    std::string name;
    const std::vector<float>* places = nullptr;
    const std::vector<float>* confidence = nullptr;
    std::size_t place = 0;  // in a row of them
    std::size_t width = 0;  // of a row
};

std::vector<PointColumn> columns_of_interval(const IntervalRecord& record) {
    constexpr std::size_t kJoints = IntervalRecord::kJoints, kPoints = IntervalRecord::kFacePoints;
    std::vector<PointColumn> columns;
    for (const std::size_t axis : {0, 1}) {
        for (const auto& [name, joint] : kJointsOfStyle)
            columns.push_back({format("{} {}", name, "xy"[axis]), &record.pose_normalized,
                               &record.pose_confidence, axis * kJoints + joint, 2 * kJoints});
        for (std::size_t point = 0; point < kPoints && !record.face_normalized.empty(); ++point)
            columns.push_back({format("Face{} {}", point, "xy"[axis]), &record.face_normalized,
                               &record.face_confidence, axis * kPoints + point, 2 * kPoints});
    }
    return columns;
}

RecordedRows rows_of_interval(const IntervalRecord& record) {
    RecordedRows rows{.fps = IntervalRecord::kFps, .features = {}, .values = {}};
    const std::vector<PointColumn> columns = columns_of_interval(record);
    for (const PointColumn& column : columns) rows.features.push_back(column.name);
    for (std::size_t t = 0; t < record.frames(); ++t) {
        for (const PointColumn& column : columns) {
            const std::size_t i = t * column.width + column.place;
            const bool is_seen = (*column.confidence)[i] > 0;
            rows.values.push_back(is_seen ? (*column.places)[i] : std::numeric_limits<float>::quiet_NaN());
        }
    }
    return rows;
}

// Compares the items of a file with the records of a corpus.
class TruthCheck {
  public:
    TruthCheck(const Predictions& predictions, const CorpusIndex& corpus, const std::string& where)
        : predictions_(predictions), corpus_(corpus), where_(where) {}

    std::vector<std::string> run() {
        std::string read;  // the record whose rows are at hand
        for (const PredictedItem& item : predictions_.items) {
            const std::string record = record_of(item);
            const auto entry = std::ranges::find(corpus_.entries, record, &CorpusEntry::id);
            if (entry == corpus_.entries.end()) continue;
            if (record != read) people_ = recorded_rows(corpus_, *entry);
            read = record;
            check(item);
        }
        if (unknown_.empty()) return {};
        return {format("{}: no record of {} has {}, so what people did there was not compared", where_,
                       corpus_.folder.string(), join(unknown_))};
    }

  private:
    // A column of an item and that of the record.
    struct Pair {
        std::string name;
        const std::vector<float>* said = nullptr;
        const RecordedRows* recorded = nullptr;
        std::size_t feature = 0, column = 0;
    };

    void check(const PredictedItem& item) {
        const std::size_t person = people_.size() == 2 && item.id.ends_with(":1") ? 1 : 0;
        const std::size_t frames = item.truth.size() / predictions_.features.size();
        if (std::abs(predictions_.fps - people_[person].fps) > 1e-3) {
            throw Error(
                format("{}: /fps is {:g}, and the records of {} have {:g} frames/s; predict at their rate",
                       where_, predictions_.fps, corpus_.folder.string(), people_[person].fps));
        }
        if (frames > people_[person].frames()) {
            throw Error(
                format("{}: /frames of {} is {}, and its record in {} has {}; give the corpus that was "
                       "predicted",
                       where_, item.id, frames, corpus_.folder.string(), people_[person].frames()));
        }
        pairs_.clear();
        pair_with("", item.truth, people_[person]);
        if (!item.partner.empty() && people_.size() == 2)
            pair_with("partner's ", item.partner, people_[1 - person]);
        std::size_t next = 0;
        for (std::size_t t = 0; t < frames; ++t) next = place_of(item, t, next) + 1;
    }

    void pair_with(const std::string& whose, const std::vector<float>& said, const RecordedRows& recorded) {
        for (std::size_t f = 0; f < predictions_.features.size(); ++f) {
            const std::string& name = predictions_.features[f];
            const auto found = std::ranges::find(recorded.features, name);
            if (found != recorded.features.end()) {
                const auto column = static_cast<std::size_t>(found - recorded.features.begin());
                pairs_.push_back({whose + name, &said, &recorded, f, column});
            } else if (std::ranges::find(unknown_, name) == unknown_.end()) {
                unknown_.push_back(name);
            }
        }
    }

    // The record's frame from `next` on that the item has as frame t.
    std::size_t place_of(const PredictedItem& item, std::size_t t, std::size_t next) const {
        constexpr double kNear = 1e-3;  // of normalised numbers, or of large ones: 16-bit floats round so
        const std::size_t frames = people_.front().frames();
        for (std::size_t n = next; n < frames; ++n)
            if (farthest(t, n).apart <= kNear) return n;
        if (next == frames) {
            throw Error(
                format("{}: /truth of {} goes on behind the last frame of its record in {}, which has {}; "
                       "give its frames in their order",
                       where_, item.id, corpus_.folder.string(), frames));
        }
        // The frame that follows the last one, or the nearest to begin with.
        std::size_t shown = next;
        for (std::size_t n = next + 1; n < frames && t == 0; ++n)
            if (farthest(t, n).apart < farthest(t, shown).apart) shown = n;
        const Pair& pair = *farthest(t, shown).pair;
        throw Error(format(
            "{}: /truth of {}: {} of frame {} is {:.4f}, and its record in {} has {:.4f} in frame {}; give the corpus "
            "that was predicted, and what people did in it",
            where_, item.id, pair.name, t, said(pair, t), corpus_.folder.string(), normalised(pair, shown),
            shown));
    }

    // The column that differs most, if there is one.
    struct Farthest {
        double apart = 0;
        const Pair* pair = nullptr;
    };
    Farthest farthest(std::size_t t, std::size_t n) const {
        Farthest most;
        for (const Pair& pair : pairs_)
            if (const double apart = distance(pair, t, n); !most.pair || apart > most.apart)
                most = {apart, &pair};
        return most;
    }

    double said(const Pair& pair, std::size_t t) const {
        return (*pair.said)[t * predictions_.features.size() + pair.feature];
    }
    double normalised(const Pair& pair, std::size_t n) const {
        const auto [low, high] = predictions_.scale[pair.feature];
        return (pair.recorded->values[n * pair.recorded->features.size() + pair.column] - low) / (high - low);
    }
    // What lies outside the scale may be cut off there. What was not seen may be anything.
    double distance(const Pair& pair, std::size_t t, std::size_t n) const {
        const double value = normalised(pair, n), given = said(pair, t);
        if (std::isnan(value)) return 0;
        const double apart = std::min(std::abs(given - value), std::abs(given - std::clamp(value, 0.0, 1.0)));
        return apart / std::max(1.0, std::abs(value));
    }

    const Predictions& predictions_;
    const CorpusIndex& corpus_;
    const std::string& where_;
    std::vector<RecordedRows> people_;  // of the record that is at hand
    std::vector<Pair> pairs_;           // of the item that is at hand
    std::vector<std::string> unknown_;
};

}  // namespace

std::vector<RecordedRows> recorded_rows(const CorpusIndex& corpus, const CorpusEntry& entry) {
    switch (corpus.kind) {
        case CorpusKind::talks:
            return {rows_of_talk(read_ipu(corpus, entry))};
        case CorpusKind::dyads: {
            std::vector<RecordedRows> people;
            for (DyadPerson& person : read_dyad(corpus, entry).people)
                people.push_back(
                    {.fps = DyadRecord::kFps, .features = kDyadFace, .values = std::move(person.face)});
            return people;
        }
        case CorpusKind::intervals:
            return {rows_of_interval(read_interval(corpus, entry))};
    }
    return {};
}

std::string record_of(const PredictedItem& item) {
    return item.id.substr(0, item.id.find_first_of(":>"));
}

std::vector<std::string> check_truth(const Predictions& predictions, const CorpusIndex& corpus,
                                     const std::string& where) {
    return TruthCheck(predictions, corpus, where).run();
}

}  // namespace chironomia::study
