#include "study/check/videos.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "study/build/study_files.h"
#include "study/clip/container.h"
#include "study/clip/loudness.h"
#include "study/plan/secret_names.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

fs::path file_of(const StudyRecord& study, const KeyVideo& video) {
    return StudyFolder{study.folder}.open() / video.file;
}

// Tags that every clip of its kind has, whatever it shows.
struct FixedTag {
    std::string_view key;
    std::string_view value;
};
constexpr FixedTag kFixedTags[] = {
    {"major_brand", "isom"},
    {"minor_version", "512"},
    {"compatible_brands", "isomiso2avc1mp41"},
    {"language", "und"},
    {"handler_name", "VideoHandler"},
    {"handler_name", "SoundHandler"},
    {"handler_name", "video"},
    {"handler_name", "sound"},
    {"encoder", "none"},  // WebM cannot do without
    {"vendor_id", "[0][0][0][0]"},
};

bool is_fixed(const ClipTag& tag) {
    // WebM has each stream's length in a tag. Another check compares the lengths.
    if (tag.key == "DURATION") return tag.value.find_first_not_of("0123456789:.") == std::string::npos;
    return std::any_of(std::begin(kFixedTags), std::end(kFixedTags), [&](const FixedTag& fixed) {
        return tag.key == fixed.key && tag.value == fixed.value;
    });
}

// All properties, but for the length, by which a viewer or a player could distinguish two videos.
std::string kind_of(const ClipInfo& info) {
    std::string kind;
    if (const auto& picture = info.picture) {
        kind = format("{}x{} at {}, {} {} {} {}", picture->width, picture->height, to_text(picture->fps),
                      picture->codec, picture->profile, picture->pixel_format, picture->colours);
    }
    if (const auto& sound = info.sound) {
        kind += format(", {} {} Hz {} channels", sound->codec, sound->rate, sound->channels);
    }
    return kind;
}

// Calls `differs(first, other)` for each video and the first of its clip, and returns what it says first.
template <typename Differs>
std::string first_difference(const StudyRecord& study, Differs differs) {
    std::map<std::string, std::size_t> first_of_clip;
    for (std::size_t i = 0; i < study.key.videos.size(); ++i) {
        const std::size_t first = first_of_clip.emplace(study.key.videos[i].clip, i).first->second;
        const std::string difference = differs(first, i);
        if (!difference.empty()) {
            return format("clip \"{}\": {} and {}: {}", study.key.videos[i].clip,
                          study.key.videos[first].file, study.key.videos[i].file, difference);
        }
    }
    return "";
}

}  // namespace

std::vector<SeenVideo> see_videos(const StudyRecord& study) {
    std::vector<SeenVideo> all;
    for (const KeyVideo& video : study.key.videos) {
        SeenVideo& seen = all.emplace_back();
        // A damaged video is what a check looks for, so here its error is an answer.
        try {
            seen.info = read_clip_info(file_of(study, video));
        } catch (const Error& error) {
            seen.fault = error.what();
        }
    }
    return all;
}

Proof check_videos_whole(const StudyRecord& study, const std::vector<SeenVideo>& seen) {
    constexpr std::string_view kProperty = "every video is whole";
    std::size_t frames = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (!seen[i].info) return no(kProperty, seen[i].fault);
        const auto& picture = seen[i].info->picture;
        if (!picture) return no(kProperty, format("{} has no picture", study.key.videos[i].file));
        if (picture->frames != study.key.videos[i].frames) {
            return no(kProperty, format("{} has {} frames, {} were recorded", study.key.videos[i].file,
                                        picture->frames, study.key.videos[i].frames));
        }
        if (!picture->constant_rate) {
            return no(kProperty, format("{} has frames of unequal length", study.key.videos[i].file));
        }
        frames += picture->frames;
    }
    return yes(kProperty, format("{} videos, {} frames", seen.size(), frames));
}

Proof check_no_names_in_videos(const StudyRecord& study) {
    constexpr std::string_view kProperty = "no name of a condition or source in the videos";
    const NamesInClips names(study.key.secret_names);
    for (const KeyVideo& video : study.key.videos) {
        const fs::path file = file_of(study, video);
        if (!fs::is_regular_file(file)) return no(kProperty, format("{} is missing", video.file));
        try {
            if (const auto name = names.find(file)) {
                return no(kProperty, format("\"{}\" stands in {}", *name, video.file));
            }
        } catch (const Error& error) {
            return no(kProperty, error.what());
        }
    }
    return yes(kProperty,
               format("{} videos, {} names", study.key.videos.size(), study.key.secret_names.size()));
}

