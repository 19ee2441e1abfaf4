#include "synth/corpus/record_checks.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

constexpr double kLooseEnd = 0.1;        // [s] by which sound, face and words of a record may differ
constexpr double kWordGap = 1e-3;        // [s] between words that follow each other
constexpr double kMelTolerance = 0.1;    // of PATS's rates: they depend on the sound's own
constexpr double kMelSlack = 8;          // rows: the last window of a short interval may be missing
constexpr float kMostTurn = 3.15f;       // [rad]; what is larger are degrees
constexpr float kMostConfidence = 1.5f;  // OpenPose's goes a little above 1

// One record under inspection.
class Inspector {
  public:
    explicit Inspector(const std::string& where) : where_(where) {}

    [[noreturn]] void refuse(const std::string& message) const {
        throw Error(format("{}: {}", where_, message));
    }

    void name(const std::string& value, std::string_view what) const {
        if (is_plain_name(value)) return;
        refuse(format("the {} \"{}\" cannot name a file; use letters, digits and . _ - +", what, value));
    }

    void rows(std::size_t found, std::size_t expected, std::string_view array, std::string_view like) const {
        if (found == expected) return;
        refuse(format("/{} has {} numbers, and {} fit /{}; they must be equally long", array, found, expected,
                      like));
    }

    void range(std::span<const float> values, float least, float most, std::string_view array) const {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] >= least && values[i] <= most) continue;
            refuse(format("/{}: element {} is {}; {} to {} is expected", array, i, values[i], least, most));
        }
    }

    void finite(std::span<const float> values, std::string_view array) const {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!std::isfinite(values[i]))
                refuse(format("/{}: element {} is {}; all must be finite", array, i, values[i]));
        }
    }

    void flags(std::span<const std::uint8_t> values, std::string_view array) const {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] > 1)
                refuse(format("/{}: element {} is {}; 0 or 1 is expected", array, i, values[i]));
        }
    }

    void rate(double found, double expected, std::string_view what) const {
        if (std::abs(found - expected) < 1e-6) return;
        refuse(format("{} has {} frames/s, and models learn at {}; resample it, as `corpus import` does",
                      what, found, expected));
    }

    void length(double found, double expected, std::string_view array, std::string_view like) const {
        if (std::abs(found - expected) <= kLooseEnd) return;
        refuse(
            format("/{} lasts {:.3f} s, /{} {:.3f} s; cut them at the same places, at the rates that "
                   "the format has",
                   array, found, like, expected));
    }

    // `meet`: they follow each other without gaps, and each lasts. PATS counts in frames, of which its short words
    // have none.
    void words(const std::vector<CorpusWord>& words, bool meet) const {
        for (std::size_t i = 0; i < words.size(); ++i) {
            const CorpusWord& word = words[i];
            if (word.text.empty()) refuse(format("word {} is empty", i));
            const bool lasts = meet ? word.end > word.start : word.end >= word.start;
            if (!(word.start >= 0 && lasts && std::isfinite(word.end))) {
                refuse(format("word {} \"{}\" lasts from {} to {} s; it {}", i, word.text, word.start,
                              word.end, meet ? "must end after it starts" : "may not end before it starts"));
            }
            if (i == 0) continue;
            const double gap = word.start - words[i - 1].end;
            if (gap < -kWordGap || (meet && gap > kWordGap)) {
                refuse(format("word {} \"{}\" starts at {} s, the word before it ends at {} s; {}", i,
                              word.text, word.start, words[i - 1].end,
                              meet ? "a silence between words is the word \",\"" : "words may not overlap"));
            }
        }
    }

  private:
    const std::string& where_;
};

// One of PATS's spectra.
struct MelArray {
    std::string_view name;  // "audio/log_mel_400"
    const std::vector<float>& numbers;
    std::size_t width = 0;
    double rate = 0;  // [rows/s]
};

// Beside `seconds` of pose.
void check_mel(const Inspector& inspector, const MelArray& mel, double seconds) {
    const auto& [array, numbers, width, rate] = mel;
    if (numbers.size() % width != 0)
        inspector.refuse(format("/{} has no whole rows of {} numbers", array, width));
    const double rows = static_cast<double>(numbers.size() / width), expected = rate * seconds;
    inspector.finite(numbers, array);
    if (std::abs(rows - expected) <= kMelTolerance * expected + kMelSlack) return;
    inspector.refuse(format(
        "/{} has {} rows for {:.2f} s of pose, where about {:.0f} are expected ({} a second); take the "
        "window and the hop of PATS",
        array, rows, seconds, expected, rate));
}

// Points of a picture as a record holds them, x and y.
struct PointArrays {
    std::string group;  // "pose", "face"
    const std::vector<float>& places;
    const std::vector<float>& normalized;
    const std::vector<float>& confidence;
};

void check_points(const Inspector& inspector, const PointArrays& points, std::size_t count) {
    const auto& [group, places, normalized, confidence] = points;
    inspector.rows(places.size(), count, group + "/data", "pose/data");
    inspector.rows(normalized.size(), count, group + "/normalize", "pose/data");
    inspector.rows(confidence.size(), count, group + "/confidence", "pose/data");
    inspector.finite(places, group + "/data");
    inspector.finite(normalized, group + "/normalize");
    inspector.range(confidence, 0, kMostConfidence, group + "/confidence");
}

}  // namespace

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
               c == '_' || c == '-' || c == '+';
    });
}

