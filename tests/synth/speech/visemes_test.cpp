#include "synth/speech/visemes.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "synth/speech/mouth_shapes.h"
#include "synth/speech/speak.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

using testing::script;

constexpr double kFps = 100;

float at(const FaceTrack& track, int unit, std::size_t frame) {
    for (std::size_t c = 0; c < track.channels.size(); ++c)
        if (track.channels[c].unit == unit) return track.intensities[frame * track.channels.size() + c];
    ADD_FAILURE() << "no AU" << unit;
    return 0;
}

std::size_t frame_at(double time, double fps = kFps) {
    return static_cast<std::size_t>(std::lround(time * fps));
}

// The frame of [start, end] in which a unit is strongest.
std::size_t peak_of(const FaceTrack& track, int unit, double start, double end) {
    std::size_t peak = frame_at(start);
    for (std::size_t t = peak; t <= frame_at(end); ++t)
        if (at(track, unit, t) > at(track, unit, peak)) peak = t;
    return peak;
}

// Phonemes of 100 ms each, from `start` on, then a second of silence; a steady noise is heard with them.
Speech speech_of(const std::string& phonemes, double start = 0, double length = 0.1) {
    Speech speech{.audio = {.rate = 1000, .channels = 1}};
    double time = start;
    for (const std::string_view symbol : split_words(phonemes)) {
        speech.phonemes.push_back({.symbol = std::string(symbol), .start = time, .end = time + length});
        time += length;
    }
    speech.audio.samples.assign(static_cast<std::size_t>(1000 * (time + 1)), 0);
    for (auto i = static_cast<std::size_t>(1000 * start); i < static_cast<std::size_t>(1000 * time); ++i)
        speech.audio.samples[i] = i % 2 == 0 ? 0.1f : -0.1f;
    return speech;
}

FaceTrack mouth_of(const Speech& speech, double fps = kFps) {
    return shape_mouth(speech, static_cast<std::size_t>(speech.audio.duration() * fps), fps);
}

TEST(ShapeMouth, GivesKnownUnitsWithinTheirRange) {
    const FaceTrack track = mouth_of(speech_of("h ə l oʊ tʃ w uː f ɪ ʃ θ ɚ m ɑ̃ ʒ ʁ y pf ɔø ç ?"));
    EXPECT_TRUE(track.head.empty());
    EXPECT_TRUE(track.gaze.empty());
    for (const FaceChannel& channel : track.channels) {
        EXPECT_THAT(known_action_units(), ::testing::Contains(channel.unit));
        EXPECT_EQ(std::count(track.channels.begin(), track.channels.end(), channel), 1);
    }
    for (const float intensity : track.intensities) {
        EXPECT_GE(intensity, 0);
        EXPECT_LE(intensity, 5);
    }
}

TEST(ShapeMouth, ShutsTheLipsWhileTheyStopTheBreath) {
    const FaceTrack track = mouth_of(speech_of("a p a b a m a"));
    for (const double closure : {0.1, 0.3, 0.5}) {
        const double end = closure + (closure == 0.5 ? 0.1 : 0.07);
        for (std::size_t t = frame_at(closure); t <= frame_at(end); ++t) {
            EXPECT_EQ(at(track, 25, t), 0) << t;
            EXPECT_EQ(at(track, 26, t), 0) << t;
            EXPECT_GT(at(track, 24, t), 1) << t;
        }
    }
    for (const double vowel : {0.05, 0.25, 0.45, 0.65}) {
        EXPECT_GT(at(track, 26, frame_at(vowel)), 1.8) << vowel;
        EXPECT_EQ(at(track, 24, frame_at(vowel)), 0) << vowel;
    }
}

// However short the stop and however slow the film, the lips are seen to meet.
TEST(ShapeMouth, ShutsTheLipsInOneFrameAtLeast) {
    for (const double fps : {12.0, 24.0, 25.0, 30.0}) {
        for (double start = 1; start < 1.1; start += 0.007) {
            Speech speech = speech_of("a b a", start);
            speech.phonemes[1].end = speech.phonemes[2].start = speech.phonemes[1].start + 0.02;
            const FaceTrack track = mouth_of(speech, fps);
            std::size_t shut = 0;
            for (std::size_t t = frame_at(start + 0.06, fps); t <= frame_at(start + 0.16, fps); ++t)
                if (at(track, 25, t) == 0 && at(track, 24, t) > 0) ++shut;
            EXPECT_GE(shut, 1u) << fps << " fps from " << start;
        }
    }
}

