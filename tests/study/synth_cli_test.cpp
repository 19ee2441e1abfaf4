// chironomia synth: the real binary, from a text to a motion that the other verbs read, and its refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files/files.h"
#include "core/files/json.h"
#include "core/files/wav_file.h"
#include "core/quantile.h"
#include "core/text.h"
#include "raster/ffmpeg/audio_file.h"
#include "skinning/motion/motion_hdf5.h"
#include "tests/study/process.h"
#include "tests/support/motion_hdf5.h"
#include "tests/support/support.h"

namespace chironomia::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Outcome;
using testing::run_chironomia;
using ::testing::SizeIs;
using testing::source_dir;
using testing::TemporaryFolder;

constexpr const char* kText = "Hello! There are two ways. One is small and quick, the other is really big.";

class Synth : public ::testing::Test {
  protected:
    Outcome synth(std::vector<std::string> more, const std::string& out = "m.h5") {
        std::vector<std::string> words = {"synth", "--out", file(out)};
        words.insert(words.end(), more.begin(), more.end());
        return run_chironomia(words);
    }
    std::string file(const std::string& name) { return (folder_ / name).string(); }

    // What a command line that must be refused as wrong input says.
    std::string refusal(std::vector<std::string> more) {
        const Outcome outcome = synth(std::move(more));
        EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
        EXPECT_FALSE(fs::exists(file("m.h5")));
        return outcome.err;
    }

    TemporaryFolder folder_;
};

