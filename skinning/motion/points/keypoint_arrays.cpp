#include "skinning/motion/points/keypoint_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/points/keypoint_json.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> kUsualNames = {
    "keypoints", "keypoints3d", "keypoints_3d", "poses3d", "poses_3d", "joints", "joints3d",
    "joints_3d", "positions",   "positions_3d", "points",  "xyz",      "data",   ""};

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), to_lower(name)) != names.end();
}

bool has_usual_name(const NumpyArray& array) {
    return std::find(kUsualNames.begin(), kUsualNames.end(), to_lower(array.name)) != kUsualNames.end();
}

// (T, 1, K, 3) of one person.
bool has_one_person_inside(const std::vector<size_t>& shape) {
    return shape.size() == 4 && shape[0] != 1 && shape[1] == 1;
}

std::vector<size_t> squeezed(std::vector<size_t> shape) {
    while (shape.size() > 3 && shape.front() == 1) shape.erase(shape.begin());
    if (has_one_person_inside(shape)) shape.erase(shape.begin() + 1);
    return shape;
}

// T frames of K points of so many columns (3, or 4 with confidence; 2 in a picture).
struct Layout {
    size_t frames = 0, points = 0, columns = 0;
    std::vector<size_t> parts{};  // of a picture that lists x of some points, then y of them, then the next
};

// The points of rows that models of gestures put out, by the width of a row: a body, a face, or both.
std::optional<std::vector<size_t>> parts_of_row(size_t width) {
    switch (width) {
        case 22:
            return {{11}};
        case 104:
            return {{52}};
        case 30:
            return {{15}};
        case 140:
            return {{70}};
        case 52:
            return {{11, 15}};
        case 244:
            return {{52, 70}};
        default:
            return std::nullopt;
    }
}

Layout picture_rows(size_t frames, std::vector<size_t> parts) {
    const size_t points = std::accumulate(parts.begin(), parts.end(), size_t{0});
    return {.frames = frames, .points = points, .columns = 2, .parts = std::move(parts)};
}

bool is_known_count(size_t points) {
    return std::any_of(keypoint_layouts().begin(), keypoint_layouts().end(),
                       [&](const KeypointLayout& layout) { return layout.points.size() == points; });
}

// Whether every fourth number can be a confidence.
bool has_confidences(const std::vector<double>& numbers) {
    for (size_t i = 3; i < numbers.size(); i += 4) {
        if (!(numbers[i] >= 0 && numbers[i] <= kMostConfidence) && !std::isnan(numbers[i])) return false;
    }
    return true;
}

// A row of K * 3 or K * 4 numbers, if only one K makes sense.
std::optional<Layout> flat_layout(const NumpyArray& array, size_t frames, size_t width, size_t names) {
    std::vector<Layout> fitting;
    for (const size_t columns : {size_t{3}, size_t{4}}) {
        if (width % columns != 0 || (columns == 4 && !has_confidences(array.numbers))) continue;
        const size_t points = width / columns;
        if (names > 0 ? points == names : is_known_count(points))
            fitting.push_back({frames, points, columns});
    }
    if (fitting.size() != 1) return std::nullopt;
    return fitting[0];
}

// As many numbers a frame as ARKit has coefficients of a face, all of them shares. Points of a body and a face, which
// are as many, lie around its neck or in a picture.
bool are_weights_of_arkit(const NumpyArray& array) {
    constexpr double kRounding = 0.01;
    return array.shape.size() == 2 && array.shape[1] == 52 && !array.numbers.empty() &&
           std::ranges::all_of(array.numbers,
                               [](double number) { return number >= -kRounding && number <= 1 + kRounding; });
}

std::optional<Layout> layout_of(const NumpyArray& array, size_t names) {
    if (array.numbers.empty()) return std::nullopt;
    const std::vector<size_t> shape = squeezed(array.shape);
    if (shape.size() == 2) {
        const auto parts = names == 0 ? parts_of_row(shape[1]) : std::nullopt;
        return parts ? picture_rows(shape[0], *parts) : flat_layout(array, shape[0], shape[1], names);
    }
    if (shape.size() != 3) return std::nullopt;
    if (shape[1] == 2 && names == 0) {
        if (const auto parts = parts_of_row(2 * shape[2])) return picture_rows(shape[0], *parts);
    }
    if (shape[2] < 2 || shape[2] > 4) return std::nullopt;
    return Layout{.frames = shape[0], .points = shape[1], .columns = shape[2]};
}

