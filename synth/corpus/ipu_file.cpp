// An inter-pausal unit of a talk as an HDF5 file.
//
//   /            attributes: format "chironomia talk", version 1, id, speaker, source, start [s], fps_video
//   /words       (N) text; "," is a silence
//   /word_times  (N, 2) float64, start and end [s] from the beginning of the unit
//   /bert        (N, 768) float16, the word's vector of the corpus's text encoder
//   /f0          (S) float32 at 100 Hz [Hz], 50 to 550; bridged where it is not voiced
//   /f0_conf     (S) float32, strength of the pitch in [0, 1]; under 0.3: bridged
//   /vq          (S, 4) float32: jitter, shimmer [dB], HNR [dB], Hammarberg index [dB]
//   /au          (T, 6) float32 at fps_video: AU1, 2, 4, 5, 6, 7 in [0, 5]
//   /head        (T, 3) float32: pose_Rx, pose_Ry, pose_Rz of OpenFace [rad]
//   /success     (T) uint8, 0: the frame was bridged
//   /confidence  (T) float32 in [0, 1]
#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/record_checks.h"
#include "synth/corpus/record_file.h"
#include "synth/corpus/record_files.h"

namespace chironomia {
namespace {

constexpr auto kDeflated = Hdf5Writer::Packing::deflated;
constexpr auto kFloat16 = Hdf5Writer::Packing::float16;

}  // namespace

void write_ipu_file(const std::filesystem::path& path, const IpuRecord& record) {
    check_record(record, path.string());
    const std::size_t words = record.words.size(), samples = record.f0.size(), frames = record.frames();
    PendingOutput pending(path, PendingOutput::Kind::file);
    Hdf5Writer file(pending.path(), path.string());
    file.write_attribute("format", kIpuFormat);
    file.write_attribute("version", kRecordVersion);
    file.write_attribute("id", record.id);
    file.write_attribute("speaker", record.speaker);
    file.write_attribute("source", record.source);
    file.write_attribute("start", record.start);
    file.write_attribute("fps_video", record.fps);
    write_words(file, "words", "word_times", record.words);
    file.write_floats("bert", {words, kWordVector}, record.vectors, kFloat16);
    file.write_floats("f0", {samples}, record.f0, kDeflated);
    file.write_floats("f0_conf", {samples}, record.f0_strength, kDeflated);
    file.write_floats("vq", {samples, IpuRecord::kVoice}, record.voice, kDeflated);
    file.write_floats("au", {frames, IpuRecord::kUnits}, record.units, kDeflated);
    file.write_floats("head", {frames, IpuRecord::kAngles}, record.head, kDeflated);
    file.write_bytes("success", {frames}, record.success);
    file.write_floats("confidence", {frames}, record.confidence, kDeflated);
    file.close();
    pending.commit();
}

IpuRecord read_ipu_file(const std::filesystem::path& path) {
    const RecordFile file(path);
    check_format(file, kIpuFormat);
    IpuRecord record;
    record.id = file.text("", "id");
    record.speaker = file.text("", "speaker");
    record.source = file.text("", "source");
    record.start = file.number("", "start");
    record.fps = file.number("", "fps_video");
    record.words = file.words("words", "word_times");
    const std::size_t words = record.words.size();
    const std::size_t samples = file.rows_of("f0", 1), frames = file.rows_of("success", 1);
    record.vectors = file.floats("bert", words, kWordVector, "words");
    record.f0 = file.floats("f0", samples, 1, "f0");
    record.f0_strength = file.floats("f0_conf", samples, 1, "f0");
    record.voice = file.floats("vq", samples, IpuRecord::kVoice, "f0");
    record.units = file.floats("au", frames, IpuRecord::kUnits, "success");
    record.head = file.floats("head", frames, IpuRecord::kAngles, "success");
    record.success = file.flags("success", frames, 1, "success");
    record.confidence = file.floats("confidence", frames, 1, "success");
    check_record(record, path.string());
    return record;
}

}  // namespace chironomia
