#include "study/corpus/intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/audio.h"
#include "core/error.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "study/corpus/pieces.h"
#include "study/corpus/pose.h"
#include "study/corpus/recording.h"
#include "synth/features/spectrum.h"
#include "synth/features/speech_units.h"
#include "synth/speech/silent_words.h"
#include "synth/speech/timed_words.h"
#include "synth/text/dialog_acts.h"
#include "synth/text/interval_text.h"

namespace chironomia::study {
namespace {

constexpr double kIntervalFps = IntervalRecord::kFps;
constexpr double kFrameSlack = 1e-6;  // of sums of decimal fractions [frames]

// Of PATS's joints: those that must be seen for a gesture to be.
struct ArmPoint {
    std::size_t joint = 0;
    const char* name = nullptr;
};
constexpr ArmPoint kArmPoints[] = {{0, "neck"},        {1, "right shoulder"}, {2, "right elbow"},
                                   {3, "right wrist"}, {4, "left shoulder"},  {5, "left elbow"},
                                   {6, "left wrist"}};

constexpr int kSpectraRate = 44100;  // [samples/s] of log_mel_512

// The frame that is shown at a time, and the first one that begins then or later.
std::size_t frame_shown_at(double time) {
    return static_cast<std::size_t>(std::floor(time * kIntervalFps + kFrameSlack));
}
std::size_t first_frame_from(double time) {
    return static_cast<std::size_t>(std::ceil(time * kIntervalFps - kFrameSlack));
}
double time_of_frame(std::size_t frame) {
    return static_cast<double>(frame) / kIntervalFps;
}

Audio sound_in(const Audio& sound, const IntervalFrames& frames) {
    const auto sample = [&](std::size_t frame) {
        const auto place = static_cast<std::size_t>(std::lround(time_of_frame(frame) * sound.rate));
        return static_cast<std::ptrdiff_t>(std::min(place, sound.length()) *
                                           static_cast<std::size_t>(sound.channels));
    };
    return {.rate = sound.rate,
            .channels = sound.channels,
            .samples = {sound.samples.begin() + sample(frames.first),
                        sound.samples.begin() + sample(frames.last)}};
}

RecordedEnds ends_of(const Motion& motion, const Audio& sound) {
    return {.first_time = motion.first_time, .seen = duration(motion), .heard = sound.duration()};
}

// The frames of the recording that are taken.
IntervalFrames frames_taken(const IntervalRecording& recording, const Motion& motion, const Audio& sound,
                            const std::string& where) {
    const double pose = duration(motion), heard = sound.duration(), shorter = std::min(pose, heard);
    refuse_late_beginning(recording.pose, ends_of(motion, sound));
    if (!recording.end && std::abs(pose - heard) > kLooseEnd) {
        throw Error(format(
            "{}: recording \"{}\": its pose lasts {:.2f} s ({} frames at {:g} frames/s) and its sound {:.2f} s, "
            "{:.2f} s {}; correct \"fps\", give files that end together, or say with \"end\" how much is taken",
            where, recording.id, pose, motion.frames, motion.fps, heard, std::abs(heard - pose),
            heard > pose ? "more" : "less"));
    }
    const double start = recording.start.value_or(0), end = recording.end.value_or(shorter);
    if (end > shorter + 1 / kIntervalFps || start >= shorter) {
        throw Error(format(
            "{}: recording \"{}\": the part from {:g} to {:g} s is taken, but its pose lasts {:.2f} s and its "
            "sound {:.2f} s; take what both have",
            where, recording.id, start, end, pose, heard));
    }
    return {.first = first_frame_from(start), .last = frame_shown_at(std::min(end, shorter))};
}

// Words behind "end" need no sound; of those that have one nothing changes.
TimedWords read_words(const IntervalRecording& recording, const Audio& sound) {
    const double duration = sound.duration();
    if (!recording.end) return read_timed_words(recording.words, duration);
    TimedWords timed = read_timed_words(recording.words, std::numeric_limits<double>::infinity());
    const auto late =
        std::ranges::find_if(timed.words, [&](const SpokenWord& word) { return word.end > duration; });
    if (late == timed.words.end() || late->start < *recording.end)
        return read_timed_words(recording.words, duration);
    timed.notes.push_back(format(
        "{}: {} words from {:.3f} s on lie behind \"end\", {:g} s, and the sound of {:.3f} s; left out",
        recording.words.string(), timed.words.end() - late, late->start, *recording.end, duration));
    timed.written.resize(static_cast<std::size_t>(late - timed.words.begin()));
    timed.words.erase(late, timed.words.end());
    return timed;
}

class IntervalCutter {
  public:
    IntervalCutter(const IntervalRecording& recording, const ImportManifest& manifest)
        : recording_(recording),
          limits_(manifest.interval_limits),
          motion_(read_pose(recording)),
          sound_(read_audio(recording.audio)),
          frames_(frames_taken(recording, motion_, sound_, manifest.file.string())) {
        TimedWords timed = read_words(recording, sound_);
        for (const auto* notes : {&motion_.notes, &timed.notes})
            cut_.notes.insert(cut_.notes.end(), notes->begin(), notes->end());
        if (auto note = note_of_ends("the pose", ends_of(motion_, sound_)); note && !recording.end)
            cut_.notes.push_back(std::move(*note));
        if (sound_.rate < kSpectraRate) {
            cut_.notes.push_back(
                format("sound: {} samples/s, so spectra have nothing above {:g} Hz; give the same rate "
                       "of all recordings",
                       sound_.rate, 0.5 * sound_.rate));
        }
        for (std::string& doubt :
             doubts_of_word_times({timed.words, recording.words, sound_, recording.audio}))
            cut_.notes.push_back(std::move(doubt));
        std::vector<CorpusWord> written;
        for (std::size_t w = 0; w < timed.words.size(); ++w) {
            const SpokenWord& word = timed.words[w];
            words_.push_back({.text = word.text, .start = word.start, .end = word.end});
            written.push_back({.text = timed.written[w], .start = word.start, .end = word.end});
        }
        find_acts(written);
    }

