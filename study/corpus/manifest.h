// The manifest that `chironomia corpus import` reads: which files belong to whom. Docs: docs/corpora.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "synth/corpus/corpus.h"

namespace chironomia::study {

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

// How a recording is cut into intervals, and which of them are good enough; ours, each a key of the manifest.
struct IntervalLimits {
    double least_seconds = 4.5;      // of an interval: a model's window of 64 frames fits into it
    double most_seconds = 16;        // of its words; cuts speech without long silences into 10 s, as PATS
    double most_pause_seconds = 1;   // of a silence within an interval
    double most_edge_seconds = 0.3;  // of the silence before its first and behind its last word
    std::size_t least_words = 1;
    double least_seen = 0.5;         // part of the frames in which each point of the arms is seen
    double least_confidence = 0.05;  // of a point; below it the point is missing
    std::size_t median_frames = 3;   // odd; more would cut off the turning points of fast hands
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

struct IntervalRecording {
    std::string id;
    std::string speaker;
    std::string language = "en";
    std::filesystem::path pose;  // a folder of OpenPose, or any other body that is read
    std::optional<double> fps;   // of the pose, where its files do not say
    std::filesystem::path audio;
    std::filesystem::path words;
    std::optional<double> start, end;  // the part of the recording that is taken [s]
    std::optional<bool> face;          // needed, or left out; not set: taken where it is there
    std::optional<Split> split;        // of all its intervals
};

struct ImportManifest {
    std::filesystem::path file;
    CorpusKind kind = CorpusKind::talks;
    ShotLimits limits;  // of talks and dyads
    IntervalLimits interval_limits;
    std::vector<TalkRecording> talks;
    std::vector<DyadRecording> dyads;
    std::vector<IntervalRecording> intervals;
};

// Paths are relative to the manifest. Throws Error with file and key if something is missing, unknown, twice
// or out of range, if a file is not there, or if only some of the recordings have a split.
ImportManifest read_import_manifest(const std::filesystem::path& file);

}  // namespace chironomia::study
