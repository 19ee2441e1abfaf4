#include "raster/images/compare_files.h"

#include <algorithm>
#include <cmath>
#include <future>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_info.h"
#include "raster/ffmpeg/clip_reader.h"
#include "raster/images/frame_stack.h"
#include "raster/images/image_file.h"
#include "raster/images/visible_difference.h"

namespace chironomia {
namespace fs = std::filesystem;
namespace {

constexpr double kMostApart = 0.002;  // of beginnings [s]: WebM counts milliseconds

constexpr double kSoundShare = 0.25;         // of the loudest sample of what is expected
constexpr double kLeastSoundLimit = 0.0005;  // of full scale

constexpr double kMostLate = 0.1;  // ours: of time stamps [frames]
constexpr double kClock = 0.0011;  // of WebM, which counts milliseconds, with what is rounded [s]

// Frames one after the other, from wherever they come.
class FrameSource {
  public:
    explicit FrameSource(const fs::path& path) : path_(path) {
        if (fs::is_directory(path)) {
            files_ = list_stack(path);
        } else if (fs::exists(path) && (has_image_name(path) || is_image(path))) {
            files_ = {path};
        } else {
            info_ = read_clip_info(path);
            reader_.emplace(path);
        }
    }

    const fs::path& path() const { return path_; }
    const std::optional<ClipInfo>& clip() const { return info_; }
    size_t count() const { return info_ ? info_->picture->frames : files_.size(); }

    Frame next() {
        if (!reader_) return read_image(files_[done_++]);
        std::optional<Frame> frame = reader_->next();
        if (!frame) {
            throw Error(
                format("{}: ends after {} of {} frames; write it again", path_.string(), done_, count()));
        }
        ++done_;
        return std::move(*frame);
    }

    // "stack/00012.png" or "clip.mp4: frame 12", for the frame that came last.
    std::string place() const {
        return info_ ? format("{}: frame {}", path_.string(), done_ - 1) : files_[done_ - 1].string();
    }

  private:
    fs::path path_;
    std::vector<fs::path> files_;
    std::optional<ClipInfo> info_;
    std::optional<ClipReader> reader_;
    size_t done_ = 0;
};

// Two files with what players make of them.
struct TwoClips {
    const FrameSource& a;
    const FrameSource& b;