std::string describe_all(const std::vector<NumpyArray>& arrays) {
    std::vector<std::string> all;
    for (const NumpyArray& array : arrays) all.push_back(describe(array));
    return all.empty() ? "none" : join(all);
}

const NumpyArray* find_array(const std::vector<NumpyArray>& arrays,
                             std::initializer_list<std::string_view> names) {
    for (const NumpyArray& array : arrays) {
        if (is_one_of(array.name, names)) return &array;
    }
    return nullptr;
}

// Turns of a body model look like flat points (165 = 55 * 3) but are none, and so do the weights of its face.
void refuse_body_model(const std::vector<NumpyArray>& arrays, const std::string& where) {
    if (!find_array(arrays, {"poses", "body_pose", "pose_body", "smpl_poses"})) {
        const bool has_points = std::any_of(arrays.begin(), arrays.end(),
                                            [](const NumpyArray& array) { return array.shape.size() > 2; });
        if (has_points || !find_array(arrays, {"betas"}) || !find_array(arrays, {"trans", "transl"})) return;
        throw Error(format(
            "{}: holds shape and place of the SMPL body model, but no turns of its joints ({}); store them "
            "as \"poses\" (T, 165), (T, 156), (T, 72) or (T, 66)",
            where, describe_all(arrays)));
    }
    if (!find_array(arrays, {"betas", "trans", "transl", "global_orient", "root_orient", "expressions"}))
        return;
    throw Error(format(
        "{}: these are turns of the SMPL body model, but not in the layout that is read ({}); store "
        "all of them as \"poses\" (T, 165), (T, 156), (T, 72) or (T, 66), or in parts with \"global_orient\" and \"body_pose\"",
        where, describe_all(arrays)));
}

// What to do with arrays none of which holds points: those of sets of motions have features instead.
std::string remedy_without_points(const std::vector<NumpyArray>& arrays) {
    for (const NumpyArray& array : arrays) {
        if (array.type.ends_with('O')) {
            return format(
                "{} was pickled, as NumPy does with dictionaries and lists, in which any program could be, "
                "so it is not read; save the numbers in it as arrays, by numpy.savez",
                describe(array));
        }
        if (are_weights_of_arkit(array)) {
            return "52 numbers a frame from 0 to 1 are the weights of ARKit's blendshapes, in an order that an array "
                   "does not say; save them as a .csv whose first line is time and their names (jawOpen, ...), or as "
                   ".json with \"names\" and \"frames\"; if they are 26 points of a picture, save them in pixels";
        }
        if (array.shape.size() != 2) continue;
        if (array.shape[1] == 263 || array.shape[1] == 251) {
            return format(
                "{} numbers a frame are features of HumanML3D or KIT-ML; save the joints, (T, {}, 3), that its "
                "recover_from_ric makes of them",
                array.shape[1], array.shape[1] == 263 ? 22 : 21);
        }
        if (array.shape[1] == 322)
            return "322 numbers a frame are those of Motion-X; save the first 156, turns as SMPL-H has them";
        if (array.shape[1] == 265) {
            return "265 numbers a frame are those of TalkSHOW, whose turns of jaw and eyes come first; save "
                   "numpy.concatenate([a[:, 9:75], a[:, :9], a[:, 75:165]], 1), turns as SMPL-X has them";
        }
    }
    return "turns of SMPL are read as axes times angles, (T, 165), (T, 156), (T, 72) or (T, 66)";
}

const NumpyArray& choose_array(const std::vector<NumpyArray>& arrays, size_t names,
                               const std::string& where) {
    std::vector<const NumpyArray*> fitting, inside, usual;
    for (const NumpyArray& array : arrays) {
        if (layout_of(array, names) && !are_weights_of_arkit(array))
            (has_one_person_inside(array.shape) ? inside : fitting).push_back(&array);
    }
    if (fitting.empty()) fitting = inside;
    for (const NumpyArray* array : fitting) {
        if (has_usual_name(*array)) usual.push_back(array);
    }
    if (fitting.size() == 1) return *fitting[0];
    if (usual.size() == 1) return *usual[0];
    throw Error(format(
        "{}: {} arrays can be keypoints of shape (T, K, 3) or (T, K, 4), or (T, K, 2) in a picture; "
        "the arrays are {}; {}",
        where, fitting.size(), describe_all(arrays),
        fitting.empty() ? remedy_without_points(arrays) : "leave one of them, or call it \"keypoints\""));
}

