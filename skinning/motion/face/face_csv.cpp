#include "skinning/motion/face/face_csv.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/text.h"
#include "skinning/motion/face/arkit_csv.h"
#include "skinning/motion/face/face_rows.h"
#include "skinning/motion/face/openface_csv.h"
#include "skinning/motion/face/pyfeat_csv.h"
#include "skinning/signal/time_columns.h"

namespace chironomia {
namespace {

constexpr std::array<std::string_view, 4> kHead = {"head_qx", "head_qy", "head_qz", "head_qw"};
constexpr std::array<std::string_view, 4> kGaze = {"gaze_left_yaw", "gaze_left_pitch", "gaze_right_yaw",
                                                   "gaze_right_pitch"};

bool is_one_of(const std::array<std::string_view, 4>& names, std::string_view column) {
    return std::find(names.begin(), names.end(), column) != names.end();
}

bool is_ours(std::string_view column) {
    return face_channel_named(column) || is_one_of(kHead, column) || is_one_of(kGaze, column);
}

bool looks_like_ours(const std::vector<std::string>& columns) {
    return std::any_of(columns.begin(), columns.end(), is_ours);
}

class FaceReader {
  public:
    explicit FaceReader(const CsvTable& table)
        : table_(table),
          head_(find_group(table, kHead)),
          gaze_(find_group(table, kGaze)),
          confidence_(find_column(table, {"confidence"})) {}

    FaceRows run(std::optional<double> fps) {
        rows_.where = table_.where;
        rows_.failure = "confidence 0";
        rows_.notes.emplace_back("CSV: a face, a row per frame");
        find_channels();
        RowTimes when = row_times(table_, fps);
        rows_.times = std::move(when.times);
        rows_.resolution = when.resolution;
        for (const CsvRow& row : table_.rows) append(row);
        return std::move(rows_);
    }

  private:
    void find_channels() {
        for (size_t i = 0; i < table_.columns.size(); ++i) {
            const auto channel = face_channel_named(table_.columns[i]);
            if (!channel) continue;
            if (std::find(rows_.channels.begin(), rows_.channels.end(), *channel) != rows_.channels.end())
                throw Error(format("{}: the column \"{}\" comes twice", table_.where, table_.columns[i]));
            columns_.push_back(i);
            rows_.channels.push_back(*channel);
        }
    }

    void append(const CsvRow& row) {
        rows_.lines.push_back(row.line);
        for (const size_t column : columns_)
            rows_.intensities.push_back(intensity_in(table_, row, column, 1));
        if (head_) rows_.head.push_back(head_in(row));
        if (gaze_) {
            const auto angle = [&](size_t i) {
                return static_cast<float>(finite_in(table_, row, (*gaze_)[i]));
            };
            rows_.gaze.push_back({{angle(0), angle(1)}, {angle(2), angle(3)}});
        }
        rows_.confidence.push_back(confidence_in(row));
    }

    Quat head_in(const CsvRow& row) const {
        const auto part = [&](size_t i) { return finite_in(table_, row, (*head_)[i]); };
        const glm::dquat turn(part(3), part(0), part(1), part(2));
        const double size = glm::length(turn);
        if (std::abs(size - 1) <= 1e-3) return Quat(glm::normalize(turn));
        throw Error(
            format("{}head_qx, head_qy, head_qz, head_qw: the turn has the length {:.4g}; a unit "
                   "quaternion is expected",
                   table_.at(row), size));
    }

    float confidence_in(const CsvRow& row) const {
        const double sure = confidence_ ? finite_in(table_, row, *confidence_) : 1;
        if (sure >= 0 && sure <= 1) return static_cast<float>(sure);
        throw Error(format("{}column \"{}\": {} does not lie between 0 and 1", table_.at(row),
                           table_.columns[*confidence_], sure));
    }

    const CsvTable& table_;
    std::optional<std::vector<size_t>> head_, gaze_;
    std::optional<size_t> confidence_;
    std::vector<size_t> columns_;  // in the order of the channels
    FaceRows rows_;
};

std::string header_line(const FaceTrack& face) {
    std::string text = "time";
    for (const FaceChannel& channel : face.channels) text += "," + to_text(channel);
    for (const std::string_view name : kHead) text += face.head.empty() ? "" : format(",{}", name);
    for (const std::string_view name : kGaze) text += face.gaze.empty() ? "" : format(",{}", name);
    return text + (face.confidence.empty() ? "\n" : ",confidence\n");
}

}  // namespace

bool is_face_table(std::string_view text, const std::string& where) {
    const std::vector<std::string> columns = csv_columns(text, where);
    return looks_like_openface(columns) || looks_like_arkit(columns) || looks_like_pyfeat(columns) ||
           looks_like_ours(columns);
}

Motion read_face_table(std::string_view text, const std::string& where, std::optional<double> fps) {
    const std::vector<std::string> columns = csv_columns(text, where);
    if (looks_like_openface(columns)) return face_of_openface(text, where, fps);
    if (looks_like_arkit(columns)) return face_of_arkit(text, where, fps);
    if (looks_like_pyfeat(columns)) return face_of_pyfeat(text, where, fps);
    const CsvTable table =
        parse_csv_table(text, where, {.keeps = [](std::string_view column) {
                            return is_ours(column) || is_time_column(column) || column == "confidence";
                        }});
    return face_of_rows(FaceReader(table).run(fps), fps);
}

std::string face_table(const Motion& motion) {
    assert(motion.face);
    const FaceTrack& face = *motion.face;
    std::string text = header_line(face);
    for (size_t t = 0; t < motion.frames; ++t) {
        text += format("{:.9g}", static_cast<double>(t) / motion.fps);
        for (size_t c = 0; c < face.channels.size(); ++c)
            text += format(",{}", face.intensities[t * face.channels.size() + c]);
        if (!face.head.empty()) {
            const Quat& turn = face.head[t];
            text += format(",{},{},{},{}", turn.x, turn.y, turn.z, turn.w);
        }
        if (!face.gaze.empty()) {
            const auto& [left, right] = face.gaze[t];
            text += format(",{},{},{},{}", left.x, left.y, right.x, right.y);
        }
        if (!face.confidence.empty()) text += format(",{}", face.confidence[t]);
        text += '\n';
    }
    return text;
}

}  // namespace chironomia
