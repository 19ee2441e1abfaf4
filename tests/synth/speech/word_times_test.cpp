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
// after the one before it, from 0 on.
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

// `alone`: how each word sounds alone.
Speech timed(const std::string& text, const std::string& events, const std::vector<std::string>& alone) {
    SpeakReply reply = reply_of(events);
    for (const std::string& phonemes : alone) {
        reply.alone.emplace_back();
        for (const std::string_view phoneme : split_words(phonemes)) reply.alone.back().emplace_back(phoneme);
    }
    Speech speech = time_words(script(text), reply, "en");
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
    const Speech speech = timed("one two", "_ @0 w ʌ n _ _ @4 t uː _", {"w ʌ n", "t uː"});
    expect_word(speech, 0, 0.1, 0.4, "w ʌ n");
    expect_word(speech, 1, 0.6, 0.8, "t uː");
    EXPECT_EQ(speech.phonemes[4].symbol, "_");
    EXPECT_NEAR(speech.phonemes[4].end - speech.phonemes[4].start, 0.2, 1e-9);
}

TEST(TimeWords, BeginsAPhonemeWithTheSilenceBeforeIt) {
    SpeakReply reply = reply_of("@0 a p a");
    for (std::size_t i = 70; i < 100; ++i) reply.samples[i] = 0;
    reply.alone = {{"a", "p", "a"}};
    const Speech speech = time_words(script("apa"), reply, "en");
    EXPECT_NEAR(speech.phonemes[0].end, 0.07, 1e-9);
    EXPECT_NEAR(speech.phonemes[1].start, 0.07, 1e-9);
}

TEST(TimeWords, BeginsAWordWhereTheVoiceDoes) {
    SpeakReply reply = reply_of("@0 a @2 b");
    reply.events[2].sample = 80;  // 20 ms before its phoneme
    reply.alone = {{"a"}, {"b"}};
    const Speech speech = time_words(script("a b"), reply, "en");
    expect_word(speech, 0, 0, 0.08, "a");
    expect_word(speech, 1, 0.08, 0.2, "b");
}

TEST(TimeWords, GivesAPhonemeThatIsReportedTooLateTheEndOfTheOneBefore) {
    SpeakReply reply = reply_of("@0 w ɛ l _ @5 l");
    reply.alone = {{"w", "ɛ", "l"}, {"l"}};
    reply.events[3].sample = 300;  // the l, when the pause begins
    const Speech speech = time_words(script("well, l"), reply, "en");
    expect_in_order(speech);
    EXPECT_NEAR(speech.phonemes[1].end, 0.234, 1e-9);
    expect_word(speech, 0, 0, 0.3, "w ɛ l");
    expect_word(speech, 1, 0.4, 0.5, "l");
}

TEST(TimeWords, JoinsLengthsAndTonesAndSkipsNamesOfLanguages) {
    const Speech speech = timed("one two", "@0 (fr) w uː ː ə- @4 t ʲ a: o1 (en)", {"w uː ə", "t a o"});
    EXPECT_EQ(phonemes_of(speech, 0), "w uːː ə");
    EXPECT_EQ(phonemes_of(speech, 1), "tʲ aː o");
}

TEST(TimeWords, KeepsWhatIsSaidOfOneWordTogether) {
    const Speech speech =
        timed("it is 7.5 (m)", "@0 a @3 b @6 c @7 d @7 e @11 f @0 g", {"a", "b", "c d e", "f g"});
    EXPECT_EQ(phonemes_of(speech, 2), "c d e");
    EXPECT_EQ(phonemes_of(speech, 3), "f g") << "the voice never speaks backwards";
}

TEST(TimeWords, GivesWhatIsWrittenAroundAWordToTheWordThatItTouches) {
    const Speech speech = timed("one :two : three", "@0 a @4 b @5 c @9 d @11 e @99 f", {"a", "b c d", "e f"});
    EXPECT_EQ(phonemes_of(speech, 0), "a");
    EXPECT_EQ(phonemes_of(speech, 1), "b c d");
    EXPECT_EQ(phonemes_of(speech, 2), "e f");
}

TEST(TimeWords, DealsOutThePhonemesOfWordsThatAreSpokenAsOne) {
    const Speech speech =
        timed("a from the dog", "@0 ə @2 f ɹ ʌ m ð ɪ @11 d ɔ ɡ", {"eɪ", "f ɹ ɒ m", "ð ə", "d ɔ ɡ"});
    expect_word(speech, 1, 0.1, 0.5, "f ɹ ʌ m");
    expect_word(speech, 2, 0.5, 0.7, "ð ɪ");
    const Speech first = timed("of the dog", "@7 ə v ð ə _ d ɔ ɡ", {"ɒ v", "ð ə", "d ɔ ɡ"});
    EXPECT_EQ(phonemes_of(first, 0), "ə v");
    EXPECT_EQ(phonemes_of(first, 1), "ð ə");
    EXPECT_EQ(phonemes_of(first, 2), "d ɔ ɡ");
}

TEST(TimeWords, DoesNotBelieveAWordThatSoundsOtherwiseAlone) {
    const Speech speech =
        timed("dogs' cats sat", "@0 d ɔ ɡ z @4 k æ t s @11 s æ t", {"d ɔ ɡ z", "k æ t s", "s æ t"});
    EXPECT_EQ(phonemes_of(speech, 0), "d ɔ ɡ z");
    EXPECT_EQ(phonemes_of(speech, 1), "k æ t s");
    EXPECT_EQ(phonemes_of(speech, 2), "s æ t");
    EXPECT_EQ(phonemes_of(timed("AB CDE x", "@0 a b c d @3 e @7 x", {"a b", "c d e", "x"}), 1), "c d e");
}

TEST(TimeWords, GivesALittleTimeToWordsThatAreNotSpoken) {
    const Speech speech = timed("- to + + b", "@2 a @9 b", {"", "t uː", "", "", "b iː"});
    expect_word(speech, 0, 0, 0.01, "");
    expect_word(speech, 1, 0.01, 0.08, "a");
    expect_word(speech, 2, 0.08, 0.09, "");
    expect_word(speech, 3, 0.09, 0.1, "");
    expect_word(speech, 4, 0.1, 0.2, "b");
    EXPECT_EQ(speech.words[2].first_phoneme, 1u);
}

TEST(TimeWords, RefusesAWordThatIsLeftWithoutTime) {
    std::vector<std::string> alone(11);
    alone[0] = "a";
    EXPECT_EQ(
        refusal_of([&] { timed("a - - - - - - - - - -", "@0 a", alone); }),
        "espeak-ng: \"-\" (word 2 of 11) is not spoken in \"en\", and \"a\" beside it is too short to share its "
        "100 ms; write it as it is spoken, or leave it out");
}

}  // namespace
}  // namespace chironomia
