#include "study/corpus/talks.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/math.h"
#include "core/quantile.h"
#include "core/text.h"
#include "synth/features/contour.h"
#include "synth/features/speech_units.h"
#include "synth/speech/timed_words.h"

namespace chironomia::study {
namespace {

constexpr std::size_t kPitchColumn = IpuRecord::kUnits, kYawColumn = IpuRecord::kUnits + 1;
constexpr double kLeastVariance = 1e-6;  // of the head [rad^2]; a picture that stands has less

// The column's numbers in frames with a face.
std::vector<double> seen_values(const TrackedValues& face, std::size_t column) {
    std::vector<double> values;
    for (std::size_t t = 0; t < face.frames(); ++t) {
        if (face.success[t]) values.push_back(face.values[t * face.width + column]);
    }
    return values;
}

double median_size_deg(std::vector<double> radians) {
    for (double& value : radians) value = std::abs(value);
    return median(std::move(radians)) * 180 / double{kPi};
}

double variance(const std::vector<double>& values) {
    double mean = 0, sum = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) sum += (value - mean) * (value - mean);
    return sum / static_cast<double>(values.size());
}

// Cuts the units of one recording.
class TalkCutter {
  public:
    TalkCutter(const TalkRecording& talk, const ShotLimits& limits, const TextEncoder& encoder)
        : talk_(talk),
          limits_(limits),
          encoder_(encoder),
          face_(read_talk_face(talk.person.face)),
          voice_(read_talk_voice(talk.person)) {
        const RecordedEnds ends{
            .first_time = face_.first_time, .seen = face_.seconds(), .heard = voice_.seconds()};
        refuse_late_beginning(talk.person.face, ends);
        if (std::abs(face_.seconds() - voice_.seconds()) > kLooseEnd) {
            throw Error(format(
                "{}: it lasts {:.2f} s ({} frames at {:.6g} frames/s), and the voice of \"{}\" {:.2f} s; give "
                "files that begin and end together",
                talk.person.face.string(), face_.seconds(), face_.frames(), face_.fps, talk.id,
                voice_.seconds()));
        }
        TimedWords words = read_timed_words(talk.words, voice_.seconds());
        for (SpokenWord& word : words.words)
            words_.push_back({.text = std::move(word.text), .start = word.start, .end = word.end});
        for (const auto* notes : {&face_.notes, &words.notes})
            cut_.notes.insert(cut_.notes.end(), notes->begin(), notes->end());
        if (auto note = note_of_ends("the face", ends)) cut_.notes.push_back(std::move(*note));
    }

    CutTalk run() {
        std::size_t whole = 0;
        for (const VideoShot& shot : read_shots(talk_.shots, face_)) {
            whole += words_in(shot).size();
            cut_shot(shot);
        }
        if (whole < words_.size()) cut_.left_out["words that no shot has whole"] = words_.size() - whole;
        add_vectors();
        return std::move(cut_);
    }

  private:
    void cut_shot(const VideoShot& shot) {
        const TrackedValues tracked = frames_of(face_, shot);
        if (const std::string fault = fault_of(tracked, limits_); !fault.empty()) {
            ++cut_.left_out[fault];
            return;
        }
        const std::vector<CorpusWord> words = words_in(shot);
        if (words.empty()) {
            ++cut_.left_out["shots without a whole word"];
            return;
        }
        const TrackedValues clean = *smoothed(tracked);  // has a face, or it would have a fault
        for (const SpeechUnit& unit : speech_units(words, talk_.words.string()))
            cut_unit(unit, clean, static_cast<double>(shot.first) / face_.fps);
    }

    std::vector<CorpusWord> words_in(const VideoShot& shot) const {
        const double start = static_cast<double>(shot.first) / face_.fps;
        const double end = std::min(static_cast<double>(shot.last) / face_.fps, voice_.seconds());
        // Faces are cut to whole frames: the last word may end behind the last one.
        const double loose = 1 / face_.fps;
        std::vector<CorpusWord> words;
        for (const CorpusWord& word : words_) {
            if (word.start >= start && word.end <= end + loose) words.push_back(word);
        }
        return words;
    }

    // `start` is that of the shot that `clean` is the face of [s].
    void cut_unit(const SpeechUnit& unit, const TrackedValues& clean, double start) {
        const auto spoken = static_cast<std::size_t>(std::count_if(
            unit.words.begin(), unit.words.end(), [](const auto& word) { return word.text != ","; }));
        if (spoken < limits_.least_words)
            return leave_out(format("units under {} words", limits_.least_words));
        IpuRecord record = record_of(unit);
        if (!put_voice(record, unit)) return leave_out("units without a voiced sample");
        put_face(record, clean, unit, start);
        const auto seen = std::count(record.success.begin(), record.success.end(), 1);
        if (static_cast<double>(seen) < limits_.least_success * static_cast<double>(record.frames()))
            return leave_out(
                format("units with a face in under {:g} % of the frames", 100 * limits_.least_success));
        cut_.units.push_back(std::move(record));
    }