    CutIntervals run(const TextEncoder& encoder,
                     const std::function<void(const IntervalRecord&, double)>& keep) {
        if (frames_.first < frames_.last) {
            pose_ = pose_in(motion_, frames_, recording_, limits_);
            choose_pieces();
        }
        // All at once: to start an encoder may take long.
        Utterances utterances;
        for (const IntervalRecord& text : texts_) utterances.push_back(texts_in(text.words));
        const std::vector<std::vector<float>> vectors = encoder.vectors(utterances);
        for (std::size_t i = 0; i < texts_.size(); ++i) {
            keep(with_text(with_pose_and_sound(texts_[i], chosen_[i].frames), encoder,
                           {.vectors = vectors[i], .acts = acts_of(chosen_[i].piece)}),
                 time_of_frame(chosen_[i].frames.first));
        }
        return std::move(cut_);
    }

  private:
    struct ChosenPiece {
        SpeechPiece piece;
        IntervalFrames frames;
    };

    // Acts are recognised by English words.
    void find_acts(const std::vector<CorpusWord>& written) {
        if (to_lower(recording_.language).starts_with("en"))
            acts_ = dialog_acts_of(written, kLongestPause);
        else
            cut_.notes.push_back(
                format("language \"{}\": dialog acts are found in English alone", recording_.language));
    }

    std::vector<std::size_t> acts_of(const SpeechPiece& piece) const {
        if (acts_.empty()) return {};
        return {acts_.begin() + static_cast<std::ptrdiff_t>(piece.first),
                acts_.begin() + static_cast<std::ptrdiff_t>(piece.last)};
    }

    void choose_pieces() {
        const std::vector<SpeechPiece> pieces = speech_pieces(
            words_, {.start = time_of_frame(frames_.first), .end = time_of_frame(frames_.last)}, limits_);
        if (pieces.empty()) ++cut_.left_out["recordings without a whole word"];
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            IntervalFrames frames{.first = frame_shown_at(pieces[i].time.start),
                                  .last = std::min(first_frame_from(pieces[i].time.end), frames_.last)};
            // No frame belongs to two intervals, which may be in different splits.
            if (i + 1 < pieces.size())
                frames.last = std::min(frames.last, frame_shown_at(pieces[i + 1].time.start));
            choose({.piece = pieces[i], .frames = frames});
        }
    }

