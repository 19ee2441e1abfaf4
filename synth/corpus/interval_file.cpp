// An interval as an HDF5 file of PATS (data/processed/<speaker>/<id>.h5), T frames at 15 a second:
//
//   /pose/data, /pose/normalize        (T, 104) x of 52 joints, then y, against the neck, y down [px]; in the
//                                      second all shoulders are equally wide
//   /pose/confidence                   (T, 104) OpenPose's, of each coordinate
//   /audio/log_mel_400                 (Ta, 64) natural logarithms, 100 rows a second
//   /audio/log_mel_512                 (Tb, 128) alike, 86 rows a second
//   /audio/silence                     any length over the same time, 1: no speech; may lack
//   /text/bert                         (T, 768) the vector of the word at each frame
//   /text/tokens                       (T) BERT's numbers of the word pieces
//   /text/meta                         a table of pandas: Word, start_frame, end_frame; may lack
// and what our own files have besides; PATS's do not:
//   /text/words, /text/word_times      (N) text, (N, 2) float64 [s]
//   /face/data, normalize, confidence  (T, 140) 70 points of OpenPose's face as /pose has its joints
//   /dialog/tags                       (T, 38) uint8, acts of the utterance at each frame
//   /meta                              attributes: fps 15, speaker, id, version 1
//   /meta/style                        (12) float32, of a synthetic speaker; no model may read it
//   /meta/phase                        (T) int32, of a synthetic gesture; no model may read it
// Our own files keep spectra and vectors as float16, packed; all else as float32.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/pats_words.h"
#include "synth/corpus/record_checks.h"
#include "synth/corpus/record_files.h"

namespace chironomia {
namespace {

constexpr std::size_t kPose = 2 * IntervalRecord::kJoints;
constexpr std::size_t kFace = 2 * IntervalRecord::kFacePoints;

// The points of a body or a face.
struct Points {
    const std::vector<float>& places;
    const std::vector<float>& normalized;
    const std::vector<float>& confidence;
};

void write_points(Hdf5Writer& file, const std::string& group, std::size_t frames, const Points& points) {
    constexpr auto kDeflated = Hdf5Writer::Packing::deflated;
    const Hdf5Writer::Shape shape = {frames, points.places.size() / frames};
    file.make_group(group);
    file.write_floats(group + "/data", shape, points.places, kDeflated);
    file.write_floats(group + "/normalize", shape, points.normalized, kDeflated);
    file.write_floats(group + "/confidence", shape, points.confidence, kDeflated);
}

void write_meta(Hdf5Writer& file, const IntervalRecord& record) {
    file.make_group("meta");
    file.write_attribute("fps", IntervalRecord::kFps, "meta");
    file.write_attribute("id", record.id, "meta");
    file.write_attribute("speaker", record.speaker, "meta");
    file.write_attribute("version", kRecordVersion, "meta");
    if (record.style) file.write_floats("meta/style", {IntervalRecord::kStyle}, *record.style);
    if (!record.phase.empty()) file.write_ints("meta/phase", {record.frames()}, record.phase);
}

// The published files do not all have as many flags as frames; each frame takes the one at its time.
std::vector<std::uint8_t> read_silence(const RecordFile& file, std::size_t frames) {
    if (!file.has("audio/silence")) return {};
    const std::size_t found = file.rows_of("audio/silence", 1);
    const auto flags = file.flags("audio/silence", found, 1, "audio/silence");
    std::vector<std::uint8_t> silence;
    for (std::size_t t = 0; t < frames; ++t) silence.push_back(flags[t * found / frames]);
    return silence;
}

void check_rate(const RecordFile& file) {
    for (const char* group : {"", "meta", "pose"}) {
        if (!file.has(group)) continue;
        const auto fps = file.hdf5().attribute(group, "fps");
        if (!fps || *fps == IntervalRecord::kFps) continue;
        file.hdf5().refuse(
            format("it has {} frames/s, and PATS has {}; resample it", *fps, IntervalRecord::kFps));
    }
}

}  // namespace

void write_interval_file(const std::filesystem::path& path, const IntervalRecord& record) {
    constexpr auto kFloat16 = Hdf5Writer::Packing::float16;
    check_record(record, path.string());
    const std::size_t frames = record.frames();
    PendingOutput pending(path, PendingOutput::Kind::file);
    Hdf5Writer file(pending.path(), path.string());
    write_points(file, "pose", frames, {record.pose, record.pose_normalized, record.pose_confidence});
    file.make_group("audio");
    file.write_floats("audio/log_mel_400",
                      {record.mel_400.size() / IntervalRecord::kMel400, IntervalRecord::kMel400},
                      record.mel_400, kFloat16);
    file.write_floats("audio/log_mel_512",
                      {record.mel_512.size() / IntervalRecord::kMel512, IntervalRecord::kMel512},
                      record.mel_512, kFloat16);
    if (!record.silence.empty()) file.write_bytes("audio/silence", {frames}, record.silence);
    file.make_group("text");
    file.write_floats("text/bert", {frames, kWordVector}, record.vectors, kFloat16);
    file.write_ints("text/tokens", {frames}, record.tokens);
    write_words(file, "text/words", "text/word_times", record.words);
    if (!record.face.empty()) {
        write_points(file, "face", frames, {record.face, record.face_normalized, record.face_confidence});
    }
    if (!record.dialog_acts.empty()) {
        file.make_group("dialog");
        file.write_bytes("dialog/tags", {frames, IntervalRecord::kDialogActs}, record.dialog_acts);
    }
    write_meta(file, record);
    file.close();
    pending.commit();
}

IntervalRecord read_interval_file(const std::filesystem::path& path, const std::string& id,
                                  const std::string& speaker) {
    const RecordFile file(path);
    check_rate(file);
    IntervalRecord record;
    record.id = id;
    record.speaker = speaker;
    const std::string pose = "pose/data", face = "face/data";
    const std::size_t frames = file.rows_of(pose, kPose);
    record.pose = file.floats(pose, frames, kPose, pose);
    record.pose_normalized = file.floats("pose/normalize", frames, kPose, pose);
    record.pose_confidence = file.floats("pose/confidence", frames, kPose, pose);
    record.mel_400 = file.floats("audio/log_mel_400", Hdf5File::kAny, IntervalRecord::kMel400, pose);
    record.mel_512 = file.floats("audio/log_mel_512", Hdf5File::kAny, IntervalRecord::kMel512, pose);
    record.silence = read_silence(file, frames);
    record.vectors = file.floats("text/bert", frames, kWordVector, pose);
    record.tokens = file.ints("text/tokens", frames, pose);
    record.words = pats_words(file, path, record.tokens);
    if (file.has(face)) {
        record.face = file.floats(face, frames, kFace, pose);
        record.face_normalized = file.floats("face/normalize", frames, kFace, pose);
        record.face_confidence = file.floats("face/confidence", frames, kFace, pose);
    }
    if (file.has("dialog/tags"))
        record.dialog_acts = file.flags("dialog/tags", frames, IntervalRecord::kDialogActs, pose);
    if (file.has("meta/style")) {
        const std::vector<float> style = file.floats("meta/style", IntervalRecord::kStyle, 1, "meta/style");
        std::copy(style.begin(), style.end(), record.style.emplace().begin());
    }
    if (file.has("meta/phase")) record.phase = file.ints("meta/phase", frames, pose);
    check_record(record, path.string());
    return record;
}

}  // namespace chironomia
