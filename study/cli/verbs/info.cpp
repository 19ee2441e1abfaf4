// chironomia info
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <memory>

#include "core/error.h"
#include "core/files/byte_order_mark.h"
#include "core/files/files.h"
#include "core/files/json_text.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/images/image_file.h"
#include "skinning/gltf/avatar_info.h"
#include "skinning/gltf/fbx_file.h"
#include "skinning/gltf/gltf.h"
#include "skinning/gltf/gltf_animation.h"
#include "skinning/gltf/gltf_motion.h"
#include "skinning/motion/motion_info.h"
#include "skinning/motion/other_formats.h"
#include "skinning/motion/picture/openpose.h"
#include "skinning/motion/points/bodies_json.h"
#include "study/cli/options/model_options.h"
#include "study/cli/options/option_kinds.h"
#include "study/cli/options/people_options.h"
#include "study/cli/verbs/verbs.h"
#include "study/corpus/info.h"
#include "study/record/study_folder.h"
#include "synth/learning.h"
#include "synth/speech/timed_words.h"
#include "synth/speech/word_table.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;

enum class FileKind { avatar, motion, words, media, picture, model, corpus };

constexpr std::string_view kAccepted =
    "name an avatar (glTF), a motion (BVH, CSV, JSON, NumPy, HDF5, or a folder of OpenPose with "
    "NAME_keypoints.json or of CMU Panoptic with body3DScene_NUMBER.json), words in time (TextGrid, ELAN, "
    "WebVTT, SubRip, JSON, CSV, CTM), a sound, a clip, a picture (PNG, EXR), a model or a corpus";

bool is_corpus(const fs::path& folder) {
    return fs::exists(folder / "corpus.json") || fs::exists(folder / "data" / "cmu_intervals_df.csv");
}

// As recognisers write them: a list of words, alone or under one of these keys, or what was heard in one stretch after
// the other.
bool are_words(const Json& json) {
    for (const char* key : {"words", "segments", "chunks", "transcription", "result"}) {
        if (json.is_object() && json.contains(key) && json[key].is_array()) return true;
    }
    const auto is_word_or_result = [](const Json& part) {
        return part.is_object() &&
               ((part.contains("start") && (part.contains("end") || part.contains("duration"))) ||
                part.contains("result") || part.contains("alternatives"));
    };
    const Json& results = json.is_object() && json.contains("results") ? json["results"] : json;
    const Json& list = results.is_object() && results.contains("channels") ? results["channels"] : results;
    return list.is_array() && std::any_of(list.begin(), list.end(), is_word_or_result);
}

bool is_utf16(std::string_view begin) {
    return begin.starts_with("\xff\xfe") || begin.starts_with("\xfe\xff");
}

// The beginning of a TextGrid, of ELAN's annotations, of captions, or of a table of words; UTF-16 is what Praat writes
// for other alphabets.
bool begins_like_words(std::string_view begin) {
    if (is_utf16(begin)) {
        std::string letters(begin.substr(2));
        std::erase(letters, '\0');
        return begins_like_words(letters);
    }
    const std::string_view text = trim(without_byte_order_mark(begin));
    if (text.starts_with("File type = \"ooTextFile\"") || text.starts_with("\"ooTextFile\"") ||
        text.starts_with("WEBVTT") || text.find("<ANNOTATION_DOCUMENT") != std::string_view::npos)
        return true;
    const std::vector<std::string_view> lines = split(text, '\n');
    if (lines.size() > 1 && parse_integer(trim(lines[0])) && lines[1].find(" --> ") != std::string_view::npos)
        return true;
    return (!lines.empty() && begins_word_table(lines[0])) ||
           is_ctm(lines.size() > 1 ? text.substr(0, text.rfind('\n')) : text);
}

FileKind kind_of_json(const fs::path& file) {
    const std::string text = read_text(file);
    if (is_json_lines(without_byte_order_mark(text))) return FileKind::motion;
    const Json json = parse_json(text, file);
    if (are_words(json)) return FileKind::words;
    const auto format = json.find("format");
    if (format != json.end() && format->is_string() &&
        format->get_ref<const std::string&>().starts_with("chironomia checkpoint"))
        return FileKind::model;
    const bool is_figure = json.is_object() && json.contains("asset") && !is_skeleton_alone(file);
    return is_figure ? FileKind::avatar : FileKind::motion;
}

bool is_readable_file(const fs::path& file) {
    return fs::exists(file) && !fs::is_directory(file);
}

// At most five names of what is in a folder, in order.
std::string some_names(const fs::path& folder) {
    constexpr std::size_t kMost = 5;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    const std::size_t more = names.size() - std::min(names.size(), kMost);
    names.resize(names.size() - more);
    return join(names) + (more > 0 ? format(" and {} more", more) : "");
}

[[noreturn]] void refuse_folder(const fs::path& folder) {
    const StudyFolder study{folder};
    std::string what = "is an empty folder";
    if (fs::exists(study.open() / "pages.json") || fs::exists(study.key()))
        what = "is the folder of a study, which study check describes";
    else if (!fs::is_empty(folder))
        what = format("is a folder with {} in it, which is no motion and no corpus", some_names(folder));
    throw Error(format("{}: {}; {}", folder.string(), what, kAccepted));
}

