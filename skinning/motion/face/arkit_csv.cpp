#include "skinning/motion/face/arkit_csv.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/arkit.h"
#include "core/error.h"
#include "core/files/csv_table.h"
#include "core/text.h"
#include "skinning/motion/face/face_rows.h"
#include "skinning/signal/time_code.h"
#include "skinning/signal/time_columns.h"

namespace chironomia {
namespace {

constexpr double kCoefficientToIntensity = 5;
constexpr float kGazeSideways = glm::radians(45.0f);  // of an eyeLook coefficient of 1
constexpr float kGazeUp = glm::radians(30.0f);
constexpr double kMostAngle = 3.2;                // [rad]; what is larger are degrees
constexpr std::ptrdiff_t kLeastCoefficients = 3;  // of a table that holds other columns, too

// A coefficient and the channel that shows it; unit 0: no channel does by itself.
struct Coefficient {
    std::string_view name;
    FaceChannel channel;
};

constexpr FaceSide kBoth = FaceSide::both, kLeft = FaceSide::left, kRight = FaceSide::right;

constexpr std::array<Coefficient, 52> kCoefficients = {{
    {"eyeBlinkLeft", {45, kLeft}},
    {"eyeBlinkRight", {45, kRight}},
    {"eyeLookDownLeft", {}},
    {"eyeLookDownRight", {}},
    {"eyeLookInLeft", {}},
    {"eyeLookInRight", {}},
    {"eyeLookOutLeft", {}},
    {"eyeLookOutRight", {}},
    {"eyeLookUpLeft", {}},
    {"eyeLookUpRight", {}},
    {"eyeSquintLeft", {7, kLeft}},
    {"eyeSquintRight", {7, kRight}},
    {"eyeWideLeft", {5, kLeft}},
    {"eyeWideRight", {5, kRight}},
    {"jawForward", {29, kBoth}},
    {"jawLeft", {30, kLeft}},
    {"jawRight", {30, kRight}},
    {"jawOpen", {26, kBoth}},
    {"mouthClose", {8, kBoth}},
    {"mouthFunnel", {22, kBoth}},
    {"mouthPucker", {18, kBoth}},
    {"mouthLeft", {}},
    {"mouthRight", {}},
    {"mouthSmileLeft", {12, kLeft}},
    {"mouthSmileRight", {12, kRight}},
    {"mouthFrownLeft", {15, kLeft}},
    {"mouthFrownRight", {15, kRight}},
    {"mouthDimpleLeft", {14, kLeft}},
    {"mouthDimpleRight", {14, kRight}},
    {"mouthStretchLeft", {20, kLeft}},
    {"mouthStretchRight", {20, kRight}},
    {"mouthRollLower", {28, kBoth}},
    {"mouthRollUpper", {28, kBoth}},
    {"mouthShrugLower", {17, kBoth}},
    {"mouthShrugUpper", {}},
    {"mouthPressLeft", {24, kLeft}},
    {"mouthPressRight", {24, kRight}},
    {"mouthLowerDownLeft", {16, kLeft}},
    {"mouthLowerDownRight", {16, kRight}},
    {"mouthUpperUpLeft", {10, kLeft}},
    {"mouthUpperUpRight", {10, kRight}},
    {"browDownLeft", {4, kLeft}},
    {"browDownRight", {4, kRight}},
    {"browInnerUp", {1, kBoth}},
    {"browOuterUpLeft", {2, kLeft}},
    {"browOuterUpRight", {2, kRight}},
    {"cheekPuff", {34, kBoth}},
    {"cheekSquintLeft", {6, kLeft}},
    {"cheekSquintRight", {6, kRight}},
    {"noseSneerLeft", {9, kLeft}},
    {"noseSneerRight", {9, kRight}},
    {"tongueOut", {19, kBoth}},
}};
constexpr std::array<std::string_view, 3> kUnshown = {"mouthLeft", "mouthRight", "mouthShrugUpper"};

constexpr std::array<std::string_view, 3> kHeadAngles = {"HeadYaw", "HeadPitch", "HeadRoll"};
constexpr std::array<std::string_view, 4> kEyes = {"LeftEyeYaw", "LeftEyePitch", "RightEyeYaw",
                                                   "RightEyePitch"};
// What looks to the person's left or up, then what looks the other way; in the order of kEyes.
constexpr std::array<std::array<std::string_view, 2>, 4> kLooks = {{{"eyeLookOutLeft", "eyeLookInLeft"},
                                                                    {"eyeLookUpLeft", "eyeLookDownLeft"},
                                                                    {"eyeLookInRight", "eyeLookOutRight"},
                                                                    {"eyeLookUpRight", "eyeLookDownRight"}}};

bool same_name(std::string_view a, std::string_view b) {
    return to_lower(a) == to_lower(b);
}

const Coefficient* coefficient_named(std::string_view name) {
    const auto found = std::find_if(kCoefficients.begin(), kCoefficients.end(),
                                    [&](const Coefficient& c) { return same_name(c.name, name); });
    return found == kCoefficients.end() ? nullptr : &*found;
}

bool is_column_of_arkit(std::string_view column) {
    const auto matches = [&](std::string_view name) { return same_name(name, column); };
    return coefficient_named(column) || is_time_column(column) || matches("timecode") ||
           matches("blendshapecount") || std::any_of(kHeadAngles.begin(), kHeadAngles.end(), matches) ||
           std::any_of(kEyes.begin(), kEyes.end(), matches);
}

class ArkitReader {
  public:
    explicit ArkitReader(const CsvTable& table)
        : table_(table), count_(find_column(table, {"blendshapecount"})) {}

