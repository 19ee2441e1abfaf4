#include "skinning/motion/motion_hdf5.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/hdf5/writer.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr std::string_view kFormat = "chironomia motion";
constexpr std::string_view kUnitsOfFile = "m, unit quaternions x y z w";

// The numbers of vectors, turns and gazes one after the other.
template <typename T>
std::span<const float> floats_of(const std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0);
    return {reinterpret_cast<const float*>(items.data()), items.size() * sizeof(T) / sizeof(float)};
}

void write_joints(Hdf5Writer& writer, const JointTrack& track, size_t frames) {
    const size_t count = track.skeleton.joints.size();
    assert(track.turns.size() == frames * count && track.translations.size() == frames * count);
    std::vector<std::string> names;
    std::vector<int> parents;
    std::vector<float> rest;
    for (const Joint& joint : track.skeleton.joints) {
        names.push_back(joint.name);
        parents.push_back(joint.parent);
        const auto& [place, turn, scale] = joint.rest;
        rest.insert(rest.end(),
                    {place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w, scale.x, scale.y, scale.z});
    }
    writer.make_group("joints");
    writer.write_texts("joints/names", names);
    writer.write_ints("joints/parents", {count}, parents);
    writer.write_floats("joints/rest", {count, 10}, rest);
    writer.write_floats("joints/turns", {frames, count, 4}, floats_of(track.turns));
    writer.write_floats("joints/translations", {frames, count, 3}, floats_of(track.translations));
}

void write_keypoints(Hdf5Writer& writer, const KeypointTrack& track, size_t frames) {
    const size_t count = track.names.size();
    assert(track.points.size() == frames * count && track.confidence.size() == frames * count);
    writer.make_group("keypoints3d");
    writer.write_texts("keypoints3d/names", track.names);
    writer.write_floats("keypoints3d/points", {frames, count, 3}, floats_of(track.points));
    writer.write_floats("keypoints3d/confidence", {frames, count}, track.confidence);
}

void write_picture(Hdf5Writer& writer, const PictureTrack& track, size_t frames) {
    const size_t count = track.names.size();
    assert(track.points.size() == frames * count && track.confidence.size() == frames * count);
    writer.make_group("keypoints2d");
    writer.write_texts("keypoints2d/names", track.names);
    writer.write_floats("keypoints2d/points", {frames, count, 2}, floats_of(track.points));
    writer.write_floats("keypoints2d/confidence", {frames, count}, track.confidence);
    writer.write_floats("keypoints2d/size", {2}, {&track.size.x, 2});
    if (track.focal > 0) writer.write_number("keypoints2d/focal", track.focal);
}

void write_face(Hdf5Writer& writer, const FaceTrack& track, size_t frames) {
    const size_t count = track.channels.size();
    assert(track.intensities.size() == frames * count);
    std::vector<std::string> names;
    for (const FaceChannel& channel : track.channels) names.push_back(to_text(channel));
    writer.make_group("face");
    if (count > 0) {
        writer.write_texts("face/channels", names);
        writer.write_floats("face/intensities", {frames, count}, track.intensities);
    }
    if (!track.head.empty()) writer.write_floats("face/head", {frames, 4}, floats_of(track.head));
    if (!track.gaze.empty()) writer.write_floats("face/gaze", {frames, 4}, floats_of(track.gaze));
    if (!track.confidence.empty()) writer.write_floats("face/confidence", {frames}, track.confidence);
}

void write_labels(Hdf5Writer& writer, const std::vector<LabelTrack>& tracks, size_t frames) {
    writer.make_group("labels");
    std::vector<std::string> names;
    for (const LabelTrack& track : tracks) names.push_back(track.name);
    writer.write_texts("labels/names", names);
    for (size_t i = 0; i < tracks.size(); ++i) {
        assert(tracks[i].frames.size() == frames);
        const std::string group = format("labels/{}", i);
        writer.make_group(group);
        writer.write_texts(group + "/values", tracks[i].values);
        writer.write_ints(group + "/frames", {frames}, tracks[i].frames);
    }
}