Proof check_no_tags(const StudyRecord& study, const std::vector<SeenVideo>& seen) {
    constexpr std::string_view kProperty = "no tag of a tool, a time or a file in the videos";
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (!seen[i].info) return no(kProperty, seen[i].fault);
        for (const ClipTag& tag : seen[i].info->tags) {
            if (is_fixed(tag)) continue;
            return no(kProperty,
                      format("{}: {}: {} = \"{}\"", study.key.videos[i].file, tag.place, tag.key, tag.value));
        }
    }
    return yes(kProperty, format("{} videos", seen.size()));
}

Proof check_same_kind(const StudyRecord& study, const std::vector<SeenVideo>& seen) {
    constexpr std::string_view kProperty = "videos of a clip have the same size, rate and encoding";
    const std::string difference = first_difference(study, [&](std::size_t a, std::size_t b) -> std::string {
        if (!seen[a].info || !seen[b].info) return seen[a].fault + seen[b].fault;
        const std::string kind_a = kind_of(*seen[a].info);
        const std::string kind_b = kind_of(*seen[b].info);
        if (kind_a != kind_b) return format("{}; {}", kind_a, kind_b);
        const auto &picture_a = seen[a].info->picture, &picture_b = seen[b].info->picture;
        const bool same = !picture_a || !picture_b || picture_a->setup == picture_b->setup;
        return same ? "" : "their encoders were not set alike";
    });
    if (!difference.empty()) return no(kProperty, difference);
    return yes(kProperty, kind_of(*seen.front().info));
}

Proof check_same_length(const StudyRecord& study, const std::vector<SeenVideo>& seen) {
    constexpr std::string_view kProperty = "videos of a clip are equally long";
    const std::string difference = first_difference(study, [&](std::size_t a, std::size_t b) -> std::string {
        if (!seen[a].info || !seen[b].info) return seen[a].fault + seen[b].fault;
        const double seconds_a = seen[a].info->duration_s;
        const double seconds_b = seen[b].info->duration_s;
        constexpr double kSame = 1e-6;  // [s]
        return std::abs(seconds_a - seconds_b) < kSame ? ""
                                                       : format("{:.3f} s; {:.3f} s", seconds_a, seconds_b);
    });
    if (!difference.empty()) return no(kProperty, difference);
    return yes(kProperty, format("{} clips", study.key.clips.size()));
}

Proof check_same_size(const StudyRecord& study) {
    constexpr std::string_view kProperty = "videos of a clip have the same number of bytes";
    const std::string difference = first_difference(study, [&](std::size_t a, std::size_t b) -> std::string {
        const fs::path file_a = file_of(study, study.key.videos[a]);
        const fs::path file_b = file_of(study, study.key.videos[b]);
        if (!fs::is_regular_file(file_a) || !fs::is_regular_file(file_b)) return "one is missing";
        const auto bytes_a = fs::file_size(file_a);
        const auto bytes_b = fs::file_size(file_b);
        return bytes_a == bytes_b ? "" : format("{}; {} bytes", bytes_a, bytes_b);
    });
    if (!difference.empty()) return no(kProperty, difference);
    return yes(kProperty, format("{} clips", study.key.clips.size()));
}

