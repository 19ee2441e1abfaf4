#include "study/corpus/import.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/hash.h"
#include "core/progress.h"
#include "core/text.h"
#include "study/corpus/intervals.h"
#include "study/corpus/manifest.h"
#include "study/corpus/recording.h"
#include "study/corpus/talks.h"
#include "study/measure/pointwise.h"
#include "synth/corpus/splits.h"
#include "synth/corpus/statistics.h"

namespace chironomia::study {
namespace {

// A dyad, or why it is left out.
struct JoinedDyad {
    DyadRecord record;
    std::string fault;
    std::vector<std::string> notes;
};

// One person's face and voice, each as long as its file.
struct DyadSide {
    TrackedValues face;        // as it was tracked
    std::vector<float> voice;  // (T, kSpeech) at kFps

    double shorter() const { return std::min(face.seconds(), voice_seconds()); }
    double longer() const { return std::max(face.seconds(), voice_seconds()); }
    double voice_seconds() const {
        return static_cast<double>(voice.size() / DyadPerson::kSpeech) / DyadRecord::kFps;
    }
};

std::string voice_file(const RecordedPerson& person) {
    return (person.audio.empty() ? person.speech : person.audio).string();
}

// All four recordings begin together; what one has more at its end is cut off.
std::size_t common_frames(const std::array<DyadSide, 2>& sides, const DyadRecording& dyad,
                          const std::string& where) {
    const double shortest = std::min(sides[0].shorter(), sides[1].shorter());
    const double longest = std::max(sides[0].longer(), sides[1].longer());
    if (longest - shortest > kLooseEnd) {
        throw Error(
            format("{}: dyad \"{}\": its faces last {:.2f} and {:.2f} s, its voices {:.2f} and {:.2f} "
                   "s; cut them so that they begin and end together",
                   where, dyad.id, sides[0].face.seconds(), sides[1].face.seconds(), sides[0].voice_seconds(),
                   sides[1].voice_seconds()));
    }
    return static_cast<std::size_t>(shortest * DyadRecord::kFps + 1e-6);
}

// A copy that is louder or has another rate has the same loudness but for a factor, and the same pitch. Those of two
// people have not, even where each microphone hears both; the limits are ours.
void refuse_copied_voice(const std::array<DyadSide, 2>& sides, const DyadRecording& dyad,
                         const std::string& where) {
    constexpr double kLikeLoudness = 0.999, kLikePitch = 0.95, kSamePitch = 0.01;
    constexpr std::size_t kPitch = 0, kLoudness = 1;
    const std::size_t rows = std::min(sides[0].voice.size(), sides[1].voice.size()) / DyadPerson::kSpeech;
    std::array<std::vector<float>, 2> loudness;
    double voiced = 0, same = 0;
    for (std::size_t t = 0; t < rows; ++t) {
        const float *a = &sides[0].voice[t * DyadPerson::kSpeech],
                    *b = &sides[1].voice[t * DyadPerson::kSpeech];
        loudness[0].push_back(a[kLoudness]);
        loudness[1].push_back(b[kLoudness]);
        if (a[kPitch] <= 0 || b[kPitch] <= 0) continue;
        ++voiced;
        same += std::abs(a[kPitch] - b[kPitch]) <= kSamePitch * a[kPitch];
    }
    const auto correlation = pearson(loudness[0], loudness[1]);
    if (!correlation || *correlation < kLikeLoudness || voiced == 0 || same < kLikePitch * voiced) return;
    throw Error(format(
        "{}: dyad \"{}\": {} and {} are one sound: their loudness correlates by {:.4f}, and their pitch is the same in "
        "{:.0f} % of the frames; give each person's own microphone",
        where, dyad.id, voice_file(dyad.people[0]), voice_file(dyad.people[1]), *correlation,
        100 * same / voiced));
}

JoinedDyad join_dyad(const DyadRecording& dyad, const ShotLimits& limits, const std::string& where) {
    JoinedDyad joined{.record = {.id = dyad.id, .language = dyad.language}};
    std::array<DyadSide, 2> sides;
    for (std::size_t p = 0; p < 2; ++p) {
        sides[p] = {.face = read_dyad_face(dyad.people[p].face), .voice = read_dyad_voice(dyad.people[p])};
        const RecordedEnds ends{.first_time = sides[p].face.first_time,
                                .seen = sides[p].face.seconds(),
                                .heard = sides[p].voice_seconds()};
        refuse_late_beginning(dyad.people[p].face, ends);
        std::vector<std::string> notes = sides[p].face.notes;
        if (auto note = note_of_ends("the face", ends)) notes.push_back(std::move(*note));
        for (const std::string& note : notes)
            joined.notes.push_back(format("{}, {}: {}", dyad.id, dyad.participants[p], note));
    }
    const std::size_t frames = common_frames(sides, dyad, where);
    refuse_copied_voice(sides, dyad, where);
    for (std::size_t p = 0; p < 2; ++p) {
        const auto face = smoothed(sides[p].face);
        if (!face || frames == 0 || success_of(*face) < limits.least_success) {
            joined.fault =
                format("dyads with a face in under {:g} % of the frames", 100 * limits.least_success);
            return joined;
        }
        DyadPerson& person = joined.record.people[p];
        person.participant = dyad.participants[p];
        person.role = dyad.roles[p];
        person.face = resampled(*face, {.start = 0, .fps = DyadRecord::kFps, .frames = frames}).values;
        person.speech = std::move(sides[p].voice);
        person.speech.resize(frames * DyadPerson::kSpeech);
    }
    return joined;
}

// Makes the corpus in a folder that is not there yet.
class Importer {
  public:
    Importer(const ImportJob& job, const ImportManifest& manifest, const std::filesystem::path& folder)
        : job_(job), manifest_(manifest) {
        imported_.index = {.folder = folder, .kind = manifest.kind, .text_encoder = job.encoder.name};
    }