Quat unit_turn(const Hdf5File& reader, const std::string& path, const double* x, size_t index) {
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

Skeleton read_skeleton(const Hdf5File& reader) {
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

JointTrack read_joints(const Hdf5File& reader, size_t frames) {
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
std::vector<float> read_between(const Hdf5File& reader, const std::string& path,
                                const std::vector<size_t>& shape, double most) {
    std::vector<float> numbers;
    for (const double number : reader.read_numbers(path, shape)) {
        if (number < 0 || number > most)
            reader.refuse(format("/{} holds {}; numbers from 0 to {} are expected", path, number, most));
        numbers.push_back(static_cast<float>(number));
    }
    return numbers;
}

KeypointTrack read_keypoints(const Hdf5File& reader, size_t frames) {
    KeypointTrack track;
    track.names = reader.read_texts("keypoints3d/names");
    const size_t count = track.names.size();
    if (count == 0) reader.refuse("/keypoints3d/names is empty");
    track.points = as_places(reader.read_numbers("keypoints3d/points", {frames, count, 3}));
    track.confidence = read_between(reader, "keypoints3d/confidence", {frames, count}, 1);
    return track;
}

PictureTrack read_picture(const Hdf5File& reader, size_t frames) {
    PictureTrack track;
    track.names = reader.read_texts("keypoints2d/names");
    const size_t count = track.names.size();
    if (count == 0) reader.refuse("/keypoints2d/names is empty");
    const std::vector<double> places = reader.read_numbers("keypoints2d/points", {frames, count, 2});
    for (size_t i = 0; i < places.size(); i += 2) track.points.emplace_back(places[i], places[i + 1]);
    track.confidence = read_between(reader, "keypoints2d/confidence", {frames, count}, 1);
    const std::vector<double> size = reader.read_numbers("keypoints2d/size", {2});
    track.size = Vec2(size[0], size[1]);
    if (reader.has("keypoints2d/focal")) {
        track.focal = reader.read_numbers("keypoints2d/focal", {})[0];
        if (!(track.focal > 0 && std::isfinite(track.focal)) || track.size.x <= 0) {
            reader.refuse(
                format("/keypoints2d/focal is {:.6g} in a picture of {} x {}; it is above 0, and the "
                       "picture has a size",
                       track.focal, track.size.x, track.size.y));
        }
    }
    return track;
}

std::vector<FaceChannel> read_channels(const Hdf5File& reader) {
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

FaceTrack read_face(const Hdf5File& reader, size_t frames) {
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

LabelTrack read_label(const Hdf5File& reader, const std::string& group, std::string name, size_t frames) {
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

std::vector<LabelTrack> read_labels(const Hdf5File& reader, size_t frames) {
    std::vector<LabelTrack> tracks;
    for (std::string& name : reader.read_texts("labels/names"))
        tracks.push_back(read_label(reader, format("labels/{}", tracks.size()), std::move(name), frames));
    return tracks;
}

// The array whose first dimension is the number of frames.
std::string first_array(const Hdf5File& reader) {
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
    Hdf5Writer writer(output.path(), file.string());
    writer.write_attribute("format", kFormat);
    writer.write_attribute("version", 1);
    writer.write_attribute("units", kUnitsOfFile);
    const size_t frames = motion.frames;
    writer.write_number("fps", motion.fps);
    writer.write_count("frames", frames);
    if (motion.first_time != 0) writer.write_number("first_time", motion.first_time);
    writer.write_texts("notes", motion.notes);
    if (motion.joints) write_joints(writer, *motion.joints, frames);
    if (motion.keypoints) write_keypoints(writer, *motion.keypoints, frames);
    if (motion.picture) write_picture(writer, *motion.picture, frames);
    if (motion.face) write_face(writer, *motion.face, frames);
    if (!motion.labels.empty()) write_labels(writer, motion.labels, frames);
    writer.close();
    output.commit();
}

Motion motion_of_hdf5(const Hdf5File& reader) {
    const bool joints = reader.has("joints"), keypoints = reader.has("keypoints3d"),
               picture = reader.has("keypoints2d"), face = reader.has("face");
    if (!reader.has("fps") || !(joints || keypoints || picture || face)) {
        const std::vector<std::string> names = reader.names_in("");
        reader.refuse(
            format("this HDF5 file is no motion that is known: it holds {}; /fps and /joints, /keypoints3d, "
                   "/keypoints2d or /face are expected, or /pose/data or /pose/normalize of PATS",
                   names.empty() ? "nothing" : "/" + join(names, ", /")));
    }
    Motion motion{.source = reader.where(),
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
    if (reader.has("first_time")) motion.first_time = reader.read_numbers("first_time", {})[0];
    if (reader.has("notes")) motion.notes = reader.read_texts("notes");
    return motion;
}

}  // namespace chironomia