Proof check_padding(const StudyRecord& study) {
    constexpr std::string_view kProperty = "nothing but zeros beside the pictures and sounds of a video";
    // Of WebM: header, segment, seek head, info, tracks, tags, cues, clusters, Void.
    static const std::vector<std::string> kKnown = {
        "ftyp",     "moov",     "mdat",     "free",     "1a45dfa3", "18538067", "114d9b74",
        "1549a966", "1654ae6b", "1254c367", "1c53bb6b", "1f43b675", "ec"};
    for (const KeyVideo& video : study.key.videos) {
        const fs::path file = file_of(study, video);
        if (!fs::is_regular_file(file)) return no(kProperty, format("{} is missing", video.file));
        std::vector<ContainerBox> boxes;
        try {
            boxes = read_boxes(file);
        } catch (const Error& error) {
            return no(kProperty, error.what());
        }
        const std::string bytes = read_text(file);
        for (const ContainerBox& box : boxes) {
            if (std::find(kKnown.begin(), kKnown.end(), box.type) == kKnown.end())
                return no(kProperty,
                          format("{} has a box \"{}\" at byte {}", video.file, box.type, box.begin));
            if (box.type != "free" && box.type != "ec") continue;
            const std::size_t other = bytes.find_first_not_of('\0', box.body);
            if (other < box.end)
                return no(kProperty, format("{} has a byte {:#04x} in its padding, at {}", video.file,
                                            static_cast<unsigned char>(bytes[other]), other));
        }
    }
    return yes(kProperty, format("{} videos", study.key.videos.size()));
}

Proof check_same_sound(const StudyRecord& study, const std::vector<SeenVideo>& seen) {
    constexpr std::string_view kProperty = "videos of a clip with the same speech sound the same";
    std::map<std::pair<std::string, std::string>, std::size_t> firsts;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (!seen[i].info) return no(kProperty, seen[i].fault);
        // A spoken instruction is heard in its own video alone.
        if (!study.key.videos[i].instruction.empty() || !seen[i].info->sound) continue;
        const std::size_t first =
            firsts.emplace(std::pair(study.key.videos[i].clip, study.key.videos[i].speech), i).first->second;
        if (seen[i].info->sound->hash != seen[first].info->sound->hash)
            return no(kProperty, format("clip \"{}\": {} and {} do not", study.key.videos[i].clip,
                                        study.key.videos[first].file, study.key.videos[i].file));
    }
    return yes(kProperty, firsts.empty() ? "silence" : format("{} sounds", firsts.size()));
}

Proof check_same_loudness(const StudyRecord& study) {
    constexpr std::string_view kProperty = "videos of a clip are equally loud";
    std::vector<std::optional<Loudness>> all;
    double least = 0, most = -200;
    for (const KeyVideo& video : study.key.videos) {
        try {
            all.push_back(loudness_of_file(file_of(study, video)));
        } catch (const Error& error) {
            return no(kProperty, error.what());
        }
        if (!all.back() || !all.back()->integrated) continue;
        least = std::min(least, *all.back()->integrated);
        most = std::max(most, *all.back()->integrated);
    }
    // What has no loudness is silence, which is as loud as other silence alone.
    const auto integrated = [&](std::size_t i) {
        return all[i] && all[i]->integrated ? *all[i]->integrated : -200.0;
    };
    const std::string difference = first_difference(study, [&](std::size_t a, std::size_t b) -> std::string {
        if (std::abs(integrated(a) - integrated(b)) <= kSameLoudness) return "";
        return format("{:.1f}; {:.1f} LUFS", integrated(a), integrated(b));
    });
    if (!difference.empty()) return no(kProperty, difference);
    if (most < least) return yes(kProperty, "silence");
    return yes(kProperty, format("{:.1f} to {:.1f} LUFS", least, most));
}

Proof check_in_sync(const StudyRecord& study, const std::vector<SeenVideo>& seen) {
    constexpr std::string_view kProperty = "sound and picture begin and end together";
    double worst = 0;  // [s]
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (!seen[i].info) return no(kProperty, seen[i].fault);
        const auto& picture = seen[i].info->picture;
        const auto& sound = seen[i].info->sound;
        if (!picture || !sound) {
            if (study.public_pages.at("sound") == sound.has_value()) continue;
            return no(kProperty, format("{} has {} sound", study.key.videos[i].file, sound ? "a" : "no"));
        }
        const double begin = std::abs(picture->start_s - sound->start_s);
        const double end =
            std::abs(picture->start_s + picture->duration_s - sound->start_s - sound->duration_s);
        worst = std::max({worst, begin, end});
        if (worst > picture->fps.seconds(1)) {
            return no(kProperty,
                      format("{}: {:.0f} ms apart, at most a frame of {:.0f} ms is allowed",
                             study.key.videos[i].file, 1000 * worst, 1000 * picture->fps.seconds(1)));
        }
    }
    return yes(kProperty, format("at most {:.1f} ms apart", 1000 * worst));
}

}  // namespace chironomia::study