TEST_F(Synth, MakesSpeechAndAMotionOfTheSameLength) {
    const Outcome made =
        synth({"--text", kText, "--speech-out", file("s.wav"), "--score-out", file("s.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, AllOf(HasSubstr("m.h5\n"), HasSubstr("15 words")));
    const Motion motion = testing::read_motion_hdf5(file("m.h5"));
    const Audio speech = read_audio(file("s.wav"));
    EXPECT_NEAR(duration(motion), speech.duration(), 1 / motion.fps);
    EXPECT_EQ(motion.fps, 30);
    ASSERT_TRUE(motion.joints && motion.face);
    EXPECT_EQ(motion.joints->skeleton.joints.size(), 55u);
    std::vector<std::string> labels;
    for (const LabelTrack& label : motion.labels) labels.push_back(label.name);
    EXPECT_THAT(labels, ::testing::UnorderedElementsAre("left phase", "right phase", "gesture", "function",
                                                        "accent"));
    const Json score = read_json(file("s.json"));
    EXPECT_EQ(score["words"].size(), 15u);
    EXPECT_GT(score["gestures"].size(), 0u);
    EXPECT_GT(score["signals"].size(), 0u);
}

TEST_F(Synth, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
    for (const char* name : {"a", "b"})
        ASSERT_EQ(synth({"--text", kText, "--seed", "7", "--speech-out", file(std::string(name) + ".wav")},
                        std::string(name) + ".h5")
                      .exit_code,
                  0);
    EXPECT_EQ(read_bytes(file("a.h5")), read_bytes(file("b.h5")));
    EXPECT_EQ(read_bytes(file("a.wav")), read_bytes(file("b.wav")));
    ASSERT_EQ(synth({"--text", kText, "--seed", "8"}, "c.h5").exit_code, 0);
    EXPECT_NE(read_bytes(file("a.h5")), read_bytes(file("c.h5")));
}

TEST_F(Synth, SpeaksAndActsInTheLanguageThatItIsGiven) {
    const std::string words = "Bonjour à tous. Aujourd’hui je voudrais parler de ce grand bâtiment.";
    const auto made_by = [&](std::vector<std::string> more) {
        more.insert(more.end(),
                    {"--text", words, "--score-out", file("s.json"), "--speech-out", file("s.wav")});
        EXPECT_EQ(synth(more).exit_code, 0);
        return std::pair(read_json(file("s.json"))["marks"].dump(), read_bytes(file("s.wav")));
    };
    EXPECT_THAT(synth({"--text", words}).err, HasSubstr("--text: 5 of its words are French"));
    const auto [english, english_sound] = made_by({});
    const auto [french, french_sound] = made_by({"--language", "fr"});
    EXPECT_THAT(french, HasSubstr("greet"));
    EXPECT_THAT(english, Not(HasSubstr("greet")));
    EXPECT_NE(french_sound, english_sound);
    const Outcome refused = synth({"--text", words, "--language", "xx"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("no voice speaks \"xx\"; write one of"));
}

TEST_F(Synth, ShowsNoAgreementWhereItIsDenied) {
    const auto gestures_of = [&](const char* text) {
        EXPECT_EQ(synth({"--text", text, "--language", "fr", "--score-out", file("s.json")}).exit_code, 0);
        return read_json(file("s.json"))["gestures"].dump();
    };
    EXPECT_THAT(gestures_of("Je suis d'accord avec vous."), HasSubstr("performative=agree"));
    EXPECT_THAT(gestures_of("Je ne suis pas d'accord avec vous."), Not(HasSubstr("performative=agree")));
}

TEST_F(Synth, MovesNoHandWithoutActivation) {
    ASSERT_EQ(synth({"--text", kText, "--oac", "0", "--score-out", file("s.json")}).exit_code, 0);
    EXPECT_EQ(read_json(file("s.json"))["gestures"].size(), 0u);
}

TEST_F(Synth, SaysWhereItHardlyGestures) {
    std::string text;
    for (int i = 0; i < 10; ++i) text += "It is as it was to be, and so we are. ";
    const Outcome made = synth({"--text", text});
    EXPECT_EQ(made.exit_code, 0);
    EXPECT_THAT(made.err,
                HasSubstr("few words weigh more than 0.5; raise --oac above 0.5 to show lighter ones"));
    const Outcome wished = synth({"--text", text, "--oac", "0.5"});
    EXPECT_THAT(wished.err, Not(HasSubstr("--oac")));
}

TEST_F(Synth, ShowsEveryGestureOfTheLexicon) {
    const Outcome made = synth({"--gesture", "all", "--score-out", file("s.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json score = read_json(file("s.json"));
    EXPECT_GE(score["gestures"].size(), 30u);
    for (std::size_t i = 0; i < score["gestures"].size(); ++i)
        EXPECT_NEAR(score["gestures"][i]["strokes"][0]["end"].get<double>(), 1.5 + 3.0 * double(i), 1e-9);
}

TEST_F(Synth, ReadsEveryLanguageFromATextOrAFile) {
    for (const char* script : {"two-ways", "simple-idea"}) {
        const std::string aplm = (source_dir() / format("assets/samples/demo/{}.aplm", script)).string();
        EXPECT_EQ(synth({"--aplm", aplm}).exit_code, 0);
        EXPECT_EQ(synth({"--script", aplm}).exit_code, 0);
        EXPECT_EQ(synth({aplm}).exit_code, 0);
    }
    EXPECT_EQ(synth({"Welcome! There are two ways."}).exit_code, 0);
    EXPECT_EQ(synth({"--ssml", "<speak>It is <emphasis>big</emphasis>.</speak>"}).exit_code, 0);
    EXPECT_EQ(
        synth({"--bml", "<bml><speech id=\"s\"><text><sync id=\"T0\" time=\"0\"/>Well</text></speech></bml>"})
            .exit_code,
        0);
}

TEST_F(Synth, GesturesWithARecording) {
    const fs::path folder = source_dir() / "assets/samples/speech";
    const std::string wav = (folder / "two-ways.wav").string();
    const Outcome with_words = synth(
        {"--speech", wav, "--words", (source_dir() / "tests/fixtures/speech/two-ways.TextGrid").string()});
    ASSERT_EQ(with_words.exit_code, 0) << with_words.err;
    EXPECT_THAT(with_words.out, Not(HasSubstr(" 0 gestures")));
    const Outcome heard = synth({"--speech", (folder / "simple-idea.wav").string()});
    ASSERT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_THAT(heard.err, HasSubstr("its words are not known; gestures go with what is stressed"));
    EXPECT_THAT(heard.out, AllOf(HasSubstr(" stressed places, "), Not(HasSubstr(" 0 gestures"))));
    fs::remove(file("m.h5"));
    EXPECT_THAT(refusal({"--speech", wav, "--text", "Something else"}),
                HasSubstr("nobody knows when its words are said; give them with --words"));
}

// What WebMAUS writes, and the same phonemes in IPA.
TEST_F(Synth, ShapesTheMouthByThePhonemesOfWebMaus) {
    const auto intensities_by = [&](const std::string& tier, const std::vector<std::string>& phones) {
        std::string grid =
            "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n2\n<exists>\n2\n"
            "\"IntervalTier\"\n\"ORT-MAU\"\n0\n2\n1\n0.5 1.5 \"bonjour\"\n"
            "\"IntervalTier\"\n\"" +
            tier + "\"\n0\n2\n5\n";
        for (std::size_t i = 0; i < phones.size(); ++i)
            grid += format("{:.1f} {:.1f} \"{}\"\n", 0.5 + 0.2 * double(i), 0.7 + 0.2 * double(i), phones[i]);
        write_text(file("w.TextGrid"), grid);
        EXPECT_EQ(
            synth({"--speech", file("s.wav"), "--words", file("w.TextGrid"), "--language", "fr"}).exit_code,
            0);
        return testing::read_motion_hdf5(file("m.h5")).face->intensities;
    };
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(2 * 16000, 0.1f)});
    const auto webmaus = intensities_by("MAU", {"b", "o~", "Z", "u", "R"});
    EXPECT_EQ(webmaus, intensities_by("phones", {"b", "o\u0303", "ʒ", "u", "ʁ"}));
    EXPECT_NE(webmaus, intensities_by("syllables", {"b", "o~", "Z", "u", "R"}));
}

// What a voice said, given back as a recording of which the words alone are timed.
TEST_F(Synth, FindsTheStressedVowelsOfWordsWithoutPhonemes) {
    ASSERT_EQ(
        synth({"--text", kText, "--speech-out", file("s.wav"), "--score-out", file("said.json")}).exit_code,
        0);
    const Json said = read_json(file("said.json"));
    std::string words = "word,start,end\n";
    for (const Json& word : said["words"]) {
        words += format("{},{},{}\n", word["word"].get<std::string>(), word["start"].get<double>(),
                        word["end"].get<double>());
    }
    write_text(file("w.csv"), words);
    const Outcome heard = synth({"--speech", file("s.wav"), "--words", file("w.csv"), "--text", kText,
                                 "--score-out", file("heard.json")});
    ASSERT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_THAT(heard.err, HasSubstr("they lie in each word as the voice of \"en-us\" says it"));
    const auto accents = [](const Json& score) {
        std::vector<double> times;
        for (const Json& gesture : score["gestures"])
            for (const Json& stroke : gesture["strokes"]) times.push_back(stroke["accent"].get<double>());
        return times;
    };
    const std::vector<double> wanted = accents(said), found = accents(read_json(file("heard.json")));
    ASSERT_THAT(found, SizeIs(wanted.size()));
    ASSERT_THAT(found, Not(SizeIs(0)));
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 0.01) << i;
}

// A word with the phonemes of an aligner, which are equally long.
struct AlignedWord {
    std::string text;
    double start = 0, end = 0;  // [s]
    std::vector<std::string> phones;
};

std::string grid_of(const std::vector<AlignedWord>& words, double duration) {
    std::string rows, phones;
    std::size_t count = 0;
    for (const AlignedWord& word : words) {
        rows += format("{} {} \"{}\"\n", word.start, word.end, word.text);
        const double each = (word.end - word.start) / static_cast<double>(word.phones.size());
        for (std::size_t i = 0; i < word.phones.size(); ++i, ++count) {
            const double start = word.start + each * static_cast<double>(i);
            phones += format("{:.3f} {:.3f} \"{}\"\n", start, start + each, word.phones[i]);
        }
    }
    return format(
        "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n{0}\n<exists>\n2\n"
        "\"IntervalTier\"\n\"words\"\n0\n{0}\n{1}\n{2}\"IntervalTier\"\n\"phones\"\n0\n{0}\n{3}\n{4}",
        duration, words.size(), rows, count, phones);
}

// As the Montreal Forced Aligner writes IPA. A third of these words is nowhere near their stress.
TEST_F(Synth, FindsTheStressOfPhonemesWithoutMarks) {
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(14 * 16000, 0.1f)});
    write_text(file("w.TextGrid"),
               grid_of({{"banana", 1, 1.6, {"b", "ə", "n", "æ", "n", "ə"}},
                        {"strength", 4, 4.8, {"s", "t", "ɹ", "ɛ", "ŋ", "k", "θ", "s"}},
                        // Said with two vowels, "ɛvɹi".
                        {"every", 7, 7.5, {"ɛ", "v", "ə", "ɹ", "i"}},
                        {"understand", 10, 11, {"ʌ", "n", "d", "ɚ", "s", "t", "æ", "n", "d", "z"}}},
                       14));
    std::string script;
    for (const char* word : {"banana", "strength", "every", "understand"})
        script +=
            format("<rheme><emphasis x-pitchaccent=\"Hstar\" weight=\"1\">{}</emphasis></rheme> ", word);
    const Outcome made =
        synth({"--speech", file("s.wav"), "--words", file("w.TextGrid"), "--aplm",
               "<aplm>" + script + "</aplm>", "--speaker", "vigorous", "--score-out", file("s.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err,
                HasSubstr("its file of words marks no stress on 3 words of several vowels: it lies where the "
                          "voice of \"en-us\" puts it"));
    std::vector<double> accents;
    const Json score = read_json(file("s.json"));
    for (const Json& gesture : score["gestures"]) accents.push_back(gesture["strokes"][0]["accent"]);
    ASSERT_THAT(accents, SizeIs(4));
    EXPECT_NEAR(accents[0], 1.3, 0.001);
    EXPECT_NEAR(accents[1], 4.3, 0.001);
    EXPECT_NEAR(accents[2], 7, 0.001);
    EXPECT_NEAR(accents[3], 10.6, 0.001);
}

TEST_F(Synth, SaysWhyNoVoiceKnowsAStress) {
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(2 * 16000, 0.1f)});
    write_text(file("w.TextGrid"), grid_of({{"東京", 0.5, 1.5, {"t", "oː", "k", "j", "oː"}}}, 2));
    const Outcome made =
        synth({"--speech", file("s.wav"), "--words", file("w.TextGrid"), "--language", "ja"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(
        made.err,
        AllOf(HasSubstr("marks no stress on 1 word of several vowels, and no synthetic voice knows it ("),
              HasSubstr("): strokes on them end at a third of the word")));
}

TEST_F(Synth, KeepsEachWordOfARecording) {
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(2 * 16000, 0.1f)});
    write_text(file("w.csv"), "word,start,end\nhello,0.2,0.5\n\U0001f44d,0.6,0.8\nworld,1,1.5\n");
    const Outcome made =
        synth({"--speech", file("s.wav"), "--words", file("w.csv"), "--score-out", file("s.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, Not(HasSubstr("emoji")));
    EXPECT_EQ(read_json(file("s.json"))["words"].size(), 3u);
}

TEST_F(Synth, SaysWhyNoVoiceGivesPhonemes) {
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(2 * 16000, 0.1f)});
    write_text(file("w.csv"), "word,start,end\n東京,0.5,1.5\n");
    const Outcome made = synth({"--speech", file("s.wav"), "--words", file("w.csv"), "--language", "ja"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, AllOf(HasSubstr("no synthetic voice gives them ("),
                                HasSubstr("): the mouth follows the loudness")));
}

TEST_F(Synth, SaysThatTheVoiceOfAnotherLanguageGivesNoPhonemes) {
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(2 * 16000, 0.1f)});
    write_text(file("w.csv"), "word,start,end\nصباح,0.2,0.8\nالخير,1,1.5\n");
    const Outcome made = synth({"--speech", file("s.wav"), "--words", file("w.csv")});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err,
                HasSubstr("\"en-us\" cannot read \"صباح\"; give the language of these letters (--language"));
}

TEST_F(Synth, TakesRatesAndLanguagesAsOthersWriteThem) {
    const auto bytes_of = [&](const char* rate, const char* language) {
        const Outcome made = synth({"--text", "Hello.", "--fps", rate, "--language", language});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return read_bytes(file("m.h5"));
    };
    EXPECT_EQ(bytes_of("30000/1001", "en_US"), bytes_of("29.97", "en-us"));
    EXPECT_NE(bytes_of("30000/1001", "en-us"), bytes_of("30", "en-us"));
}

TEST_F(Synth, SaysThatNoSpeechIsHeard) {
    write_wav(file("s.wav"), {.rate = 16000, .channels = 1, .samples = std::vector<float>(12 * 16000)});
    const Outcome silent = synth({"--speech", file("s.wav")});
    EXPECT_EQ(silent.exit_code, 0);
    EXPECT_THAT(silent.err, HasSubstr("s.wav: no speech is heard in it, and nothing is gestured"));
    EXPECT_THAT(silent.err, Not(HasSubstr("--oac")));
}

// Five seconds of silence before a recording whose words were timed without them.
TEST_F(Synth, SaysThatWordsLieInSilence) {
    const fs::path wav = source_dir() / "assets/samples/speech/two-ways.wav";
    const std::string words = (source_dir() / "tests/fixtures/speech/two-ways.TextGrid").string();
    EXPECT_THAT(synth({"--speech", wav.string(), "--words", words}).err, Not(HasSubstr("silent")));
    Audio late = read_audio(wav);
    late.samples.insert(late.samples.begin(), static_cast<std::size_t>(5 * late.rate * late.channels), 0.0f);
    write_wav(file("late.wav"), late);
    const Outcome noted = synth({"--speech", file("late.wav"), "--words", words});
    EXPECT_EQ(noted.exit_code, 0);
    EXPECT_THAT(noted.err, AllOf(HasSubstr(": 15 of 24 words lie where "),
                                 HasSubstr("late.wav is silent, the first is "),
                                 HasSubstr(" s; are its times those of this sound?")));
}

// As of a transcript of the beginning alone, and of times that are halved.
TEST_F(Synth, SaysThatSpeechHasNoWords) {
    const fs::path folder = source_dir() / "assets/samples/speech";
    const std::string whole = read_text(folder / "two-ways.words.csv");
    const std::vector<std::string_view> rows = split(trim(whole), '\n');
    std::string few(rows[0]), halved = few + "\n";
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string_view> cells = split(rows[i], ',');
        if (i < 6) few += format("\n{}", rows[i]);
        halved += format("{},{},{}\n", cells[0], *parse_number(cells[1]) / 2, *parse_number(cells[2]) / 2);
    }
    for (const auto& [words, from] : {std::pair(few, "1.5"), {halved, "4.1"}}) {
        write_text(file("w.csv"), words);
        EXPECT_THAT(
            synth({"--speech", (folder / "two-ways.wav").string(), "--words", file("w.csv")}).err,
            AllOf(HasSubstr(format("w.csv: no word lies from {} to 9.0 s, where ", from)),
                  HasSubstr(
                      "two-ways.wav is as loud as in its words; are all of them there, at their times?")));
    }
    const Outcome known =
        synth({(folder / "two-ways.txt").string(), "--speech", (folder / "two-ways.wav").string(), "--words",
               (folder / "two-ways.words.csv").string()});
    EXPECT_EQ(known.exit_code, 0) << known.err;
    EXPECT_THAT(known.err, Not(HasSubstr("no word lies")));
}