// x of all points of a part, then y of them, then the next part.
void take_rows(KeypointData& data, const NumpyArray& array, const Layout& layout) {
    for (const size_t part : layout.parts) {
        for (const KeypointLayout& known : picture_layouts()) {
            if (known.points.size() != part) continue;
            data.notes.push_back(format("picture: {}, by the number of points", known.name));
            for (const LayoutPoint& point : known.points) {
                data.names.emplace_back(point.theirs);
                data.ours.push_back(point.name());
            }
        }
    }
    const double* row = array.numbers.data();
    for (size_t t = 0; t < layout.frames; ++t) {
        for (const size_t part : layout.parts) {
            for (size_t k = 0; k < part; ++k)
                data.places.insert(data.places.end(), {row[k], row[part + k], 0});
            row += 2 * part;
        }
    }
}

// MoveNet puts y before x, which nothing but its shape and its shares shows.
void refuse_movenet(const NumpyArray& array, const Layout& layout, const std::string& where) {
    const bool has_shape = has_one_person_inside(array.shape) && layout.points == 17 && layout.columns == 3;
    const auto is_share = [](double number) { return std::isnan(number) || (number >= 0 && number <= 1); };
    if (!has_shape || !std::ranges::all_of(array.numbers, is_share)) return;
    throw Error(
        format("{}: {} of shares is what MoveNet writes, y before x; save it as (frames, 17, 3) of x, y and "
               "confidence, as a[:, 0][..., [1, 0, 2]] of NumPy is",
               where, describe(array)));
}

// Four numbers of a joint may be a turn, x, y, z and w in any order; places and confidences are no unit vectors.
void refuse_quaternions(const NumpyArray& array, const Layout& layout, const std::string& where) {
    if (layout.columns != 4 || array.numbers.empty()) return;
    for (size_t i = 0; i + 4 <= array.numbers.size(); i += 4) {
        const double* q = array.numbers.data() + i;
        if (!(std::abs(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) - 1) <
              kQuaternionTolerance))
            return;
    }
    throw Error(format(
        "{}: the four numbers of every point of {} make 1 as those of quaternions, so they are turns and not "
        "x, y, z and a confidence; save the places of joints, (T, {}, 3), or turns as SMPL or BVH has them",
        where, describe(array), layout.points));
}

void take_places(KeypointData& data, const NumpyArray& array, const Layout& layout) {
    refuse_movenet(array, layout, data.where);
    refuse_quaternions(array, layout, data.where);
    data.frames = layout.frames;
    data.points = layout.points;
    data.picture = layout.columns == 2;
    data.unnamed_third = layout.columns == 3;
    if (!layout.parts.empty()) return take_rows(data, array, layout);
    for (size_t i = 0; i < layout.frames * layout.points; ++i) {
        const double* values = array.numbers.data() + i * layout.columns;
        data.places.insert(data.places.end(), {values[0], values[1], layout.columns == 2 ? 0 : values[2]});
        if (layout.columns == 4) data.confidence.push_back(values[3]);
    }
}

// A body and a face that a model put out as two arrays, side by side.
std::optional<NumpyArray> body_with_face(const std::vector<NumpyArray>& arrays) {
    const NumpyArray* body = find_array(arrays, {"pose"});
    const NumpyArray* face = find_array(arrays, {"face"});
    if (!body || !face || body->shape.size() != 2 || face->shape.size() != 2) return std::nullopt;
    const size_t frames = body->shape[0], width = body->shape[1], more = face->shape[1];
    if (face->shape[0] != frames || body->numbers.empty() || face->numbers.empty()) return std::nullopt;
    NumpyArray both{.name = "pose and face",
                    .type = body->type,
                    .shape = {frames, width + more},
                    .numbers = {},
                    .texts = {}};
    for (size_t t = 0; t < frames; ++t) {
        const auto append = [&](const std::vector<double>& numbers, size_t columns) {
            const auto row = numbers.begin() + static_cast<std::ptrdiff_t>(t * columns);
            both.numbers.insert(both.numbers.end(), row, row + static_cast<std::ptrdiff_t>(columns));
        };
        append(body->numbers, width);
        append(face->numbers, more);
    }
    if (!layout_of(both, 0) || layout_of(both, 0)->parts.size() != 2) return std::nullopt;
    return both;
}

