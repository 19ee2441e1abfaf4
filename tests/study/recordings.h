// Recordings of people who were never there: what a tracker, a microphone and a recogniser would have
// written, with numbers that follow from the time.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "core/files/files.h"
#include "core/files/wav_file.h"
#include "core/text.h"
#include "tests/synth/features/sounds.h"

namespace chironomia::testing {

// A face whose numbers rise evenly, so that neither smoothing nor another rate changes them: AU01 is
// 0.1 / s * t, AU02 the double, and so on in the order of kUnits; the head turns by 0.01, 0.02, 0.03 rad/s,
// the gaze by 0.004 and 0.006.
struct FaceSpec {
    double fps = 30;
    double seconds = 6;
    int first_lost = 0, end_lost = 0;  // frames without a face, whose numbers are nonsense
    double confidence = 0.98;
    std::string without{};  // a column that is left out
    int first_row = 0;      // rows before it are not in the file
};

inline constexpr int kUnits[] = {1, 2, 4, 5, 6, 7, 12};

inline void write_openface(const std::filesystem::path& file, const FaceSpec& spec) {
    std::vector<std::pair<std::string, double>> columns = {{"pose_Rx", 0.01},
                                                           {"pose_Ry", 0.02},
                                                           {"pose_Rz", 0.03},
                                                           {"gaze_angle_x", 0.004},
                                                           {"gaze_angle_y", 0.006}};
    double slope = 0;
    for (const int unit : kUnits) columns.emplace_back(format("AU{:02}_r", unit), slope += 0.1);
    std::erase_if(columns, [&](const auto& column) {
        return column.first.find(spec.without) == 0 && !spec.without.empty();
    });
    std::string text = "frame, timestamp, confidence, success";
    for (const auto& [name, rise] : columns) text += ", " + name;
    for (int row = spec.first_row; row < std::lround(spec.seconds * spec.fps); ++row) {
        const bool lost = row >= spec.first_lost && row < spec.end_lost;
        const double time = row / spec.fps;
        text += format("\n{}, {:.3f}, {}, {}", row + 1, time, lost ? 0.1 : spec.confidence, lost ? 0 : 1);
        for (const auto& [name, rise] : columns) text += format(", {}", lost ? 0 : rise * time);
    }
    write_text(file, text + "\n");
}

// A voice of 120 Hz, or of another pitch.
inline void write_voice(const std::filesystem::path& file, double seconds = 6, double pitch = 120) {
    write_wav(file, voice_like(pitch, 16000, seconds));
}

// "well , done" from 0.5 to 1.5 s with a short silence, and "again" from 2.5 to 3 s.
inline void write_timed_words(const std::filesystem::path& file) {
    write_text(file, "start,end,word\n0.5,1.0,well\n1.1,1.5,done\n2.5,3.0,again\n");
}

// openSMILE's tables of prosody with cepstra and of eGeMAPS, 100 rows a second.
inline void write_opensmile(const std::filesystem::path& speech, const std::filesystem::path& voice,
                            double seconds = 6, double step = 0.01) {
    std::string prosody = "name;frameTime;F0final_sma;voicingFinalUnclipped_sma;pcm_loudness_sma";
    for (int i = 0; i < 13; ++i) prosody += format(";pcm_fftMag_mfcc[{}]", i);
    std::string quality =
        "name;frameTime;jitterLocal_sma3nz;shimmerLocaldB_sma3nz;HNRdBACF_sma3nz;hammarbergIndex_sma3";
    for (int row = 0; row < std::lround(seconds / step); ++row) {
        prosody += format("\n'a';{:.3f};{};0.9;0.5", row * step, row % 10 == 0 ? 0 : 150);
        for (int i = 0; i < 13; ++i) prosody += format(";{}", i);
        quality += format("\n'a';{:.3f};0.01;0.2;15;20", row * step);
    }
    write_text(speech, prosody + "\n");
    write_text(voice, quality + "\n");
}

}  // namespace chironomia::testing
