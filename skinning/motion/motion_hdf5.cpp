#include "skinning/motion/motion_hdf5.h"

#include <hdf5.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::string_view kFormat = "chironomia motion";
constexpr std::string_view kUnits = "m, unit quaternions x y z w";
constexpr double kMostNumber = 1e9;  // no place, turn or rate of a body is larger

// One open thing of HDF5.
class Handle {
  public:
    using Close = herr_t (*)(hid_t);

    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }

    operator hid_t() const { return id_; }
    hid_t release() { return std::exchange(id_, -1); }
    explicit operator bool() const { return id_ >= 0; }

  private:
    hid_t id_;
    Close close_;
};

// HDF5 prints every failed call to stderr unless told otherwise; the messages here are ours.
class QuietErrors {
  public:
    QuietErrors() {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    H5E_auto2_t print_ = nullptr;
    void* data_ = nullptr;
};

// A file in memory that is written to the disk when it is closed.
Handle memory_access() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, size_t{1} << 20, true);
    // Since 1.8 there is a layout with a checksum at every header, so damage is seen before it is followed.
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    return access;
}

Handle text_type(size_t size) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<size_t>(size, 1));
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    return type;
}

class Writer {
  public:
    Writer(const std::filesystem::path& file, std::string where)
        : where_(std::move(where)),
          creation_(H5Pcreate(H5P_FILE_CREATE), H5Pclose),
          access_(memory_access()),
          file_(create(file), H5Fclose) {}