TEST(ShapeMouth, IsStillInPauses) {
    Speech speech = speech_of("a _ _ _ _ _ u", 0.5);
    const FaceTrack track = mouth_of(speech);
    for (std::size_t t = 0; t < frame_at(speech.audio.duration()); ++t) {
        const double time = static_cast<double>(t) / kFps;
        const double distance = std::min(std::max(0.5 - time, time - 0.6), std::max(1.1 - time, time - 1.2));
        if (distance < 0.121) continue;
        for (const FaceChannel& channel : track.channels)
            EXPECT_EQ(at(track, channel.unit, t), 0) << to_text(channel) << " at " << time;
    }
    EXPECT_GT(at(track, 26, frame_at(0.55)), 1.8);
    EXPECT_GT(at(track, 18, frame_at(1.15)), 2);
}

TEST(ShapeMouth, MovesWithWhatIsHeard) {
    const FaceTrack early = mouth_of(speech_of("p a ʃ u f i", 0.5));
    const FaceTrack late = mouth_of(speech_of("p a ʃ u f i", 0.7));
    const std::size_t shift = frame_at(0.2) * early.channels.size();
    ASSERT_EQ(late.intensities.size(), early.intensities.size() + shift);
    for (std::size_t i = 0; i < early.intensities.size(); ++i)
        EXPECT_NEAR(late.intensities[i + shift], early.intensities[i], 1e-5) << i;
    EXPECT_NEAR(static_cast<double>(peak_of(early, 26, 0.4, 1.2)), 100 * 0.65, 2);
    EXPECT_NEAR(static_cast<double>(peak_of(early, 18, 0.4, 1.2)), 100 * 0.85, 2);
    EXPECT_NEAR(static_cast<double>(peak_of(early, 28, 0.4, 1.2)), 100 * 0.95, 2);
}

TEST(ShapeMouth, RoundsTheLipsBeforeARoundedVowel) {
    const FaceTrack round = mouth_of(speech_of("s t u")), spread = mouth_of(speech_of("s t i"));
    EXPECT_GT(at(round, 18, frame_at(0.08)), at(spread, 18, frame_at(0.08)) + 0.3);
    EXPECT_GT(at(round, 18, frame_at(0.15)), 1.2);
    EXPECT_GT(at(spread, 20, frame_at(0.15)), at(round, 20, frame_at(0.15)) + 0.5);
}

TEST(ShapeMouth, KnowsNasalVowelsHoweverTheirTildeIsWritten) {
    for (const char* const vowel : {"a", "e", "i", "o", "u"})
        EXPECT_EQ(mouth_of(speech_of("b " + std::string(vowel) + "\u0303")).intensities,
                  mouth_of(speech_of("b " + std::string(vowel))).intensities);
    EXPECT_EQ(mouth_of(speech_of("b ã ẽ ĩ õ ũ")).intensities, mouth_of(speech_of("b a e i o u")).intensities);
}

TEST(ShapeMouth, GoesThroughADiphthong) {
    const FaceTrack track = mouth_of(speech_of("aʊ", 0, 0.3));
    EXPECT_LT(peak_of(track, 26, 0, 0.3), frame_at(0.18));
    EXPECT_GT(peak_of(track, 18, 0, 0.3), frame_at(0.18));
}

TEST(ShapeMouth, OpensWiderForWhatIsLouder) {
    Speech speech = speech_of("a t a t a");
    const float steady = at(mouth_of(speech), 26, frame_at(0.25));
    for (std::size_t i = 200; i < 300; ++i) speech.audio.samples[i] *= 2;  // by 6 dB
    const float louder = at(mouth_of(speech), 26, frame_at(0.25));
    EXPECT_GT(louder, 1.08 * steady);
    EXPECT_LT(louder, 1.13 * steady);
    for (std::size_t i = 200; i < 300; ++i) speech.audio.samples[i] *= 0.01f;
    const float softest = at(mouth_of(speech), 26, frame_at(0.25));
    EXPECT_GT(softest, 0.7 * steady);
    EXPECT_LT(softest, 0.85 * steady);
}