    void choose(const ChosenPiece& chosen) {
        if (const std::string fault = fault_in(chosen); !fault.empty()) {
            ++cut_.left_out[fault];
            return;
        }
        IntervalRecord text{.id = format("{}_{:04}", recording_.id, chosen_.size()),
                            .speaker = recording_.speaker};
        const double start = time_of_frame(chosen.frames.first);
        for (std::size_t w = chosen.piece.first; w < chosen.piece.last; ++w) {
            text.words.push_back({.text = words_[w].text,
                                  .start = std::max(0.0, words_[w].start - start),
                                  .end = words_[w].end - start});
        }
        for (std::size_t t = chosen.frames.first; t < chosen.frames.last; ++t) {
            const auto is_lost = [&](const ArmPoint& point) { return !sees(t, point); };
            cut_.bridged += std::any_of(std::begin(kArmPoints), std::end(kArmPoints), is_lost) ? 1 : 0;
        }
        cut_.frames += chosen.frames.count();
        chosen_.push_back(chosen);
        texts_.push_back(std::move(text));
    }

    std::string fault_in(const ChosenPiece& chosen) const {
        if (chosen.piece.spoken.seconds() > limits_.most_seconds + kFrameSlack)
            return format("stretches over {:g} s without a place to cut", limits_.most_seconds);
        const auto count = static_cast<double>(chosen.frames.count());
        if (count / kIntervalFps < limits_.least_seconds - kFrameSlack)
            return format("intervals under {:g} s", limits_.least_seconds);
        if (chosen.piece.last - chosen.piece.first < limits_.least_words)
            return format("intervals under {} words", limits_.least_words);
        for (const ArmPoint& point : kArmPoints) {
            std::size_t seen = 0;
            for (std::size_t t = chosen.frames.first; t < chosen.frames.last; ++t) seen += sees(t, point);
            if (static_cast<double>(seen) < limits_.least_seen * count)
                return format("intervals with the {} in under {:g} % of the frames", point.name,
                              100 * limits_.least_seen);
        }
        return "";
    }

    // `frame` is one of the recording.
    bool sees(std::size_t frame, const ArmPoint& point) const {
        const std::size_t row = (frame - frames_.first) * 2 * IntervalRecord::kJoints;
        return pose_.body.confidence[row + point.joint] > 0;
    }

    IntervalRecord with_pose_and_sound(IntervalRecord interval, const IntervalFrames& frames) const {
        const auto rows = [&](const std::vector<float>& values) {
            const std::size_t width = values.size() / frames_.count();
            const auto at = [&](std::size_t frame) {
                return values.begin() + static_cast<std::ptrdiff_t>((frame - frames_.first) * width);
            };
            return std::vector<float>(at(frames.first), at(frames.last));
        };
        interval.pose = rows(pose_.body.places);
        interval.pose_normalized = rows(pose_.body.normalized);
        interval.pose_confidence = rows(pose_.body.confidence);
        interval.face = rows(pose_.face.places);
        interval.face_normalized = rows(pose_.face.normalized);
        interval.face_confidence = rows(pose_.face.confidence);
        IntervalSpectra spectra = interval_spectra(sound_in(sound_, frames));
        interval.mel_400 = std::move(spectra.mel_400);
        interval.mel_512 = std::move(spectra.mel_512);
        return interval;
    }

    const IntervalRecording& recording_;
    const IntervalLimits& limits_;
    Motion motion_;
    Audio sound_;
    IntervalFrames frames_;  // that are taken
    std::vector<CorpusWord> words_;
    std::vector<std::size_t> acts_;  // (words); empty: not known
    RecordedPose pose_;              // of frames_
    std::vector<ChosenPiece> chosen_;
    std::vector<IntervalRecord> texts_;  // (chosen) id, speaker and words alone
    CutIntervals cut_;
};

}  // namespace

CutIntervals cut_intervals(const IntervalRecording& recording, const ImportManifest& manifest,
                           const TextEncoder& encoder,
                           const std::function<void(const IntervalRecord&, double)>& keep) {
    return IntervalCutter(recording, manifest).run(encoder, keep);
}

}  // namespace chironomia::study
