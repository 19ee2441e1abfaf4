// The manifest that `chironomia corpus import` reads: which files belong to whom. Docs: docs/corpora.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"

namespace chironomia {

// Which shots of a video are good enough to learn from; what the thesis does not say is a key of the
// manifest.
struct ShotLimits {
    double least_seconds = 2;
    double least_success = 0.5;     // part of its frames in which a face was found
    double least_sure = 0.8;        // part of its frames that are as sure as `least_confidence`
    double least_confidence = 0.9;  // of a tracker, in [0, 1]
    double most_yaw_deg = 35;       // middle of the head's turns to a side, either way
    double most_pitch_deg = 30;     // of those up or down
    std::size_t least_words = 1;    // of a unit
};

// What was tracked and heard of one person. A voice is measured in the sound, or comes out of openSMILE.
struct RecordedPerson {
    std::filesystem::path face;    // OpenFace's table, or any other face that is read
    std::filesystem::path audio;   // empty: there are tables instead
    std::filesystem::path speech;  // of openSMILE: pitch, voicing, loudness, MFCC
    std::filesystem::path voice;   // of openSMILE: jitter, shimmer, HNR, Hammarberg index; talks alone
};

struct TalkRecording {
    std::string id;
    std::string speaker;
    RecordedPerson person;
    std::filesystem::path words;
    std::filesystem::path shots;  // of PySceneDetect; empty: one shot
    std::optional<Split> split;   // of all its units
};

struct DyadRecording {
    std::string id;
    std::string language = "en";
    std::array<std::string, 2> participants;
    std::array<std::string, 2> roles;
    std::array<RecordedPerson, 2> people;
    std::optional<Split> split;
};

struct ImportManifest {
    std::filesystem::path file;
    CorpusKind kind = CorpusKind::talks;  // or dyads
    ShotLimits limits;
    std::vector<TalkRecording> talks;
    std::vector<DyadRecording> dyads;
};

// Paths are relative to the manifest. Throws Error with file and key if something is missing, unknown, twice
// or out of range, if a file is not there, or if only some of the recordings have a split.
ImportManifest read_import_manifest(const std::filesystem::path& file);

}  // namespace chironomia
