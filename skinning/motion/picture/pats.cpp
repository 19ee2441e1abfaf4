#include "skinning/motion/picture/pats.h"

#include <algorithm>

#include "core/text.h"
#include "skinning/body/keypoint_layout.h"
#include "skinning/motion/points/keypoint_data.h"

namespace chironomia {
namespace {

// x of all points and then y of all points, in a row for each frame.
struct Rows {
    size_t frames = 0;
    size_t points = 0;
    std::vector<double> numbers;  // (T, 2, K)
};

Rows read_rows(const Hdf5File& file, const std::string& path) {
    Hdf5Array array = file.read(path);
    if (array.numbers.empty()) file.refuse(format("/{} holds no numbers", path));
    if (array.shape.size() == 3 && array.shape[1] == 2) array.shape = {array.shape[0], 2 * array.shape[2]};
    if (array.shape.size() != 2 || array.shape[1] % 2 != 0) {
        file.refuse(format("/{} has the shape ({}); (T, 2 K) is expected, x of K points and then y of them",
                           path, fmt::join(array.shape, ", ")));
    }
    return {.frames = array.shape[0], .points = array.shape[1] / 2, .numbers = std::move(array.numbers)};
}

// Of a group such as /pose: the layout that has as many points.
const KeypointLayout& layout_of(const Hdf5File& file, const std::string& path, size_t points,
                                std::initializer_list<std::string_view> known) {
    for (const KeypointLayout& layout : picture_layouts()) {
        if (layout.points.size() == points &&
            std::find(known.begin(), known.end(), layout.name) != known.end())
            return layout;
    }
    file.refuse(format("/{} has {} points; {} are known", path, points, fmt::join(known, ", ")));
}

// One group's points behind those that are there.
struct Group {
    std::string path;  // of the places
    Rows places;
    std::vector<double> confidence;  // (T, K); empty: all are seen
    const KeypointLayout* layout = nullptr;
};

Group read_group(const Hdf5File& file, const std::string& name,
                 std::initializer_list<std::string_view> known) {
    Group group;
    group.path = name + (file.has(name + "/data") ? "/data" : "/normalize");
    group.places = read_rows(file, group.path);
    group.layout = &layout_of(file, group.path, group.places.points, known);
    const std::string path = name + "/confidence";
    if (!file.has(path)) return group;
    const Rows sure = read_rows(file, path);
    if (sure.frames != group.places.frames || sure.points != group.places.points) {
        file.refuse(format("/{} has {} frames of {} points, /{} has {} of {}", path, sure.frames, sure.points,
                           group.path, group.places.frames, group.places.points));
    }
    for (size_t t = 0; t < sure.frames; ++t) {
        const auto row = sure.numbers.begin() + static_cast<std::ptrdiff_t>(t * 2 * sure.points);
        group.confidence.insert(group.confidence.end(), row, row + static_cast<std::ptrdiff_t>(sure.points));
    }
    return group;
}

void append_frame(KeypointData& data, const Group& group, size_t t) {
    const size_t count = group.places.points;
    const double* x = group.places.numbers.data() + t * 2 * count;
    for (size_t k = 0; k < count; ++k) {
        data.places.insert(data.places.end(), {x[k], x[count + k], 0});
        data.confidence.push_back(group.confidence.empty() ? 1 : group.confidence[t * count + k]);
    }
}

std::optional<double> stored_rate(const Hdf5File& file) {
    for (const char* path : {"", "meta", "pose"}) {
        if (!file.has(path)) continue;
        if (const auto rate = file.attribute(path, "fps")) return rate;
    }
    return std::nullopt;
}

}  // namespace

bool holds_pats(const Hdf5File& file) {
    return file.has("pose/data") || file.has("pose/normalize");
}

Motion read_pats(const Hdf5File& file, std::optional<double> fps) {
    std::vector<Group> groups = {read_group(file, "pose", {"PATS 52", "PATS 11"})};
    if (file.has("face/data") || file.has("face/normalize"))
        groups.push_back(read_group(file, "face", {"OpenPose face 70", "PATS face 15"}));
    KeypointData data;
    data.where = file.where();
    data.picture = true;
    data.frames = groups[0].places.frames;
    data.fps = stored_rate(file).value_or(kPatsFps);
    for (const Group& group : groups) {
        if (group.places.frames != data.frames) {
            file.refuse(format("/{} has {} frames, /{} has {}", group.path, group.places.frames,
                               groups[0].path, data.frames));
        }
        for (const LayoutPoint& point : group.layout->points) {
            data.names.emplace_back(point.theirs);
            data.ours.push_back(point.name());
        }
        data.notes.push_back(format("PATS: /{}, {}", group.path, group.layout->name));
    }
    data.points = data.names.size();
    for (size_t t = 0; t < data.frames; ++t) {
        for (const Group& group : groups) append_frame(data, group, t);
    }
    return name_keypoints(std::move(data), fps, {});
}

}  // namespace chironomia