    void leave_out(const std::string& why) { ++cut_.left_out[why]; }

    IpuRecord record_of(const SpeechUnit& unit) const {
        IpuRecord record{.id = format("{}_{:04}", talk_.id, cut_.units.size()),
                         .speaker = talk_.speaker,
                         .source = talk_.id,
                         .start = unit.start};
        for (const CorpusWord& word : unit.words)
            record.words.push_back(
                {.text = word.text, .start = word.start - unit.start, .end = word.end - unit.start});
        return record;
    }

    // All units at once: to start an encoder may take long.
    void add_vectors() {
        Utterances utterances;
        for (const IpuRecord& unit : cut_.units) utterances.push_back(texts_in(unit.words));
        std::vector<std::vector<float>> vectors = encoder_.vectors(utterances);
        for (std::size_t i = 0; i < cut_.units.size(); ++i) cut_.units[i].vectors = std::move(vectors[i]);
    }

    // False if nothing of it is voiced.
    bool put_voice(IpuRecord& record, const SpeechUnit& unit) const {
        const auto first = static_cast<std::size_t>(std::lround(unit.start * IpuRecord::kSpeechRate));
        const auto count = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround((unit.end - unit.start) * IpuRecord::kSpeechRate)));
        const std::size_t last = std::min(first + count, voice_.samples());
        const auto cut = [&](const std::vector<float>& values, std::size_t width) {
            return std::vector<float>(values.begin() + static_cast<std::ptrdiff_t>(first * width),
                                      values.begin() + static_cast<std::ptrdiff_t>(last * width));
        };
        auto f0 = fill_pitch(cut(voice_.f0, 1), IpuRecord::kSpeechRate, record.words);
        if (!f0) return false;
        record.f0 = std::move(*f0);
        record.f0_strength = cut(voice_.strength, 1);
        record.voice = cut(voice_.quality, IpuRecord::kVoice);
        return true;
    }

    static void put_face(IpuRecord& record, const TrackedValues& clean, const SpeechUnit& unit,
                         double start) {
        const auto frames = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround((unit.end - unit.start) * record.fps)));
        const TrackedValues face =
            resampled(clean, {.start = unit.start - start, .fps = record.fps, .frames = frames});
        for (std::size_t t = 0; t < frames; ++t) {
            const auto row = face.values.begin() + static_cast<std::ptrdiff_t>(t * face.width);
            record.units.insert(record.units.end(), row, row + IpuRecord::kUnits);
            record.head.insert(record.head.end(), row + IpuRecord::kUnits, row + face.width);
        }
        record.success = face.success;
        record.confidence = face.confidence;
    }

    const TalkRecording& talk_;
    const ShotLimits& limits_;
    const TextEncoder& encoder_;
    TrackedValues face_;
    RecordedVoice voice_;
    std::vector<CorpusWord> words_;
    CutTalk cut_;
};

}  // namespace

std::string fault_of(const TrackedValues& face, const ShotLimits& limits) {
    if (face.seconds() < limits.least_seconds) return format("shots under {:g} s", limits.least_seconds);
    const double success = success_of(face);
    if (success == 0 || success < limits.least_success)
        return format("shots with a face in under {:g} % of the frames", 100 * limits.least_success);
    const auto sure = std::count_if(face.confidence.begin(), face.confidence.end(), [&](float confidence) {
        return confidence >= static_cast<float>(limits.least_confidence);
    });
    if (static_cast<double>(sure) < limits.least_sure * static_cast<double>(face.frames())) {
        return format("shots with a confidence of {:g} in under {:g} % of the frames",
                      limits.least_confidence, 100 * limits.least_sure);
    }
    const std::vector<double> yaw = seen_values(face, kYawColumn), pitch = seen_values(face, kPitchColumn);
    if (median_size_deg(yaw) > limits.most_yaw_deg)
        return format("shots of a head turned by more than {:g} degrees", limits.most_yaw_deg);
    if (median_size_deg(pitch) > limits.most_pitch_deg)
        return format("shots of a head raised or lowered by more than {:g} degrees", limits.most_pitch_deg);
    if (variance(yaw) + variance(pitch) < kLeastVariance) return "shots of a picture that stands still";
    return "";
}

CutTalk cut_talk(const TalkRecording& talk, const ShotLimits& limits, const TextEncoder& encoder) {
    return TalkCutter(talk, limits, encoder).run();
}

}  // namespace chironomia::study