// As the core of BML, GRETA and a mistyped function of one's own ask.
TEST_F(Synth, SaysWhatNoGestureShows) {
    const auto notes = [&](const std::string& gesture) {
        return synth({"--bml",
                      "<bml><speech id=\"s\" xmlns=\"\">Look at this box</speech>" + gesture + "</bml>"})
            .err;
    };
    EXPECT_THAT(
        notes("<gesture lexeme=\"POINT\" target=\"greenBox\"/>"),
        AllOf(HasSubstr("the place of \"greenBox\" is not known; <gesture> points to the side of the hand"),
              Not(HasSubstr("a beat is shown"))));
    EXPECT_THAT(
        notes("<gesture lexeme=\"own\"><description><reference>world</reference></description></gesture>"),
        HasSubstr("gesture \"own\": no gesture of the lexicon shows world; a beat is shown"));
    EXPECT_THAT(synth({"--aplm", "<APLM><world type=\"x-spirl\">round</world> it goes</APLM>"}).err,
                HasSubstr("no gesture of the lexicon names world=x-spirl"));
}

TEST_F(Synth, ReadsTheEncodingThatXmlDeclares) {
    write_text(file("fr.xml"),
               "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<bml><speech id=\"s\"><text>Voil\xe0 "
               "l'\xe9t\xe9</text></speech></bml>\n");
    ASSERT_EQ(synth({file("fr.xml"), "--language", "fr", "--score-out", file("s.json")}).exit_code, 0);
    EXPECT_EQ(read_json(file("s.json"))["words"][1]["word"], "l'été");
}

