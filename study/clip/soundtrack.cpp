#include "study/clip/soundtrack.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "raster/ffmpeg/clip_length.h"
#include "raster/ffmpeg/sound.h"
#include "raster/images/frame_stack.h"
#include "study/clip/loudness.h"
#include "study/clip/voices.h"

namespace chironomia::study {
namespace fs = std::filesystem;
namespace {

// The cut of the motions is one of whole frames, and so is that of their sound.
std::optional<Cut> sound_cut_of(const ClipJob& job, const std::optional<Cut>& own) {
    if (own || !job.cut) return own;
    const auto to_frame = [&](double seconds) {
        return job.fps.seconds(static_cast<std::size_t>(std::llround(seconds * job.fps.per_second())));
    };
    Cut cut{.begin = to_frame(job.cut->begin)};
    if (job.cut->end) cut.end = to_frame(*job.cut->end);
    return cut;
}

Audio read_part(const fs::path& file, const std::optional<Cut>& cut) {
    return cut ? read_cut(file, *cut) : read_audio(file);
}

// A motion that was found in the pictures of the file begins with them, but is heard with the sound's first sample.
void warn_of_late_sound(Soundtrack& track, const fs::path& file, const ClipJob& job) {
    const double late = sound_after_pictures(file);
    if (std::abs(late) < job.fps.seconds(1)) return;
    track.warnings.push_back(format(
        "{}: its sound begins {:.3f} s {} its pictures, and here with the motion; if the motion was found in "
        "these pictures, write a sound that begins with them",
        file.string(), std::abs(late), late > 0 ? "after" : "before"));
}

void warn_of_delay(Soundtrack& track, const fs::path& file) {
    if (auto warning = unstated_delay(file)) track.warnings.push_back(std::move(*warning));
}

Audio in_both_channels(const Audio& mono) {
    Audio stereo{.rate = mono.rate, .channels = 2, .samples = {}};
    for (const float sample : mono.samples) stereo.samples.insert(stereo.samples.end(), 2, sample);
    return stereo;
}

Soundtrack soundtrack_of_voices(const Performer& left_person, const Performer& right_person,
                                const ClipJob& job) {
    const fs::path &left_file = *left_person.voice, &right_file = *right_person.voice;
    const Audio left = read_part(left_file, sound_cut_of(job, left_person.voice_cut));
    const Audio right = read_part(right_file, sound_cut_of(job, right_person.voice_cut));
    const VoiceMix mix = mix_voices(left, right);
    Soundtrack track{.sound = mix.sound, .voices = {left, right}};
    for (const fs::path& file : {left_file, right_file}) {
        warn_of_late_sound(track, file, job);
        warn_of_delay(track, file);
    }
    if (mix.gain < 1) {
        track.warnings.push_back(
            format("{} and {}: together they are too loud by {:.1f} dB; both are made quieter by that",
                   left_file.string(), right_file.string(), -20 * std::log10(mix.gain)));
    }
    const bool left_ends_first = left.duration() < right.duration();
    const Audio& shorter = left_ends_first ? left : right;
    if (mix.sound.duration() - shorter.duration() > 0.05) {
        track.warnings.push_back(format("{}: the voice lasts {:.3f} s of {:.3f} s; silence is added",
                                        (left_ends_first ? left_file : right_file).string(),
                                        shorter.duration(), mix.sound.duration()));
    }
    return track;
}

std::string name_of_sound(const ClipJob& job) {
    return job.audio ? job.audio->string() : "the voices";
}

double largest_sample(const Audio& sound) {
    double peak = 0;
    for (const float sample : sound.samples) peak = std::max(peak, std::abs(static_cast<double>(sample)));
    return peak;
}

// A sound that was asked for in part is as long as the picture.
void fit_to_picture(Soundtrack& track, const ClipJob& job, double seconds) {
    const double missing = seconds - track.sound->duration();
    track.sound = set_duration(*track.sound, seconds);
    const bool is_meant = job.at_least && missing < 0;  // speech of another clip, which is longer
    if (is_meant || std::abs(missing) <= job.fps.seconds(1)) return;
    const std::string name = name_of_sound(job);
    track.warnings.push_back(
        missing > 0
            ? format("{}: there is sound for {:.3f} s of {:.3f} s; {:.3f} s of silence are added", name,
                     seconds - missing, seconds, missing)
            : format(
                  "{}: the sound lasts {:.3f} s and the picture {:.3f} s; {:.3f} s are faded out and cut off",
                  name, seconds - missing, seconds, -missing));
}

// What is above full scale would be clipped.
void keep_in_scale(Soundtrack& track, const ClipJob& job) {
    Audio& sound = *track.sound;
    const double peak = largest_sample(resample(sound, sound.rate));  // mixed down as the encoder does
    if (peak <= 1) return;
    for (float& sample : sound.samples) sample = static_cast<float>(sample / peak);
    track.warnings.push_back(format("{}: too loud by {:.2f} dB{}; made quieter by that", name_of_sound(job),
                                    20 * std::log10(peak),
                                    sound.channels > 2 ? " as its channels are mixed down to two" : ""));
}

// The sound that belongs to a range of frames, as long as they are.
Audio part_of(const Audio& sound, const FrameRange& range, const Rate& fps) {
    const auto sample_at = [&](std::size_t frame) {
        return static_cast<std::ptrdiff_t>(std::llround(fps.seconds(frame) * sound.rate)) * sound.channels;
    };
    Audio part{.rate = sound.rate, .channels = sound.channels, .samples = {}};
    part.samples.assign(sound.samples.begin() + sample_at(range.first),
                        sound.samples.begin() + sample_at(*range.last));
    return part;
}

}  // namespace

Soundtrack read_soundtrack(const ClipJob& job) {
    const auto& people = job.performers;
    if (people.size() == 2 && people[0].voice && people[1].voice)
        return soundtrack_of_voices(people[0], people[1], job);
    assert(std::none_of(people.begin(), people.end(), [](const Performer& each) { return each.voice; }));
    if (!job.audio) return {};
    const Audio sound = read_part(*job.audio, sound_cut_of(job, job.sound_cut));
    Soundtrack track{.sound = job.stereo && sound.channels == 1 ? in_both_channels(sound) : sound};
    const bool shows_film =
        std::any_of(people.begin(), people.end(), [](const Performer& each) { return !each.film.empty(); });
    if (!shows_film) warn_of_late_sound(track, *job.audio, job);
    warn_of_delay(track, *job.audio);
    return track;
}

bool picture_sets_length(const ClipJob& job) {
    return job.cut || job.sound_cut ||
           std::any_of(job.performers.begin(), job.performers.end(),
                       [](const Performer& each) { return each.cut || each.voice_cut; });
}

void finish(Soundtrack& track, const ClipJob& job, std::size_t frames, const FrameRange& range) {
    if (job.silent) track.sound.reset();
    if (job.spoken && !track.sound) {
        throw Error(format("spoken notice \"{}\": the clip has no sound to speak over; give it one",
                           job.spoken->text));
    }
    if (!track.sound) return;
    if (is_stack_pattern(job.out)) {
        track.warnings.push_back(
            format("{}: pictures hold no sound; that of {} decides only how many there are", job.out.string(),
                   name_of_sound(job)));
    }
    // A condition of a study ends where the shortest one does, and its sound as it would with a cut.
    const bool ends_early = job.at_least && *range.last < frames;
    const double seconds = job.fps.seconds(ends_early ? *range.last : frames);
    if (picture_sets_length(job)) {
        fit_to_picture(track, job, seconds);
    } else {
        track.sound =
            ends_early ? set_duration(*track.sound, seconds) : pad_with_silence(*track.sound, seconds);
    }
    if (job.spoken) track.sound = speak_over(*track.sound, *job.spoken);
    if (!job.loudness) keep_in_scale(track, job);
    track.sound = part_of(*track.sound, range, job.fps);
    if (!job.loudness) return;
    LoudSound loud = normalize_loudness(*track.sound, *job.loudness);
    track.sound = std::move(loud.sound);
    if (!loud.warning.empty()) track.warnings.push_back(format("{}: {}", name_of_sound(job), loud.warning));
    keep_in_scale(track, job);
}

}  // namespace chironomia::study
