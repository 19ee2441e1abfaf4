#include "synth/features/opensmile_csv.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "core/text.h"
#include "synth/features/speech_features.h"
#include "tests/support/support.h"

namespace chironomia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal_of;

// The cepstra "0.5" to "12.5".
std::string cepstra(const std::string& name, bool is_header) {
    std::string cells;
    for (int i = 0; i < 13; ++i) cells += is_header ? format(";{}[{}]", name, i) : format(";{}.5", i);
    return cells;
}

std::string prosody_table(const std::string& mfcc = "pcm_fftMag_mfcc") {
    std::string text =
        "name;frameTime;voicingFinalUnclipped_sma;F0final_sma;pcm_loudness_sma" + cepstra(mfcc, true) + "\n";
    for (const char* row : {"0.000000;0.1;0;0.25", "0.010000;0.9;121.5;0.5", "0.020000;0.8;122;0.75"})
        text += format("'unknown';{}{}\n", row, cepstra("", false));
    return text;
}

FeatureTrack parse(const std::string& text, OpenSmileSet set = OpenSmileSet::speech) {
    return parse_opensmile(text, "lld.csv", set);
}

std::string refusal(const std::string& text, OpenSmileSet set = OpenSmileSet::speech) {
    return refusal_of([&] { parse(text, set); });
}

// `text` with its first `from` made `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST(OpenSmile, GivesTheColumnsOfSpeechInTheirOrder) {
    const FeatureTrack track = parse(prosody_table());
    EXPECT_EQ(track.columns, speech_columns());
    EXPECT_DOUBLE_EQ(track.rate, 100);
    ASSERT_EQ(track.frames(), 3u);
    EXPECT_EQ(track.at(1)[0], 121.5f);
    EXPECT_EQ(track.at(1)[1], 0.5f);
    EXPECT_EQ(track.at(1)[2], 0.9f);
    EXPECT_EQ(track.at(2)[3], 0.5f);
    EXPECT_EQ(track.at(2)[15], 12.5f);
}

TEST(OpenSmile, KnowsTheNamesOfSeveralConfigurations) {
    std::string text = replaced(prosody_table("mfcc_sma"), "F0final_sma", "F0_sma");
    text = replaced(text, "pcm_loudness_sma", "audspec_lengthL1norm_sma");
    text = replaced(text, "voicingFinalUnclipped_sma", "voiceProb_sma");
    EXPECT_EQ(parse(text).values, parse(prosody_table()).values);
}

TEST(OpenSmile, GivesTheVoiceQualityOfEgemaps) {
    const std::string text =
        "name;frameTime;Loudness_sma3;hammarbergIndex_sma3;jitterLocal_sma3nz;shimmerLocaldB_sma3nz;HNRdBACF_"
        "sma3nz\n"
        "'a';0;1;20;0.01;0.3;12\n'a';0.01;1;21;0.02;0.4;13\n";
    const FeatureTrack track = parse(text, OpenSmileSet::voice);
    EXPECT_THAT(track.columns, ElementsAre("jitter", "shimmer", "hnr", "hammarberg"));
    EXPECT_THAT(track.values, ElementsAre(0.01f, 0.3f, 12, 20, 0.02f, 0.4f, 13, 21));
}

TEST(OpenSmile, ReadsAFile) {
    const testing::TemporaryFolder folder;
    write_text(folder / "a.csv", prosody_table());
    EXPECT_EQ(read_opensmile(folder / "a.csv", OpenSmileSet::speech).frames(), 3u);
    EXPECT_THAT(refusal_of([&] { read_opensmile(folder / "a.csv", OpenSmileSet::voice); }),
                HasSubstr("a.csv: none of the columns is jitter (jitterLocal_sma3nz)"));
}

TEST(OpenSmile, RefusesWhatIsMissingOrThereTwice) {
    EXPECT_EQ(
        refusal(replaced(prosody_table(), "F0final_sma", "x")),
        "lld.csv: none of the columns is f0 (F0final_sma or F0_sma or F0env_sma or F0final or F0env); choose a "
        "configuration that writes it");
    EXPECT_THAT(refusal(replaced(prosody_table(), "frameTime", "x")),
                HasSubstr("none of the columns is the time (frameTime or timestamp)"));
    EXPECT_EQ(refusal(replaced(prosody_table(), "pcm_loudness_sma", "F0final_sma")),
              "lld.csv: column \"F0final_sma\" is there twice; export it once");
}

TEST(OpenSmile, RefusesWhatIsNoNumber) {
    EXPECT_THAT(refusal(replaced(prosody_table(), "121.5", "high")),
                HasSubstr("lld.csv:3: column \"F0final_sma\": \"high\" is no number"));
    EXPECT_EQ(refusal(replaced(prosody_table(), "121.5", "nan")),
              "lld.csv:3: column \"F0final_sma\": \"nan\" is not finite; extract the features again");
    EXPECT_THAT(refusal(replaced(prosody_table(), ";121.5", "")), HasSubstr("lld.csv:3: 17 values"));
}

TEST(OpenSmile, RefusesTimesThatDoNotRiseEvenly) {
    EXPECT_EQ(refusal(replaced(prosody_table(), "0.010000", "0.015")),
              "lld.csv:3: the time is 0.015 s, even steps would have 0.01 s; export every frame");
    EXPECT_EQ(refusal(replaced(prosody_table(), "0.020000", "0")),
              "lld.csv: the first row is at 0 s, the last at 0 s; times must rise");
    EXPECT_EQ(refusal(replaced(replaced(prosody_table(), "0.000000", "0.4"), "0.020000", "0.42")),
              "lld.csv:2: the first row is at 0.4 s; it must be at 0, within half a step of 0.01 s");
    const std::string table = prosody_table();
    EXPECT_EQ(refusal(table.substr(0, table.find("'unknown';0.010000"))),
              "lld.csv: 1 row gives no rate; at least 2 are needed");
}

}  // namespace
}  // namespace chironomia
