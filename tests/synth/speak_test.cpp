#include "synth/speech/speak.h"

#include <gmock/gmock.h>

#include <cmath>
#include <future>
#include <vector>

#include "tests/support/support.h"

namespace chironomia {
namespace {

using testing::refusal_of;

double rms(const Audio& sound) {
    double sum = 0;
    for (const float sample : sound.samples) sum += static_cast<double>(sample) * sample;
    return std::sqrt(sum / static_cast<double>(sound.samples.size()));
}

TEST(Speak, SaysASentenceInAboutTheTimeAPersonNeeds) {
    const Audio sound = speak("Please choose the left video.", "en");
    EXPECT_EQ(sound.rate, 22050);
    EXPECT_EQ(sound.channels, 1);
    EXPECT_GT(sound.duration(), 1.2);
    EXPECT_LT(sound.duration(), 3);
    EXPECT_GT(rms(sound), 0.02);
}

TEST(Speak, SaysMoreInMoreTime) {
    EXPECT_GT(speak("Please choose the left video. Then go on.", "en").duration(),
              speak("Please choose the left video.", "en").duration() + 0.5);
}

// What is said before, and beside it, changes nothing.
TEST(Speak, SaysTheSameTextTheSameWayEveryTime) {
    const Audio first = speak("Attention : choisissez la vidéo de gauche.", "fr");
    speak("Something else.", "en");
    std::vector<std::future<Audio>> others;
    for (int i = 0; i < 3; ++i)
        others.push_back(std::async(
            std::launch::async, [] { return speak("Attention : choisissez la vidéo de gauche.", "fr"); }));
    for (auto& other : others) EXPECT_EQ(other.get().samples, first.samples);
}

TEST(Speak, KnowsLanguagesFromEachOther) {
    EXPECT_NE(speak("nation", "en").samples, speak("nation", "fr").samples);
    EXPECT_NE(speak("nation", "en-gb").samples, speak("nation", "en-us").samples);
    EXPECT_EQ(speak("nation", "en").samples, speak("nation", "en-gb").samples);
}

TEST(Speak, TakesATextForATextWhateverItLooksLike) {
    EXPECT_GT(speak("--help; $(ls) \"quoted\"", "en").duration(), 0.5);
}

TEST(Speak, RefusesALanguageThatNobodySpeaks) {
    EXPECT_EQ(refusal_of([] { speak("Hello", "xx"); }),
              "espeak-ng: no voice speaks \"xx\"; write a language such as en-gb, en-us, fr or de");
}

TEST(Speak, RefusesWhatIsNoSpeech) {
    for (const char* text : {"", "...", " "}) {
        EXPECT_EQ(refusal_of([&] { speak(text, "en"); }),
                  "espeak-ng: \"" + std::string(text) +
                      "\" cannot be spoken in \"en\"; write a sentence of that language");
    }
}

}  // namespace
}  // namespace chironomia