    FaceRows run(std::optional<double> fps) {
        rows_.where = table_.where;
        rows_.failure = "BlendshapeCount 0";
        find_coefficients();
        for (const CsvRow& row : table_.rows) {
            rows_.lines.push_back(row.line);
            rows_.confidence.push_back(is_tracked(row) ? 1 : 0);
        }
        take_times(fps);
        for (size_t n = 0; n < table_.rows.size(); ++n) append_intensities(n);
        rows_.notes.push_back(format("ARKit: {} of 52 coefficients, as {} channels of action units",
                                     coefficients_, rows_.channels.size()));
        take_head();
        take_gaze();
        note_unshown();
        return std::move(rows_);
    }

  private:
    // A column that shows a channel.
    struct Shown {
        size_t column = 0, channel = 0;
        float whole = 1;  // the coefficient that shows the unit at intensity 5
    };

    std::optional<size_t> column_of(std::string_view name) const {
        for (size_t i = 0; i < table_.columns.size(); ++i) {
            if (same_name(table_.columns[i], name)) return i;
        }
        return std::nullopt;
    }

    size_t channel_index(const FaceChannel& channel) {
        const auto found = std::find(rows_.channels.begin(), rows_.channels.end(), channel);
        if (found == rows_.channels.end()) {
            rows_.channels.push_back(channel);
            return rows_.channels.size() - 1;
        }
        return static_cast<size_t>(found - rows_.channels.begin());
    }

    void find_coefficients() {
        std::vector<std::string> seen;
        for (size_t i = 0; i < table_.columns.size(); ++i) {
            const std::string name = to_lower(table_.columns[i]);
            if (std::find(seen.begin(), seen.end(), name) != seen.end())
                throw Error(format("{}: the column \"{}\" comes twice", table_.where, table_.columns[i]));
            seen.push_back(name);
            const Coefficient* coefficient = coefficient_named(name);
            if (!coefficient) continue;
            ++coefficients_;
            const FaceChannel& channel = coefficient->channel;
            const bool of_jaw = channel.unit == 26 || channel.unit == 8;
            if (channel.unit > 0) shown_.push_back({i, channel_index(channel), of_jaw ? kWholeDrop : 1});
        }
        jaw_ = column_of("jawOpen");
        close_ = column_of("mouthClose");
        if (jaw_) lips_ = channel_index({25, FaceSide::both});
    }

    // Live Link Face leaves the coefficients out where it sees no face.
    bool is_tracked(const CsvRow& row) const {
        if (count_ && row.cells[*count_] == "0") return false;
        if (row.values < table_.width) refuse_row_width(table_, row);
        return true;
    }

