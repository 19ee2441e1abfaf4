#include "skinning/motion/face/openface_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/text.h"
#include "skinning/motion/face/face_rows.h"
#include "skinning/signal/time_columns.h"

namespace chironomia {
namespace {

constexpr std::array<std::string_view, 3> kPose = {"pose_Rx", "pose_Ry", "pose_Rz"};
constexpr std::array<std::string_view, 6> kGazeDirections = {"gaze_0_x", "gaze_0_y", "gaze_0_z",
                                                             "gaze_1_x", "gaze_1_y", "gaze_1_z"};
constexpr std::array<std::string_view, 2> kGazeAngle = {"gaze_angle_x", "gaze_angle_y"};
constexpr double kMostTurn = 6.3;   // [rad]; what is larger are degrees
constexpr double kMostGaze = 1.57;  // [rad]; nobody looks behind

// The number of the unit in "AU01_r" if the suffix is `kind`, or nothing. "AU45_R" is the right side of our
// own tables.
std::optional<int> unit_in(std::string_view column, std::string_view kind) {
    const std::string lower = to_lower(column);
    if (!lower.starts_with("au") || !column.ends_with(kind)) return std::nullopt;
    const auto number = parse_integer(std::string_view(lower).substr(2, lower.size() - 2 - kind.size()));
    if (!number || *number < 1 || *number > 99) return std::nullopt;
    return static_cast<int>(*number);
}

template <size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, std::string_view column) {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return to_lower(name) == to_lower(column); });
}

bool is_column_of_openface(std::string_view column) {
    static constexpr std::array<std::string_view, 3> kOthers = {"confidence", "success", "face_id"};
    return is_time_column(column) || is_one_of(kOthers, column) || is_one_of(kPose, column) ||
           is_one_of(kGazeDirections, column) || is_one_of(kGazeAngle, column) || unit_in(column, "_r") ||
           unit_in(column, "_c");
}

void check_columns(const CsvTable& table) {
    std::map<std::string, size_t> seen;
    for (const std::string& column : table.columns) {
        if (++seen[to_lower(column)] == 2)
            throw Error(format("{}: the column \"{}\" comes twice", table.where, column));
    }
}

// A file of one person has one face_id.
void check_faces(const CsvTable& table) {
    const auto column = find_column(table, {"face_id"});
    if (!column) return;
    std::map<std::string, size_t> counts;
    for (const CsvRow& row : table.rows) ++counts[std::string(row.cells[*column])];
    if (counts.size() < 2) return;
    std::vector<std::string> faces;
    for (const auto& [id, count] : counts) {
        faces.push_back(format("{} in {} rows", id, count));
        if (faces.size() == 8) break;
    }
    throw Error(format("{}: it holds {} faces (face_id {}); keep the rows of one person", table.where,
                       counts.size(), join(faces)));
}

class OpenFaceReader {
  public:
    explicit OpenFaceReader(const CsvTable& table)
        : table_(table),
          pose_(find_group(table, kPose)),
          gaze_(find_group(table, kGazeDirections)),
          angle_(gaze_ ? std::nullopt : find_group(table, kGazeAngle)),
          success_(find_column(table, {"success"})),
          confidence_(find_column(table, {"confidence"})) {}

    FaceRows run(std::optional<double> fps) {
        rows_.where = table_.where;
        rows_.failure = format("success 0 or confidence under {}", kLeastOpenFaceConfidence);
        find_units();
        if (units_.empty() && !pose_ && !gaze_ && !angle_) {
            throw Error(
                format("{}: no column holds an intensity (AU01_r), the head (pose_Rx) or the gaze "
                       "(gaze_0_x); export one of them",
                       table_.where));
        }
        RowTimes when = row_times(table_, fps);
        rows_.times = std::move(when.times);
        rows_.resolution = when.resolution;
        for (const CsvRow& row : table_.rows) append(row);
        add_notes();
        return std::move(rows_);
    }

  private:
    void find_units() {
        for (size_t i = 0; i < table_.columns.size(); ++i) {
            const auto unit = unit_in(table_.columns[i], "_r");
            if (!unit) continue;
            if (name_of_unit(*unit).empty()) {
                unknown_.push_back(table_.columns[i]);
                continue;
            }
            if (holds_unit(*unit)) {
                throw Error(format("{}: the column \"{}\" holds action unit {} again", table_.where,
                                   table_.columns[i], *unit));
            }
            units_.push_back(i);
            rows_.channels.push_back({*unit, FaceSide::both});
        }
    }

    bool holds_unit(int unit) const {
        const FaceChannel channel{unit, FaceSide::both};
        return std::find(rows_.channels.begin(), rows_.channels.end(), channel) != rows_.channels.end();
    }

    void append(const CsvRow& row) {
        rows_.lines.push_back(row.line);
        const float confidence = confidence_in(row);
        rows_.confidence.push_back(confidence);
        Quat head = kNoTurn;
        Gaze gaze;
        if (confidence > 0) {
            if (pose_) head = head_in(row);
            if (gaze_ || angle_) {
                const auto found = gaze_in(row, head);
                if (!found) rows_.confidence.back() = 0;
                gaze = found.value_or(Gaze{});
            }
        }
        for (const size_t column : units_)
            rows_.intensities.push_back(confidence > 0 ? intensity_in(table_, row, column, 1) : 0);
        if (pose_) rows_.head.push_back(head);
        if (gaze_ || angle_) rows_.gaze.push_back(gaze);
    }

