#include "synth/speech/speak.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <exception>
#include <future>
#include <vector>

#include "core/files/files.h"
#include "core/random.h"
#include "tests/support/sanitizers.h"
#include "tests/support/support.h"
#include "tests/synth/speech/speech_support.h"

namespace chironomia {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;
using testing::Environment;
using testing::expect_in_order;
using ::testing::HasSubstr;
using testing::part_of;
using testing::phonemes_of;
using testing::refusal_of;
using testing::rms;
using testing::script;
using testing::texts_of;

Speech say(const std::string& text, const Voice& voice = {}) {
    return speak(script(text), voice);
}

Speech say_ssml(const std::string& inside, const Voice& voice = {}) {
    return speak(script("<speak>" + inside + "</speak>", true), voice);
}

double length_of(const SpokenWord& word) {
    return word.end - word.start;
}

// Of a voice, by the strongest autocorrelation between 60 and 400 Hz.
double pitch_of(std::span<const float> sound, double rate) {
    double best = 0;
    std::size_t best_lag = 1;
    for (auto lag = static_cast<std::size_t>(rate / 400); lag < static_cast<std::size_t>(rate / 60); ++lag) {
        double sum = 0;
        for (std::size_t i = 0; i + lag < sound.size(); ++i) sum += sound[i] * sound[i + lag];
        if (sum > best) {
            best = sum;
            best_lag = lag;
        }
    }
    return rate / static_cast<double>(best_lag);
}

double pitch_of(const Speech& speech, std::size_t word) {
    return pitch_of(part_of(speech.audio, speech.words[word].start, speech.words[word].end),
                    speech.audio.rate);
}

TEST(Speak, SaysASentenceInAboutTheTimeAPersonNeeds) {
    const Audio sound = speak("Please choose the left video.", "en");
    EXPECT_EQ(sound.rate, 22050);
    EXPECT_EQ(sound.channels, 1);
    EXPECT_GT(sound.duration(), 1.2);
    EXPECT_LT(sound.duration(), 3);
    EXPECT_GT(rms(sound.samples), 0.02);
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

TEST(Speak, RefusesLettersThatTheVoiceSpellsByTheirNamesInEnglish) {
    EXPECT_EQ(
        refusal_of([] { speak("左をえらぶ", "ja"); }),
        "espeak-ng: the voice of \"ja\" cannot read \"左をえらぶ\"; give the language of these letters (--language; of "
        "Chinese zh for Mandarin, or yue), write it in letters that the voice reads, such as kana for Japanese, or "
        "record it");
    EXPECT_THAT(refusal_of([] { speak("Choose 左.", "en"); }), HasSubstr("\"en\" cannot read \"左\""));
    EXPECT_THAT(refusal_of([] { speak("Wählen Sie 左.", "de"); }), HasSubstr("\"de\" cannot read \"左\""));
    EXPECT_THAT(refusal_of([] { speak("Wählen Sie Привет.", "de"); }),
                HasSubstr("\"de\" cannot read \"Привет\""));
    EXPECT_THAT(refusal_of([] { say("左をえらぶ。", {.language = "ja"}); }),
                HasSubstr("\"ja\" cannot read \"左をえらぶ\""));
}

TEST(Speak, RefusesLettersThatTheVoiceSpellsInItsOwnLanguage) {
    for (const char* text : {"صباح الخير", "Доброе утро", "Καλημέρα", "בוקר טוב", "おはよう", "สวัสดี"})
        EXPECT_THAT(refusal_of([&] { say(text); }), HasSubstr("\"en-us\" cannot read \"")) << text;
    EXPECT_THAT(refusal_of([] { say("おはよう", {.language = "es"}); }), HasSubstr("\"es\" cannot read"));
    EXPECT_THAT(refusal_of([] { say("Καλημέρα", {.language = "hr"}); }), HasSubstr("\"hr\" cannot read"));
    EXPECT_GT(say("नमस्ते").audio.duration(), 0.3) << "it leaves Hindi to another voice";
    EXPECT_GT(say("The word мир means peace and world.").audio.duration(), 0.5) << "a foreign word";
    EXPECT_GT(speak("The number π is 3.14.", "en").duration(), 0.5) << "a symbol";
}

// Half of this sentence is kana, as of any in Japanese.
TEST(Speak, RefusesKanjiHoweverFewTheyAre) {
    EXPECT_THAT(
        refusal_of([] { say("みなさん、こんにちは。きょうは、左をえらびます。", {.language = "ja"}); }),
        HasSubstr("\"ja\" cannot read \"左をえらびます\""));
    EXPECT_THAT(refusal_of([] { say_ssml("<s xml:lang=\"ja-JP\">きょうは、左をえらびます。</s>"); }),
                HasSubstr("\"ja\" cannot read \"左をえらびます\""));
    EXPECT_GT(say("みなさん、こんにちは。", {.language = "ja"}).audio.duration(), 0.5);
    EXPECT_GT(say("The sign 左 stands on the left side.").audio.duration(), 0.5) << "a foreign word";
}

TEST(Speak, ReadsTheScriptsOfItsLanguages) {
    EXPECT_GT(speak("ひだりをえらんでください。", "ja").duration(), 0.5);
    EXPECT_GT(speak("請選左邊", "yue").duration(), 0.5);
    EXPECT_GT(speak("請選左邊", "zh-yue").duration(), 0.5);
    EXPECT_GT(speak("早上好，请选左边。", "zh").duration(), 0.5);
    EXPECT_GT(speak("早上好，请选左边。", "cmn-latn-pinyin").duration(), 0.5);
    EXPECT_GT(speak("Здраво", "sr").duration(), 0.3);
    EXPECT_GT(speak("اختر اليسار، من فضلك", "ar").duration(), 0.5);
    EXPECT_GT(speak("Выберите «левое» видео — A.", "ru").duration(), 0.5);
    EXPECT_GT(speak("Ελλάδα und Übrigens", "de").duration(), 0.5);
    EXPECT_GT(say_ssml("Say <voice xml:lang=\"yue\">左</voice>.").audio.duration(), 0.5);
}

TEST(Speak, TakesATextForATextWhateverItLooksLike) {
    EXPECT_GT(speak("--help; $(ls) \"quoted\"", "en").duration(), 0.5);
}

TEST(Speak, GivesThePhonemesOfEveryWordAndTheirStress) {
    const Speech speech = say("Hello, the seven dogs remember.");
    expect_in_order(speech);
    EXPECT_EQ(speech.language, "en-us");
    EXPECT_THAT(texts_of(speech), ElementsAre("Hello", "the", "seven", "dogs", "remember"));
    EXPECT_EQ(phonemes_of(speech, 0), "h ə l 'oʊ");
    EXPECT_EQ(phonemes_of(speech, 1), "ð ə");
    EXPECT_EQ(phonemes_of(speech, 2), "s 'ɛ v ə n");
    EXPECT_EQ(phonemes_of(speech, 3), "d 'ɑː ɡ z");
    EXPECT_EQ(phonemes_of(speech, 4), "ɹ ᵻ m 'ɛ m b ɚ");
    EXPECT_EQ(phonemes_of(say("The world is well."), 1), "w 'ɜː l d");
    EXPECT_EQ(phonemes_of(say("The world is well."), 3), "w 'ɛ l");
}

TEST(Speak, SaysTheSameSoundWithAndWithoutWords) {
    EXPECT_EQ(say("Hello, the dogs.", {.rate = 175}).audio.samples,
              speak("Hello, the dogs.", "en-us").samples);
}

TEST(Speak, GivesPausesThatAreSilentAndWordsThatAreNot) {
    const Speech speech = say("Papa, a cup of tea. Good night!");
    for (const SpokenPhoneme& phoneme : speech.phonemes) {
        const double level = rms(part_of(speech.audio, phoneme.start, phoneme.end));
        if (phoneme.symbol == "_") {
            EXPECT_EQ(level, 0) << phoneme.start;
        } else {
            EXPECT_GT(level, 0.003) << phoneme.symbol << " at " << phoneme.start;
        }
    }
    EXPECT_GT(speech.words[1].start, speech.words[0].end + 0.1);
    EXPECT_EQ(speech.phonemes.back().symbol, "_");
    EXPECT_EQ(speech.phonemes.back().end, speech.audio.duration());
}

// The closure of a stop is a part of it: its sound begins in silence.
TEST(Speak, BeginsAStopWithItsClosure) {
    const Speech speech = say("Happy.");
    const SpokenPhoneme& stop = speech.phonemes[2];
    EXPECT_EQ(stop.symbol, "p");
    EXPECT_EQ(rms(part_of(speech.audio, stop.start, stop.start + 0.03)), 0);
    EXPECT_GT(rms(part_of(speech.audio, stop.start - 0.02, stop.start)), 0.001);
}

TEST(Speak, FindsEveryWordWhateverIsWrittenAroundIt) {
    const std::string text =
        "He said “don’t go”… and left\tat\n3:45pm (see p. 5-7) [note] e.g. his "
        "mother-in-law's $7.50, or 1,234,567 of the 3rd U.S. NASA's 1990s dogs' 'quote'.";
    const Speech speech = say(text);
    expect_in_order(speech);
    ASSERT_EQ(speech.words.size(), script(text).words.size());
    const auto word = [&](const std::string& wanted) {
        for (std::size_t i = 0; i < speech.words.size(); ++i)
            if (speech.words[i].text == wanted) return phonemes_of(speech, i);
        return std::string("no such word");
    };
    EXPECT_EQ(word("$7.50"), "d 'ɑː l ɚ s 'ɛ v ə n p ɔɪ n t f 'aɪ v z 'iə ɹ oʊ");
    EXPECT_EQ(word("NASA's"), "n 'æ s ɐ");
    EXPECT_THAT(word("1990s"), HasSubstr("n 'aɪ n t"));
    EXPECT_THAT(word("mother-in-law's"), HasSubstr("l"));
    EXPECT_EQ(word("of"), "ʌ v");
    EXPECT_EQ(word("the"), "ð ə");
    EXPECT_EQ(word("3rd"), "θ 'ɜː d");
    EXPECT_EQ(word("dogs'"), "d 'ɑː ɡ z");
    EXPECT_EQ(word("'quote'"), "k w 'oʊ t");
}

TEST(Speak, CountsCharactersAndNotBytes) {
    const Speech french = say("Élan déjà vu : « été », où çà ? Noël naïf aujourd'hui.", {.language = "fr"});
    expect_in_order(french);
    EXPECT_EQ(phonemes_of(french, 0), "e l 'ɑ̃");
    EXPECT_EQ(phonemes_of(french, french.words.size() - 1), "o ʒ u ʁ d y 'i");
    const Speech german = say("Größere Straßen für Übermütige", {.language = "de"});
    expect_in_order(german);
    EXPECT_EQ(phonemes_of(german, 2), "f yː ɾ");
    EXPECT_EQ(phonemes_of(say("😀😀 naïve dog"), 2), "d 'ɑː ɡ");
}

// Words that are spoken as one share their phonemes.
TEST(Speak, GivesEachWordOfALiaisonItsShare) {
    const Speech speech = say("Qu'est-ce que c'est que ça ?", {.language = "fr"});
    expect_in_order(speech);
    for (std::size_t i = 0; i < speech.words.size(); ++i) EXPECT_NE(phonemes_of(speech, i), "") << i;
}

TEST(Speak, KeepsItsPlaceInALongTextWithoutStops) {
    std::string text;
    for (int i = 0; i < 600; ++i) text += "seven dogs and papa ";
    const Speech speech = say(text);
    expect_in_order(speech);
    ASSERT_EQ(speech.words.size(), 2400u);
    for (std::size_t i = 1; i < 2400; i += 4) EXPECT_EQ(phonemes_of(speech, i), "d 'ɑː ɡ z") << i;
}

TEST(Speak, CarriesMarksOver) {
    MarkedText text = script("A small world.");
    text.marks = {{.kind = MarkKind::world, .value = "size", .first_word = 1, .end_word = 2, .weight = 0.7}};
    EXPECT_EQ(speak(text, {}).marks, text.marks);
}

TEST(Speak, IsSteeredBySsml) {
    const Speech plain = say_ssml("dogs remember houses");
    const Speech slow = say_ssml("dogs <prosody rate=\"50%\">remember</prosody> houses");
    EXPECT_GT(length_of(slow.words[1]), 1.6 * length_of(plain.words[1]));
    EXPECT_NEAR(length_of(slow.words[0]), length_of(plain.words[0]), 0.03);
    const Speech high = say_ssml("dogs <prosody pitch=\"150%\">remember</prosody> houses");
    EXPECT_GT(pitch_of(high, 1), 1.15 * pitch_of(plain, 1));
    const Speech loud = say_ssml("dogs <prosody volume=\"50%\">remember</prosody> houses");
    EXPECT_LT(rms(part_of(loud.audio, loud.words[1].start, loud.words[1].end)),
              0.7 * rms(part_of(plain.audio, plain.words[1].start, plain.words[1].end)));
    const Speech pause = say_ssml("dogs <break time=\"700ms\"/> remember houses");
    EXPECT_GT(pause.words[1].start - pause.words[0].end, 0.6);
    const Speech strong = say_ssml("dogs <emphasis level=\"strong\">remember</emphasis> houses");
    EXPECT_NE(strong.audio.samples, plain.audio.samples);
    for (const Speech* speech : {&plain, &slow, &high, &loud, &pause, &strong}) {
        expect_in_order(*speech);
        EXPECT_THAT(texts_of(*speech), ElementsAre("dogs", "remember", "houses"));
        EXPECT_EQ(phonemes_of(*speech, 2), "h 'aʊ z ᵻ z");
    }
}

TEST(Speak, FindsWordsBehindTagsAndEntities) {
    const Speech speech = say_ssml(
        "<p><s>AT&amp;T caf&#233;</s><s>cats &amp; <emphasis>dogs</emphasis>, "
        "<say-as interpret-as=\"characters\">xy</say-as> <!-- none --> <prosody rate='120%'>of the</prosody> "
        "house</s></p>");
    expect_in_order(speech);
    EXPECT_THAT(texts_of(speech),
                ElementsAre("AT&amp;T", "caf&#233", "cats", "&amp", "dogs", "xy", "of", "the", "house"));
    EXPECT_EQ(phonemes_of(speech, 2), "k ,æ t s");
    EXPECT_EQ(phonemes_of(speech, 4), "d 'ɑː ɡ z");
    EXPECT_EQ(phonemes_of(speech, 6), "ʌ v");
    EXPECT_EQ(phonemes_of(speech, 8), "h 'aʊ s");
}

TEST(Speak, SpeaksAsTheVoiceOfASpeakerSays) {
    const Speech plain = say("remember");
    EXPECT_LT(say("remember", {.rate = 300}).words[0].end, 0.75 * plain.words[0].end);
    EXPECT_GT(pitch_of(say("remember", {.pitch = 90}), 0), 1.2 * pitch_of(plain, 0));
    EXPECT_NE(say("remember", {.range = 0}).audio.samples, plain.audio.samples);
    EXPECT_GT(pitch_of(say("remember", {.variant = "f2"}), 0), 1.2 * pitch_of(plain, 0));
}

// With sanitizers two of them: each is read by a helper of its own, in the same way.
TEST(Speak, KnowsEveryVoiceThatTheBundledSpeakersMayHave) {
    std::vector<std::vector<float>> sounds;
    std::vector<const char*> variants = {"",   "m1", "m2", "m3", "m4", "m5", "m6",        "m7",
                                         "m8", "f1", "f2", "f3", "f4", "f5", "Mr serious"};
    if (testing::has_sanitizers()) variants = {"m3", "Mr serious"};
    for (const char* language : {"en-us", "en-gb", "en-gb-scotland", "fr", "de"}) {
        for (const char* variant : variants) {
            const Speech speech = say("remember me", {.language = language, .variant = variant});
            expect_in_order(speech);
            EXPECT_THAT(sounds, ::testing::Not(::testing::Contains(speech.audio.samples)))
                << language << variant;
            sounds.push_back(speech.audio.samples);
        }
    }
}

TEST(Speak, FindsTheWordsOfOddTexts) {
    const std::vector<std::string> pieces = {
        "dog",     "a",     "the",
        "of",      "é",     "Ω",
        "naïve",   "7",     "3.5",
        "1/2",     "50%",   "x=y",
        "don't",   "re-do", "http://a.org/b",
        "a@b.c",   "C++",   "—",
        "...",     "*",     "♪",
        "😀",       "日本",  "привет",
        "U.S.A.",  "&",     "<b>",
        "\"",      "'",     "(",
        "_x_",     "$5",    "№1",
        "½",       "ЖЖ",    "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
        "e\u0301", "[[x]]", "hm?!",
        "III",     "10:30"};
    Random random(testing::has_sanitizers() ? 4712 : 4711);
    const int rounds = testing::has_sanitizers() ? 10 : 40;
    for (int round = 0; round < rounds; ++round) {
        std::string text = "well";
        for (std::uint32_t i = 1 + random.below(20); i > 0; --i)
            text += (random.below(5) == 0 ? ", " : " ") +
                    pieces[random.below(static_cast<std::uint32_t>(pieces.size()))];
        SCOPED_TRACE(text);
        const std::string language = std::vector<std::string>{"en-us", "fr", "de"}[random.below(3)];
        const Speech speech = say(text, {.language = language});
        expect_in_order(speech);
        EXPECT_EQ(speech.words.size(), script(text).words.size());
    }
}

TEST(Speak, RefusesALanguageThatNobodySpeaks) {
    const std::string message = refusal_of([] { speak("Hello", "xx"); });
    EXPECT_THAT(message, ::testing::StartsWith("espeak-ng: no voice speaks \"xx\"; write one of af, "));
    EXPECT_THAT(message, HasSubstr(", de, el, en, en-029, en-gb, en-gb-scotland, "));
}

TEST(Speak, TakesALanguageHoweverItIsWritten) {
    EXPECT_EQ(speak("nation", "de-DE").samples, speak("nation", "de").samples);
    EXPECT_EQ(speak("nation", "fr_FR").samples, speak("nation", "fr-fr").samples);
    EXPECT_EQ(speak("nation", "EN").samples, speak("nation", "en").samples);
    EXPECT_EQ(speak("nation", "en-AU").samples, speak("nation", "en").samples);
    EXPECT_EQ(speak("nation", "es-MX").samples, speak("nation", "es-mx").samples);
    EXPECT_EQ(say("Hallo", {.language = "de_AT"}).audio.samples,
              say("Hallo", {.language = "de"}).audio.samples);
}

TEST(Speak, RefusesAVariantThatIsNotThere) {
    const std::string message = refusal_of([] { say("Hello", {.variant = "f9"}); });
    EXPECT_THAT(message,
                ::testing::StartsWith("espeak-ng: there is no variant \"f9\" of a voice; write one of "));
    EXPECT_THAT(message, HasSubstr(", f1, f2, f3, f4, f5, "));
}

TEST(Speak, RefusesSettingsOutOfRange) {
    EXPECT_EQ(refusal_of([] { say("Hello", {.pitch = 101}); }),
              "voice: the pitch is 101; write a number from 0 to 100");
    EXPECT_EQ(refusal_of([] { say("Hello", {.rate = 79}); }),
              "voice: the rate is 79; write a number from 80 to 450");
    EXPECT_EQ(refusal_of([] { say("Hello", {.range = -1}); }),
              "voice: the range is -1; write a number from 0 to 100");
}

TEST(Speak, RefusesWhatIsNoSpeech) {
    for (const char* text : {"", "...", " "}) {
        const std::string message = "espeak-ng: \"" + std::string(text) +
                                    "\" cannot be spoken in \"en\"; write a sentence of that language";
        EXPECT_EQ(refusal_of([&] { speak(text, "en"); }), message);
        EXPECT_EQ(refusal_of([&] { say(text, {.language = "en"}); }), message);
    }
    EXPECT_EQ(refusal_of([] { speak(std::string(500, '.'), "en"); }),
              "espeak-ng: \"" + std::string(60, '.') +
                  "...\" cannot be spoken in \"en\"; write a sentence of that language");
}

TEST(Speak, RefusesWhatIsNoText) {
    EXPECT_EQ(refusal_of([] { say("caf\xe9 noir"); }),
              "text to speak: byte 4 is not UTF-8; save it as UTF-8");
    EXPECT_EQ(refusal_of([] { say(std::string("a\0b", 3)); }),
              "text to speak: byte 2 is not UTF-8; save it as UTF-8");
    EXPECT_EQ(
        refusal_of([] { say_ssml("the <sub alias=\"World Wide Web\">WWW</sub>"); }),
        "text to speak: <sub> at byte 12 hides when its words are said; write its alias in place of it");
}

TEST(Speak, RefusesAWordThatIsNotHeard) {
    std::string text = "a";
    for (int i = 0; i < 100; ++i) text += " \u200b";
    EXPECT_THAT(refusal_of([&] { say(text); }),
                HasSubstr("(word 2 of 101) is not spoken in \"en-us\", and \"a\" beside it is too short"));
}

TEST(Speak, SaysThatItsVoicesAreNotWhereTheyShouldBe) {
    const testing::TemporaryFolder folder;
    const Environment elsewhere("ESPEAK_DATA_PATH", folder.path().string());
    EXPECT_EQ(refusal_of([] { speak("Hello", "en"); }),
              "espeak-ng: its voices are not in \"" + folder.path().string() +
                  "/espeak-ng-data\"; set ESPEAK_DATA_PATH to the folder that holds espeak-ng-data, or unset "
                  "it and install the package espeak-ng-data");
}

TEST(Speak, SaysThatItsHelperIsMissing) {
    const Environment elsewhere("CHIRONOMIA_SPEAK", "/nowhere/speak");
    EXPECT_EQ(refusal_of([] { speak("Hello", "en"); }),
              "chironomia_speak: speech needs this program, and it is not at /nowhere/speak; install "
              "chironomia again, or set CHIRONOMIA_SPEAK to its path");
}

TEST(Speak, SaysThatItsHelperDoesNotRunOrAnswer) {
    const testing::TemporaryFolder folder;
    const fs::path helper = folder / "speak";
    const Environment elsewhere("CHIRONOMIA_SPEAK", helper.string());
    write_text(helper, "#!/bin/sh\necho hello\n");
    EXPECT_EQ(refusal_of([] { speak("Hello", "en"); }),
              helper.string() + ": cannot be started (Permission denied); install it again");
    fs::permissions(helper, fs::perms::owner_all);
    EXPECT_EQ(
        refusal_of([] { speak("Hello", "en"); }),
        helper.string() + ": does not answer as this version of chironomia expects; install both again");
}

TEST(Speak, SaysThatTooManyFilesAreOpen) {
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    const rlimit none{.rlim_cur = 0, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_NOFILE, &none);
    std::exception_ptr thrown;
    try {
        speak("Hello", "en");
    } catch (...) {
        thrown = std::current_exception();
    }
    setrlimit(RLIMIT_NOFILE, &before);
    ASSERT_TRUE(thrown);
    // Read only now: the sanitizers open files to look at an exception.
    EXPECT_EQ(refusal_of([&] { std::rethrow_exception(thrown); }),
              "speech: no file can be opened (Too many open files); close other files or end other programs");
}

}  // namespace
}  // namespace chironomia