    Imported run() {
        const std::size_t count =
            manifest_.talks.size() + manifest_.dyads.size() + manifest_.intervals.size();
        Progress progress(job_.out.filename().string(), "recordings", count, job_.quiet);
        const auto add_all = [&](const auto& recordings) {
            for (const auto& recording : recordings) {
                add(recording);
                progress.step();
            }
        };
        add_all(manifest_.talks);
        add_all(manifest_.dyads);
        add_all(manifest_.intervals);
        finish();
        return std::move(imported_);
    }

  private:
    void add(const TalkRecording& talk) {
        const CutTalk cut = cut_talk(talk, manifest_.limits, job_.encoder);
        for (const IpuRecord& unit : cut.units) {
            write_ipu(imported_.index.folder, unit);
            const double seconds = static_cast<double>(unit.frames()) / unit.fps;
            add_entry({.id = unit.id, .speaker = unit.speaker, .seconds = seconds}, talk.split);
            bridged_ += static_cast<std::size_t>(std::count(unit.success.begin(), unit.success.end(), 0));
            frames_ += unit.frames();
        }
        note(talk.id, cut.left_out, cut.notes);
    }

    void add(const DyadRecording& dyad) {
        const JoinedDyad joined = join_dyad(dyad, manifest_.limits, manifest_.file.string());
        imported_.notes.insert(imported_.notes.end(), joined.notes.begin(), joined.notes.end());
        if (!joined.fault.empty()) {
            ++left_out_[joined.fault];
            return;
        }
        write_dyad(imported_.index.folder, joined.record);
        add_entry({.id = dyad.id,
                   .speaker = dyad.participants[0] + "+" + dyad.participants[1],
                   .seconds = static_cast<double>(joined.record.frames()) / DyadRecord::kFps},
                  dyad.split);
    }

    void add(const IntervalRecording& recording) {
        const auto keep = [&](const IntervalRecord& interval, double start) {
            write_interval(imported_.index.folder, interval);
            const double seconds = static_cast<double>(interval.frames()) / IntervalRecord::kFps;
            add_entry({.id = interval.id,
                       .speaker = interval.speaker,
                       .seconds = seconds,
                       .recording = recording.id,
                       .start = start},
                      recording.split);
        };
        const CutIntervals cut = cut_intervals(recording, manifest_, job_.encoder, keep);
        bridged_ += cut.bridged;
        frames_ += cut.frames;
        note(recording.id, cut.left_out, cut.notes);
    }

    void note(const std::string& id, const LeftOut& left_out, const std::vector<std::string>& notes) {
        for (const auto& [why, number] : left_out) left_out_[why] += number;
        for (const std::string& note : notes) imported_.notes.push_back(format("{}: {}", id, note));
    }

    void add_entry(CorpusEntry entry, std::optional<Split> split) {
        has_splits_ = split.has_value();
        entry.split = split.value_or(Split::train);
        imported_.index.entries.push_back(std::move(entry));
    }

    void finish() {
        CorpusIndex& index = imported_.index;
        for (const auto& [why, number] : left_out_)
            imported_.notes.push_back(format("left out: {}: {}", why, number));
        if (bridged_ > 0)
            imported_.notes.push_back(format("{} of {} frames were bridged", bridged_, frames_));
        if (index.entries.empty()) {
            throw Error(format("{}: nothing is left to learn from: {}", manifest_.file.string(),
                               join(imported_.notes, "; ")));
        }
        if (!has_splits_ && index.kind == CorpusKind::dyads)
            index.entries =
                split_by_participants(std::move(index.entries), job_.seed, manifest_.file.string());
        else if (!has_splits_)
            index.entries = split_by_speakers(std::move(index.entries), job_.seed);
        index.origin = {{"command", "corpus import"}, {"seed", job_.seed}, {"notes", imported_.notes}};
        if (!job_.encoder.weights.empty())
            index.origin["text_encoder_sha256"] = sha256_of_file(job_.encoder.weights);
        write_corpus_index(index);
        write_statistics(index.folder, measure_statistics(index));
    }

    const ImportJob& job_;
    const ImportManifest& manifest_;
    Imported imported_;
    LeftOut left_out_;
    bool has_splits_ = false;
    std::size_t bridged_ = 0, frames_ = 0;
};

}  // namespace

Imported import_corpus(const ImportJob& job) {
    const ImportManifest manifest = read_import_manifest(job.manifest);
    PendingOutput out(job.out, PendingOutput::Kind::folder);
    Imported imported = Importer(job, manifest, out.path()).run();
    out.commit();
    imported.index.folder = job.out;
    return imported;
}

}  // namespace chironomia::study