    // 0 if the row failed.
    float confidence_in(const CsvRow& row) const {
        const double success = success_ ? finite_in(table_, row, *success_) : 1;
        if (success != 0 && success != 1) {
            throw Error(format("{}column \"{}\": {} is neither 0 nor 1", table_.at(row),
                               table_.columns[*success_], success));
        }
        if (success == 0) return 0;
        const double sure = confidence_ ? finite_in(table_, row, *confidence_) : 1;
        if (sure < -1 || sure > 1) {
            throw Error(format("{}column \"{}\": {} does not lie between -1 and 1", table_.at(row),
                               table_.columns[*confidence_], sure));
        }
        return sure < kLeastOpenFaceConfidence ? 0 : static_cast<float>(sure);
    }

    // Ours is theirs seen after half a turn about x, which turns y and z around.
    Quat head_in(const CsvRow& row) const {
        const auto about = [&](size_t i, const Vec3& axis) {
            return glm::angleAxis(angle_in(table_, row, (*pose_)[i], kMostTurn), axis);
        };
        return normalize(about(0, {1, 0, 0}) * about(1, {0, -1, 0}) * about(2, {0, 0, -1}));
    }

    // Nothing if an eye looks nowhere, which is how some versions mark an eye that was not found.
    std::optional<Gaze> gaze_in(const CsvRow& row, const Quat& head) const {
        if (angle_) {
            const auto slope = [&](size_t i) {
                return std::tan(angle_in(table_, row, (*angle_)[i], kMostGaze));
            };
            const Vec3 way = {slope(0), slope(1), -1};
            const Vec2 both = against_head(way, head);
            return Gaze{both, both};
        }
        std::array<Vec2, 2> eyes;  // theirs: 0 is the person's right
        for (size_t eye = 0; eye < 2; ++eye) {
            Vec3 way;
            for (int axis = 0; axis < 3; ++axis)
                way[axis] =
                    static_cast<float>(finite_in(table_, row, (*gaze_)[3 * eye + static_cast<size_t>(axis)]));
            if (!(length(way) > 0.1f)) return std::nullopt;
            eyes[eye] = against_head(way, head);
        }
        return Gaze{eyes[1], eyes[0]};
    }

    static Vec2 against_head(const Vec3& camera_way, const Quat& head) {
        const Vec3 way = conjugate(head) * Vec3(camera_way.x, -camera_way.y, -camera_way.z);
        return {std::atan2(way.x, way.z), std::atan2(way.y, std::hypot(way.x, way.z))};
    }

    void add_notes() {
        std::vector<std::string> parts;
        if (!units_.empty()) parts.push_back(format("{} action units", units_.size()));
        if (pose_) parts.emplace_back("head");
        if (gaze_ || angle_) parts.emplace_back("gaze");
        rows_.notes.push_back(format("OpenFace CSV: {}", join(parts)));
        if ((gaze_ || angle_) && !pose_)
            rows_.notes.emplace_back("gaze: the head is not known, so it is taken to be still");
        if (!unknown_.empty())
            rows_.notes.push_back(format("units that are not known, left out: {}", join(unknown_)));
        for (size_t i = 0; i < table_.columns.size(); ++i) note_presence(i);
    }

    // A unit that is only present or absent has no intensity to show.
    void note_presence(size_t column) {
        const auto unit = unit_in(table_.columns[column], "_c");
        if (!unit || holds_unit(*unit)) return;
        size_t present = 0;
        for (size_t n = 0; n < table_.rows.size(); ++n)
            present += rows_.confidence[n] > 0 && finite_in(table_, table_.rows[n], column) > 0;
        if (present == 0) return;
        rows_.notes.push_back(format("{}: present in {} rows, but without intensity, left out",
                                     table_.columns[column], present));
    }

    const CsvTable& table_;
    std::optional<std::vector<size_t>> pose_;
    std::optional<std::vector<size_t>> gaze_;
    std::optional<std::vector<size_t>> angle_;
    std::optional<size_t> success_, confidence_;
    std::vector<size_t> units_;  // columns, in the order of the channels
    std::vector<std::string> unknown_;
    FaceRows rows_;
};

}  // namespace

bool looks_like_openface(const std::vector<std::string>& columns) {
    return std::any_of(columns.begin(), columns.end(), [](const std::string& column) {
        return unit_in(column, "_r") || unit_in(column, "_c") || is_one_of(kPose, column) ||
               is_one_of(kGazeDirections, column) || is_one_of(kGazeAngle, column);
    });
}

Motion face_of_openface(std::string_view text, const std::string& where, std::optional<double> fps) {
    const CsvTable table = parse_csv_table(text, where, {.keeps = is_column_of_openface});
    check_columns(table);
    check_faces(table);
    return face_of_rows(OpenFaceReader(table).run(fps), fps);
}

}  // namespace chironomia