    void take_times(std::optional<double> fps) {
        const auto column = column_of("timecode");
        if (!column) {
            RowTimes when = row_times(table_, fps);
            rows_.times = std::move(when.times);
            rows_.resolution = when.resolution;
            return;
        }
        std::vector<TimeCode> codes;
        for (const CsvRow& row : table_.rows) codes.push_back(code_in(row, *column));
        const double rate = rate_of(codes, fps);
        rows_.times = seconds_of_time_codes(codes, rate);
        rows_.resolution = 0.001 / rate;
        rows_.notes.push_back(
            format("time codes: they count {:.6g} frames in a second{}", rate, fps ? ", set by hand" : ""));
        const double start = rows_.times.front();
        for (double& time : rows_.times) time -= start;
    }

    TimeCode code_in(const CsvRow& row, size_t column) const {
        if (const auto code = parse_time_code(row.cells[column])) return *code;
        throw Error(format("{}column \"{}\": \"{}\" is no time code; HH:MM:SS:FF.fff is expected",
                           table_.at(row), table_.columns[column], row.cells[column].substr(0, 40)));
    }

    double rate_of(const std::vector<TimeCode>& codes, std::optional<double> fps) const {
        const auto found = fps ? fps : rate_of_time_codes(codes);
        if (!found) {
            throw Error(
                format("{}: how many frames in a second the time codes count cannot be found from them; "
                       "set it with --motion-fps",
                       table_.where));
        }
        for (size_t n = 0; n < codes.size(); ++n) {
            if (codes[n].frames < *found) continue;
            throw Error(format("{}frame {} of a second that has {:.6g}; set another rate with --motion-fps",
                               table_.at(table_.rows[n]), codes[n].frames, *found));
        }
        return *found;
    }

    float coefficient_in(const CsvRow& row, std::optional<size_t> column) const {
        return column ? intensity_in(table_, row, *column, kCoefficientToIntensity) / 5 : 0;
    }

    void append_intensities(size_t n) {
        const size_t begin = rows_.intensities.size();
        rows_.intensities.resize(begin + rows_.channels.size(), 0);
        if (rows_.confidence[n] == 0) return;
        const CsvRow& row = table_.rows[n];
        for (const Shown& shown : shown_) {
            float& intensity = rows_.intensities[begin + shown.channel];
            const float read = intensity_in(table_, row, shown.column, kCoefficientToIntensity);
            intensity = std::max(intensity, std::min(read / shown.whole, 5.0f));
        }
        if (jaw_) {
            const float parted = (coefficient_in(row, jaw_) - coefficient_in(row, close_)) / kWholeDrop;
            rows_.intensities[begin + lips_] = 5 * std::clamp(parted, 0.0f, 1.0f);
        }
    }

    // (N, K) radians; nothing if the columns are missing or 0 throughout, which is how they are switched off.
    template <size_t N>
    std::optional<std::vector<float>> read_angles(const std::array<std::string_view, N>& names) {
        const auto columns = find_group(table_, names);
        if (!columns) return std::nullopt;
        std::vector<float> angles(table_.rows.size() * N, 0);
        for (size_t n = 0; n < table_.rows.size(); ++n) {
            if (rows_.confidence[n] == 0) continue;
            for (size_t i = 0; i < N; ++i)
                angles[n * N + i] = angle_in(table_, table_.rows[n], (*columns)[i], kMostAngle);
        }
        if (std::any_of(angles.begin(), angles.end(), [](float angle) { return angle != 0; })) return angles;
        rows_.notes.push_back(format("{}: 0 in every row, so nothing is known of it",
                                     join(std::vector<std::string>(names.begin(), names.end()))));
        return std::nullopt;
    }

    void take_head() {
        const auto angles = read_angles(kHeadAngles);
        if (!angles) return;
        for (size_t n = 0; n < table_.rows.size(); ++n) {
            const float* turn = angles->data() + 3 * n;
            rows_.head.push_back(
                normalize(glm::angleAxis(turn[0], Vec3(0, 1, 0)) * glm::angleAxis(-turn[1], Vec3(1, 0, 0)) *
                          glm::angleAxis(turn[2], Vec3(0, 0, 1))));
        }
        rows_.notes.emplace_back("head: yaw to the person's left, pitch up, roll with the left ear up");
    }