TEST_F(Synth, SaysThatTheEndOfARecordingCutsAGestureOff) {
    Audio sound = read_audio(source_dir() / "assets/samples/speech/two-ways.wav");
    sound.samples.resize(static_cast<std::size_t>(2.0 * sound.rate * sound.channels));
    write_wav(file("short.wav"), sound);
    write_text(file("words.csv"), "word,start,end\ngoodbye,1.2,1.9\n");
    const Outcome cut = synth({"--speech", file("short.wav"), "--words", file("words.csv")});
    EXPECT_EQ(cut.exit_code, 0);
    EXPECT_THAT(cut.err, AllOf(HasSubstr("gesture \""),
                               HasSubstr(" s, but the speech ends at 2.00 s and cuts it off")));
}

TEST_F(Synth, TakesTheWordsOfARecordingAsTheyStand) {
    const std::string wav = (source_dir() / "assets/samples/speech/two-ways.wav").string();
    write_text(file("w.csv"), "word,start,end\n*hello*,1,1.4\n[world](a),2,2.6\n");
    const Outcome made = synth({"--speech", wav, "--words", file("w.csv")});
    EXPECT_EQ(made.exit_code, 0);
    EXPECT_THAT(made.err, Not(HasSubstr("Markdown")));
}

TEST_F(Synth, GesturesWithTheWordsOfTheSpeakerWhoIsChosen) {
    const std::string wav = (source_dir() / "assets/samples/speech/two-ways.wav").string();
    write_text(file("w.csv"), "word,start,end,speaker\nhello,1,1.4,Ann\ngoodbye,2,2.6,Ben\n");
    EXPECT_THAT(refusal({"--speech", wav, "--words", file("w.csv")}),
                HasSubstr("w.csv: line 3 is said by \"Ben\", what is before it by \"Ann\""));
    const Outcome made = synth(
        {"--speech", wav, "--words", file("w.csv"), "--words-speaker", "Ben", "--score-out", file("s.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json words = read_json(file("s.json"))["words"];
    ASSERT_EQ(words.size(), 1u);
    EXPECT_EQ(words[0]["word"], "goodbye");
}

TEST_F(Synth, TakesTheChannelOfAPersonFromASoundOfTwo) {
    ASSERT_EQ(synth({"--text", "Hello there! This one is really enormous.", "--speech-out", file("one.wav")})
                  .exit_code,
              0);
    const Audio one = read_audio(file("one.wav"));
    // The same words, first from the left and then from the right, or from both sides at once.
    const auto write_stereo = [&](const char* name, bool in_turn) {
        Audio both{.rate = one.rate, .channels = 2, .samples = std::vector<float>(4 * one.length())};
        for (std::size_t i = 0; i < one.length(); ++i) {
            both.samples[2 * i] = one.samples[i];
            both.samples[2 * (in_turn ? one.length() + i : i) + 1] = one.samples[i];
        }
        write_wav(file(name), both);
    };
    write_stereo("two.wav", true);
    write_stereo("same.wav", false);
    const std::string two = file("two.wav");
    EXPECT_THAT(synth({"--speech", two}).err,
                HasSubstr("if they are two people, --speech-channel left or right takes one"));
    EXPECT_THAT(synth({"--speech", file("same.wav")}).err, Not(HasSubstr("channel")));
    const auto stroke_ends = [&](const std::string& side) {
        const Outcome made =
            synth({"--speech", two, "--speech-channel", side, "--oac", "1", "--score-out", file("s.json")});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        EXPECT_THAT(made.err, Not(HasSubstr("channel")));
        std::vector<double> ends;
        const Json score = read_json(file("s.json"));
        for (const Json& gesture : score["gestures"]) ends.push_back(gesture["strokes"][0]["end"]);
        return ends;
    };
    const double half = static_cast<double>(one.length()) / one.rate;
    EXPECT_THAT(stroke_ends("left"), AllOf(Not(IsEmpty()), ::testing::Each(::testing::Lt(half))));
    EXPECT_THAT(stroke_ends("right"), AllOf(Not(IsEmpty()), ::testing::Each(::testing::Gt(half))));
    fs::remove(file("m.h5"));
    EXPECT_THAT(refusal({"--speech", file("one.wav"), "--speech-channel", "left"}),
                HasSubstr("one.wav: it has 1 channel, but one side of 2 was asked for"));
}

TEST_F(Synth, DoesNotSpeakTheSignsOfMarkdown) {
    const auto sound_of = [&](const std::string& text) {
        EXPECT_EQ(synth({"--text", text, "--speech-out", file("s.wav")}).exit_code, 0);
        return read_bytes(file("s.wav"));
    };
    EXPECT_EQ(sound_of("It is **really** big.\n"), sound_of("It is really big.\n"));
}

TEST_F(Synth, ShowsHeadsFacesAndGazesOfBml) {
    write_text(file("t.bml"),
               "<bml><speech id=\"s\"><text>Well <sync id=\"A\"/>thank <sync id=\"B\"/>you</text></speech>"
               "<head lexeme=\"NOD\" start=\"s:A\" end=\"s:B\"/><faceLexeme lexeme=\"smile\" start=\"s:A\" "
               "end=\"s:end\"/><gaze target=\"user\" start=\"s:B\"/></bml>");
    const Outcome made = synth({"--bml", file("t.bml"), "--score-out", file("s.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Json score = read_json(file("s.json"));
    const auto starts_at_word = [&](const std::string& name, std::size_t word) {
        return std::ranges::any_of(score["signals"], [&](const Json& signal) {
            return signal["signal"] == name && signal["start"] == score["words"][word]["start"];
        });
    };
    EXPECT_TRUE(starts_at_word("nod", 1)) << score["signals"];
    EXPECT_TRUE(starts_at_word("smile", 1));
    EXPECT_TRUE(starts_at_word("look at", 2));
}

TEST_F(Synth, SaysThatTagsAreSpokenAsWords) {
    const char* const ssml = "<speak>One. Two.</speak>";
    EXPECT_THAT(synth({"--text", ssml}).err,
                HasSubstr("--text: its tags are spoken as words; give it by --ssml"));
    EXPECT_THAT(synth({"--ssml", ssml}).err, Not(HasSubstr("tags")));
}

TEST_F(Synth, ReadsARecordingInTheLanguageThatItsWordsAreIn) {
    const std::string wav = (source_dir() / "assets/samples/speech/two-ways.wav").string();
    write_text(file("fr.json"),
               R"({"language": "fr", "words": [{"word": "Bonjour", "start": 1, "end": 2}]})");
    const Outcome french =
        synth({"--speech", wav, "--words", file("fr.json"), "--score-out", file("s.json")});
    ASSERT_EQ(french.exit_code, 0) << french.err;
    EXPECT_THAT(french.err,
                HasSubstr("its words are in \"fr\", as it says, and not in the speaker's \"en-us\""));
    EXPECT_THAT(read_text(file("s.json")), HasSubstr("\"greet\""));
    const Outcome asked = synth({"--speech", wav, "--words", file("fr.json"), "--language", "de"});
    EXPECT_THAT(asked.err, Not(HasSubstr("\"fr\"")));
    fs::remove(file("m.h5"));
    write_text(file("words.lab"), "10000000 20000000 hello\n");
    EXPECT_THAT(refusal({"--speech", wav, "--words", file("words.lab")}),
                HasSubstr("words.lab: it holds phonemes and no words, as label files of HTK are read"));
}

// Words in time gesture as their text does: with its punctuation just so, without it by the pauses of the voice.
TEST_F(Synth, PartsTheWordsOfARecordingAsAScriptWould) {
    constexpr const char* kTalk =
        "We measured the temperature of the whole building. Nobody expected such enormous differences, but the "
        "instruments agreed. The upper windows were responsible. Replacing them was expensive, and everybody "
        "complained. Afterwards the heating consumed considerably less electricity.";
    const auto score = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--score-out", file("score.json")});
        const Outcome made = synth(std::move(more));
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return read_json(file("score.json"));
    };
    // What the words themselves ask for, without what the voice stresses.
    const auto asked = [](const Json& score) {
        Json marks = Json::array();
        for (const Json& mark : score["marks"])
            if (mark["kind"] != "emphasis" || mark["value"] != "medium") marks.push_back(mark);
        return marks;
    };
    const Json of_text = score({"--text", kTalk, "--speech-out", file("talk.wav")});
    EXPECT_GE(of_text["gestures"].size(), 4u);
    const std::vector<std::string_view> written = split_words(kTalk);
    std::string bare = "start,end,word\n", punctuated = bare;
    const Json& words = of_text["words"];
    ASSERT_EQ(words.size(), written.size());
    for (std::size_t w = 0; w < words.size(); ++w) {
        const std::string times =
            format("{},{},", words[w]["start"].get<double>(), words[w]["end"].get<double>());
        bare += times + words[w]["word"].get<std::string>() + "\n";
        punctuated += times + "\"" + std::string(written[w]) + "\"\n";
    }
    write_text(folder_ / "bare.csv", bare);
    write_text(folder_ / "punctuated.csv", punctuated);
    const Json same = score({"--speech", file("talk.wav"), "--words", file("punctuated.csv")});
    EXPECT_EQ(asked(same), asked(of_text));
    EXPECT_GE(same["gestures"].size(), of_text["gestures"].size());
    const Json bare_score = score({"--speech", file("talk.wav"), "--words", file("bare.csv")});
    EXPECT_GE(bare_score["gestures"].size(), of_text["gestures"].size());
}

// Words that say nothing to gesture about go with the stresses of the voice; a script of one's own has its own marks.
TEST_F(Synth, GesturesWithTheStressesOfARecordingWhoseWordsShowNothing) {
    const fs::path wav = source_dir() / "assets/samples/speech/two-ways.wav";
    std::string words = "word,start,end\n";
    for (int i = 0; i < 30; ++i) words += format("the,{:.1f},{:.1f}\n", 0.2 * i, 0.2 * i + 0.2);
    write_text(file("words.csv"), words);
    const auto marks = [&](std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"--speech", wav.string(), "--words", file("words.csv"), "--score-out", file("s.json")});
        EXPECT_EQ(synth(std::move(more)).exit_code, 0);
        std::vector<double> starts;
        const Json score = read_json(file("s.json"));
        for (const Json& mark : score["marks"]) {
            if (mark["kind"] == "emphasis" && mark["value"] == "medium")
                starts.push_back(score["words"][mark["words"][0].get<std::size_t>()]["start"]);
        }
        return starts;
    };
    const std::vector<double> stressed = marks({});
    EXPECT_GE(stressed.size(), 2u);
    for (std::size_t i = 1; i < stressed.size(); ++i) EXPECT_GE(stressed[i] - stressed[i - 1], 1.8);
    EXPECT_THAT(read_json(file("s.json"))["gestures"], SizeIs(Ge(2u)));
    std::string script;
    for (int i = 0; i < 30; ++i) script += "the ";
    EXPECT_THAT(marks({"--aplm", "<aplm>" + script + "</aplm>"}), IsEmpty());
}

TEST_F(Synth, MakesBothPeopleOfADialog) {
    write_text(folder_ / "talk.json", R"({"people": [{"speaker": "neutral"}, {"speaker": "vigorous"}],
        "turns": [{"person": 0, "text": "Is this the biggest of them?"}, {"person": 1, "text": "No, there are two bigger ones."}]})");
    const Outcome made = synth({"--dialog", file("talk.json")}, "talk");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Motion one = testing::read_motion_hdf5(folder_ / "talk/person-0.h5"),
                 other = testing::read_motion_hdf5(folder_ / "talk/person-1.h5");
    EXPECT_EQ(one.frames, other.frames);
    EXPECT_EQ(read_audio(folder_ / "talk/person-0.wav").length(),
              read_audio(folder_ / "talk/person-1.wav").length());
    const Json first = read_json(folder_ / "talk/person-0.json"),
               second = read_json(folder_ / "talk/person-1.json");
    EXPECT_EQ(first["words"].size(), 6u);
    EXPECT_LT(first["words"].back()["end"], second["words"].front()["start"]);
    EXPECT_EQ(second["speaker"], "vigorous");
    EXPECT_THAT(made.err, HasSubstr("person 1: gesture \""));
}

// The head of the left one of two goes to the left, where the other stands.
TEST_F(Synth, LooksAtAPartnerWhoStandsAside) {
    const auto yaw = [&](const std::string& degrees) {
        EXPECT_EQ(synth({"--text", kText, "--partner-deg", degrees}, "m.h5").exit_code, 0);
        std::vector<double> yaws;
        for (const Quat& turn : testing::read_motion_hdf5(folder_ / "m.h5").face->head) {
            const Vec3 ahead = turn * Vec3(0, 0, 1);
            yaws.push_back(std::atan2(ahead.x, ahead.z));
        }
        return glm::degrees(median(yaws));
    };
    const double left = yaw("35"), right = yaw("-35"), ahead = yaw("0");
    EXPECT_GT(left, ahead + 15);
    EXPECT_LT(right, ahead - 15);
}

TEST_F(Synth, ReadsNoTablesAloud) {
    std::string table = "frame, timestamp, confidence\n";
    for (int t = 0; t < 40; ++t) table += format("{}, {:.3f}, 0.98\n", t, t / 30.0);
    write_text(folder_ / "face.csv", table);
    const Outcome outcome = synth({file("face.csv")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err,
                HasSubstr("face.csv: 120 of its 123 words are numbers, so it is a table and no text"));
}

TEST_F(Synth, SaysWhatIsWrong) {
    EXPECT_THAT(refusal({"--text", kText, "--speaker", "vigourous"}),
                HasSubstr("there is no such speaker; did you mean vigorous?"));
    EXPECT_THAT(refusal({"--aplm", "<APLM><theme>One</rheme></APLM>"}), HasSubstr("--aplm:1:"));
    EXPECT_THAT(refusal({"--text", " "}), HasSubstr("--text"));
    EXPECT_THAT(refusal({"--text", "こんにちは。今日はいいてんきです。", "--language", "ja"}),
                HasSubstr("\"ja\" cannot read \"今日はいいてんきです\"; give the language of these letters"));
    EXPECT_THAT(refusal({"--gesture", "wave_hello_there"}), HasSubstr("there is no such gesture"));
    EXPECT_THAT(refusal({"--text", kText, "--lexicon", "none.json"}), HasSubstr("none.json"));
    EXPECT_THAT(refusal({"--dialog", "none.json"}), HasSubstr("none.json"));
    EXPECT_THAT(refusal({"--engine", "amii"}), HasSubstr("give both --user-face and --user-speech"));
    const Outcome bvh = synth({"--text", kText}, "m.bvh");
    EXPECT_EQ(bvh.exit_code, 3);
    EXPECT_THAT(bvh.err, HasSubstr("a motion is written as .h5; name it so, and convert it"));
}

TEST_F(Synth, RefusesAWrongCommandLine) {
    const auto wrong = [&](std::vector<std::string> more) {
        const Outcome outcome = synth(std::move(more));
        EXPECT_EQ(outcome.exit_code, 2);
        return outcome.err;
    };
    EXPECT_THAT(wrong({}),
                HasSubstr("--text, --aplm, --bml, --ssml, --script, --speech, --gesture or --dialog"));
    EXPECT_THAT(wrong({"--text", "a", "--style-of", "b"}),
                HasSubstr("--style-of: needs a learned engine: zs-mstm, mix-stage\n"));
    EXPECT_THAT(wrong({"--text", "a", "--aplm", "b"}), HasSubstr("--aplm"));
    EXPECT_THAT(wrong({"--text", "a", "--oac", "-0.5"}), HasSubstr("--oac"));
    EXPECT_THAT(wrong({"--text", "a", "--tempo-reading", "slow"}),
                HasSubstr("\"slow\" is none of fast, printed"));
    EXPECT_THAT(wrong({"--text", "a", "--engine", "magic"}), HasSubstr("magic"));
    EXPECT_THAT(wrong({"--dialog", "d.json", "--oac", "1"}),
                HasSubstr("a dialog's file says who speaks and how"));
    EXPECT_THAT(wrong({"--text", "a", "--words", "w.csv"}), HasSubstr("--speech"));
}

}  // namespace
}  // namespace chironomia::study