// What FFmpeg would call a clip that cannot be read.
void refuse_other_files(const fs::path& file, std::string_view begin) {
    const auto refuse = [&](std::string_view what) {
        throw Error(format("{}: is {}; {}", file.string(), what, kAccepted));
    };
    if (begin.empty()) refuse("an empty file");
    if (begin.starts_with("\xff\xd8\xff")) refuse("a picture in JPEG, which is not read");
    const bool is_text = std::all_of(begin.begin(), begin.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 || (byte >= '\t' && byte <= '\r');
    });
    if (is_text) refuse("a text, but neither BVH nor CSV, JSON or glTF");
}

fs::path find_file(const fs::path& named) {
    if (is_readable_file(named) || is_openpose_folder(named) || is_panoptic_folder(named) || is_corpus(named))
        return named;
    const std::vector<std::string> bundled = bundled_avatars();
    const bool is_name = std::find(bundled.begin(), bundled.end(), named) != bundled.end();
    if (fs::is_directory(named) && !is_name) refuse_folder(named);
    return find_avatar(named);
}

// The first bytes show the kind. JSON is an avatar if it is glTF, else a motion. A file that begins like none of our
// formats goes to FFmpeg, which knows many more and has clear error messages.
FileKind kind_of(const fs::path& file) {
    if (is_corpus(file)) return FileKind::corpus;
    if (fs::is_directory(file)) return FileKind::motion;  // of OpenPose or Panoptic
    const std::string ending = to_lower(file.extension().string());
    if (ending == ".safetensors") return FileKind::model;
    std::array<char, 512> bytes{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(bytes.data(), bytes.size());
    const std::string_view begin(bytes.data(), static_cast<std::size_t>(stream.gcount()));
    refuse_fbx(file, begin);
    refuse_other_formats(file, begin);
    const std::string_view word = trim(without_byte_order_mark(begin));
    if (begin.starts_with("glTF")) return is_skeleton_alone(file) ? FileKind::motion : FileKind::avatar;
    if (word.starts_with("{") || word.starts_with("[")) return kind_of_json(file);
    if (begins_like_words(begin)) return FileKind::words;
    if (is_utf16(begin)) throw Error(format("{}: it is UTF-16; save it as UTF-8", file.string()));
    const bool motion = word.starts_with("HIERARCHY") || begin.starts_with("\x89HDF") ||
                        begin.starts_with("PK\x03") || begin.starts_with("\x93NUMPY") || ending == ".csv" ||
                        ending == ".bvh";
    if (motion) return FileKind::motion;
    if (is_image(file)) return FileKind::picture;
    refuse_other_files(file, begin);
    return FileKind::media;
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

// What is not as usual, or need not be there.
void add_display(const PictureInfo& picture, Json& json) {
    if (picture.pixel_shape != "1:1") json["pixel_shape"] = picture.pixel_shape;
    if (picture.turn_deg != 0) json["turn_deg"] = picture.turn_deg;
    if (picture.is_mirrored) json["mirrored"] = true;
    if (picture.transfer != "unknown") json["transfer"] = picture.transfer;
    if (picture.primaries != "unknown") json["primaries"] = picture.primaries;
}

// A line for how it is shown and one for its colours, where there is something to say.
std::string display_text(const PictureInfo& picture) {
    std::vector<std::string> shown, colours;
    if (picture.pixel_shape != "1:1") shown.push_back(format("pixels of {}", picture.pixel_shape));
    if (picture.turn_deg != 0) shown.push_back(format("turned by {:g} degrees", picture.turn_deg));
    if (picture.is_mirrored) shown.emplace_back("mirrored");
    if (picture.transfer != "unknown") colours.push_back(format("transfer {}", picture.transfer));
    if (picture.primaries != "unknown") colours.push_back(format("primaries {}", picture.primaries));
    return (shown.empty() ? "" : format("shown      {}\n", join(shown))) +
           (colours.empty() ? "" : format("colours    {}\n", join(colours)));
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
        add_display(*picture, json["picture"]);
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

Json describe_picture(const fs::path& file) {
    const Frame picture = read_image(file);
    return {{"picture", {{"size", {picture.width, picture.height}}, {"bytes", fs::file_size(file)}}}};
}

std::string picture_text(const Json& description) {
    const Json& picture = description["picture"];
    return format("picture    {}x{}, {} bytes\n", picture["size"][0].get<int>(),
                  picture["size"][1].get<int>(), picture["bytes"].get<std::uintmax_t>());
}

std::string clip_text(const ClipInfo& clip) {
    std::string text =
        format("container  {}, {:.3f} s, {} bytes\n", clip.container, clip.duration_s, clip.bytes);
    if (const auto& picture = clip.picture) {
        const std::string profile = picture->profile.empty() ? "" : " " + picture->profile;
        text += format("picture    {}{} {} {}, {}x{}, {} frames/s{}, {} frames, {:.3f} s\n", picture->codec,
                       profile, picture->pixel_format, picture->colours, picture->width, picture->height,
                       to_text(picture->fps), picture->constant_rate ? " constant" : "", picture->frames,
                       picture->duration_s);
        text += display_text(*picture);
    }
    if (const auto& sound = clip.sound) {
        text += format("sound      {}, {} Hz, {} channels, {:.3f} s\n", sound->codec, sound->rate,
                       sound->channels, sound->duration_s);
    }
    for (const ClipTag& tag : clip.tags)
        text += format("tag        {}: {} = {}\n", tag.place, tag.key, tag.value);
    return text;
}

Json describe_words(const fs::path& file) {
    const TimedWords timed = read_timed_words(file, std::numeric_limits<double>::infinity());
    Json words = Json::array();
    for (const SpokenWord& word : timed.words)
        words.push_back({{"word", word.text}, {"start", word.start}, {"end", word.end}});
    return {{"words", std::move(words)}, {"phonemes", timed.phonemes.size()}, {"notes", timed.notes}};
}

std::string words_text(const Json& description) {
    const Json& words = description["words"];
    std::string text =
        format("words      {}, {} phonemes\n", words.size(), description["phonemes"].get<size_t>());
    if (!words.empty()) {
        for (const auto& [label, word] :
             {std::pair{"first", &words.front()}, std::pair{"last", &words.back()}})
            text += format("{:<10} \"{}\", {:.3f} to {:.3f} s\n", label, (*word)["word"].get<std::string>(),
                           (*word)["start"].get<double>(), (*word)["end"].get<double>());
    }
    for (const Json& note : description["notes"]) text += format("note       {}\n", note.get<std::string>());
    return text;
}

// The losses that training ended with stand for the whole curve.
std::string model_text(const Json& model) {
    std::vector<std::string> inputs, outputs, options;
    for (const Json& name : model["inputs"]) inputs.push_back(name.get<std::string>());
    for (const Json& name : model["outputs"]) outputs.push_back(name.get<std::string>());
    for (const auto& [key, value] : model["options"].items()) {
        const auto reading = std::ranges::find(readings(), key, &Reading::key);
        options.push_back(format("{} {}", reading == readings().end() ? key : reading->name,
                                 value.is_string() ? value.get<std::string>() : value.dump()));
    }
    const std::string encoder = model["text_encoder"].get<std::string>();
    std::string text = format("model      {}, preset {}, {} numbers", model["model"].get<std::string>(),
                              model["preset"].get<std::string>(), model["parameters"].get<std::size_t>());
    if (model.contains("parameters_without_ast"))
        text += format(" ({} without AST)", model["parameters_without_ast"].get<std::size_t>());
    if (model.contains("discriminator_parameters"))
        text += format(", discriminator {}", model["discriminator_parameters"].get<std::size_t>());
    text += "\n";
    text +=
        format("inputs     {}{}\noutputs    {}\noptions    {}\n", join(inputs),
               encoder.empty() ? "" : format(", word vectors of {}", encoder), join(outputs), join(options));
    text += format("training   seed {}, {} steps", model["seed"].get<std::uint64_t>(),
                   model["steps"].get<std::size_t>());
    if (!model["curve"].empty()) {
        const Json& last = model["curve"].back();
        text +=
            format(", last loss {:.4g}, of validation {:.4g}", last[1].get<double>(), last[2].get<double>());
    }
    return text + "\n";
}

}  // namespace

void add_info(CLI::App& app, std::optional<Command>& result) {
    auto command = std::make_shared<InfoCommand>();
    CLI::App* verb = add_verb(
        app, "info", "Say what an avatar, motion, sound, clip, picture, file of words, model or corpus holds",
        "  $ chironomia info avatar.glb\n  $ chironomia info motion.bvh --json");
    verb->add_option("file", command->file, "The file, or the name of a bundled avatar")
        ->type_name("FILE")
        ->required();
    add_motion_hints(*verb, command->hints);
    verb->add_flag("--json", command->json, "Print JSON");
    verb->callback([&result, command] { result = *command; });
}

int run(const InfoCommand& command) {
    const fs::path file = find_file(command.file);
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
        case FileKind::words: {
            const Json description = describe_words(file);
            return as_asked(description, words_text(description));
        }
        case FileKind::model: {
            const Json description =
                ask_to_learn({{"verb", "describe"}, {"checkpoint", fs::absolute(file).string()}});
            return as_asked(description, model_text(description));
        }
        case FileKind::corpus: {
            const Json description = describe_corpus(read_corpus_index(file));
            return as_asked(description, corpus_text(description));
        }
        case FileKind::picture: {
            const Json description = describe_picture(file);
            return as_asked(description, picture_text(description));
        }
        case FileKind::media: {
            const ClipInfo clip = read_clip_info(file);
            Json description = describe_clip(clip);
            std::string text = clip_text(clip);
            if (clip.picture) return as_asked(description, text);
            check_audio(file);
            if (const auto delay = unstated_delay(file)) {
                description["notes"] = {*delay};
                text += format("note       {}\n", *delay);
            }
            return as_asked(description, text);
        }
    }
    return kExitOurBug;
}

}  // namespace chironomia::study