TEST(ShapeMouth, KnowsEveryPhonemeOfTheVoices) {
    const MouthShape other = shapes_of("?")[0];
    for (const auto& [language, text] :
         {std::pair{"en-us",
                    "The quick brown fox jumps over the lazy dog, which measures the joy of thirsty "
                    "church boys, rather poor there. Yes, a ring, a hut, a bird and the law."},
          std::pair{"en-gb", "Here are the poor boys; there a bird heard the wrong thing. Go home now."},
          std::pair{"fr",
                    "Un bon vin blanc, la peur du jeune cygne à Montréal, huit oiseaux, fille, rouge, chat."},
          std::pair{"de",
                    "Zwölf Boxkämpfer jagen Viktor quer über den großen Sylter Deich, ich heute auch, "
                    "Pfeffer, Häuser, Ding."}}) {
        for (const SpokenPhoneme& phoneme : speak(script(text), {.language = language}).phonemes) {
            if (phoneme.symbol == "_") continue;
            for (const MouthShape& shape : shapes_of(phoneme.symbol))
                EXPECT_FALSE(shape.wanted == other.wanted && shape.opening == other.opening)
                    << phoneme.symbol << " of " << language;
        }
    }
}

// In a real sentence lips are shut in every closure, and the jaw is widest within the open vowels.
TEST(ShapeMouth, FollowsAVoice) {
    const Speech speech = speak(script("Papa, a baby happily jumped about the maple, and mama began."), {});
    const FaceTrack track = mouth_of(speech);
    int stops = 0, vowels = 0;
    std::string symbols;
    for (const SpokenPhoneme& phoneme : speech.phonemes) {
        symbols += phoneme.symbol + " ";
        if (phoneme.symbol == "p" || phoneme.symbol == "b" || phoneme.symbol == "m") {
            const double middle = phoneme.start + (phoneme.end - phoneme.start) / 3;
            EXPECT_EQ(at(track, 25, frame_at(middle)), 0) << phoneme.symbol << phoneme.start;
            ++stops;
        }
        if (phoneme.symbol != "ɑː" && phoneme.symbol != "æ") continue;
        const auto peak =
            static_cast<double>(peak_of(track, 26, std::max(0.0, phoneme.start - 0.1), phoneme.end + 0.1)) /
            kFps;
        EXPECT_GT(peak, phoneme.start - 0.02) << phoneme.start;
        EXPECT_LT(peak, phoneme.end + 0.02) << phoneme.start;
        EXPECT_GT(at(track, 26, frame_at(peak)), 1.3) << phoneme.start;
        ++vowels;
    }
    EXPECT_GE(stops, 12) << symbols;
    EXPECT_GE(vowels, 4) << symbols;
}

TEST(ShapeMouth, FollowsTheLoudnessWithoutPhonemes) {
    Speech speech{.audio = {.rate = 1000, .channels = 1, .samples = std::vector<float>(2000)}};
    for (std::size_t i = 500; i < 900; ++i) speech.audio.samples[i] = i % 2 == 0 ? 0.3f : -0.3f;
    const FaceTrack track = mouth_of(speech);
    EXPECT_EQ(at(track, 26, frame_at(0.4)), 0);
    EXPECT_NEAR(at(track, 26, frame_at(0.7)), 1.6, 0.01);
    EXPECT_EQ(at(track, 26, frame_at(1)), 0);
    speech.audio.samples.assign(2000, 0);
    for (const float intensity : mouth_of(speech).intensities) EXPECT_EQ(intensity, 0);
}

TEST(ShapeMouth, HasAsManyFramesAsAreAskedFor) {
    EXPECT_TRUE(shape_mouth(speech_of("a"), 0, 25).intensities.empty());
    const FaceTrack track = shape_mouth(speech_of("a"), 1000, 25);
    EXPECT_EQ(track.intensities.size(), 1000 * track.channels.size());
    EXPECT_EQ(track.intensities.back(), 0);
}

}  // namespace
}  // namespace chironomia