    const PictureInfo& picture_a() const { return *a.clip()->picture; }
    const PictureInfo& picture_b() const { return *b.clip()->picture; }
};

void expect_same_times(const TwoClips& clips) {
    const auto &times_a = clips.picture_a().times_s, &times_b = clips.picture_b().times_s;
    const double most = std::max(kMostLate * clips.picture_a().fps.seconds(1), kClock);
    for (size_t i = 0; i < times_a.size(); ++i) {
        if (std::abs(times_a[i] - times_b[i]) <= most) continue;
        throw DifferentForm(format(
            "{}: shows frame {} after {:.3f} s, {} after {:.3f} s; write both with the same time stamps",
            clips.a.path().string(), i, times_a[i], clips.b.path().string(), times_b[i]));
    }
}

std::string display_of(const PictureInfo& picture) {
    return format("{:g} degrees{}", picture.turn_deg, picture.is_mirrored ? " and mirrored" : "");
}

// What the file does not say is taken as players take it, as the matrix is: BT.709, of small pictures BT.601, which
// has the transfer of BT.709.
std::string colour_tags_of(const PictureInfo& picture) {
    constexpr const char *kUnknown = "unknown", *kOld = "smpte170m", *kNew = "bt709";
    const bool is_old = picture.colours == kUnknown ? picture.height < 720
                                                    : picture.colours == kOld || picture.colours == "bt470bg";
    const bool same_transfer = picture.transfer == kUnknown || picture.transfer == kOld;
    return format("transfer {} and primaries {}", same_transfer ? kNew : picture.transfer,
                  picture.primaries != kUnknown ? picture.primaries
                  : is_old                      ? kOld
                                                : kNew);
}

void expect_same_display(const TwoClips& clips) {
    const std::string a = clips.a.path().string(), b = clips.b.path().string();
    const PictureInfo &picture_a = clips.picture_a(), &picture_b = clips.picture_b();
    if (picture_a.pixel_shape != picture_b.pixel_shape) {
        throw DifferentForm(format("{}: has pixels of {}, {} of {}; write both with pixels of one shape", a,
                                   picture_a.pixel_shape, b, picture_b.pixel_shape));
    }
    if (display_of(picture_a) != display_of(picture_b)) {
        throw DifferentForm(format("{}: is to be shown turned by {}, {} by {}; write both to be shown alike",
                                   a, display_of(picture_a), b, display_of(picture_b)));
    }
    if (colour_tags_of(picture_a) != colour_tags_of(picture_b)) {
        throw DifferentForm(format("{}: has colours of {}, {} of {}; write both with the same tags", a,
                                   colour_tags_of(picture_a), b, colour_tags_of(picture_b)));
    }
}

void expect_comparable(const FrameSource& a, const FrameSource& b) {
    if (a.count() != b.count()) {
        throw DifferentForm(format("{}: has {} frames, {} has {}; compare equally many", a.path().string(),
                                   a.count(), b.path().string(), b.count()));
    }
    if (!a.clip() || !b.clip()) return;
    const Rate& rate_a = a.clip()->picture->fps;
    const Rate& rate_b = b.clip()->picture->fps;
    if (rate_a != rate_b) {
        throw DifferentForm(format("{}: has {} frames per second, {} has {}; render both at one rate",
                                   a.path().string(), to_text(rate_a), b.path().string(), to_text(rate_b)));
    }
    expect_same_times({a, b});
    expect_same_display({a, b});
    const auto sound_of = [](const ClipInfo& clip) {
        return clip.sound ? format("sound of {} Hz, {} channels", clip.sound->rate, clip.sound->channels)
                          : std::string("no sound");
    };
    if (sound_of(*a.clip()) != sound_of(*b.clip())) {
        throw DifferentForm(format("{}: has {}, {} has {}; compare clips with sound of one form",
                                   a.path().string(), sound_of(*a.clip()), b.path().string(),
                                   sound_of(*b.clip())));
    }
    if (a.clip()->tracks != b.clip()->tracks) {
        throw DifferentForm(format("{}: has the tracks {}, {} has {}; write both with the same tracks",
                                   a.path().string(), join(a.clip()->tracks), b.path().string(),
                                   join(b.clip()->tracks)));
    }
    if (!a.clip()->sound) return;
    const auto lateness_of = [](const ClipInfo& clip) { return clip.sound->start_s - clip.picture->start_s; };
    const double late_a = lateness_of(*a.clip()), late_b = lateness_of(*b.clip());
    if (std::abs(late_a - late_b) > kMostApart) {
        throw DifferentForm(
            format("{}: its sound begins {:.3f} s after its pictures, that of {} {:.3f} s; join sound and "
                   "pictures alike",
                   a.path().string(), late_a, b.path().string(), late_b));
    }
}

void expect_same_size(const Frame& frame_a, const FrameSource& a, const Frame& frame_b,
                      const FrameSource& b) {
    if (frame_a.width == frame_b.width && frame_a.height == frame_b.height) return;
    throw DifferentForm(format("{}: is {} x {}, {} is {} x {}; render both at one size", a.place(),
                               frame_a.width, frame_a.height, b.place(), frame_b.width, frame_b.height));
}

// What is missing at the end of the shorter one counts as silence.
double largest_error(const Audio& a, const Audio& b) {
    const auto sample = [](const Audio& sound, size_t i) {
        return i < sound.samples.size() ? sound.samples[i] : 0.0f;
    };
    double largest = 0;
    for (size_t i = 0; i < std::max(a.samples.size(), b.samples.size()); ++i) {
        largest = std::max(largest, std::abs(static_cast<double>(sample(a, i)) - sample(b, i)));
    }
    return largest;
}

// A sound that is quiet as a whole may not be lost.
double quiet_limit(const Audio& expected, double limit) {
    double loudest = 0;
    for (const float sample : expected.samples)
        loudest = std::max(loudest, std::abs(static_cast<double>(sample)));
    return std::min(limit, std::max(kLeastSoundLimit, kSoundShare * loudest));
}

// The eye looks only at what the levels refuse.
FrameComparison judge(const Frame& a, const Frame& b, const CompareOptions& options) {
    FrameComparison comparison = compare(a, b, options.limits);
    if (comparison.within_limits || !options.seen_share) return comparison;
    comparison.visible_differences = count_visible_differences(a, b);
    comparison.within_limits = static_cast<double>(*comparison.visible_differences) <=
                               *options.seen_share * static_cast<double>(comparison.pixels);
    return comparison;
}

void compare_next(FrameSource& a, FrameSource& b, const CompareOptions& options, FileComparison& result) {
    std::future<Frame> beside = std::async(std::launch::async, [&a] { return a.next(); });
    const Frame frame_b = b.next();
    const Frame frame_a = beside.get();
    expect_same_size(frame_a, a, frame_b, b);
    const FrameComparison comparison = judge(frame_a, frame_b, options);
    const size_t index = result.frames.size();
    result.width = frame_a.width;
    result.height = frame_a.height;
    result.frames.push_back(comparison);
    if (comparison.rms_error > result.frames[result.worst].rms_error) result.worst = index;
    result.within_limits = result.within_limits && comparison.within_limits;
    if (options.on_frame) {
        options.on_frame(
            {.index = index, .count = a.count(), .a = frame_a, .b = frame_b, .comparison = comparison});
    }
}

}  // namespace

FileComparison compare_files(const fs::path& path_a, const fs::path& path_b, const CompareOptions& options) {
    FrameSource a(path_a), b(path_b);
    expect_comparable(a, b);
    FileComparison result;
    while (result.frames.size() < a.count()) compare_next(a, b, options, result);
    if (a.clip() && b.clip() && a.clip()->sound) {
        const Audio expected = read_audio(path_a);
        result.sound_error = largest_error(expected, read_audio(path_b));
        result.sound_limit = quiet_limit(expected, options.sound_limit);
        if (*result.sound_error > result.sound_limit) result.within_limits = false;
    }
    return result;
}

}  // namespace chironomia