    // (N, 4) in the order of kEyes; nothing without eyeLook coefficients.
    std::optional<std::vector<float>> read_looks() const {
        std::array<std::string_view, 8> names;
        for (size_t i = 0; i < 8; ++i) names[i] = kLooks[i / 2][i % 2];
        const auto columns = find_group(table_, names);
        if (!columns) return std::nullopt;
        std::vector<float> looks(table_.rows.size() * 4, 0);
        for (size_t n = 0; n < table_.rows.size(); ++n) {
            if (rows_.confidence[n] == 0) continue;
            for (size_t i = 0; i < 4; ++i) {
                looks[n * 4 + i] = coefficient_in(table_.rows[n], (*columns)[2 * i]) -
                                   coefficient_in(table_.rows[n], (*columns)[2 * i + 1]);
            }
        }
        return looks;
    }

    void take_gaze() {
        auto angles = read_angles(kEyes);
        const auto looks = read_looks();
        if (angles && looks) agree(*angles, *looks);
        if (!angles && looks) {
            angles = *looks;
            for (size_t i = 0; i < angles->size(); ++i) (*angles)[i] *= i % 2 ? kGazeUp : kGazeSideways;
            rows_.notes.emplace_back("gaze: by the eyeLook coefficients, 1 is 45 degrees sideways, 30 up");
        }
        if (!angles) return;
        for (size_t n = 0; n < table_.rows.size(); ++n) {
            const float* eye = angles->data() + 4 * n;
            rows_.gaze.push_back({{eye[0], eye[1]}, {eye[2], eye[3]}});
        }
    }

    // Turns an axis around that runs against the coefficients, which say in words where they look.
    void agree(std::vector<float>& angles, const std::vector<float>& looks) {
        for (size_t axis = 0; axis < 2; ++axis) {
            double sum = 0;
            for (size_t i = axis; i < angles.size(); i += 2) sum += double(angles[i]) * double(looks[i]);
            if (sum >= 0) continue;
            for (size_t i = axis; i < angles.size(); i += 2) angles[i] = -angles[i];
            rows_.notes.push_back(format("gaze: the eyes' {} counts {}, as the eyeLook coefficients show",
                                         axis ? "pitch" : "yaw", axis ? "down" : "to the person's right"));
        }
    }

    void note_unshown() {
        std::vector<std::string> unshown;
        for (const std::string_view name : kUnshown) {
            const auto column = column_of(name);
            if (!column) continue;
            float most = 0;
            for (size_t n = 0; n < table_.rows.size(); ++n) {
                if (rows_.confidence[n] > 0) most = std::max(most, coefficient_in(table_.rows[n], column));
            }
            if (most > 0) unshown.push_back(format("{} (up to {:.2f})", name, most));
        }
        if (!unshown.empty()) rows_.notes.push_back(format("no action unit, left out: {}", join(unshown)));
    }

    const CsvTable& table_;
    std::optional<size_t> count_;
    std::optional<size_t> jaw_, close_;
    size_t lips_ = 0;  // channel 25
    size_t coefficients_ = 0;
    std::vector<Shown> shown_;
    FaceRows rows_;
};

}  // namespace

bool looks_like_arkit(const std::vector<std::string>& columns) {
    const auto coefficients = std::ranges::count_if(
        columns, [](const std::string& column) { return coefficient_named(column) != nullptr; });
    return coefficients >= kLeastCoefficients ||
           (coefficients > 0 && std::ranges::all_of(columns, is_column_of_arkit));
}

Motion face_of_arkit(std::string_view text, const std::string& where, std::optional<double> fps) {
    const CsvTable table =
        parse_csv_table(text, where, {.keeps = is_column_of_arkit, .allows_short_rows = true});
    FaceRows rows = ArkitReader(table).run(fps);
    const bool coded = find_column(table, {"timecode"}).has_value();
    return face_of_rows(rows, coded ? std::nullopt : fps);
}

}  // namespace chironomia