void take_confidence(KeypointData& data, const std::vector<NumpyArray>& arrays) {
    const NumpyArray* array = find_array(arrays, kConfidenceNames);
    if (!array || !data.confidence.empty()) return;
    if (array->numbers.size() != data.frames * data.points) {
        throw Error(format("{}: {} does not fit {} frames of {} points", data.where, describe(*array),
                           data.frames, data.points));
    }
    data.confidence = array->numbers;
    data.unnamed_third = false;
}

void check_name_count(const KeypointData& data) {
    if (data.names.empty() || data.names.size() == data.points) return;
    throw Error(format("{}: {} names for {} points", data.where, data.names.size(), data.points));
}

// The other file of a pair: the longest stem that both share.
std::vector<fs::path> beside(const fs::path& file, const std::string& extension, auto&& fits) {
    std::vector<fs::path> found;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == extension && fits(entry.path().stem().string()))
            found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool begins(std::string_view longer, std::string_view shorter) {
    return longer == shorter ||
           (longer.starts_with(shorter) &&
            std::string_view("_-.").find(longer[shorter.size()]) != std::string_view::npos);
}

std::string list_files(const std::vector<fs::path>& files) {
    std::vector<std::string> names;
    for (const fs::path& file : files) names.push_back(file.filename().string());
    return join(names);
}

NumpyArray read_npy(const fs::path& file) {
    return parse_npy(read_bytes(file), file.string());
}

KeypointData join_description(const fs::path& array_file, const fs::path& json_file, const Json& json) {
    const std::vector<NumpyArray> arrays = {read_npy(array_file)};
    KeypointData data;
    data.where = array_file.string();
    data.companions = {array_file, json_file};
    data.names = names_in(json, json_file.string());
    data.fps = rate_in(json, json_file.string());
    const NumpyArray& chosen = choose_array(arrays, data.names.size(), data.where);
    take_places(data, chosen, *layout_of(chosen, data.names.size()));
    check_name_count(data);
    data.notes.push_back(format("described by {}", json_file.filename().string()));
    return data;
}

}  // namespace

KeypointData keypoints_of_arrays(const std::vector<NumpyArray>& arrays, const std::string& where) {
    refuse_body_model(arrays, where);
    KeypointData data;
    data.where = where;
    if (const auto* names =
            find_array(arrays, {"names", "joint_names", "keypoint_names", "point_names", "labels"})) {
        data.names = names->texts;
    }
    const auto* rate =
        find_array(arrays, {"fps", "frame_rate", "framerate", "mocap_frame_rate", "mocap_framerate"});
    if (rate && rate->numbers.size() == 1) data.fps = rate->numbers[0];
    const std::optional<NumpyArray> both = body_with_face(arrays);
    const NumpyArray& array = both ? *both : choose_array(arrays, data.names.size(), where);
    take_places(data, array, *layout_of(array, data.names.size()));
    take_confidence(data, arrays);
    check_name_count(data);
    data.notes.push_back(format("NumPy: {}", describe(array)));
    return data;
}

KeypointData read_npy_keypoints(const fs::path& file, const NumpyArray& array) {
    const std::string stem = file.stem().string();
    std::vector<fs::path> fitting =
        beside(file, ".json", [&](const std::string& other) { return begins(stem, other); });
    const auto same =
        std::find_if(fitting.begin(), fitting.end(), [&](const fs::path& f) { return f.stem() == stem; });
    if (same != fitting.end()) fitting = {fs::path(*same)};
    if (fitting.size() > 1) {
        throw Error(format("{}: several JSON files may describe it: {}; keep one", file.string(),
                           list_files(fitting)));
    }
    if (fitting.empty()) return keypoints_of_arrays({array}, file.string());
    return join_description(file, fitting[0], read_json(fitting[0]));
}

KeypointData read_described_keypoints(const fs::path& json_file, const Json& json) {
    if (json.contains("file") && json["file"].is_string()) {
        return join_description(json_file.parent_path() / json["file"].get<std::string>(), json_file, json);
    }
    const std::string stem = json_file.stem().string();
    const auto arrays =
        beside(json_file, ".npy", [&](const std::string& other) { return begins(other, stem); });
    if (arrays.size() == 1) return join_description(arrays[0], json_file, json);
    throw Error(
        format("{}: it has no frames, and describes {} arrays beside it ({}); name the array under \"file\"",
               json_file.string(), arrays.size(), list_files(arrays)));
}

}  // namespace chironomia
