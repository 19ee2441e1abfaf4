// Two people in conversation as an HDF5 file.
//
//   /            attributes: format "chironomia dyad", version 1, id, language, fps 25; of a synthetic one
//                kappa and tau [s], how closely and how late each follows the other's smiles
//   /A, /B       attributes: participant, role
//   /A/face      (T, 10) float32: gaze_angle_x, gaze_angle_y, pose_Rx, pose_Ry, pose_Rz of OpenFace [rad],
//                AU1, 2, 4, 6, 12 in [0, 5]
//   /A/speech    (T, 16) float32: f0 [Hz], loudness, voicing, MFCC 0 to 12 (synth/features/speech_features.h)
// /B alike, equally long.
#include "core/error.h"
#include "core/files/files.h"
#include "core/text.h"
#include "synth/corpus/record_checks.h"
#include "synth/corpus/record_files.h"

namespace chironomia {

void check_format(const RecordFile& file, std::string_view expected) {
    const std::string found = file.text("", "format");
    if (found != expected)
        file.hdf5().refuse(format("its format is \"{}\"; \"{}\" is expected", found, expected));
    if (const double version = file.number("", "version"); version != kRecordVersion) {
        file.hdf5().refuse(format("it has version {} of the format; this program reads version {}", version,
                                  kRecordVersion));
    }
}

void write_dyad_file(const std::filesystem::path& path, const DyadRecord& record) {
    check_record(record, path.string());
    const std::size_t frames = record.frames();
    PendingOutput pending(path, PendingOutput::Kind::file);
    Hdf5Writer file(pending.path(), path.string());
    file.write_attribute("format", kDyadFormat);
    file.write_attribute("version", kRecordVersion);
    file.write_attribute("id", record.id);
    file.write_attribute("language", record.language);
    file.write_attribute("fps", record.fps);
    if (record.kappa) file.write_attribute("kappa", *record.kappa);
    if (record.tau) file.write_attribute("tau", *record.tau);
    for (std::size_t p = 0; p < 2; ++p) {
        const DyadPerson& person = record.people[p];
        const std::string group = p == 0 ? "A" : "B";
        file.make_group(group);
        file.write_attribute("participant", person.participant, group);
        file.write_attribute("role", person.role, group);
        file.write_floats(group + "/face", {frames, DyadPerson::kFace}, person.face,
                          Hdf5Writer::Packing::deflated);
        file.write_floats(group + "/speech", {frames, DyadPerson::kSpeech}, person.speech,
                          Hdf5Writer::Packing::deflated);
    }
    file.close();
    pending.commit();
}

DyadRecord read_dyad_file(const std::filesystem::path& path) {
    const RecordFile file(path);
    check_format(file, kDyadFormat);
    DyadRecord record;
    record.id = file.text("", "id");
    record.language = file.text("", "language");
    record.fps = file.number("", "fps");
    record.kappa = file.hdf5().attribute("", "kappa");
    record.tau = file.hdf5().attribute("", "tau");
    const std::size_t frames = file.rows_of("A/face", DyadPerson::kFace);
    for (std::size_t p = 0; p < 2; ++p) {
        DyadPerson& person = record.people[p];
        const std::string group = p == 0 ? "A" : "B";
        person.participant = file.text(group, "participant");
        person.role = file.text(group, "role");
        person.face = file.floats(group + "/face", frames, DyadPerson::kFace, "A/face");
        person.speech = file.floats(group + "/speech", frames, DyadPerson::kSpeech, "A/face");
    }
    check_record(record, path.string());
    return record;
}

}  // namespace chironomia
