// What a corpus holds: stretches of speech with what a face, a head or a body did, as models are trained on
// them. Docs: synth/corpus/README.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/manner.h"

namespace chironomia {

// A word in time. A silence within a unit is the pseudo-word "," (thesis section 4.1).
struct CorpusWord {
    std::string text;
    double start = 0;  // [s] from the beginning of the record
    double end = 0;    // [s] > start
};

inline constexpr std::size_t kWordVector = 768;  // numbers of BERT-base's vector of a word

// An inter-pausal unit of a talk: Fares 2023, chapter 4.1. The face has the action units 1, 2, 4, 5, 6, 7 and
// the head's turns about OpenFace's axes.
struct IpuRecord {
    static constexpr std::size_t kUnits = 6;
    static constexpr std::array<int, kUnits> kUnitNumbers{1, 2, 4, 5, 6, 7};
    static constexpr std::size_t kAngles = 3;   // pose_Rx, pose_Ry, pose_Rz
    static constexpr double kFps = 24;          // of face and head, as in TED's videos
    static constexpr double kSpeechRate = 100;  // of f0 and voice [Hz]
    static constexpr std::size_t kVoice = 4;    // jitter, shimmer [dB], HNR [dB], Hammarberg index [dB]

    std::string id;                     // of the file: "s03_0012"
    std::string speaker;                // "s03"
    std::string source;                 // the video or recording that it was cut from
    double start = 0;                   // in that source [s]
    double fps = kFps;                  // of face and head; no other is read or written
    std::vector<CorpusWord> words;      // (N) ascending, without gaps
    std::vector<float> vectors;         // (N, kWordVector)
    std::vector<float> f0;              // (S) [Hz], 50 to 550; bridged where it is not voiced
    std::vector<float> f0_strength;     // (S) in [0, 1]; under 0.3: bridged
    std::vector<float> voice;           // (S, kVoice)
    std::vector<float> units;           // (T, kUnits) in [0, 5]
    std::vector<float> head;            // (T, kAngles) [rad]
    std::vector<std::uint8_t> success;  // (T) 0: the frame was bridged
    std::vector<float> confidence;      // (T) in [0, 1]

    std::size_t frames() const { return success.size(); }  // T
};

// Who was recorded in a dyad, and what for.
struct DyadPerson {
    static constexpr std::size_t kFace = 10;  // gaze_angle_x, gaze_angle_y, pose_Rx, Ry, Rz, AU1, 2, 4, 6, 12
    static constexpr std::size_t kSpeech = 16;  // f0, loudness, voicing, MFCC 0 to 12

    std::string participant;
    std::string role;           // "expert", "novice"
    std::vector<float> face;    // (T, kFace) [rad], [0, 5]
    std::vector<float> speech;  // (T, kSpeech) as synth/features/speech_features.h gives them
};

// Two people in conversation, as NoXi has them: Woo, Fares, Pelachaud, Achard, "AMII", 2023, section 4.
struct DyadRecord {
    static constexpr double kFps = 25;

    std::string id;
    std::string language = "en";
    double fps = kFps;                 // no other is read or written
    std::array<DyadPerson, 2> people;  // equally long
    // Of a synthetic one: how closely and how late each follows the other's smiles.
    std::optional<double> kappa, tau;  // in [0, 0.8]; [s]

    std::size_t frames() const { return people[0].face.size() / DyadPerson::kFace; }  // T
};

// An interval of one speaker as PATS has it, with our extension by faces and dialog acts: Ahuja et al.,
// "Style Transfer for Co-Speech Gesture Animation", 2020; Fares 2023, chapter 4.2 and 4.3. x of all points
// stand before y of all points; places are relative to the neck, y down.
struct IntervalRecord {
    static constexpr double kFps = 15;
    static constexpr std::size_t kJoints = 52;
    static constexpr std::size_t kFacePoints = 70;
    static constexpr std::size_t kMel400 = 64, kMel512 = 128;
    static constexpr double kMel400Rate = 100;    // [rows/s] of sound at 16 kHz with the hop 160
    static constexpr double kMel512Rate = 86.13;  // of sound at 44.1 kHz with the hop 512; PATS counts 89
    static constexpr std::size_t kDialogActs = 38;
    static constexpr std::size_t kStyle = 12;

    std::string id;
    std::string speaker;
    std::vector<CorpusWord> words;
    std::vector<float> pose;                         // (T, 2 kJoints) [px]
    std::vector<float> pose_normalized;              // (T, 2 kJoints) shoulder widths made equal
    std::vector<float> pose_confidence;              // (T, 2 kJoints) in [0, 1]
    std::vector<float> mel_400;                      // (Ta, kMel400) at PATS's own rate
    std::vector<float> mel_512;                      // (Tb, kMel512) at PATS's own rate
    std::vector<std::uint8_t> silence;               // (T) 1: no speech
    std::vector<float> vectors;                      // (T, kWordVector) of the word at each frame
    std::vector<int> tokens;                         // (T) of BERT's vocabulary
    std::vector<float> face;                         // (T, 2 kFacePoints) [px]; empty: not known
    std::vector<float> face_normalized;              // alike
    std::vector<float> face_confidence;              // alike
    std::vector<std::uint8_t> dialog_acts;           // (T, kDialogActs) 0 or 1; empty: not known
    std::optional<std::array<float, kStyle>> style;  // of a synthetic speaker; no model may read it
    std::vector<int> phase;                          // (T) of a synthetic gesture; no model may read it

    std::size_t frames() const { return pose.size() / (2 * kJoints); }  // T
};

}  // namespace chironomia
