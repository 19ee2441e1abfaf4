// chironomia info
#include <array>
#include <cstdio>
#include <fstream>

#include "core/text.h"
#include "raster/ffmpeg/clip_info.h"
#include "skinning/gltf/avatar_info.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_motion.h"
#include "skinning/motion/motion_info.h"
#include "skinning/motion/openpose.h"
#include "study/cli/commands.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

enum class FileKind { avatar, motion, media };

bool is_readable_file(const fs::path& file) {
    return fs::exists(file) && !fs::is_directory(file);
}

// Told by the first bytes. JSON is an avatar if it is glTF, else a motion; what begins like no form of ours
// is left to FFmpeg, which knows the rest and refuses well.
FileKind kind_of(const fs::path& file) {
    if (fs::is_directory(file)) return FileKind::motion;  // of OpenPose
    std::array<char, 512> bytes{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(bytes.data(), bytes.size());
    const std::string_view begin(bytes.data(), static_cast<std::size_t>(stream.gcount()));
    const std::string_view word = trim(begin);
    if (begin.starts_with("glTF")) return is_skeleton_alone(file) ? FileKind::motion : FileKind::avatar;
    if (word.starts_with("{")) return read_json(file).contains("asset") ? FileKind::avatar : FileKind::motion;
    const std::string ending = to_lower(file.extension().string());
    const bool motion = word.starts_with("HIERARCHY") || word.starts_with("[") ||
                        begin.starts_with("\x89HDF") || begin.starts_with("PK\x03") ||
                        begin.starts_with("\x93NUMPY") || ending == ".csv" || ending == ".bvh";
    return motion ? FileKind::motion : FileKind::media;
}

Json describe_animations(const fs::path& file) {
    Json list = Json::array();
    for (const Animation& animation : read_animated_scene(file).animations) {
        list.push_back({{"name", animation.name},
                        {"seconds", animation.seconds},
                        {"channels", animation.tracks.size()}});
    }
    return list;
}

std::string animations_text(const Json& description) {
    std::vector<std::string> lines;
    for (const Json& one : description["animations"]) {
        lines.push_back(format("{} \"{}\" {:.3f} s", lines.size(), one["name"].get<std::string>(),
                               one["seconds"].get<double>()));
    }
    return labelled_list("animations", lines);
}

Json describe_clip(const ClipInfo& clip) {
    Json json;
    json["container"] = clip.container;
    json["duration_s"] = clip.duration_s;
    json["bytes"] = clip.bytes;
    json["index_first"] = clip.index_first;
    if (const auto& picture = clip.picture) {
        json["picture"] = {{"codec", picture->codec},
                           {"profile", picture->profile},
                           {"pixel_format", picture->pixel_format},
                           {"colours", picture->colours},
                           {"size", {picture->width, picture->height}},
                           {"fps", to_text(picture->fps)},
                           {"constant_rate", picture->constant_rate},
                           {"frames", picture->frames},
                           {"duration_s", picture->duration_s}};
    }
    if (const auto& sound = clip.sound) {
        json["sound"] = {{"codec", sound->codec},
                         {"rate_hz", sound->rate},
                         {"channels", sound->channels},
                         {"duration_s", sound->duration_s}};
    }
    json["tags"] = Json::array();
    for (const ClipTag& tag : clip.tags) json["tags"].push_back({tag.place, tag.key, tag.value});
    return json;
}

std::string clip_text(const ClipInfo& clip) {
    std::string text =
        format("container  {}, {:.3f} s, {} bytes\n", clip.container, clip.duration_s, clip.bytes);
    if (const auto& picture = clip.picture) {
        text += format("picture    {} {} {} {}, {}x{}, {} frames/s{}, {} frames, {:.3f} s\n", picture->codec,
                       picture->profile, picture->pixel_format, picture->colours, picture->width,
                       picture->height, to_text(picture->fps), picture->constant_rate ? " constant" : "",
                       picture->frames, picture->duration_s);
    }
    if (const auto& sound = clip.sound) {
        text += format("sound      {}, {} Hz, {} channels, {:.3f} s\n", sound->codec, sound->rate,
                       sound->channels, sound->duration_s);
    }
    for (const ClipTag& tag : clip.tags)
        text += format("tag        {}: {} = {}\n", tag.place, tag.key, tag.value);
    return text;
}

void print(const std::string& text) {
    std::fputs(text.c_str(), stdout);
}

}  // namespace

int run(const InfoCommand& command) {
    const fs::path file = is_readable_file(command.file) || is_openpose_folder(command.file)
                              ? command.file
                              : find_avatar(command.file);
    const auto as_asked = [&command](const Json& description, const std::string& text) {
        print(command.json ? description.dump(2) + "\n" : text);
        return kExitYes;
    };
    switch (kind_of(file)) {
        case FileKind::avatar: {
            Json description = describe_avatar(read_avatar_or_scene(file));
            description["animations"] = describe_animations(file);
            return as_asked(description, avatar_text(description) + animations_text(description));
        }
        case FileKind::motion: {
            const Json description = describe_motion(read_motion(file, command.hints));
            return as_asked(description, motion_text(description));
        }
        default: {
            const ClipInfo clip = read_clip_info(file);
            return as_asked(describe_clip(clip), clip_text(clip));
        }
    }
}

}  // namespace chironomia
