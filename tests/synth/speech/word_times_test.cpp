#include "synth/speech/word_times.h"

#include <gmock/gmock.h>

#include "tests/support/support.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

using testing::expect_in_order;
using testing::phonemes_of;
using testing::refusal_of;
using testing::script;

// A sound of 1000 samples a second; an event is "@12" for a word at character 12, or a phoneme, each 100 ms
// behind the one before it, from 0 on.
SpeakReply reply_of(const std::string& events) {
    SpeakReply reply{.outcome = SpeakReply::Outcome::spoken, .rate = 1000};
    std::size_t sample = 0;
    for (const std::string_view event : split_words(events)) {
        if (event.starts_with("@")) {
            reply.events.push_back(
                {.kind = SpeakEvent::Kind::word,
                 .sample = sample,
                 .position = static_cast<std::size_t>(parse_integer(event.substr(1)).value())});
            continue;
        }
        reply.events.push_back({.kind = SpeakEvent::Kind::phoneme,
                                .sample = sample,
                                .symbol = event == "_" ? "" : std::string(event)});
        sample += 100;
    }
    reply.samples.assign(sample, 1);
    return reply;
}

Speech timed(const std::string& text, const std::string& events) {
    Speech speech = time_words(script(text), reply_of(events), "en");
    expect_in_order(speech);
    return speech;
}

void expect_word(const Speech& speech, std::size_t word, double start, double end,
                 const std::string& phonemes) {
    EXPECT_NEAR(speech.words[word].start, start, 1e-9) << word;
    EXPECT_NEAR(speech.words[word].end, end, 1e-9) << word;
    EXPECT_EQ(phonemes_of(speech, word), phonemes) << word;
}

TEST(TimeWords, GivesEachWordItsPhonemesWithoutThePausesAroundThem) {
    const Speech speech = timed("one two", "_ @0 w ʌ n _ _ @4 t uː _");
    expect_word(speech, 0, 0.1, 0.4, "w ʌ n");
    expect_word(speech, 1, 0.6, 0.8, "t uː");
    EXPECT_EQ(speech.phonemes[4].symbol, "_");
    EXPECT_NEAR(speech.phonemes[4].end - speech.phonemes[4].start, 0.2, 1e-9);
}

TEST(TimeWords, BeginsAPhonemeWithTheSilenceBeforeIt) {
    SpeakReply reply = reply_of("@0 a p a");
    for (std::size_t i = 70; i < 100; ++i) reply.samples[i] = 0;
    const Speech speech = time_words(script("apa"), reply, "en");
    EXPECT_NEAR(speech.phonemes[0].end, 0.07, 1e-9);
    EXPECT_NEAR(speech.phonemes[1].start, 0.07, 1e-9);
}

TEST(TimeWords, BeginsAWordWhereTheVoiceDoes) {
    SpeakReply reply = reply_of("@0 a @2 b");
    reply.events[2].sample = 80;  // 20 ms before its phoneme
    const Speech speech = time_words(script("a b"), reply, "en");
    expect_word(speech, 0, 0, 0.08, "a");
    expect_word(speech, 1, 0.08, 0.2, "b");
}

TEST(TimeWords, JoinsLengthsAndTonesAndSkipsNamesOfLanguages) {
    const Speech speech = timed("one two", "@0 (fr) w uː ː ə- @4 t ʲ a: o1 (en)");
    EXPECT_EQ(phonemes_of(speech, 0), "w uːː ə");
    EXPECT_EQ(phonemes_of(speech, 1), "tʲ aː o");
}

TEST(TimeWords, KeepsWhatIsSaidOfOneWordTogether) {
    const Speech speech = timed("it is 7.5 (m)", "@0 a @3 b @6 c @7 d @7 e @11 f @0 g");
    EXPECT_EQ(phonemes_of(speech, 2), "c d e");
    EXPECT_EQ(phonemes_of(speech, 3), "f g") << "the voice never speaks backwards";
}

TEST(TimeWords, GivesWhatIsWrittenAroundAWordToTheWordThatItTouches) {
    const Speech speech = timed("one :two : three", "@0 a @4 b @5 c @9 d @11 e @99 f");
    EXPECT_EQ(phonemes_of(speech, 0), "a");
    EXPECT_EQ(phonemes_of(speech, 1), "b c d");
    EXPECT_EQ(phonemes_of(speech, 2), "e f");
}

TEST(TimeWords, SharesPhonemesOfWordsThatAreSpokenAsOneByTheirLetters) {
    const Speech speech = timed("a of the dog", "@0 a @2 ʌ v ð ə @9 d");
    expect_word(speech, 1, 0.1, 0.3, "ʌ v");
    expect_word(speech, 2, 0.3, 0.5, "ð ə");
    const Speech first = timed("of the dog", "@7 d ɒ ɡ z ə");
    EXPECT_EQ(phonemes_of(first, 0), "d");
    EXPECT_EQ(phonemes_of(first, 1), "ɒ ɡ");
    EXPECT_EQ(phonemes_of(first, 2), "z ə");
}

TEST(TimeWords, SharesTheTimeOfWordsThatHaveTooFewPhonemes) {
    const Speech speech = timed("to a b", "@0 a @5 b");
    expect_word(speech, 0, 0, 0.2 / 3, "a");
    expect_word(speech, 1, 0.2 / 3, 0.1, "");
    expect_word(speech, 2, 0.1, 0.2, "b");
}

TEST(TimeWords, RefusesAWordThatIsLeftWithoutTime) {
    EXPECT_EQ(
        refusal_of([] { timed("incomprehensible x", "@0 a"); }),
        "espeak-ng: \"x\" (word 2 of 2) gets 6 ms of the sound in \"en\", and a word needs 10; write it "
        "as it is spoken, or leave it out");
}

}  // namespace
}  // namespace chironomia