    void write_attribute(const char* name, std::string_view text) {
        const Handle type = text_type(text.size());
        const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
        const Handle attribute(H5Acreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        check(H5Awrite(attribute, type, text.data()));
    }

    void write_attribute(const char* name, int32_t value) {
        const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
        const Handle attribute(H5Acreate2(file_, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
        check(H5Awrite(attribute, H5T_NATIVE_INT32, &value));
    }

    void make_group(const char* name) {
        const Handle creation = untimed(H5P_GROUP_CREATE);
        check(Handle(H5Gcreate2(file_, name, H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose));
    }

    void write(const char* name, hid_t stored, hid_t given, std::vector<hsize_t> shape, const void* data) {
        const Handle creation = untimed(H5P_DATASET_CREATE);
        const Handle space(shape.empty()
                               ? H5Screate(H5S_SCALAR)
                               : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                           H5Sclose);
        const Handle set(H5Dcreate2(file_, name, stored, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                         H5Dclose);
        check(set);
        check(H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
    }

    void write_floats(const char* name, std::vector<hsize_t> shape, const float* data) {
        write(name, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, std::move(shape), data);
    }

    void write_texts(const char* name, const std::vector<std::string>& texts) {
        if (texts.empty()) return;
        size_t longest = 1;
        for (const std::string& text : texts) longest = std::max(longest, text.size());
        std::string cells(texts.size() * longest, '\0');
        for (size_t i = 0; i < texts.size(); ++i)
            std::copy(texts[i].begin(), texts[i].end(),
                      cells.begin() + static_cast<std::ptrdiff_t>(i * longest));
        const Handle type = text_type(longest);
        write(name, type, type, {texts.size()}, cells.data());
    }

    // Everything goes to the disk here, and may not fit.
    void close() { check(H5Fclose(file_.release())); }

  private:
    // Without times the same motion gives the same bytes.
    static Handle untimed(hid_t kind) {
        Handle list(H5Pcreate(kind), H5Pclose);
        H5Pset_obj_track_times(list, false);
        return list;
    }

    hid_t create(const std::filesystem::path& file) {
        H5Pset_obj_track_times(creation_, false);
        const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation_, access_);
        check(id < 0 ? -1 : 0);
        return id;
    }

    void check(herr_t result) const {
        if (result < 0)
            throw Error(format("{}: cannot be written; check free space and permissions", where_));
    }
    void check(const Handle& handle) const { check(handle ? 0 : -1); }

    std::string where_;
    QuietErrors quiet_;
    Handle creation_, access_;
    Handle file_;
};

void write_joints(Writer& writer, const JointTrack& track, hsize_t frames) {
    const hsize_t count = track.skeleton.joints.size();
    assert(track.turns.size() == frames * count && track.translations.size() == frames * count);
    std::vector<std::string> names;
    std::vector<int32_t> parents;
    std::vector<float> rest;
    for (const Joint& joint : track.skeleton.joints) {
        names.push_back(joint.name);
        parents.push_back(joint.parent);
        const auto& [place, turn, scale] = joint.rest;
        rest.insert(rest.end(),
                    {place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w, scale.x, scale.y, scale.z});
    }
    static_assert(sizeof(Quat) == 4 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float));
    writer.make_group("joints");
    writer.write_texts("joints/names", names);
    writer.write("joints/parents", H5T_STD_I32LE, H5T_NATIVE_INT32, {count}, parents.data());
    writer.write_floats("joints/rest", {count, 10}, rest.data());
    writer.write_floats("joints/turns", {frames, count, 4}, &track.turns.data()->x);
    writer.write_floats("joints/translations", {frames, count, 3}, &track.translations.data()->x);
}

void write_keypoints(Writer& writer, const KeypointTrack& track, hsize_t frames) {
    const hsize_t count = track.names.size();
    assert(track.points.size() == frames * count && track.confidence.size() == frames * count);
    writer.make_group("keypoints3d");
    writer.write_texts("keypoints3d/names", track.names);
    writer.write_floats("keypoints3d/points", {frames, count, 3}, &track.points.data()->x);
    writer.write_floats("keypoints3d/confidence", {frames, count}, track.confidence.data());
}

void write_picture(Writer& writer, const PictureTrack& track, hsize_t frames) {
    const hsize_t count = track.names.size();
    assert(track.points.size() == frames * count && track.confidence.size() == frames * count);
    writer.make_group("keypoints2d");
    writer.write_texts("keypoints2d/names", track.names);
    writer.write_floats("keypoints2d/points", {frames, count, 2}, &track.points.data()->x);
    writer.write_floats("keypoints2d/confidence", {frames, count}, track.confidence.data());
    writer.write_floats("keypoints2d/size", {2}, &track.size.x);
}

void write_face(Writer& writer, const FaceTrack& track, hsize_t frames) {
    const hsize_t count = track.channels.size();
    assert(track.intensities.size() == frames * count);
    std::vector<std::string> names;
    for (const FaceChannel& channel : track.channels) names.push_back(to_text(channel));
    writer.make_group("face");
    if (count > 0) {
        writer.write_texts("face/channels", names);
        writer.write_floats("face/intensities", {frames, count}, track.intensities.data());
    }
    static_assert(sizeof(Gaze) == 4 * sizeof(float));
    if (!track.head.empty()) writer.write_floats("face/head", {frames, 4}, &track.head.data()->x);
    if (!track.gaze.empty()) writer.write_floats("face/gaze", {frames, 4}, &track.gaze.data()->left.x);
    if (!track.confidence.empty()) writer.write_floats("face/confidence", {frames}, track.confidence.data());
}

void write_labels(Writer& writer, const std::vector<LabelTrack>& tracks, hsize_t frames) {
    writer.make_group("labels");
    std::vector<std::string> names;
    for (const LabelTrack& track : tracks) names.push_back(track.name);
    writer.write_texts("labels/names", names);
    for (size_t i = 0; i < tracks.size(); ++i) {
        assert(tracks[i].frames.size() == frames);
        const std::string group = format("labels/{}", i);
        writer.make_group(group.c_str());
        writer.write_texts((group + "/values").c_str(), tracks[i].values);
        writer.write((group + "/frames").c_str(), H5T_STD_I32LE, H5T_NATIVE_INT, {frames},
                     tracks[i].frames.data());
    }
}

std::string shape_text(const std::vector<size_t>& shape) {
    return format("({})", fmt::join(shape, ", "));
}

class Reader {
  public:
    explicit Reader(const Hdf5File& file) : file_(file) {}

    [[noreturn]] void refuse(const std::string& message) const { file_.refuse(message); }
    bool has(const std::string& path) const { return file_.has(path); }
    std::vector<size_t> shape_of(const std::string& path) const { return file_.shape_of(path); }

    // Numbers of an array whose shape must be `shape`; kAny fits any extent.
    static constexpr size_t kAny = ~size_t{0};
    std::vector<double> read_numbers(const std::string& path, const std::vector<size_t>& shape) const {
        check_shape(path, shape);
        std::vector<double> numbers = file_.read(path).numbers;
        if (numbers.empty() && !is_empty(path)) refuse(format("/{} holds no numbers", path));
        for (size_t i = 0; i < numbers.size(); ++i) {
            if (!(std::abs(numbers[i]) < kMostNumber)) {
                refuse(format("/{}: element {} is {}; all must be finite and below {}", path, i, numbers[i],
                              kMostNumber));
            }
        }
        return numbers;
    }

    std::vector<std::string> read_texts(const std::string& path) const {
        check_shape(path, {kAny});
        Hdf5Array array = file_.read(path);
        if (!array.is_text) refuse(format("/{} holds no texts", path));
        return std::move(array.texts);
    }

  private:
    void check_shape(const std::string& path, const std::vector<size_t>& shape) const {
        const std::vector<size_t> found = shape_of(path);
        const auto fits = [](size_t expected, size_t extent) {
            return expected == kAny || expected == extent;
        };
        if (std::equal(shape.begin(), shape.end(), found.begin(), found.end(), fits)) return;
        std::string expected = shape_text(shape);
        const std::string any = format("{}", kAny);
        for (size_t at; (at = expected.find(any)) != std::string::npos;)
            expected.replace(at, any.size(), "any");
        refuse(format("/{} has the shape {}; {} is expected", path, shape_text(found), expected));
    }

    bool is_empty(const std::string& path) const {
        const std::vector<size_t> shape = shape_of(path);
        return std::find(shape.begin(), shape.end(), 0u) != shape.end();
    }

    const Hdf5File& file_;
};

Quat unit_turn(const Reader& reader, const std::string& path, const double* x, size_t index) {
    const glm::dquat turn(x[3], x[0], x[1], x[2]);
    const double size = glm::length(turn);
    if (std::abs(size - 1) > 1e-3) {
        reader.refuse(format("/{}: the turn {} has the length {:.4g}; unit quaternions x y z w are expected",
                             path, index, size));
    }
    // What is exact stays exact, so that writing again gives the same bytes.
    return std::abs(size - 1) < 1e-6 ? Quat(turn) : Quat(glm::normalize(turn));
}

std::vector<Vec3> as_places(const std::vector<double>& numbers) {
    std::vector<Vec3> places;
    places.reserve(numbers.size() / 3);
    for (size_t i = 0; i + 2 < numbers.size(); i += 3)
        places.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return places;
}

Skeleton read_skeleton(const Reader& reader) {
    const std::vector<std::string> names = reader.read_texts("joints/names");
    const size_t count = names.size();
    if (count == 0) reader.refuse("/joints/names is empty");
    const std::vector<double> parents = reader.read_numbers("joints/parents", {count});
    const std::vector<double> rest = reader.read_numbers("joints/rest", {count, 10});
    Skeleton skeleton;
    for (size_t j = 0; j < names.size(); ++j) {
        if (!(parents[j] >= -1 && parents[j] < static_cast<double>(j))) {
            reader.refuse(format(
                "/joints/parents: joint {} (\"{}\") has the parent {}; an earlier joint or -1 is expected", j,
                names[j], parents[j]));
        }
        const double* r = rest.data() + 10 * j;
        skeleton.joints.push_back({names[j],
                                   static_cast<int>(parents[j]),
                                   {.translation = {r[0], r[1], r[2]},
                                    .rotation = unit_turn(reader, "joints/rest", r + 3, j),
                                    .scale = {r[7], r[8], r[9]}}});
    }
    return skeleton;
}

JointTrack read_joints(const Reader& reader, size_t frames) {
    JointTrack track{.skeleton = read_skeleton(reader), .turns = {}, .translations = {}};
    const size_t count = track.skeleton.joints.size();
    const std::vector<double> turns = reader.read_numbers("joints/turns", {frames, count, 4});
    track.translations = as_places(reader.read_numbers("joints/translations", {frames, count, 3}));
    for (size_t i = 0; i < frames * count; ++i) {
        track.turns.push_back(unit_turn(reader, "joints/turns", turns.data() + 4 * i, i));
    }
    return track;
}

// Numbers from 0 to `most`.
std::vector<float> read_between(const Reader& reader, const std::string& path,
                                const std::vector<size_t>& shape, double most) {
    std::vector<float> numbers;
    for (const double number : reader.read_numbers(path, shape)) {
        if (number < 0 || number > most)
            reader.refuse(format("/{} holds {}; numbers from 0 to {} are expected", path, number, most));
        numbers.push_back(static_cast<float>(number));
    }
    return numbers;
}

KeypointTrack read_keypoints(const Reader& reader, size_t frames) {
    KeypointTrack track;
    track.names = reader.read_texts("keypoints3d/names");
    const size_t count = track.names.size();
    if (count == 0) reader.refuse("/keypoints3d/names is empty");
    track.points = as_places(reader.read_numbers("keypoints3d/points", {frames, count, 3}));
    track.confidence = read_between(reader, "keypoints3d/confidence", {frames, count}, 1);
    return track;
}

PictureTrack read_picture(const Reader& reader, size_t frames) {
    PictureTrack track;
    track.names = reader.read_texts("keypoints2d/names");
    const size_t count = track.names.size();
    if (count == 0) reader.refuse("/keypoints2d/names is empty");
    const std::vector<double> places = reader.read_numbers("keypoints2d/points", {frames, count, 2});
    for (size_t i = 0; i < places.size(); i += 2) track.points.emplace_back(places[i], places[i + 1]);
    track.confidence = read_between(reader, "keypoints2d/confidence", {frames, count}, 1);
    const std::vector<double> size = reader.read_numbers("keypoints2d/size", {2});
    track.size = Vec2(size[0], size[1]);
    return track;
}

std::vector<FaceChannel> read_channels(const Reader& reader) {
    std::vector<FaceChannel> channels;
    for (const std::string& name : reader.read_texts("face/channels")) {
        const auto channel = face_channel_named(name);
        if (!channel) {
            reader.refuse(format(
                "/face/channels: \"{}\" is no action unit that is known; \"AU12\" or \"AU12_L\" is meant",
                name));
        }
        if (std::find(channels.begin(), channels.end(), *channel) != channels.end())
            reader.refuse(format("/face/channels: \"{}\" comes twice", name));
        channels.push_back(*channel);
    }
    return channels;
}

FaceTrack read_face(const Reader& reader, size_t frames) {
    FaceTrack track;
    if (reader.has("face/channels")) {
        track.channels = read_channels(reader);
        const size_t count = track.channels.size();
        track.intensities = read_between(reader, "face/intensities", {frames, count}, 5);
    }
    if (reader.has("face/head")) {
        const std::vector<double> turns = reader.read_numbers("face/head", {frames, 4});
        for (size_t t = 0; t < frames; ++t)
            track.head.push_back(unit_turn(reader, "face/head", turns.data() + 4 * t, t));
    }
    if (reader.has("face/gaze")) {
        const std::vector<double> turns = reader.read_numbers("face/gaze", {frames, 4});
        for (size_t i = 0; i < turns.size(); i += 4)
            track.gaze.push_back({{turns[i], turns[i + 1]}, {turns[i + 2], turns[i + 3]}});
    }
    if (reader.has("face/confidence"))
        track.confidence = read_between(reader, "face/confidence", {frames}, 1);
    return track;
}

LabelTrack read_label(const Reader& reader, const std::string& group, std::string name, size_t frames) {
    LabelTrack track{.name = std::move(name), .values = reader.read_texts(group + "/values"), .frames = {}};
    for (const double index : reader.read_numbers(group + "/frames", {frames})) {
        if (index < 0 || index >= static_cast<double>(track.values.size()) || index != std::floor(index)) {
            reader.refuse(format("/{}/frames holds {}; numbers of the {} values are expected", group, index,
                                 track.values.size()));
        }
        track.frames.push_back(static_cast<int>(index));
    }
    return track;
}

std::vector<LabelTrack> read_labels(const Reader& reader, size_t frames) {
    std::vector<LabelTrack> tracks;
    for (std::string& name : reader.read_texts("labels/names"))
        tracks.push_back(read_label(reader, format("labels/{}", tracks.size()), std::move(name), frames));
    return tracks;
}

// The array that tells how many frames there are.
std::string first_array(const Reader& reader) {
    for (const char* path : {"joints", "keypoints3d", "keypoints2d"}) {
        if (reader.has(path)) return format("{}/{}", path, path[0] == 'j' ? "turns" : "points");
    }
    for (const char* path : {"face/intensities", "face/head", "face/gaze"}) {
        if (reader.has(path)) return path;
    }
    reader.refuse("/face holds neither intensities nor head nor gaze");
}

}  // namespace

void write_motion_hdf5(const std::filesystem::path& file, const Motion& motion) {
    PendingOutput output(file, PendingOutput::Kind::file);
    Writer writer(output.path(), file.string());
    writer.write_attribute("format", kFormat);
    writer.write_attribute("version", 1);
    writer.write_attribute("units", kUnits);
    const auto frames = static_cast<uint64_t>(motion.frames);
    writer.write("fps", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &motion.fps);
    writer.write("frames", H5T_STD_U64LE, H5T_NATIVE_UINT64, {}, &frames);
    writer.write_texts("notes", motion.notes);
    if (motion.joints) write_joints(writer, *motion.joints, frames);
    if (motion.keypoints) write_keypoints(writer, *motion.keypoints, frames);
    if (motion.picture) write_picture(writer, *motion.picture, frames);
    if (motion.face) write_face(writer, *motion.face, frames);
    if (!motion.labels.empty()) write_labels(writer, motion.labels, frames);
    writer.close();
    output.commit();
}

Motion motion_of_hdf5(const Hdf5File& file) {
    const Reader reader(file);
    const bool joints = reader.has("joints"), keypoints = reader.has("keypoints3d"),
               picture = reader.has("keypoints2d"), face = reader.has("face");
    if (!reader.has("fps") || !(joints || keypoints || picture || face)) {
        const std::vector<std::string> names = file.names_in("");
        reader.refuse(
            format("this HDF5 file is no motion that is known: it holds {}; /fps and /joints, /keypoints3d, "
                   "/keypoints2d or /face are expected, or /pose/data or /pose/normalize of PATS",
                   names.empty() ? "nothing" : "/" + join(names, ", /")));
    }
    Motion motion{.source = file.where(),
                  .fps = reader.read_numbers("fps", {})[0],
                  .joints = {},
                  .keypoints = {},
                  .notes = {}};
    if (!(motion.fps > 0)) reader.refuse(format("/fps is {}; it must be above 0", motion.fps));
    const auto shape = reader.shape_of(first_array(reader));
    const size_t frames = shape.empty() ? 0 : shape[0];
    if (frames == 0) reader.refuse("the motion has no frames");
    motion.frames = frames;
    if (joints) motion.joints = read_joints(reader, frames);
    if (keypoints) motion.keypoints = read_keypoints(reader, frames);
    if (picture) motion.picture = read_picture(reader, frames);
    if (face) motion.face = read_face(reader, frames);
    if (reader.has("labels")) motion.labels = read_labels(reader, frames);
    if (reader.has("notes")) motion.notes = reader.read_texts("notes");
    return motion;
}

Motion read_motion_hdf5(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    return motion_of_hdf5(Hdf5File(bytes, file.string()));
}

}  // namespace chironomia