void check_record(const IpuRecord& record, const std::string& where) {
    const Inspector inspector(where);
    inspector.name(record.id, "id");
    inspector.name(record.speaker, "speaker");
    inspector.rate(record.fps, IpuRecord::kFps, "the face");
    const std::size_t frames = record.frames(), samples = record.f0.size();
    if (record.words.empty()) inspector.refuse("there are no words");
    if (frames == 0) inspector.refuse("/success is empty");
    if (samples == 0) inspector.refuse("/f0 is empty");
    inspector.words(record.words, true);
    inspector.rows(record.vectors.size(), record.words.size() * kWordVector, "bert", "words");
    inspector.rows(record.f0_strength.size(), samples, "f0_conf", "f0");
    inspector.rows(record.voice.size(), samples * IpuRecord::kVoice, "vq", "f0");
    inspector.rows(record.units.size(), frames * IpuRecord::kUnits, "au", "success");
    inspector.rows(record.head.size(), frames * IpuRecord::kAngles, "head", "success");
    inspector.rows(record.confidence.size(), frames, "confidence", "success");
    inspector.length(static_cast<double>(samples) / IpuRecord::kSpeechRate, record.words.back().end, "f0",
                     "words");
    inspector.length(static_cast<double>(frames) / record.fps, record.words.back().end, "au", "words");
    inspector.finite(record.vectors, "bert");
    inspector.finite(record.voice, "vq");
    inspector.range(record.f0, 50, 550, "f0");
    inspector.range(record.f0_strength, 0, 1, "f0_conf");
    inspector.range(record.units, 0, 5, "au");
    inspector.range(record.head, -kMostTurn, kMostTurn, "head");
    inspector.range(record.confidence, 0, 1, "confidence");
    inspector.flags(record.success, "success");
}

void check_record(const DyadRecord& record, const std::string& where) {
    const Inspector inspector(where);
    inspector.name(record.id, "id");
    inspector.rate(record.fps, DyadRecord::kFps, "the face");
    const std::size_t frames = record.frames();
    if (frames == 0) inspector.refuse("/A/face is empty");
    for (std::size_t p = 0; p < 2; ++p) {
        const DyadPerson& person = record.people[p];
        const std::string group = p == 0 ? "A" : "B";
        inspector.name(person.participant, "participant");
        if (person.participant.find('+') != std::string::npos)
            inspector.refuse(format("the participant \"{}\" has a +, which joins two of them in the index",
                                    person.participant));
        inspector.rows(person.face.size(), frames * DyadPerson::kFace, group + "/face", "A/face");
        inspector.rows(person.speech.size(), frames * DyadPerson::kSpeech, group + "/speech", "A/face");
        inspector.finite(person.speech, group + "/speech");
        for (std::size_t t = 0; t < frames; ++t) {
            const std::span<const float> row(&person.face[t * DyadPerson::kFace], DyadPerson::kFace);
            inspector.range(row.first(5), -kMostTurn, kMostTurn, format("{}/face of frame {}", group, t));
            inspector.range(row.subspan(5), 0, 5, format("{}/face of frame {} from AU1 on", group, t));
        }
    }
    if (record.people[0].participant == record.people[1].participant)
        inspector.refuse(format("both people are the participant \"{}\"", record.people[0].participant));
}

void check_record(const IntervalRecord& record, const std::string& where) {
    const Inspector inspector(where);
    inspector.name(record.id, "id");
    inspector.name(record.speaker, "speaker");
    const std::size_t frames = record.frames();
    if (frames == 0) inspector.refuse("/pose/data is empty");
    const double seconds = static_cast<double>(frames) / IntervalRecord::kFps;
    check_points(inspector, {"pose", record.pose, record.pose_normalized, record.pose_confidence},
                 frames * 2 * IntervalRecord::kJoints);
    if (!record.face.empty() || !record.face_normalized.empty() || !record.face_confidence.empty()) {
        check_points(inspector, {"face", record.face, record.face_normalized, record.face_confidence},
                     frames * 2 * IntervalRecord::kFacePoints);
    }
    check_mel(inspector,
              {"audio/log_mel_400", record.mel_400, IntervalRecord::kMel400, IntervalRecord::kMel400Rate},
              seconds);
    check_mel(inspector,
              {"audio/log_mel_512", record.mel_512, IntervalRecord::kMel512, IntervalRecord::kMel512Rate},
              seconds);
    inspector.rows(record.vectors.size(), frames * kWordVector, "text/bert", "pose/data");
    inspector.finite(record.vectors, "text/bert");
    inspector.rows(record.tokens.size(), frames, "text/tokens", "pose/data");
    inspector.words(record.words, false);
    if (!record.silence.empty()) inspector.rows(record.silence.size(), frames, "audio/silence", "pose/data");
    inspector.flags(record.silence, "audio/silence");
    if (!record.dialog_acts.empty()) {
        inspector.rows(record.dialog_acts.size(), frames * IntervalRecord::kDialogActs, "dialog/tags",
                       "pose/data");
    }
    inspector.flags(record.dialog_acts, "dialog/tags");
    if (!record.phase.empty()) inspector.rows(record.phase.size(), frames, "meta/phase", "pose/data");
}

}  // namespace chironomia
