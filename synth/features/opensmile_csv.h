// The tables that openSMILE writes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "synth/features/feature_track.h"

namespace chironomia {

enum class OpenSmileSet {
    speech,  // the columns of speech_columns(), under any of the names that openSMILE's configurations use
    voice,   // those of voice_quality() out of eGeMAPS
};

// The columns of a set in the order and under the names of speech_features.h, from a table whose cells are
// separated by ";" or ",", with a column "frameTime" or "timestamp" [s] whose times rise evenly from within
// half a step of 0. The values are as openSMILE has them. Of several names that a column goes by, the first
// that is there is read, with or without "_sma":
//   f0          F0final_sma, F0_sma, F0env_sma
//   loudness    pcm_loudness_sma, audspec_lengthL1norm_sma, Loudness_sma3
//   voicing     voicingFinalUnclipped_sma, voiceProb_sma
//   mfcc_N      pcm_fftMag_mfcc[N], pcm_fftMag_mfcc_sma[N], mfcc_sma[N]
//   jitter      jitterLocal_sma3nz
//   shimmer     shimmerLocaldB_sma3nz
//   hnr         HNRdBACF_sma3nz
//   hammarberg  hammarbergIndex_sma3
// Throws Error, with line and column, for a column that is missing or there twice, a value that is no finite
// number, times that do not rise evenly, or fewer than two rows.
FeatureTrack parse_opensmile(std::string_view text, const std::string& where, OpenSmileSet set);
FeatureTrack read_opensmile(const std::filesystem::path& file, OpenSmileSet set);

}  // namespace chironomia
