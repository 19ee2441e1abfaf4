#include "synth/corpus/make/tables.h"

#include <algorithm>

#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "core/text.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordings = "recordings";

// A row of a matrix of `width` columns.
std::span<const float> row_of(std::span<const float> values, std::size_t width, std::size_t row) {
    return values.subspan(row * width, width);
}

// The cells of a row with the separator before each.
std::string cells(std::span<const float> row, char separator) {
    std::string text;
    for (const float value : row) text += format("{}{}", separator, value);
    return text;
}

// A tracker finds no unit weaker than 0 or stronger than 5.
std::vector<float> in_range(std::vector<float> units) {
    for (float& unit : units) unit = std::clamp(unit, 0.0f, 5.0f);
    return units;
}

std::string openface_table(const RecordedTables& tables) {
    const TrackedFace& face = tables.face;
    const std::vector<float> units = in_range(face.units);
    std::string text =
        "frame,face_id,timestamp,confidence,success,gaze_angle_x,gaze_angle_y,pose_Rx,pose_Ry,pose_Rz";
    for (const int unit : tables.units) text += format(",AU{:02}_r", unit);
    for (std::size_t t = 0; t < face.frames(); ++t) {
        text += format("\n{},0,{:.6f},{},{}", t + 1, static_cast<double>(t) / tables.fps, face.confidence[t],
                       face.success[t]);
        text += cells(row_of(face.gaze, TrackedFace::kGaze, t), ',');
        text += cells(row_of(face.head, TrackedFace::kHead, t), ',');
        text += cells(row_of(units, tables.units.size(), t), ',');
    }
    return text + "\n";
}

// A table of openSMILE with a name for each column of the track.
std::string opensmile_table(const FeatureTrack& track, const std::vector<std::string>& columns) {
    std::string text = "name;frameTime;" + join(columns, ";");
    for (std::size_t t = 0; t < track.frames(); ++t) {
        text += format("\n'unknown';{:.3f}", static_cast<double>(t) / track.rate);
        text += cells(row_of(track.values, track.width(), t), ';');
    }
    return text + "\n";
}

std::string interval_text(double start, double end, std::string_view text, std::size_t number) {
    std::string quoted;
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return format(
        "        intervals [{}]:\n            xmin = {}\n            xmax = {}\n            text = \"{}\"\n",
        number, start, end, quoted);
}

// Praat's long form, one tier without gaps; a silence is an interval without a text.
std::string text_grid(const std::vector<CorpusWord>& words) {
    std::string intervals;
    std::size_t count = 0;
    double time = 0;
    for (const CorpusWord& word : words) {
        const bool is_silence = word.text == ",";
        if (word.start > time) intervals += interval_text(time, word.start, "", ++count);
        intervals += interval_text(word.start, word.end, is_silence ? "" : word.text, ++count);
        time = word.end;
    }
    return format(
        "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = {0}\ntiers? "
        "<exists>\nsize = "
        "1\nitem []:\n    item [1]:\n        class = \"IntervalTier\"\n        name = \"words\"\n        "
        "xmin = "
        "0\n        xmax = {0}\n        intervals: size = {1}\n{2}",
        time, count, intervals);
}

std::vector<std::string> prosody_columns() {
    std::vector<std::string> columns = {"F0final_sma", "pcm_loudness_sma", "voicingFinalUnclipped_sma"};
    for (int i = 0; i < 13; ++i) columns.push_back(format("pcm_fftMag_mfcc[{}]", i));
    return columns;
}

// The voice of a recording, as sound or as tables.
void add_voice(Json& recording, const std::string& name, bool is_sound, bool is_talk) {
    recording["face"] = name + "/openface.csv";
    if (is_sound) {
        recording["audio"] = name + "/voice.wav";
        return;
    }
    recording["speech"] = name + "/prosody.csv";
    if (is_talk) recording["voice"] = name + "/egemaps.csv";
}

Json recording_of_talk(const CorpusEntry& entry, bool is_sound) {
    Json recording = {{"id", entry.id},
                      {"speaker", entry.speaker},
                      {"words", entry.id + "/words.TextGrid"},
                      {"split", name_of(entry.split)}};
    add_voice(recording, entry.id, is_sound, true);
    return recording;
}

Json recording_of_dyad(const CorpusEntry& entry, bool is_sound) {
    Json recording = {{"id", entry.id}, {"people", Json::array()}, {"split", name_of(entry.split)}};
    for (const std::string_view person : split(entry.speaker, '+')) {
        Json one = {{"participant", person}, {"role", recording["people"].empty() ? "expert" : "novice"}};
        add_voice(one, format("{}_{}", entry.id, person), is_sound, false);
        recording["people"].push_back(std::move(one));
    }
    return recording;
}

}  // namespace

void write_tables(const fs::path& folder, const std::string& name, const RecordedTables& tables) {
    const fs::path own = folder / kRecordings / name;
    write_text(own / "openface.csv", openface_table(tables));
    write_text(own / "prosody.csv", opensmile_table(tables.speech, prosody_columns()));
    write_wav(own / "voice.wav", tables.sound);
}

void write_talk_tables(const fs::path& folder, const std::string& name, const FeatureTrack& quality,
                       const std::vector<CorpusWord>& words) {
    const fs::path own = folder / kRecordings / name;
    write_text(own / "egemaps.csv", opensmile_table(quality, {"jitterLocal_sma3nz", "shimmerLocaldB_sma3nz",
                                                              "HNRdBACF_sma3nz", "hammarbergIndex_sma3"}));
    write_text(own / "words.TextGrid", text_grid(words));
}

void write_manifests(const CorpusIndex& index) {
    for (const bool is_sound : {false, true}) {
        Json manifest = {{"kind", name_of(index.kind)}, {"recordings", Json::array()}};
        for (const CorpusEntry& entry : index.entries) {
            manifest["recordings"].push_back(index.kind == CorpusKind::talks
                                                 ? recording_of_talk(entry, is_sound)
                                                 : recording_of_dyad(entry, is_sound));
        }
        write_json(index.folder / kRecordings / (is_sound ? "sounds.json" : "tables.json"), manifest);
    }
}

}  // namespace chironomia
