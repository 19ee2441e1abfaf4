// Beside a made corpus, the files that it would have been imported from: what a tracker, openSMILE, an
// aligner and a microphone would have written of its people.
//
//   recordings/tables.json    the job of `corpus import`, with voices as openSMILE's tables
//   recordings/sounds.json    the same, with voices as sound files
//   recordings/<name>/openface.csv, prosody.csv, voice.wav
//   recordings/<name>/egemaps.csv, words.TextGrid    of talks
// <name> is the id of a talk's unit, and "<id>_<participant>" of a dyad.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/audio.h"
#include "synth/corpus/corpus.h"
#include "synth/corpus/make/face.h"
#include "synth/features/feature_track.h"

namespace chironomia {

// What was tracked and heard of one person.
struct RecordedTables {
    const TrackedFace& face;     // as track_face() gives it
    std::span<const int> units;  // of the face
    double fps = 0;              // of the face
    const FeatureTrack& speech;  // as speech_features() gives it
    const Audio& sound;
};

// Writes OpenFace's table, openSMILE's table of prosody and the sound. Numbers have all their digits.
// `folder` is that of the corpus that is being made. Throw Error if they cannot be written.
void write_tables(const std::filesystem::path& folder, const std::string& name, const RecordedTables& tables);
// What else talks need: openSMILE's eGeMAPS of voice_quality(), and the words.
void write_talk_tables(const std::filesystem::path& folder, const std::string& name,
                       const FeatureTrack& quality, const std::vector<CorpusWord>& words);

// The two manifests, of talks or dyads.
void write_manifests(const CorpusIndex& index);

}  // namespace chironomia
